"""What speaks against an assembly and its order: loose parts, tools that do not reach, presses."""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from mechwright.contracts.finding import Finding, Stage, at_stage
from mechwright.pipeline import Build, Inspection
from mechwright.pipeline.work import SOLIDS

if TYPE_CHECKING:
    from mechwright_cad.assembly_order.holding import Way
    from mechwright_cad.assembly_order.levels import Step
    from mechwright_cad.assembly_order.order import Order
    from mechwright_cad.assembly_order.plan import Plan


class AssemblyOrder(Inspection):
    """The order of assembly of a machine or a chain: parts held and retained, tools that reach, presses.

    It waits for the solids, so that the plan of the assembly guide serves both.
    """

    name = "assembly-order"
    stage = Stage.ASSEMBLY
    needs = frozenset({SOLIDS})
    order = 16
    doing = "order of assembly"

    def findings(self, build: Build) -> Sequence[Finding]:
        """Nothing of a mechanism alone, whose shafts and frame are somebody else's."""
        from mechwright.machine.made import settings_of
        from mechwright.mechanics.chain import Chain
        from mechwright_cad.assembly_order.plan import plan_of

        framed = settings_of(build).frame != "none"
        bodies = sum(len(part.instances) for part in build.parts)
        if bodies < 2 or not (framed or isinstance(build.design.family, Chain)):
            return ()
        return at_stage(self.stage, order_findings(build.made(plan_of), framed=framed))


def order_findings(plan: "Plan", *, framed: bool = True) -> "Iterator[Finding]":
    """An error for each part that nothing retains, a warning for each step that a fitter cannot do.

    Without a frame nothing is said of what is held: its plates and bearings are somebody else's.
    """
    order = plan.order
    if framed:
        yield from unretained(order)
    told: set[tuple[str, ...]] = set()
    for step in order.steps:
        if step.way is None:
            continue
        held = _falling(order, step) if framed else ()
        for found in (held, _unreached(order, step), _unsupported(order, step)):
            for key, finding in found:
                if key not in told:
                    told.add(key)
                    yield finding
    yield from _locked(order)


def unretained(order: "Order") -> "Iterator[Finding]":
    """Bodies of the finished assembly that can leave their place.

    A body is moved by ``MOVE`` with what is fastened to it, and pushes on what it meets.
    """
    from mechwright_cad.assembly_order.blocking import MOVE

    if order.root is None:
        return
    told: set[str] = set()
    for unit, way in order.retention.free(frozenset(range(len(order.bodies))), order.root):
        body = order.bodies[max(unit, key=lambda k: (order.size(k), -k))]
        name = body.part.name
        if name in told:
            continue
        told.add(name)
        yield Finding.error(
            "assembly.loose",
            "",
            f"{name} of {body.instance.body} can leave its place along {_along(way)}: nothing fastens it, "
            f"and no body stops it within {MOVE:g} mm",
            remedy="give it a shoulder, a circlip or a screw, or a pin that is tight at both of its limits",
        )


def _along(way: "Way") -> str:
    """A direction as three coordinates.

    >>> _along((0.0, 0.0, -1.0))
    '(0, 0, -1)'
    """
    return f"({', '.join(f'{round(x, 2) + 0.0:g}' for x in way)})"


def _names(order: "Order", those: "Sequence[int]") -> str:
    names = list(dict.fromkeys(order.bodies[k].part.name for k in those))
    return " and ".join(names)


def _falling(order: "Order", step: "Step") -> "Iterator[tuple[tuple[str, ...], Finding]]":
    units = order.holding.units(frozenset((*step.onto, *step.moved)))
    falling = {units[k] for k in step.hand}
    if len(falling) < 2:
        return
    named = sorted(max(unit, key=lambda k: (order.size(k), -k)) for unit in falling)
    yield (
        ("held", *(order.bodies[k].part.name for k in named)),
        Finding.warning(
            "assembly.held",
            "",
            f"nothing holds {_names(order, named)} once {_names(order, step.moved[:1])} is there; a fitter "
            "holds one part by hand",
            len(falling),
            1,
            "",
            "give one of them a shoulder, a seat or a screw of its own, or hold it with a clamp",
        ),
    )


def _unreached(order: "Order", step: "Step") -> "Iterator[tuple[tuple[str, ...], Finding]]":
    import numpy as np

    from mechwright_cad.assembly_order.reach import blockers_of

    there, way = frozenset((*step.onto, *step.moved)), np.array(step.way)
    if len(step.moved) > 1 or not order.reach.needs_tool(step.moved[0]):
        return
    (k,) = step.moved
    if order.reach.tool(k, way, there) is None:
        met = sorted(blockers_of(order.reach.accesses(k, way), there))
        name = order.bodies[k].part.name
        yield (
            ("reach", name),
            Finding.warning(
                "assembly.reach",
                "",
                f"no tool gets to {name} at its step: {_names(order, met) or 'its own part'} is in the way",
                remedy="leave room for a key over its head, or put the screw in from the other side",
            ),
        )


def _unsupported(order: "Order", step: "Step") -> "Iterator[tuple[tuple[str, ...], Finding]]":
    from mechwright_cad.assembly_order.press import filled, presses, support

    for match in presses(order, step):
        if not support(order, step, match).holds:
            pin, hole = (order.bodies[k].part.name for k in (match.pin, match.hole))
            yield (
                ("press", pin, hole),
                Finding.warning(
                    "assembly.press",
                    "",
                    f"{hole} is pressed on {pin}, which only stands there",
                    remedy="press them together before, or fasten the pin first",
                ),
            )
    for pair in filled(order, step):
        bush, inside = (order.bodies[k].part.name for k in pair)
        yield (
            ("mandrel", bush, inside),
            Finding.warning(
                "assembly.press",
                "",
                f"{bush} is pressed in while {inside} is in its bore: no mandrel gets through",
                remedy="let the pin come from the other side, or take a pin without a head",
            ),
        )


def _locked(order: "Order") -> "Iterator[Finding]":
    from mechwright_cad.assembly_order.undo import locked

    for pin, hole in dict.fromkeys(
        (order.bodies[one.pin].part.name, order.bodies[one.hole].part.name) for one in locked(order)
    ):
        yield Finding.note(
            "assembly.undo",
            f"{pin} cannot be driven out of {hole} again: its hole is blind and nothing stands out",
        )
