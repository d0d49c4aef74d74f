"""What stands in the way of cutting a part with its cutters, and what is worth knowing about them."""

import math
from collections.abc import Iterator, Mapping, Sequence, Set
from dataclasses import replace

from mechwright.contracts.finding import Change, Finding, Severity
from mechwright.contracts.materials import HSS_SPEED
from mechwright.contracts.materials import material as material_of
from mechwright.contracts.part import Feature, Part
from mechwright.errors import DesignError, MechwrightError, PluginFaultError, ToolError
from mechwright.tolerances import TOLERANCES
from mechwright_cam.operations.bending import SLENDER, deflection, most_bent, pass_depth, says_step_down
from mechwright_cam.operations.choice import MisfitError, long_enough
from mechwright_cam.operations.contract import Task
from mechwright_cam.operations.drilling import SPOT
from mechwright_cam.operations.rates import RUBS, rates, rubs, runs_too_fast
from mechwright_cam.operations.tap import declined
from mechwright_cam.planning.assign import Assignments
from mechwright_cam.planning.better_process import better_process
from mechwright_cam.planning.selection import choose_tools
from mechwright_cam.setup.job import Job
from mechwright_cam.setup.lay_out import check_clamp, make_job
from mechwright_cam.setup.limits import check_travel
from mechwright_cam.shop.library import Library
from mechwright_cam.shop.machine import Machine
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import MILLS, Tool, ToolKind


def lay_out(
    part: Part,
    settings: CamSettings,
    library: Library,
    below: Sequence[Feature] = (),
    assignments: Assignments | None = None,
) -> tuple[Job | None, list[Finding]]:
    """Choose the cutters of a part and lay it into its stock; the job is None where that cannot be done.

    Tabs stay clear of the features that are cut from ``below`` later. Who cuts what stays in ``assignments``.

    Errors: a tool that is not in the library, a wall, bore or opening that no listed cutter makes, a clamp or
    stock in the way. Warnings: a cutter that this machine runs too fast or feeds too slowly, a listed tool
    without data for the material. Notes: slender cutters, and stock that stays in corners.
    """
    assignments = assignments or Assignments()
    try:
        tools = choose_tools(part, settings, library, assignments)
        job = make_job(part, settings, tools, below)
        assigned = assignments.of(job)
    except PluginFaultError:  # of no design
        raise
    except MechwrightError as error:
        return None, [refusal(error, listed=settings.tools, part=part.name)]
    refused = list(assigned.refused)
    try:
        check_clamp(job)
    except DesignError as error:
        refused.append(error)
    found = [refusal(error, listed=settings.tools) for error in refused]
    if not found:
        for task in assigned.tasks:
            found += task.operation.remarks(task, job)
        every = replace(job, tools=library.tools)
        found += declined(every, assigned.tasks, assignments.untapped(library))
        found += better_process(job, assigned.tasks)
        idle = _idle(job, assigned.tasks)
        if settings.tools:
            found += [_idling(job, mill) for mill in idle]
        elif idle:
            # Of the chosen cutters a wider one has turned out to be as good.
            used = tuple(tool for tool in job.tools if tool not in idle)
            job = assignments.carry(job, replace(job, tools=used))
    depths = {} if refused else assigned.depths()
    return job, [*found, *check_travel(job), *_remarks(job, depths)]


def _idle(job: Job, tasks: Sequence[Task]) -> list[Tool]:
    """The mills that nothing in the part is for."""
    used = {mill.name for task in tasks for mill in task.tools}
    return [mill for mill in job.mills if mill.name not in used and job.part.material in mill.cutting]


INSTEAD_OF_TABS: tuple[Change, ...] = (
    {"cam.hold.method": "bore"},
    {"cam.hold.method": "none", "cam.hold.bed": "tape"},
)
"""How a part is held whose walls have no room for tabs, as fine teeth and small wheels have none."""


def refusal(
    error: MechwrightError, code: str = "cam.cannot-cut", *, listed: Sequence[str] = (), part: str = ""
) -> Finding:
    """An error that names its parameter in front, as a finding.

    Where the design has ``listed`` its cutters the program may choose others, if it is let.
    """
    text = str(error)
    parameter, _, message = text.partition(": ")
    if not parameter.startswith("cam") or " " in parameter:
        parameter, message = "cam.tools" if isinstance(error, ToolError) else "cam", text
    proposed: tuple[Change, ...] = ()
    if parameter == "cam.tools" and listed:
        proposed = ({"cam.tools": None},)
    if parameter == "cam.hold.tabs":
        message = f"{part}: {message}" if part else message
        proposed = () if "tab_shape" in message else INSTEAD_OF_TABS
    if isinstance(error, MisfitError):
        code = error.code or code
        return Finding.error(code, parameter, message, error.measured, error.limit, "mm", proposed=proposed)
    return Finding.error(code, parameter, message, proposed=proposed)


def _idling(job: Job, mill: Tool) -> Finding:
    if mill.nose == mill.radius:
        why = f"no floor has a fillet of {mill.nose:g} mm, and flat floors are for the others"
    elif not long_enough(mill, job.thickness):
        why = f"its flutes are too short for what others cut, {mill.flute_length:g} mm"
    else:
        why = "the others reach as far"
    return _unused(mill, f"has nothing to do in {job.part.name}: {why}", "take it out of cam.tools")


UNUSED = "cam.tool-unused"
"""Code of what is said of a tool that a part has no use for."""


def _unused(tool: Tool, message: str, remedy: str) -> Finding:
    return Finding.warning(UNUSED, "cam.tools", f"{tool.name} {message}", remedy=remedy)


def merged_tool_findings(findings: Sequence[Finding], used: Set[str]) -> list[Finding]:
    """What is said of tools of several parts: one that any of them uses is not unused, and is told once."""
    said, told = [], set(used)
    for finding in findings:
        if finding.code == UNUSED:
            name = finding.message.partition(" ")[0]  # as _unused begins
            if name in told:
                continue
            told.add(name)
        said.append(finding)
    return said


def _remarks(job: Job, depths: Mapping[str, float]) -> Iterator[Finding]:
    """What is worth knowing of the cutters; one whose depth is not known is taken to cut through."""
    material = job.part.material
    for tool in job.tools:
        if material not in tool.cutting:
            remedy = (
                f"add {material} to its table in the tool library, or give cutting_speed and chip_load in "
                f"[cam.cutting.{tool.name}]"
            )
            yield _unused(tool, f"has no cutting data for {material} and is not used", remedy)
            continue
        yield from _speeds(job, tool)
        if tool.kind in MILLS:
            yield from _bending(job, tool, depths.get(tool.name, tool.nose - job.floor))
            if not tool.is_estimated(material):
                yield from _figures(tool, material, job.settings.machine)


def _speeds(job: Job, tool: Tool) -> Iterator[Finding]:
    """Whether the machine turns a tool too fast, or feeds so slowly that its teeth take next to nothing."""
    machine, material, width = job.settings.machine, job.part.material, tool.diameter
    data, planned = tool.cutting[material], rates(tool, material, machine)
    if tool.kind is ToolKind.SPOT_DRILL:  # it goes no deeper than the widest of the drills asks for
        drills = [other.diameter for other in job.tools if other.kind is ToolKind.DRILL]
        width = min(SPOT * max(drills), width) if drills else width
    if runs_too_fast(tool, material, machine, width):
        message = f"{tool.name} runs faster than {data.cutting_speed:g} m/min in {material}"
        slowest, wanted = machine.spindle_min, 1000 * data.cutting_speed / (math.pi * width)
        where, remedy = "cam.machine.spindle_min", "take a smaller tool"
        yield Finding.warning("cam.too-fast", where, message, slowest, wanted, "rpm", remedy)
    if rubs(tool, material, machine):
        least = RUBS * data.chip_load
        message = (
            f"{tool.name} gets {planned.chip:.3f} mm per tooth at {planned.spindle:.0f} rev/min, not the "
            f"{data.chip_load:g} mm of its chip load, and rubs"
        )
        remedy = "take a smaller cutter or one with fewer flutes, or a slower spindle if the machine has one"
        where = "cam.machine.max_feed"
        yield Finding.warning("cam.rubbing", where, message, planned.chip, least, "mm", remedy)


def _bending(job: Job, tool: Tool, deep: float) -> Iterator[Finding]:
    """Whether a mill is slender, what its passes are for that, and whether it bends too much all the same."""
    slender = deep / tool.diameter
    if slender <= SLENDER:
        return
    material, step = job.part.material, pass_depth(job, tool, deep)
    message = f"{tool.name} cuts {deep:g} mm deep, {slender:.1f} diameters"
    usual = tool.cutting[material].step_down * tool.diameter
    if step < usual:
        message += f", in passes of {step:.2g} mm instead of {usual:.2g} mm, so that it bends less"
    yield Finding("cam.slender", Severity.NOTE, "cam.tools", message, slender, SLENDER)
    bent, most = deflection(tool, material, deep, step), most_bent(job)
    if bent <= most + TOLERANCES.noise:
        return
    message = (
        f"{tool.name} bends {bent:.3f} mm in its roughing cut, {deep:g} mm deep in {job.part.name}, "
        f"{step:.2g} mm in a pass"
    )
    where, remedy = "cam.tools", "take a cutter that is thicker, shorter or of carbide"
    proposed: tuple[Change, ...] = ()
    if says_step_down(job, tool):
        where = f"cam.cutting.{tool.name}.step_down"
        remedy = "leave it out, and passes are as deep as the cutter bears"
        proposed = () if "." in tool.name else ({where: None},)
    yield Finding.warning("cam.deflection", where, message, bent, most, "mm", remedy, proposed=proposed)


def _figures(tool: Tool, workpiece: str, machine: Machine) -> Iterator[Finding]:
    """Whether an end mill's cutting data are of the usual size: a slip of the decimal point is not.

    A speed below the usual ones is none where the spindle turns no faster.
    """
    data, usual = tool.cutting[workpiece], material_of(workpiece)
    share = HSS_SPEED if tool.substrate == "hss" else 1.0
    reached = machine.speed(math.inf) * math.pi * tool.diameter / 1000
    for what, value, (low, high), unit in (
        (
            "cutting_speed",
            data.cutting_speed,
            (min(usual.speed[0] * share, 0.9 * reached), usual.speed[1] * share),
            "m/min",
        ),
        ("chip_load", data.chip_load, tuple(tool.diameter * s for s in usual.chip_share), "mm"),
    ):
        if not low <= value <= high:
            limit = high if value > high else low
            where = f"{what} of {tool.name} in {workpiece}"
            message = f"{where}: {value:g} {unit}, usual {low:.3g} to {high:.3g}"
            remedy = "look at what the cutter's maker says, and correct the tool library"
            yield Finding.warning("cam.cutting-data", "cam.tool_library", message, value, limit, unit, remedy)
