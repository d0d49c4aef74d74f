"""The round faces of an assembly, which of them go into each other, and how tightly.

Glossary
--------
face
    Name of a round face in its part: a bore's own name, ``"bore"`` of a turned part's hole through,
    ``"step-2"`` of its second step, ``"thread-lower"`` of a thread in an end, ``"outside"`` and ``"inside"``
    of a bought part.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.bodies import Placed
from mechwright.contracts.details import Thread
from mechwright.contracts.fits import EXACT, Fit
from mechwright.contracts.joint import Vector
from mechwright.contracts.part import Bore, Part
from mechwright.contracts.shape import Revolve, Shape
from mechwright.contracts.turned import Turned

PARALLEL = 1e-9
"""By how much less than 1 the product of two unit vectors is that are parallel."""

UPRIGHT: Vector = (0.0, 0.0, 1.0)
"""Axis of the faces of plates, turned and bought parts in their own coordinates."""

NEAR = 0.05
"""How far apart axes of faces are that go into each other, mm, at most."""

CONTACT = 0.02
"""Faces nearer to each other than this, mm, touch: half the play of a sliding fit, and a stack's rounding."""

TIGHT = 0.1
"""How much narrower a hole is drawn than its pin, mm, at most: a circlip in its groove is narrower, and no
hole."""

ROOM = 0.1
"""A hole without a fit that is wider than its pin by this and more, mm, is room for it."""

ALIKE = 0.3
"""How much wider a hole is than what it fits, mm, at most: more is room, as for a screw."""


@dataclass(frozen=True)
class Face:
    """A round face of a part in the part's own coordinates, mm.

    ``low`` and ``high`` are measured from its point ``centre`` along its axis, the unit vector ``direction``.
    """

    face: str
    centre: Vector
    low: float
    high: float
    diameter: float
    inside: bool
    fit: Fit | None
    threaded: bool
    direction: Vector = UPRIGHT


@dataclass(frozen=True, kw_only=True)
class Round(Face):
    """The same where it stands: a point of its axis in the assembly, and the axis."""

    at: Array
    axis: Array

    @property
    def limits(self) -> tuple[float, float]:
        """Least and greatest diameter, mm; both as drawn where no fit is said."""
        return (self.diameter, self.diameter) if self.fit is None else self.fit.limits

    @property
    def text(self) -> str:
        """As a drawing has it."""
        return f"⌀{self.diameter:g}" if self.fit is None else f"⌀{self.fit.short}"


@dataclass(frozen=True)
class Match:
    """A pin and the hole that it goes into, each with the number of its body."""

    pin: int
    hole: int
    outside: Round
    inside: Round

    @property
    def play(self) -> tuple[float, float]:
        """Least and greatest play, mm; below 0 the pin is wider than the hole."""
        (d0, d1), (h0, h1) = self.outside.limits, self.inside.limits
        return h0 - d1, h1 - d0

    @property
    def overlap(self) -> float:
        """How far the pin is in the hole, mm."""
        along = float((self.outside.at - self.inside.at) @ self.inside.axis)
        sign = 1.0 if self.outside.axis @ self.inside.axis > 0 else -1.0
        low, high = sorted((along + sign * self.outside.low, along + sign * self.outside.high))
        return min(high, self.inside.high) - max(low, self.inside.low)

    @property
    def missing_fits(self) -> int:
        """Of how many of both faces the drawing gives no limits."""
        return (self.outside.fit is None) + (self.inside.fit is None)

    @property
    def text(self) -> str:
        """Both faces, hole first, as fits are written."""
        return f"{self.inside.text} / {self.outside.text.removeprefix('⌀')}"


def rounds_of(body: Placed, sample: int) -> list[Round]:
    """The round faces of a plate, of an upright part, or of one of free form, where it stands."""
    turn, place = body.poses.rotation[sample], body.poses.position[sample]
    lift = body.instance.z * turn[:, 2]
    found = []
    for own in faces_of(body.part):
        at, axis = turn @ np.array(own.centre) + lift + place, turn @ np.array(own.direction)
        found.append(Round(**vars(own), at=at, axis=axis))
    return found


def faces_of(part: Part) -> Iterator[Face]:
    """The round faces of a plate, of a turned part, of a bought one, or of one of free form."""
    if part.free_form is not None:
        for hole in part.free_form.bores:
            yield Face(
                hole.name, hole.start, 0.0, hole.length, hole.diameter, True, hole.fit, False, hole.axis
            )
        return
    if part.outline is not None:
        threads = [detail.centre for detail in part.details if isinstance(detail, Thread)]
        for bore in part.features:
            if isinstance(bore, Bore):
                top = part.thickness - bore.top
                low, threaded = top - bore.depth, bore.centre in threads
                yield Face(bore.name, (*bore.centre, 0.0), low, top, bore.diameter, True, bore.fit, threaded)
        return
    shape = part.build
    if not isinstance(shape, Shape):
        return
    if part.turned is not None:
        yield from _turned(part.turned)
        return
    fits = () if part.bought is None else part.bought.fits
    for piece in shape.pieces:
        if isinstance(piece, Revolve):
            radii, heights = zip(*piece.profile, strict=True)
            outer = 2 * max(radii)
            yield Face(
                "outside",
                (*piece.axis, 0.0),
                min(heights),
                max(heights),
                outer,
                False,
                _of_size(outer, fits),
                False,
            )
            for diameter, low, high in _bores(piece):
                yield Face(
                    "inside", (*piece.axis, 0.0), low, high, diameter, True, _of_size(diameter, fits), False
                )


def _of_size(diameter: float, fits: Sequence[Fit]) -> Fit | None:
    """The limits of the face of this diameter."""
    return next((fit for fit in fits if abs(fit.size - diameter) < EXACT), None)


def _turned(turned: Turned) -> Iterator[Face]:
    axis = (0.0, 0.0, 0.0)
    for number, (low, step) in enumerate(zip(turned.starts, turned.steps, strict=True), start=1):
        if step.start is None:
            yield Face(f"step-{number}", axis, low, low + step.length, step.diameter, False, step.fit, False)
    if turned.bore:
        yield Face("bore", axis, 0.0, turned.length, turned.bore, True, turned.bore_fit, turned.tapped)
    for thread in turned.threads:
        low = 0.0 if thread.end == "lower" else turned.length - thread.depth
        yield Face(f"thread-{thread.end}", axis, low, low + thread.depth, thread.diameter, True, None, True)


def _bores(piece: Revolve) -> Iterator[tuple[float, float, float]]:
    """Diameters and heights of the bores of a ring whose bore has steps; none of a full one."""
    corners = piece.profile
    if min(r for r, _ in corners) <= 0:
        return
    edges = list(zip(corners, (*corners[1:], corners[0]), strict=True))
    turn = math.copysign(1.0, sum(r0 * z1 - r1 * z0 for (r0, z0), (r1, z1) in edges))
    for (r0, z0), (r1, z1) in edges:
        if r0 == r1 and (z1 - z0) * turn < 0:
            yield 2 * r0, min(z0, z1), max(z0, z1)


def matches(bodies: Sequence[Placed], sample: int, moved: Sequence[int], onto: Sequence[int]) -> list[Match]:
    """What goes into each other as ``moved`` bodies come to the others."""
    faces = {k: rounds_of(bodies[k], sample) for k in (*moved, *onto)}
    found = []
    for one in moved:
        for two in onto:
            pairs = [(one, two, a, b) for a in faces[one] for b in faces[two] if not a.inside and b.inside]
            pairs += [(two, one, b, a) for a in faces[one] for b in faces[two] if a.inside and not b.inside]
            fitting = [Match(pin, hole, a, b) for pin, hole, a, b in pairs if _fits(a, b)]
            if fitting:  # the tightest of those that the drawing says tells how the two go together
                found.append(min(fitting, key=lambda match: (match.missing_fits, match.play)))
    return found


def _fits(pin: Round, hole: Round) -> bool:
    if abs(pin.axis @ hole.axis) < 1 - PARALLEL:
        return False
    away = pin.at - hole.at
    along = float(away @ hole.axis)
    if np.linalg.norm(away - along * hole.axis) > NEAR or not -TIGHT < hole.diameter - pin.diameter < ALIKE:
        return False
    sign = 1.0 if pin.axis @ hole.axis > 0 else -1.0
    low, high = sorted((along + sign * pin.low, along + sign * pin.high))
    return min(high, hole.high) - max(low, hole.low) > ALIKE
