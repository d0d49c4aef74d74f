"""What is set, measured and tried while a machine is put together: motor, float, shafts, backlash, run-in."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import cached_property
from itertools import takewhile

from mechwright.contracts.axial_stack import AxialStack, StackLength
from mechwright.mechanics.mating.rounds import Match
from mechwright.mechanics.strength.tightening import torque_text
from mechwright_cad.assembly_order.groups import is_bearing
from mechwright_cad.assembly_order.levels import Step
from mechwright_cad.assembly_order.plan import Plan
from mechwright_cad.bodies import is_coupling, is_motor, is_spring

CROSSWISE = 3
"""So many screws of one flange are tightened crosswise."""


class Adjusting:
    """The adjustments of a plan, each told at one step."""

    def __init__(self, plan: Plan, stacks: Sequence[AxialStack] = ()) -> None:
        self.plan, self.stacks = plan, tuple(stacks)
        self._main = [step for step in plan.steps if step.root == plan.order.root]
        self._turned: set[str] = set()

    def waits(self, match: Match) -> int | None:
        """The step at which the coupling's screw on a motor is tightened, where that is a later one."""
        one, two = self.plan.bodies[match.pin], self.plan.bodies[match.hole]
        return self.aligned if is_motor(one.part) and is_coupling(two.part) else None

    @cached_property
    def aligned(self) -> int | None:
        """The step that fastens the motor, where a coupling is on it already; None without both."""
        motors = [k for k, body in enumerate(self.plan.bodies) if is_motor(body.part)]
        couplings = [k for k, body in enumerate(self.plan.bodies) if is_coupling(body.part)]
        order = self.plan.order
        for step in self._main:
            there = frozenset((*step.onto, *step.moved))
            if not {*motors, *couplings} <= there or not motors or not couplings:
                continue
            without = there.difference(couplings)
            if not any(motors[0] in unit for unit in order.holding.unretained(without, step.root)):
                return self.plan.steps.index(step) + 1
        return None

    @cached_property
    def hooked(self) -> int | None:
        """The step after which springs pull: all that the motor does not drive from below stands by then."""
        late, springs = self.plan.order.last, [is_spring(body.part) for body in self.plan.bodies]
        before = list(takewhile(lambda step: not late & {*step.moved}, self._main))
        return self.plan.steps.index(before[-1]) + 1 if before and any(springs) else None

    def aligning(self, step: Step) -> Iterator[str]:
        """How motor and shaft come in line, at the step that fastens the motor."""
        if self.aligned == self.plan.steps.index(step) + 1:
            heads = all(self.plan.bodies[k].part.turned is None for k in step.moved)
            what = (
                "Turn them in until their heads just rest" if heads else "Screw them on until they just rest"
            )
            yield (
                f"{what}. Turn the coupling by hand, and shift the motor until the coupling neither wobbles "
                "nor binds through a whole turn; only then tighten."
            )
            yield "Tighten the screw of the coupling on the motor's shaft last, and turn once more by hand."

    def crosswise(self, step: Step) -> Iterator[str]:
        """Several screws of one flange: in two passes."""
        torques = [joint.tightening for joint in map(self.plan.joint, step.moved) if joint is not None]
        found = [one.torque for one in torques if one is not None]
        if len(found) >= CROSSWISE and len(found) == len(step.moved):
            half = torque_text(min(found) / 2)
            yield f"Tighten them crosswise in two passes: first to {half} N m, then to the torque."

    def shafts(self, step: Step, name: Callable[[int], str]) -> Iterator[str]:
        """Shafts whose bearings all sit in their seats now: they turn by hand."""
        if step.root != self.plan.order.root:
            return
        there = {*step.onto, *step.moved}
        seats, bodies = self.plan.order.seats, self.plan.bodies
        rings: dict[int, list[int]] = {}
        for one in seats.matches:
            if is_bearing(bodies[one.hole]):
                rings.setdefault(one.pin, []).append(one.hole)
        housed = {one.pin for one in seats.matches if one.hole in there}
        for shaft, on in rings.items():
            head = seats.head(shaft)
            if head not in self._turned and shaft in there and set(on) <= there & housed:
                self._turned.add(head)
                yield f"Try: {name(shaft)} turns by hand through a whole turn without a tight place."

    def measured(self, step: Step, *, loose: bool = False) -> Iterator[str]:
        """Axial stacks whose parts are all there since this step, with the rings that each takes.

        ``loose``: the screws of this step wait for a later one; for the measurement they are tight.
        """
        number = self.plan.steps.index(step) + 1
        found = [one for one in self.stacks if self._measuring.get(one.name) == number]
        if found and loose:
            yield "Draw these screws tight while you measure, and loosen them again after it."
        yield from map(_measured, found)

    def omitted_ring(self, step: Step) -> int | None:
        """The step that chooses the shim rings that this one would put in; None where none does."""
        number = self.plan.steps.index(step) + 1
        names = {self.plan.bodies[k].part.name for k in step.moved}
        later = [
            at
            for one in self.stacks
            if one.shimming is not None and one.shimming.part in names
            for at in (self._measuring.get(one.name, 0),)
            if at > number
        ]
        return min(later) if later and len(names) == 1 else None

    def chosen_at(self, shaft: int) -> int | None:
        """The step that chooses the rings over the hub of a shaft, by its body; None where there are none."""
        name = self.plan.bodies[shaft].part.name
        found = [
            self._measuring[one.name]
            for one in self.stacks
            if one.shimming is not None and one.hub_on == name and one.name in self._measuring
        ]
        return min(found, default=None)

    @cached_property
    def _measuring(self) -> dict[str, int]:
        """Names of stacks to the steps, from 1, at which they are measured: all parts there, screws in."""
        found: dict[str, int] = {}
        for number, step in enumerate(self.plan.steps, start=1):
            now, before = self._there((*step.onto, *step.moved)), self._there(step.onto)
            for one in self.stacks:
                rings = "" if one.shimming is None else one.shimming.part
                parts = [each for each in one.lengths if each.part not in {"", rings}]
                if parts and all(map(now, parts)) and not all(map(before, parts)) and one.measurable:
                    found.setdefault(one.name, self._screwed(number))
        return found

    def _screwed(self, number: int) -> int:
        """The step after one that puts screws into what came then; that step itself where none does."""
        steps = self.plan.steps
        if number < len(steps) and steps[number].root == steps[number - 1].root:
            joints = [self.plan.joint(k) for k in steps[number].moved]
            came = {*steps[number - 1].moved}
            if joints and all(one is not None and came & {k for k, _ in one.clamped} for one in joints):
                return number + 1
        return number

    def _there(self, numbers: Iterable[int]) -> Callable[[StackLength], bool]:
        """Whether some bodies have the part of a length: that copy of it where one of several is meant."""
        bodies = [self.plan.bodies[k] for k in numbers]
        names = {body.part.name for body in bodies}
        copies = {(body.part.name, body.instance.body, round(body.instance.z, 6)) for body in bodies}

        def there(length: StackLength) -> bool:
            if length.copy is None:
                return length.part in names
            return (length.part, length.copy[0], round(length.copy[1], 6)) in copies

        return there

    def run_in(self, step: Step) -> Iterator[str]:
        """What is done when all is together."""
        if step is self.plan.steps[-1] and any(joint.drives for joint in self.plan.motion.joints.values()):
            yield (
                "Run in: grease teeth and slides, turn the input by hand through one whole cycle, then run "
                "without load at low speed."
            )


def _measured(stack: AxialStack) -> str:
    """How the play of a stack is measured, and what is done about it."""
    low, high = stack.worst
    shimming = stack.shimming
    if shimming is None:
        return f"Check the {stack.name}: it is {low:.2f} to {high:.2f} mm."
    how = f"Push and pull, and measure the {stack.name} with a dial gauge"
    rings = " + ".join(f"{ring:g}" for ring in shimming.rings(stack.middle))
    given = f" At {stack.middle:.2f} mm, say, put in {rings} mm." if rings else ""
    return (
        f"{how}, without rings: it is {low:.2f} to {high:.2f} mm. Choose rings {shimming.designation} that "
        f"leave {shimming.least:g} to {shimming.least + shimming.step:g} mm of it.{given} They go "
        f"{shimming.where}: take it apart as far as that, put them in, and assemble again."
    )
