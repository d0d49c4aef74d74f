"""Whether a control reads what it writes, and says one thing of its offsets everywhere."""

import re
from collections.abc import Iterator, Sequence

import numpy as np

from mechwright_cam.controls.contract import Control
from mechwright_cam.controls.reading.run import Kind, Run
from mechwright_cam.pages.setup_sheet import setup_html
from mechwright_cam.program.moves import Drill, Pause, Program, Rapid, Tap, ToolSection
from mechwright_cam.setup.job import Job
from mechwright_plane.text import number

OTHER = {"radius": "diameter", "diameter": "radius"}
_SLACK = 1.01
"""Of the last decimal: heights are rounded down, and floating point adds a little."""


def assert_read_back(control: Control, program: Program) -> None:
    """The control reads its own text, and every cut of it as the program has it.

    Where the control compensates the cutter's radius, the cutter's centre is elsewhere: places are compared
    outside of compensation alone.
    """
    files = {name + control.suffix: text for name, text in control.files(program).items()}
    tools = {tool.d_number: tool.diameter for tool in program.tools}
    run = control.read(
        files if len(files) > 1 else next(iter(files.values())),
        upper_end=control.upper_end(program.machine),
        diameters=tools,
    )
    assert run.ended, "the control does not see the program's end"
    assert np.isfinite(run.end[run.cutting]).all(), "a cut is read to a place that nobody knows"
    pauses = [m for s in program.sections for o in s.operations for m in o.moves if isinstance(m, Pause)]
    assert (run.kind == Kind.STOP).sum() >= len(pauses), "a stop is not read"
    if program.compensated:
        assert any(state.side for state in run.states), "cutter compensation is not read"
        return
    steps = iter(np.flatnonzero(run.cutting).tolist())
    for section, place, feed, pecks in _cuts(program):
        words = f"the cut of T{section.tool.number} to {place} at F{feed:g}"
        for step in steps:
            _assert_state(run, step, section, program, words)
            off = np.abs(run.end[step] - place)
            if off.max() <= _SLACK * control.resolution and abs(run.feed[step] - feed) <= 0.13:
                break
            above = pecks and off[:2].max() <= 1e-3 and run.end[step, 2] > place[2]
            assert above, f"line {run.line[step]}: {words} is read as one to {run.end[step]}"
        else:
            raise AssertionError(f"{words} is not read")
    assert not list(steps), "there are cuts that the program does not have"


def _assert_state(run: Run, step: int, section: ToolSection, program: Program, words: str) -> None:
    state = run.states[int(run.state[step])]
    found = (state.tool, state.spindle, state.rpm, state.coolant, state.work_offset)
    hand = -1 if section.tool.left_hand else 1
    planned = (section.tool.number, hand, section.spindle, section.coolant, program.work_offset)
    assert found == planned, f"line {run.line[step]}: {words} is read in another state"


def _cuts(program: Program) -> Iterator[tuple[ToolSection, tuple[float, float, float], float, bool]]:
    """Where each cut ends, its feed, and whether it may take pecks."""
    for section in program.sections:
        x = y = z = np.nan
        for move in (move for operation in section.operations for move in operation.moves):
            if isinstance(move, Pause):
                continue
            x, y = (x if move.x is None else move.x), (y if move.y is None else move.y)
            if isinstance(move, Drill | Tap):
                yield section, (x, y, move.bottom), move.feed, True
                continue
            z = z if move.z is None else move.z
            if not isinstance(move, Rapid):
                yield section, (x, y, z), move.feed, False


def assert_one_d(control: Control, job: Job, program: Program) -> None:
    """The text, the file of offsets and the setup sheet have the same quantity and value for every D."""
    text = control.write(program).lower()
    page = setup_html(job, program, None, control)
    _, table = control.offset_table(program.tools, job.settings)
    for tool in program.compensated:
        offset = control.offsets.d_offset(tool, program.posting, program.compensation, program.wear_limit)
        told = [line for line in text.splitlines() if re.search(rf"\bd{offset.number}\b", line)]
        assert not [line for line in told if OTHER[offset.quantity] in line], f"D is the {offset.quantity}"
        cell = re.search(rf"<b>D{offset.number}</b> = ([^<]+)", page)
        assert cell, f"D{offset.number} is not on the setup sheet"
        assert cell[1].startswith(f"{offset.planned:.3f}")
        assert offset.quantity in cell[1]
        if table:
            value = re.escape(number(offset.planned))
            rows = [row for row in table.splitlines() if re.search(rf"(?<!\d)0*{offset.number}(?!\d)", row)]
            assert [row for row in rows if re.search(rf"(?<![\d.-]){value}(\.0*)?(?![\d.])", row)], (
                f"{offset.planned:g} for D{offset.number} is not in the file of offsets"
            )


def assert_same_at(run: Run, offsets: Sequence[str]) -> None:
    """Assert that a run makes the same cuts, with the same tools and feeds, at each of some work offsets."""
    offset = run.of_states(lambda state: state.work_offset)
    cuts = [np.column_stack((run.end, run.feed, run.tool))[run.cutting & (offset == one)] for one in offsets]
    assert len(cuts[0]), f"nothing is cut at {offsets[0]}"
    for name, own in zip(offsets, cuts, strict=True):
        assert np.array_equal(own, cuts[0]), f"the cuts at {name} are not those at {offsets[0]}"
