"""Errors of the coupler point from links, pins, gears and the input.

Pins move the hole of one link against that of the other along and across the coupler. The play of a mesh lets
the arm run ahead or behind by s/r, s along the pitch circle and r that of the wheel.
"""

import math
from collections.abc import Iterator, Sequence

import numpy as np

from mechwright import GeometryError, Output, Tolerances
from mechwright.mechanics.linkage.kinematics.period import course_of
from mechwright.mechanics.linkage.planar_table import AnyPlanarTable
from mechwright.mechanics.linkage.tolerance.contributors import Effect, Fixed, Play, Source
from mechwright.mechanics.linkage.tolerance.model import MachineTolerances
from mechwright.mechanics.linkage.tolerance.outputs import Point
from mechwright.mechanics.planar.free_bodies import GROUND
from mechwright.mechanics.planar.machine import Revolute
from mechwright.mechanics.planar.sensitivity import Change
from mechwright_five_bar.rules.gears import require_gears
from mechwright_five_bar.table import FiveBarTable

POINT = Output("coupler point", "mm", 2)

PINS = {
    "shaft-a0": ("A0", "crank"),
    "pin-a": ("A", "coupler"),
    "pin-c": ("C", "rocker"),
    "shaft-b0": ("B0", "arm"),
    "pin-b1": ("B1", "rocker"),
}
"""Contributor to its joint, and the link whose hole stands off the pin."""


class FiveBarTolerances(MachineTolerances):
    """The model of a design; crank angles count from X, as in the motion."""

    most_positions = 1 << 30
    judges_gears = True

    def __init__(self, table: FiveBarTable, tolerances: Tolerances) -> None:
        self.meshes, wheel = _meshes(table)
        sources = list(_sources(table, tolerances, self.meshes, wheel))
        judged = [Point("coupler", table.params.coupler_point, "P", POINT)]
        super().__init__(table, course_of(table), sources, judged)
        self.input_name = "theta"


def _sources(
    table: FiveBarTable, tolerances: Tolerances, meshes: Sequence[str], wheel: float
) -> Iterator[Source]:
    params = table.params
    for name, changes in _lengths(table).items():
        size = tolerances.length(name, float(getattr(params, name)))
        yield Source(size, (Fixed(Change(changes)),))
    joints = {one.name: one for one in table.machine.joints if isinstance(one, Revolute)}
    for name, (joint, link) in PINS.items():
        member = name in ("pin-a", "pin-c")
        pin = tolerances.pin(name, params.pin_diameter, params.running_fit, member=member, joint=joint)
        ways = (1 + 0j, 1j)[: pin.components]
        yield Source(pin, tuple(Play(link, (joints[joint],), "coupler", way) for way in ways))
    for name in meshes:
        yield Source(tolerances.gap(name, params.backlash, 2), (Fixed(Change(phases={"gears": 1 / wheel})),))
    for name, value, effect in _point(params.coupler_point):
        yield Source(tolerances.length(name, value), (effect,))
    for one in tolerances.input("input"):
        yield Source(one, (Fixed(Change(input=1.0)),))


def _meshes(table: FiveBarTable) -> tuple[tuple[str, ...], float]:
    """The plays of the gears, and the pitch radius of the wheel; none where gears cannot be made."""
    try:
        require_gears(table)
    except GeometryError:  # it moves all the same
        return (), 1.0
    return tuple(f"mesh-{one}-{two}" for one, two in table.train.meshes()), table.train.radius("wheel")


def _lengths(table: AnyPlanarTable) -> dict[str, dict[tuple[str, str], complex]]:
    """Link to the joint at its end that moves with its length."""
    ground = complex(np.exp(1j * math.radians(table.params.ground_angle)))
    return {
        "crank": {("A", "crank"): 1 + 0j},
        "coupler": {("C", "coupler"): 1 + 0j},
        "rocker": {("C", "rocker"): 1 + 0j},
        "arm": {("B1", "arm"): 1 + 0j},
        "ground": {("B0", GROUND): ground},
    }


def _point(place: complex) -> Iterator[tuple[str, float, Effect]]:
    for name, value, way in (("along", place.real, 1 + 0j), ("across", place.imag, 1j)):
        yield f"point-{name}", value, Fixed(Change({("P", "coupler"): way}))
