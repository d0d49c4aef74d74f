"""The contour of one slot: its walls as chains of segments.

Glossary
--------
way
    The roller's way over the wheel: in from outside, through the stroke, out again.
lead
    What of the way lies before or after the stroke: the wheel stands still, so it is an arc about the crank's
    axis, and so are the walls.
cap
    The line that closes a slot outside the wheel.
mouth
    Where a wall passes the rim.

All in the wheel's frame, the slot's axis at -θw0.
"""

import cmath
import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

from mechwright import TOLERANCES, Arc, Array, GeometryError, Line, Loop, Point, Segment, kept
from mechwright.geometry.fit import fit_curves
from mechwright_geneva.kinematics.geometry import LEFT, RIGHT, Points
from mechwright_geneva.kinematics.mechanism import Mechanism
from mechwright_geneva.parts.mirror import mirrored

FIT = TOLERANCES.outline / 2
"""Deviation of the fitted walls, mm: half of what an outline may have."""

CAP = 1.0
"""How far outside the rim a cap stands at least, mm: well clear of the rim's own tolerance."""

_QUARTERS = (0.25, 0.75)
"""Shares at which the walls of a smooth law are cut besides mid stroke: one piece rarely fits a half."""

_SAME = 1e-12
"""Shares of the stroke that differ by rounding."""

_BISECTIONS = 60
"""Halvings of a bracket of order 1: to the last bit."""


@dataclass(frozen=True)
class Wall:
    """One wall of a slot from the mouth where the roller enters to the one where it leaves.

    Parameters
    ----------
    segments
        In the direction of the roller's way.
    deviation
        Largest distance from the exact wall, mm.
    """

    segments: tuple[Segment, ...]
    deviation: float

    @property
    def start(self) -> Point:
        """First point."""
        return self.segments[0].start

    @property
    def end(self) -> Point:
        """Last point."""
        return self.segments[-1].end


@dataclass(frozen=True)
class Slot:
    """The exact contour of slot 0 of a mechanism, for a roller of ``radius``."""

    mechanism: Mechanism
    radius: float

    @cached_property
    def lead(self) -> float:
        """|φ| at which the cap stands, rad: beyond θd0."""
        wanted = self.mechanism.rim + CAP

        def gap(phi: float) -> float:
            return self._nearest(phi) - wanted

        return _bisect(gap, self.mechanism.crank_half, math.pi)

    def _nearest(self, phi: float) -> float:
        """Distance of the cap at φ from the wheel's axis."""
        m = self.mechanism
        foot = min(max(m.axes * math.cos(phi), m.crank - self.radius), m.crank + self.radius)
        return abs(m.axes - foot * cmath.exp(1j * phi))

    def wall(self, side: int, *, trimmed: bool) -> Wall:
        """The left or right wall: up to the caps, or trimmed at the rim."""
        if self.mechanism.straight:
            return self._straight(side, trimmed)
        lead_in = self._lead(side, trimmed, 0)
        lead_out = self._lead(side, trimmed, 1)
        first = 0.0 if lead_in else self._mouth(side, 0)
        last = 1.0 if lead_out else self._mouth(side, 1)
        chains, deviation = _fitted(self.mechanism, self.radius, first, last)
        chain = chains[0 if side == LEFT else 1]
        segments: list[Segment] = [*lead_in, *chain, *lead_out]
        return Wall(tuple(_joined(segments)), deviation)

    def exact(self, side: int, u: Array) -> Points:
        """Points of the exact wall at shares u of the stroke."""
        return self.mechanism.stroke(u).wall(self.radius, side)

    def _lead(self, side: int, trimmed: bool, end: int) -> list[Segment]:
        """The wall's arc before (end 0) or after (end 1) the stroke; none if the rim is inside the stroke."""
        m = self.mechanism
        radius = m.crank + side * self.radius
        if radius <= 0:
            raise GeometryError(f"the crank of {m.crank:.3f} mm is not larger than the roller")
        phi = self.lead
        if trimmed:
            if abs(self.exact(side, np.array([float(end)]))[0]) >= m.rim:
                return []
            # On the circle about the crank's axis the rim is where the cosine law puts it.
            cosine = (m.axes**2 + radius**2 - m.rim**2) / (2 * m.axes * radius)
            phi = math.acos(min(1.0, max(-1.0, cosine)))
        centre = cmath.rect(m.axes, -2 * m.wheel_half * end)
        # The wall is at a - R exp(iφ), so its direction from the centre is π + φ.
        turn = math.pi - 2 * m.wheel_half * end
        start, sweep = (
            (turn + phi, m.crank_half - phi) if end == 0 else (turn - m.crank_half, m.crank_half - phi)
        )
        if abs(sweep) * radius < TOLERANCES.closure:
            return []
        return [Arc(_point(centre), radius, start, sweep, "lead")]

    def _mouth(self, side: int, end: int) -> float:
        """The share u at which a wall passes the rim inside the stroke, next to this end of it."""

        def outside(u: float) -> float:
            return float(abs(self.exact(side, np.array([u]))[0])) - self.mechanism.rim

        grid = np.linspace(0, 0.5, 129) if end == 0 else np.linspace(1, 0.5, 129)
        away = np.abs(self.exact(side, grid)) - self.mechanism.rim
        inside = np.flatnonzero(away <= 0)
        if not inside.size:
            raise GeometryError("a wall of the slot does not reach into the wheel")
        if inside[0] == 0:
            return float(grid[0])
        return _bisect(lambda u: -outside(u), float(grid[inside[0] - 1]), float(grid[inside[0]]))

    def _straight(self, side: int, trimmed: bool) -> Wall:
        """A line in, and the left wall with the round bottom; walls of a straight slot meet at its bottom.

        The left wall is the way in on the left, the right wall likewise on the right; the arc of the bottom
        belongs to the left one.
        """
        m, r = self.mechanism, self.radius
        axis = cmath.exp(-1j * m.wheel_half)
        reach = math.sqrt(m.rim**2 - r**2) if trimmed else m.rim + CAP
        # Inwards along the axis, left is +i times the direction -1.
        inner, outer = complex(m.bottom, -side * r) * axis, complex(reach, -side * r) * axis
        line: Segment = Line(_point(outer), _point(inner), "slot")
        if side == RIGHT:
            return Wall((line,), 0.0)
        # Round the bottom from the left side to the right one: through the point nearest to the axis.
        start = cmath.phase(-1j * axis)
        bottom = Arc(_point(m.bottom * axis), r, start, -math.pi, "slot")
        return Wall(tuple(_joined([line, bottom])), 0.0)

    def loop(self) -> tuple[Loop, float]:
        """The whole slot up to its caps, counter-clockwise, and its deviation."""
        left, right = (self.wall(side, trimmed=False) for side in (LEFT, RIGHT))
        back = [segment.reversed() for segment in right.segments[::-1]]
        caps: tuple[Segment, ...] = (Line(left.end, right.end, "cap"), Line(right.start, left.start, "cap"))
        if self.mechanism.straight:
            # The left wall already ends at the bottom's other side, where the right one begins backwards.
            loop = Loop(tuple(_joined([*left.segments, *back, caps[1]])))
        else:
            loop = Loop((*left.segments, caps[0], *back, caps[1]))
        return (loop if loop.area > 0 else loop.reversed()), max(left.deviation, right.deviation)


@kept
def _fitted(
    mechanism: Mechanism, radius: float, first: float, last: float
) -> tuple[list[list[Segment]], float]:
    """Both walls between two shares of the stroke, fitted together, cut where the jerk jumps; deviation.

    The way out of a symmetric law is the way in, mirrored about the slot's axis.
    """
    law = mechanism.law
    halved = law.symmetric and abs(first + last - 1) < _SAME
    cuts = {0.5, *(law.breaks or _QUARTERS)}
    ends = [first, *sorted(u for u in cuts if first < u < last and not (halved and u > 0.5))]
    if not halved:
        ends.append(last)
    chains: list[list[Segment]] = [[], []]
    deviation = 0.0
    for a, b in pairwise(ends):

        def curves(t: Array, a: float = a, b: float = b) -> Array:
            run = mechanism.stroke((1 - t) * a + t * b)
            walls = np.stack((run.wall(radius, LEFT), run.wall(radius, RIGHT)))
            return np.stack((walls.real, walls.imag), axis=-1)

        found, error = fit_curves(curves, 2, FIT, "wall")
        for chain, more in zip(chains, found, strict=True):
            chain.extend(more)
        deviation = max(deviation, error)
    if halved:
        for chain in chains:
            chain.extend([mirrored(segment, -mechanism.wheel_half) for segment in chain[::-1]])
    return chains, deviation


def _joined(segments: list[Segment]) -> list[Segment]:
    """The segments as they are; they meet to rounding, which is far below the closure tolerance."""
    return [segment for segment in segments if segment.start != segment.end]


def _point(z: complex) -> Point:
    return z.real, z.imag


def _bisect(function: Callable[[float], float], low: float, high: float) -> float:
    """The place between ``low`` (negative) and ``high`` (positive) where a function passes 0."""
    for _ in range(_BISECTIONS):
        middle = (low + high) / 2
        if function(middle) < 0:
            low = middle
        else:
            high = middle
    return (low + high) / 2
