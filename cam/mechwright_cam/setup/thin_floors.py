"""Floors that are left so thin that they give way under the cutter."""

from collections.abc import Iterator, Sequence

import shapely

from mechwright.contracts.finding import Finding
from mechwright.contracts.part import Feature, Part, is_outside
from mechwright.contracts.sections import plan_view
from mechwright_cam.setup.job import LEVEL

THIN_FLOOR = 0.5
"""Floors below this are told of, mm: they spring away from an end mill, which then pulls them up and tears
them. Common advice is to leave 1 mm without a support."""
WIDE_FLOOR = 1.0
"""A floor narrower than this, mm, is stiff enough."""

_Level = tuple[str, float, shapely.Geometry | None]
"""Name of a recess, its floor or its ceiling in mm below the top face, its plan view; None for a face."""


def thin_floors(part: Part, above: Sequence[Feature], below: Sequence[Feature]) -> Iterator[Finding]:
    """What stays of a part between floors cut from above and from below, or the faces, where that is thin."""
    thick = part.thickness
    floors: list[_Level] = [(f.name, f.top + f.depth, plan_view(f)) for f in above if not is_outside(f)]
    ceilings: list[_Level] = [(f.name, f.top, plan_view(f)) for f in below]
    near = [
        (floor, ceiling)
        for floor in (*floors, ("the top face", 0.0, None))
        for ceiling in (*ceilings, ("the underside", thick, None))
        if LEVEL < ceiling[1] - floor[1] < THIN_FLOOR and not (floor[2] is ceiling[2] is None)
    ]
    if not near:
        return
    whole = shapely.union_all([outline.polygon() for outline in part.outlines])
    for floor, ceiling in near:
        deeper = [view for _, z, view in floors if z > floor[1] + LEVEL]
        deeper += [view for _, z, view in ceilings if z < ceiling[1] - LEVEL]
        left = whole
        for view in (floor[2], ceiling[2]):
            left = left if view is None else shapely.intersection(left, view)
        left = shapely.difference(left, shapely.union_all(deeper))
        if not shapely.is_empty(shapely.buffer(left, -WIDE_FLOOR / 2)):
            web = ceiling[1] - floor[1]
            message = f"{web:.3g} mm of part {part.name} stay between {floor[0]} and {ceiling[0]}"
            remedy = "leave more, or support it from below while it is cut"
            yield Finding.warning("cam.thin-floor", "cam", message, web, THIN_FLOOR, "mm", remedy)
