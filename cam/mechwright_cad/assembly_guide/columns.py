"""Screws of pillars and legs stay loose until their column stands: plates and shafts find their place.

A column is what stands on one upright axis: turned parts with threads in both ends, and screws.
"""

from collections.abc import Sequence

import numpy as np

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
        self.put: dict[int, int] = {}
        """The step in which each body comes."""
        for number, step in enumerate(plan.steps, start=1):
            for k in step.moved:
                self.put.setdefault(k, number)
                if _belongs(plan.bodies[k].part):
                    seen.setdefault(self._axis(k), {}).setdefault(k, number)
        pillars = {self._axis(k) for k, body in enumerate(plan.bodies) if _threaded(body.part)}
        self._tight: dict[int, int] = {}
        for axis in pillars:
            steps = seen.get(axis, {})
            last = max(steps.values(), default=0)
            early = (k for k, step in steps.items() if step < last and _headed(plan.bodies[k].part))
            self._tight |= dict.fromkeys(early, last)
        never = {self._alike(k) for k, last in self._tight.items() if not self._reached(k, last)}
        self._tight = {k: last for k, last in self._tight.items() if self._alike(k) not in never}

    def _alike(self, k: int) -> tuple[int, str]:
        """Screws that a step puts in together are drawn tight together."""
        return self.put[k], self.plan.bodies[k].part.name

    def _reached(self, k: int, last: int) -> bool:
        """Whether a tool still gets to a screw in a later step."""
        way = self.plan.steps[self.put[k] - 1].way
        return way is not None and self.plan.order.reach.tool(k, np.array(way), self.there(last)) is not None

    def there(self, last: int) -> frozenset[int]:
        """All bodies that have come up to a step."""
        return frozenset(k for k, number in self.put.items() if number <= last) | {*self.plan.sequence[:1]}

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
