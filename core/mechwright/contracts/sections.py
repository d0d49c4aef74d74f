"""What stands of a plate at each height: the outline, less the recesses that reach that height.

A recess that reaches beyond the outline is open there, and nothing of it stands in the opening. Solids, mass,
pictures and interference ask here, so that a part is the same in all of them. Layers do not show chamfers;
``mechwright.contracts.moments`` counts them.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

from mechwright.contracts.part import Bore, Feature, Part, Pocket, Profile, is_outside
from mechwright.geometry import circle
from mechwright.tolerances import TOLERANCES

if TYPE_CHECKING:
    import shapely

STEPS = 8
"""Layers of a fillet: in between a wall of 3 mm fillet is 0.6 mm off at most, and never too small."""
ROUND = 64
"""Chords per quarter circle around the ends of walls."""


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


def plan_view(
    feature: Feature, tolerance: float = TOLERANCES.flatten
) -> "shapely.Polygon | shapely.MultiPolygon":
    """A feature seen from above: what it takes, or what an outside profile surrounds.

    A recess comes as it is drawn, with all that reaches beyond the plate.
    """
    import shapely

    match feature:
        case Bore():
            radius = feature.diameter / 2
            return shapely.Polygon(circle(feature.centre, radius).flatten(tolerance)[:-1])
        case Profile():
            return shapely.Polygon(feature.loop.flatten(tolerance))
        case Pocket():
            islands = [shapely.Polygon(loop.flatten(tolerance)) for loop in feature.islands]
            outside = shapely.Polygon(feature.boundary.flatten(tolerance))
            # Overlays leave specks of lines beside what they are asked for.
            view = shapely.get_parts(shapely.difference(outside, shapely.union_all(islands)))
            pieces = [piece for piece in view if piece.geom_type == "Polygon"]
            return pieces[0] if len(pieces) == 1 else shapely.MultiPolygon(pieces)


def blind(part: Part) -> tuple[Feature, ...]:
    """The features that do not go through the whole plate: the outline does not show them."""
    through = part.thickness - TOLERANCES.closure
    return tuple(f for f in part.features if f.top > TOLERANCES.closure or f.top + f.depth < through)


def sections(part: Part, tolerance: float = TOLERANCES.flatten, steps: int = STEPS) -> tuple[Section, ...]:
    """The layers of a plate part from its top face to its underside.

    Parameters
    ----------
    part
        A plate; a part without outline has no layers.
    tolerance
        Chord error of the polygons, mm.
    steps
        Layers of a floor's fillet, each as large as at its bottom; 0 leaves fillets out.

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
    round_floors = [f for f in blind(part) if isinstance(f, Pocket) and f.floor_radius > 0] if steps else []
    plain = plain_layers(part, tolerance, [z for feature in round_floors for z in _heights(feature, steps)])
    if not round_floors:
        return plain
    feet = [(feature, *foot(part, feature, plain, tolerance)) for feature in round_floors]
    layers = []
    for layer in plain:
        strips = [
            shapely.intersection(inside, shapely.buffer(lines, feature.inset(height), quad_segs=ROUND))
            for feature, inside, lines in feet
            if 0 <= (height := feature.top + feature.depth - layer.bottom) < feature.floor_radius
        ]
        shape = shapely.union_all([layer.shape, *strips]) if strips else layer.shape
        layers.append(Section(layer.top, layer.bottom, shape))
    return tuple(layers)


def plain_layers(part: Part, tolerance: float, extra: Sequence[float] = ()) -> tuple[Section, ...]:
    """The layers without fillets; ``extra`` are more depths to divide at."""
    assert part.outline is not None  # noqa: S101 - asked of plates only
    return cut_layers(part.outline.polygon(tolerance), blind(part), part.thickness, tolerance, extra)


def cut_layers(
    whole: "shapely.Geometry",
    features: Sequence[Feature],
    depth: float,
    tolerance: float = TOLERANCES.flatten,
    extra: Sequence[float] = (),
) -> tuple[Section, ...]:
    """The layers of a plate of the plan view ``whole`` down to a depth, mm, less its features.

    Fillets on floors are left out; ``extra`` are more depths to divide at.
    """
    import shapely

    heights = {0.0, depth, *extra}
    for feature in features:
        heights |= {float(feature.top), float(min(feature.top + feature.depth, depth))}
    views = [plan_view(feature, tolerance) for feature in features]
    layers = []
    for top, bottom in pairwise(sorted(h for h in heights if 0 <= h <= depth)):
        if bottom - top <= TOLERANCES.closure:
            continue
        middle = (top + bottom) / 2
        shape = whole
        for feature, view in zip(features, views, strict=True):
            if feature.top < middle < feature.top + feature.depth:
                stays = shapely.intersection if is_outside(feature) else shapely.difference
                shape = stays(shape, view)
        layers.append(Section(top, bottom, shape))
    return tuple(layers)


def _heights(feature: Pocket, steps: int) -> list[float]:
    """Depths at which the layers of a fillet begin, mm, at even angles."""
    floor, radius = feature.top + feature.depth, feature.floor_radius
    angles = (math.pi / 2 * step / steps for step in range(1, steps + 1))
    return [floor - radius * (1 - math.cos(angle)) for angle in angles]


def walls(part: Part, feature: Pocket, tolerance: float = TOLERANCES.flatten) -> "shapely.Geometry":
    """The lines at which walls stand on the floor of a recess, part coordinates, mm."""
    return foot(part, feature, plain_layers(part, tolerance), tolerance)[1]


def foot(
    part: Part, feature: Pocket, layers: Sequence[Section], tolerance: float
) -> "tuple[shapely.Geometry, shapely.Geometry]":
    """The floor of a recess, less what goes deeper, and the lines at which walls stand on it."""
    import shapely

    assert part.outline is not None  # noqa: S101 - asked of plates only
    floor = feature.top + feature.depth
    above = next(layer for layer in layers if abs(layer.bottom - floor) <= TOLERANCES.closure)
    below = next((layer for layer in layers if abs(layer.top - floor) <= TOLERANCES.closure), above)
    view = plan_view(feature, tolerance)
    # A boundary that is the plate's own edge has no wall; both are chords of the same curve.
    lines = shapely.intersection(shapely.boundary(view), shapely.buffer(above.shape, 2 * tolerance))
    return shapely.intersection(view, below.shape), lines
