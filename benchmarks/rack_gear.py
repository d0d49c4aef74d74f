"""A circular gear cut by a rack, as points and as an outline: a stand-in of known cost for CAD benchmarks.

Flank and fillet are the envelope of the rack in closed form (Litvin, Gear Geometry and Applied Theory, ch.
6); with pitch radius R every point of the rack's flank touches at an angle that is linear in its place.
"""

import math
from dataclasses import dataclass

import numpy as np

from mechwright.geometry import Arc, BSpline, Loop, Outline, circle

PRESSURE_ANGLE = math.radians(20)
ADDENDUM, DEDENDUM, TIP_RADIUS = 1.0, 1.25, 0.38
"""In modules (ISO 53 basic rack, profile A)."""

SAMPLES = 60
"""Points per flank and per fillet: closer than the fit needs."""


@dataclass(frozen=True)
class RackGear:
    """A gear of ``teeth`` teeth and ``module`` mm; curves start at the root of the space around angle 0."""

    teeth: int = 40
    module: float = 2.0
    bore: float = 20.0

    @property
    def radius(self) -> float:
        return self.teeth * self.module / 2

    def fillet(self, t):
        """Points (n, 2) of the upper fillet, t from 0 (root) to 1 (flank)."""
        m, sin = self.module, math.sin(PRESSURE_ANGLE)
        low = -DEDENDUM * m + TIP_RADIUS * m * (1 - sin)
        eta = -DEDENDUM * m + TIP_RADIUS * m
        centre = math.pi * m / 4 + low * math.tan(PRESSURE_ANGLE) - TIP_RADIUS * m * math.cos(PRESSURE_ANGLE)
        turn = t * (math.pi / 2 - PRESSURE_ANGLE)
        s = centre + eta * np.tan(turn)
        w = np.column_stack((centre - s, np.full_like(s, eta)))
        return self._at(s, (1 + TIP_RADIUS * m / np.linalg.norm(w, axis=1))[:, None] * w)

    def flank(self, t):
        """Points (n, 2) of the upper flank, t from 0 (fillet) to 1 (tip circle)."""
        m, sin, cos = self.module, math.sin(PRESSURE_ANGLE), math.cos(PRESSURE_ANGLE)
        low = (-DEDENDUM * m + TIP_RADIUS * m * (1 - sin)) / (sin * cos)
        # |P|² = (R + u sin cos)² + (u cos²)² reaches the tip circle.
        a, b = cos * cos, 2 * self.radius * sin * cos
        c = self.radius**2 - (self.radius + ADDENDUM * m) ** 2
        high = (-b + math.sqrt(b * b - 4 * a * c)) / (2 * a)
        u = low + t * (high - low)
        return self._at(math.pi * m / 4 + u, np.column_stack((-u * cos * cos, u * sin * cos)))

    def _at(self, s, offset):
        angle = s / self.radius
        normal = np.column_stack((np.cos(angle), np.sin(angle)))
        tangent = np.column_stack((-normal[:, 1], normal[:, 0]))
        return self.radius * normal + offset[:, :1] * tangent + offset[:, 1:] * normal


def outline(gear: RackGear) -> Outline:
    """Six segments per tooth: root arc, fillet, flank, tip arc, flank, fillet, fitted by Bezier curves."""
    t = (1 - np.cos(np.pi * np.arange(SAMPLES) / (SAMPLES - 1))) / 2
    fillet, worst1 = _fitted(gear.fillet(t), t, 7)
    flank, worst2 = _fitted(gear.flank(t), t, 4)
    flank[0] = fillet[-1]
    pitch = math.tau / gear.teeth
    low, high = (math.atan2(p[1], p[0]) for p in (fillet[0], flank[-1]))
    root, tip = np.hypot(*fillet[0]), np.hypot(*flank[-1])
    segments = []
    for tooth in range(gear.teeth):
        angle = tooth * pitch
        segments += [
            Arc((0.0, 0.0), root, angle - low, 2 * low, "root"),
            BSpline.bezier(_turned(fillet, angle), "fillet"),
            BSpline.bezier(_turned(flank, angle), "flank"),
            Arc((0.0, 0.0), tip, angle + high, pitch - 2 * high, "tip"),
            BSpline.bezier(_turned(_mirrored(flank), angle + pitch), "flank"),
            BSpline.bezier(_turned(_mirrored(fillet), angle + pitch), "fillet"),
        ]
    bore = Loop((circle((0.0, 0.0), gear.bore / 2, clockwise=True),))
    return Outline(Loop(tuple(segments)), (bore,), max(worst1, worst2))


def _fitted(points, t, degree):
    """Control points of the Bezier curve with these ends that is nearest at t, and its largest distance."""
    k = np.arange(degree + 1)
    binomial = np.array([math.comb(degree, i) for i in k], dtype=float)
    basis = binomial * t[:, None] ** k * (1 - t[:, None]) ** (degree - k)
    net = np.empty((degree + 1, 2))
    net[0], net[-1] = points[0], points[-1]
    right = points - basis[:, [0, -1]] @ net[[0, -1]]
    net[1:-1] = np.linalg.lstsq(basis[:, 1:-1], right, rcond=None)[0]
    return net, float(np.linalg.norm(basis @ net - points, axis=1).max())


def _turned(points, angle):
    c, s = math.cos(angle), math.sin(angle)
    return points @ np.array([[c, s], [-s, c]])


def _mirrored(points):
    return points[::-1] * (1, -1)
