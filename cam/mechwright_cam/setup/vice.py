"""A vice on two finished edges of the stock: where its jaws may be.

The jaws grip the part's own edges, a given height above the underside, and stand in the way of what is cut
deeper than their tops. So they are only as wide as what is not milled there; the cutter passes beside them.
"""

import math
from typing import TYPE_CHECKING, Literal

import shapely

from mechwright.contracts.part import Bore, Part, Profile
from mechwright.contracts.sections import plan_view, sections
from mechwright.errors import DesignError
from mechwright.tolerances import TOLERANCES
from mechwright_cam.setup.holding import Jaw
from mechwright_cam.setup.views import SKIN
from mechwright_plane.offsets import filled, opened

if TYPE_CHECKING:
    from mechwright_cam.setup.job import Job

REACH = 100.0
"""How far a jaw and the vice behind it reach outwards, mm: further than any cutter runs out."""

FILM = TOLERANCES.leftover / 4
"""Half the thickness of stock beside a finished edge that is not milled, mm: half of what may be left."""

CLAMP_GAP = 1.0
"""Least distance of the cutter from clamp and jaws, mm."""

RUN_OUT = 1.0
"""Finishing runs on past the last of the stock so far, mm, before it leaves the wall."""

LEAST_JAW = 10.0
"""Jaws narrower than this do not keep a part from turning, mm."""

LEAST_GRIP = 1 / 3
"""Jaws grip at least this share of the part's length: what hangs out on a side is no longer than they are."""

PAIRS: dict[tuple[str, str], Literal["x", "y"]] = {("front", "rear"): "x", ("left", "right"): "y"}
"""Edges that a vice grips, and the axis along which its jaws lie."""
INWARD = {"front": (0.0, SKIN), "rear": (0.0, -SKIN), "left": (SKIN, 0.0), "right": (-SKIN, 0.0)}
"""A way from each edge that just enters the part, mm."""


def can_be_clamped(part: Part) -> bool:
    """Whether the part has a bore or an opening for a clamp."""
    return any(isinstance(f, Bore) or (isinstance(f, Profile) and f.side == "inside") for f in part.features)


def gripping_height(job: "Job") -> float:
    """Height of the jaws' tops over the underside, mm."""
    grip = job.settings.hold.grip
    return job.thickness / 2 if grip is None else grip


def lay_jaws(job: "Job", widest: float) -> tuple[Jaw, Jaw]:
    """Place the jaws of a vice on two opposite finished edges, where no cutter goes as deep as they are.

    ``widest`` is the diameter of the widest end mill, mm. Raises DesignError where there are no such edges,
    or they are too short for what is milled beside them.
    """
    height = gripping_height(job)
    if height > job.thickness:
        raise DesignError(
            f"cam.hold.grip: jaws of {height:g} mm stand above part {job.part.name}, which is "
            f"{job.thickness:g} mm thick; use at most its thickness"
        )
    found: list[tuple[float, float, Literal["x", "y"], tuple[str, str]]] = []
    for edges, axis in PAIRS.items():
        if set(edges) <= set(job.settings.stock.finished):
            for low, high in _free(job, edges, axis, height, widest) or [(0.0, 0.0)]:
                found.append((high - low, low, axis, edges))
    if not found:
        raise DesignError(
            "cam.hold.method: a vice grips two opposite finished edges; list front and rear, or left and "
            "right, in cam.stock.finished, and let the part have a straight wall at both"
        )
    length, low, axis, edges = max(found, key=lambda one: one[0])
    near, far = _span(job.stock, axis)
    least = max(LEAST_JAW, LEAST_GRIP * (far - near))
    wanted = job.settings.hold.jaw_width
    limit = length if wanted is None else min(wanted, length)
    if limit < least:
        if wanted is not None and wanted < least <= length:
            cures = [f"let jaw_width be at least {least:.1f} mm"]
        else:
            finer = max((high - low for low, high in _free(job, edges, axis, height, 0.0)), default=0.0)
            cures = ["use a smaller cutter"] if finer > least else []
            if can_be_clamped(job.part):
                cures.append('use method = "bore"')
            cures.append('leave finished out and use method = "tabs"')
        raise DesignError(
            f"cam.hold.method: the jaws of a vice get {limit:.1f} mm on the {edges[0]} and {edges[1]} edges "
            f"of part {job.part.name} and need {least:.1f} mm; {', or '.join(cures)}"
        )
    if wanted is not None and wanted > length:
        raise DesignError(
            f"cam.hold.jaw_width: beside what is milled there is room for jaws of {length:.2f} mm on the "
            f"{edges[0]} and {edges[1]} edges of part {job.part.name}, not for {wanted:g} mm"
        )
    first = low + (length - limit) / 2
    top = height - job.thickness
    one, two = (_jaw(job, edge, first, first + limit, top) for edge in edges)
    return one, two


def _jaw(job: "Job", edge: str, first: float, last: float, top: float) -> Jaw:
    x0, y0, x1, y1 = job.stock
    match edge:
        case "front":
            shape, face = shapely.box(first, y0 - REACH, last, y0), [(first, y0), (last, y0)]
        case "rear":
            shape, face = shapely.box(first, y1, last, y1 + REACH), [(first, y1), (last, y1)]
        case "left":
            shape, face = shapely.box(x0 - REACH, first, x0, last), [(x0, first), (x0, last)]
        case _:
            shape, face = shapely.box(x1, first, x1 + REACH, last), [(x1, first), (x1, last)]
    return Jaw(edge, shape, shapely.LineString(face), top)


def _free(
    job: "Job", edges: tuple[str, str], axis: Literal["x", "y"], height: float, widest: float
) -> list[tuple[float, float]]:
    """Stretches along two edges that the part touches with both, and that no cutter comes near to."""
    lower, upper = _span(job.stock, axis)
    barred = shapely.union_all(_barred(job, height, widest))
    free = shapely.LineString([(lower, 0.0), (upper, 0.0)])
    for edge in edges:
        jaw, inward = _jaw(job, edge, lower, upper, 0.0), INWARD[edge]
        line = shapely.transform(jaw.face, lambda points, by=inward: points + by)
        # The whole part touches the jaw, not the stock beside it: all layers that are as low as the jaw.
        for layer in sections(job.part):
            if layer.bottom > job.thickness - height:
                shape = shapely.transform(layer.shape, lambda points: points - job.origin)
                free = shapely.intersection(free, _level(shapely.intersection(line, shape), axis))
        free = shapely.difference(free, _level(shapely.intersection(jaw.shape, barred), axis))
    lines = [line for line in shapely.get_parts(free) if line.geom_type == "LineString" and line.length > 0]
    return [(float(line.bounds[0]), float(line.bounds[2])) for line in lines]


def _span(box: tuple[float, float, float, float], axis: Literal["x", "y"]) -> tuple[float, float]:
    """From where to where a box reaches along an axis."""
    return (box[0], box[2]) if axis == "x" else (box[1], box[3])


def _level(shape: shapely.Geometry, axis: Literal["x", "y"]) -> shapely.Geometry:
    """How far the pieces of a shape reach along an axis, laid on the axis X."""
    spans = (_span(piece.bounds, axis) for piece in shapely.get_parts(shape))
    return shapely.union_all([shapely.LineString([(a, 0.0), (b, 0.0)]) for a, b in spans if b > a])


def surrounding_stock(plate: shapely.Geometry, target: shapely.Geometry) -> shapely.Geometry:
    """What of a plate lies around the parts; not the film that chords leave where both have one edge."""
    return opened(shapely.difference(plate, filled(target)), FILM)


def _barred(job: "Job", height: float, widest: float) -> list[shapely.Geometry]:
    """What cutters may cross while they are deeper than the jaws' tops."""
    plate = shapely.box(*job.stock)
    away = surrounding_stock(plate, job.target)
    # Roughing stays within a diameter of what it takes. Finishing runs on past the stock and leaves the wall
    # on a quarter circle: one radius along the wall, and one is the cutter's own.
    reach = widest + math.sqrt(RUN_OUT * (widest + RUN_OUT)) + CLAMP_GAP
    shapes = [away]
    for feature in job.inner:
        if feature.top + feature.depth > job.thickness - height:
            view = plan_view(feature)
            if not shapely.contains_properly(plate, view):  # it is open there, and the cutter runs out
                shapes.append(view)
    return [shapely.buffer(shape, reach, quad_segs=32) for shape in shapes if not shapely.is_empty(shape)]
