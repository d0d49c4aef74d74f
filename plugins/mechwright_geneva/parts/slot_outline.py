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
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np

from mechwright import TOLERANCES, Arc, Array, Line, Loop, Point, Segment, kept
from mechwright.contracts.design_table import column, number
from mechwright.geometry.fit import fit_curves
from mechwright.geometry.mirror import turned_segment
from mechwright_geneva.kinematics.geometry import LEFT, RIGHT, Points, corner_angle
from mechwright_geneva.kinematics.mechanism import Mechanism

FIT = TOLERANCES.outline / 2
"""Deviation of the fitted walls, mm: half of what an outline may have."""

CAP = 1.0
"""How far outside the rim a cap stands at least, mm: well clear of the rim's own tolerance."""

_QUARTERS = (0.25, 0.75)
"""Shares at which the walls of a smooth law are cut besides mid stroke: one piece rarely fits a half."""

_GRID, _NEWTON = 129, 4
"""Samples of half a stroke that bracket where a wall passes the rim, and steps of Newton's method."""


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
    """The exact contour of slot 0 as it is cut, clearance included; its mouths also of a table."""

    mechanism: Mechanism

    @cached_property
    def cap_angle(self) -> float:
        """|φ| at which the cap stands, rad: beyond θd0."""
        m, away = self.mechanism, self.mechanism.rim + CAP
        square = (m.axes - away) * (m.axes + away)
        # The cap's nearest place to the wheel's axis, from the crank's.
        nearest = min(max(math.sqrt(max(square, 0.0)), m.crank - m.groove), m.crank + m.groove)
        return math.acos((square + nearest**2) / (2 * m.axes * nearest))

    def lead_angle(self, side: int) -> Any:
        """|φ| at which the lead of a wall passes the rim, rad; θd0 if the wall does so within the stroke."""
        m = self.mechanism
        return number(np.fmax(corner_angle(m.axes, m.crank + side * m.groove, m.rim), m.crank_half))

    def mouth(self, side: int, end: int) -> Array:
        """The share (n, 1) of the stroke at which a wall passes the rim next to an end; the end of a lead."""
        m = self.mechanism
        found = np.full((m.size, 1), float(end))
        rows = np.flatnonzero(column(self.lead_angle(side) <= m.crank_half, m.size))
        if not rows.size:
            return found
        m = m.rows(rows)
        grid = np.abs(end - np.linspace(0, 0.5, _GRID))
        inside = np.atleast_2d(np.abs(m.stroke(grid).wall(m.groove, side)) <= m.rim)
        place = np.maximum(np.argmax(inside, axis=1), 1)[:, None]
        bracket = grid[place - 1], grid[place]
        u = bracket[1]
        for _ in range(_NEWTON):
            run = m.stroke(u)
            wall = run.wall(m.groove, side)
            rate = (np.conj(wall) * run.velocity * run.to_wheel).real * run.regularity(m.groove, side)
            u = u - (np.abs(wall) ** 2 - m.rim**2) / (4 * m.crank_half * rate)
            u = np.clip(u, np.minimum(*bracket), np.maximum(*bracket))
        found[rows] = u
        return found

    def wall(self, side: int, *, trimmed: bool) -> Wall:
        """The left or right wall: up to the caps, or trimmed at the rim."""
        m = self.mechanism
        if m.straight:
            return self._straight(side, trimmed)
        first, last = 0.0, 1.0
        if trimmed:
            first = self.mouth(side, 0).item()
            last = 1 - first if m.law.symmetric else self.mouth(side, 1).item()
        chains, deviation = _fitted(m, first, last)
        lead_in, lead_out = (self._lead(side, trimmed, end) for end in (0, 1))
        segments: list[Segment] = [*lead_in, *chains[0 if side == LEFT else 1], *lead_out]
        return Wall(tuple(_joined(segments)), deviation)

    def exact(self, side: int, u: Array) -> Points:
        """Points of the exact wall at shares u of the stroke."""
        return self.mechanism.stroke(u).wall(self.mechanism.groove, side)

    def _lead(self, side: int, trimmed: bool, end: int) -> list[Segment]:
        """The wall's arc before (end 0) or after (end 1) the stroke; none if the rim is inside the stroke."""
        m = self.mechanism
        radius, phi = m.crank + side * m.groove, self.lead_angle(side) if trimmed else self.cap_angle
        centre, sweep = cmath.rect(m.axes, -2 * m.wheel_half * end), m.crank_half - phi
        if abs(sweep) * radius < TOLERANCES.closure:
            return []
        # The wall is at a - R exp(iφ), so its direction from the centre is π + φ.
        start = math.pi - 2 * m.wheel_half * end + (phi if end == 0 else -m.crank_half)
        return [Arc(_point(centre), radius, start, sweep, "lead")]

    @property
    def reach(self) -> Any:
        """How far from the wheel's axis the walls of a straight slot pass the rim, along the slot, mm."""
        return number(np.sqrt(self.mechanism.rim**2 - self.mechanism.groove**2))

    def _straight(self, side: int, trimmed: bool) -> Wall:
        """A line in, and the left wall with the round bottom; walls of a straight slot meet at its bottom.

        The left wall is the way in on the left, the right wall likewise on the right; the arc of the bottom
        belongs to the left one.
        """
        m, r = self.mechanism, self.mechanism.groove
        axis = cmath.exp(-1j * m.wheel_half)
        reach = self.reach if trimmed else m.rim + CAP
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
        back = backwards(right.segments)
        caps: tuple[Segment, ...] = (Line(left.end, right.end, "cap"), Line(right.start, left.start, "cap"))
        if self.mechanism.straight:
            # The left wall already ends at the bottom's other side, where the right one begins backwards.
            loop = Loop(tuple(_joined([*left.segments, *back, caps[1]])))
        else:
            loop = Loop((*left.segments, caps[0], *back, caps[1]))
        return (loop if loop.area > 0 else loop.reversed()), max(left.deviation, right.deviation)


@kept
def _fitted(mechanism: Mechanism, first: float, last: float) -> tuple[list[list[Segment]], float]:
    """Both walls between two shares of the stroke, fitted together, cut where the jerk jumps; deviation.

    The way out of a symmetric law is the way in, mirrored about the slot's axis.
    """
    law = mechanism.law
    cuts = {0.5, *(law.breaks or _QUARTERS)}
    ends = [first, *sorted(u for u in cuts if first < u < last and not (law.symmetric and u > 0.5))]
    if not law.symmetric:
        ends.append(last)
    chains: list[list[Segment]] = [[], []]
    deviation = 0.0
    for a, b in pairwise(ends):

        def curves(t: Array, a: float = a, b: float = b) -> Array:
            run = mechanism.stroke((1 - t) * a + t * b)
            walls = np.stack((run.wall(mechanism.groove, LEFT), run.wall(mechanism.groove, RIGHT)))
            return np.stack((walls.real, walls.imag), axis=-1)

        found, error = fit_curves(curves, 2, FIT, "wall")
        for chain, more in zip(chains, found, strict=True):
            chain.extend(more)
        deviation = max(deviation, error)
    if law.symmetric:
        for chain in chains:
            chain.extend(mirrored(chain, -mechanism.wheel_half))
    return chains, deviation


def _joined(segments: list[Segment]) -> list[Segment]:
    """The segments as they are; they meet to rounding, which is far below the closure tolerance."""
    return [segment for segment in segments if segment.start != segment.end]


def backwards(segments: Sequence[Segment]) -> list[Segment]:
    """A chain of segments run the other way."""
    return [segment.reversed() for segment in segments[::-1]]


def mirrored(segments: Sequence[Segment], angle: float) -> list[Segment]:
    """A chain reflected in the line through the origin at ``angle``, rad, and run the other way."""
    return [turned_segment(one, "x").moved(0, 0, 2 * angle) for one in backwards(segments)]


def _point(z: complex) -> Point:
    return z.real, z.imag
