"""The pieces at the faces where a leaning kerf is narrowest and widest.

The proof of the pieces takes the kerf as wide at both faces. By a jet, an arc or a beam the faces of a piece
differ in size by up to the taper: the kerf is narrower by it at one of them, or wider.
"""

from collections.abc import Iterator, Sequence

import shapely

from mechwright.tolerances import TOLERANCES
from mechwright_cut.proof.reading import Motion
from mechwright_cut.proof.swept import disc, runs, way

WALL = TOLERANCES.gouge
"""Largest distance of a cut wall from where the taper may put it, mm."""
SPECK = 1e-6
"""Area of what is no more than rounding, mm²."""
TIP = 4.0
"""A tip of half a right angle loses 2.6 times what its walls do; one that loses more is a finger."""
Named = Sequence[tuple[str, shapely.Polygon]]
"""Pieces that fall: names and outlines on the sheet."""


def taper_faults(
    through: Sequence[Motion], kerf: float, taper: float, sheet: tuple[float, float], pieces: Named
) -> Iterator[str]:
    """What is wrong with the pieces at either face: they hang together, fall apart, or lose a wall."""
    lines = [way(run) for run in runs(through)]
    edge = shapely.box(0, 0, *sheet)
    for width in (kerf - taper, kerf + taper):
        taken = shapely.union_all([disc(line, width) for line in lines])
        parts = shapely.get_parts(shapely.difference(edge, taken))
        tree = shapely.STRtree(parts)
        for name, shape in pieces:
            core = shapely.buffer(shape, -taper / 2 - WALL)
            if width > kerf and (said := _thin(shape, core, taper)):
                yield f"{name} {said}"
                continue
            own = [parts[k] for k in tree.query(core, predicate="intersects")]
            if said := _fault(own, shape, core, kerf, taper, edge):
                yield f"{name} {said} at the face where the kerf is {width:.2f} mm"


def _thin(shape: shapely.Polygon, core: shapely.Geometry, taper: float) -> str:
    """What of a piece is thinner than the taper: a web between openings, or a finger."""
    if core.geom_type != "Polygon" or len(core.interiors) != len(shape.interiors):
        return f"has a web below the taper of {taper:g} mm"
    ends = shapely.points(shapely.get_coordinates(shape))
    if shapely.distance(ends, core).max() > TIP * (taper / 2 + WALL):
        return f"has a finger below the taper of {taper:g} mm"
    return ""


def _fault(
    own: Sequence[shapely.Polygon],
    shape: shapely.Polygon,
    core: shapely.Geometry,
    kerf: float,
    taper: float,
    edge: shapely.Polygon,
) -> str:
    """What is wrong with the material that is a piece's at one face; empty where nothing is."""
    if len(own) != 1:
        return "falls apart" if own else "is cut away"
    if shapely.intersects(own[0], edge.exterior):
        return "is not cut free"
    lack = shapely.difference(core, own[0]).area
    reach = shapely.buffer(shapely.buffer(shape, kerf / 2, quad_segs=64), -kerf / 2, quad_segs=64)
    over = shapely.difference(own[0], shapely.buffer(reach, taper / 2 + WALL)).area
    if max(lack, over) <= SPECK:
        return ""
    return "lacks a wall" if lack > over else "keeps waste"
