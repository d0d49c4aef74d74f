"""What the machine is too small for, before any program is planned."""

import math
from collections.abc import Iterator

from mechwright.contracts.finding import Finding
from mechwright_cam.setup.job import Job
from mechwright_cam.setup.nest import Nest
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool

_ROUND = 10
"""mm: to this a travel that would do is rounded up."""

HOLDER = 30.0
"""Least length of shank and holder above a tool's flutes, mm: that of a small collet chuck."""


def height_of(tool: Tool, settings: CamSettings, thickness: float) -> float:
    """From the table to the nose of a spindle whose tool is as high over a part as rapids run, mm."""
    clamp = settings.hold.clamp_height if settings.hold.method == "bore" else 0.0
    return tool.flute_length + HOLDER + settings.clearance + clamp + thickness


def check_travel(job: Job) -> Iterator[Finding]:
    """Travel of X and Y: the least that the finest end mill travels around the part."""
    machine = job.settings.machine
    if not job.mills:
        return
    x0, y0, x1, y1 = job.target.bounds
    around = job.mills[-1].diameter
    fewer = ", or nest fewer parts" if isinstance(job.part, Nest) else ""
    for axis, size, travel in (("x", x1 - x0, machine.travel_x), ("y", y1 - y0, machine.travel_y)):
        wanted = size + around
        if wanted > travel:
            where, name = f"cam.machine.travel_{axis}", axis.upper()
            asked = f"part {job.part.name} asks for {wanted:.1f} mm of travel in {name}"
            message = f"{asked}, the machine has {travel:g}"
            least = math.ceil(wanted / _ROUND) * _ROUND
            remedy = f"take a machine with {least} mm in {name}, or a smaller part{fewer}"
            yield Finding.error("cam.travel", where, message, wanted, travel, "mm", remedy)


def check_machine(job: Job) -> Iterator[Finding]:
    """Travel of Z for the longest tool, and places in the tool changer."""
    machine, part = job.settings.machine, job.part.name
    longest = max(job.tools, key=lambda tool: tool.flute_length, default=None)
    wanted = 0.0 if longest is None else height_of(longest, job.settings, job.thickness)
    if longest is not None and wanted > machine.travel_z:
        message = (
            f"{longest.name} with its holder needs {wanted:.0f} mm between the table and a full "
            f"retract over part {part}"
        )
        where, remedy = "cam.machine.travel_z", "take a shorter tool, or a larger machine"
        yield Finding.error("cam.tool-too-long", where, message, wanted, machine.travel_z, "mm", remedy)
    count, pockets = len(job.tools), machine.pockets
    if 0 < pockets < count:
        message = f"part {part} takes {count} tools, the changer holds {pockets}"
        where, remedy = "cam.machine.pockets", "list fewer cutters in cam.tools, or change some by hand"
        yield Finding.warning("cam.pockets", where, message, count, pockets, "", remedy)
