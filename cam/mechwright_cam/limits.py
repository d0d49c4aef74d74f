"""What the machine is too small for, before any program is planned."""

from mechwright.findings import Finding, Severity
from mechwright_cam.job import Job

HOLDER = 30.0
"""Least length of shank and holder above a tool's flutes, mm: that of a small collet chuck."""


def check_machine(job: Job) -> list[Finding]:
    """Travel of Z for the longest tool, and places in the tool changer."""
    machine, found = job.settings.machine, []
    longest = max(job.tools, key=lambda tool: tool.flute_length, default=None)
    if longest is not None:
        clamp = job.clamp.top if job.clamp is not None else 0.0
        wanted = longest.flute_length + HOLDER + job.settings.clearance + clamp + job.thickness
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
