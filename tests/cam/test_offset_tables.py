"""What a program writes into the control: its own measured offsets, and nothing else."""

import re

import pytest
from by_control import BY_NAME, CONTROLS, interpret
from machine_programs import LENGTHS, at_the_end, job_of, judged, refused, scene_of, text_of

from mechwright.errors import ProgramError
from mechwright_cam.proof import prove
from mechwright_cam.proof.offset_rules import offset_tables

OFFSETS = (
    *((control, "G57") for control in CONTROLS),
    *(("linuxcnc", "G59.3"), ("fanuc", "G54.1 P7"), ("haas", "G154 P7")),
)


@pytest.mark.parametrize(("control", "offset"), OFFSETS)
def test_a_program_sets_its_own_offsets(control: str, offset: str) -> None:
    text, job = (
        text_of(control, measured=True, work_offset=offset),
        job_of(control, measured=True, work_offset=offset),
    )
    proof = prove(text, job, BY_NAME[control])
    assert proof.failures == ()
    writes = scene_of(control, text, job).run.writes
    assert len(writes) == (1 if control == "grbl" else 1 + len(LENGTHS))


@pytest.mark.parametrize(("control", "offset"), OFFSETS)
def test_each_of_its_values_is_the_measured_one(control: str, offset: str) -> None:
    """Every number in every G10 matters: changed by a hundredth it is refused in its line."""
    text, job = (
        text_of(control, measured=True, work_offset=offset),
        job_of(control, measured=True, work_offset=offset),
    )
    lines = text.splitlines()
    tried = 0
    for index, line in enumerate(lines):
        for match in re.finditer(r"([XYZR])(-?[\d.]+)", line) if "G10" in line else ():
            value = f"{float(match[2]) + 0.01:.3f}"
            changed = line[: match.start(2)] + value + line[match.end() :]
            wrong = "\n".join([*lines[:index], changed, *lines[index + 1 :]])
            found = refused(offset_tables, control, wrong, index + 1, job)
            assert re.search(
                rf"sets {match[1]}-?[\d.]+, cam\.measured\.\S+ is -?[\d.]+; write that", found.message
            )
            tried += 1
    assert tried == (3 if control == "grbl" else 6)


@pytest.mark.parametrize(
    "words",
    [
        *("L2 P2 X-312.5", "L2 P0 X-312.5", "L20 P1 Z0.", "L2 P1 R10.", "L2 P1 X-312.5 R0.", "L2 P1"),
        *("L1 P3 R3.", "L1 P9 Z50.", "L10 P9 R50.", "L11 P3 Z77.", "L12 P3 R3.", "L13 P3 R0.", "L10 P3 X1."),
    ],
)
@pytest.mark.parametrize("control", CONTROLS)
def test_any_other_table_is_left_alone(control: str, words: str) -> None:
    text, line = at_the_end(text_of(control), f"G10 {words}")
    number, place, *values = words.split()
    table = next((t for t in BY_NAME[control].dialect.words.tables if t.number == int(number[1:])), None)
    letters = {value[0] for value in values}
    why = ""
    if table is None:
        why = r"G10 L\d+: .* is known to read G10 with L"
    elif not table.first <= int(place[1:]) <= table.last:
        why = r"G10 L\d+ P\d+: .* has P\d+ "
    elif letters.isdisjoint(table.letters):
        why = r"G10 L\d+ without a value; write one of [A-Z]"
    elif not letters <= set(table.letters):
        why = r"[A-Z] means nothing in this line"
    if not letters <= set(BY_NAME[control].dialect.words.known["G10"].takes):
        why = r"[A-Z] means nothing in this line"
    if why:
        with pytest.raises(ProgramError, match=rf"^line {line}: {why}"):
            prove(text, job_of(control), BY_NAME[control])
        return
    found = refused(offset_tables, control, text, line, job_of(control, measured=True))
    assert "this job leaves alone" in found.message
    assert found.message.partition(", at ")[0].endswith("take it out")


@pytest.mark.parametrize("control", CONTROLS)
def test_what_was_not_measured_is_not_set(control: str) -> None:
    text, line = at_the_end(text_of(control), "G10 L2 P1 X0.")
    found = refused(offset_tables, control, text, line)
    assert "cam.measured.x is not given; measure it, or take it out" in found.message


@pytest.mark.parametrize("control", CONTROLS)
def test_offsets_are_no_distances(control: str) -> None:
    job = job_of(control, measured=True)
    assert judged(offset_tables, control, at_the_end(text_of(control), "G10 L2 P1 X-312.5")[0], job).passed
    text, line = at_the_end(text_of(control), "G91\nG10 L2 P1 X-312.5\nG90")
    assert "G91 is in force" in refused(offset_tables, control, text, line + 1, job).message


def test_in_inches_too() -> None:
    job = job_of("linuxcnc", measured=True)
    for value, good in (("-12.303150", True), ("-312.5", False)):
        text, _ = at_the_end(text_of("linuxcnc"), f"G20\nG10 L2 P1 X{value}\nG21")
        assert judged(offset_tables, "linuxcnc", text, job).passed == good


@pytest.mark.parametrize("number", [0, 5001, 5070, 5161, 5181, 5210, 5220, 5221, 5390, 5403, 5420, 5602])
def test_parameters_of_the_machine_are_not_written(number: int) -> None:
    with pytest.raises(ProgramError, match=rf"^line 2: #{number} .* a program writes #1 to #5000$"):
        interpret(f"G21\n#{number} = 10\nM2")
    with pytest.raises(ProgramError, match="a program writes #1 to #5000"):
        interpret(f"G21\n#1={number}\n##1=10\nM2")


@pytest.mark.parametrize(
    "name", ["_x", "_metric", "_Current_Tool", "_tool_offset", "_value", "_hal[x]", "_ini[a]b"]
)
def test_named_parameters_of_the_machine_are_not_written(name: str) -> None:
    with pytest.raises(ProgramError, match=r"^line 2: #<.*> is kept by the machine and not written"):
        interpret(f"G21\n#<{name}> = 10\nM2")


@pytest.mark.parametrize("name", ["1", "31", "5000", "<depth>", "<_depth>"])
def test_a_program_writes_its_own(name: str) -> None:
    assert interpret(f"G21 G90\n#{name} = 7\nG0 X#{name}\nM2").end[0, 0] == 7


@pytest.mark.parametrize("control", ["fanuc", "haas", "mach3", "grbl"])
@pytest.mark.parametrize("words", ["#5221=10.", "#0=1.", "#500=1."])
def test_other_controls_have_no_parameters_here(control: str, words: str) -> None:
    text, line = at_the_end(text_of(control), words)
    with pytest.raises(
        ProgramError, match=rf"^line {line}: parameters, expressions and O-words are not read"
    ):
        _ = scene_of(control, text).run
