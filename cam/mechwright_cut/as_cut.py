"""The parts as their programs leave them, and whether the mechanism runs with them.

Walls are measured from the text: a wall stands half a kerf beside the way of the beam. Holes that are reamed,
drilled or given a bush afterwards count as drawn. What the process strays by besides is no part of this: it
is the tolerance that ``[tolerances]`` takes.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import shapely

from mechwright.arrays import turned
from mechwright.contracts.as_made import AsMade
from mechwright.contracts.finding import Stage, at_stage
from mechwright.contracts.made_part import MadePart, MadeRing, MadeSection
from mechwright.geometry import Loop
from mechwright.pipeline import Build
from mechwright.pipeline.process import plates_of
from mechwright.tolerances import TOLERANCES
from mechwright_cut.cutting import Cutting, ProvenCut
from mechwright_cut.jobs import CutPiece
from mechwright_cut.proof.reading import read_beam
from mechwright_cut.proof.swept import runs, way

CORNER = TOLERANCES.leftover
"""Where more than this stays, mm, a round beam does not come: the proof has found no other such place."""


def as_cut(build: Build) -> AsMade:
    """What the family says of the parts as cut; nothing where a wire or another process makes a plate."""
    cutting = build.made(Cutting)
    copies: dict[str, list[MadePart]] = {}
    for one in cutting.programs:
        if one.suffix != ".iso":
            for part in parts_as_cut(one):
                copies.setdefault(part.name, []).append(part)
    if copies.keys() != {part.name for part in plates_of(build.parts)}:
        return AsMade()
    design = build.design
    said = design.family.as_made(design.params, copies)
    return replace(said, findings=tuple(at_stage(Stage.OUTPUT, said.findings)))


def parts_as_cut(item: ProvenCut) -> Iterator[MadePart]:
    """The pieces of a sheet as its text leaves them, each in its own coordinates."""
    control = "grbl-laser" if item.suffix == ".nc" else "linuxcnc-beam"
    mark = 0.0 if item.job.process.name == "plasma" else item.job.settings.marking[0]
    lit = [m for m in read_beam(item.text, control).motions if m.power == 0 or m.power > mark]
    ways = shapely.union_all([way(run) for run in runs(lit)])
    shapely.prepare(ways)
    for piece in item.job.pieces:
        part = piece.cut.part
        assert part.outline is not None  # noqa: S101 - plates alone are cut
        cut = set(piece.cut.outline.loops)
        rings = tuple(
            _ring(loop, piece, ways if loop in cut else None, item.job.kerf.width)
            for loop in part.outline.loops
        )
        section = MadeSection(0.0, part.thickness, rings)
        yield MadePart(part.name, piece.label, TOLERANCES.gouge, (section,))


def _ring(loop: Loop, piece: CutPiece, ways: shapely.Geometry | None, kerf: float) -> MadeRing:
    """A wall; as drawn where no beam makes it."""
    points = loop.flatten()
    along = np.roll(points, -1, axis=0) - np.roll(points, 1, axis=0)
    # The material lies on the left of a loop, so that its right points off it.
    outward = np.column_stack((along[:, 1], -along[:, 0])) / np.hypot(*along.T)[:, None]
    off = np.zeros(len(points))
    if ways is not None:
        places = np.add(turned(points, piece.angle), (piece.x, piece.y))
        off = shapely.distance(shapely.points(places), ways) - kerf / 2
    corner = off > CORNER
    off = np.where(corner, 0.0, off)
    return MadeRing(points + off[:, None] * outward, outward, off, corner)
