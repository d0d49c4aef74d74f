"""Witness lines: where passes of different depths meet on a wall, and how far the wall steps there."""

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.made_part import MadeSection, Witness
from mechwright_cam.controls.reading.run import Ints
from mechwright_cam.proof.as_made import fine_chords
from mechwright_cam.proof.sweep import Sweep, Sweeps
from mechwright_cam.proof.wall import HINTED

SEEN = 1e-4
"""A smaller step is none, mm: the last decimal of a program may move a pass by as much."""
ONE_DEPTH = 1e-4
"""Passes whose depths differ by less are one, mm."""


def witnesses(sweeps: Sweeps, section: MadeSection) -> list[Witness]:
    """The witness lines of a cross-section in work coordinates, from the top down.

    A flat cutter clears all above its tip. So a wall is farthest out at its foot, and steps in where a pass
    that has gone on a line of its own has ended.
    """
    above = sweeps.at(-section.top, -section.top)
    if not section.rings or not above:
        return []
    # Corners are left by all passes, and differ in depth as their cutters do.
    places = np.concatenate([ring.points[~ring.corner] for ring in section.rings])
    outward = np.concatenate([ring.outward[~ring.corner] for ring in section.rings])
    off = np.zeros(len(places))
    beside = [_beside(group, places, outward) for group in above]
    found = []
    for level in np.unique(np.concatenate([levels for levels, _, _ in beside])):
        z = float(level) * ONE_DEPTH
        if not -section.bottom + ONE_DEPTH < z < -section.top - ONE_DEPTH:
            continue
        reached = off.copy()
        for levels, place, away in beside:
            here = levels == level
            np.minimum.at(reached, place[here], away[here])
        step = off - reached
        worst = int(np.argmax(step))
        if step[worst] > SEEN:
            x, y = places[worst].tolist()
            found.append(Witness(-z, float(step[worst]), (x, y)))
        off = reached
    return found[::-1]


def _beside(group: Sweep, places: Array, outward: Array) -> tuple[Ints, Ints, Array]:
    """Depth of the path, place, and how far that is off, mm, of each pair of a place and a path beside it."""
    chords, owner = fine_chords(group)
    line, place = chords.pairs(places + group.radius * outward, HINTED)
    levels = np.round(group.pieces.low / ONE_DEPTH).astype(np.int64)[owner][line]
    return levels, place, chords.distances(places, place, line) - group.radius
