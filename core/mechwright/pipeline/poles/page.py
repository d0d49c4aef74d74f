"""The page ``poles.html``."""

import math
from abc import abstractmethod
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, ClassVar

from mechwright.pipeline.build import Build, Wanted
from mechwright.pipeline.figures import Figure, Grid, figures_page
from mechwright.pipeline.page import FileName, Page

if TYPE_CHECKING:
    from mechwright.pipeline.poles.coupler import Coupler

NAME = "poles.html"
"""The file."""

RATIOS = (0.0, 0.5, -0.5)
"""Acceleration ratios that are drawn beside the design's own."""

POSITIONS = 4
"""Crank angles at which the circles are drawn: a sixth of the way, then even steps."""


class PolesPage(Page):
    """``poles.html``: loci of the acceleration pole on both planes, the circles at some angles, numbers.

    A family derives from it, says its own name, and what its coupler does.
    """

    commands = frozenset({"solve", "build"})
    doing = "poles"
    family: ClassVar[str]
    """Name of the family whose designs have the page."""

    @abstractmethod
    def coupler(self, params: Any) -> "Coupler":
        """The coupler of a design that moves."""

    def names(self, build: Build, wanted: Wanted) -> list[FileName]:  # noqa: ARG002
        """The page."""
        return [FileName(NAME, "the poles")] if build.design.family.name == self.family else []

    def files(self, build: Build) -> Mapping[str, str]:
        """The page; none for other families, and where the coupler only shifts."""
        if build.design.family.name != self.family:
            return {}
        coupler = self.coupler(build.design.params)
        try:
            html = page(build.design.name, build.design.family.title, coupler)
        except NoPole:
            return {}
        return {NAME: html}


class NoPole(Exception):  # noqa: N818 - it is no fault
    """All points of the coupler share one acceleration."""


def page(name: str, title: str, coupler: "Coupler") -> str:
    """The page of a coupler; raises NoPole where it has no pole."""
    import numpy as np

    from mechwright.pipeline.poles import planes

    own = coupler.course.acceleration_ratio
    ratios = tuple(dict.fromkeys((own, *RATIOS)))
    if not np.isfinite(coupler.locus(own)[0]).any():
        raise NoPole
    start, travel = coupler.course.start, coupler.course.travel
    angles = [start + travel * (1 + 1.5 * n) / 6 for n in range(POSITIONS)]
    said = ", ".join(f"{ratio:g}" for ratio in ratios)
    figures = [
        Figure(
            "On the ground",
            planes.ground(coupler, ratios, angles[0]),
            f"Loci of the acceleration pole G over a period for the acceleration ratios k = α/ω² of the "
            f"crank, {said} per radian; the first is the design's own, dashed in the other assembly.",
        ),
        Figure(
            "In the coupler",
            planes.moving(coupler, ratios),
            "The same loci as the coupler sees them, A in the origin, B to the right.",
        ),
    ]
    figures += [
        Figure(
            f"Crank at {math.degrees(phi):.4g}°",
            planes.position(coupler, own, phi),
            f"P at {_place(complex(coupler.circles(phi, own).instant_centre[0]))}; "
            f"G at {_place(coupler.pole(phi, own))}.",
        )
        for phi in angles
    ]
    return figures_page(
        name, f"{title}: acceleration poles", _notes(coupler), figures, [_table(coupler, angles)]
    )


def _notes(coupler: "Coupler") -> list[str]:
    k = coupler.course.acceleration_ratio
    law = (
        "The crank is a lever with a law of its own; drawn are the poles of constant acceleration ratios."
        if coupler.course.rocks
        else "The crank's speed is constant."
        if k == 0
        else f"The crank's acceleration is {k:g} times the square of its speed, all along."
    )
    return [
        f"{law} Places are from A0, in mm; k is counter-clockwise positive, per radian.",
        "Circles, blue: the inflection circle. Whatever the crank's acceleration, the pole lies on it; the "
        "dots are the poles of the ratios beside them. Green: the circle of zero tangential acceleration "
        "of the design's own ratio. Both meet in the instant centre P and in the pole G.",
    ]


def _table(coupler: "Coupler", angles: list[float]) -> Grid:
    own = coupler.course.acceleration_ratio
    ratios = sorted({own, *RATIOS})
    rows = []
    for phi in angles:
        found, body = coupler.circles(phi, own), coupler.body(phi, 0.0)
        omega, alpha = float(body.turning.omega[0]), float(body.turning.alpha[0])
        rows.append(
            [
                f"{math.degrees(phi):.6g}°",
                _place(complex(found.instant_centre[0])),
                _place(complex(found.inflection_pole[0])),
                f"{-alpha / omega:.6f}" if omega else "none",
                *(_place(coupler.pole(phi, ratio)) for ratio in ratios),
            ]
        )
    head = ["crank", "P", "inflection pole", "its k", *(f"G, k = {ratio:g}" for ratio in ratios)]
    return Grid("Instant centre and poles, mm from A0", head, rows)


def _place(point: complex) -> str:
    if math.isnan(point.real):
        return "at infinity"
    return f"{point.real:.4f}, {point.imag:.4f}".replace("-", "−")
