"""The outline of the crank plate: a hub, and a boss about each roller's pin, with their common tangents."""

import math

from mechwright import Arc, Line, Loop, Point, Segment
from mechwright_geneva.kinematics.mechanism import Mechanism
from mechwright_geneva.parts.dowels import driver_dowels


def boss_radius(m: Mechanism) -> float:
    """Radius of the boss about a pin, mm: not less than the roller, which it covers."""
    return max(m.params.pin_diameter / 2 + m.params.least_wall, m.roller)


def hub_radius(m: Mechanism) -> float:
    """Radius of the crank's hub, mm: around opening and dowels, or twice the least wall about a bare bore."""
    params = m.params
    bare = m.driver_opening + 2 * params.least_wall
    if not driver_dowels(m):
        return bare
    return max(bare, (m.driver_opening + m.driver_radius) / 2 + params.fixing / 2 + params.least_wall)


def crank_loop(m: Mechanism) -> Loop:
    """The outside of the crank plate, counter-clockwise, roller 0 on +x."""
    boss, hub, k = boss_radius(m), hub_radius(m), m.params.rollers
    centres = [(m.crank * math.cos(i * m.pitch), m.crank * math.sin(i * m.pitch)) for i in range(k)]
    circles: list[tuple[Point, float]] = []
    for centre in centres:
        circles.append((centre, boss))
        # Where the line between two bosses would cut into the hub, the hub shows.
        if k == 1 or m.crank * math.cos(m.pitch / 2) + boss < hub or k == 2:
            circles.append(((0.0, 0.0), hub))
    if k == 2 and hub <= boss:
        circles = [(centre, boss) for centre in centres]
    return _hull(circles)


def _hull(circles: list[tuple[Point, float]]) -> Loop:
    """The loop around circles that are met in this order, by outer common tangents."""
    count = len(circles)
    normals = []
    for i in range(count):
        (c1, r1), (c2, r2) = circles[i], circles[(i + 1) % count]
        dx, dy = c2[0] - c1[0], c2[1] - c1[1]
        # The tangent's outward normal n has n·(c2 - c1) = r1 - r2.
        normals.append(math.atan2(dy, dx) - math.acos((r1 - r2) / math.hypot(dx, dy)))
    segments: list[Segment] = []
    for i, (centre, radius) in enumerate(circles):
        start, end = normals[i - 1], normals[i]
        segments.append(Arc(centre, radius, start, (end - start) % math.tau, "crank"))
        after, next_radius = circles[(i + 1) % count]
        touch = (after[0] + next_radius * math.cos(end), after[1] + next_radius * math.sin(end))
        segments.append(Line(segments[-1].end, touch, "crank"))
    return Loop(tuple(segments))
