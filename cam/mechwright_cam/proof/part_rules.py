"""Rules about what becomes of the part: nothing is cut that should stay, and nothing stays that should go."""

import math

from mechwright.tolerances import TOLERANCES
from mechwright_cam.proof.details import missing
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import Scene


def gouge(scene: Scene) -> Check:
    """The cutter stays out of the finished part."""
    cut, limit = scene.gouge, TOLERANCES.gouge
    if cut is None or cut.depth <= limit:
        depth = cut.depth if cut else 0.0
        return Check(True, "the cutter stays out of the finished part", value=depth, limit=limit, unit="mm")
    message = f"cuts {cut.depth:.3f} mm into the finished part, the limit is {limit:g} mm"
    return scene.bad(cut.step, message, cut.depth, limit, "mm", cut.at)


def tabs(scene: Scene) -> Check:
    """The tabs remain."""
    cut, limit, count = scene.in_tab, TOLERANCES.gouge, len(scene.job.tabs)
    if not count:
        return Check(True, "there are no tabs")
    if cut is None or cut.depth <= limit:
        return Check(True, f"all {count} tabs remain")
    message = f"cuts {cut.depth:.3f} mm into a tab that holds the part, the limit is {limit:g} mm"
    return scene.bad(cut.step, message, cut.depth, limit, "mm", cut.at)


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
    return Check(False, message, None, left.reachable, limit, "mm", left.at)


def details(scene: Scene) -> Check:
    """Every chamfer, thread and engraving is there."""
    lacking = missing(scene.paths, scene.job)
    return Check(not lacking, lacking or "chamfers, threads and engravings are cut")
