"""From a design table to the linkage in space: its loop, its input, the bodies and their pins."""

import math
from dataclasses import dataclass, replace

import numpy as np

from mechwright import Array, DesignError, GeometryError, kept
from mechwright.mechanics.planar import Course, Turning
from mechwright_spherical.fivebar import AdjustableFiveBar
from mechwright_spherical.fourbar import FourBar
from mechwright_spherical.loop import Loop, State
from mechwright_spherical.mobility import input_range
from mechwright_spherical.params import FiveBarTable, FourBarTable, SphericalParams
from mechwright_spherical.projection import project
from mechwright_spherical.vectors import arc, cross, dot, norm, vector


@dataclass(frozen=True)
class Phase:
    """One phase of a linkage: what moves, from where to where.

    Parameters
    ----------
    number
        1 or 2; a four-bar has only 1.
    loop
        The linkage, its input angle counted from the position of adjustment or, for a four-bar, from its
        start.
    reference
        Input angle at which bodies are measured, rad: 0, the adjustment, or a four-bar's start.
    start, travel
        Input angle at which it starts, and how far it goes from there, rad.
    rocks
        Whether the input is a lever that goes back to its start, as it cannot turn fully.
    targets
        Prescribed path points (3, n), unit vectors.
    target_angles
        Input angles (n,) of them, rad.
    """

    number: int
    loop: Loop
    reference: float
    start: float
    travel: float
    targets: Array
    target_angles: Array
    rocks: bool = False

    @property
    def course(self) -> Course:
        """One period of the input."""
        return Course(self.start, self.travel, self.rocks)

    def sweep(self, samples: int) -> Array:
        """Input angles (samples,) once over the whole travel, rad."""
        return self.course.way(samples)

    def state(self, samples: int) -> State:
        """The linkage over the whole travel."""
        return self.loop.at(Turning.of(self.sweep(samples)), 0)

    @property
    def at_reference(self) -> State:
        """The linkage at its reference angle, one sample."""
        return self.loop.at(Turning.of(np.array([self.reference])), 0)

    @property
    def path_errors(self) -> Array:
        """Distances (n,) of the path from its prescribed points, on the unit sphere."""
        return norm(self.loop.position(self.target_angles) - self.targets)


@dataclass(frozen=True)
class Linkage:
    """A linkage in space.

    Parameters
    ----------
    phases
        One for a four-bar, two for an adjustable five-bar.
    shown
        The phase that motion and assembly show.
    five_bar, four_bar
        The one that it is.
    """

    phases: tuple[Phase, ...]
    shown: Phase
    five_bar: AdjustableFiveBar | None = None
    four_bar: FourBar | None = None


@kept
def linkage_of(params: SphericalParams) -> Linkage:
    """The linkage of a design, assembled or not.

    Raises
    ------
    PinError
        A pin has no direction, or two that must differ coincide.
    """
    if params.kind == "four-bar":
        return _four_bar(params.four_bar)
    return _five_bar(params.five_bar)


class PinError(DesignError):
    """A pin or arc that makes no link; ``parameter``, ``value`` and ``limit`` (deg) are for its finding."""

    def __init__(self, parameter: str, message: str, remedy: str, value: float, limit: float) -> None:
        super().__init__(f"{parameter}: {message}; {remedy}")
        self.parameter, self.message, self.remedy = parameter, message, remedy
        self.value, self.limit = value, limit


SHORTEST = math.radians(0.05)
"""Arcs shorter than this, or as near to 180°, are no links: on a sphere of 2 m they are 1.7 mm."""


def _vector(pin: tuple[float, ...], parameter: str) -> Array:
    try:
        return vector(pin)
    except GeometryError as error:
        raise PinError(
            parameter, str(error).split(";")[0], "give a point away from the centre", 0.0, 0.0
        ) from error


def _direction(pin: tuple[float, ...], table: FiveBarTable, name: str) -> Array:
    if len(pin) == 2:
        return project(pin, table.projection_length, centre=table.projection_centre)
    return _vector(pin, f"five_bar.{name}")


def _points(pins: tuple[tuple[float, ...], ...], table: FiveBarTable, name: str) -> Array:
    found = [_direction(pin, table, name) for pin in pins]
    return np.array(found).T.reshape(3, len(found))


_LINKS = (
    ("a0", "b0"), ("a0", "a1"), ("a0", "a1n"), ("b0", "b1"), ("b1", "c1"), ("b1", "c1n"),
    ("a1", "c1"), ("a1n", "c1n"), ("a1", "b1"), ("a1n", "b1"),
)  # fmt: skip
"""Pairs of pins between which there must be an arc: links, and A to B, on which the closed form stands."""


def _five_bar(table: FiveBarTable) -> Linkage:
    names = ("a0", "b0", "b1", "a1", "c1", "a1n", "c1n")
    pins = {name: _direction(getattr(table, name), table, name) for name in names}
    for one, two in _LINKS:
        apart = math.degrees(float(arc(pins[one], pins[two])))
        limit = math.degrees(SHORTEST)
        if not limit <= apart <= 180 - limit:
            raise PinError(
                f"five_bar.{two}",
                f"it is {apart:.3g}° from {one}, and an arc is {limit:.2g}° to {180 - limit:.5g}°",
                f"move {two}, or {one}",
                apart,
                limit if apart < 90 else 180 - limit,
            )
    mechanism = AdjustableFiveBar(**pins, p1=_direction(table.point, table, "point"), ratio=table.ratio)
    if table.common_arcs:
        mechanism = mechanism.equalised()
    phases = tuple(
        Phase(
            number,
            mechanism.phase(number),
            0.0,
            math.radians(getattr(table, f"start{mark}")),
            math.radians(getattr(table, f"travel{mark}")),
            _points(getattr(table, f"path{mark}"), table, f"path{mark}"),
            np.radians(np.array(getattr(table, f"path_angles{mark}"), dtype=float)),
        )
        for number, mark in ((1, ""), (2, "_n"))
    )
    return Linkage(phases, phases[table.phase - 1], five_bar=mechanism)


def _four_bar(table: FourBarTable) -> Linkage:
    for name in ("ground", "input", "coupler", "output"):
        degrees, limit = getattr(table, name), math.degrees(SHORTEST)
        if not limit <= degrees <= 180 - limit:
            raise PinError(
                f"four_bar.{name}",
                f"an arc of {degrees:.3g}° is no link",
                f"use {limit:.2g}° to {180 - limit:.5g}°",
                degrees,
                limit if degrees < 90 else 180 - limit,
            )
    four_bar = FourBar(
        math.radians(table.ground),
        math.radians(table.input),
        math.radians(table.coupler),
        math.radians(table.output),
        float(table.branch),
        math.radians(table.point_azimuth),
        math.radians(table.point_elevation),
    )
    axes = _frame(table)
    own = four_bar.loop()
    turned = {name: axes @ getattr(own, name) for name in ("a0", "a1", "b0", "b1")}
    loop = replace(own, **turned)
    course, zero = _course(table, four_bar)
    found = [_vector(pin, "four_bar.path") for pin in table.path]
    targets = np.array(found).T.reshape(3, len(found))
    phase = Phase(
        1,
        loop,
        zero,
        course.start,
        course.travel,
        targets,
        zero + np.radians(np.array(table.path_angles, dtype=float)),
        course.rocks,
    )
    return Linkage((phase,), phase, four_bar=four_bar)


TURN_BACK = math.radians(1.0)
"""Transmission angle at which a lever turns back before its dead centre: 57 times the torque of the output
would have to come from the input there, and friction blocks it long before."""


def _course(table: FourBarTable, four_bar: FourBar) -> tuple[Course, float]:
    """One period of the input, and the input angle from which path angles count, rad.

    What cannot be assembled is left as the design says it, for the checks to find.
    """
    start = math.radians(table.start or 0.0)
    if table.travel is not None:
        return Course(start, math.radians(table.travel)), start
    ways = input_range(*four_bar.arcs, TURN_BACK)
    if not ways or ways == ((0.0, math.tau),):
        return Course(start, math.tau), start
    if len(ways) == 2 and ways[0][0] == 0.0:  # one way through 0
        ways = ((-ways[0][1], ways[0][1]),)
    for low, high in ways:
        turn = math.tau * math.floor((start - low) / math.tau)
        if table.start is not None and low + turn <= start <= high + turn:
            return Course(low + turn, high - low, rocks=True), start
    if table.start is not None:
        return Course(start, math.tau), start
    low, high = ways[0]
    return Course(low, high - low, rocks=True), low


def _frame(table: FourBarTable) -> Array:
    """The four-bar's own x, y, z in space, as columns."""
    z = _vector(table.input_axis, "four_bar.input_axis")
    towards = _vector(table.output_towards, "four_bar.output_towards")
    apart = float(arc(z, towards))
    if not SHORTEST <= apart <= math.pi - SHORTEST:
        raise PinError(
            "four_bar.output_towards",
            "it is parallel to input_axis, so the output axis has no direction",
            "give another direction",
            math.degrees(apart),
            math.degrees(SHORTEST),
        )
    x = vector(towards - z * float(dot(z, towards)))
    return np.stack([x, cross(z, x), z], axis=1)
