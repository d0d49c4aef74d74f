"""Tapped threads: which tap, which hole, at what speed; and programs with a fault, each refused by its check."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from by_control import BY_NAME, asked, interpret
from golden_case import CORE, MORE, SHARP, hole
from golden_operations import made
from rs274 import needs_rs274, run_rs274
from test_rs274 import agree

from mechwright.contracts.details import Thread
from mechwright.contracts.part import Part, Profile
from mechwright.errors import DesignError, ProgramError, ToolError
from mechwright.geometry import Loop, Outline, circle
from mechwright_cam.controls.reading import Kind
from mechwright_cam.machining import machine
from mechwright_cam.operations.rates import rates
from mechwright_cam.planning.assign import Assignments
from mechwright_cam.planning.selection import choose_tools
from mechwright_cam.planning.setups import lay_out_setups
from mechwright_cam.shop.cutter import cutter
from mechwright_cam.shop.library import Library
from mechwright_cam.shop.machine import Machine
from mechwright_cam.shop.settings import CamSettings, CuttingChange
from mechwright_cam.shop.tool import Tool

TAP = MORE.get("tap-m6")
THREADED = Thread("m6", (0.0, 0.0), 6.0, 1.0, 4.0)
FAULTS = [
    ("linuxcnc", "tap", "K1\n", "K1.01\n", "tapping", "1.0100 mm in a turn, and its pitch is 1 mm"),
    ("fanuc", "tap", "F795.", "F790.", "tapping", "write F795.000"),
    ("haas", "tap-inch", "F37.55", "F37.5", "tapping", "its pitch is 1.27 mm"),
    ("mach3", "tap-floating", "F795", "F740", "tapping", "its pitch is 1 mm"),
    (
        "fanuc",
        "tap",
        "M29 S795\n",
        "",
        "tapping",
        "is held fast, and nothing keeps feed and spindle together",
    ),
    ("fanuc", "tap", "Z-20. R5.", "Z-20. R1.", "tapping", "1.00 mm above the plate, 2 mm at least"),
    ("fanuc", "tap", "G98 G84 X-8.", "G98 G74 X-8.", "spindle", "turns backwards (M4)"),
    ("linuxcnc", "tap-left", "M4\n", "M3\n", "spindle", "there this tap has to turn backwards (M4)"),
    ("haas", "tap", "G84 X-8.", "G81 X-8.", "tapping", "moves at rapid in the work, and tears its thread"),
    ("linuxcnc", "tap", "Z-20 K1", "Z-19 K1", "details", "m6: no right-hand helix"),
    ("linuxcnc", "tap", "Z-12 K1", "Z-13.5 K1", "gouge", "mm into the finished part"),
    ("haas", "tap-floating", "Z-6. R5.", "Z-5.9 R5.", "details", "m6: no right-hand helix"),
    ("linuxcnc", "tap", "Z-17.8022 R1", "Z-2 R1", "edges", "with its core, and cuts with its teeth alone"),
    ("linuxcnc", "tap", "G0 X8\nG33.1 Z-12", "G0 X8.1\nG33.1 Z-12", "gouge", "mm into the finished part"),
]


@pytest.mark.parametrize(("control", "operation", "old", "new", "check", "says"), FAULTS)
def test_a_fault_is_refused_by_its_check(
    control: str, operation: str, old: str, new: str, check: str, says: str
) -> None:
    (one,) = made(operation, control)
    assert old in one.text
    assert asked(check, one.text, one.job, BY_NAME[control]).passed
    found = asked(check, one.text.replace(old, new, 1), one.job, BY_NAME[control])
    assert not found.passed
    assert says in found.message


def test_every_control_reads_in_and_out_at_the_pitch() -> None:
    """Down with the tap's hand, up against it, and both as far as the cycle goes."""
    for control, operation in (("linuxcnc", "tap-left"), ("fanuc", "tap-left"), ("mach3", "tap-floating")):
        (one,) = made(operation, control)
        run, tool = BY_NAME[control].read(one.text), one.job.tools[-1]
        steps = [k for k in range(len(run)) if run.kind[k] == Kind.FEED and run.tool[k] == tool.number]
        hand = -1 if tool.left_hand else 1
        for down, up in zip(steps[::2], steps[1::2], strict=True):
            states = [run.states[int(run.state[k])] for k in (down, up)]
            assert [state.spindle for state in states] == [hand, -hand]
            assert {state.synchronous for state in states} == {not tool.floating}
            assert run.end[down, 2] == pytest.approx(-(4 + tool.point_length))
            assert run.end[up, 2] == pytest.approx(run.start[down, 2])
            assert run.feed[[down, up]] == pytest.approx(795.0)


def test_a_tap_waits_at_the_bottom_as_long_as_p_says() -> None:
    """Once for each hole, where it has come down and before it goes up; without P it does not wait."""
    head = "G17 G21 G40 G80 G90 G94\nG54 G0 X0. Y0.\nZ9.\nS500 M3\n"
    for word, seconds in (("", []), ("P750", [0.75, 0.75])):
        run = interpret(f"{head}G98 G84 X1. Y0. Z-3. R5. {word} F500.\nX2.\nG80\nM30\n", BY_NAME["fanuc"])
        waits = np.flatnonzero(run.kind == Kind.DWELL)
        assert run.seconds[waits].tolist() == seconds
        assert (run.end[waits, 2] == -3.0).all()
        assert (run.kind[waits - 1] == Kind.FEED).all()
        assert (run.kind[waits + 1] == Kind.FEED).all()


def test_after_rigid_tapping_the_spindle_of_fanuc_and_haas_stands() -> None:
    """They turn it themselves in the cycle; whoever feeds on without M3 feeds with a spindle at rest."""
    head = "G17 G21 G40 G80 G90 G94\nG54 G0 X0. Y0.\nZ9.\nS500 M3\n"
    cycle = "G98 G84 X1. Y0. Z-3. R5. F500.\nG80\nG1 Z8. F100.\n"
    for control, before, after in (
        ("fanuc", "", 1),
        ("fanuc", "M29 S500\n", 0),
        ("haas", "", 0),
        ("mach3", "", 1),
    ):
        run = interpret(head + before + cycle, BY_NAME[control])
        assert run.states[int(run.state[-1])].spindle == after
        assert [s.synchronous for s in run.states].count(True) == (0 if after else 2)
    run = interpret(
        head + "M29 S500\nG0 X2.\n" + cycle, BY_NAME["fanuc"]
    )  # another motion ends what M29 began
    assert not any(state.synchronous for state in run.states)


@pytest.mark.parametrize(
    ("pitch", "expected"), [(1.0, 795), (1.25, 795), (25.4 / 20, 795), (25.4 / 28, 791), (25.4 / 13, 793)]
)
def test_speed_times_pitch_is_a_feed_that_can_be_written(pitch: float, expected: int) -> None:
    tap = Tool(name="t", number=1, kind="tap", diameter=6, pitch=pitch, flute_length=20,
               cutting={"aluminium": {"cutting_speed": 15}})  # fmt: skip
    found = rates(tap, "aluminium", Machine())
    assert found.spindle == expected
    assert found.feed == pytest.approx(round(found.feed, 3), abs=1e-9)
    assert found.feed / found.spindle == pytest.approx(pitch, rel=1e-12)


def test_a_machine_that_cannot_go_so_slowly_is_told() -> None:
    with pytest.raises(
        ToolError, match=r"tap-m6 with its pitch of 1 mm goes 3000 mm/min at the slowest speed"
    ):
        rates(TAP, "aluminium", Machine(spindle_min=3000, max_feed=2000))


def plate(*, thickness: float = 4.0, deep: float = 4.0, thread: Thread = THREADED) -> Part:
    inner = (Loop((circle((0.0, 0.0), CORE / 2, clockwise=True),)),) if deep == thickness else ()
    return Part("plate", Outline(SHARP, inner), thickness, "aluminium",
                machined=(hole("core", 0, 0, CORE, deep),), details=(thread,))  # fmt: skip


def chosen(control: str, part: Part, *tools: Tool, **settings: object) -> tuple[set[str], list[str]]:
    """Names of the tools that a crib's chooser takes, and what is said of tapping."""
    library = Library(tuple(tool for tool in MORE if tool.kind != "tap")).extended(tools)
    cam = CamSettings.model_validate({"control": control, "stock": {"margin": 0}, **settings})
    jobs, found = lay_out_setups(part, cam, library, Assignments((), BY_NAME[control]))
    return {tool.name for tool in jobs[0].tools}, [one.message for one in found if one.code == "cam.tapping"]


def test_the_crib_decides_and_it_is_said() -> None:
    assert chosen("linuxcnc", plate()) == ({"spot-6", "drill-5", "thread-m6"}, [])
    assert chosen("linuxcnc", plate(), TAP) == (
        {"spot-6", "drill-5", "tap-m6"},
        ["m6, M6x1, is cut by the tap tap-m6"],
    )
    tools, said = chosen("linuxcnc", plate(), TAP, operations=["thread"])
    assert ("thread-m6" in tools, "tap-m6" in tools) == (True, False)
    short = TAP.model_copy(update={"flute_length": 7.9})
    tools, (said,) = chosen("linuxcnc", plate(), short)
    assert "thread-m6" in tools
    assert said == (
        "m6, M6x1, is milled: tap-m6: its flutes are 7.9 mm long, and it goes 8 mm deep with its chamfer"
    )


def test_a_blind_hole_has_room_for_chamfer_and_run_out() -> None:
    for deep, taps in ((9.0, True), (8.9, False)):
        tools, (said,) = chosen("haas", plate(thickness=12, deep=deep), TAP)
        assert ("tap-m6" in tools) is taps
        assert ("has to be 9 mm with the chamfer" in said) is not taps


@pytest.mark.parametrize(
    ("control", "change", "why"),
    [
        ("grbl", {}, "it has no tapping cycle"),
        ("grbl", {"floating": True}, "it has no tapping cycle"),
        ("mach3", {}, "does not keep feed and spindle together: a tap needs a floating holder"),
        ("mach3", {"floating": True, "left_hand": True}, "has no cycle for left-hand taps"),
    ],
)
def test_what_a_control_cannot_do_is_refused_by_name(control: str, change: dict[str, bool], why: str) -> None:
    tap = TAP.model_copy(update=change)
    thread = replace(THREADED, left=tap.left_hand)
    tools, (said,) = chosen(control, plate(thread=thread), tap)
    assert "thread-m6" in tools
    assert why in said
    (finding, *_) = BY_NAME[control].check_tools(CamSettings(), [tap])
    assert why in finding.message
    unmilled = Library(tuple(tool for tool in MORE.tools if not tool.name.startswith(("thread", "tap"))))
    unmilled = unmilled.extended((tap,))
    with pytest.raises(ToolError, match=f"no tap {thread.designation} that the control can use"):
        choose_tools(plate(thread=thread), CamSettings(), unmilled, Assignments((), BY_NAME[control]))
    jobs, _ = lay_out_setups(
        plate(thread=thread),
        CamSettings.model_validate({"tools": ["drill-5", "tap-m6"], "stock": {"margin": 0}}),
        MORE.extended((tap,)),
    )
    with pytest.raises(ProgramError, match="mill the thread"):
        machine(jobs[0], BY_NAME[control], 0)


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"pitch": None}, "a tap needs its pitch"),
        ({"pitch": 3}, "below half of its diameter"),
        ({"chamfer_length": 8, "flute_length": 8}, "the chamfer of a tap is shorter than its flute_length"),
        ({"centre_cutting": True}, "leave centre_cutting out"),
        (
            {"cutting": {"steel": {"cutting_speed": 10, "chip_load": 0.3}}},
            "is its pitch over its flutes, 0.5 mm",
        ),
        ({"kind": "drill"}, "are those of a tap"),
    ],
)
def test_a_tap_is_checked(change: dict[str, object], reason: str) -> None:
    good = {"name": "t", "number": 1, "kind": "tap", "diameter": 6, "pitch": "1 mm", "flute_length": 20}
    assert (
        Tool.model_validate({**good, "cutting": {"steel": {"cutting_speed": 10}}}).cutting["steel"].chip_load
        == 0.5
    )
    with pytest.raises(ValueError, match=reason):
        Tool.model_validate({**good, **change})


def test_a_tap_is_as_wide_as_its_thread_above_its_chamfer() -> None:
    shape = cutter(TAP)
    assert float(shape.radius_at(TAP.point_length)) == pytest.approx(3.0)
    assert float(shape.radius_at(0.0)) == pytest.approx(2.3)
    assert pytest.approx(3 - 0.6134) == TAP.hollow
    faster = MORE.cutting({"tap-m6": CuttingChange(cutting_speed=20)}).get("tap-m6")
    assert faster.cutting["aluminium"].chip_load * 3 == pytest.approx(1.0)
    with pytest.raises(DesignError, match="a tap feeds its pitch, 1 mm, in a turn"):
        MORE.cutting({"tap-m6": CuttingChange(chip_load=0.2)})


def test_below_a_blind_thread_the_point_of_its_drill_may_stay_and_nothing_else() -> None:
    """With mills in the program, too, which could reach what is left there."""
    part = plate(thickness=12, deep=10.0)
    rim = Profile("outside", SHARP, "outside", 0.0, 12.0)
    part = replace(part, machined=(*part.features, rim))
    cam = CamSettings.model_validate({"tools": ["drill-5", "tap-m6", "mill-8"]})
    (job,), _ = lay_out_setups(part, cam, MORE)
    one = machine(job, BY_NAME["linuxcnc"], 0)
    assert one.proof.ok
    assert "Z-10 R1" in one.text
    for low, check in (("Z-9.5", "depth"), ("Z-10.5", "gouge"), ("Z-7", "edges")):
        found = asked(check, one.text.replace("Z-10 R1", f"{low} R1"), one.job)
        assert not found.passed, check


START = "G17 G21 G40 G49 G80 G90 G94\nG0 X0 Y0\nG0 Z8\nS500 M3\n"


@needs_rs274
def test_linuxcnc_taps_where_it_is_read_to(tmp_path: Path) -> None:
    agree(
        START
        + "G0 Z5\nG33.1 Z-3 K1\nZ-4 K1\nG0 Z8\nG98 G84 X1 Y1 Z-3 R2 F500\nX2 Y0\nG99 G84 X3 Z-2 R3 P0.2\nX4\nG80\n"
        "M4\nG98 G74 X5 Y5 Z-3 R1 F500\nG80\nG0 X0\nM2\n",
        tmp_path,
    )


@needs_rs274
@pytest.mark.parametrize(
    ("lines", "said"),
    [
        ("G33.1 Z-3 K1 F100", "G33.1 with F"),
        ("G33.1 Z-3 K1\nZ-4 K1 F100", "G33.1 with F"),
        ("G33.1 Z-3", "G33.1 needs the pitch, K"),
        ("M5\nG33.1 Z-3 K1", "G33.1 while the spindle stands"),
        ("M5\nG98 G84 X1 Y1 Z-3 R1 F100", "G84 needs a spindle that turns clockwise"),
        ("M4\nG98 G84 X1 Y1 Z-3 R1 F100", "G84 needs a spindle that turns clockwise"),
        ("G98 G74 X1 Y1 Z-3 R1 F100", "G74 needs a spindle that turns backwards"),
        ("G98 G84 X1 Y1 Z-3 R1", "G84 without a feed"),
    ],
)
def test_what_linuxcnc_refuses_of_tapping_is_refused(lines: str, said: str, tmp_path: Path) -> None:
    text = START + lines + "\nM2\n"
    assert not run_rs274(text, tmp_path).ok
    with pytest.raises(ProgramError, match=said):
        interpret(text)


@pytest.mark.parametrize(
    ("diameter", "check", "says"),
    [
        (5.16, "gouge", ""),  # the widest core that ISO 965 lets be, as nearly as a quarter of a pitch has it
        (5.2, "gouge", "mm into the finished part"),
        (4.78, "edges", ""),
        (4.74, "edges", "drill the hole of its thread to 5 mm first"),
    ],
)
def test_the_hole_of_a_tap_is_as_wide_as_its_core(diameter: float, check: str, says: str) -> None:
    (one,) = made("tap-floating", "fanuc")
    drills = {"drill-5": one.job.tools[0].model_copy(update={"diameter": diameter})}
    job = replace(one.job, tools=tuple(drills.get(tool.name, tool) for tool in one.job.tools))
    found = asked(check, one.text, job, BY_NAME["fanuc"])
    assert found.passed is (not says)
    assert says in found.message


@pytest.mark.parametrize(("share", "taken"), [(0.97, True), (0.94, False), (1.02, False)])
def test_a_floating_holder_may_be_fed_a_little_less_than_the_pitch(share: float, taken: bool) -> None:
    (one,) = made("tap-floating", "mach3")
    text = re.sub(r"(G84.*F)([\d.]+)", lambda found: f"{found[1]}{float(found[2]) * share:.1f}", one.text)
    assert text != one.text
    assert asked("tapping", text, one.job, BY_NAME["mach3"]).passed == taken


@pytest.mark.parametrize(
    ("control", "operation", "old", "again", "taken"),
    [
        ("fanuc", "tap", r"(?m)^.*G84 .*\n", r"\g<0>X8. Y0.\nX-8. Y0.\n", False),
        ("fanuc", "tap", r"(?m)^.*G84 .*\n", r"\g<0>X-8.006 Y0.\n", False),
        ("haas", "tap", r"(?m)^G98 G84 .*\n", r"\g<0>\g<0>", False),
        ("mach3", "tap-floating", r"(?m)^G98 G84 .*\n", r"\g<0>\g<0>", False),
        ("linuxcnc", "tap", r"(?m)^G33.1 .*\n", r"\g<0>\g<0>", True),  # it waits for the encoder's index
        ("linuxcnc", "tap-floating", r"(?m)^G98 G84 .*\n", r"\g<0>\g<0>", False),
    ],
)
def test_a_thread_is_tapped_twice_only_where_the_spindle_has_a_mark(
    control: str, operation: str, old: str, again: str, taken: bool
) -> None:
    (one,) = made(operation, control)
    text, count = re.subn(old, again, one.text, count=1)
    assert count == 1
    found = asked("tapping", text, one.job, BY_NAME[control])
    assert found.passed == taken
    assert taken or "taps a thread that has been tapped before" in found.message
