"""The parts on both fixed axes of a ground link with a motor's flange, and the frames of all round parts.

``axle-a0`` and ``axle-b0`` turn with crank and rocker, ``hub-a0`` and ``hub-b0`` stand in the ground; z of
each is its axis, outwards, and the origin the centre. Outwards is towards the motor: where the ground is on
both sides, the input's shaft goes through the centre, and its z is against the crank.

Each pin, and the tool, stands in a frame of its own name, z along it and outwards.
"""

import math
from collections.abc import Iterator, Mapping

import numpy as np

from mechwright import Array, Instance, Joint, Part, Poses
from mechwright.contracts.joint import fixed
from mechwright_spherical.kinematics.bodies import pins_of_phase
from mechwright_spherical.kinematics.drive import train_of
from mechwright_spherical.kinematics.linkage import linkage_of
from mechwright_spherical.kinematics.vectors import perpendicular
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.parts.frame import motor_opposite, shells_of
from mechwright_spherical.parts.mount import (
    AIR,
    FAR,
    hubs_of,
    idler_ring,
    shaft_form,
    shaft_start,
    spacer_form,
    spacer_room,
    stud_form,
)
from mechwright_spherical.parts.places import in_ground, link_arcs, path_point, pin_places

BRIGHT, BRONZE = (0.82, 0.82, 0.84), (0.76, 0.58, 0.30)


def axis_parts(params: SphericalParams) -> Iterator[Part]:
    """Shafts with rings, bushes and spacers of a ground with a flange; and the idler's stud."""
    shells, steel = shells_of(params), params.hardware.pin_material
    for name, hub in hubs_of(params).items():
        axle, shaft = f"axle-{name}", shaft_form(params, shells, name)
        at = (Instance(axle, shaft_start(params, shells, name)),)
        yield Part(f"shaft-{name}", None, 0.0, steel, at, BRIGHT, turned=shaft)
        for number, (bush, low) in enumerate(hub.bushes, start=1):
            at = (Instance(f"hub-{name}", low),)
            # Bushes at both ends of one long bore leave its middle free.
            free = hub.free_bore(params)
            yield Part(f"bush-{name}-{number}", None, 0.0, "brass", at, BRONZE, bought=bush.bought, play=free)
        if hub.ring is not None:
            at = (Instance(axle, hub.seat),)
            yield Part(f"circlip-{name}", None, 0.0, "steel", at, BRIGHT, bought=hub.ring.bought)
        spacer = spacer_form(params, name)
        if spacer is not None:
            at = (Instance(axle, spacer_room(params, name)[0] + AIR / 2),)
            yield Part(f"spacer-{name}", None, 0.0, "brass", at, BRONZE, turned=spacer, play=AIR / 2)
    train = train_of(linkage_of(params), params.drive)
    if train is not None and train.idler_axis is not None:
        form, at = stud_form(params, shells, train), (Instance("shaft-idler", shells.pins["idler"][0]),)
        yield Part("shaft-idler", None, 0.0, steel, at, BRIGHT, turned=form)
        held = idler_ring(params, shells, train)
        if held is not None:
            at = (Instance("shaft-idler", held[1]),)
            yield Part("circlip-idler", None, 0.0, "steel", at, BRIGHT, bought=held[0].bought)


def axis_frames(params: SphericalParams) -> dict[str, tuple[str, Array]]:
    """Frames to the body that each is fixed to, and its rotation (3, 3) in that; none without a flange."""
    # Not whether there are hubs: what pins without bush or ring forbid are parts, and no motion.
    if params.stand.motor_flange is None:
        return {}
    arc, far = link_arcs(linkage_of(params))["ground"], motor_opposite(params)
    turned, output = math.pi if far else 0.0, "arm" if params.kind == "five-bar" else "rocker"
    found = {}
    for name, body, own, angle in (("a0", "crank", turned, turned), ("b0", output, 0.0, arc)):
        found[f"axle-{name}"] = (body, _along(own))
        found[f"hub-{name}"] = ("ground", _along(angle))
    if far:
        found |= {name: (body, np.diag([-1.0, -1.0, 1.0])) for body, name in FAR.items()}
    return found


def pin_frames(params: SphericalParams) -> dict[str, tuple[str, Array]]:
    """Frames of the pins that are shown and of the tool, by part name, as :func:`axis_frames` has them."""
    linkage = linkage_of(params)
    train, places = train_of(linkage, params.drive), pin_places(params)
    second, flange = linkage.shown.number == 2, params.stand.motor_flange is not None
    found = {}
    for name, (_, body, angle) in places.items():
        shown = second if name.endswith("-n") else not (second and f"{name}-n" in places)
        if shown and not (flange and name.startswith("shaft-")):
            found[name] = (body, _along(angle))
    if train is not None and train.idler_axis is not None:
        found["shaft-idler"] = ("ground", _frame(in_ground(linkage, train.idler_axis)))
    found["tool"] = ("coupler", _frame(path_point(linkage, pins_of_phase(linkage, 1))))
    return found


def axis_poses(params: SphericalParams, poses: Mapping[str, Poses]) -> dict[str, Poses]:
    """The poses of these frames."""
    return {
        name: Poses(poses[body].position, poses[body].rotation @ turn)
        for name, (body, turn) in (axis_frames(params) | pin_frames(params)).items()
    }


def axis_joints(params: SphericalParams) -> dict[str, Joint]:
    """What they are fixed to."""
    found: dict[str, Joint] = {}
    for name, (body, _) in (axis_frames(params) | pin_frames(params)).items():
        found |= fixed(body, name)
    return found


def _frame(z: Array) -> Array:
    """A rotation with that z, a unit vector."""
    x = perpendicular(z)
    return np.stack([x, np.cross(z, x), z], axis=1)


def _along(angle: float) -> Array:
    """A rotation whose z lies in the xy plane, that angle from x."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[0.0, -s, c], [0.0, c, s], [-1.0, 0.0, 0.0]])
