"""A program read from its first line to its end."""

import re
from collections.abc import Mapping, Sequence, Set
from dataclasses import replace
from itertools import compress
from typing import Any

from mechwright.errors import ProgramError
from mechwright_cam.controls.dialect import Dialect
from mechwright_cam.controls.reading import motion_lines
from mechwright_cam.controls.reading.blocks import Block, fail, read_block
from mechwright_cam.controls.reading.calls import Calls, uses_calls
from mechwright_cam.controls.reading.characters import Faults
from mechwright_cam.controls.reading.machine import Machine
from mechwright_cam.controls.reading.macros import uses_macros
from mechwright_cam.controls.reading.plain import PlainLines, Row, WorkedOut
from mechwright_cam.controls.reading.run import Run, joined
from mechwright_cam.controls.reading.values import Lines

CODE = re.compile(r"\s*(?:/\s*)?[A-Z:]\s*[-+.#\[\d]", re.IGNORECASE)
"""How a line of a program begins, and no line of prose."""
MOST_BLOCKS = 20_000
"""So many texts of lines are remembered."""


def interpret(
    text: str,
    dialect: Dialect,
    *,
    block_delete: bool = False,
    upper_end: float = 0.0,
    diameters: Mapping[int, float] | None = None,
    start: tuple[float, float, float] | None = None,
) -> Run:
    r"""Run a program; see :meth:`mechwright_cam.controls.contract.Control.read`.

    With ``start``, where the tool stands at first, mm, all work offsets and lengths are taken for 0, and
    tools for changed where they stand, as another simulator may do.

    Examples
    --------
    >>> from mechwright_cam.controls.linuxcnc import LinuxCnc
    >>> run = interpret("G21 G90 G17\nG0 X0 Y0 Z5\nG1 Z-1 F100\nG2 X10 I5 J0\nM2", LinuxCnc.dialect)
    >>> run.end[-2].tolist(), run.ended
    ([10.0, 0.0, -1.0], True)
    """
    machine = Machine(dialect, upper_end, diameters or {})
    if start is not None:
        machine.x, machine.y, machine.z = start
        machine.offsets_are_zero = True
    text = text.replace("\r\n", "\n")
    if dialect.translate is not None:
        text = dialect.translate(text, block_delete)
    lines, plain = text.split("\n"), PlainLines(text, dialect, block_delete=block_delete)
    source, called = Lines(lines), set[int]()
    others = (line for line in compress(lines, ~plain.plain) if len(line) <= dialect.text.longest)
    if dialect.macros and uses_macros("\n".join(others)):
        source = dialect.macros(lines, machine.system_value, machine.look_anew)
    elif dialect.calls and uses_calls(list(compress(lines, ~plain.plain))):
        source = Calls(lines, dialect.calls)
        called = source.covered
    percents = 0
    faults, blocks = Faults(text, lines, dialect), Blocks(dialect)
    plain.strike(faults.at)
    source.read(plain, faults.at)
    for index, raw in source.run():
        if not isinstance(raw, str):
            _run_rows(machine, raw, plain, lines, blocks, block_delete=block_delete)
            continue
        faults.check(index)
        # A line that is plain has nothing for macros to work out: it is run as it stands in the text.
        if plain.plain[index]:
            after = motion_lines.run_motion_lines(machine, plain, index)
            if after > index:
                source.at = after
                machine.check_steps(after)
                continue
        elif dialect.text.percent and raw.strip(" \t") == "%":
            percents += 1
            if percents == 1 and any(map(str.strip, lines[:index])):
                raise fail(index + 1, "a % without one in the first line; put one there, or take this out")
            if percents == 2:
                machine.ended = machine.ended or dialect.text.percent_ends
                return replace(machine.result(len(lines)), beyond=_beyond(lines, index, dialect, called))
            continue
        block = (plain.plain[index] and plain.block(index)) or blocks.read(index + 1, raw)
        if block.title and any(map(CODE.match, lines[:index])):
            raise fail(index + 1, "a program number begins another program; keep one program in a file")
        if block.deleted and block_delete:
            continue
        machine.run(block)
        machine.check_steps(index + 1)
        if machine.ended:
            return replace(machine.result(len(lines)), beyond=_beyond(lines, index, dialect, called))
    return machine.result(len(lines))


class Blocks:
    """Blocks of lines, each text taken apart once: those of loops and subroutines come again and again."""

    def __init__(self, dialect: Dialect) -> None:
        self.dialect = dialect
        self._known: dict[str, Block] = {}

    def read(self, line: int, text: str) -> Block:
        """The same as :func:`read_block`."""
        if text not in self._known:
            block = read_block(line, text, self.dialect)
            if len(self._known) >= MOST_BLOCKS:
                return block
            self._known[text] = block
        return self._known[text].again(line)


def _run_rows(
    machine: Machine,
    rows: Sequence[Row],
    text: PlainLines,
    lines: Sequence[str],
    blocks: Blocks,
    *,
    block_delete: bool,
) -> None:
    """Run rows of numbers: those that are motions together, others one by one."""
    worked, at = WorkedOut(rows, text) if len(rows) >= motion_lines.FEWEST_LINES else None, 0
    while at < len(rows):
        after = motion_lines.run_motion_lines(machine, worked, at) if worked and worked.plain[at] else at
        if after == at:
            row, after = rows[at], at + 1
            block = blocks.read(row.index + 1, lines[row.index] if row.columns is None else row.text)
            if not (block.deleted and block_delete):
                machine.run(block)
        machine.check_steps(rows[after - 1].index + 1)
        at = after


def _beyond(lines: Sequence[str], end: int, dialect: Dialect, called: Set[int]) -> int:
    """Number of the first line of a program behind the line of index ``end``, 0 if there is none.

    Subroutines may stand there, those of indices ``called``.
    """
    for index, raw in enumerate(lines[end + 1 :], end + 1):
        if raw.strip() == "%":
            break
        if index in called:
            continue
        if CODE.match(raw):
            subroutine = dialect.macros is not None and raw.strip()[0] in "oO"
            return 0 if subroutine else index + 1
    return 0


def interpret_files(program: str | Mapping[str, str], dialect: Dialect, **settings: Any) -> Run:
    """Run a program: one text, or several files by name, one after the other.

    Settings are those of :func:`interpret`; an error names the file as well.
    """
    if isinstance(program, str):
        return interpret(program, dialect, **settings)
    runs = []
    for name, text in program.items():
        try:
            runs.append(interpret(text, dialect, **settings))
        except ProgramError as error:
            raise ProgramError(f"{name}: {error}") from error
    return joined(tuple(program), runs)
