"""The parts on a plate as its programs leave them, each in its own coordinates."""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
import shapely

from mechwright.arrays import Array, turned
from mechwright.contracts.made_part import MadePart, MadeRing, MadeSection
from mechwright.contracts.part import Part
from mechwright.pipeline.result_store import stored
from mechwright_cam.proof.as_made import as_made_sections, wall_sweeps
from mechwright_cam.proof.off_path import corridor
from mechwright_cam.proof.scene import Scene
from mechwright_cam.proof.witness import witnesses
from mechwright_cam.setup.sides import SIGNS
from mechwright_plane.nest import Nest, Placed


@stored
def parts_as_made(scene: Scene) -> list[MadePart]:
    """The parts that one program makes from above, each in its own coordinates."""
    sweeps = wall_sweeps(scene)
    sections = as_made_sections(scene, sweeps)
    shift = np.array(scene.job.origin)
    lines = [
        replace(line, at=tuple((np.array(line.at) + shift).tolist()))
        for section in sections
        for line in witnesses(sweeps, section)
    ]
    placed = placed_in(scene)
    owner = _owners(placed)
    shared = _shared([_moved(section, shift) for section in sections], placed)
    off_path = corridor(sweeps.paths, scene.job, scene.motion.off)
    return [
        MadePart(
            one.part.name,
            one.label,
            off_path,
            own,
            tuple(
                replace(line, at=tuple(_turned_back(np.array(line.at), one).tolist()))
                for line in lines
                if owner(np.array(line.at)) == number
            ),
        )
        for number, (one, own) in enumerate(zip(placed, shared, strict=True))
    ]


def placed_in(scene: Scene) -> tuple[Placed, ...]:
    """The copies on the plate of a job from above."""
    return placed_on(scene.job.part)


def placed_on(part: Part) -> tuple[Placed, ...]:
    """The copies on the plate that a program cuts: those of a nest, or the part."""
    return part.placed if isinstance(part, Nest) else (Placed(part, part.name, 0.0, 0.0),)


def with_undersides(parts: Sequence[MadePart], placed: Sequence[Placed], scene: Scene) -> list[MadePart]:
    """The parts with what a second setup has cut from below: recesses that are closed all around."""
    job = scene.job
    assert job.frame is not None  # noqa: S101 - it has been turned over
    sign, thickness = np.array(SIGNS[job.settings.second_side.flip]), job.thickness
    sections = []
    for section in as_made_sections(scene, wall_sweeps(scene)):
        holes = [
            ring
            for ring in section.rings
            if ring.area < 0 and shapely.contains_xy(job.frame.body, *ring.points.mean(axis=0))
        ]
        over = tuple(_turned_over(ring, sign, np.array(job.origin)) for ring in holes)
        if over:
            sections.append(MadeSection(thickness - section.bottom, thickness - section.top, over))
    sections.sort(key=lambda section: section.top)
    shared = _shared(sections, placed)
    return [replace(part, underside=own) for part, own in zip(parts, shared, strict=True)]


def _owners(placed: Sequence[Placed]) -> Callable[[Array], int]:
    """Which of the parts in a nest a point lies on."""
    outlines = np.array([one.outline.polygon() for one in placed], dtype=object)
    return lambda point: (
        0 if len(outlines) == 1 else int(np.argmin(shapely.distance(outlines, shapely.Point(point))))
    )


def _shared(sections: Sequence[MadeSection], placed: Sequence[Placed]) -> list[tuple[MadeSection, ...]]:
    """The sections of a plate as those of each part on it, in the part's own coordinates."""
    owner = _owners(placed)
    rings = [(section, ring, owner(ring.points[0])) for section in sections for ring in section.rings]
    return [
        tuple(
            replace(
                section,
                rings=tuple(
                    _placed_back(ring, one)
                    for here, ring, mine in rings
                    if here is section and mine == number
                ),
            )
            for section in sections
        )
        for number, one in enumerate(placed)
    ]


def _moved(section: MadeSection, shift: Array) -> MadeSection:
    rings = tuple(replace(ring, points=ring.points + shift) for ring in section.rings)
    return replace(section, rings=rings)


def _turned_back(points: Array, one: Placed) -> Array:
    """Points (..., 2) of a nest in the coordinates of one of its parts."""
    return turned(points - (one.x, one.y), -one.angle)


def _placed_back(ring: MadeRing, one: Placed) -> MadeRing:
    points = _turned_back(ring.points, one)
    return replace(ring, points=points, outward=_turned_back(ring.points + ring.outward, one) - points)


def _turned_over(ring: MadeRing, sign: Array, origin: Array) -> MadeRing:
    """A wall of the second setup in the part's coordinates; mirrored, it runs the other way round."""
    return MadeRing(
        ((ring.points + origin) * sign)[::-1],
        (ring.outward * sign)[::-1],
        ring.off[::-1],
        ring.corner[::-1],
    )
