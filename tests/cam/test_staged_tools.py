"""The next tool, made ready behind each change where the control has it ready while it cuts."""

import pytest
from by_control import BY_NAME, asked
from planning_parts import bore, job, plate

from mechwright.errors import ProgramError
from mechwright_cam.controls.reading import Kind
from mechwright_cam.machining import Machined, machine
from mechwright_cam.shop.settings import CamSettings

TOOLS = ("spot-6", "drill-8", "mill-6")


def staged(control: str) -> Machined:
    of = job(plate(bore(12.0)), *TOOLS, control=control, post={"stage_tools": True})
    return machine(of, BY_NAME[control])


@pytest.mark.parametrize("control", ["linuxcnc", "fanuc", "haas"])
def test_each_change_makes_the_next_tool_ready_and_the_last_the_first(control: str) -> None:
    one = staged(control)
    lines = one.text.splitlines()
    numbers = [section.tool.number for section in one.program.sections]
    alone = [line for line in lines if line[0] == "T" and line[1:].isdigit()]
    assert alone == [f"T{n}" for n in (*numbers[1:], numbers[0])]
    for number, line in zip(numbers, alone, strict=True):
        change = lines.index(f"T{number} M6")
        # Behind length offset and coolant, before anything is cut.
        assert [one.split()[0] for one in lines[change : lines.index(line, change)]][-2:] == ["G43", "M8"]
    run = BY_NAME[control].read(one.text)
    assert run.tool[run.kind == Kind.TOOL].tolist() == numbers
    assert one.proof.ok


def test_a_tool_that_is_not_the_job_s_is_not_made_ready() -> None:
    one = staged("linuxcnc")
    of, text = one.job, one.text
    found = asked("tools", text.replace("\nT24\n", "\nT77\n", 1), of)
    assert not found.passed
    assert "T77 is made ready and is not a tool of this job" in found.message
    # The change itself names its tool: another one made ready before it is put back unused.
    assert asked("tools", text.replace("\nT24\n", "\nT1\n", 1), of).passed


@pytest.mark.parametrize("control", ["mach3", "grbl"])
def test_it_is_refused_by_name_where_there_is_none(control: str) -> None:
    settings = CamSettings.model_validate({"post": {"stage_tools": True}})
    (found,) = [one for one in BY_NAME[control].check(settings) if one.code == "cam.stage-tools"]
    assert found.message.startswith(f"{BY_NAME[control].title} has no tool made ready ahead")
    with pytest.raises(ProgramError, match=r"leave post\.stage_tools out"):
        staged(control)
