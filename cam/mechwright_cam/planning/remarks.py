"""What stands in the way of cutting a part with its cutters, and what is worth knowing about them."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

from mechwright.contracts.finding import Finding, Severity
from mechwright.contracts.materials import HSS_SPEED
from mechwright.contracts.materials import material as material_of
from mechwright.contracts.part import Feature, Part
from mechwright.errors import DesignError, MechwrightError, ToolError
from mechwright_cam.operations.bending import MOST, deflection
from mechwright_cam.operations.choice import long_enough
from mechwright_cam.operations.contract import Task
from mechwright_cam.operations.drilling import SPOT
from mechwright_cam.operations.rates import Rates, rates, runs_too_fast
from mechwright_cam.planning.assign import Assignments
from mechwright_cam.planning.selection import choose_tools
from mechwright_cam.setup.job import Job
from mechwright_cam.setup.lay_out import check_clamp, make_job
from mechwright_cam.setup.nest import Nest
from mechwright_cam.shop.library import Library
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import MILLS, CuttingData, Tool, ToolKind

SLENDER = 5.0
"""Beyond this many diameters of depth a mill bends noticeably: makers list such cutters as long-reach."""


def check_tools(part: Part, settings: CamSettings, library: Library) -> list[Finding]:
    """Find what stands in the way of cutting a part, and what is worth knowing about its cutters.

    Errors: a tool that is not in the library, a wall, bore or opening that no listed cutter makes, a clamp or
    stock in the way. Warnings: a cutter that this machine runs too fast or feeds too slowly, a listed tool
    without data for the material. Notes: slender cutters, and stock that stays in corners.
    """
    return lay_out(part, settings, library)[1]


def lay_out(
    part: Part,
    settings: CamSettings,
    library: Library,
    below: Sequence[Feature] = (),
    assignments: Assignments | None = None,
) -> tuple[Job | None, list[Finding]]:
    """Choose the cutters of a part and lay it into its stock, with all that :func:`check_tools` finds.

    Tabs stay clear of the features that are cut from ``below`` later. Who cuts what stays in ``assignments``.

    The job is None if the cutters cannot be chosen or the part does not fit its stock.
    """
    assignments = assignments or Assignments()
    try:
        tools = choose_tools(part, settings, library, assignments)
        job = make_job(part, settings, tools, below)
        assigned = assignments.of(job)
    except MechwrightError as error:
        return None, [refusal(error)]
    refused = list(assigned.refused)
    try:
        check_clamp(job)
    except DesignError as error:
        refused.append(error)
    found = [refusal(error) for error in refused]
    if not found:
        for task in assigned.tasks:
            found += task.operation.remarks(task, job)
        idle = _idle(job, assigned.tasks)
        if settings.tools:
            found += [_unused(job, mill) for mill in idle]
        elif idle:
            # Of the chosen cutters a wider one has turned out to be as good.
            used = tuple(tool for tool in job.tools if tool not in idle)
            job = assignments.carry(job, replace(job, tools=used))
    depths = {} if refused else _depths(assigned.tasks)
    return job, found + _travel(job) + _remarks(job, depths)


def _idle(job: Job, tasks: Sequence[Task]) -> list[Tool]:
    """The mills that nothing in the part is for."""
    used = {mill.name for task in tasks for mill in task.tools}
    return [mill for mill in job.mills if mill.name not in used and job.part.material in mill.cutting]


def _depths(tasks: Sequence[Task]) -> dict[str, float]:
    """How deep below the top of the stock each mill cuts, mm, by its name."""
    deep: dict[str, float] = {}
    for task in tasks:
        for mill in task.tools:
            deep[mill.name] = max(deep.get(mill.name, 0.0), -task.operation.deepest(task, mill))
    return deep


def _unused(job: Job, mill: Tool) -> Finding:
    return Finding(
        "cam.tool-unused",
        Severity.WARNING,
        "cam.tools",
        f"{mill.name} has nothing to do in {job.part.name}: {_why_idle(job, mill)}",
        remedy="take it out of cam.tools",
    )


def _why_idle(job: Job, mill: Tool) -> str:
    if mill.nose == mill.radius:
        return f"no floor has a fillet of {mill.nose:g} mm, and flat floors are for the others"
    if not long_enough(mill, job.thickness):
        return f"its flutes are too short for what others cut, {mill.flute_length:g} mm"
    return "the others reach as far"


def _travel(job: Job) -> list[Finding]:
    """Whether the machine is large enough: the least that the finest end mill travels around the part."""
    machine = job.settings.machine
    if not job.mills:
        return []
    x0, y0, x1, y1 = job.target.bounds
    around = job.mills[-1].diameter
    axes = (("x", x1 - x0 + around, machine.travel_x), ("y", y1 - y0 + around, machine.travel_y))
    return [
        Finding(
            "cam.travel",
            Severity.ERROR,
            f"cam.machine.travel_{axis}",
            f"part {job.part.name} asks for {wanted:.1f} mm of travel in {axis.upper()}",
            wanted,
            travel,
            "mm",
            "take a larger machine" + (", or nest fewer parts" if isinstance(job.part, Nest) else ""),
        )
        for axis, wanted, travel in axes
        if wanted > travel
    ]


def refusal(error: MechwrightError, code: str = "cam.cannot-cut") -> Finding:
    """An error that names its parameter in front, as a finding."""
    text = str(error)
    parameter, _, message = text.partition(": ")
    if not parameter.startswith("cam") or " " in parameter:
        parameter, message = "cam.tools" if isinstance(error, ToolError) else "cam", text
    return Finding(code, Severity.ERROR, parameter, message)


def _spotted(job: Job, spot: Tool) -> float:
    """Diameter of the widest spot that a spot drill makes, mm."""
    drills = [tool.diameter for tool in job.tools if tool.kind is ToolKind.DRILL]
    return min(SPOT * max(drills), spot.diameter) if drills else spot.diameter


def _remarks(job: Job, depths: Mapping[str, float]) -> list[Finding]:
    """What is worth knowing of the cutters; one whose depth is not known is taken to cut through."""
    found = []
    machine, material = job.settings.machine, job.part.material
    for tool in job.tools:
        data = tool.cutting.get(material)
        if data is None:
            found.append(
                Finding(
                    "cam.tool-unused",
                    Severity.WARNING,
                    "cam.tools",
                    f"{tool.name} has no cutting data for {material} and is not used",
                    remedy=f"add {material} to its table in the tool library",
                )
            )
            continue
        planned = rates(tool, material, machine)
        width = _spotted(job, tool) if tool.kind is ToolKind.SPOT_DRILL else tool.diameter
        if runs_too_fast(tool, material, machine, width):
            found.append(
                Finding(
                    "cam.too-fast",
                    Severity.WARNING,
                    "cam.machine.spindle_min",
                    f"{tool.name} runs faster than {data.cutting_speed:g} m/min in {material}",
                    machine.spindle_min,
                    1000 * data.cutting_speed / (math.pi * width),
                    "rpm",
                    "take a smaller tool",
                )
            )
        found += _rubbing(tool, data, planned)
        deep = depths.get(tool.name, tool.nose - job.floor)
        if tool.kind in MILLS and deep > SLENDER * tool.diameter:
            found.append(
                Finding(
                    "cam.slender",
                    Severity.NOTE,
                    "cam.tools",
                    f"{tool.name} cuts {deep:g} mm deep, {deep / tool.diameter:.1f} diameters",
                    deep / tool.diameter,
                    SLENDER,
                    "",
                )
            )
            found += _bending(job, tool, deep)
        found += _figures(tool, material)
    return found


RUBS = 0.5
"""Below this share of its chip load a tooth rubs as much as it cuts: usual ranges reach about so far down."""


def _rubbing(tool: Tool, data: CuttingData, planned: Rates) -> list[Finding]:
    """Whether the machine feeds so slowly that the teeth take next to nothing."""
    if planned.chip >= RUBS * data.chip_load:
        return []
    return [
        Finding(
            "cam.rubbing",
            Severity.WARNING,
            "cam.machine.max_feed",
            f"{tool.name} gets {planned.chip:.3f} mm per tooth at {planned.spindle:.0f} rev/min, not the "
            f"{data.chip_load:g} mm of its chip load, and rubs",
            planned.chip,
            RUBS * data.chip_load,
            "mm",
            "take a smaller cutter or one with fewer flutes, or a slower spindle if the machine has one",
        )
    ]


def _bending(job: Job, tool: Tool, deep: float) -> list[Finding]:
    """Whether a slender mill bends too much in its deepest cut."""
    bent = deflection(tool, job.part.material, deep)
    if bent <= MOST:
        return []
    return [
        Finding(
            "cam.deflection",
            Severity.WARNING,
            "cam.tools",
            f"{tool.name} bends {bent:.3f} mm in its roughing cut, {deep:g} mm deep in {job.part.name}",
            bent,
            MOST,
            "mm",
            "take less step_down in the tool library, or a thicker cutter",
        )
    ]


def _figures(tool: Tool, workpiece: str) -> list[Finding]:
    """Whether an end mill's cutting data are of the usual size: a slip of the decimal point is not."""
    if tool.kind not in MILLS:
        return []
    data, usual = tool.cutting[workpiece], material_of(workpiece)
    share = HSS_SPEED if tool.substrate == "hss" else 1.0
    found = []
    for what, value, (low, high), unit in (
        ("cutting_speed", data.cutting_speed, (usual.speed[0] * share, usual.speed[1] * share), "m/min"),
        ("chip_load", data.chip_load, tuple(tool.diameter * s for s in usual.chip_share), "mm"),
    ):
        if not low <= value <= high:
            found.append(
                Finding(
                    "cam.cutting-data",
                    Severity.WARNING,
                    "cam.tool_library",
                    f"{what} of {tool.name} in {workpiece}: {value:g} {unit}, usual {low:.3g} to {high:.3g}",
                    value,
                    high if value > high else low,
                    unit,
                    "look at what the cutter's maker says, and correct the tool library",
                )
            )
    return found
