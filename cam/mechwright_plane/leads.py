"""Tangential arcs that lead a cutter to a wall and away from it."""

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.geometry.segments import Point
from mechwright_plane.path import Path, arc, printed

CANDIDATES = 120
"""Places of a ring at which leads are tried."""
SMOOTH = 0.1
"""A vertex that turns by more, rad, has no tangent to lead along."""
FINE_STEPS = 48
"""Pieces of a lead that is looked at as a whole: on a radius of 10 mm they are 1.3 µm off."""
STEPS = 8
"""Points of a lead that are tested, its far end included."""

Test = Callable[[Array], NDArray[np.bool_]]


def lead_shapes(radius: float, least: float) -> list[tuple[float, float]]:
    """Radius, mm, and sweep, rad, of leads to try, roomy ones first; the last rise just ``least`` mm."""
    shapes = [(radius, math.pi / 2), (radius / 2, math.pi / 2), (radius, math.pi / 4)]
    shapes = [(rho, sweep) for rho, sweep in shapes if rho * (1 - math.cos(sweep)) >= least]
    if 0 < least < radius:
        shapes.append((radius, math.acos(1 - least / radius)))
    return shapes


def best_start(
    ring: Array,
    shapes: list[tuple[float, float]],
    climb: bool,
    free: Test,
    clear: Test,
    exact: Callable[[Array], bool],
) -> tuple[int, float, float] | None:
    """Where to enter a ring (n + 1, 2), mm, and with which lead: its vertex, radius and sweep of the lead.

    Leads are tried in the order of ``shapes``, radius, mm, and sweep, rad. Of all places where one fits it is
    the middle of the longest stretch; None if no lead fits anywhere. ``climb`` has the wall on the right.
    ``free`` tells of points (k, 2) whether the cutter's centre may be there, ``clear`` whether the cutter may
    be sunk there, and ``exact`` whether it may run along a polyline (k, 2): that is asked of the lead that is
    chosen, for between the points that ``free`` is asked for a corner of the wall may stand.
    """
    edge = np.diff(ring, axis=0)
    heading = np.arctan2(edge[:, 1], edge[:, 0])
    turn = (heading - np.roll(heading, 1) + math.pi) % math.tau - math.pi
    n = len(edge)
    index = np.unique(np.linspace(0, n - 1, min(n, CANDIDATES)).astype(int))
    index = index[np.abs(turn[index]) < SMOOTH]
    if not index.size:
        return None
    mean = heading[index] - turn[index] / 2
    t = np.column_stack((np.cos(mean), np.sin(mean)))
    away = np.column_stack((-t[:, 1], t[:, 0])) * (1 if climb else -1)
    for rho, sweep in shapes:
        a = np.linspace(0, sweep, STEPS + 1)[1:]
        rise = (rho * (1 - np.cos(a)))[None, :, None] * away[:, None, :]
        along = (rho * np.sin(a))[None, :, None] * t[:, None, :]
        ways = ring[index][:, None, None, :] + np.stack((rise - along, rise + along), axis=1)
        fits = np.asarray(free(ways.reshape(-1, 2)).reshape(len(index), -1).all(axis=1))
        fits = np.logical_and(fits, clear(ways[:, :, -1].reshape(-1, 2)).reshape(len(index), 2).all(axis=1))
        while fits.any():
            best = middle_of_longest(fits)
            if exact(ring[index[best]] + _arcs(rho, sweep, t[best], away[best])):
                return int(index[best]), rho, sweep
            fits[best] = False
    return None


def _arcs(rho: float, sweep: float, along: Array, away: Array) -> Array:
    """A lead in and a lead out (k, 2), mm, from the place on the wall at which both meet."""
    a = np.linspace(-sweep, sweep, 2 * FINE_STEPS + 1)[:, None]
    return rho * (np.sin(a) * along + (1 - np.cos(a)) * away)


def middle_of_longest(flags: NDArray[np.bool_]) -> int:
    """The middle of the longest run of true flags on a circle."""
    n = len(flags)
    if flags.all():
        return 0
    shift = int(np.flatnonzero(~flags)[0])
    edges = np.diff(np.concatenate(([False], np.roll(flags, -shift), [False])).astype(int))
    first, last = np.flatnonzero(edges == 1), np.flatnonzero(edges == -1)
    longest = int(np.argmax(last - first))
    return (int(first[longest] + last[longest] - 1) // 2 + shift) % n


def with_leads(path: Path, heading: float, rho: float, sweep: float, climb: bool) -> Path:
    """A closed path with an arc in front and one behind, tangent to ``heading``, rad, at its start."""
    side = 1 if climb else -1
    rise, along = rho * (1 - math.cos(sweep)), rho * math.sin(sweep)
    begin, end = (printed(_off(path.start, heading, side, rise, way)) for way in (-along, along))
    centre = _off(path.start, heading, side, rho, 0.0)
    return Path(begin, (arc(begin, path.start, centre, side), *path.cuts, arc(path.start, end, centre, side)))


def half_circles(centre: Point, turn: Path) -> tuple[Path, Path]:
    """The ways from the middle of a circle to its start, and from there back."""
    middle, start, side = printed(centre), turn.start, turn.cuts[0].turn
    between = ((middle[0] + start[0]) / 2, (middle[1] + start[1]) / 2)
    into, off = arc(middle, start, between, side), arc(start, middle, between, side)
    return Path(middle, (into,)), Path(start, (off,))


def _off(place: Point, heading: float, side: int, rise: Any, along: Any) -> Any:
    """What is so far off a wall, and ahead along it, from a place on it, mm: a point, or x and y of many."""
    tx, ty = math.cos(heading), math.sin(heading)
    nx, ny = -ty * side, tx * side
    return place[0] + rise * nx + along * tx, place[1] + rise * ny + along * ty


def led(
    path: Path, headings: tuple[float, float], shapes: Sequence[tuple[float, float]], climb: bool, test: Test
) -> Path:
    """An open path with an arc in front and one behind, each as roomy as it fits.

    ``headings`` are those of the path at its start and at its end, rad; ``test`` tells of points (k, 2) of a
    lead whether the cutter may be there with nothing in its way. The rest is as for :func:`best_start`.
    """
    side = 1 if climb else -1
    for at_end, heading in enumerate(headings):
        place, way = (path.end, 1) if at_end else (path.start, -1)
        for rho, sweep in shapes:
            a = np.linspace(0, sweep, STEPS + 1)[1:]
            rise, along = rho * (1 - np.cos(a)), way * rho * np.sin(a)
            points = np.column_stack(_off(place, heading, side, rise, along))
            if not test(points).all():
                continue
            far, centre = printed(points[-1].tolist()), _off(place, heading, side, rho, 0.0)
            if at_end:
                path = path + Path(path.end, (arc(path.end, far, centre, side),))
            else:
                path = Path(far, (arc(far, path.start, centre, side),)) + path
            break
    return path
