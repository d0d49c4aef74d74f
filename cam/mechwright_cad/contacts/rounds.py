"""Which round faces a step brings into each other, and how tightly they go."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.details import Thread
from mechwright.contracts.fits import Fit, hole_fit, shaft_fit
from mechwright.contracts.part import Bore, Part
from mechwright.contracts.shape import Revolve, Shape
from mechwright_cad.assembly_order.layers import PARALLEL
from mechwright_cad.bodies import Body

NEAR = 0.05
"""How far apart axes of faces are that go into each other, mm, at most."""

CONTACT = 0.02
"""Faces nearer to each other than this, mm, touch: half the play of a sliding fit, and a stack's rounding."""

ALIKE = 0.3
"""How much wider a hole is than what it fits, mm, at most: more is room, as for a screw."""

_BUSHES = "ISO 2795"
"""Pressed into H7 with r6, which leaves their bores H7."""

_DOWELS = ("ISO 8734", "ISO 2338")


@dataclass(frozen=True)
class Round:
    """A round face: a point of its axis in the assembly, the axis, where along it, its diameter, mm."""

    at: Array
    axis: Array
    low: float
    high: float
    diameter: float
    inside: bool
    fit: Fit | None
    threaded: bool = False

    @property
    def limits(self) -> tuple[float, float]:
        """Least and greatest diameter, mm; both as drawn where no fit is said."""
        if self.fit is None:
            return self.diameter, self.diameter
        return self.fit.size + self.fit.lower, self.fit.size + self.fit.upper

    @property
    def text(self) -> str:
        """As a drawing has it."""
        return f"⌀{self.diameter:g}" if self.fit is None else f"⌀{self.fit.size:g} {self.fit.name}"


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
    def has_fit(self) -> bool:
        """Whether the drawing says how tightly they go."""
        return self.outside.fit is not None or self.inside.fit is not None

    @property
    def text(self) -> str:
        """Both faces, hole first, as fits are written."""
        return f"{self.inside.text} / {self.outside.text.removeprefix('⌀')}"


def rounds_of(body: Body, sample: int) -> list[Round]:
    """The round faces of a plate, or of an upright part, where it stands."""
    turn, place = body.poses.rotation[sample], body.poses.position[sample]
    axis, found = turn[:, 2], []
    for (x, y), low, high, diameter, inside, fit, threaded in _own(body.part):
        at = turn @ np.array((x, y, body.instance.z)) + place
        found.append(Round(at, axis, low, high, diameter, inside, fit, threaded))
    return found


_Own = tuple[tuple[float, float], float, float, float, bool, Fit | None, bool]


def _own(part: Part) -> Iterator[_Own]:
    """Place, heights, diameter, whether it is a hole, fit, whether it has a thread."""
    if part.outline is not None:
        threads = [detail.centre for detail in part.details if isinstance(detail, Thread)]
        for bore in part.features:
            if isinstance(bore, Bore):
                top = part.thickness - bore.top
                yield (
                    bore.centre,
                    top - bore.depth,
                    top,
                    bore.diameter,
                    True,
                    bore.fit,
                    bore.centre in threads,
                )
        return
    shape = getattr(part.build, "__self__", None)
    if not isinstance(shape, Shape):
        return
    turned, bought = part.turned, part.bought
    if turned is not None:
        for low, step in zip(turned.starts, turned.steps, strict=True):
            if step.start is None:
                yield (0.0, 0.0), low, low + step.length, step.diameter, False, step.fit, False
        if turned.bore:
            yield (0.0, 0.0), 0.0, turned.length, turned.bore, True, turned.bore_fit, turned.tapped
        for thread in turned.threads:
            low = 0.0 if thread.end == "lower" else turned.length - thread.depth
            yield (0.0, 0.0), low, low + thread.depth, thread.diameter, True, None, True
        return
    for piece in shape.pieces:
        if isinstance(piece, Revolve):
            radii, heights = zip(*piece.profile, strict=True)
            outer = 2 * max(radii)
            standard = bought.standard if bought is not None else ""
            fit = shaft_fit(outer, "m6") if standard in _DOWELS else None
            inner = None
            if standard == _BUSHES:
                fit, inner = shaft_fit(outer, "r6"), hole_fit(2 * min(radii), "H7")
            yield piece.axis, min(heights), max(heights), outer, False, fit, False
            for diameter, low, high in _bores(piece):
                yield piece.axis, low, high, diameter, True, inner, False


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


def matches(bodies: Sequence[Body], sample: int, moved: Sequence[int], onto: Sequence[int]) -> list[Match]:
    """What goes into each other as ``moved`` bodies come to the others."""
    faces = {k: rounds_of(bodies[k], sample) for k in (*moved, *onto)}
    found = []
    for one in moved:
        for two in onto:
            pairs = [(one, two, a, b) for a in faces[one] for b in faces[two] if not a.inside and b.inside]
            pairs += [(two, one, b, a) for a in faces[one] for b in faces[two] if a.inside and not b.inside]
            fitting = [Match(pin, hole, a, b) for pin, hole, a, b in pairs if _fits(a, b)]
            if fitting:  # the tightest of those that the drawing says tells how the two go together
                found.append(min(fitting, key=lambda match: (not match.has_fit, match.play)))
    return found


def _fits(pin: Round, hole: Round) -> bool:
    if abs(pin.axis @ hole.axis) < 1 - PARALLEL:
        return False
    away = pin.at - hole.at
    along = float(away @ hole.axis)
    if np.linalg.norm(away - along * hole.axis) > NEAR or not -ALIKE < hole.diameter - pin.diameter < ALIKE:
        return False
    sign = 1.0 if pin.axis @ hole.axis > 0 else -1.0
    low, high = sorted((along + sign * pin.low, along + sign * pin.high))
    return min(high, hole.high) - max(low, hole.low) > ALIKE
