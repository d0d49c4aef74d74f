"""The geometry of what touches: round pins as cylinders, plates as convex prisms."""

import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.joint import Joint
from mechwright.contracts.part import Instance, Part
from mechwright.errors import GeometryError
from mechwright_cad.exporters.mesh import part_mesh
from mechwright_cad.exporters.simulation.elements import METRES, SOLREF, corners, element, text
from mechwright_cad.solids.convex import prisms

Placed = Mapping[str, Sequence[tuple[Part, Instance]]]
"""Body to the parts in it."""


def write_contacts(
    assets: ET.Element,
    bodies: Mapping[str, ET.Element],
    placed: Placed,
    touching: Sequence[Joint],
    friction: float,
) -> None:
    """Write what touches: each body that pushes has a bit of its own, to which the other answers.

    With a coefficient of friction surfaces that slide on each other rub; none of them rolls or twists hard.

    Raises
    ------
    GeometryError
        A body shall touch another and has nothing to do it with.
    """
    bits = {body: 1 << place for place, body in enumerate(dict.fromkeys(j.one for j in touching))}
    pins = {joint.one: joint for joint in touching if joint.radius > 0}
    pieces: dict[str, list[str]] = {}
    for body in dict.fromkeys(body for joint in touching for body in (joint.one, joint.two)):
        answers = {bits[joint.one] for joint in touching if joint.two == body}
        how = {
            "contype": str(bits.get(body, 0)),
            "conaffinity": str(sum(answers)),
            "group": "3",
            "condim": "3" if friction else "1",
        }
        if friction:
            how["friction"] = text([friction, 0.0, 0.0])
        if body in pins:
            ends = _pin_ends(pins[body], placed[body]) * METRES
            size = pins[body].radius * METRES
            element(bodies[body], "geom", type="cylinder", fromto=ends, size=size, solref=SOLREF, **how)
            continue
        plates = [(part, at) for part, at in placed[body] if part.outline is not None]
        if not plates:
            raise GeometryError(
                f"{body or 'the ground'} shall touch other bodies and has no plate; give it one, or the "
                "contact a radius"
            )
        for part, at in plates:
            if part.name not in pieces:
                pieces[part.name] = _pieces(assets, part)
            for name in pieces[part.name]:
                place = [0.0, 0.0, at.z * METRES]
                element(bodies[body], "geom", type="mesh", mesh=name, pos=place, solref=SOLREF, **how)


def _pieces(assets: ET.Element, part: Part) -> list[str]:
    """Write the convex prisms of a plate; their names."""
    found = []
    for number, points in enumerate(prisms(part), start=1):
        found.append(f"{part.name}.{number}")
        element(assets, "mesh", name=found[-1], inertia="shell", vertex=corners(points))
    return found


def _pin_ends(joint: Joint, here: Sequence[tuple[Part, Instance]]) -> Array:
    """Ends (6,) of a round pin, mm: it is as long as the body along its axis."""
    if not here:
        raise GeometryError(f"body {joint.one} touches {joint.two} with a pin and has no part; give it one")
    point, axis = np.array(joint.point), np.array(joint.axis)
    along = np.concatenate([(part_mesh(part).points - point) @ axis + at.z * axis[2] for part, at in here])
    return np.concatenate([point + along.min() * axis, point + along.max() * axis])
