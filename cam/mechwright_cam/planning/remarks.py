"""What stands in the way of cutting a part with its cutters, and what is worth knowing about them."""

import math
from collections.abc import Callable
from functools import partial

import shapely

from mechwright.errors import MechwrightError, ToolError
from mechwright.findings import Finding, Severity
from mechwright.materials import HSS_SPEED
from mechwright.materials import material as material_of
from mechwright.part import Part
from mechwright.tolerances import TOLERANCES
from mechwright.tooling import CamSettings, Tool, ToolKind
from mechwright_cam.job import Job, make_job
from mechwright_cam.library import Library
from mechwright_cam.planning.bending import MOST, deflection
from mechwright_cam.planning.details import plan_detail
from mechwright_cam.planning.grooves import grooves
from mechwright_cam.planning.holes import plan_bore
from mechwright_cam.planning.rates import rates
from mechwright_cam.planning.selection import choose_tools
from mechwright_cam.planning.zone import Zone, bores, check_clamp, inner_zones, outer_zones
from mechwright_cam.reach import remainder
from mechwright_cam.toolpath.offsets import ROUGH, grow

MILLS = frozenset({ToolKind.END_MILL, ToolKind.BULL_NOSE, ToolKind.BALL})
"""Cutters whose chip load goes with their diameter."""
SLENDER = 5.0
"""Beyond this many diameters of depth a mill bends noticeably: makers list such cutters as long-reach."""


def check_tools(part: Part, settings: CamSettings, library: Library) -> list[Finding]:
    """Find what stands in the way of cutting a part, and what is worth knowing about its cutters.

    Errors: a tool that is not in the library, a wall, bore or opening that no listed cutter makes, a clamp or
    stock in the way. Warnings: a cutter that cannot run at its cutting speed on this machine, a listed tool
    without data for the material. Notes: slender cutters, and stock that stays in corners.
    """
    return lay_out(part, settings, library)[1]


def lay_out(part: Part, settings: CamSettings, library: Library) -> tuple[Job | None, list[Finding]]:
    """Choose the cutters of a part and lay it into its stock, with all that :func:`check_tools` finds.

    The job is None if the cutters cannot be chosen or the part does not fit its stock.
    """
    try:
        tools = choose_tools(part, settings, library)
        job = make_job(part, settings, tools)
    except MechwrightError as error:
        return None, [_refusal(error)]
    found: list[Finding] = []
    zones: list[Zone] = []
    for bore in bores(job):
        _try(found, partial(plan_bore, job, bore))
    _try(found, lambda: zones.extend(inner_zones(job, skip=grooves(job))))
    _try(found, lambda: zones.extend(outer_zones(job)))
    _try(found, partial(check_clamp, job))
    for detail in job.details:
        _try(found, partial(plan_detail, job, detail))
    if not found:
        found += _corners(job, zones)
    return job, found + _travel(job) + _remarks(job)


def _travel(job: Job) -> list[Finding]:
    """Whether the machine is large enough: the least that the finest end mill travels around the part."""
    machine = job.settings.machine
    if not job.end_mills:
        return []
    x0, y0, x1, y1 = job.target.bounds
    around = job.end_mills[-1].diameter
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
            "take a larger machine",
        )
        for axis, wanted, travel in axes
        if wanted > travel
    ]


def _try(found: list[Finding], action: Callable[[], object]) -> None:
    try:
        action()
    except MechwrightError as error:
        found.append(_refusal(error))


def _refusal(error: MechwrightError) -> Finding:
    """An error that names its parameter in front, as a finding."""
    text = str(error)
    parameter, _, message = text.partition(": ")
    if not parameter.startswith("cam") or " " in parameter:
        parameter, message = "cam.tools" if isinstance(error, ToolError) else "cam", text
    return Finding("cam.cannot-cut", Severity.ERROR, parameter, message)


def _corners(job: Job, zones: list[Zone]) -> list[Finding]:
    """The remainder on every wall."""
    found = []
    for zone in zones:
        if zone.at_tabs:
            continue
        found += _partly(job, zone)
        depth = remainder(zone.wall, zone.finisher.radius, zone.must)
        if depth > TOLERANCES.leftover:
            found.append(
                Finding(
                    "cam.unreachable",
                    Severity.NOTE,
                    "cam.tools",
                    f"{zone.finisher.name} leaves up to {depth:.3f} mm in corners of {zone.name} "
                    f"of {job.part.name}",
                    depth,
                    TOLERANCES.leftover,
                    "mm",
                )
            )
    return found


def _remarks(job: Job) -> list[Finding]:
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
        speed = rates(tool, material, machine).spindle
        if (
            speed <= machine.spindle_min
            and speed * tool.diameter * math.pi > 1000 * data.cutting_speed * 1.01
        ):
            found.append(
                Finding(
                    "cam.too-fast",
                    Severity.WARNING,
                    "cam.machine.spindle_min",
                    f"{tool.name} runs faster than {data.cutting_speed:g} m/min in {material}",
                    machine.spindle_min,
                    1000 * data.cutting_speed / (math.pi * tool.diameter),
                    "rpm",
                    "take a smaller tool",
                )
            )
        if tool.kind is ToolKind.END_MILL and -job.floor > SLENDER * tool.diameter:
            found.append(
                Finding(
                    "cam.slender",
                    Severity.NOTE,
                    "cam.tools",
                    f"{tool.name} cuts {-job.floor:g} mm deep, {-job.floor / tool.diameter:.1f} diameters",
                    -job.floor / tool.diameter,
                    SLENDER,
                    "",
                )
            )
            found += _bending(job, tool)
        found += _figures(tool, material)
    return found


MOSTLY = 0.9
"""A recess of which the mills reach less than this is hardly what was drawn."""


def _partly(job: Job, zone: Zone) -> list[Finding]:
    """Whether much of a recess is too narrow for all its mills."""
    if zone.kind == "outside":
        return []
    must = zone.clear if zone.must is None else zone.must
    radius = zone.finisher.radius
    reach = grow(grow(zone.clear, -radius, ROUGH), radius, ROUGH)
    share = float(shapely.intersection(reach, must).area / must.area)
    if share >= MOSTLY:
        return []
    return [
        Finding(
            "cam.partly",
            Severity.WARNING,
            "cam.tools",
            f"{zone.finisher.name} reaches {100 * share:.0f} % of {zone.name} of {job.part.name}",
            100 * share,
            100 * MOSTLY,
            "%",
            "list a smaller end mill",
        )
    ]


def _bending(job: Job, tool: Tool) -> list[Finding]:
    """Whether a slender mill bends too much; the deepest cut counts."""
    bent = deflection(tool, job.part.material, -job.floor)
    if bent <= MOST:
        return []
    return [
        Finding(
            "cam.deflection",
            Severity.WARNING,
            "cam.tools",
            f"{tool.name} bends {bent:.3f} mm in its roughing cut, {-job.floor:g} mm deep in {job.part.name}",
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
