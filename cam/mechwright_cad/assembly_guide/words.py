"""What a step says: what goes where, with which tool, how tightly, and what to try at its end."""

from collections.abc import Iterator, Sequence

import numpy as np

from mechwright.contracts.axial_stack import AxialStack
from mechwright.contracts.bodies import rigid
from mechwright.contracts.fitting_marks import FittingMark
from mechwright.contracts.marking import FITTING_MARKS
from mechwright.contracts.part import Part
from mechwright.mechanics.mating.rounds import Match, matches, rounds_of
from mechwright.mechanics.strength.tightening import torque_text
from mechwright_cad.assembly_guide.adjusting import Adjusting
from mechwright_cad.assembly_guide.bonding import DROP, Bonding
from mechwright_cad.assembly_guide.columns import Columns
from mechwright_cad.assembly_guide.dowelling import Dowelling
from mechwright_cad.assembly_guide.facing import facings
from mechwright_cad.assembly_guide.handling import Handling, whence
from mechwright_cad.assembly_guide.pin_places import chosen_hole, depths
from mechwright_cad.assembly_guide.pressing import BENCH, pressed
from mechwright_cad.assembly_guide.tools import fitted, is_outer_ring, keyed, screwed
from mechwright_cad.assembly_order.groups import is_bearing
from mechwright_cad.assembly_order.levels import Step
from mechwright_cad.assembly_order.plan import Plan
from mechwright_cad.assembly_order.reach import Tool
from mechwright_cad.bodies import is_coupling, is_spring

NEXT = 0.6
"""How much further than the nearest lies what also counts as met, mm: more than the gap between links."""

ALIKE = 0.1
"""Threads whose depths differ by less, mm, are alike."""

UPWARDS = 0.5
"""Share of a way that goes against the floor, from which on what comes along it comes from underneath."""

_TRIED = {
    "prismatic": "slides freely on",
    "revolute": "turns freely on",
    "gear": "meshes freely with",
}
"""Kind of a joint to what is tried of it."""


class Words:
    """The sentences of a plan, with the numbers of its items."""

    def __init__(self, plan: Plan, numbers: dict[str, int], stacks: Sequence[AxialStack] = ()) -> None:
        self.plan, self.numbers = plan, numbers
        self._heads = rigid(plan.motion)
        self._handling, self._adjusting = Handling(plan), Adjusting(plan, stacks)
        self._last = {k: step for step in plan.steps for k in step.moved}
        self._first = {k: step for step in reversed(plan.steps) for k in step.moved}
        self._last |= {plan.sequence[0]: plan.steps[0]} if plan.steps else {}
        self._columns = Columns(plan)
        self._bonding = Bonding(plan, self._adjusting, self.name)
        self._dowelling = Dowelling(plan, self.name)
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
        omitted = self._adjusting.omitted_ring(step)
        if omitted:
            return [
                f"Keep {self.names(step.moved)} back: step {omitted} measures the play and says what goes in "
                "here."
            ]
        plan = self.plan
        found = matches(plan.bodies, plan.sample, step.moved, step.onto)
        turn = self._handling.turn(step)
        said = [
            *([turn] if turn else []),
            *self._punched(step),
            self._moves(step, found),
            *self._by_hand(step),
        ]
        said += self._from_below(step)
        said += facings(plan, step, self.name)
        aligned = list(self._adjusting.aligning(step))
        said += aligned[:1]
        said += dict.fromkeys(self._fits(match, step) for match in found if self._fast(match))
        said += dict.fromkeys(depths(plan.order, step, found, self.name))
        said += dict.fromkeys(filter(None, (chosen_hole(plan.order, match, self.name) for match in found)))
        new = [k for k in step.moved if self._first[k] is step]
        said += dict.fromkeys(sentence for k in new for sentence in self._ends(k))
        said += dict.fromkeys(filter(None, (self._screwed(k, self._columns.later(k), step) for k in new)))
        if not any(self._columns.later(k) for k in new):
            said += self._adjusting.crosswise(step)
        said += aligned[1:]
        said += dict.fromkeys(filter(None, (self._turned_on(k) for k in new)))
        said += self._drawn_tight(step)
        if self._tight_in(step) and plan.order.seats.is_bush(step.moved[0]):
            said.append(f"{BENCH} Use a mandrel as thick as the shaft, with a shoulder.")
        said += dict.fromkeys(filter(None, (fitted(plan.bodies[k].part) for k in new)))
        there = [(k, plan.bodies[k].part) for k in (*step.onto, *step.moved)]
        said += dict.fromkeys(filter(None, (keyed(plan.bodies[k].part, there, self.name) for k in new)))
        said += dict.fromkeys(
            mark.note
            for k in (*step.onto, *step.moved)
            for mark in plan.bodies[k].part.marks
            if self._marked(k, mark) is step
        )
        hooked = self._adjusting.hooked
        if (
            hooked
            and any(is_spring(plan.bodies[k].part) for k in new)
            and hooked > plan.steps.index(step) + 1
        ):
            said.append(f"Hang it on one of its pins; step {hooked} hooks its other end.")
        said += self._dowelling.sentences(step)
        said += dict.fromkeys(self._tries(step, found))
        said += self._adjusting.shafts(step, self.name)
        said += self._adjusting.measured(step, loose=any(self._columns.later(k) for k in step.moved))
        said += self._bonding.chosen(step)
        said += self._adjusting.run_in(step)
        return said

    def _ends(self, k: int) -> Iterator[str]:
        """Which end of a pillar is up where its threads are not alike, as a screw would meet a bottom."""
        body = self.plan.bodies[k]
        depths = {one.end: one.depth for one in body.part.turned.threads} if body.part.turned else {}
        if len(depths) < 2 or abs(depths["upper"] - depths["lower"]) < ALIKE:
            return
        up, down = depths["upper"], depths["lower"]
        if body.poses.rotation[self.plan.sample][2, 2] < 0:
            up, down = down, up
        yield f"The thread {up:g} mm deep of {self.name(k)} goes up, that of {down:g} mm down."

    def _marked(self, k: int, mark: FittingMark) -> Step | None:
        """The step in which a mark is told: of a spring once what it pulls stands in all of its bearings."""
        hooked = self._adjusting.hooked
        if hooked and is_spring(self.plan.bodies[k].part):
            return self.plan.steps[hooked - 1]
        return (self._first if mark.joins else self._last).get(k)

    def _punched(self, step: Step) -> Iterator[str]:
        """Where dots are punched in parts that have none engraved, while they still lie on the bench."""
        for k in (*step.onto, *step.moved):
            part = self.plan.bodies[k].part
            first = self._first.get(k, self.plan.steps[0]) is step
            dots = [mark.dots for mark in part.marks if mark.dots and first and not _has_dots(part)]
            if dots:
                places = "; and ".join(" and ".join(f"x {x:.1f}, y {y:.1f}" for x, y in one) for one in dots)
                yield (
                    f"On the bench first: centre-punch the top face of {part.name}, at {places} mm from "
                    "its axis."
                )

    def _by_hand(self, step: Step) -> Iterator[str]:
        both = self._handling.in_turn(step)
        if both is not None:
            screws = self.names(self.plan.steps[both - 1].moved[:1])
            yield f"Take one after the other with {screws} of step {both}: hold it by hand until that is in."
            return
        held, until = self._handling.in_hand(step)
        if held:
            yield f"Hold {self.names(held)} by hand{f' until step {until} is done' if until else ''}."
        if self._handling.stands(step):
            yield "Stand the whole on it."

    def _from_below(self, step: Step) -> Iterator[str]:
        """Screws that come from underneath as the assembly lies, and what they hold."""
        steps = self.plan.steps[: self.plan.steps.index(step)]
        up = step.way is not None and float(np.dot(step.way, step.down)) < -UPWARDS
        if not up or not all(self.plan.joint(k) is not None for k in step.moved):
            return
        if any(self._handling.stands(one) for one in steps):
            yield "Lay the whole on its side for it, or let it stand over the edge of the bench."
        else:
            yield (
                "As it lies, these come up from the bench: let it stand over the edge, or lay it on its "
                "side, and hold by hand what they screw into."
            )

    def _fits(self, match: Match, step: Step) -> str:
        """How tightly a pin goes into its hole, and how it is brought there."""
        later = self._adjusting.waits(match)
        if later is not None:
            pin, hole = self.name(match.pin), self.name(match.hole)
            return (
                f"{pin} goes {match.overlap:.1f} mm into {hole}: leave its screw there loose, step {later} "
                "tightens it."
            )
        order = self.plan.order
        press = pressed(order, step, match, self.name) if order.seats.kind(match) == "pressed" else ""
        ring = match.play[1] > 0 and any(is_bearing(self.plan.bodies[k]) for k in (match.pin, match.hole))
        return f"{self._tight(match, press)} {press if ring else ''}".rstrip()

    def _screwed(self, k: int, later: int | None = None, step: Step | None = None) -> str:
        order, part = self.plan.order, self.plan.bodies[k].part
        tool: Tool | None = "key"
        if step is not None and step.way is not None and order.reach.needs_tool(k):
            there = self._columns.there(later) if later else frozenset((*step.onto, *step.moved))
            tool = order.reach.tool(k, np.array(step.way), there)
        said = screwed(part, self.plan.joint(k), self.name, later, tool)
        return f"{said}{self._stud_end(k, step)}"

    def _stud_end(self, k: int, step: Step | None) -> str:
        """How far a stud stands out of what it is screwed into in a step."""
        there = {*step.onto} if step is not None else set()
        found = [one for one in self.plan.joints if one.screw == k and one.holder in there]
        if not found or found[0].what.head:
            return ""
        return f" Turn it in until {found[0].what.length - found[0].engaged:.1f} mm of it stand out."

    def _turned_on(self, k: int) -> str:
        """How a bar with threads in its ends, which comes onto a stud, is held and how tight it gets."""
        form = self.plan.bodies[k].part.turned
        joints = [one for one in self.plan.joints if one.holder == k]
        stud = any(not one.what.head and self.put(one.screw) < self.put(k) for one in joints)
        torques = [one.tightening.torque for one in joints if one.tightening is not None]
        if form is None or not form.flats or not stud or not torques:
            return ""
        return (
            f"Tool: two open spanners {form.flats[0].across:g} mm, one on the flats of {self.name(k)} and "
            f"one on those of what the stud stands in; tighten to {torque_text(min(torques))} N m."
        )

    def put(self, k: int) -> int:
        """The step in which a body comes."""
        return self._columns.put.get(k, 0)

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
            yield "Go round twice: first to half of the torque, then to all of it."

    def _moves(self, step: Step, found: Sequence[Match]) -> str:
        group = len({self.plan.bodies[k].part.name for k in step.moved}) > 1
        what = f"Put the group of {self.name(self.main(step))}" if group else f"Put {self.names(step.moved)}"
        near: dict[int, None] = dict.fromkeys(
            k for match in found for k in (match.pin, match.hole) if k in step.onto
        )
        tight = self._tight_in(step)
        near = self._grooved(step) or near or tight
        if not near and self._leans(step):
            touch = self.plan.order.standing.touch
            near = {k: None for k in step.onto if any(touch(k, m) for m in step.moved)}
        touched = near or self._below(step)
        where = self.names(tuple(touched or (max(step.onto, key=self.plan.order.size),)))
        pins = bool(found) and all(match.pin in step.moved for match in found) and not group
        turned = len(touched) > 0 and all(self.plan.bodies[k].part.turned for k in step.moved)
        how = "into" if pins or tight or (turned and self._leans(step)) else "onto" if touched else "beside"
        return f"{what} {how} {where}, {self.way(step)}."

    def _grooved(self, step: Step) -> dict[int, None]:
        """The shaft whose groove a circlip goes into, of all that it touches."""
        bodies, touch = self.plan.bodies, self.plan.order.standing.touch
        if not all(is_outer_ring(bodies[k].part) for k in step.moved):
            return {}
        return {
            k: None
            for k in step.onto
            for form in (bodies[k].part.turned,)
            if form is not None and form.grooves and any(touch(k, m) for m in step.moved)
        }

    def _tight_in(self, step: Step) -> dict[int, None]:
        """Solids without declared holes into which a step presses a pin or a bush."""
        order, new = self.plan.order, set(step.moved)
        known = {frozenset((one.pin, one.hole)) for one in order.seats.matches}
        found = [one.joins for one in order.holding.fastenings if one.kind == "pressed"]
        return {
            k: None
            for pair in found
            if pair not in known and len(new) == 1 and pair & new
            for k in pair - new & set(step.onto)
        }

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
        return whence(step.way)

    def _fast(self, match: Match) -> bool:
        """Whether a pin does not turn in its hole: no bearing does in its seat, no shaft in its coupling."""
        return self.plan.order.seats.is_fast(match)

    def _tight(self, match: Match, press: str) -> str:
        pin, hole = self.name(match.pin), self.name(match.hole)
        least, most = (round(value, 4) + 0.0 for value in match.play)
        if match.inside.threaded:
            return f"{pin} screws into {hole}."
        if is_coupling(self.plan.bodies[match.hole].part):
            return f"{pin} goes {match.overlap:.1f} mm into {hole}: tighten its screw there."
        if match.missing_fits:
            return f"{pin} goes through {hole} with room, {match.text}: it is no seat."
        if most <= 0:
            tight = f"{0.0 - most:.3f} to {-least:.3f} mm tight"
            drop = DROP if self.plan.order.seats.may_lack_interference(match) else ""
            return f"{pin} in {hole} is a press fit, {match.text}, {tight}. {press}{drop}"
        if least < 0:
            loose = f"from {-least:.3f} mm tight to {most:.3f} mm loose: light blows, or warm {hole}"
            return f"{pin} in {hole} is a push fit, {match.text}, {loose}.{self._bonding.compound(match)}"
        play = f"with a play of {least:.3f} to {most:.3f} mm"
        return f"{pin} slides in {hole}, {match.text}, {play}.{self._bonding.compound(match)}"

    def _tries(self, step: Step, found: Sequence[Match]) -> Iterator[str]:
        """What has to move by hand now, as it first can."""
        for match in found:
            if not self._fast(match):
                pair = frozenset(self._head(k) for k in (match.pin, match.hole))
                if pair in self._said:
                    continue
                self._said.add(pair)
                least, most = match.play
                loose = (
                    "" if match.missing_fits else f" with {least:.3f} to {most:.3f} mm of play, {match.text}"
                )
                yield (
                    f"{self._bonding.grease(match, step)} Try: {self.name(match.pin)} and "
                    f"{self.name(match.hole)} turn freely on each other by hand{loose}."
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
                if joint.kind == "gear":
                    yield "Hold one gear and rock the other: some backlash is felt at four places of a turn."

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


def _has_dots(part: Part) -> bool:
    """Whether the dots of its fitting marks are engraved."""
    return any(one.name == FITTING_MARKS for one in part.details)
