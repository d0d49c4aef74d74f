"""Retaining compound and grease: where each goes, when, and what has to cure before."""

from collections.abc import Callable, Iterator

from mechwright.mechanics.mating.rounds import Match
from mechwright_cad.assembly_guide.adjusting import Adjusting
from mechwright_cad.assembly_order.levels import Step
from mechwright_cad.assembly_order.plan import Plan

BOND = "bond it with retaining compound"

HOW = "Degrease both, wipe off what comes out, and let it cure as the compound's sheet says."
"""How a seat is bonded."""

DROP = " Where it goes in by hand, a drop of retaining compound holds it."
"""Of a press that may have no interference at its limits."""


class Bonding:
    """The bonded seats of a plan, and how each is kept free of grease; steps count from 1."""

    def __init__(self, plan: Plan, adjusting: Adjusting, name: Callable[[int], str]) -> None:
        self.plan, self.name = plan, name
        self._later = adjusting.chosen_at
        seats = plan.order.seats
        self._bonded = [one for one in seats.matches if seats.kind(one) == "bonded"]

    def compound(self, match: Match) -> str:
        """What keeps a pin in a hole that it slides in; empty where something else does."""
        if self.plan.order.seats.kind(match) != "bonded":
            return ""
        later = self._later(match.pin)
        if later:
            return f" Nothing else keeps it there: {BOND}, once step {later} has chosen the rings."
        return f" Nothing else keeps it there: {BOND}. {HOW}"

    def chosen(self, step: Step) -> Iterator[str]:
        """Seats that are bonded at a step that has chosen the rings beside them."""
        number = self.plan.steps.index(step) + 1
        for one in self._bonded:
            if self._later(one.pin) == number:
                yield (
                    f"Now bond {self.name(one.hole)} on {self.name(one.pin)} with retaining compound, as you "
                    f"assemble them again. {HOW}"
                )

    def grease(self, match: Match, step: Step) -> str:
        """How a pin and the hole that it turns in are greased, beside seats of the same pin that are bonded.

        A bond of an earlier step has to cure first; the seat of a later one stays free of grease.
        """
        number = self.plan.steps.index(step) + 1
        own = [one for one in self._bonded if match.pin in (one.pin, one.hole)]
        before = sorted({at for one in own if (at := self.at(one)) <= number})
        after = {self.at(one): self._other(one, match.pin) for one in own if self.at(one) > number}
        cured = ""
        if before:
            steps = " and ".join(map(str, before))
            cured = f"Wait until the compound of step {steps} has cured. "
        if not after:
            return f"{cured}Grease."
        kept = ", ".join(f"that of {self.name(k)}, step {at}" for at, k in sorted(after.items()))
        return f"{cured}Grease, but leave free of it the seat that is bonded later: {kept}."

    def at(self, match: Match) -> int:
        """The step in which a seat is bonded."""
        return self._later(match.pin) or self._met(match)

    def _met(self, match: Match) -> int:
        both = {match.pin, match.hole}
        there = (both <= {*step.onto, *step.moved} for step in self.plan.steps)
        return next((number for number, found in enumerate(there, start=1) if found), 0)

    @staticmethod
    def _other(match: Match, pin: int) -> int:
        return match.hole if match.pin == pin else match.pin
