"""What the joints of a mechanism carry, without friction, by the equilibrium of its bodies.

For each group of bodies that move as one, forces and torques of its joints, of weights and of loads make up
the rate of its momentum: ∫ a dm, and ∫ p x a dm about the origin. Where more joints hold a group than have
to, as parallel pins do across their plane, the solution with the least forces is taken.

Glossary
--------
wrench
    A force, N, and a torque about the origin, N m, as six numbers.
direction
    Of a joint: the wrench on its body ``two`` for an unknown of 1 N.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.bodies import rigid
from mechwright.contracts.joint import GROUND, Joint, Vector
from mechwright.contracts.motion import Motion
from mechwright.contracts.part import Part
from mechwright.errors import KinematicsError
from mechwright.machine.course import Course, course_of
from mechwright.machine.drive import GRAVITY, MICRO, MILLI, all_loads, moving_masses, with_own_inertia
from mechwright.machine.settings import MachineSettings

LEVER = 10.0
"""mm. A torque counts as much as the force that makes it with this lever, where a share has to be chosen."""

UNBALANCED = 1e-4
"""Share of the greatest wrench that joints may leave: more means that something else carries it."""

RANK = 1e-9
"""Share of the greatest singular value below which a direction carries nothing, as at a dead centre."""


@dataclass(frozen=True, eq=False)
class Carried:
    """What joints carry over a period.

    Parameters
    ----------
    forces
        Name of a revolute or prismatic joint to the force (n,), N, across its axis.
    drive
        (n,) torque, N m, or force, N, of the input about or along the axis of its joint, without friction.
    """

    forces: Mapping[str, Array]
    drive: Array


def carried_of(motion: Motion, parts: Sequence[Part], settings: MachineSettings) -> Carried:
    """What joints carry while the input runs forwards at its speed, with weights where ``up`` is set.

    Raises
    ------
    DesignError
        The motion does not say how fast it runs, or its input is no angle.
    KinematicsError
        Something besides pins, slides, gears and round rollers carries forces.
    GeometryError
        A part that moves has no mass.
    """
    course = course_of(motion, settings.speed)
    heads = rigid(motion)
    groups = sorted({head for head in heads.values() if head != heads[GROUND]})
    wanted = _needed(motion, parts, settings, course)
    nothing = np.zeros((course.angle.size, 6))
    right = np.stack([sum((wanted[b] for b in wanted if heads[b] == g), nothing) for g in groups], axis=1)
    columns: list[Array] = []
    owners: dict[str, list[int]] = {}
    for name, joint in motion.joints.items():
        if heads[joint.one] == heads[joint.two]:
            continue
        found, mate = _directions(joint, motion, course)
        one, two = heads[mate], heads[joint.two]
        owners[name] = list(range(len(columns), len(columns) + len(found)))
        for direction in found:
            column = np.zeros((course.angle.size, len(groups), 6))
            for head, sign in ((one, -1.0), (two, 1.0)):
                if head != heads[GROUND]:
                    column[:, groups.index(head)] += sign * direction
            columns.append(column)
    # Torques are weighed by a lever, so that all numbers are forces.
    weights = np.repeat((1.0, 1 / (LEVER * MILLI)), 3)
    matrix = (np.stack(columns, axis=-1) * weights[:, None]).reshape(course.angle.size, -1, len(columns))
    target = (right * weights).reshape(course.angle.size, -1)
    unknown = np.einsum("nij,nj->ni", np.linalg.pinv(matrix, rcond=RANK), target)
    _check(np.einsum("nij,nj->ni", matrix, unknown) - target, target, groups)
    drive = next((name for name, joint in motion.joints.items() if joint.drives and name in owners), None)
    if drive is None:
        raise KinematicsError("no joint of the motion is driven, so the forces of its joints are not known")
    lever = LEVER * MILLI if motion.joints[drive].kind == "revolute" else 1.0
    forces = {
        name: np.linalg.norm(unknown[:, [owners[name][k] for k in _ACROSS[joint.kind]]], axis=1)
        for name, joint in motion.joints.items()
        if joint.kind in _ACROSS and name in owners
    }
    return Carried(forces, unknown[:, owners[drive][-1]] * lever)


_ACROSS = {"revolute": (0, 1), "prismatic": (0, 1)}
"""Which of the directions of a joint are forces across its axis."""


def _check(left: Array, target: Array, groups: Sequence[str]) -> None:
    # A dead centre, where forces grow without limit, is one sample: it is the many that count.
    most = np.abs(target).max()
    amiss = np.median(np.abs(left).reshape(len(left), len(groups), 6).max(axis=2), axis=0)
    if most > 0 and amiss.max() > UNBALANCED * most:
        raise KinematicsError(
            f"something besides pins, slides, gears and rollers, such as a flat cam follower's face, moves "
            f"{groups[int(amiss.argmax())]}, so the forces of its joints are not known; "
            "set simulation.friction = 0"
        )


def _needed(
    motion: Motion, parts: Sequence[Part], settings: MachineSettings, course: Course
) -> dict[str, Array]:
    """Body to the wrench (n, 6) that its joints have to give it."""
    masses = moving_masses(motion, parts)
    found: dict[str, Array] = {}
    for body, moments in with_own_inertia(motion, masses).items():
        timed = course.bodies[body]
        force = timed.second @ moments[:, 3] * MILLI
        product = timed.frames @ moments @ np.swapaxes(timed.second, 1, 2) * MICRO
        found[body] = np.concatenate([force, _turning(product)], axis=1)
    up = np.array(settings.upwards)
    for body, moments in masses.items() if up.any() else ():
        lift = GRAVITY * moments[3, 3] * up + np.zeros((course.angle.size, 3))
        centre = course.bodies[body].frames @ moments[:, 3] / moments[3, 3]
        found[body] = found.get(body, 0.0) + _wrench(centre, lift)
    for load in all_loads(motion, settings).values():
        share = np.broadcast_to(1.0 if load.share is None else load.share, course.angle.shape)[:, None]
        timed = course.bodies[load.body]
        at = timed.frames @ np.array([*load.point, 1.0])
        given = _wrench(at, share * np.array(load.force))
        given[:, 3:] += share * np.array(load.torque)
        sense = np.where(course.rests, 0.0, np.sign(course.speed))
        turning = course.turning(load.body) * sense[:, None]
        length = np.linalg.norm(turning, axis=1, keepdims=True)
        given[:, 3:] -= load.resisting * turning / np.where(length > 0, length, 1.0)
        found[load.body] = found.get(load.body, 0.0) - given
    return found


def _turning(product: Array) -> Array:
    """∫ p x a dm (n, 3) of ∫ p aᵀ dm (n, 3, 3)."""
    skew = product - np.swapaxes(product, 1, 2)
    return np.stack([skew[:, 1, 2], skew[:, 2, 0], skew[:, 0, 1]], axis=1)


def _wrench(at: Array, force: Array) -> Array:
    """The wrench (n, 6) of a force (n, 3), N, at places (n, 3), mm."""
    return np.concatenate([force, np.cross(at * MILLI, force)], axis=1)


def _couple(axis: Array) -> Array:
    """The wrench (n, 6) of a torque of 1 N at the lever about axes (n, 3)."""
    return np.concatenate([np.zeros_like(axis), axis * LEVER * MILLI], axis=1)


def _directions(joint: Joint, motion: Motion, course: Course) -> tuple[list[Array], str]:
    """What a joint can carry, (n, 6) each, its drive last; and the body that bears it."""
    if joint.kind == "gear":
        mate, found = _meshing(joint, motion, course)
        return [found], mate
    if joint.kind == "contact":
        return ([_rolling(joint, motion, course)] if joint.radius > 0 else []), joint.one
    at, axis = _placed(joint, course, joint.point), _placed(joint, course, joint.axis, free=True)
    across = [_placed(joint, course, one, free=True) for one in _perpendicular(joint.axis)]
    if joint.kind == "prismatic":
        own = [_wrench(at, one) for one in across] + [_couple(one) for one in (*across, axis)]
        return ([*own, _wrench(at, axis)] if joint.drives else own), joint.one
    own = [_wrench(at, one) for one in (*across, axis)] + [_couple(one) for one in across]
    return ([*own, _couple(axis)] if joint.drives else own), joint.one


def _placed(joint: Joint, course: Course, of_one: Vector, *, free: bool = False) -> Array:
    """A place, or a ``free`` vector, (n, 3) in the coordinates of the poses."""
    if joint.one == GROUND:
        return np.array(of_one) + np.zeros((course.angle.size, 3))
    return np.asarray(course.bodies[joint.one].frames @ np.array([*of_one, 0.0 if free else 1.0]))


def _perpendicular(axis: Vector) -> tuple[Vector, Vector]:
    first, second = np.linalg.svd(np.array(axis)[None])[2][1:]
    return tuple(first.tolist()), tuple(second.tolist())


def _meshing(gear: Joint, motion: Motion, course: Course) -> tuple[str, Array]:
    """The body that meshes with ``two``, and the force of 1 N along both pitch lines at their pitch point.

    That is the point on the line of centres at which both have one velocity. A planet whose gear counts
    against its carrier meshes with what the carrier turns on.
    """
    own = {
        joint.two: joint
        for joint in motion.joints.values()
        if joint.kind in {"revolute", "prismatic"} and joint.two in {gear.one, gear.two}
    }
    if set(own) != {gear.one, gear.two} or own[gear.one].kind == "prismatic":
        raise KinematicsError(
            f"{gear.one} and {gear.two} mesh, and do not turn in joints of their own; name them so"
        )
    first, second = own[gear.one], own[gear.two]
    mate = first.one if gear.one == second.one else gear.one
    start, end = _placed(first, course, first.point), _placed(second, course, second.point)
    axis = _placed(first, course, first.axis, free=True)
    if second.kind == "prismatic":
        along = _placed(second, course, second.axis, free=True)
        across, apart = np.cross(along, axis), np.zeros(course.angle.size)
    else:
        across = end - start
        across -= _dot(across, axis)[:, None] * axis
        apart = np.linalg.norm(across, axis=1)
        across /= apart[:, None]
        along = np.cross(axis, across)
    slip = _dot(_velocity(gear.two, end, course) - _velocity(mate, start, course), along)
    one, two = (_dot(_spin(body, course), axis) for body in (mate, gear.two))
    with np.errstate(divide="ignore", invalid="ignore"):
        way = (two * apart - slip) / (two - one)
    if not np.isfinite(way).all():
        raise KinematicsError(f"{gear.one} and {gear.two} turn as one somewhere, and mesh at no point")
    return mate, _wrench(start + way[:, None] * across, along)


def _dot(one: Array, two: Array) -> Array:
    return np.asarray(np.sum(one * two, axis=1))


def _spin(body: str, course: Course) -> Array:
    """Turns (n, 3) of a body for one of the input."""
    return np.zeros((course.angle.size, 3)) if body == GROUND else course.turning(body)


def _velocity(body: str, at: Array, course: Course) -> Array:
    """Of the point of a body that stands at places (n, 3), mm for each rad of the input."""
    if body == GROUND:
        return np.zeros_like(at)
    frames, along = course.bodies[body].frames, course.along(body)
    local = np.einsum("nji,nj->ni", frames[:, :, :3], at - frames[:, :, 3])
    return np.asarray(np.einsum("nij,nj->ni", along[:, :, :3], local) + along[:, :, 3])


def _rolling(contact: Joint, motion: Motion, course: Course) -> Array:
    """The force of 1 N of a round pin on a wall along which it moves; none of one that is not the nearest.

    Of the pins of one body it is the one nearest to the axis of the other that touches.
    """
    heads = rigid(motion)
    pair = (heads[contact.one], heads[contact.two])
    rivals = [
        joint
        for joint in motion.joints.values()
        if joint.kind == "contact" and joint.radius > 0 and (heads[joint.one], heads[joint.two]) == pair
    ]
    centre = next(
        (
            _placed(joint, course, joint.point)
            for joint in motion.joints.values()
            if joint.kind == "revolute" and heads[joint.two] == pair[1]
        ),
        np.zeros((course.angle.size, 3)),
    )
    at, axis = _placed(contact, course, contact.point), _placed(contact, course, contact.axis, free=True)
    reach = [np.linalg.norm(_placed(one, course, one.point) - centre, axis=1) for one in rivals]
    nearest = np.linalg.norm(at - centre, axis=1) <= np.min(reach, axis=0)
    slip = _velocity(contact.one, at, course) - _velocity(contact.two, at, course)
    normal = np.cross(axis, slip)
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    normal = normal / np.where(length > 0, length, 1.0)
    return _wrench(at, normal * nearest[:, None])
