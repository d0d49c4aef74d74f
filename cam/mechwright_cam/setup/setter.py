"""Which tools of a program a setter on the table measures, and from where."""

from mechwright_cam.program.moves import Program
from mechwright_cam.program.touches import ToolTouches
from mechwright_cam.setup.job import Job

LENGTHS = "-lengths"
"""What the name of a program that measures tools ends in."""


def measures_tools(job: Job) -> bool:
    """Whether a program is to measure the tools of a job: those of a second side have been measured."""
    return job.settings.setter.x is not None and job.side == "top"


def unmeasured(job: Job) -> str:
    """Why the setter does not measure the tools of a job; nothing where it does."""
    setter, machine = job.settings.setter, job.settings.machine
    wide = [tool for tool in job.tools if tool.diameter > setter.diameter]
    if wide:
        return (
            f"{wide[0].name} is wider than the setter ({setter.diameter:g} mm) and would touch beside it; "
            "measure by hand"
        )
    for axis, key in (("x", "x"), ("y", "y"), ("z", "start")):
        place, (low, high) = getattr(setter, key), machine.ends(axis)
        if place is not None and not low <= place <= high:
            return f"{key} is {place:g}, and {axis.upper()} travels from {low:g} to {high:g}"
    if setter.start is not None and setter.start > machine.retract_z:
        return f"start {setter.start:g} is above the retract, machine Z {machine.retract_z:g}"
    return ""


def tool_touches(job: Job, program: Program) -> ToolTouches:
    """How the tools of a program are measured, in the order of their use.

    Raises
    ------
    ValueError
        There is no setter, or :func:`unmeasured` says why not.
    """
    setter = job.settings.setter
    if setter.x is None or setter.y is None or setter.over is None:
        raise ValueError("no setter is named")
    if why := unmeasured(job):
        raise ValueError(why)
    return ToolTouches(
        name=program.name + LENGTHS,
        offsets=program.offsets,
        tools=tuple((tool.number, tool.name) for tool in program.tools),
        place=(setter.x, setter.y),
        over=setter.over,
        start=setter.start,
        travel=setter.travel,
        fast=setter.fast,
        slow=setter.slow,
    )
