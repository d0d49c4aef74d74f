"""What a step says: what goes where, with which tool, how tightly, and what to try at its end."""

from collections.abc import Iterator, Sequence

import numpy as np

from mechwright.contracts.bodies import rigid
from mechwright.mechanics.mating.rounds import Match, matches, rounds_of
from mechwright_cad.assembly_guide.columns import Columns
from mechwright_cad.assembly_guide.tools import fitted, screwed
from mechwright_cad.assembly_order.groups import is_bearing
from mechwright_cad.assembly_order.order import Step
from mechwright_cad.assembly_order.plan import Plan
from mechwright_cad.bodies import is_coupling

PRESS = "Press it in a vice or arbor press, with support right under the hole."
"""How a press fit is made on the bench."""

IN_PLACE = "Support that part right under the hole and draw the pin in with a clamp, or warm the part first."
"""How one is made where no press gets in."""

NEXT = 0.6
"""How much further than the nearest lies what also counts as met, mm: more than the gap between links."""

_TRIED = {
    "prismatic": "slides freely on",
    "revolute": "turns freely on",
    "gear": "meshes freely with",
}
"""Kind of a joint to what is tried of it."""

LEVEL = 0.999
"""Product of a way and the upright from which on it counts as upright, and as level below the rest of 1."""


class Words:
    """The sentences of a plan, with the numbers of its items."""

    def __init__(self, plan: Plan, numbers: dict[str, int]) -> None:
        self.plan, self.numbers = plan, numbers
        self._heads = rigid(plan.motion)
        self._last = {k: step for step in plan.steps for k in step.moved}
        self._first = {k: step for step in reversed(plan.steps) for k in step.moved}
        self._last |= {plan.sequence[0]: plan.steps[0]} if plan.steps else {}
        self._columns = Columns(plan)
        self._said: set[frozenset[str]] = set()

    def name(self, k: int) -> str:
        """A body: its part and the number of its item."""
        part = self.plan.bodies[k].part
        return f"{part.name} ({self.numbers[part.name]})"

    def names(self, those: Sequence[int]) -> str:
        """Bodies, copies of one part counted."""
        counted: dict[str, int] = {}
        for k in those:
            counted[self.name(k)] = counted.get(self.name(k), 0) + 1
        words = [name if count == 1 else f"{count} x {name}" for name, count in counted.items()]
        return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"

    def main(self, step: Step) -> int:
        """The body that a group is called by: the largest of it."""
        return max(step.moved, key=lambda k: (self.plan.order.size(k), -k))

    def title(self, step: Step) -> str:
        """A heading."""
        if step.way is None:
            return f"{self.names(step.moved)}, brought together"
        group = len({self.plan.bodies[k].part.name for k in step.moved}) > 1
        return f"The group of {self.name(self.main(step))}" if group else self.names(step.moved)

    def sentences(self, step: Step) -> list[str]:
        """What to do, in order; what to try stands last."""
        if step.way is None:
            return [
                f"No straight way brings {self.names(step.moved)} together one after the other: tilt them "
                "into each other, or take a joint apart."
            ]
        plan = self.plan
        found = matches(plan.bodies, plan.sample, step.moved, step.onto)
        said = [self._moves(step, found)]
        bench = len({self._head(k) for k in (*step.onto, *step.moved)}) == 1
        press = PRESS if bench else IN_PLACE
        said += dict.fromkeys(self._tight(match, press) for match in found if self._fast(match))
        new = [k for k in step.moved if self._first[k] is step]
        said += dict.fromkeys(filter(None, (self._screwed(k, self._columns.later(k)) for k in new)))
        said += self._drawn_tight(step)
        said += dict.fromkeys(filter(None, (fitted(plan.bodies[k].part) for k in new)))
        said += dict.fromkeys(
            mark.note
            for k in (*step.onto, *step.moved)
            if self._last.get(k) is step
            for mark in plan.bodies[k].part.marks
        )
        said += dict.fromkeys(self._tries(step, found))
        return said

    def _screwed(self, k: int, later: int | None = None) -> str:
        joint = self.plan.joint(k)
        return screwed(self.plan.bodies[k].part, joint, self.name, later)

    def _drawn_tight(self, step: Step) -> Iterator[str]:
        """The screws of a column that stands now."""
        waiting = self._columns.waiting(self.plan.steps.index(step) + 1)
        alike: dict[tuple[str, str], list[int]] = {}
        for k in waiting:
            alike.setdefault((self.plan.bodies[k].part.name, self._screwed(k)), []).append(k)
        for (_, sentence), those in alike.items():
            how = sentence.removeprefix("Tool: ")
            when = " and ".join(str(one) for one in sorted({self._columns.put[k] for k in those}))
            yield (
                f"Stand it on a flat plate, turn the shafts by hand, and draw {self.names(those)} of step "
                f"{when} tight now, crosswise: {how}"
            )

    def _moves(self, step: Step, found: Sequence[Match]) -> str:
        group = len({self.plan.bodies[k].part.name for k in step.moved}) > 1
        what = f"Put the group of {self.name(self.main(step))}" if group else f"Put {self.names(step.moved)}"
        near = dict.fromkeys(k for match in found for k in (match.pin, match.hole) if k in step.onto)
        if not near and self._leans(step):
            touch = self.plan.order.standing.touch
            near = {k: None for k in step.onto if any(touch(k, m) for m in step.moved)}
        touched = near or self._below(step)
        where = self.names(tuple(touched or (max(step.onto, key=self.plan.order.size),)))
        pins = bool(found) and all(match.pin in step.moved for match in found) and not group
        turned = len(touched) > 0 and all(self.plan.bodies[k].part.turned for k in step.moved)
        how = "into" if pins or (turned and self._leans(step)) else "onto" if touched else "beside"
        return f"{what} {how} {where}, {self.way(step)}."

    def _below(self, step: Step) -> dict[int, None]:
        """What a step would meet first if it went on."""
        assert step.way is not None  # noqa: S101 - asked of steps with a way only
        order, way = self.plan.order, np.array(step.way)
        barred = order.table.barred(way)
        ahead = {
            k: min(order.ahead(k, way, low=True) - order.ahead(m, way, low=False) for m in step.moved)
            for k in step.onto
            if barred[list(step.moved), k].any()
        }
        if not ahead:
            return {}
        return {k: None for k, far in ahead.items() if far < min(ahead.values()) + NEXT}

    def way(self, step: Step) -> str:
        """In words whence it comes."""
        assert step.way is not None  # noqa: S101 - asked of steps with a way only
        x, y, z = step.way
        if abs(z) > LEVEL:
            return "from above" if z < 0 else "from below: turn the whole over, or hold it up"
        if abs(z) < 1 - LEVEL:
            side = {(-1, 0): "the right", (1, 0): "the left", (0, -1): "the back", (0, 1): "the front"}
            return f"from {side[(round(x), round(y))]}" if max(abs(x), abs(y)) > LEVEL else "from the side"
        return "along the axis that the picture shows"

    def _fast(self, match: Match) -> bool:
        """Whether a pin does not turn in its hole: no bearing does in its seat, no shaft in its coupling."""
        one, two = (self.plan.bodies[k] for k in (match.pin, match.hole))
        alike = self._head(match.pin) == self._head(match.hole)
        return alike or any(is_bearing(body) or is_coupling(body.part) for body in (one, two))

    def _tight(self, match: Match, press: str) -> str:
        pin, hole = self.name(match.pin), self.name(match.hole)
        least, most = (round(value, 4) + 0.0 for value in match.play)
        if match.inside.threaded:
            return f"{pin} screws into {hole}."
        if is_coupling(self.plan.bodies[match.hole].part):
            return f"{pin} goes into {hole}: tighten its screw there."
        if match.unsaid:
            return f"{pin} goes through {hole} with room, {match.text}: it is no seat."
        if most <= 0:
            return (
                f"{pin} in {hole} is a press fit, {match.text}, {-most:.3f} to {-least:.3f} mm tight. {press}"
            )
        if least < 0:
            loose = f"from {-least:.3f} mm tight to {most:.3f} mm loose"
            return f"{pin} in {hole} is a push fit, {match.text}, {loose}: light blows, or warm {hole}."
        play = f"with a play of {least:.3f} to {most:.3f} mm"
        return f"{pin} slides in {hole}, {match.text}, {play}.{self._held(match)}"

    def _held(self, match: Match) -> str:
        """What keeps a pin from turning in a hole that it slides in."""
        pin, hole = (self.plan.bodies[k].part for k in (match.pin, match.hole))
        ring = any(part.turned is not None and part.turned.bore for part in (pin, hole))
        keyed = pin.turned is not None and pin.turned.seats
        screwed_down = pin.turned is not None and pin.turned.threads
        if ring or keyed or screwed_down or pin.bought is not None or hole.bought is not None:
            return ""
        return " Nothing else holds it: secure it, with retaining compound if it stays for good."

    def _tries(self, step: Step, found: Sequence[Match]) -> Iterator[str]:
        """What has to move by hand now, as it first can."""
        for match in found:
            if not self._fast(match):
                pair = frozenset(self._head(k) for k in (match.pin, match.hole))
                if pair in self._said:
                    continue
                self._said.add(pair)
                least, most = match.play
                loose = "" if match.unsaid else f" with {least:.3f} to {most:.3f} mm of play, {match.text}"
                yield (
                    f"Grease. Try: {self.name(match.pin)} and {self.name(match.hole)} turn freely on each "
                    f"other by hand{loose}."
                )
        for joint in self.plan.motion.joints.values():
            pair = frozenset((self._heads[joint.one], self._heads[joint.two]))
            if joint.kind not in _TRIED or pair in self._said or len(pair) < 2:
                continue
            if joint.kind == "revolute" and not self._leans(step):
                continue  # a pin that is put into its hole has been told of
            if self._touch(step, pair):
                self._said.add(pair)
                yield f"Try: {joint.two} {_TRIED[joint.kind]} {joint.one or 'the frame'}, by hand."

    def _leans(self, step: Step) -> bool:
        """Whether what comes has no round faces that are known: it stands askew in the assembly."""
        return not any(rounds_of(self.plan.bodies[k], self.plan.sample) for k in step.moved)

    def _touch(self, step: Step, pair: frozenset[str]) -> bool:
        """Whether what comes brings two bodies of the motion into touch."""
        return any(
            {self._head(one), self._head(two)} == pair and self.plan.order.standing.touch(one, two)
            for one in step.moved
            for two in step.onto
        )

    def _head(self, k: int) -> str:
        return self._heads[self.plan.bodies[k].instance.body]
