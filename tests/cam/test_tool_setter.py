"""Programs that measure tools on a setter: their lines, what is refused, and what LinuxCNC makes of them."""

import re
from dataclasses import replace

import pytest
from by_control import BY_NAME
from planning_parts import bore, job, plate
from rs274 import needs_rs274, run_rs274

from mechwright.errors import ProgramError, ProofError
from mechwright_cam.pages.setup_sheet import setup_html
from mechwright_cam.planning import plan
from mechwright_cam.proof.measuring import prove_lengths
from mechwright_cam.setup.job import Job
from mechwright_cam.setup.setter import measures_tools, tool_touches, unmeasured

SETTER = {"x": -30.0, "y": -300.0, "over": 42.5}
MEASURING = [name for name, control in BY_NAME.items() if not control.cannot_measure(())]


def measured_job(**changes: object) -> Job:
    settings = {"setter": SETTER, "machine": {"retract_z": -2.0}} | changes
    return job(plate(bore(12.0)), "spot-6", "drill-8", "mill-6", **settings)


def texts(control: str, of: Job, units: str = "mm") -> tuple[dict[str, str], tuple[int, ...]]:
    touches = tool_touches(of, plan(of))
    made = BY_NAME[control].speaking(units).measure(touches, of.settings.machine)  # type: ignore[arg-type]
    return made, tuple(number for number, _ in touches.tools)


def test_the_lines_of_linuxcnc() -> None:
    made, numbers = texts("linuxcnc", measured_job())
    ((name, text),) = made.items()
    assert name == "plate-lengths"
    code = [line for line in text.splitlines() if not line.startswith("(")]
    tool = numbers[0]
    assert code[:17] == [
        *("G17 G21 G40 G49 G80 G90 G91.1 G94", "G61", "M5", "M9", "G53 G0 Z-2", "G54", f"T{tool} M6", "G49"),
        *("G53 G0 X-30 Y-300", "G91", "G38.2 Z-100 F150", "G0 Z2", "G38.2 Z-4 F25", "G90"),
        *(f"G10 L10 P{tool} Z42.5", "G53 G0 Z-2", f"T{numbers[1]} M6"),
    ]
    assert code[-2:] == ["G53 G0 Z-2", "M30"]
    assert len(re.findall("G10", text)) == len(numbers) == len(set(numbers))


def test_grbl_has_a_program_for_each_tool_and_sets_the_work_offset() -> None:
    made, numbers = texts("grbl", measured_job(work_offset="G55"))
    assert list(made) == [f"plate-lengths-t{number}" for number in numbers]
    for text in made.values():
        assert re.findall("G10.*", text) == ["G10 L20 P2 Z42.5"]
        assert "M6" not in text


@pytest.mark.parametrize("units", ["mm", "inch"])
@pytest.mark.parametrize("control", MEASURING)
def test_they_are_proven(control: str, units: str) -> None:
    of = measured_job()
    made, numbers = texts(control, of, units)
    prove_lengths(made, of, BY_NAME[control], numbers)


@pytest.mark.parametrize("control", MEASURING)
@pytest.mark.parametrize(
    ("old", "new", "why"),
    [
        ("G53 G0 Z-2\nG54", "G54", "goes sideways|changes the tool"),
        ("G53 G0 Z-2\nG54", "G53 G0 Z300\nG54", "machine Z 300, and Z travels from -400 to 0"),
        ("G53 G0 X-30 Y-300", "G53 G0 X-30 Y-500", "machine Y -500, and Y travels from -400 to 400"),
        ("G53 G0 X-30 Y-300\n", "", "touches elsewhere than over the setter"),
        ("G53 G0 X-30 Y-300", "G53 G0 X-31 Y-300", "1.000 mm beside the setter"),
        ("G53 G0 X-30 Y-300", "G0 X-30 Y-300", "none of what a program that measures tools does"),
        ("G38.2 Z-100 F150", "G38.3 Z-100 F150", "G38.3"),
        ("G38.2 Z-100 F150", "G38.2 Z-200 F150", "touches 200 mm down, 100 mm at most"),
        ("G38.2 Z-100 F150", "G38.2 Z-100 F1500", "with 1500 mm/min, 150"),
        ("G38.2 Z-100 F150", "G1 Z-100 F150", "G1"),
        ("G91\n", "", "by a distance"),
        ("G0 Z2", "G0 Z-2", "goes to a height that no touch has found"),
        ("G38.2 Z-4 F25\n", "", "without two touches"),
        ("Z42.5\n", "Z4.25\n", "writes Z4.25 where the setter's top is at 42.5"),
        (r"G10 L(\d+) P(\d+)", r"G10 L\1 P77", "G10 L.* P77 is no entry of"),
        (r"G10 L\d+", "G10 L2", "G10 L2 P.* is no entry"),
        (r"G10.*\n", "", "is no tool of this job|is not measured"),
        ("M5\n", "S900 M3\n", "S900 M3"),
        ("M5\n", "G55 M5\n", "G55"),
        ("M30\n", "", "the program has no end"),
        ("G90\n", "G90\n#1=3\n", "is more than a program that measures tools may say"),
    ],
)
def test_a_planted_fault_is_refused_in_its_line(control: str, old: str, new: str, why: str) -> None:
    of = measured_job()
    made, numbers = texts(control, of)
    name = next(iter(made))
    changed, count = re.subn(old, new, made[name], count=1)
    assert count == 1
    with pytest.raises(ProofError, match=rf"^{name}(?:: line \d+)?.*(?:{why})"):
        prove_lengths(made | {name: changed}, of, BY_NAME[control], numbers)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"x": -501.0}, "x is -501, and X travels from -500 to 500"),
        ({"y": 401.0}, "y is 401, and Y travels from -400 to 400"),
        ({"start": -401.0}, "start is -401, and Z travels from -400 to 0"),
    ],
)
def test_a_setter_outside_of_the_travel_is_refused_before_any_program(
    changes: dict[str, float], said: str
) -> None:
    assert unmeasured(measured_job(setter=SETTER | changes)) == said


def test_the_setter_is_clear_of_the_stock_where_both_are_known() -> None:
    near = measured_job(measured={"x": -40.0, "y": -270.0, "z": -350.0})
    made, numbers = texts("linuxcnc", near)
    with pytest.raises(ProofError, match=r"the setter is .* mm beside the stock at G54, 20 mm at least"):
        prove_lengths(made, near, BY_NAME["linuxcnc"], numbers)
    far = measured_job(measured={"x": -300.0, "y": -250.0, "z": -350.0})
    prove_lengths(made, far, BY_NAME["linuxcnc"], numbers)


def test_a_rapid_stops_over_the_setter_where_lengths_are_known() -> None:
    place = {"x": -300.0, "y": -250.0, "z": -350.0}
    lengths = {"spot-6": 80.0, "drill-8": 110.0, "mill-6": 70.0}
    for start, ends in ((-190.0, True), (-199.0, False)):
        of = measured_job(setter={**SETTER, "start": start, "travel": 120.0}, measured=place)
        tools = tuple(tool.model_copy(update={"length": lengths[tool.name]}) for tool in of.tools)
        of = replace(of, tools=tools)
        made, numbers = texts("linuxcnc", of)
        assert f"G53 G0 Z{start:g}" in made["plate-lengths"]
        if ends:
            prove_lengths(made, of, BY_NAME["linuxcnc"], numbers)
            continue
        with pytest.raises(
            ProofError, match=r"would stand -1\.5 mm over the setter .* raise cam\.setter\.start"
        ):
            prove_lengths(made, of, BY_NAME["linuxcnc"], numbers)


@needs_rs274
@pytest.mark.parametrize("units", ["mm", "inch"])
def test_linuxcnc_writes_the_lengths_that_are_meant(units: str, tmp_path) -> None:
    """Its interpreter, without a machine, takes the end of each touch for the contact."""
    of = measured_job()
    made, numbers = texts("linuxcnc", of, units)
    table = "".join(f"T{number} P{number} Z0 D6\n" for number in numbers)
    canon = run_rs274(made["plate-lengths"], tmp_path, table)
    assert canon.ok, canon.error
    entries = re.findall(r"SET_TOOL_TABLE_ENTRY\(0, (\d+), [-\d.]+ [-\d.]+ ([-\d.]+)", canon.text)
    assert [int(number) for number, _ in entries] == list(numbers)
    # Without a setter each touch goes its whole way, and the control is told 0.254 mm less. Inches.
    stands = -2 - 100 + 0.254 + 2 - 4 + 0.254
    assert [float(z) for _, z in entries] == pytest.approx([(stands - 42.5) / 25.4] * len(numbers), abs=2e-4)


def test_what_cannot_be_measured_is_refused_by_name() -> None:
    assert measures_tools(measured_job())
    assert not measures_tools(job(plate(bore(12.0)), "mill-6"))
    assert "spot-6 is wider than the setter (5 mm)" in unmeasured(
        measured_job(setter={**SETTER, "diameter": 5.0})
    )
    assert "above the retract" in unmeasured(measured_job(setter={**SETTER, "start": -1.0}))
    of = measured_job()
    for name, control in BY_NAME.items():
        if name not in MEASURING:
            assert "has no program that measures tools here" in control.cannot_measure(of.tools)
            with pytest.raises(ProgramError, match="has no program that measures tools"):
                texts(name, of)
    known = [of.tools[0].model_copy(update={"length": 70.0})]
    assert "has tool lengths in its programs" in BY_NAME["grbl"].cannot_measure(known)


@pytest.mark.parametrize("setter", [{"x": 1.0}, {"x": 1.0, "y": 2.0}, {"over": 3.0}])
def test_half_a_setter_is_none(setter: dict[str, float]) -> None:
    with pytest.raises(ValueError, match="give x, y and over of the setter"):
        measured_job(setter=setter)


@pytest.mark.parametrize("control", MEASURING)
def test_the_sheet_says_how(control: str) -> None:
    of = measured_job()
    made, _ = texts(control, of)
    page = setup_html(of, plan(of), None, BY_NAME[control], measuring=tuple(made))
    assert "Or measure" in page
    assert all(name + BY_NAME[control].suffix in page for name in made)
    assert "machine X −30.00, Y −300.00" in page
