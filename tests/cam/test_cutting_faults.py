"""Programs in which a tool cuts with what does not cut, or takes more than it bears: refused on every control."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import pytest
from by_control import BY_NAME, CONTROLS, asked, prove
from by_night import thinned
from golden_operations import made
from test_mutations import deep

from mechwright_cam.controls.linuxcnc import LinuxCnc
from mechwright_cam.machining import Machined
from mechwright_cam.planning import plan
from mechwright_cam.program.moves import Feed, FeedArc, Move, Operation, Program, Rapid
from mechwright_cam.proof import Check, Proof
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import Tool, ToolKind

Change = Callable[[Operation], Operation | None]


def changed(program: Program, change: Change) -> Program:
    """The program with other operations; one that becomes None is left out."""
    sections = []
    for section in program.sections:
        kept = tuple(one for one in map(change, section.operations) if one is not None)
        if kept:
            sections.append(replace(section, operations=kept))
    return replace(program, sections=tuple(sections))


def only(*names: str) -> Change:
    return lambda one: one if one.name in names else None


def fed(factor: float, *names: str) -> Change:
    def change(one: Operation) -> Operation:
        if one.name not in names:
            return one
        moves = (
            replace(move, feed=math.floor(factor * move.feed)) if isinstance(move, Feed | FeedArc) else move
            for move in one.moves
        )
        return replace(one, moves=tuple(moves))

    return change


def before(program: Program, moves: Sequence[Move], tool: int) -> Program:
    """The program with some moves of a tool in front of all that it does."""
    slip = Operation("slip", tuple(moves))
    return replace(
        program,
        sections=tuple(
            replace(section, operations=(slip, *section.operations))
            if section.tool.number == tool
            else section
            for section in program.sections
        ),
    )


def files_of(program: Program, control: str) -> str | Mapping[str, str]:
    files = BY_NAME[control].files(program)
    return files if len(files) > 1 else next(iter(files.values()))


def proof_of(program: Program, job: Job, control: str) -> Proof:
    return prove(files_of(program, control), job, BY_NAME[control])


def found_by(check: str, program: Program, job: Job, control: str) -> Check:
    return asked(check, files_of(program, control), job, BY_NAME[control])


def refused(program: Program, one: Machined, control: str, check: str) -> Check:
    found = found_by(check, program, one.job, control)
    assert not found.passed
    assert found.line is not None
    assert f"line {found.line}: " in found.message
    return found


@pytest.mark.parametrize("control", thinned(3, CONTROLS))
def test_a_thread_mill_needs_the_hole_of_its_thread(control: str) -> None:
    (one,) = made("thread", control)
    found = refused(changed(one.program, only("m6: thread")), one, control, "edges")
    assert "T45 (thread-m6) is fed into material with its neck of 3.15 mm" in found.message


@pytest.mark.parametrize("control", thinned(3, CONTROLS, first=1))
def test_a_thread_mill_is_not_sunk_onto_the_rim_of_a_narrow_hole(control: str) -> None:
    """Its neck would pass, and its teeth do not cut downwards."""
    (one,) = made("thread", control)
    narrow = fitted(one, "thread-m6", diameter=7.0, neck_diameter=4.0)
    found = refused(changed(one.program, only("core: bore", "m6: thread")), narrow, control, "edges")
    assert "is fed down into material, and cuts sideways only; make its hole first" in found.message


def fitted(one: Machined, name: str, **figures: float) -> Machined:
    """The same with other figures of a tool."""
    tools = tuple(tool.model_copy(update=figures) if tool.name == name else tool for tool in one.job.tools)
    return replace(one, job=replace(one.job, tools=tools))


@pytest.mark.parametrize("control", thinned(3, CONTROLS, first=2))
def test_a_chamfer_mill_does_not_cut_with_its_point(control: str) -> None:
    (one,) = made("chamfer", control)
    found = refused(changed(one.program, only("edge: chamfer")), one, control, "edges")
    assert "T40 (chamfer-6) is fed into material with its point, which does not cut" in found.message
    engraver = fitted(one, "chamfer-6", centre_cutting=True)
    assert found_by("edges", changed(one.program, only("edge: chamfer")), engraver.job, control).passed


@pytest.mark.parametrize(("operation", "control"), thinned(3, ["drill", "spot"], CONTROLS))
def test_a_drill_is_not_fed_sideways(operation: str, control: str) -> None:
    (one,) = made(operation, control)
    tool = one.program.sections[0].tool
    slip = (Rapid(-10, 5), Rapid(z=1), Feed(None, None, -0.5, 100), Feed(0, 5, None, 100), Rapid(z=5))
    found = refused(before(one.program, slip, tool.number), one, control, "edges")
    assert (
        f"T{tool.number} ({tool.name}) is fed sideways into material, and cuts downwards only"
        in found.message
    )


@pytest.mark.parametrize(("degrees", "control"), thinned(3, [90.0, 45.0], CONTROLS))
def test_a_mill_that_ramps_elsewhere_does_not_plunge_at_full_feed(degrees: float, control: str) -> None:
    (one,) = made("pocket-contour", control)
    section = one.program.sections[0]
    full = max(move.feed for move in section.operations[0].moves if isinstance(move, Feed))

    def down(feed: float) -> Program:
        side = 1.5 / math.tan(math.radians(degrees))
        way = Feed(None, None, -1.5, feed) if degrees == 90 else Feed(round(side, 3), 0, -1.5, feed)
        moves = (Rapid(0, 0), Rapid(z=1), Feed(None, None, 0, full), way, Rapid(z=5))
        return before(one.program, moves, section.tool.number)

    found = refused(down(full), one, control, "plunges")
    assert "T23 (mill-8) down into aluminium at" in found.message
    slow = math.floor(0.3 * full)
    assert proof_of(down(slow), one.job, control).ok


@pytest.mark.parametrize(
    ("cut", "control"), thinned(3, [("slot", "slot: rough"), ("profile-inside", "window: rough")], CONTROLS)
)
def test_a_full_slot_bears_its_chip_load_and_not_twice_and_a_half(cut: tuple[str, str], control: str) -> None:
    operation, name = cut
    (one,) = made(operation, control)
    found = refused(changed(one.program, fed(2.5, name)), one, control, "chips")
    assert "mm per tooth into aluminium, the tool library says" in found.message
    assert found_by("chips", changed(one.program, fed(1.3, name)), one.job, control).passed


def turned_round(program: Program, name: str) -> Program:
    """The program with an operation in front of all others of its tool."""
    return replace(
        program,
        sections=tuple(
            replace(section, operations=tuple(sorted(section.operations, key=lambda one: one.name != name)))
            for section in program.sections
        ),
    )


@pytest.mark.parametrize("control", thinned(3, CONTROLS))
def test_finishing_before_roughing_takes_too_much(control: str) -> None:
    of, _ = deep()
    program = replace(plan(of), machine=of.settings.machine)
    assert proof_of(program, of, control).ok
    wrong = proof_of(turned_round(program, "recess: finish"), of, control)
    assert {"depth-of-cut", "chips"} & {check.name for check in wrong.failures}


def test_a_deep_cut_may_be_narrow_and_a_wide_one_shallow() -> None:
    """Adaptive clearing asks for deep cuts; a full slot as deep as they are is refused all the same."""
    of, _ = deep()
    settings = of.settings.model_copy(update={"clearing": "adaptive", "adaptive_depth": 1.5})
    of = replace(of, settings=settings)
    program = plan(of)
    assert proof_of(program, of, "linuxcnc").ok
    mill = program.sections[0].tool
    slot = (
        *(Rapid(-8, 0), Rapid(z=1), Feed(None, None, 0, 400), Feed(None, None, -9, 150)),
        *(Feed(8, 0, None, 400), Rapid(z=5)),
    )
    found = found_by("depth-of-cut", before(program, slot, mill.number), of, "linuxcnc")
    assert not found.passed
    assert "takes 9.0 mm deep and 6.0 mm wide of aluminium, 5" in found.message


@pytest.mark.parametrize("control", thinned(3, CONTROLS, first=1))
def test_finishing_the_wrong_way_round_is_told_and_refused_where_climb_is_asked_for(control: str) -> None:
    (one,) = made("conventional", control)
    program = one.program
    assert found_by("climb", program, one.job, control).message.endswith("by conventional milling")

    def job(**said: bool) -> Job:
        cam = one.job.settings
        rest = cam.model_dump(include=cam.model_fields_set - {"climb"})
        return replace(one.job, settings=type(cam).model_validate({**rest, **said}))

    asked = proof_of(program, job(climb=True), control)
    assert [check.name for check in asked.failures] == ["climb"]
    said = asked.failures[0]
    assert said.message.startswith(f"line {said.line}: T23 (mill-8) finishes ")
    assert "mm of wall by conventional milling, the job asks for climb; turn the path round" in said.message
    usual = proof_of(program, job(), control)
    assert usual.ok
    assert any("by conventional milling, the usual way is climb" in note for note in usual.notes)


def test_tools_know_whether_their_middle_cuts() -> None:
    given = {"name": "t", "number": 1, "diameter": 6, "flute_length": 3}
    assert Tool(kind=ToolKind.END_MILL, **given).hollow == 0
    chamfer = Tool.model_validate({"kind": "chamfer-mill", "tip_diameter": 1, **given})
    assert (chamfer.centre_cutting, chamfer.hollow) == (False, 0.5)
    assert Tool.model_validate({"kind": "chamfer-mill", "centre_cutting": True, **given}).hollow == 0
    assert Tool.model_validate({"kind": "thread-mill", **given}).hollow == pytest.approx(2.1)
    assert Tool.model_validate({"kind": "thread-mill", "neck_diameter": 4, **given}).hollow == 2
    for wrong in (
        {"kind": "thread-mill", "neck_diameter": 6},
        {"kind": "end-mill", "neck_diameter": 4},
        {"kind": "thread-mill", "centre_cutting": True},
    ):
        with pytest.raises(ValueError, match="thread mill"):
            Tool.model_validate({**wrong, **given})


def test_planning_keeps_to_the_ramp_that_a_tool_can_do() -> None:
    (one,) = made("pocket-contour", "linuxcnc")
    gentle = fitted(one, "mill-8", ramp_angle=1.0)
    text = LinuxCnc().write(replace(plan(gentle.job), machine=one.job.settings.machine))
    assert prove(text, gentle.job).ok
    found = asked("entries", one.text, gentle.job).message
    assert "T23 (mill-8) ramps into the stock at 1.6 degrees, the limit is 1, at " in found


@pytest.mark.parametrize(
    ("cut", "control"), thinned(3, [("profile-inside", 8, 6), ("tabs", 8, 6), ("slot", 6, 7)], CONTROLS)
)
def test_a_path_for_a_tool_of_another_diameter_is_called_so(
    cut: tuple[str, float, float], control: str
) -> None:
    operation, planned, other = cut
    (one,) = made(operation, control)
    wrong = fitted(one, f"mill-{planned}", diameter=float(other))
    proof = prove(one.text, wrong.job, BY_NAME[control])
    said = [
        proof.checks[name].message for name in ("gouge", "depth", "leftover") if not proof.checks[name].passed
    ]
    assert said
    for message in said:
        assert f"(mill-{planned}) of {other} mm runs {planned / 2:.2f}"[:-1] in message
        assert f"as one of {planned}.0" in message
        assert "the path is made for a tool of another diameter, and " in message


def test_a_single_wrong_coordinate_is_no_wrong_tool() -> None:
    (one,) = made("profile-inside", "linuxcnc")
    way = "G1 Y2.9719 F4692\n"
    assert way in one.text
    proof = prove(one.text.replace(way, f"{way}X8.9985\nX7.9985\n"), one.job)
    assert not proof.ok
    assert not any("another diameter" in check.message for check in proof.failures)
