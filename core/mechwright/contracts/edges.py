"""The edges of a plate's top face, broken."""

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Literal

from mechwright.contracts.details import Chamfer
from mechwright.contracts.part import Bore, Feature, Part, Pocket, Profile
from mechwright.contracts.sections import blind, plan_view
from mechwright.errors import GeometryError
from mechwright.geometry import Arc, Loop, circle
from mechwright.tolerances import TOLERANCES

Side = Literal["outside", "inside"]


def deburred(part: Part, width: float) -> Part:
    """The plate with all edges of its top face broken at 45 degrees, ``width`` mm wide.

    Edges that have a chamfer keep it. What starts below the top face, or in the middle of a recess, has no
    edge there. Raises GeometryError where a recess, or the plate, is no deeper than the chamfer.

    >>> from mechwright.geometry import Outline
    >>> square = Loop.polygon([(0, 0), (10, 0), (10, 10), (0, 10)])
    >>> [edge.name for edge in deburred(Part("plate", Outline(square), 5.0, "steel"), 0.3).details]
    ['edge-outside']
    """
    had = [detail for detail in part.details if isinstance(detail, Chamfer)]
    details = list(part.details)
    for name, loop, side, depth in _edges(part):
        if any(one.loop == loop and one.side == side for one in had):
            continue
        if width >= depth:
            raise GeometryError(
                f"a chamfer of {width:g} mm takes all of {name} of part {part.name}, which is {depth:g} mm "
                "deep; make it narrower"
            )
        details.append(Chamfer(f"edge-{name}", loop, side, width))
    return replace(part, details=tuple(details))


def _edges(part: Part) -> Iterator[tuple[str, Loop, Side, float]]:
    """Name, loop and side of every edge of the top face, and the depth of the wall below it, mm."""
    import shapely

    assert part.outline is not None  # noqa: S101 - only plates have edges
    yield "outside", part.outline.outer, "outside", part.thickness
    recesses = [feature for feature in blind(part) if feature.top <= TOLERANCES.closure]
    views = {feature.name: plan_view(feature) for feature in recesses}

    def in_another(loop: Loop, name: str = "") -> bool:
        ring = shapely.LinearRing(loop.flatten())
        return any(shapely.contains(view, ring) for other, view in views.items() if other != name)

    for number, loop in enumerate(part.outline.inner, start=1):
        if not in_another(loop):
            yield _name(part, loop) or f"opening-{number}", loop, "inside", part.thickness
    for feature in recesses:
        for name, loop, side in _loops(feature):
            if not in_another(loop, feature.name):
                yield name, loop, side, feature.depth


def _name(part: Part, loop: Loop) -> str:
    """The name of the feature that makes an opening; nothing if that is not told."""
    arc = loop.segments[0]
    for feature in part.features:
        if isinstance(feature, Profile) and feature.loop == loop:
            return feature.name
        if not (isinstance(feature, Bore) and loop.is_circle and isinstance(arc, Arc)):
            continue
        if math.dist(arc.centre, feature.centre) <= TOLERANCES.closure:
            return feature.name
    return ""


def _loops(feature: Feature) -> Iterator[tuple[str, Loop, Side]]:
    match feature:
        case Bore():
            yield feature.name, Loop((circle(feature.centre, feature.diameter / 2),)), "inside"
        case Profile():
            yield feature.name, feature.loop, feature.side
        case Pocket():
            yield feature.name, feature.boundary, "inside"
            for number, island in enumerate(feature.islands, start=1):
                yield f"{feature.name}-island-{number}", island, "outside"
