"""Which moves go straight down in what one earlier cut has taken: quickly told, and never wrongly.

A cut that has come within d of a place, with a cutter as wide as d and r together at some height of its own,
has taken all within r of that place from there up. Of each place and cut that is one height, and of many
cuts the lowest counts.
"""

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.arrays import Array, first_of_each
from mechwright_cam.controls.reading.run import Ints, Kind
from mechwright_cam.proof.paths import NEAR, Paths

AT_ONCE = 256
"""So many places are looked at together, each with the cuts around it."""


def bored(paths: Paths, cuts: Ints, steps: Ints, *, lift: float, radius: float) -> NDArray[np.bool_]:
    """Which of the steps (k,) go straight down and meet nothing, since one of the cuts (m,) has been there.

    What is asked about is a cylinder of a radius that begins ``lift`` above the cutter's tip, mm. A step of
    which this is not known, as several cuts have made its hole, is none of them.
    """
    found = np.zeros(steps.size, dtype=np.bool_)
    upright = np.hypot(*(paths.end - paths.start)[steps, :2].T) < NEAR
    at = np.flatnonzero(upright & (paths.run.kind[steps] != Kind.ARC))
    if not at.size or not cuts.size:
        return found
    # Passes go down at the same places: each is looked at once.
    places, place = np.unique(np.round(paths.end[steps[at], :2], 9), axis=0, return_inverse=True)
    near, cut, low = _taken(paths, _different(paths, cuts), places, radius)
    # In the order of the program, what has been taken so far at each place.
    asked = steps[at]
    which, when = np.concatenate((near, place.ravel())), np.concatenate((cut, asked))
    order = np.lexsort((np.arange(which.size) < near.size, when, which))
    heights = np.concatenate((low, np.full(at.size, np.inf)))[order]
    bottom = paths.low[asked] + lift
    drop = float(np.ptp(np.concatenate((low, bottom)))) + 1.0  # more than any two differ by
    lowest = np.minimum.accumulate(heights - drop * which[order]) + drop * which[order]
    sofar = np.empty(which.size)
    sofar[order] = lowest
    found[at] = sofar[near.size :] <= bottom + NEAR
    return found


def _different(paths: Paths, cuts: Ints) -> Ints:
    """The first of all cuts that are alike."""
    run = paths.run
    table = np.column_stack(
        (
            run.tool[cuts],
            paths.start[cuts],
            paths.end[cuts],
            np.nan_to_num(run.centre[cuts]),
            run.sweep[cuts],
        )
    )
    return cuts[np.sort(first_of_each(np.round(table / NEAR).astype(np.int64))[0])]


def _taken(paths: Paths, cuts: Ints, places: Array, radius: float) -> tuple[Ints, Ints, Array]:
    """Place and step (p,) of the cuts near enough, and the height z (p,) down to which each has taken all."""
    least, most = paths.extent(cuts)
    reach = paths.radius[cuts, None] - radius
    boxes = shapely.box(*(least - reach).T, *(most + reach).T)
    able = np.flatnonzero((reach >= 0).ravel())
    tree = shapely.STRtree(boxes[able])
    found = [(np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64), np.empty(0))]
    for first in range(0, len(places), AT_ONCE):
        place, box = tree.query(shapely.points(places[first : first + AT_ONCE]))
        step = cuts[able[box]]
        away = distance(paths, step, places[first + place])
        top = np.maximum(paths.start[step, 2], paths.end[step, 2])
        height = top + paths.cutters(step).height_at(away + radius)
        known = np.isfinite(height)
        found.append((first + place[known], step[known], height[known]))
    place, step, height = (np.concatenate(column) for column in zip(*found, strict=True))
    return place, step, height


def distance(paths: Paths, steps: Ints, places: Array) -> Array:
    """Distance (p,) in plan view of places (p, 2) from the path of a step each, mm; no arc is nearer."""
    run = paths.run
    start, end = paths.start[steps, :2], paths.end[steps, :2]
    way, out = end - start, places - start
    share = np.clip((way * out).sum(axis=1) / np.maximum((way * way).sum(axis=1), NEAR**2), 0.0, 1.0)
    away: Array = np.hypot(*(out - way * share[:, None]).T)
    arc = np.flatnonzero(run.kind[steps] == Kind.ARC)
    if arc.size:
        step, sweep = steps[arc], run.sweep[steps[arc]]
        spoke, there = start[arc] - run.centre[step], places[arc] - run.centre[step]
        turn = np.arctan2(there[:, 1], there[:, 0]) - np.arctan2(spoke[:, 1], spoke[:, 0])
        beside = np.mod(turn * np.sign(sweep), 2 * np.pi) <= np.abs(sweep)
        ends = np.minimum(np.hypot(*out[arc].T), np.hypot(*(places - end)[arc].T))
        ring = np.abs(np.hypot(*there.T) - run.radius[step]) + run.arc_error[step]
        away[arc] = np.where(beside, ring, ends)
    return away
