"""What stands of a plate at each height: the outline, less the recesses that reach that height.

A recess that reaches beyond the outline is open there, and nothing of it stands in the opening. Solids, mass,
pictures and interference ask here, so that a part is the same in all of them. Chamfers and
engravings count in the volume; layers do not show them.
"""

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from mechwright.details import Engraving, depth_of, taken_by
from mechwright.part import Bore, Feature, Part, Pocket, Profile
from mechwright.tolerances import TOLERANCES

if TYPE_CHECKING:
    import shapely

FINE = 1e-5
"""Chord error of the polygons that a volume is made of, mm: a millionth of the volume of any part in use."""


@dataclass(frozen=True)
class Section:
    """A layer of a part with one cross-section.

    Parameters
    ----------
    top, bottom
        Depths below the part's top face, mm, ``top`` the smaller.
    shape
        What stands there, part coordinates, mm; it may be in several pieces.
    """

    top: float
    bottom: float
    shape: "shapely.Polygon | shapely.MultiPolygon"


def plan_view(feature: Feature, tolerance: float = TOLERANCES.flatten) -> "shapely.Polygon":
    """A feature seen from above: what it takes, or what an outside profile surrounds.

    A recess comes as it is drawn, with all that reaches beyond the plate.
    """
    import shapely

    match feature:
        case Bore():
            from mechwright.geometry import circle

            radius = feature.diameter / 2
            return shapely.Polygon(circle(feature.centre, radius).flatten(tolerance)[:-1])
        case Profile():
            return shapely.Polygon(feature.loop.flatten(tolerance))
        case Pocket():
            islands = [shapely.Polygon(loop.flatten(tolerance)) for loop in feature.islands]
            outside = shapely.Polygon(feature.boundary.flatten(tolerance))
            view: shapely.Polygon = outside.difference(shapely.union_all(islands))
            return view


def blind(part: Part) -> tuple[Feature, ...]:
    """The features that do not go through the whole plate: the outline does not show them."""
    through = part.thickness - TOLERANCES.closure
    return tuple(f for f in part.features if f.top > TOLERANCES.closure or f.top + f.depth < through)


def sections(part: Part, tolerance: float = TOLERANCES.flatten) -> tuple[Section, ...]:
    """The layers of a plate part from its top face to its underside.

    Parameters
    ----------
    part
        A plate; a part without outline has no layers.
    tolerance
        Chord error of the polygons, mm.

    Examples
    --------
    A groove across a plate, open at both ends:

    >>> from mechwright.geometry import Loop, Outline
    >>> plate = Loop.polygon([(0, 0), (30, 0), (30, 20), (0, 20)])
    >>> groove = Loop.polygon([(-5, 8), (35, 8), (35, 12), (-5, 12)])
    >>> machined = (Pocket("groove", groove, (), 0, 2), Profile("outside", plate, "outside", 0, 5))
    >>> part = Part("plate", Outline(plate), 5.0, "steel", machined=machined)
    >>> [(layer.top, layer.bottom, layer.shape.area) for layer in sections(part)]
    [(0.0, 2.0, 480.0), (2.0, 5.0, 600.0)]
    """
    import shapely

    if part.outline is None:
        return ()
    partial = blind(part)
    heights = {0.0, part.thickness}
    for feature in partial:
        heights |= {float(feature.top), float(min(feature.top + feature.depth, part.thickness))}
    whole = part.outline.polygon(tolerance)
    views = [plan_view(feature, tolerance) for feature in partial]
    layers = []
    for top, bottom in pairwise(sorted(h for h in heights if 0 <= h <= part.thickness)):
        if bottom - top <= TOLERANCES.closure:
            continue
        middle = (top + bottom) / 2
        shape = whole
        for feature, view in zip(partial, views, strict=True):
            if feature.top < middle < feature.top + feature.depth:
                outside = isinstance(feature, Profile) and feature.side == "outside"
                shape = shapely.intersection(shape, view) if outside else shapely.difference(shape, view)
        layers.append(Section(top, bottom, shape))
    return tuple(layers)


def volume(part: Part) -> float:
    """Volume of a plate part, mm³, recesses, chamfers and engravings taken out; 0 for one built as a solid.

    The plate itself is exact, what is taken out of it is right to ``FINE``.
    """
    if part.outline is None:
        return 0.0
    solid = part.outline.area * part.thickness
    if not blind(part) and not part.details:
        return solid
    whole = part.outline.polygon(FINE).area
    layers = sections(part, FINE)
    solid -= float(sum((whole - layer.shape.area) * (layer.bottom - layer.top) for layer in layers))
    return solid - _details_volume(part) if part.details else solid


NODES = {False: 2, True: 6}
"""Depths at which details are looked at, between those where one begins or ends. Two (of Gauss) are exact for
bands along edges, whose area is a polynomial of degree 2; strokes of an engraving part from each other."""
BAND = 10 * FINE
"""Chord error of the polygons along which details are cut, mm: both sides of a band have it."""


def _details_volume(part: Part) -> float:
    """What details take of the layers of a part, mm³."""
    import shapely

    layers = sections(part, BAND)
    count = NODES[any(isinstance(detail, Engraving) for detail in part.details)]
    nodes, weights = np.polynomial.legendre.leggauss(count)
    ends = {depth_of(detail) for detail in part.details}
    taken = 0.0
    for layer in layers:
        inner = {depth for depth in ends if layer.top < depth < layer.bottom}
        for top, bottom in pairwise(sorted({layer.top, layer.bottom} | inner)):
            for node, weight in zip(nodes.tolist(), weights.tolist(), strict=True):
                depth = top + (bottom - top) * (1 + node) / 2
                cut = [taken_by(d, depth, BAND) for d in part.details if depth < depth_of(d)]
                if cut:
                    area = shapely.intersection(layer.shape, shapely.union_all(cut)).area
                    taken += float(area) * weight * (bottom - top) / 2
    return taken
