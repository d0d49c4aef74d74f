"""The drawing of a part as made: nominal, and both bounds of the path's corridor."""

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright.contracts.made_part import MadePart
from mechwright.pipeline.result_store import stored
from mechwright.tolerances import TOLERANCES
from mechwright_cad.exporters.polylines import polylines

FINE = TOLERANCES.flatten / 2
"""Chord error of the polylines, mm."""
DIGITS = 5
"""Decimals of coordinates, mm."""


@stored
def as_made_drawing(part: MadePart) -> bytes:
    """A DXF with the layers ``MADE``, ``MADE-MOST``, ``MADE-LEAST``, ``TARGET``, and marks of witness lines.

    ``MADE-MOST`` has the most material that the corridor allows, ``MADE-LEAST`` the least; ``TARGET`` is
    what the cutters were to leave: the part, and the corners that none of them enters.
    """
    rings = [ring for section in (*part.sections, *part.underside) for ring in section.rings]
    layers = {
        "MADE": [_thin(ring.points) for ring in rings],
        "MADE-MOST": [_thin(ring.moved(part.corridor)) for ring in rings],
        "MADE-LEAST": [_thin(ring.moved(-part.corridor)) for ring in rings],
        "TARGET": [_thin(ring.planned) for ring in rings],
    }
    marks = [(line.at, f"{line.step * 1e3:.1f} um at depth {line.depth:g}") for line in part.witnesses]
    off = part.off * 1e3
    text = (
        f"{part.label} as made: {off.min():.1f} to {off.max():.1f} um left on its walls, "
        f"mean {off.mean():.1f}\nthe path may be off by {part.corridor * 1e3:g} um either way"
    )
    return polylines(layers, marks, text)


def _thin(points: Array) -> Array:
    """A closed ring (n, 2) with no more points than its shape needs."""
    line = shapely.LineString(np.concatenate((points, points[:1])))
    thin: Array = shapely.get_coordinates(shapely.simplify(line, FINE))[:-1].round(DIGITS)
    return thin
