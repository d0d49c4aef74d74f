"""Screws of pillars and legs stay loose until their column stands: plates and shafts find their place.

A column is what stands on one upright axis: turned parts with threads in both ends, and screws.
"""

from collections.abc import Sequence

from mechwright.contracts.part import Part
from mechwright_cad.assembly_order.plan import Plan

_THREADS = 2
"""Of a pillar or a leg."""

_SCREW, _STUD = "ISO 4762", "ISO 4026"

_GRAIN = 2
"""Decimals of a place, mm."""


class Columns:
    """Which screws of a plan are drawn tight later than they are put in, and when.

    Steps count from 1.
    """

    def __init__(self, plan: Plan) -> None:
        seen: dict[tuple[float, float], dict[int, int]] = {}
        self.plan = plan
        for number, step in enumerate(plan.steps, start=1):
            for k in step.moved:
                if _belongs(plan.bodies[k].part):
                    seen.setdefault(self._axis(k), {}).setdefault(k, number)
        pillars = {self._axis(k) for k, body in enumerate(plan.bodies) if _threaded(body.part)}
        self._tight: dict[int, int] = {}
        for axis in pillars:
            steps = seen.get(axis, {})
            last = max(steps.values(), default=0)
            self._tight |= {
                k: last for k, step in steps.items() if _headed(plan.bodies[k].part) and step < last
            }

    def _axis(self, k: int) -> tuple[float, float]:
        body = self.plan.bodies[k]
        x, y = body.poses.position[self.plan.sample][:2]
        return round(float(x), _GRAIN), round(float(y), _GRAIN)

    def later(self, k: int) -> int | None:
        """The step that draws a screw tight, where it is not its own."""
        return self._tight.get(k)

    def waiting(self, number: int) -> Sequence[int]:
        """Screws that a step draws tight besides its own."""
        return [k for k, step in sorted(self._tight.items()) if step == number]


def _threaded(part: Part) -> bool:
    return part.turned is not None and len(part.turned.threads) == _THREADS


def _headed(part: Part) -> bool:
    return part.bought is not None and part.bought.standard == _SCREW


def _belongs(part: Part) -> bool:
    stud = part.bought is not None and part.bought.standard == _STUD
    return stud or _threaded(part) or _headed(part)
