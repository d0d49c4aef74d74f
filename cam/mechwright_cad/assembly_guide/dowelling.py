"""Dowels that no body shows: the step that puts them in, and how tightly they go."""

from collections.abc import Callable, Iterator

from mechwright.contracts.fits import hole_fit, shaft_fit
from mechwright.contracts.holes import hole
from mechwright.mechanics.mating.undrawn_dowels import UndrawnDowel
from mechwright_cad.assembly_order.levels import Step
from mechwright_cad.assembly_order.plan import Plan
from mechwright_cad.bill.supplies import dowel_items

DOWEL = "m6"
"""Class of a dowel pin (ISO 8734)."""


class Dowelling:
    """The dowels of a plan that are no bodies, each told at the step that brings the last of its parts."""

    def __init__(self, plan: Plan, name: Callable[[int], str]) -> None:
        self.plan, self.name = plan, name
        self._items = dowel_items(plan.bodies, plan.sample)

    def sentences(self, step: Step) -> Iterator[str]:
        """One for dowels of a size, with the fits of their holes."""
        moved, onto = {*step.moved}, {*step.onto}
        for number, those in self._items.items():
            now = [
                one
                for one in those
                for parts in (self._parts(one),)
                if parts <= moved | onto and not parts <= onto and not parts <= moved
            ]
            if now:
                yield self._sentence(number, now)

    @staticmethod
    def _parts(one: UndrawnDowel) -> set[int]:
        return {seat.body for seat in one.seats}

    def _sentence(self, number: int, now: list[UndrawnDowel]) -> str:
        first = now[0]
        fits = [self._fit(first, k) for k in range(len(first.seats))]
        return (
            f"Drive {len(now)} x dowel ({number}), ⌀{first.diameter:g} x {first.room:g}, in: "
            f"{' and '.join(dict.fromkeys(fits))}. Use a drop of retaining compound and a soft hammer. They "
            "set the parts to each other, so they go in before any compound on the shaft has cured."
        )

    def _fit(self, one: UndrawnDowel, k: int) -> str:
        seat = one.seats[k]
        part = self.plan.bodies[seat.body].part
        inside = hole(part, seat.hole).fit or hole_fit(one.diameter, "H7")
        pin = shaft_fit(one.diameter, DOWEL)
        tight, loose = pin.upper - inside.lower, inside.upper - pin.lower
        play = f"{tight:.3f} mm tight to {loose:.3f} mm loose"
        return f"{self.name(seat.body)} {inside.short} / {DOWEL}, {play}"
