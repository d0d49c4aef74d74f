"""The spherical four-bar in its own coordinates.

The input axis is o = (0, 0, 1), the output axis c = (sin α1, 0, cos α1). With the arcs α1 ground (o to c), α2
input (o to a), α3 coupler (a to b), α4 output (c to b), the input angle θ is 0 where a lies on the arc oc,
and the output angle ψ is 0 where b lies on the prolongation of oc beyond c. Closure a.b = cos α3 reads::

    A cos ψ + B sin ψ + C = 0,   ψ = atan2(B, A) + σ acos(-C/√(A² + B²))

The sign σ of c.(a x b) stays the same on a branch.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from mechwright import Array
from mechwright.mechanics.planar import Turning
from mechwright_spherical.kinematics.chain import EDGE
from mechwright_spherical.kinematics.loop import Loop, State
from mechwright_spherical.kinematics.vectors import arc, column, cross, dot, norm, rotate

POLE = np.array([0.0, 0.0, 1.0])
"""The input axis o."""


@dataclass(frozen=True, slots=True)
class FourBar:
    """Arcs in rad, each above 0 and below π; fields are floats, or (designs, 1) arrays for many at once.

    Parameters
    ----------
    ground, input, coupler, output
        The arcs α1 to α4.
    side
        +1 or -1: the sign σ of c.(a x b).
    point_azimuth, point_elevation
        Path point: κ from a along the coupler's arc towards b, then η up to the left,
        p = cos η (cos κ a + sin κ m x a) + sin η m with m = a x b / sin α3.
    """

    ground: Array | float
    input: Array | float
    coupler: Array | float
    output: Array | float
    side: Array | float = 1.0
    point_azimuth: Array | float = 0.0
    point_elevation: Array | float = 0.0

    @property
    def arcs(self) -> tuple[float, float, float, float]:
        """α1 to α4 of a single linkage."""
        return float(self.ground), float(self.input), float(self.coupler), float(self.output)

    @property
    def output_axis(self) -> Array:
        """The axis c, (3, ...)."""
        a1 = np.asarray(self.ground, dtype=float)
        return np.stack([np.sin(a1), 0 * a1, np.cos(a1)])

    def loop(self) -> Loop:
        """The same linkage as a loop whose arm stands still."""
        c = self.output_axis
        a2 = np.asarray(self.input, dtype=float)
        a = np.stack([np.sin(a2), 0 * a2, np.cos(a2)])
        kappa, eta, a3 = self.point_azimuth, self.point_elevation, self.coupler
        along = np.cos(eta) * np.sin(kappa) / np.sin(a3)
        # m x a = (b - cos α3 a) / sin α3
        point = (np.cos(eta) * np.cos(kappa) - along * np.cos(a3), along, np.sin(eta) / np.sin(a3))
        pole = POLE if c.ndim == 1 else column(POLE, c)
        return Loop(
            pole,
            a,
            c,
            c,
            0.0,
            np.cos(a3),
            np.cos(self.output),
            -np.asarray(self.side, dtype=float),  # b.(a x c) = -c.(a x b)
            tuple(np.asarray(x) for x in point),  # type: ignore[arg-type]
        )

    def set_to(self, pose: float, crank: float, follower: float) -> "FourBar":
        """The four-bar after its pins were set: the coupler held at the input angle ``pose``, rad.

        Crank and output link are turned about their axes by so much, rad, to the coupler's new pins. A pose
        in which it cannot be assembled gives NaN.
        """
        state = self.loop().at(Turning.of(np.array([pose])), 0)
        o, c, p = POLE, self.output_axis, state.p[0][:, 0]
        a, b = rotate(o, crank, state.a[0][:, 0]), rotate(c, follower, state.c[0][:, 0])
        m = cross(a, b) / norm(cross(a, b))
        return replace(
            self,
            coupler=float(arc(a, b)),
            side=1.0 if float(dot(c, cross(a, b))) > 0 else -1.0,
            point_azimuth=math.atan2(float(dot(p, cross(m, a))), float(dot(p, a))),
            point_elevation=math.asin(float(np.clip(dot(p, m), -1.0, 1.0))),
        )

    def output_angle(self, theta: ArrayLike) -> Array:
        """ψ (...), rad, continuous in θ, up to whole turns for all; NaN where there is none."""
        a1, a2, a3, a4 = self.ground, self.input, self.coupler, self.output
        theta = np.asarray(theta, dtype=float)
        cos, sin = np.cos(theta), np.sin(theta)
        x = np.sin(a4) * (np.sin(a2) * np.cos(a1) * cos - np.cos(a2) * np.sin(a1))
        y = np.sin(a2) * np.sin(a4) * sin
        rest = np.sin(a2) * np.sin(a1) * np.cos(a4) * cos + np.cos(a2) * np.cos(a4) * np.cos(a1) - np.cos(a3)
        share = -rest / np.hypot(x, y)
        swing = np.where(np.abs(share) <= 1 + EDGE, np.arccos(np.clip(share, -1, 1)), np.nan)
        return self._direction(x, y, theta) + self.side * swing

    def _direction(self, x: Array, y: Array, theta: Array) -> Array:
        """atan2(y, x) without jumps: (x, y) runs on an ellipse around the origin, or beside it."""
        a1, a2 = self.ground, self.input
        around = np.abs(np.sin(a2) * np.cos(a1)) > np.abs(np.cos(a2) * np.sin(a1))
        sense = np.where(around, np.sign(np.cos(a1)), 0.0)
        # Seen from a direction that turns with it, or from that of its centre, it never passes ±π.
        start = np.where(around, np.where(np.cos(a1) > 0, 0.0, np.pi), np.where(np.cos(a2) > 0, np.pi, 0.0))
        turn = start + sense * theta
        cos, sin = np.cos(turn), np.sin(turn)
        return np.asarray(turn + np.arctan2(y * cos - x * sin, x * cos + y * sin))

    def at(self, turning: Turning, order: int = 3) -> State:
        """Pins and path point; the pin C of the loop is b."""
        return self.loop().at(turning, order)
