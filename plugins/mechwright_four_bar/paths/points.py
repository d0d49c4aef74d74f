"""The points of a path as they are asked for: what is wrong with them, and which are searched with."""

import math
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from mechwright import Array
from mechwright.mechanics.planar import Plane
from mechwright_four_bar.paths.asked import Limits, PathProblem
from mechwright_four_bar.requirements import PathRequirement

SEARCHED = 40
"""Points that a search looks at; of more, so many are taken, and what is found is fitted to all."""

SMOOTHED = 9
"""Points of the running mean along which very many points are told apart: noise would lengthen the way."""

SENSES = {"ccw": (1,), "cw": (-1,), "any": (1, -1)}


def fault(wanted: PathRequirement) -> str:
    """Points that no path can be sought through, and which; empty where they are sound."""
    points = wanted.points
    if len(set(points)) == 1:
        x, y = points[0]
        return f"all {len(points)} points are ({x:g}, {y:g}): a path needs two places at least"
    if wanted.crank_turns is None:
        for number, (one, two) in enumerate(pairwise(points), start=1):
            if one == two:
                return (
                    f"points {number} and {number + 1} are both ({one[0]:g}, {one[1]:g}); leave one out, "
                    f"or say in "
                    "crank_turns how far the crank turns while the point stands still"
                )
    return ""


def problem_of(wanted: PathRequirement) -> PathProblem:
    """The requirement in complex numbers and radians.

    A first point that comes again at the end closes the path.
    """
    targets = np.array([complex(x, y) for x, y in wanted.points])
    turns = None if wanted.crank_turns is None else np.radians(wanted.crank_turns)
    again = targets.size > 3 and targets[0] == targets[-1] and turns is None
    return PathProblem(
        targets[:-1] if again else targets,
        turns,
        SENSES[wanted.sense],
        wanted.closed or bool(again),
        math.radians(wanted.order_tolerance),
        Limits(
            wanted.shortest_link,
            wanted.longest_link,
            math.radians(wanted.least_transmission_angle),
            wanted.frame,
        ),
    )


def thinned(targets: Plane, closed: bool) -> NDArray[np.intp]:
    """Indices of at most :data:`SEARCHED` points, even along the path.

    >>> thinned(np.arange(1000.0) + 0j, False)[[0, -1]].tolist()
    [0, 999]
    """
    n = targets.size
    if n <= SEARCHED:
        return np.arange(n)
    half = SMOOTHED // 2
    padded = (
        np.concatenate((targets[-half:], targets, targets[:half]))
        if closed
        else np.pad(targets, half, "edge")
    )
    smooth = np.convolve(padded, np.full(SMOOTHED, 1 / SMOOTHED), "valid")
    steps = np.abs(np.diff(np.append(smooth, smooth[0]) if closed else smooth))
    way = np.concatenate(([0.0], np.cumsum(steps)))
    wanted = np.linspace(0, way[-1], SEARCHED + 1)[:-1] if closed else np.linspace(0, way[-1], SEARCHED)
    return np.unique(np.clip(np.searchsorted(way[:n], wanted - 1e-9 * way[-1]), 0, n - 1))


def all_angles(chosen: NDArray[np.intp], phi: Array, count: int, closed: bool) -> Array:
    """Crank angles (count,) for all points from those of the chosen ones."""
    if closed:
        way = math.copysign(math.tau, phi[-1] - phi[0])
        chosen, phi = np.append(chosen, chosen[0] + count), np.append(phi, phi[0] + way)
    angles: Array = np.interp(np.arange(count), chosen, phi)
    return angles
