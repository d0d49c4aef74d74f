"""A checker of an order of assembly: each part held when needed, each tool reaches, each press is supported.

It replays the single steps, before copies are told of together, and gives what is wrong in words. Steps
without a straight way are for :mod:`cam.replay`.
"""

from collections.abc import Iterator

import numpy as np

from mechwright_cad.assembly_order.plan import Plan
from mechwright_cad.assembly_order.press import filled, presses, support

MOST_BY_HAND = 1
"""Units that a fitter holds at a time."""


def falling(plan: Plan) -> list[int]:
    """After each step, how many units neither are held nor rest."""
    order, found = plan.order, []
    for step in (one for one in order.steps if one.way is not None):
        there = frozenset((*step.onto, *step.moved))
        found.append(len(order.holding.falling(there, step.root, step.down)))
    return found


def loose(plan: Plan) -> list[int]:
    """After each step, how many bodies are held by nothing: they rest, or fall."""
    order, found = plan.order, []
    for step in (one for one in order.steps if one.way is not None):
        there = frozenset((*step.onto, *step.moved))
        found.append(sum(map(len, order.holding.unretained(there, step.root))))
    return found


def unreached(plan: Plan) -> Iterator[str]:
    """Screws, circlips and couplings to which no tool gets at their step."""
    order = plan.order
    for step in order.steps:
        there = frozenset((*step.onto, *step.moved))
        if len(step.moved) == 1 and step.way is not None and order.reach.needs_tool(step.moved[0]):
            (k,) = step.moved
            if order.reach.tool(k, np.array(step.way), there) is None:
                yield plan.bodies[k].name


def badly_pressed(plan: Plan) -> Iterator[str]:
    """Presses without support, and bushes that are pressed in over a pin."""
    for step in plan.order.steps:
        for match in presses(plan.order, step) if step.way is not None else ():
            if not support(plan.order, step, match).holds:
                yield f"{plan.bodies[match.hole].name} on {plan.bodies[match.pin].name}"
        yield from (plan.bodies[bush].name for bush, _ in filled(plan.order, step))


def faults(plan: Plan) -> list[str]:
    """All of it, in words."""
    found = [
        f"step {number}: {count} units fall"
        for number, count in enumerate(falling(plan), start=1)
        if count > MOST_BY_HAND
    ]
    found += [f"no tool gets to {name}" for name in unreached(plan)]
    return [*found, *(f"{what} has no support" for what in badly_pressed(plan))]
