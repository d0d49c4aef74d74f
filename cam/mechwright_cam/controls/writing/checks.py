"""What a control cannot do: of what a design file asks for, and of what a program uses."""

from collections.abc import Iterator

from mechwright.contracts.finding import Finding, Severity
from mechwright.errors import ProgramError
from mechwright_cam.controls.writing.spelling import Spelling
from mechwright_cam.program.moves import Program, Rapid
from mechwright_cam.shop.settings import CamSettings


def unmet(settings: CamSettings, control: Spelling) -> Iterator[Finding]:
    """What of a design file's wishes a control lacks: the work offset, cutter compensation."""
    title, rows = control.title, control.work_offsets
    if not any(row.has(settings.work_offset) for row in rows):
        message = f"{title} has no work offset {settings.work_offset}"
        remedy = f"use one of: {', '.join(row.name for row in rows)}"
        yield Finding("cam.work-offset", Severity.ERROR, "cam.work_offset", message, remedy=remedy)
    if settings.compensation != "computer" and control.offsets.d is None:
        message = f"{title} has no cutter compensation (G41, G42)"
        remedy = 'use compensation = "computer"'
        yield Finding("cam.compensation", Severity.ERROR, "cam.compensation", message, remedy=remedy)


def check_program(program: Program, control: Spelling) -> None:
    """Raise ProgramError for a program that the control cannot run, or that does nothing."""
    title, compensates = control.title, control.offsets.d is not None
    if not any(operation.moves for section in program.sections for operation in section.operations):
        raise ProgramError(f"program {program.name} has no moves; nothing is written")
    for section in program.sections:
        tool = section.tool
        if not compensates and tool in program.compensated:
            raise ProgramError(
                f"{title} has no cutter compensation (G41, G42), and program {program.name} uses "
                'it; use cam.compensation = "computer"'
            )
        if max(tool.number, tool.d_number if tool in program.compensated else 0) > control.highest_tool:
            raise ProgramError(
                f"tool {tool.name} has number {max(tool.number, tool.d_number)}; {title} takes up "
                f"to T{control.highest_tool}; give it a lower one in the tool library"
            )
        first = next((move for operation in section.operations for move in operation.moves), None)
        if not (isinstance(first, Rapid) and None not in (first.x, first.y)):
            raise ProgramError(
                f"program {program.name}: the section of T{tool.number} does not start "
                "with a rapid to x and y"
            )
