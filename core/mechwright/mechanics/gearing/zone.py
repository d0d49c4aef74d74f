"""The part of two outlines that lies near contact.

Glossary
--------
envelope
    The pitch curve, moved outwards along its radii until it holds a gear; two gears touch only where both
    envelopes overlap.
run
    Consecutive edges of an outline, looked at as one: a circle about them tells whether any can be near.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.mechanics.gearing.crossings import Ints
from mechwright.mechanics.gearing.pitch_curve import PitchCurve

Flags = NDArray[np.bool_]

_RUN = 16
"""Edges per run: a quarter of a flank of the finest outlines."""

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
    """

    angle: Array
    radius: Array
    steepness: float

    @classmethod
    def of(cls, points: Array, curve: PitchCurve, margin: float) -> "Envelope":
        """The envelope of an outline (n, 2), mm, wider by a margin, mm."""
        frame = curve.frame(np.linspace(0, math.tau, _SAMPLES, endpoint=False))
        angle, radius = frame.polar_angle, frame.polar_radius
        rise = np.diff(radius, append=radius[0]) / (np.diff(angle, append=angle[0]) % math.tau)
        slope = float((np.abs(rise) / np.minimum(radius, np.roll(radius, -1))).max())
        on_curve = cls(angle, radius, math.hypot(1, slope))
        return cls(
            angle, radius + max(0.0, float(on_curve.height(points).max())) + margin, on_curve.steepness
        )

    def height(self, points: Array) -> Array:
        """Distance (...), mm, of points (..., 2), body frame, from the envelope along their radii."""
        x, y = points[..., 0], points[..., 1]
        height: Array = np.hypot(x, y) - np.interp(np.arctan2(y, x), self.angle, self.radius, period=math.tau)
        return height


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

    def near(self, mate: Envelope, turn: Array, axis: Array) -> tuple[Ints, Array, Array, Flags]:
        """Runs that may reach into the mate's envelope.

        ``turn`` (n,), rad, and ``axis`` (n, 2), mm, place this gear in the mate's body frame in position.

        Returns
        -------
        position
            Of each such run (r,).
        corners, placed
            (r, m, 2), mm, in the body frame and in that of the mate.
        near
            Which of them (r, m) lie in the envelope.
        """
        centres = turned(self.centre, turn[:, None]) + axis[:, None]
        position, run = np.nonzero(mate.height(centres) < mate.steepness * self.reach)
        corners = self.corners[run]
        placed = turned(corners, turn[position][:, None]) + axis[position][:, None]
        return position, corners, placed, mate.height(placed) < 0


@dataclass(frozen=True)
class Near:
    """The points and edges of one gear near contact, seen from the driven gear.

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

    @classmethod
    def of(cls, corners: Array, position: Ints, near: Flags) -> "Near":
        """Choose from runs: corners (r, m, 2), positions (r,), and whether they are near (r, m)."""
        run, at = np.nonzero(near[:, :-1])
        edge, start = np.nonzero(near[:, :-1] | near[:, 1:])
        return cls(
            corners[run, at], position[run], corners[edge, start], corners[edge, start + 1], position[edge]
        )


def turned(points: Array, angle: Array) -> Array:
    """Points (..., 2) turned by angles (...), rad."""
    x, y, cos, sin = points[..., 0], points[..., 1], np.cos(angle), np.sin(angle)
    return np.stack((cos * x - sin * y, sin * x + cos * y), axis=-1)
