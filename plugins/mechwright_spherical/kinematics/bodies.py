"""Where the bodies are: every link has a frame of its own, with the origin in the centre of the sphere.

A link's x axis points along its first joint, its arc runs in the xy plane towards the second one. Lying so,
its middle plane is z = 0: it can be printed as it is.

Glossary
--------
ground
    a0 (x) to b0.
crank, arm
    Fixed axis (x) to moving pin.
rocker
    B (x) to C; the output link of a four-bar, from its fixed axis.
coupler
    A (x) to C in phase 1; in other phases the same body stands on other pins.
coupler-a, coupler-c
    Parts of the coupler at a pin that is clamped in a slot: z points along the pin to the centre.
pinion, idler
    Gears of the drive; the wheel belongs to the arm.
base
    The base plate: z along the post, the origin on its underside.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from mechwright import Array, Poses
from mechwright_spherical.kinematics.chain import orientation
from mechwright_spherical.kinematics.drive import Train
from mechwright_spherical.kinematics.linkage import Linkage, Phase
from mechwright_spherical.kinematics.loop import State
from mechwright_spherical.kinematics.vectors import perpendicular, rotation_about
from mechwright_spherical.parts.seats import seats_of


def link_frames(linkage: Linkage, phase: Phase, state: State) -> Mapping[str, Array]:
    """Frames (3, 3, n) of all links, their axes the columns, for a state of the phase."""
    loop = phase.loop
    a, b, c = state.a[0], state.b[0], state.c[0]
    frames = {
        "ground": _still(orientation(loop.a0, loop.b0), a),
        "crank": orientation(np.broadcast_to(loop.a0[:, None], a.shape), a),
        "rocker": orientation(b, c),
        "coupler": coupler_frame(linkage, phase, state),
    }
    if linkage.five_bar is not None:
        frames["arm"] = orientation(np.broadcast_to(loop.b0[:, None], b.shape), b)
    return frames


def coupler_frame(linkage: Linkage, phase: Phase, state: State) -> Array:
    """The coupler's frame (3, 3, n): that of phase 1, carried along on the pins of this phase."""
    moved = orientation(state.a[0], state.c[0])
    if phase.number == 1:
        return moved
    return _times(moved, pins_of_phase(linkage, phase.number).T @ pins_of_phase(linkage, 1))


def pins_of_phase(linkage: Linkage, number: int) -> Array:
    """The frame (3, 3) of the pins A and C at the reference angle."""
    state = linkage.phases[number - 1].at_reference
    return orientation(state.a[0], state.c[0])[:, :, 0]


def clamped_frames(linkage: Linkage, phase: Phase, slotted: Sequence[str]) -> dict[str, Array]:
    """Frames (3, 3) of clamped pins in the coupler's frame, by body: z along the pin to the centre."""
    frame = pins_of_phase(linkage, 1)
    found = {}
    for seat in seats_of(linkage):
        if seat.name in slotted:
            z = -(frame.T @ seat.places[phase.number - 1])
            x = perpendicular(z)
            found[f"coupler-{seat.name}"] = np.stack([x, np.cross(z, x), z], axis=1)
    return found


def poses(
    linkage: Linkage, phase: Phase, state: State, angles: Array, train: Train | None, slotted: Sequence[str]
) -> dict[str, Poses]:
    """Poses of all bodies that turn about the centre, for a state at input angles (n,), rad.

    ``slotted`` are the pins, a or c, that are clamped in slots.
    """
    frames = dict(link_frames(linkage, phase, state))
    for name, own in clamped_frames(linkage, phase, slotted).items():
        frames[name] = _times(frames["coupler"], own)
    if train is not None:
        frames["pinion"] = _turned(phase.loop.a0, angles, frames["ground"][:, :, 0])
        if train.idler_axis is not None:
            # The idler's x axis is its own; y towards the arm's axis.
            at_rest = orientation(train.idler_axis, phase.loop.b0)
            frames["idler"] = _turned(train.idler_axis, train.idler_ratio * angles, at_rest)
    return {name: _poses(frame) for name, frame in frames.items()}


def _poses(frame: Array) -> Poses:
    rotation = np.ascontiguousarray(np.moveaxis(frame, 2, 0))
    return Poses(np.zeros((rotation.shape[0], 3)), rotation)


def _still(frame: Array, like: Array) -> Array:
    return np.broadcast_to(frame[:, :, None], (3, 3, like.shape[-1]))


def _turned(axis: Array, angles: Array, frame: Array) -> Array:
    return _times(rotation_about(axis, angles), frame)


def _times(moved: Array, frame: Array) -> Array:
    found: Array = np.einsum("ijn,jk->ikn", moved, frame)
    return found


def quaternions(rotation: Array) -> Array:
    """Unit quaternions (4, n), scalar first and not negative, of rotation matrices (3, 3, n).

    The largest component is computed from the trace, the others from it (Shepperd), so that no digits are
    lost.
    """
    r = rotation
    trace = r[0, 0] + r[1, 1] + r[2, 2]
    squares = np.stack([trace, r[0, 0], r[1, 1], r[2, 2]])
    best = np.argmax(squares, axis=0)
    # 4 times the products of all pairs of components.
    products = np.array(
        [
            [1 + trace, r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]],
            [r[2, 1] - r[1, 2], 1 + 2 * r[0, 0] - trace, r[0, 1] + r[1, 0], r[0, 2] + r[2, 0]],
            [r[0, 2] - r[2, 0], r[0, 1] + r[1, 0], 1 + 2 * r[1, 1] - trace, r[1, 2] + r[2, 1]],
            [r[1, 0] - r[0, 1], r[0, 2] + r[2, 0], r[1, 2] + r[2, 1], 1 + 2 * r[2, 2] - trace],
        ]
    )
    row = np.take_along_axis(products, best[None, None, :], axis=0)[0]
    found = row / np.sqrt((row**2).sum(axis=0))
    return np.asarray(np.where(found[0] < 0, -1.0, 1.0) * found)
