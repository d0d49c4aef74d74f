"""The proof: a clean program passes, and each planted defect fails with its own message and line."""

import json
import re
from collections.abc import Callable
from dataclasses import replace
from itertools import groupby

import pytest
from by_control import prove
from by_night import examples
from hypothesis import given, settings
from hypothesis import strategies as st
from shop import BIAS, DRILL, MILL, SPOT, bore, plate_job, plate_program

from mechwright.errors import ProgramError, ProofError
from mechwright_cam.controls.linuxcnc import LinuxCnc
from mechwright_cam.program.moves import (
    Feed,
    Move,
    Operation,
    Pause,
    Program,
    Rapid,
    ToolSection,
)
from mechwright_cam.proof import Proof
from mechwright_cam.proof.judge import RULES, judge
from mechwright_cam.proof.scene import Scene
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.holding import Hold
from mechwright_cam.shop.posting import Posting

CLEAN = LinuxCnc().write(plate_program())


def test_the_clean_program_is_proven() -> None:
    proof = prove(CLEAN, plate_job())
    assert proof.failures == ()
    proof.require()
    assert proof.gouge_max_mm <= BIAS
    assert BIAS - 5e-4 <= proof.leftover_reachable_max_mm <= BIAS + 5e-4
    assert proof.unreachable_area_mm2 == 0
    assert proof.rapids_in_stock == 0
    assert [o.name for o in proof.operations] == ["start", "spot drill", "drill", "bore", "outside"]
    assert sum(o.time_s for o in proof.operations) == pytest.approx(proof.time_estimate_s)
    assert sum(proof.tool_times_s.values()) == pytest.approx(proof.time_estimate_s)
    assert sum(o.cutting_mm for o in proof.operations) == pytest.approx(proof.cutting_length_mm)


def test_a_proof_says_how_far_it_is() -> None:
    heard: list[tuple[float, str]] = []
    judge(Scene(CLEAN, plate_job(), LinuxCnc()), progress=lambda done, what: heard.append((done, what)))
    assert [what for what, _ in groupby(what for _, what in heard)] == [
        *("reading the program", "simulating its cuts", "asking the rules")
    ]
    rules = sorted(done for done, what in heard if what == "asking the rules")
    assert len(rules) == len(RULES) == len(set(rules))
    assert heard[0][0] == 0 < rules[0] < rules[-1] < 1


def test_proof_json_holds_what_the_report_needs() -> None:
    data = json.loads(json.dumps(prove(CLEAN, plate_job()).as_dict(), allow_nan=False))
    wanted = {
        *("ok", "gouge_max_mm", "leftover_reachable_max_mm", "unreachable_area_mm2", "unreachable"),
        *("rapids_in_stock", "checks", "time_estimate_s", "operations", "tool_times_s", "cutting_length_mm"),
    }
    assert wanted <= data.keys()
    assert data["checks"]["gouge"]["passed"] is True
    assert data["checks"]["gouge"]["limit"] == 0.005


def line_of(text: str, wanted: str, occurrence: int = 1) -> int:
    lines = [number for number, line in enumerate(text.splitlines(), 1) if wanted in line]
    return lines[occurrence - 1]


def swap(old: str, new: str, occurrence: int = 1) -> Callable[[], tuple[str, int]]:
    """The clean text with one occurrence changed, and the line of the change."""

    def change() -> tuple[str, int]:
        position = -1
        for _ in range(occurrence):
            position = CLEAN.index(old, position + 1)
        text = CLEAN[:position] + new + CLEAN[position + len(old) :]
        return text, text.count("\n", 0, position) + 1

    return change


DEFECTS = {
    "gouge": (
        swap("G1 X22\n", "G1 Y22.98\nX22\nY23.001\n", 4),
        "gouge",
        r"cuts 0\.02. mm into the finished",
        0,
    ),
    "no length offset": (swap("G43 H3 Z5", "Z5"), "length-offset", "H2 while T3|G43 H3", 0),
    "offset off": (swap("G43 H1 Z5", "Z5"), "length-offset", "without a length offset while T1", 0),
    "wrong H": (swap("G43 H2", "G43 H3"), "length-offset", "H3 while T2 .*write G43 H2", 0),
    "H of G43.1": (swap("G43 H2 Z5", "G43.1 Z50\nZ5"), "length-offset", "G43.1", 1),
    "rapid at depth": (swap("G1 X22\n", "G0 X22\n", 2), "rapid-height", "sideways rapid .* Z-2.4", 0),
    "rapid into stock": (swap("Z2\nG1 Z0 F150", "Z-1\nG1 Z-1 F150"), "rapids-in-stock", "into the stock", 0),
    "spindle off": (swap("S8000 M3", "S8000"), "spindle", "turns not at all", None),
    "spindle backwards": (swap("S8000 M3", "S8000 M4"), "spindle", "backwards", None),
    "spindle speed 0": (swap("S8000 M3", "S0 M3"), "spindle", "not at all", None),
    "no coolant": (swap("H3 Z5\nM8", "H3 Z5"), "coolant", "coolant off, planned is flood; write M8", None),
    "wrong coolant": (swap("H3 Z5\nM8", "H3 Z5\nM7"), "coolant", "coolant mist", None),
    "arc off": (swap("I11.001 J0", "I11.011 J0", 3), "arcs", r"differ by 0\.01", 0),
    "tab cut away": (swap("Z-4.9\nY4.51\nZ-6.3 F150\n", ""), "tabs", "into a tab", 0),
    "work offset": (
        swap("G54 S2400", "G55 S2400"),
        "work-offset",
        "in G55; the job is set up in G54",
        1,
    ),
    "travel": (swap("G0 X0 Y0", "G0 X0 Y600", 2), "travel", "span .* mm in Y", 0),
    "beside the stock": (
        swap("G0 Z5\nM9\nM5\n", "G1 X-61 Y-12\nG0 Z5\nM9\nM5\n"),
        "beside",
        "cuts 22.0 mm outside of the stock, 21 mm at most",
        0,
    ),
    "over-speed": (swap("S8000", "S12500"), "speeds", "S12500 is above the spindle's 12000 rpm", None),
    "under-speed": (swap("S8000", "S50"), "speeds", "S50 is below the spindle's 100 rpm", None),
    "over-feed": (swap("Z-1.2 F600", "Z-1.2 F6000"), "feeds", "feed of 6000 mm/min is above", 0),
    "no end": (swap("M30\n", ""), "program-end", "no end; write M30", 0),
    "ends down": (swap("G0 Z5\nM9\nM5\nG53 G0 Z0\n", "M9\nM5\n"), "program-end", "tool down", -1),
    "no retract": (swap("G53 G0 Z0\n(operation: bore)\n", "G0 Z1\n"), "tool-change", "without a retract", 1),
    "no height": (swap("G53 G0 Z0\n", ""), "positions", "unknown height", 3),
    "no units": (swap("G17 G21 G40", "G17 G40"), "modes", "moves before G21", None),
    "no distance mode": (swap("G80 G90 G91.1", "G80 G91.1"), "modes", "moves before G90", None),
    "milliseconds": (swap("M8\n", "M8\nG4 P2000\n"), "dwells", "2000 s", 1),
    "unknown tool": (
        swap("T2 M6", "T7 M6"),
        "tools",
        "T7 is not a tool of this job; .* T1, T2, T3",
        2,
    ),
    "no tool": (swap("T1 M6\n", ""), "tools", "no tool was changed to", 1),
}


@pytest.mark.parametrize("name", DEFECTS)
def test_a_planted_defect_is_caught(name: str) -> None:
    change, check, message, offset = DEFECTS[name]
    text, line = change()
    proof = prove(text, plate_job())
    found = proof.checks[check]
    assert not found.passed
    with pytest.raises(ProofError, match=message) as caught:
        replace(proof, checks={check: found}).require()
    assert "\n" not in str(caught.value)
    assert found.line is not None
    if offset is not None:
        assert found.line == line + offset
    assert f"line {found.line}: " in found.message or check == "program-end"


@st.composite
def spoilt(draw: st.DrawFn) -> str:
    """The clean text with lines lost, repeated, exchanged, or a number changed."""
    lines = CLEAN.splitlines()
    for _ in range(draw(st.integers(1, 4))):
        at = draw(st.integers(0, len(lines) - 1))
        match draw(st.sampled_from(["lose", "repeat", "move", "number", "word"])):
            case "lose":
                del lines[at]
            case "repeat":
                lines.insert(at, lines[at])
            case "move":
                lines.insert(draw(st.integers(0, len(lines) - 1)), lines.pop(at))
            case "number":
                lines[at] = re.sub(r"\d+", str(draw(st.integers(0, 400))), lines[at], count=1)
            case _:
                lines[at] += draw(
                    st.sampled_from([" Z-9", " X5", " G0", " F1", " M5", " G91", " G20", " M2"])
                )
    return "\n".join(lines) + "\n"


@given(spoilt())
@settings(max_examples=examples(20, 60), deadline=None)
def test_a_spoilt_program_is_judged_and_never_crashes_the_proof(text: str) -> None:
    try:
        proof = prove(text, plate_job())
    except ProgramError as error:
        told = str(error)
    else:
        json.dumps(proof.as_dict(), allow_nan=False)
        told = "line 0: " if proof.ok else f"line {proof.failures[0].message}"
    assert told.startswith("line ")
    assert "\n" not in told


def proof_of(program: Program, job: Job) -> Proof:
    return prove(LinuxCnc().write(program), job)


@pytest.mark.parametrize(("bias", "gouge"), [(-0.006, 0.006), (-0.02, 0.02), (-0.3, 0.3)])
def test_a_gouge_is_measured_exactly(bias: float, gouge: float) -> None:
    proof = proof_of(plate_program(bias=bias), plate_job())
    assert proof.gouge_max_mm == pytest.approx(gouge, abs=6e-4)
    assert not proof.checks["gouge"].passed


def test_a_gouge_within_the_limit_passes_on_a_path_that_the_control_keeps_to() -> None:
    program = plate_program(bias=-0.003)
    proof = proof_of(replace(program, posting=Posting(exact_stop=True)), plate_job())
    assert proof.ok
    assert proof.gouge_max_mm == pytest.approx(0.003, abs=6e-4)
    assert [check.name for check in proof_of(program, plate_job()).failures] == ["path-tolerance"]


@pytest.mark.parametrize("bias", [0.02, 0.011, 0.2])
def test_leftover_is_measured_on_the_wall(bias: float) -> None:
    proof = proof_of(plate_program(bias=bias), plate_job())
    assert [c.name for c in proof.failures] == ["leftover"]
    assert proof.leftover_reachable_max_mm == pytest.approx(bias, abs=6e-4)


def test_leftover_of_one_missing_move_is_found_where_it_is() -> None:
    text = CLEAN.replace(
        "Z-6.3 F150\nX22 F600\nG2 X33.001 Y12 I0 J-11.001\n", "Z5\nX33.001 Y12\nZ-6.3 F150\n"
    )
    assert text != CLEAN
    proof = prove(text, plate_job())
    at = proof.checks["leftover"].at
    assert at is not None
    assert at[0] > 0 < at[1]
    assert proof.leftover_reachable_max_mm > 1


def test_a_cut_that_stops_short_of_the_underside_is_found() -> None:
    proof = prove(CLEAN.replace("Z-6.3", "Z-5.9"), plate_job())
    assert proof.checks["depth"].message == "bore is cut down to Z-5.900, its floor is at Z-6.000" or (
        "outside is cut down to Z-5.900" in proof.checks["depth"].message
    )
    assert not proof.checks["leftover"].passed


def test_only_centre_cutting_tools_plunge() -> None:
    blunt = MILL.model_copy(update={"centre_cutting": False})
    proof = prove(CLEAN, plate_job(tools=(SPOT, DRILL, blunt)))
    assert [c.name for c in proof.failures] == ["entries"]
    assert proof.failures[0].line == line_of(CLEAN, "G1 Z-6.3 F150")
    assert "plunges into the stock" in proof.failures[0].message


def test_a_plunge_into_a_hole_is_no_plunge_into_stock() -> None:
    # An 8 mm drill has been there before the 6 mm mill, which may go down in the hole.
    blunt = MILL.model_copy(update={"centre_cutting": False})
    moves: tuple[Move, ...] = (Rapid(0.0, 0.0), Rapid(z=1.0), Feed(None, None, -6.0, 100.0), Rapid(z=5.0))
    program = plate_program()
    drilled = ToolSection(blunt, 8000, "flood", (Operation("down", moves),))
    proof = proof_of(
        replace(program, sections=(*program.sections[:2], drilled)), plate_job(tools=(SPOT, DRILL, blunt))
    )
    assert proof.checks["entries"].passed


def test_a_ramp_has_a_limit() -> None:
    assert prove(CLEAN, plate_job(ramp_angle=1)).ok  # a preference of the design: this mill does more
    for limit, angle, guilty in ((2.8, "2.9", "Y12 Z-1.2"), (2.5, "2.7", "G3 X2.999 Y0 Z-0.9")):
        gentle = MILL.model_copy(update={"ramp_angle": limit})
        proof = prove(CLEAN, plate_job(tools=(SPOT, DRILL, gentle)))
        assert [c.name for c in proof.failures] == ["entries"]
        assert f"{angle} degrees" in proof.failures[0].message
        assert proof.failures[0].line == line_of(CLEAN, guilty)


def test_flutes_have_a_length() -> None:
    short = MILL.model_copy(update={"flute_length": 6.0})
    proof = prove(CLEAN, plate_job(tools=(SPOT, DRILL, short)))
    assert [c.name for c in proof.failures] == ["flutes"]
    assert "6.300 mm deep" in proof.failures[0].message


def test_the_spot_drill_s_point_may_stand_in_the_bore_but_not_beside_it() -> None:
    deep = CLEAN.replace("G81 X0 Y0 Z-2", "G81 X4 Y0 Z-2")
    assert prove(deep, plate_job()).gouge_max_mm <= BIAS  # 4 + 2 (90° point at 2 mm) is just the radius of 6
    proof = prove(CLEAN.replace("G81 X0 Y0 Z-2", "G81 X4.1 Y0 Z-2"), plate_job())
    assert proof.gouge_max_mm == pytest.approx(0.1, abs=1e-3)


def test_a_bore_that_is_cut_too_small_is_named():
    program = plate_program()
    section = program.sections[2]
    small = (bore(MILL.radius, bias=0.03), *section.operations[1:])
    program = replace(program, sections=(*program.sections[:2], replace(section, operations=small)))
    proof = prove(LinuxCnc().write(program), plate_job())
    assert proof.leftover_reachable_max_mm == pytest.approx(0.03, abs=1e-3)
    assert "0.030 mm of stock stay on the wall of bore, which is to be cut to" in proof.failures[0].message


def clamped_program(*, pause: bool, swing: float) -> Program:
    program = plate_program()
    bore_moves = bore(MILL.radius)
    stop: tuple[Move, ...] = (Pause("set the clamp"), Rapid(-swing, 0.0), Rapid(z=20.0)) if pause else ()
    section = program.sections[2]
    outside = section.operations[1]
    # Without tabs the last pass runs through.
    low: list[Move] = [m for m in outside.moves if not (isinstance(m, Feed) and m.z == -4.9)]
    high = [Rapid(m.x, m.y, 20.0) if isinstance(m, Rapid) else m for m in low]
    lowered = [Rapid(*start) for start in [(-33.001, -12.0)]]
    outside = Operation("outside", (*lowered, Rapid(z=2.0), *high[2:]))
    operations = (bore_moves, Operation("clamp", stop), outside) if pause else (bore_moves, outside)
    return replace(
        program, clearance=20.0, sections=(*program.sections[:2], replace(section, operations=operations))
    )


def test_a_clamp_is_missed() -> None:
    job = plate_job(hold=Hold(method="bore", clamp_diameter=20, clamp_height=15), clearance=20.0)
    assert job.clamp is not None
    text = LinuxCnc().write(clamped_program(pause=True, swing=40.0))
    text = text.replace("G0 X0 Y0\nG43 H1 Z5", "G0 X0 Y0\nG43 H1 Z20").replace("H2 Z5", "H2 Z20")
    proof = prove(text, job)
    assert proof.failures == ()


def test_a_clamp_is_hit() -> None:
    job = plate_job(hold=Hold(method="bore", clamp_diameter=62, clamp_height=15), clearance=20.0)
    text = LinuxCnc().write(clamped_program(pause=True, swing=40.0))
    proof = prove(text, job)
    hit = proof.checks["clamp"]
    assert not hit.passed
    assert hit.line is not None
    assert hit.line > line_of(text, "M0")
    assert "into the clamp (diameter 62 mm" in hit.message


def test_without_a_stop_the_clamp_is_there_from_the_start() -> None:
    job = plate_job(hold=Hold(method="bore", clamp_diameter=20, clamp_height=15), clearance=20.0)
    proof = proof_of(clamped_program(pause=False, swing=0.0), job)
    assert not proof.checks["clamp"].passed
