"""The walls of a part as the posted program leaves them.

What has to stay at the foot of each layer (``target``: the part, and the corners that no cutter enters) is
followed all around; at each place the wall stands where the nearest path ends it. Cut least is a layer at its
foot, so that is where the wall stands out most. Beside a tab it is taken above the tab, which is cut off and
dressed by hand. A round bore is followed on its own circle, for a drill reaches what a mill does not.
"""

from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.contracts.made_part import MadeRing, MadeSection
from mechwright.contracts.part import Bore
from mechwright.geometry.prepared import prepared
from mechwright.tolerances import TOLERANCES
from mechwright_cam.controls.reading.run import Ints
from mechwright_cam.proof.bands import Band
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.plane import Shape
from mechwright_cam.proof.point_segment_distance import Chords
from mechwright_cam.proof.rings import Ring, circle_ring, rings_of
from mechwright_cam.proof.scene import Scene
from mechwright_cam.proof.sweep import Sweep, Sweeps
from mechwright_cam.proof.target_shape import TargetShape
from mechwright_cam.proof.unreachable_stock import VISIBLE
from mechwright_cam.proof.wall import HINTED
from mechwright_cam.shop.tool import MILLS, ToolKind

CHORD = 2e-5
"""Chord error of the paths that the walls are measured from, mm: a fiftieth of a micrometre."""
EDGE = 1e-3
"""A wall so near to the edge of the stock is that edge, mm: nothing cuts it."""
ON_CIRCLE = 4 * TOLERANCES.flatten
"""A hole of the part is a bore's own if its corners are so near to the bore's circle, mm."""


@dataclass(frozen=True)
class Tools:
    """What is cut at one height: radius, mm, and the paths of it."""

    cuts: list[tuple[float, Chords]]

    @classmethod
    def of(cls, groups: list[Sweep]) -> "Tools":
        """The paths of sweeps in fine chords."""
        return cls([(group.radius, fine_chords(group)[0]) for group in groups])

    def off(self, points: Array, outward: Array) -> Array:
        """Distance (k,) from each place to the nearest disc, mm, negative inside of one."""
        off = self.off_along_wall(points, outward)
        far = np.flatnonzero(off > TOLERANCES.leftover)
        for radius, chords in self.cuts:
            if far.size:
                off[far] = np.minimum(off[far], chords.distance(points[far]) - radius)
        return off

    def off_along_wall(self, points: Array, outward: Array) -> Array:
        """The same where a path runs beside the wall, inf elsewhere."""
        off = np.full(len(points), np.inf)
        for radius, chords in self.cuts:
            hints = points + radius * outward
            off = np.minimum(off, chords.hinted_distance(points, hints, HINTED) - radius)
        return off


def fine_chords(group: Sweep) -> tuple[Chords, Ints]:
    """The paths of a sweep in fine chords, and the piece (k,) that each belongs to."""
    points, owner = group.paths.points(group.pieces, CHORD)
    same = owner[:-1] == owner[1:]
    return Chords(points[:-1][same], points[1:][same]), owner[:-1][same]


def wall_sweeps(scene: Scene) -> Sweeps:
    """What the cutters that make walls sweep: chamfers and threads are cut into walls that stand already."""
    makers = {*MILLS, ToolKind.DRILL, ToolKind.REAMER}
    if {tool.kind for tool in scene.paths.tools.values()} <= makers:
        return scene.sweeps
    return Sweeps(scene.paths.of_kinds(makers))


def as_made_sections(scene: Scene, sweeps: Sweeps) -> list[MadeSection]:
    """All cross-sections from the top of the plate down, in work coordinates, tabs cut off.

    Depths are below the upper face of the setup. ``off`` is inf where nothing has cut.
    """
    if not scene.paths.mills:
        return []
    target = TargetShape(scene.job, scene.paths.mills)
    found: list[MadeSection] = []
    for number in dict.fromkeys(band.section for band in target.bands):
        places = [place for place, band in enumerate(target.bands) if band.section == number]
        runs = np.split(places, np.flatnonzero(np.diff(places) > 1) + 1)
        found += [_section(scene, sweeps, target, run.tolist()) for run in runs]
    return sorted(found, key=lambda section: section.top)


def _section(scene: Scene, sweeps: Sweeps, target: TargetShape, places: list[int]) -> MadeSection:
    """One cross-section, from layers that follow on each other, from the top down."""
    job, layers = scene.job, target.bands
    foot = places[-1]
    band = layers[foot]
    level, groups = sweeps.foot(band.bottom, job.thickness)
    rings = rings_here(scene, target.rest(foot, level), band)
    tools = Tools.of(groups)
    aside = target.tab_lift_area(foot)
    above = next((p for p in reversed(places) if target.tab_lift_area(p) is None), None)
    over = None
    if aside is not None and above is not None:
        over = Tools.of(sweeps.foot(layers[above].bottom, job.thickness)[1])
    made = [_made(ring, band, tools, over, aside, scene) for ring in rings]
    return MadeSection(-layers[places[0]].top, -band.bottom, tuple(made))


def rings_here(scene: Scene, rest: Shape, band: Band) -> list[Ring]:
    """The walls of what has to stay, round bores on their circles."""
    holes = [shapely.Polygon(hole) for part in shapely.get_parts(band.keep) for hole in part.interiors]
    own: list[Bore] = []
    for feature in scene.job.features:
        if not isinstance(feature, Bore):
            continue
        if -feature.top < band.top - NEAR or -(feature.top + feature.depth) > band.bottom + NEAR:
            continue
        for hole in holes:
            away = np.hypot(*(shapely.get_coordinates(hole) - feature.centre).T)
            if np.abs(away - feature.diameter / 2).max() < ON_CIRCLE:
                own.append(feature)
                break
    plugs = [shapely.Point(bore.centre).buffer(bore.diameter / 2 + 2 * TOLERANCES.leftover) for bore in own]
    closed = shapely.union_all([rest, *plugs]) if plugs else rest
    return [*rings_of(closed), *(circle_ring(bore.centre, bore.diameter / 2) for bore in own)]


def _made(
    ring: Ring, band: Band, tools: Tools, over: Tools | None, aside: Shape | None, scene: Scene
) -> MadeRing:
    points, outward = ring.points, ring.outward
    off = tools.off(points, outward)
    if aside is not None:
        beside = np.flatnonzero(_in(aside, points))
        if beside.size:
            off[beside] = 0.0 if over is None else over.off(points[beside], outward[beside])
    x0, y0, x1, y1 = scene.job.stock
    least, most = np.array((x0 + EDGE, y0 + EDGE)), np.array((x1 - EDGE, y1 - EDGE))
    off[~((points > least) & (points < most)).all(axis=1)] = 0.0
    corner = ~shapely.dwithin(prepared(shapely.boundary(band.keep)), shapely.points(points), VISIBLE)
    shift = np.where(np.isfinite(off), off, 0.0)
    return MadeRing(points + shift[:, None] * outward, outward, off, corner)


def _in(shape: Shape, points: Array) -> NDArray[np.bool_]:
    inside: NDArray[np.bool_] = shapely.contains_xy(prepared(shape), points[:, 0], points[:, 1])
    return inside
