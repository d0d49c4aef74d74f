"""What holds the plate and its pieces: where, and from when on."""

from dataclasses import dataclass

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


@dataclass(frozen=True)
class Grip:
    """One thing that holds."""

    places: tuple[Mask, ...]
    """(ny, nx) each: a piece is held that has enough cells of every one of them."""
    least: tuple[int, ...]
    """Cells that are enough."""
    since: int = -1
    """The step from which on it holds."""

    def holds(self, piece: Mask, step: int) -> bool:
        """Whether it holds a piece when a step is done."""
        return step >= self.since and all(
            np.count_nonzero(piece & place) >= least
            for place, least in zip(self.places, self.least, strict=True)
        )


def grips(scene: Scene) -> list[Grip]:
    """All that holds, as the job says."""
    job, found = scene.job, scene.footprint
    if job.jaws:
        faces = tuple(found.inside(shapely.buffer(jaw.face, found.cell)) for jaw in job.jaws)
        return [Grip(faces, tuple(int(LEAST_JAW * np.count_nonzero(face)) + 1 for face in faces))]
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


def _edge(found: Footprint) -> Grip:
    """The clamps on the edge of the plate."""
    edge = np.ones(found.cut.shape, dtype=bool)
    edge[1:-1, 1:-1] = False
    return Grip((edge,), (int(LEAST_RIM * np.count_nonzero(edge)) + 1,))


def advice(job: Job) -> str:
    """What to do about a piece that nothing holds."""
    if job.clamp is not None:
        return "clamp it before"
    if job.jaws:
        return "leave it between the jaws"
    return "leave tabs"
