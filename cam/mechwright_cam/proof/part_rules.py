"""Rules about what becomes of the part: nothing is cut that should stay, and nothing stays that should go."""

import math

import numpy as np
import shapely

from mechwright.contracts.details import Thread
from mechwright.contracts.part import Profile
from mechwright.geometry.prepared import prepared
from mechwright.tolerances import TOLERANCES
from mechwright_cam.proof.bands import floor_of, stock_shape
from mechwright_cam.proof.details import missing
from mechwright_cam.proof.overcut import with_extent
from mechwright_cam.proof.paths import NEAR, Paths, Pieces
from mechwright_cam.proof.plane import Shape, grow
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import Scene
from mechwright_cam.proof.sweep import ROUNDING
from mechwright_cam.proof.thread_turns import LEADS, off_helix


def gouge(scene: Scene) -> Check:
    """The cutter stays out of the finished part."""
    cut, limit = scene.gouge, TOLERANCES.gouge
    if cut is None or cut.depth <= limit:
        depth = cut.depth if cut else 0.0
        return Check(True, "the cutter stays out of the finished part", value=depth, limit=limit, unit="mm")
    message = f"cuts {cut.depth:.3f} mm into the finished part, the limit is {limit:g} mm"
    if scene.misfit:
        message = f"{scene.misfit}, and {message}"
    return with_extent(scene.bad(cut.step, message, cut.depth, limit, "mm", cut.at), scene, cut)


def leftover(scene: Scene) -> Check:
    """No stock stays where a cutter of the program could go."""
    left, limit = scene.remains, TOLERANCES.leftover
    if left.reachable <= limit or left.at is None:
        found = "no stock is left that the cutters could reach"
        return Check(True, found, value=left.reachable, limit=limit, unit="mm")
    x, y, z = left.at
    found = (
        f"{left.reachable:.3f} mm of stock stay" if math.isfinite(left.reachable) else "the stock stays whole"
    )
    where = "where a cutter of the program could go"
    if left.bore is not None:
        where = f"on the wall of {left.bore.name}, which is to be cut to {left.bore.diameter:g} mm"
    message = f"{found} {where}, the limit is {limit:g} mm, at X{x:.3f} Y{y:.3f} Z{z:.3f}"
    if scene.misfit:
        message = f"{scene.misfit}, and {message}"
    return Check(False, message, None, left.reachable, limit, "mm", left.at)


def details(scene: Scene) -> Check:
    """Every chamfer, thread and engraving is there, and no thread is cut where its mill should not."""
    lacking = missing(scene.paths, scene.job)
    if lacking:
        return Check(False, lacking)
    for thread in (detail for detail in scene.job.details if isinstance(detail, Thread)):
        found, limit = off_helix(scene.paths, thread), LEADS * thread.pitch
        if found is None or found[1] <= limit:
            continue
        step, deep, at = found
        tool = scene.tools[int(scene.run.tool[step])]
        message = (
            f"T{tool.number} ({tool.name}) cuts {deep:.2f} mm into the turns of {thread.name}, off its "
            f"helix, the limit is {limit:.2f} mm; go down and up at the axis, and round on the helix alone"
        )
        return scene.bad(step, message, deep, limit, "mm", at)
    return Check(True, "chamfers, threads and engravings are cut")


AT_ONCE = 64
"""So many of the deepest moves are asked first whether they cut a feature."""
AROUND_OUTSIDE = 0.5
"""The cut around an outside is looked for so near to it, mm: half of the least frame between two channels."""
ROUGHLY_AROUND = 0.01
"""Accuracy of that, mm."""


def depth(scene: Scene) -> Check:
    """Every feature is cut down to its floor, somewhere at least; the rest is for the leftover check."""
    paths, job = scene.paths, scene.job
    for feature in job.features:
        floor = -min(feature.top + feature.depth, job.thickness)
        shape = floor_of(feature, job)
        if isinstance(feature, Profile) and feature.side == "outside":
            # At its own wall: further away, in a nest, are the cuts around its neighbours.
            around = shapely.intersection(grow(shape, AROUND_OUTSIDE, ROUGHLY_AROUND), stock_shape(job))
            shape = shapely.difference(around, shape)
        if shape.is_empty or shape.area <= NEAR:
            continue
        shape = prepared(shape)
        low = lowest_cut(paths, paths.below(floor + ROUNDING, steps=paths.cuts), shape)
        if low > floor + ROUNDING:
            low = lowest_cut(paths, paths.below(-NEAR, steps=paths.cuts), shape)
        if low > floor + ROUNDING:
            message = f"{feature.name} is cut down to Z{low:.3f}, its floor is at Z{floor:.3f}"
            if scene.misfit:
                message = f"{scene.misfit}, and nothing cuts at the wall of {feature.name}"
            return Check(False, message, None, low, floor, "mm")
    return Check(True, "every feature is cut to its full depth")


def lowest_cut(paths: Paths, pieces: Pieces, shape: Shape) -> float:
    """Lowest z at which any piece, all of them below the top, cuts into a shape; 0 if none does."""
    order, some, begin = np.argsort(pieces.low, kind="stable"), AT_ONCE, 0
    while begin < order.size:  # the lowest first: one of them nearly always does
        few = pieces.only(order[begin : begin + some])
        # The disc has to enter the feature, not to touch it: a bore beside an edge is not its neighbour's.
        radius = np.maximum(paths.radius[few.step] - NEAR, NEAR)
        near = np.flatnonzero(shapely.dwithin(shape, paths.lines(few), radius))
        if near.size:
            return float(few.low[near[0]])
        begin, some = begin + some, 4 * some
    return 0.0
