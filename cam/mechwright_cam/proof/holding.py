"""What holds the part when everything is cut, and what comes loose in its openings."""

import numpy as np
import shapely

from mechwright.contracts.part import Profile
from mechwright.geometry.prepared import prepared
from mechwright_cam.proof.bands import bands, stock_shape
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.plane import Shape, grow, swept
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import Scene
from mechwright_cam.proof.sweep import Sweep, Sweeps
from mechwright_cam.setup.job import Job
from mechwright_cam.setup.views import inside_of

BRIDGE = 0.02
"""Accuracy of the areas here, mm: a bridge thinner than that holds nothing."""
JAMS = 1.0
"""A loose piece wider than this is worth a remark, mm: it can be caught between cutter and part."""


TOUCHES = 0.002
"""The part touches a jaw where it is so near to its face, mm: the chords of its outline, and rounding."""
BEARS = 0.95
"""Share of a jaw's face that the part has to touch, at every height of the jaw."""


def holding(scene: Scene) -> Check:
    """The tabs join the part to a frame, or the jaws of the vice grip it."""
    job = scene.job
    if job.jaws:
        return _gripped(job)
    if not job.tabs:
        return Check(True, "the part is held by a clamp or from below")
    cut = scene.sweeps.through(job.thickness)
    free = None if _rim_is_whole(cut, job) else _free_tab(cut, job)
    if free is not None:
        message = (
            f"the tab at X{free.x:.1f} Y{free.y:.1f} leads to no frame: the cut around the part "
            "leaves none; give the stock a larger margin"
        )
        return Check(False, message)
    return Check(True, "the tabs join the part to the frame")


def _gripped(job: Job) -> Check:
    """Whether the finished part touches both jaws of the vice all over, from the underside to their tops."""
    for jaw in job.jaws:
        for band in bands(job, (jaw.top,)):
            if band.top > jaw.top + NEAR:
                continue
            touched = shapely.intersection(jaw.face, grow(band.keep, TOUCHES, TOUCHES / 4))
            if touched.length < BEARS * jaw.face.length:
                message = (
                    f"the {jaw.edge} jaw of the vice is {jaw.face.length:.1f} mm wide, and the part touches "
                    f"{touched.length:.1f} mm of it at Z{band.bottom:.2f}; grip it lower, or elsewhere"
                )
                return Check(False, message)
    return Check(True, "the part stays between the jaws of the vice")


def _rim_is_whole(cut: list[Sweep], job: Job) -> bool:
    """Whether nothing cuts the plate's edge or the way from any tab to it: the usual case, found quickly."""
    plate = stock_shape(job)
    ways = [shapely.shortest_line(tab.shape, plate.exterior) for tab in job.tabs]
    for sweep in cut:
        for way in ways if sweep.stays_inside(plate) else [plate.exterior, *ways]:
            way = prepared(way)
            if shapely.dwithin(way, sweep.beside(way), sweep.radius).any():
                return False
    return True


def _swept(cut: list[Sweep], region: Shape) -> list[Shape]:
    """What is cut away of a region, roughly."""
    region = prepared(region)
    shapes: list[Shape] = []
    for sweep in cut:
        chains = sweep.beside(region)
        near = chains[shapely.dwithin(region, chains, sweep.radius)]
        shapes.append(swept(near, sweep.radius, BRIDGE))
    return shapes


def _free_tab(cut: list[Sweep], job: Job) -> shapely.Point | None:
    """A tab that ends in nothing, if there is one.

    Without the tabs and the scraps beside them, the piece at the outer end of each has to be one that another
    tab ends in as well: that is a frame.
    """
    plate = stock_shape(job)
    scrap = max((sweep.radius for sweep in cut), default=0.0)  # the round end of a cut beside a tab
    tabs = [grow(tab.shape, scrap, BRIDGE) for tab in job.tabs]
    pieces = shapely.get_parts(shapely.difference(plate, shapely.union_all([*_swept(cut, plate), *tabs])))
    inside = shapely.point_on_surface(shapely.get_parts(job.target))
    others = pieces[~shapely.intersects(pieces[:, None], inside).any(axis=1)]
    ends = np.array([shapely.dwithin(others, tab, BRIDGE) for tab in tabs]).reshape(len(tabs), len(others))
    frame = ends.sum(axis=0) >= 2
    for tab, row in zip(job.tabs, ends, strict=True):
        if not (row & frame).any():
            return tab.shape.centroid
    return None


def loose(sweeps: Sweeps, job: Job) -> list[str]:
    """Remarks on what falls out of openings that are cut along their edge only."""
    cut, remarks = sweeps.through(job.thickness), []
    for feature in job.features:
        through = feature.top + feature.depth >= job.thickness - NEAR
        if not through or (isinstance(feature, Profile) and feature.side == "outside"):
            continue
        opening = inside_of(feature)
        rest = shapely.get_parts(shapely.difference(opening, shapely.union_all(_swept(cut, opening))))
        free = rest[shapely.distance(rest, opening.exterior) > BRIDGE]
        for piece in free[~shapely.is_empty(shapely.buffer(free, -JAMS / 2, quad_segs=4))].tolist():
            remarks.append(
                f"a piece of {piece.area:.1f} mm² comes loose in {feature.name}; stop to take it out"
            )
    return remarks
