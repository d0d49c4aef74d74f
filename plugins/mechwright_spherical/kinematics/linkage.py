"""From a design table to the linkage in space: its loop, its input, the bodies and their pins."""

import math
from dataclasses import dataclass, replace

import numpy as np

from mechwright import Array, DesignError, Finding, GeometryError, kept
from mechwright.mechanics.planar import Course, Turning
from mechwright.mechanics.planar.swing import TURN_BACK
from mechwright_spherical.kinematics.five_bar import AdjustableFiveBar
from mechwright_spherical.kinematics.four_bar import FourBar
from mechwright_spherical.kinematics.loop import Loop, State
from mechwright_spherical.kinematics.mobility import input_ways
from mechwright_spherical.kinematics.projection import project
from mechwright_spherical.kinematics.vectors import arc, cross, dot, norm, rotate, vector
from mechwright_spherical.parameters import FiveBarTable, FourBarPhase, FourBarTable, SphericalParams


@dataclass(frozen=True)
class Phase:
    """One phase of a linkage: what moves, from where to where.

    Parameters
    ----------
    number
        From 1 on.
    loop
        The linkage, its input angle counted from the position of adjustment or, for a four-bar, from its
        start.
    reference
        Input angle in the pose of setting, at which bodies are measured, rad; the start where nothing is
        set.
    start, travel
        Input angle at which it starts, and how far it goes from there, rad.
    targets
        Prescribed path points (3, n), unit vectors.
    target_angles
        Input angles (n,) of them, rad.
    rocks
        Whether the input is a lever that goes back to its start, as it cannot turn fully.
    four_bar
        The four-bar that it is, if it is one.
    """

    number: int
    loop: Loop
    reference: float
    start: float
    travel: float
    targets: Array
    target_angles: Array
    rocks: bool = False
    four_bar: FourBar | None = None

    @property
    def mark(self) -> str:
        """What names of its figures and of its own parts end on: nothing for phase 1."""
        return {1: "", 2: "n"}.get(self.number, str(self.number))

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
        One or more of a four-bar, two or more of an adjustable five-bar.
    shown
        The phase that motion and assembly show.
    five_bar
        Its first two phases, if it is one.
    """

    phases: tuple[Phase, ...]
    shown: Phase
    five_bar: AdjustableFiveBar | None = None

    @property
    def four_bar(self) -> FourBar | None:
        """The four-bar of the phase that is shown, if it is one."""
        return self.shown.four_bar


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
    """A pin or arc that makes no link, and its finding; value and limit are degrees."""

    def __init__(self, parameter: str, message: str, remedy: str, value: float, limit: float) -> None:
        super().__init__(f"{parameter}: {message}; {remedy}")
        self.finding = Finding.error("spherical.pins", parameter, message, value, limit, "deg", remedy)


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
    phases = [
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
    ]
    for number, row in enumerate(table.phases, start=3):
        a = rotate(mechanism.a0, math.radians(row.crank_turn), mechanism.a1)
        c = rotate(mechanism.b1, math.radians(row.rocker_turn), mechanism.c1)
        start, travel = _or(row.start, table.start), _or(row.travel, table.travel)
        phases.append(
            Phase(
                number,
                Loop.of_pins(mechanism.a0, a, mechanism.b0, mechanism.b1, c, mechanism.p1, mechanism.ratio),
                0.0,
                math.radians(start or 0.0),
                math.radians(travel or 0.0),
                _points(row.path, table, f"phases[{number - 3}].path"),
                np.radians(np.array(row.path_angles, dtype=float)),
            )
        )
    return Linkage(tuple(phases), phases[table.phase - 1], five_bar=mechanism)


def _or(own: float | None, other: float | None) -> float | None:
    """What a phase says, or what phase 1 does."""
    return other if own is None else own


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
    rows: list[tuple[FourBarTable | FourBarPhase, FourBar, float]] = [
        (table, four_bar, math.radians(table.setting_angle or 0.0))
    ]
    for row in table.phases:
        own = four_bar.set_to(rows[0][2], math.radians(row.crank_turn), math.radians(row.follower_turn))
        rows.append((row, own, rows[0][2] + math.radians(row.crank_turn)))
    phases = []
    for number, (said, bar, pose) in enumerate(rows, start=1):
        start, travel = _or(said.start, table.start), _or(said.travel, table.travel)
        course, zero = _course(start, travel, bar)
        found = [_vector(pin, "four_bar.path") for pin in said.path]
        loop = bar.loop()
        turned = {name: axes @ getattr(loop, name) for name in ("a0", "a1", "b0", "b1")}
        phases.append(
            Phase(
                number,
                replace(loop, **turned),
                pose if table.phases else zero,
                course.start,
                course.travel,
                np.array(found).T.reshape(3, len(found)),
                zero + np.radians(np.array(said.path_angles, dtype=float)),
                course.rocks,
                bar,
            )
        )
    return Linkage(tuple(phases), phases[table.phase - 1])


def _course(said: float | None, travel: float | None, four_bar: FourBar) -> tuple[Course, float]:
    """One period of the input, and the input angle from which path angles count, rad.

    Start and travel are as a design says them, degrees. What cannot be assembled is left as it is said, for
    the checks to find.
    """
    start = math.radians(said or 0.0)
    if travel is not None:
        return Course(start, math.radians(travel)), start
    ways = input_ways(*four_bar.arcs, TURN_BACK)
    if not ways or ways == [(0.0, math.tau)]:
        return Course(start, math.tau), start
    for low, high in ways:
        turn = math.tau * math.floor((start - low) / math.tau)
        if said is not None and low + turn <= start <= high + turn:
            return Course(low + turn, high - low, rocks=True), start
    if said is not None:
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
