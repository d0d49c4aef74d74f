"""The contours of a sheet in the order in which they are cut.

Marks come first, then every opening, then every line that two parts share, then every outside: small before
large, so that what is cut still hangs in as much of the sheet as possible. Among equals the next one is far
from the last, which spreads the heat.
"""

import math

import shapely

from mechwright.errors import GeometryError
from mechwright.geometry import Loop
from mechwright_cut.cuts import Contour, Role
from mechwright_cut.jobs import CutJob, CutPiece, lead_radius, target
from mechwright_cut.paths.common_lines import common_contours, outside_contour
from mechwright_cut.paths.entries import Waste, divided, entered, joint_places
from mechwright_cut.paths.parallels import beam_path
from mechwright_plane.path import polyline


def contours(job: CutJob) -> list[Contour]:
    """All contours of a sheet in order; raises GeometryError where one cannot be cut."""
    kept = shapely.union_all([target(piece) for piece in job.pieces])
    waste = Waste(kept, shapely.box(0, 0, *job.size), job.kerf.width)
    marks = [mark for piece in job.pieces for mark in _marks(job, piece)]
    inner = [
        (loop, _contour(job, loop, "inside", f"{piece.label} opening {number}", waste))
        for piece in job.pieces
        for number, loop in enumerate(piece.outline.inner, start=1)
    ]
    outer = [(piece.outline.outer, _outside(job, number, waste)) for number, piece in enumerate(job.pieces)]
    return [*marks, *_small_first(inner), *common_contours(job, waste), *_small_first(outer)]


def _outside(job: CutJob, number: int, waste: Waste) -> Contour:
    if shared := [line for line in job.common if number in line.pieces]:
        return outside_contour(job, number, shared)
    piece = job.pieces[number]
    return _contour(job, piece.outline.outer, "outside", f"{piece.label} outside", waste)


def _marks(job: CutJob, piece: CutPiece) -> list[Contour]:
    if not job.process.engraves or not piece.strokes:
        return []
    return [Contour(f"{piece.label} marks", "engrave", tuple(polyline(stroke) for stroke in piece.strokes))]


def _contour(job: CutJob, loop: Loop, role: Role, name: str, waste: Waste) -> Contour:
    settings, kerf = job.settings, job.kerf.width
    path = beam_path(loop, kerf, role == "outside", name)
    joints = settings.joints if role == "outside" and job.process.joints else 0
    overcut = 0.0 if joints else settings.overcut
    led = entered(path, loop, waste, lead_radius(settings, kerf), overcut, name)
    if not joints:
        return Contour(name, role, (led,))
    # The beam is off for the width of the joint and half a kerf on either side.
    gap = settings.joint_width + kerf
    try:
        places = joint_places(led, loop, joints, gap)
    except GeometryError as error:
        raise GeometryError(f"{name}: {error}; set cut.joints = {joints - 1}") from error
    return Contour(name, role, tuple(divided(led, places, gap)))


def _small_first(found: list[tuple[Loop, Contour]]) -> list[Contour]:
    """Small before large; among equals the farthest from the last one."""
    left = sorted(found, key=lambda pair: round(abs(pair[0].area), 6))
    ordered: list[Contour] = []
    here = (0.0, 0.0)
    while left:
        least = round(abs(left[0][0].area), 6)
        alike = [k for k, (loop, _) in enumerate(left) if round(abs(loop.area), 6) == least]
        best = max(alike, key=lambda k: (round(math.dist(here, left[k][1].start), 6), -k))
        _, contour = left.pop(best)
        ordered.append(contour)
        here = contour.start
    return ordered
