"""What holds the plate and its pieces: where, and from when on."""

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np
import shapely

from mechwright_cam.proof.footprint import Footprint, Mask
from mechwright_cam.proof.scene import Scene
from mechwright_cam.proof.stops import clamp_set, way_through
from mechwright_cam.setup.job import Job

LEAST_RIM = 1 / 8
"""A piece with so much of the plate's edge has a clamp on it, as the setup sheet asks: share of all of it."""
LEAST_JAW = 0.5
"""A piece that touches so much of both jaws is gripped by them: share of their width."""

PRESSED = 20.0
"""A toe clamp holds a piece of which it covers so much, mm²: a toe of 10 mm that reaches over by 2 mm."""
LEAST_AREA = {"vacuum": 500.0, "tape": 100.0}
"""A piece so large stays where it is when it is cut free, mm², under the 12 N sideways of a finishing cut: a
vacuum of 0.8 bar with friction of 0.3 holds 0.024 N/mm², double-sided tape 0.12 N/mm² at least."""


class Workholding(Protocol):
    """Something that holds pieces."""

    def secures(self, piece: Mask, step: int) -> bool:
        """Whether it holds a piece when a step is done."""


@dataclass(frozen=True)
class Grip:
    """One thing that holds."""

    places: tuple[Mask, ...]
    """(ny, nx) each: a piece is held that has enough cells of every one of them."""
    least: tuple[int, ...]
    """Cells that are enough."""
    since: int = -1
    """The step from which on it holds."""

    def secures(self, piece: Mask, step: int) -> bool:
        """Whether it holds a piece when a step is done."""
        return step >= self.since and all(
            np.count_nonzero(piece & place) >= least
            for place, least in zip(self.places, self.least, strict=True)
        )


def workholding(scene: Scene) -> list[Grip]:
    """All that holds, as the job says."""
    job, found = scene.job, scene.footprint
    if job.jaws:
        faces = tuple(found.inside(shapely.buffer(jaw.face, found.cell)) for jaw in job.jaws)
        return [Grip(faces, tuple(int(LEAST_JAW * np.count_nonzero(face)) + 1 for face in faces))]
    if job.settings.hold.method == "none":
        return _from_below_and_above(job, found)
    held = [_edge(found)]
    if job.clamp is not None:
        middle = shapely.Point(job.clamp.centre)
        # It presses on the rim of its hole, however wide that is.
        hole = float(shapely.distance(middle, job.target)) + 2 * found.cell
        disc = middle.buffer(max(job.clamp.diameter / 2, hole))
        since = clamp_set(scene)
        if way_through(scene) < since:  # before there is one, nobody can have set it
            held.append(Grip((found.inside(disc),), (1,), since))
    return held


def _from_below_and_above(job: Job, found: Footprint) -> list[Grip]:
    """A vacuum or tape under the whole plate, and clamps on it."""
    cells = 1 / found.cell**2
    held = [Grip((found.inside(toe.shape),), (math.ceil(PRESSED * cells),)) for toe in job.toes]
    if job.settings.hold.bed is not None:
        everywhere = np.ones(found.cut.shape, dtype=bool)
        held.append(Grip((everywhere,), (math.ceil(LEAST_AREA[job.settings.hold.bed] * cells),)))
    return held


def _edge(found: Footprint) -> Grip:
    """The clamps on the edge of the plate."""
    edge = np.ones(found.cut.shape, dtype=bool)
    edge[1:-1, 1:-1] = False
    return Grip((edge,), (int(LEAST_RIM * np.count_nonzero(edge)) + 1,))


def advice(job: Job) -> str:
    """What to do about a piece that nothing holds."""
    if job.clamp is not None:
        return "clamp it before"
    if job.side == "underside":
        return "leave it joined to the rest"
    if job.settings.hold.bed is not None:
        return f"leave pieces of {LEAST_AREA[job.settings.hold.bed]:g} mm² at least, or tabs"
    if job.settings.hold.method == "none":
        return "hold it by tape (cam.hold.bed), or with one more of cam.hold.toe_clamps"
    if job.jaws:
        return "leave it between the jaws"
    return "leave tabs"
