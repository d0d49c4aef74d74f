"""Chamfers, threads and engravings: what their tools may cut of the part, and whether they did.

A cone that runs along a chamfer touches it all over, so two heights decide: at the top face the cone may
reach the edge less the chamfer, and at the chamfer's foot the edge itself. In between both are straight.
"""

import math

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright.contracts.details import CORE_PLAY, Chamfer, Detail, Engraving, Thread
from mechwright.tolerances import TOLERANCES
from mechwright_cam.proof.bands import Band
from mechwright_cam.proof.fillets import Fillet
from mechwright_cam.proof.gouge import Gouge, deepest_cut
from mechwright_cam.proof.paths import NEAR, Paths
from mechwright_cam.proof.plane import Shape, closing, grow
from mechwright_cam.proof.sweep import Sweeps
from mechwright_cam.proof.thread_turns import FITS, unthreaded
from mechwright_cam.proof.wall import Wall
from mechwright_cam.setup.depths import core_of, makes, tapped_deep
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import ToolKind

OWN = {
    Chamfer: (ToolKind.CHAMFER,),
    Engraving: (ToolKind.CHAMFER,),
    Thread: (ToolKind.THREAD_MILL, ToolKind.TAP, ToolKind.DRILL),
}
"""Which kinds of tool may cut which detail; a drill takes of a tapped thread what its core may be wider."""
EDGE_SPACING = 0.2
"""Distance of the places along an edge or a stroke at which its cut is measured, mm."""
FINE = 24
"""A fillet is looked at, at so many heights, for what is not as a mill: in between it is within 0.1 % of its
radius of both."""
BESIDE_CORNER = 0.003
"""A place of a chamfer this near to what its cutter cannot reach is not asked for, mm."""

BELOW = 0.3
"""By so much a pointed tool's tip may stand below a chamfer, mm; what it leaves in corners then may stay."""


def heights(job: Job) -> tuple[float, ...]:
    """Heights z at which the details end, mm."""
    depths = {_depth(detail, kind, job) for detail in job.details for kind in OWN[type(detail)]}
    return tuple(max(-depth, -job.thickness) for depth in depths)


def deepest(paths: Paths, job: Job, bands: list[Band]) -> list[Gouge | None]:
    """The deepest cut into each band: the tools of details may cut those, all others nothing."""
    others, special = _by_tool(paths, job)
    found = []
    for band in bands:
        found.append(deepest_cut(others, band.keep, band.top, -job.thickness))
        for kind, own, details in special:
            given = [
                _given(detail, kind) for detail in details if band.top > -_depth(detail, kind, job) + NEAR
            ]
            keep = shapely.difference(band.keep, shapely.union_all(given)) if given else band.keep
            found.append(deepest_cut(own, keep, band.top, -job.thickness))
    return found


def deepest_in_fillet(paths: Paths, job: Job, fillet: Fillet) -> list[Gouge | None]:
    """The deepest cut into a fillet; where a detail takes some of it, its tool may.

    A chamfer goes on over the mouth of a recess, and takes the upper end of the fillet there.
    """
    others, special = _by_tool(paths, job)
    found = [fillet.deepest(others)]
    for kind, own, details in special:
        for z in fillet.heights_in(FINE) if own.steps.size else ():
            given = [_given(detail, kind, -z) for detail in details if _depth(detail, kind, job) > NEAR - z]
            found.append(deepest_cut(own, shapely.difference(fillet.solid(z), shapely.union_all(given)), z))
    return found


def _by_tool(paths: Paths, job: Job) -> tuple[Paths, list[tuple[ToolKind, Paths, list[Detail]]]]:
    """The moves of tools that may cut no detail; each other kind, its moves and the details for it."""
    if not job.details:
        return paths, []
    own: dict[ToolKind, list[Detail]] = {}
    for detail in job.details:
        for kind in OWN[type(detail)]:
            own.setdefault(kind, []).append(detail)
    others = paths.of_kinds(set(ToolKind) - own.keys())
    return others, [(kind, paths.of_kinds({kind}), own[kind]) for kind in sorted(own)]


def _depth(detail: Detail, kind: ToolKind, job: Job) -> float:
    """How deep a kind of tool may go for a detail, mm: a tap by its chamfer deeper, a drill to its floor."""
    if isinstance(detail, Chamfer):
        return detail.width
    if not isinstance(detail, Thread) or kind is ToolKind.THREAD_MILL:
        return detail.depth
    taps, hole = [tap for tap in job.tools if makes(tap, detail)], core_of(job, detail)
    if hole is None:
        return 0.0
    if kind is ToolKind.DRILL:
        return hole.depth
    return max((tapped_deep(tap, detail) for tap in taps), default=0.0)


def _given(detail: Detail, kind: ToolKind, depth: float = 0.0) -> Shape:
    """What of the plate a detail takes so far below the top face: a chamfer less and less."""
    match detail:
        case Chamfer():
            return grow(shapely.LinearRing(detail.loop.flatten()), detail.width - depth)
        case Thread():
            wide = detail.core + CORE_PLAY * detail.pitch if kind is ToolKind.DRILL else detail.diameter
            return grow(shapely.Point(detail.centre), wide / 2)
        case Engraving():
            return grow(shapely.MultiLineString(list(detail.strokes)), detail.width / 2)


def missing(paths: Paths, job: Job) -> str:
    """What is not there of a detail: along its whole edge, on all strokes, to the last turn; else nothing."""
    for detail in job.details:
        match detail:
            case Chamfer():
                found = _chamfer(paths, job, detail)
            case Engraving():
                found = _engraving(paths, detail)
            case Thread():
                found = "" if _tapped(paths, detail, job) else unthreaded(paths, detail)
        if found:
            return f"{detail.name}: {found}"
    return ""


def _off(paths: Paths, points: Array, height: float, level: float) -> Array:
    """Distance (n,) of points from the nearest cut of a pointed tool that goes down to ``height``, mm."""
    found = np.full(len(points), np.inf)
    for group in Sweeps(paths.of_kinds({ToolKind.CHAMFER})).at(height, level):
        found = np.minimum(found, group.chords.distance(points) - group.radius)
    return found


def _chamfer(paths: Paths, job: Job, detail: Chamfer) -> str:
    region = shapely.Polygon(detail.loop.flatten())
    width = detail.width
    if detail.side == "outside":
        keep = grow(region, -width)
    else:
        frame = shapely.box(*region.bounds).buffer(4 * width + 4)
        keep = shapely.difference(frame, grow(region, width))
    wall = Wall(closing(keep, _blunt(job, width)))
    points, _ = wall.at(wall.stations(EDGE_SPACING))
    near = shapely.dwithin(
        shapely.LinearRing(detail.loop.flatten()), shapely.points(points), width + BESIDE_CORNER
    )
    off = _off(paths, points[near], -width + TOLERANCES.arc_fit, 0.0)
    if not off.size or off.max() > TOLERANCES.leftover:
        x, y = points[near][int(np.argmax(off))] if off.size else (0.0, 0.0)
        return f"the edge is not broken to {width:g} mm at X{x:.3f} Y{y:.3f}"
    return ""


def _blunt(job: Job, width: float) -> float:
    """Greatest radius at the top face of a pointed tool that breaks an edge: it rounds inside corners so."""
    cones = [
        t.tip_diameter / 2 + (width + BELOW) * math.tan(math.radians(t.point_angle / 2))
        for t in job.tools
        if t.kind is ToolKind.CHAMFER
    ]
    return max(cones, default=0.0)


def _engraving(paths: Paths, detail: Engraving) -> str:
    lines = shapely.segmentize([shapely.LineString(stroke) for stroke in detail.strokes], EDGE_SPACING)
    points = shapely.get_coordinates(lines)
    off = _off(paths, points, -detail.depth + TOLERANCES.arc_fit, -detail.depth + TOLERANCES.leftover)
    if off.max() > TOLERANCES.leftover:
        x, y = points[int(np.argmax(off))]
        return f"the stroke is not cut {detail.depth:g} mm deep at X{x:.3f} Y{y:.3f}"
    return ""


def _tapped(paths: Paths, detail: Thread, job: Job) -> bool:
    """Whether a tap has cut a thread to its last full turn."""
    for tap in (tool for tool in job.tools if makes(tool, detail)):
        steps = paths.of_kinds({ToolKind.TAP}).steps
        steps = steps[paths.run.cutting[steps] & (paths.run.tool[steps] == tap.number)]
        ends = np.hypot(*(paths.end[steps, :2] - detail.centre).T)
        deep = paths.low[steps] <= -tapped_deep(tap, detail) + FITS
        if ((ends < FITS) & deep).any():
            return True
    return False
