"""Which face of a plate looks up: what is drawn is not always alike from both sides."""

from collections.abc import Callable, Iterator

from mechwright_cad.assembly_order.levels import Step
from mechwright_cad.assembly_order.plan import Plan

UPRIGHT = 0.999
"""Coordinate of a plate's axis from which on it lies level."""


def facings(plan: Plan, step: Step, name: Callable[[int], str]) -> Iterator[str]:
    """A sentence for each made plate that comes to hand in a step: alone, or as what a group begins with."""
    number = plan.steps.index(step)
    before = {k for one in plan.steps[:number] for k in (*one.onto, *one.moved)}
    looks: dict[bool, list[str]] = {}
    for k in (*step.onto, *step.moved):
        body = plan.bodies[k]
        if k in before or body.part.outline is None:
            continue
        up = float(body.poses.rotation[plan.sample][2, 2])
        if abs(up) > UPRIGHT:
            names = looks.setdefault(up > 0, [])
            if name(k) not in names:
                names.append(name(k))
    for up, names in looks.items():
        yield f"{' and '.join(names)}: the face that the drawing shows looks {'up' if up else 'down'}."
