"""Errors of slider and coupler point from links, pins, guide and input.

Pins move the hole of one link against that of the other, in the directions along and across the rod. The
slider stands off its line in its guide.
"""

from collections.abc import Iterator

import numpy as np

from mechwright import DesignError, Output, Tolerances
from mechwright.contracts.fit_settings import RUNNING
from mechwright.mechanics.linkage.tolerance.contributors import Fixed, Play, Source
from mechwright.mechanics.linkage.tolerance.model import MachineTolerances
from mechwright.mechanics.linkage.tolerance.outputs import Judged, Point, Way
from mechwright.mechanics.planar.dynamics import GROUND
from mechwright.mechanics.planar.sensitivity import Change
from mechwright_slider_crank.kinematics.course import course_of
from mechwright_slider_crank.kinematics.mechanism import Mechanism

SLIDER = Output("slider position", "mm")
POINT = Output("coupler point", "mm", 2)


GUIDE_WALLS = 4
"""Milled walls between which the slider has its play: two of the rails and its own."""

EYE = "point"
"""Where the coupler point's change stands in a :class:`Change`."""


class SliderCrankTolerances(MachineTolerances):
    """The model of one design; crank angles count from X, as in the motion."""

    def __init__(self, table: Mechanism, tolerances: Tolerances) -> None:
        if table.closed.at_limit:
            raise DesignError(
                "rod: where it stands across the slide, no error is of first order; make it longer"
            )
        *_, guide = table.closed.joints
        judged: list[Judged] = [Way(guide, SLIDER), Point("rod", table.given.coupler_point, EYE, POINT)]
        super().__init__(table, course_of(table), list(_sources(table, tolerances)), judged)


def _sources(table: Mechanism, tolerances: Tolerances) -> Iterator[Source]:
    given, sizes = table.given, table.dimensions
    shaft, crank_pin, wrist_pin, _ = table.closed.joints
    across = 1j * np.exp(1j * table.closed.direction)
    line = Fixed(Change({("guide", GROUND): across}))
    yield Source(tolerances.length("crank", given.crank), (Fixed(Change({("crank-pin", "crank"): 1.0})),))
    yield Source(tolerances.length("rod", given.rod), (Fixed(Change({("wrist-pin", "rod"): 1.0})),))
    yield Source(tolerances.length("offset", given.offset), (line,))
    for joint, made, link, size, way in (
        (shaft, "shaft", "crank", sizes.shaft, 1.0),
        (crank_pin, "pin-a", "crank", sizes.pin, -1.0),
        (wrist_pin, "pin-b", "slider", sizes.pin, 1.0),
    ):
        play = tolerances.pin(joint.name, size, f"{RUNNING}/h6", member=joint is not shaft, joint=made)
        ways = (complex(way), 1j * way)[: play.components]
        yield Source(play, tuple(Play(link, (joint,), "rod", one) for one in ways))
    yield Source(tolerances.gap("guide", 2 * given.play, GUIDE_WALLS), (line,))
    point = given.coupler_point
    for name, value, part in (("along", point.real, 1.0), ("across", point.imag, 1j)):
        yield Source(tolerances.length(f"point-{name}", value), (Fixed(Change({(EYE, "rod"): part})),))
    for one in tolerances.input("input"):
        yield Source(one, (Fixed(Change(input=1.0)),))
