"""The parts as their programs leave them.

Walls are measured from the text: by a beam they stand half a kerf beside its way, by a wire on the contour.
Those of a service are measured from its drawing, which it cuts true to size. Holes that are reamed, drilled
or given a bush afterwards count as drawn. What the process strays by besides is no part of this: it is the
tolerance that ``[tolerances]`` takes.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
import shapely

from mechwright.arrays import Array, turned
from mechwright.contracts.made_part import MadePart, MadeRing, MadeSection
from mechwright.geometry import Loop
from mechwright.pipeline import Build
from mechwright.tolerances import TOLERANCES
from mechwright_cut.cutting import Cutting, ProvenCut
from mechwright_cut.jobs import CutPiece
from mechwright_cut.proof.reading import read_beam
from mechwright_cut.proof.swept import runs, way
from mechwright_cut.proof.wire_judge import wire_walls
from mechwright_cut.settings.cut_settings import SERVICE
from mechwright_cut.settings.services import services

NUDGE = 1e-4
"""A place is tried so far off the material, mm, to see on which side of it the wall stands."""
CORNER = TOLERANCES.leftover
"""Where more than this stays, mm, a round beam does not come: the proof has found no other such place."""


def plates_as_cut(build: Build) -> dict[str, list[MadePart]]:
    """The copies of each plate that the programs of a build cut, by its name, and one that a service does."""
    cutting = build.made(Cutting)
    copies: dict[str, list[MadePart]] = {}
    for one in cutting.programs:
        for part in parts_as_cut(one):
            copies.setdefault(part.name, []).append(part)
    return copies | {part.name: [part] for part in parts_ordered(cutting)}


def parts_as_cut(item: ProvenCut) -> Iterator[MadePart]:
    """The pieces of a sheet as its text leaves them, each in its own coordinates.

    A wall leans by half of the taper: the mechanism has to run wherever on either side it stands.
    """
    corridor = TOLERANCES.gouge + item.job.process.taper / 2
    walls = _wire_walls(item) if item.suffix == ".iso" else _beam_walls(item)
    for piece in item.job.pieces:
        yield _as_cut(piece, walls, corridor)


def parts_ordered(cutting: Cutting) -> Iterator[MadePart]:
    """The parts that a service cuts, as their drawings have them; its taper is that of its process."""
    if not cutting.ordered:
        return
    from mechwright_cut.service.checker import drawn_rings

    rules = services()[cutting.settings.service]
    for cut, content in zip(cutting.ordered, cutting.drawings.values(), strict=True):
        process = cutting.settings.kind(SERVICE, cut.part.material)
        rings = shapely.union_all([ring.exterior for ring in drawn_rings(content)])
        offset = rules.offset(cut.part.material)
        walls = _beside(rings, offset) if offset else _on(rings)
        piece = CutPiece(cut, cut.part.name, 0.0, 0.0, 0.0)
        yield _as_cut(piece, walls, TOLERANCES.gouge + process.taper / 2)


def _as_cut(piece: CutPiece, walls: "Walls", corridor: float) -> MadePart:
    part = piece.cut.part
    assert part.outline is not None  # noqa: S101 - plates alone are cut
    cut = set(piece.cut.outline.loops)
    rings = tuple(_ring(loop, piece, walls if loop in cut else None) for loop in part.outline.loops)
    return MadePart(part.name, piece.label, corridor, (MadeSection(0.0, part.thickness, rings),))


@dataclass(frozen=True)
class Walls:
    """Where walls stand.

    Parameters
    ----------
    off
        Stock (n,) on walls at places (n, 2) on the sheet, mm, with their normals (n, 2) off the material.
    everywhere
        What the program leaves on all of them, mm.
    """

    off: Callable[[Array, Array], Array]
    everywhere: float = 0.0


def _beam_walls(item: ProvenCut) -> Walls:
    """A wall stands half a kerf beside the way of the beam."""
    control = "grbl-laser" if item.suffix == ".nc" else "linuxcnc-beam"
    mark = 0.0 if item.job.process.name == "plasma" else item.job.settings.marking[0]
    lit = [m for m in read_beam(item.text, control).motions if m.power == 0 or m.power > mark]
    return _beside(shapely.union_all([way(run) for run in runs(lit)]), item.job.kerf.width / 2)


def _beside(ways: shapely.Geometry, half: float) -> Walls:
    """Walls that half a kerf takes off beside ways in the waste, mm."""
    shapely.prepare(ways)

    def off(places: Array, outward: Array) -> Array:  # noqa: ARG001 - a beam runs in the waste alone
        found: Array = shapely.distance(shapely.points(places), ways) - half
        return found

    return Walls(off)


def _wire_walls(item: ProvenCut) -> Walls:
    """A wall is the contour with the last register, which leaves what it has above half of the kerf."""
    registers = item.job.settings.registers(item.job.kerf.width)
    more = registers[-1] - item.job.kerf.width / 2
    return _on(shapely.union_all([shapely.boundary(one) for one in wire_walls(item.text, registers)]), more)


def _on(contours: shapely.Geometry, more: float = 0.0) -> Walls:
    """Walls on contours, with so much left on them everywhere, mm."""
    shapely.prepare(contours)

    def off(places: Array, outward: Array) -> Array:
        apart = shapely.distance(shapely.points(places), contours)
        beyond = shapely.distance(shapely.points(places + NUDGE * outward), contours)
        found: Array = np.where(beyond < apart, apart, -apart) + more
        return found

    return Walls(off, more)


def _ring(loop: Loop, piece: CutPiece, walls: Walls | None) -> MadeRing:
    """A wall; as drawn where no beam makes it."""
    points = loop.flatten()
    along = np.roll(points, -1, axis=0) - np.roll(points, 1, axis=0)
    # The material lies on the left of a loop, so that its right points off it.
    outward = np.column_stack((along[:, 1], -along[:, 0])) / np.hypot(*along.T)[:, None]
    off = np.zeros(len(points))
    if walls is not None:
        places = np.add(turned(points, piece.angle), (piece.x, piece.y))
        off = walls.off(places, turned(outward, piece.angle))
    corner = off > CORNER + (0.0 if walls is None else walls.everywhere)
    off = np.where(corner, 0.0, off)
    return MadeRing(points + off[:, None] * outward, outward, off, corner)
