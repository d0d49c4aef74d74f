"""Every piece of the plate is held while it is cut, or out of the way; and what holds it is strong enough."""

import numpy as np
import shapely

from mechwright.geometry.prepared import prepared
from mechwright_cam.proof.bands import bands, stock_shape
from mechwright_cam.proof.finished import finished_bodies
from mechwright_cam.proof.loose_pieces import LoosePiece, milled_away, passed
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.plane import grow
from mechwright_cam.proof.refinement import refined_loose_pieces
from mechwright_cam.proof.report import Check
from mechwright_cam.proof.scene import Scene
from mechwright_cam.proof.stops import clamp_set, way_through
from mechwright_cam.proof.sweep import BRIDGE, Sweep, taken
from mechwright_cam.proof.workholding import advice
from mechwright_cam.setup.job import Job

TOUCHES = 0.002
"""The part touches a jaw where it is so near to its face, mm: the chords of its outline, and rounding."""
BEARS = 0.95
"""Share of a jaw's face that the part has to touch, at every height of the jaw."""


def holding(scene: Scene) -> Check:
    """The tabs join the part to a frame, or the jaws of the vice grip it.

    On the second side they are those of the first, and that they stay is for the rule on gouges.
    """
    job = scene.job
    if job.tabs:
        cut = scene.sweeps.through(job.thickness)
        free = None if _rim_is_whole(cut, job) else _free_tab(cut, job)
        if free is not None:
            message = (
                f"the tab at X{free.x:.1f} Y{free.y:.1f} leads to no frame: the cut around the part "
                "leaves none; give the stock a larger margin"
            )
            return Check(False, message)
    for piece in refined_loose_pieces(scene):
        failed = _judged(scene, piece)
        if failed is not None:
            return failed
    if job.jaws:
        return _gripped(job)
    if job.clamp is not None:
        return Check(True, "the part is held by its clamp before it is cut free")
    if job.side == "underside":
        if len(bodies := finished_bodies(job)) > 1:
            least = min(bodies, key=lambda body: float(body.area))
            place = least.representative_point()
            message = (
                f"the recesses of both sides cut the part into {len(bodies)} pieces, one of {least.area:.0f} "
                f"mm² at X{place.x:.1f} Y{place.y:.1f}; make those of one side less deep, or move them apart"
            )
            return Check(False, message)
        return Check(True, "the part hangs in its frame, and nothing else comes loose in the way")
    if job.settings.hold.method == "none":
        return Check(True, "every piece stays where it is held")
    return Check(True, "the tabs join the part to the frame")


def _judged(scene: Scene, piece: LoosePiece) -> Check | None:
    """The failed check of a loose piece; None if it is taken away, or lies where no cutter goes."""
    run, job, (x, y) = scene.run, scene.job, piece.place
    line = "from the start" if piece.step < 0 else f"at line {int(run.line[piece.step])}"
    if piece.is_part:
        clamp = clamp_words(scene) if job.clamp is not None else ""
        message = f"the part comes loose: nothing holds it when this is cut{clamp}; {advice(job)}"
        return scene.bad(max(piece.step, 0), message)
    step = passed(scene, piece)
    if step is None:
        return None
    message = (
        f"T{int(run.tool[step])} passes a piece of {piece.area:.0f} mm² {piece.where}, X{x:.1f} Y{y:.1f}, "
        f"that comes loose {line}; {advice(job)}, or stop with {scene.control.m(0)} and a comment to "
        "take it out"
    )
    return scene.bad(step, message)


def clamp_words(scene: Scene) -> str:
    """When the clamp is set, as far as the program says."""
    since, halt = clamp_set(scene), scene.control.m(0)
    if since < 0:
        return f", and no {halt} sets the clamp"
    early = ", where there is no way through the plate for it" if way_through(scene) > since else ""
    return f", and the clamp is set by the {halt} in line {int(scene.run.line[since])}{early}"


def remarks(scene: Scene) -> list[str]:
    """What falls out, and lies still or is taken away."""
    return [
        f"a piece of {piece.area:.0f} mm² comes loose {piece.where}, at X{piece.place[0]:.1f} "
        f"Y{piece.place[1]:.1f}; {_goes(piece)}"
        for piece in refined_loose_pieces(scene)
        if not piece.is_part and not milled_away(scene, piece) and passed(scene, piece) is None
    ]


def _goes(piece: LoosePiece) -> str:
    """What becomes of a loose piece that no cutter passes."""
    if piece.taken is None:
        return "no cutter comes near it any more"
    return f"it is taken out {'at a stop' if piece.taken >= 0 else 'when the plate is turned over'}"


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
            if shapely.dwithin(way, sweep.paths_within_radius(way), sweep.radius).any():
                return False
    return True


def _free_tab(cut: list[Sweep], job: Job) -> shapely.Point | None:
    """A tab that ends in nothing, if there is one.

    Without the tabs and the scraps beside them, the piece at the outer end of each has to be one that another
    tab ends in as well: that is a frame.
    """
    plate = stock_shape(job)
    scrap = max((sweep.radius for sweep in cut), default=0.0)  # the round end of a cut beside a tab
    tabs = [grow(tab.shape, scrap, BRIDGE) for tab in job.tabs]
    pieces = shapely.get_parts(shapely.difference(plate, shapely.union_all([*taken(cut, plate), *tabs])))
    inside = shapely.point_on_surface(shapely.get_parts(job.target))
    others = pieces[~shapely.intersects(pieces[:, None], inside).any(axis=1)]
    ends = np.array([shapely.dwithin(others, tab, BRIDGE) for tab in tabs]).reshape(len(tabs), len(others))
    frame = ends.sum(axis=0) >= 2
    for tab, row in zip(job.tabs, ends, strict=True):
        if not (row & frame).any():
            return tab.shape.centroid
    return None
