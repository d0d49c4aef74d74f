"""Plates that drive each other, as gears do, or a lock and its wheel: the thinner faces the other in full."""

from collections.abc import Iterator

from mechwright.contracts.joint import Joint
from mechwright.mechanics.mating.rounds import CONTACT
from mechwright_cad.contacts.touching import Gap, Touching

DRIVING = frozenset({"gear", "contact"})
"""Kinds of joints between surfaces that push each other."""


def disengaged(touching: Touching) -> Iterator[Gap]:
    """Driving pairs of which one body has no plate, or whose plates do not stand at one height.

    Left out are pairs without any plate, as bevel gears are, and round pins that drive, which have a seat.
    """
    told: set[frozenset[str]] = set()
    for joint in touching.motion.joints.values():
        pair = frozenset((joint.one, joint.two))
        if joint.kind not in DRIVING or joint.radius or pair in told:
            continue
        told.add(pair)
        found = _least(touching, joint)
        if found is not None:
            yield found


def _least(touching: Touching, joint: Joint) -> Gap | None:
    """The gap of the plates that overlap best; None where they overlap in full."""
    ones, twos = (_plates(touching, body) for body in (joint.one, joint.two))
    if not ones and not twos:
        return None
    if not ones or not twos:
        missing, other = (joint.one, twos[0]) if not ones else (joint.two, ones[0])
        low, high = touching.heights(other)
        return Gap("missing", missing, touching.bodies[other].name, high - low, 0.0)
    gaps = [_gap(touching, one, two) for one in ones for two in twos]
    least = min(gaps, key=lambda gap: gap.gap - gap.play)
    return least if least.gap > CONTACT + least.play else None


def _gap(touching: Touching, one: int, two: int) -> Gap:
    """Which part of the thinner of two plates, mm, does not face the other."""
    (a0, a1), (b0, b1) = touching.heights(one), touching.heights(two)
    thinner = min(a1 - a0, b1 - b0)
    facing = max(min(a1, b1) - max(a0, b0), 0.0)
    first, second = touching.bodies[one], touching.bodies[two]
    return Gap("driving", first.name, second.name, thinner - facing, max(first.part.play, second.part.play))


def _plates(touching: Touching, body: str) -> list[int]:
    """Numbers of the plates of a body of the motion, and of all that is fixed to it."""
    head = touching.groups[body]
    return [k for k, one in enumerate(touching.bodies) if touching.heads[k] == head and one.is_plate]
