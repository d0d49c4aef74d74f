"""Witness lines: where passes of different depths meet on a wall, and how far the wall steps there."""

import numpy as np

from mechwright.contracts.made_part import MadeSection, Witness
from mechwright_cam.proof.as_made import Tools
from mechwright_cam.proof.sweep import Sweep, Sweeps

SEEN = 1e-4
"""A smaller step is none, mm: the last decimal of a program may move a pass by as much."""
ONE_DEPTH = 1e-4
"""Passes whose depths differ by less are one, mm."""


def witnesses(sweeps: Sweeps, section: MadeSection) -> list[Witness]:
    """The witness lines of a cross-section in work coordinates, from the top down.

    A flat cutter clears all above its tip. So a wall is farthest out at its foot, and steps in where a pass
    that has gone on a line of its own has ended.
    """
    if not section.rings:
        return []
    places = np.concatenate([ring.points for ring in section.rings])
    outward = np.concatenate([ring.outward for ring in section.rings])
    off = np.concatenate([np.where(ring.corner, -np.inf, 0.0) for ring in section.rings])
    found = []
    above = sweeps.at(-section.top, -section.top)
    depths = np.concatenate([group.pieces.low for group in above]) if above else np.empty(0)
    for z in _levels(depths, section):
        at_depth = [
            Sweep(g.radius, g.paths, g.pieces.only(np.abs(g.pieces.low - z) < ONE_DEPTH)) for g in above
        ]
        reached = Tools.of([sweep for sweep in at_depth if len(sweep.pieces)]).beside(places, outward)
        step = off - np.minimum(off, reached)
        worst = int(np.argmax(np.nan_to_num(step)))
        if step[worst] > SEEN:
            x, y = places[worst].tolist()
            found.append(Witness(-z, float(step[worst]), (x, y)))
        off = np.minimum(off, reached)
    return found[::-1]


def _levels(depths: np.ndarray, section: MadeSection) -> list[float]:
    """Heights z at which passes end in a section, mm, lowest first."""
    inside = (depths > -section.bottom + ONE_DEPTH) & (depths < -section.top - ONE_DEPTH)
    levels: list[float] = (np.unique(np.round(depths[inside] / ONE_DEPTH)) * ONE_DEPTH).tolist()
    return levels
