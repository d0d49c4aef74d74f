"""The edges of a plate's top face, broken."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Literal

from mechwright.contracts.details import Chamfer
from mechwright.contracts.part import Bore, Feature, Part, Pocket, Profile
from mechwright.contracts.sections import plan_view
from mechwright.errors import GeometryError
from mechwright.geometry import Loop, circle
from mechwright.tolerances import TOLERANCES

Side = Literal["outside", "inside"]


def deburred(part: Part, width: float) -> Part:
    """The plate with all edges of its top face broken at 45 degrees, ``width`` mm wide.

    Edges that have a chamfer keep it. What starts below the top face, or in the middle of a recess, has no
    edge there.

    Raises
    ------
    GeometryError
        A recess, or the plate, is no deeper than the chamfer.

    Examples
    --------
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

    at_top = [feature for feature in part.features if feature.top <= TOLERANCES.closure]
    taken = [(feature, plan_view(feature)) for feature in at_top if not _is_outside(feature)]
    for feature in at_top:
        depth = min(feature.depth, part.thickness)
        for name, loop, side in _loops(feature):
            ring = shapely.LinearRing(loop.flatten())
            others = (view for other, view in taken if other is not feature)
            if not any(shapely.contains(view, ring) for view in others):
                yield name, loop, side, depth


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


def _is_outside(feature: Feature) -> bool:
    return isinstance(feature, Profile) and feature.side == "outside"
