"""The plan of a build: its bodies, the steps in which they go together, and where the input stands."""

from collections.abc import Sequence, Set
from dataclasses import dataclass, replace

import numpy as np

from mechwright.contracts.motion import Motion
from mechwright.mechanics.strength.tightening import torque_text
from mechwright.pipeline import Build
from mechwright_cad.assembly_order.levels import Step
from mechwright_cad.assembly_order.order import Order
from mechwright_cad.bodies import Body, bodies_of
from mechwright_cad.contacts.screw_joints import ScrewJoint

LOOKS = 13
"""Positions of the input that are tried, both ends of its way included."""


@dataclass(frozen=True)
class Plan:
    """Bodies in the order of the parts, and steps; ``sample`` is where the input of ``motion`` stands."""

    bodies: tuple[Body, ...]
    steps: tuple[Step, ...]
    motion: Motion
    sample: int
    order: Order

    @property
    def joints(self) -> tuple[ScrewJoint, ...]:
        """All screwed joints."""
        return self.order.joints

    def joint(self, number: int) -> ScrewJoint | None:
        """That of a screw, by its number; None of what is none, or is in no thread."""
        return next((one for one in self.joints if one.screw == number), None)

    @property
    def torques(self) -> dict[str, str]:
        """Names of screws that are tightened to a torque, and to which, in which parts."""
        found: dict[str, dict[str, list[str]]] = {}
        for one in self.joints:
            if one.tightening is not None:
                where = found.setdefault(self.bodies[one.screw].part.name, {})
                holders = where.setdefault(torque_text(one.tightening.torque), [])
                holders.append(self.bodies[one.holder].part.name)
        return {
            name: "tighten to "
            + "; ".join(
                f"{torque} N m in {', '.join(dict.fromkeys(those))}" for torque, those in where.items()
            )
            for name, where in found.items()
        }

    @property
    def turned(self) -> bool:
        """Whether the input has to be turned from its start before the mechanism goes together."""
        return self.sample > 0

    @property
    def sequence(self) -> tuple[int, ...]:
        """Numbers of the bodies in the order in which they come to hand."""
        return sequence(self.steps, len(self.bodies), self.order.root)


def plan_of(build: Build) -> Plan:
    """The plan at the start of the motion; where that holds bodies fast, at the first place that does not."""
    motion = build.design.solve(2)
    first = _order(build, motion, 0)
    if first.has_ways:
        return planned(first)
    motion = build.design.solve(LOOKS)
    others = (_order(build, motion, sample) for sample in range(1, LOOKS))
    fast = {first.bodies[k].name for k in first.stuck}
    return planned(next((one for one in others if _is_loose(one, fast) and one.has_ways), first))


def _is_loose(order: Order, names: Set[str]) -> bool:
    """Whether bodies that hold each other fast elsewhere come apart here, without a look at the others."""
    bodies = [body for body in order.bodies if body.name in names]
    return Order(bodies, order.motion, order.sample).has_ways


def _order(build: Build, motion: Motion, sample: int) -> Order:
    return Order(bodies_of(build.parts, motion, sample), motion, sample)


def planned(order: Order) -> Plan:
    """The plan of an order."""
    return Plan(order.bodies, tuple(alike(order.steps, order)), order.motion, order.sample, order)


def alike(steps: Sequence[Step], order: Order) -> list[Step]:
    """Steps that follow each other and do the same with copies of one part as one step.

    Pillar, screw, pillar, screw become two pillars and two screws where each pillar is held by hand until its
    screw is in: both steps are done for one pillar after the other.
    """
    found: list[Step] = []
    for step in steps:
        found.append(step)
        if len(found) > 1 and _together(*found[-2:]) and _copies(order, *found[-2:]):
            found[-2:] = [_merged(*found[-2:])]
        elif len(found) > 3 and _taken_in_turn(order, *found[-4:]):
            part, screw, other, another = found[-4:]
            parts = _merged(part, other)
            found[-4:] = [parts, _merged(replace(screw, onto=_there(parts)), another)]
    return found


def _together(one: Step, two: Step) -> bool:
    """Whether both steps can be told of as one: what a hand holds meanwhile is neither of both parts."""
    return not one.hand or (one.hand == two.hand and not {*one.moved, *two.moved} & {*one.hand})


def _copies(order: Order, one: Step, two: Step) -> bool:
    """Whether two steps put copies of one part onto the same root, the same way."""
    names = {order.bodies[k].part.name for k in (*one.moved, *two.moved)}
    apart = len(two.moved) == 1 and bool(one.onto)
    return apart and one.way == two.way is not None and one.root == two.root and len(names) == 1


def _taken_in_turn(order: Order, part: Step, screw: Step, other: Step, another: Step) -> bool:
    """Whether two parts, each held until its screw is in, can as well be told of in two steps."""
    if not (part.hand and other.hand and _copies(order, part, other) and _copies(order, screw, another)):
        return False
    if screw.hand or another.hand or screw.way is None:
        return False
    barred = [order.table.row(k, -np.array(screw.way)) for k in screw.moved]
    return not any(row[list(other.moved)].any() for row in barred)


def _there(step: Step) -> tuple[int, ...]:
    return tuple(sorted((*step.onto, *step.moved)))


def _merged(one: Step, two: Step) -> Step:
    return replace(
        one, moved=(*one.moved, *two.moved), down=two.down, hand=tuple(dict.fromkeys((*one.hand, *two.hand)))
    )


def sequence(steps: Sequence[Step], count: int, root: int | None = None) -> tuple[int, ...]:
    """Bodies as they come to hand: what all goes onto, then what each group begins with and goes onto it."""
    found: dict[int, None] = {} if root is None else {root: None}
    for step in steps:
        found |= dict.fromkeys((*step.onto, *step.moved))
    return tuple(found | dict.fromkeys(range(count)))
