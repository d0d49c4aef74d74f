"""A mechanism whose bodies turn in space: their surfaces as triangles."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright_cad.animation.figures import ANGLE, DRAWN, hexadecimal, rounded
from mechwright_cad.bodies import Body, label_of
from mechwright_cad.interference.path import STILL
from mechwright_cad.interference.slabs import slabs_of, triangles_of

SURFACE_CHORD = 0.15
"""Distance of triangles from the surface, mm: less than a line's width on the screen, some hundred triangles
for a link."""


def mesh_of_body(body: Body) -> tuple[Array, NDArray[np.int64]]:
    """Corners (n, 3), mm, in the frame of the body, and triangles (k, 3)."""
    if body.is_plate:
        return triangles_of(slabs_of(body.part, body.instance), SURFACE_CHORD)
    from mechwright_cad.solids.solid import part_solid
    from mechwright_cad.solids.tessellate import mesh_of

    made = mesh_of(part_solid(body.part), ruled=False, tolerance=SURFACE_CHORD)
    return made.points + np.array((0.0, 0.0, body.instance.z)), made.triangles


def meshes_of(
    bodies: Sequence[Body], *, solids: bool, paths: Sequence[Array] = ()
) -> tuple[list[dict[str, Any]], dict[str, Any]]:
    """The surfaces of bodies that can be had; a sphere about all that they and ``paths`` come to, mm."""
    found, reach = [], list(paths)
    for body in bodies:
        if not (body.is_plate or solids):
            continue
        points, triangles = mesh_of_body(body)
        low, high = points.min(axis=0), points.max(axis=0)
        corners = np.array([[(low, high)[k >> axis & 1][axis] for axis in range(3)] for k in range(8)])
        reach.append(body.poses.transform(corners).reshape(-1, 3))
        found.append(
            {
                "body": body.instance.body,
                "name": label_of(body),
                "colour": hexadecimal(body.part.colour_of(body.instance)),
                "points": rounded(points.ravel(), DRAWN),
                "triangles": triangles.ravel().tolist(),
            }
        )
    return found, ball(reach)


def upwards(bodies: Sequence[Body], middle: Sequence[float]) -> list[Any]:
    """The direction (3,) that is drawn upwards: from the largest plate at rest towards the ``middle``."""
    plates = [
        (body.part.outline.area, body)
        for body in bodies
        if body.part.outline is not None and np.ptp(body.poses.rotation, axis=0).max() < STILL
    ]
    if not plates:
        return [0, 0, 1]
    _, base = max(plates, key=lambda item: item[0])
    normal = base.poses.rotation[0, :, 2]
    away = float(normal @ (np.asarray(middle) - base.poses.position[0]))
    return rounded(normal if away >= 0 else -normal, ANGLE)


def ball(pieces: Sequence[Array]) -> dict[str, Any]:
    """A sphere about points (n, 3), mm: in the middle of their box."""
    if not pieces:
        return {"centre": [0, 0, 0], "radius": 1}
    every = np.concatenate(pieces)
    centre = (every.min(axis=0) + every.max(axis=0)) / 2
    radius = float(np.linalg.norm(every - centre, axis=1).max())
    return {"centre": rounded(centre, DRAWN), "radius": round(radius, DRAWN) or 1}
