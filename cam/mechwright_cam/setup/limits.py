"""What the machine is too small for, before any program is planned."""

from mechwright.contracts.finding import Finding, Severity
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool

HOLDER = 30.0
"""Least length of shank and holder above a tool's flutes, mm: that of a small collet chuck."""


def height_of(tool: Tool, settings: CamSettings, thickness: float) -> float:
    """From the table to the nose of a spindle whose tool is as high over a part as rapids run, mm."""
    clamp = settings.hold.clamp_height if settings.hold.method == "bore" else 0.0
    return tool.flute_length + HOLDER + settings.clearance + clamp + thickness


def check_machine(job: Job) -> list[Finding]:
    """Travel of Z for the longest tool, and places in the tool changer."""
    machine, found = job.settings.machine, []
    longest = max(job.tools, key=lambda tool: tool.flute_length, default=None)
    if longest is not None:
        wanted = height_of(longest, job.settings, job.thickness)
        if wanted > machine.travel_z:
            found.append(
                Finding(
                    "cam.tool-too-long",
                    Severity.ERROR,
                    "cam.machine.travel_z",
                    f"{longest.name} with its holder needs {wanted:.0f} mm between the table and a full "
                    f"retract over part {job.part.name}",
                    wanted,
                    machine.travel_z,
                    "mm",
                    "take a shorter tool, or a larger machine",
                )
            )
    if 0 < machine.pockets < len(job.tools):
        found.append(
            Finding(
                "cam.pockets",
                Severity.WARNING,
                "cam.machine.pockets",
                f"part {job.part.name} takes {len(job.tools)} tools, the changer holds {machine.pockets}",
                len(job.tools),
                machine.pockets,
                "",
                "list fewer cutters in cam.tools, or change some by hand",
            )
        )
    return found
