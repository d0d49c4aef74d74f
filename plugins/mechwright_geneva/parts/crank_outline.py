"""The crank plate: a hub, and a boss about each roller's pin, with their common tangents."""

import cmath
import math
from typing import Any

import numpy as np

from mechwright import Arc, Line, Loop, Segment
from mechwright.contracts.design_table import number
from mechwright.contracts.fits import Fit, hole_fit
from mechwright_geneva.kinematics.mechanism import Mechanism
from mechwright_geneva.parts.openings import by_size


def pins(m: Mechanism) -> list[Any]:
    """Places of the pins as x + iy, mm, roller 0 on +x."""
    return [m.crank * cmath.rect(1.0, k * m.pitch) for k in range(m.params.rollers)]


def pin_fit(m: Mechanism, size: float) -> Fit | None:
    """Of the bore of a pin of this size, mm; None without one."""
    return None if m.params.pin_fit == "none" else hole_fit(size, m.params.pin_fit)


def pin_bore(m: Mechanism) -> Any:
    """Diameter of the pins' bores, mm: the middle of their fit."""

    def bore(size: float) -> float:
        fit = pin_fit(m, size)
        return size if fit is None else fit.middle

    return by_size(bore, m.params.pin_diameter)


def stud_diameter(m: Mechanism) -> Any:
    """Diameter of the rollers' studs, mm; one that is pressed in is shown as it then is."""
    return number(np.minimum(m.params.pin_diameter, pin_bore(m)))


def boss_radius(m: Mechanism) -> float:
    """Radius of the boss about a pin, mm: not less than the roller, which it covers."""
    return number(np.maximum(m.params.pin_diameter / 2 + m.params.least_wall, m.roller))


def hub_radius(m: Mechanism) -> float:
    """Radius of the crank's hub, mm: around opening and dowels, or twice the least wall about a bare bore."""
    fixing, wall = np.asarray(m.params.fixing), m.params.least_wall
    bare = m.driver_opening + 2 * wall
    joined = np.maximum(bare, (m.driver_opening + m.driver_radius) / 2 + fixing / 2 + wall)
    return number(np.where(fixing > 0, joined, bare))


def crank_loop(m: Mechanism) -> Loop:
    """The outside of the crank plate, counter-clockwise, roller 0 on +x."""
    boss, hub, k = boss_radius(m), hub_radius(m), m.params.rollers
    circles: list[tuple[complex, float]] = []
    for centre in pins(m):
        circles.append((centre, boss))
        # Where the line between two bosses would cut into the hub, the hub shows.
        if k == 1 or hub > (boss if k == 2 else m.crank * math.cos(m.pitch / 2) + boss):
            circles.append((0j, hub))
    return _hull(circles)


def _hull(circles: list[tuple[complex, float]]) -> Loop:
    """The loop around circles that are met in this order, by outer common tangents."""
    following = [*circles[1:], circles[0]]
    normals = []
    for (c1, r1), (c2, r2) in zip(circles, following, strict=True):
        # The tangent's outward normal n has n·(c2 - c1) = r1 - r2.
        normals.append(cmath.phase(c2 - c1) - math.acos((r1 - r2) / abs(c2 - c1)))
    segments: list[Segment] = []
    for i, (centre, radius) in enumerate(circles):
        start, end = normals[i - 1], normals[i]
        segments.append(Arc((centre.real, centre.imag), radius, start, (end - start) % math.tau, "crank"))
        after, next_radius = following[i]
        touch = after + cmath.rect(next_radius, end)
        segments.append(Line(segments[-1].end, (touch.real, touch.imag), "crank"))
    return Loop(tuple(segments))
