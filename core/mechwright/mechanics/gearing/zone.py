"""The part of two outlines that lies near contact.

Glossary
--------
envelope
    The pitch curve, moved along its radii, outwards or of a ring inwards, until it holds the body; two gears
    touch only where both envelopes overlap.
run
    Consecutive edges of an outline, looked at as one: a circle about them tells whether any can be near.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.gearing.candidates import Ints
from mechwright.mechanics.gearing.pitch_curve import PitchCurve

_RUN = 32
"""Edges per run: half a flank of a fine outline."""

_SAMPLES = 1024
"""Corners of an envelope: it is the chords between them, so that none of what follows is approximate."""


@dataclass(frozen=True)
class Envelope:
    """Polar form of an envelope, straight between its samples.

    Parameters
    ----------
    angle, radius
        Samples (m,), rad in the body frame and mm.
    steepness
        Greatest rise of :meth:`height` over the way of a point outside, 1 or more.
    side
        1 where the body lies within the envelope, -1 where it is a ring about it.
    """

    angle: Array
    radius: Array
    steepness: float
    side: int = 1

    @classmethod
    def of(cls, points: Array, curve: PitchCurve, margin: float, side: int = 1) -> "Envelope":
        """The envelope of an outline (n, 2), mm, that holds a margin, mm, more than its body."""
        frame = curve.frame(curve.around(_SAMPLES))
        angle, radius = frame.polar_angle, frame.polar_radius
        rise = np.diff(radius, append=radius[0]) / (np.diff(angle, append=angle[0]) % math.tau)
        slope = float((np.abs(rise) / np.minimum(radius, np.roll(radius, -1))).max())
        on_curve = cls(angle, radius, math.hypot(1, slope), side)
        more = max(0.0, float(on_curve.height(points).max())) + margin
        return cls(angle, radius + side * more, on_curve.steepness, side)

    def height(self, points: Array) -> Array:
        """Distance (...), mm, of points (..., 2), body frame, out of the envelope along their radii."""
        x, y = points[..., 0], points[..., 1]
        angle = np.arctan2(y, x)
        height: Array = np.hypot(x, y) - np.interp(angle + math.tau * (angle < 0), *self._round)
        return height if self.side > 0 else -height

    @cached_property
    def _round(self) -> tuple[Array, Array]:
        """The samples from 0 to 2π, with the last one before and the first one behind them."""
        angle = self.angle % math.tau
        order = np.argsort(angle)
        angle, radius = angle[order], self.radius[order]
        return (
            np.concatenate((angle[-1:] - math.tau, angle, angle[:1] + math.tau)),
            np.concatenate((radius[-1:], radius, radius[:1])),
        )


@dataclass(frozen=True)
class Near:
    """The points and edges of one gear near contact.

    Parameters
    ----------
    points, position
        (n, 2), mm, and the position (n,) each belongs to.
    starts, ends, edge_position
        The edges with an end among the points: (m, 2) mm, and (m,).
    """

    points: Array
    position: Ints
    starts: Array
    ends: Array
    edge_position: Ints


@dataclass(frozen=True)
class Rim:
    """An outline in runs.

    Parameters
    ----------
    corners
        (k, m, 2), mm, body frame, counter-clockwise; the last of a run is the first of the next.
    centre, reach
        Circles (k, 2) and (k,), mm, about the runs.
    """

    corners: Array
    centre: Array
    reach: Array

    @classmethod
    def of(cls, points: Array) -> "Rim":
        """Prepare an outline (n, 2); its last run goes on into the first where the edges do not come out."""
        first = np.arange(0, len(points), _RUN)
        corners = points[(first[:, None] + np.arange(_RUN + 1)) % len(points)]
        centre = corners.mean(axis=1)
        return cls(corners, centre, np.linalg.norm(corners - centre[:, None], axis=2).max(axis=1))

    def near(self, mate: Envelope, turn: Array, axis: Array, *, placed: bool) -> Near:
        """What lies in the mate's envelope in some positions.

        ``turn`` (n,), rad, and ``axis`` (n, 2), mm, place this gear in the mate's body frame. Points and
        edges are given in that frame, or, not ``placed``, in the gear's own.
        """
        centres = turned(self.centre, turn[:, None]) + axis[:, None]
        position, run = np.nonzero(mate.height(centres) < mate.steepness * self.reach)
        own = self.corners[run]
        there = turned(own, turn[position][:, None]) + axis[position][:, None]
        inside, corners = mate.height(there) < 0, (there if placed else own).reshape(-1, 2)
        # The last corner of a run is no point of it and begins no edge: the next run has it.
        begins = np.zeros(inside.shape, dtype=np.bool_)
        begins[:, :-1] = inside[:, :-1]
        point = np.flatnonzero(begins)
        begins[:, :-1] |= inside[:, 1:]
        edge = np.flatnonzero(begins)
        starts, ends = corners.take(edge, axis=0), corners.take(edge + 1, axis=0)
        of = np.repeat(position, _RUN + 1)
        return Near(corners.take(point, axis=0), of[point], starts, ends, of[edge])


def turned(points: Array, angle: Array) -> Array:
    """Points (..., 2) turned by angles (...), rad."""
    x, y, cos, sin = points[..., 0], points[..., 1], np.cos(angle), np.sin(angle)
    return np.stack((cos * x - sin * y, sin * x + cos * y), axis=-1)
