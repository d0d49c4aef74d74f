"""A mechanism in space: the forms of its parts, the bodies that have them, and the room that they take."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.motion import Motion
from mechwright_cad.animation.figures import ANGLE, DRAWN, hexadecimal, rounded
from mechwright_cad.bodies import Body, label_of
from mechwright_cad.interference.path import STILL
from mechwright_cad.viewer.forms import LARGEST, forms_of, is_light
from mechwright_cad.viewer.groups import FASTENERS, groups_of
from mechwright_cad.viewer.packed import form


def bodies_in_space(
    bodies: Sequence[Body], motion: Motion, *, solids: bool, paths: Sequence[Array] = (), grouped: bool = True
) -> dict[str, Any]:
    """What a picture in space holds of bodies that can be had, and a sphere about all that they come to.

    A mechanism of too many triangles has none of its bodies, and their number as ``large``.
    Without ``solids`` parts are left out whose form takes the CAD kernel. ``paths`` (n, 3), mm, are within
    the sphere as well. Where bodies are ``grouped``, fasteners are hidden at first.
    """
    made = [body for body in bodies if solids or is_light(body.part)]
    parts = list({id(body.part): body.part for body in made}.values())
    number = {id(part): place for place, part in enumerate(parts)}
    meshes = forms_of(parts)
    count = sum(len(triangles) for _, triangles in meshes)
    groups = dict(zip(map(id, bodies), groups_of(bodies, motion), strict=True))
    reach = list(paths)
    for body in made:
        points, _ = meshes[number[id(body.part)]]
        low, high = points.min(axis=0), points.max(axis=0)
        corners = np.array([[(low, high)[k >> axis & 1][axis] for axis in range(3)] for k in range(8)])
        lifted = corners + np.array((0.0, 0.0, body.instance.z))
        reach.append(body.poses.transform(lifted).reshape(-1, 3))
    sphere = ball(reach)
    if count > LARGEST:
        return {
            "forms": [],
            "meshes": [],
            "large": count,
            "ball": sphere,
            "up": upwards(bodies, sphere["centre"]),
        }
    return {
        "forms": [form(*mesh) for mesh in meshes],
        "meshes": [_mesh(body, number[id(body.part)], groups[id(body)] if grouped else "") for body in made],
        "ball": sphere,
        "up": upwards(bodies, sphere["centre"]),
    }


def _mesh(body: Body, number: int, group: str) -> dict[str, Any]:
    found: dict[str, Any] = {
        "body": body.instance.body,
        "name": label_of(body),
        "colour": hexadecimal(body.part.colour_of(body.instance)),
        "form": number,
    }
    if body.instance.z:
        found["z"] = round(body.instance.z, DRAWN + 1)
    return found | grouping(group)


def grouping(group: str) -> dict[str, Any]:
    """What a page is told of the group of a body; nothing of none."""
    if not group:
        return {}
    return {"group": group, "off": True} if group == FASTENERS else {"group": group}


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
    foot = base.poses.position[0] + base.instance.z * normal
    away = float(normal @ (np.asarray(middle) - foot))
    return rounded(normal if away >= 0 else -normal, ANGLE)


def ball(pieces: Sequence[Array]) -> dict[str, Any]:
    """A sphere about points (n, 3), mm: in the middle of their box."""
    if not pieces:
        return {"centre": [0, 0, 0], "radius": 1}
    every = np.concatenate(pieces)
    centre = (every.min(axis=0) + every.max(axis=0)) / 2
    radius = float(np.linalg.norm(every - centre, axis=1).max())
    return {"centre": rounded(centre, DRAWN), "radius": round(radius, DRAWN) or 1}
