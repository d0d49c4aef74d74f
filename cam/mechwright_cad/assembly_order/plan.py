"""The plan of a build: its bodies, the steps in which they go together, and where the input stands."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from mechwright.contracts.motion import Motion
from mechwright.mechanics.strength.tightening import torque_text
from mechwright.pipeline import Build
from mechwright_cad.assembly_order.order import Order, Step
from mechwright_cad.bodies import Body, bodies_of
from mechwright_cad.contacts.screw_joints import ScrewJoint, joints_of

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

    @cached_property
    def joints(self) -> tuple[ScrewJoint, ...]:
        """All screwed joints."""
        return tuple(joints_of(self.bodies, self.sample, self.order.standing.touch))

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
    first = _at(build, build.design.solve(2), 0)
    if all(step.way is not None for step in first.steps):
        return first
    motion = build.design.solve(LOOKS)
    for sample in range(1, LOOKS):
        found = _at(build, motion, sample)
        if all(step.way is not None for step in found.steps):
            return found
    return first


def _at(build: Build, motion: Motion, sample: int) -> Plan:
    bodies = tuple(bodies_of(build.parts, motion, sample))
    order = Order(bodies, motion, sample)
    return Plan(bodies, tuple(alike(gathered(order), bodies)), motion, sample, order)


def gathered(order: Order) -> list[Step]:
    """The steps, each copy of a part right after the last one, where nothing between the two minds.

    Pillar, screw, pillar, screw become two pillars and two screws.
    """
    found: list[Step] = []
    for step in order.steps:
        place, tried = len(found), [step]
        while place and not _copy(order, found[place - 1], tried[0]):
            before = found[place - 1]
            if not _may_wait(order, before, tried[0]):
                break
            later = replace(before, onto=tuple(sorted((*before.onto, *step.moved))))
            tried[:1] = [replace(tried[0], onto=before.onto), later]
            place -= 1
        if place and _copy(order, found[place - 1], tried[0]):
            found[place:] = tried
        else:
            found.append(step)
    return found


def _copy(order: Order, one: Step, two: Step) -> bool:
    """Whether two steps put a copy of one part onto the same, the same way."""
    return (
        len(one.moved) == len(two.moved) == 1
        and one.way == two.way is not None
        and order.bodies[one.moved[0]].part.name == order.bodies[two.moved[0]].part.name
        and set(two.onto) == {*one.onto, *one.moved}
    )


def _may_wait(order: Order, one: Step, two: Step) -> bool:
    """Whether a step can as well be done after the next one, which needs nothing of it."""
    if one.way is None or len(two.moved) > 1 or set(two.onto) != {*one.onto, *one.moved}:
        return False
    barred = order.table.barred(-np.array(one.way))
    return not any(barred[k, two.moved[0]] or order.standing.touch(k, two.moved[0]) for k in one.moved)


def alike(steps: Sequence[Step], bodies: Sequence[Body]) -> list[Step]:
    """Steps that follow each other and do the same with copies of one part as one step."""
    found: list[Step] = []
    for step in steps:
        last = found[-1] if found else None
        if (
            last is not None
            and last.onto
            and last.way == step.way is not None
            and set(step.onto) == {*last.onto, *last.moved}
            and len(step.moved) == 1
            and {bodies[k].part.name for k in last.moved} == {bodies[step.moved[0]].part.name}
        ):
            found[-1] = replace(last, moved=(*last.moved, *step.moved))
        else:
            found.append(step)
    return found


def sequence(steps: Sequence[Step], count: int, root: int | None = None) -> tuple[int, ...]:
    """Bodies as they come to hand: what all goes onto, then what each group begins with and goes onto it."""
    found: dict[int, None] = {} if root is None else {root: None}
    for step in steps:
        found |= dict.fromkeys((*step.onto, *step.moved))
    return tuple(found | dict.fromkeys(range(count)))
