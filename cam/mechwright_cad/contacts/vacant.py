"""Places of an assembly that are made for a part which is not there: threads, grooves, bores of joints."""

from collections.abc import Iterator, Sequence

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.joint import GROUND, Joint
from mechwright.mechanics.linkage.fields import LOOSEST
from mechwright.mechanics.mating.rounds import ALIKE, CONTACT, NEAR, PARALLEL, Round
from mechwright.standards import bearings, bushes, circlips
from mechwright.tolerances import TOLERANCES
from mechwright_cad.bodies import is_coupling, is_motor
from mechwright_cad.contacts.screw_joints import Hole, ScrewJoint, holes_of
from mechwright_cad.contacts.touching import Gap, Touching

SEATED = frozenset({bearings.STANDARD, bushes.STANDARD})
"""Standards of what sits on a shaft: ball bearings, bushes."""


def vacancies(touching: Touching, joints: Sequence[ScrewJoint]) -> Iterator[Gap]:
    """All of them."""
    yield from _threads(touching, joints)
    yield from _grooves(touching)
    yield from _bores(touching)
    yield from _couplings(touching)


def _threads(touching: Touching, joints: Sequence[ScrewJoint]) -> Iterator[Gap]:
    """Threads of turned and bought parts in which is no screw; a plate may have more than it needs."""
    used = {(joint.holder, *joint.hole.mouth.round(3).tolist()) for joint in joints}
    for k, body in enumerate(touching.bodies):
        if body.part.turned is None and body.part.bought is None:
            continue
        for hole in holes_of(k, body, touching.sample):
            if (k, *hole.mouth.round(3).tolist()) in used or hole.through or _bolted(touching, hole):
                continue
            yield Gap("thread", body.name, "", hole.depth, 0.0)


def _bolted(touching: Touching, hole: Hole) -> bool:
    """Whether a bolt that is made is in a thread."""
    return any(
        not one.inside
        and k != hole.body
        and abs(one.diameter - hole.diameter) < ALIKE
        and _passes(one, hole.mouth + ALIKE * hole.way, hole.way)
        for k, one in touching.rounds
    )


def _passes(one: Round, point: Array, axis: Array) -> bool:
    """Whether a round face goes round a point, along an axis."""
    if abs(one.axis @ axis) < 1 - PARALLEL:
        return False
    away = point - one.at
    along = float(away @ one.axis)
    return one.low <= along <= one.high and bool(np.linalg.norm(away - along * one.axis) <= NEAR)


def _grooves(touching: Touching) -> Iterator[Gap]:
    """Grooves of shafts in which no circlip is."""
    rings = [
        (m, body)
        for m, body in enumerate(touching.bodies)
        if body.part.bought is not None and body.part.bought.standard == circlips.ON_SHAFTS
    ]
    for body in touching.bodies:
        for groove in body.part.turned.grooves if body.part.turned is not None else ():
            turn, place = body.poses.rotation[touching.sample], body.poses.position[touching.sample]
            low = turn @ np.array((0.0, 0.0, body.instance.z + groove.at)) + place
            if not any(_in_groove(touching, m, low, turn[:, 2], groove.width) for m, _ in rings):
                yield Gap("groove", body.name, "", groove.width, 0.0)


def _in_groove(touching: Touching, ring: int, low: Array, axis: Array, width: float) -> bool:
    body = touching.bodies[ring]
    turn, place = body.poses.rotation[touching.sample], body.poses.position[touching.sample]
    at = turn @ np.array((0.0, 0.0, body.instance.z)) + place
    along = float((at - low) @ axis)
    aside = float(np.linalg.norm(at - low - along * axis))
    return aside <= NEAR and -CONTACT <= along <= width + CONTACT


def _bores(touching: Touching) -> Iterator[Gap]:
    """Bearings and bushes on no shaft, and bores of what turns, in the axis of its joint, without a pin.

    A plate that stands still may have holes there for a key; its seats have fits, which are looked at
    elsewhere.
    """
    axes = [_axis(touching, joint) for joint in touching.motion.joints.values() if joint.kind == "revolute"]
    for k, hole, pins in touching.mates:
        if pins or hole.fit is not None or _loose(touching, k, hole):
            continue
        body = touching.bodies[k]
        seated = body.part.bought is not None and body.part.bought.standard in SEATED
        turns = (body.part.bought is None and touching.heads[k] != GROUND) and any(
            touching.heads[k] in heads
            and abs(axis @ hole.axis) > 1 - PARALLEL
            and np.linalg.norm(np.cross(point - hole.at, axis)) <= NEAR
            for point, axis, heads in axes
        )
        if seated or turns:
            yield Gap("empty", body.name, "", hole.high - hole.low, 0.0)


def _loose(touching: Touching, k: int, hole: Round) -> bool:
    """Whether a pin with more play than a seat has goes through a hole of a body, by its number."""
    middle = hole.at + (hole.low + hole.high) / 2 * hole.axis
    return any(
        not one.inside
        and m != k
        and 0 <= hole.diameter - one.diameter <= LOOSEST + TOLERANCES.closure
        and _passes(one, middle, hole.axis)
        for m, one in touching.rounds
    )


def _couplings(touching: Touching) -> Iterator[Gap]:
    """Motors whose shaft ends in no coupling."""
    couplings = [k for k, body in enumerate(touching.bodies) if is_coupling(body.part)]
    for k, body in enumerate(touching.bodies):
        if is_motor(body.part) and not any(touching.standing.touch(k, m) for m in couplings):
            yield Gap("motor", body.name, "", 0.0, 0.0)


def _axis(touching: Touching, joint: Joint) -> tuple[Array, Array, set[str]]:
    """A point and the direction of a joint's axis in the assembly, and the groups that it joins."""
    point, axis = np.array(joint.point), np.array(joint.axis)
    if joint.one != GROUND:
        poses = touching.motion.poses[joint.one]
        turn, place = poses.rotation[touching.sample], poses.position[touching.sample]
        point, axis = turn @ point + place, turn @ axis
    return point, axis, {touching.groups[joint.one], touching.groups[joint.two]}
