"""How an assembly lies at a step, and what a fitter holds by hand meanwhile."""

import math
from collections.abc import Sequence

from mechwright.mechanics.mating.rounds import PARALLEL
from mechwright_cad.assembly_order.holding import UPRIGHT, Way
from mechwright_cad.assembly_order.levels import Step
from mechwright_cad.assembly_order.plan import Plan

LEVEL_FROM = 67.5
"""Angle to the upright, degrees, from which on something comes from a side."""

STEEP = 0.999
"""Coordinate of a unit vector from which on it counts as along that axis."""


class Handling:
    """What the steps of a plan say of turning over and of holding; steps count from 1."""

    def __init__(self, plan: Plan) -> None:
        self.plan = plan
        self._chains: dict[int, list[int]] = {}
        for place, step in enumerate(plan.steps):
            self._chains.setdefault(step.root, []).append(place)

    def turn(self, step: Step) -> str:
        """How the assembly is turned before a step; empty where it stays as it lies."""
        before = self._before(step)
        lay: Way = before.down if before is not None else UPRIGHT[0]
        if lay == step.down:
            return ""
        if abs(step.down[2]) < STEEP:
            if step.way is None or sum(a * b for a, b in zip(step.way, step.down, strict=True)) > STEEP:
                return "Lay it on the side first, so that this comes from above."
            x, y, _ = step.down
            return f"Lay it on {_SIDES[round(math.degrees(math.atan2(y, x)) / 45) % 8]} side first."
        return "Turn it over first." if step.down[2] > 0 else "Turn it upright first."

    def stands(self, step: Step) -> bool:
        """Whether all that is there is stood onto what comes, which lies on the bench."""
        if step.way is None or step.way[2] * step.down[2] > -PARALLEL or step.hand:
            return False
        return self.plan.order.holding.carries(frozenset((*step.onto, *step.moved)), step.root, step.moved)

    def in_turn(self, step: Step) -> int | None:
        """The next step, where both are done for one copy after the other."""
        place = self.plan.steps.index(step)
        held = set(step.hand) & set(step.moved)
        return place + 2 if held and len(step.moved) > 1 and self._all_alike(step.moved) else None

    def in_hand(self, step: Step) -> tuple[Sequence[int], int | None]:
        """Bodies, one of each unit, that are held by hand from this step on, and until which step."""
        before = self._before(step)
        units = self.plan.order.holding.units(frozenset((*step.onto, *step.moved)))
        known = frozenset(before.hand if before is not None else ())
        new = {k for k in step.hand if not units[k] & known}
        if not new:
            return (), None
        size = self.plan.order.size
        named = sorted({max(units[k] & new, key=lambda m: (size(m), -m)) for k in new})
        return named, self._until(step, new)

    def _until(self, step: Step, held: set[int]) -> int | None:
        chain = self._chains[step.root]
        later = chain[chain.index(self.plan.steps.index(step)) + 1 :]
        return next((place + 1 for place in later if not held & set(self.plan.steps[place].hand)), None)

    def _before(self, step: Step) -> Step | None:
        chain = self._chains[step.root]
        place = chain.index(self.plan.steps.index(step))
        return self.plan.steps[chain[place - 1]] if place else None

    def _all_alike(self, bodies: Sequence[int]) -> bool:
        return len({self.plan.bodies[k].part.name for k in bodies}) == 1


_ROUND = ("the right", "the back right", "the back", "the back left", "the left", "the front left")
_SIDES = (*_ROUND, "the front", "the front right")


def whence(way: Way) -> str:
    """In words whence something comes that goes along a way.

    >>> whence((0.0, 0.0, -1.0)), whence((-1.0, 0.0, 0.0))
    ('from above', 'from the right')
    >>> whence((0.0, -0.5, -0.8660254))
    'from above, tilted 30 degrees to the back'
    """
    x, y, z = way
    if abs(z) > STEEP:
        return "from above" if z < 0 else "from below"
    side = _SIDES[round(math.degrees(math.atan2(-y, -x)) / 45) % 8]
    tilt = math.degrees(math.acos(min(abs(z), 1.0)))
    if tilt > LEVEL_FROM:
        return f"from {side}"
    return f"from {'above' if z < 0 else 'below'}, tilted {tilt:.0f} degrees to {side}"
