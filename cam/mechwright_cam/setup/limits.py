"""What the machine is too small for, before any program is planned.

Heights above the table: G the nose of the spindle at the upper end of Z, T the travel of Z, w the spoil
board, t the stock, c what holds it above that, a the clearance of rapids, o how far cuts go below the stock.
A tool that stands s out of the nose

    reaches the deepest cut with       s >= (G - T) - (w - o),
    clears what stands on the table    s <= G - (w + t + c + a),
    and is held with                   s <= L - g,

L its length and g the grip of the collet. The first two together ask for T >= t + c + a + o, whatever G is.
"""

import math
from collections.abc import Iterator

from mechwright.contracts.finding import Finding
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.machine import Machine
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool
from mechwright_plane.nest import Nest

_ROUND = 10
"""mm: to this a travel that would do is rounded up."""

HOLDER_GAP = 3.0
"""Air between the holder and the highest thing below it, mm: chips pack in less."""

SAME = 1e-6
"""Diameters that differ by less are the same, mm."""

CHUCK = 30.0
"""Height of a collet chuck below the nose of a spindle, mm; a collet in the nose itself has none."""


def clamp_height(settings: CamSettings) -> float:
    """How far what holds the part stands above the stock, mm."""
    if settings.hold.method == "bore":
        return settings.hold.clamp_height
    return max((toe[4] for toe in settings.hold.toe_clamps), default=0.0)


def chuck(settings: CamSettings) -> float:
    """Height of what stands between the nose of the spindle and the tool, mm."""
    return 0.0 if settings.machine.collet is not None else CHUCK


def least_stick_out(tool: Tool, settings: CamSettings, thickness: float) -> float:
    """Least length of a tool out of its holder for a cut through the part, mm; its own where it is set."""
    if tool.stick_out is not None:
        return tool.stick_out
    return min(tool.flute_length, thickness + settings.breakthrough) + clamp_height(settings) + HOLDER_GAP


def height_of(tool: Tool, settings: CamSettings, thickness: float) -> float:
    """From the table to the nose of a spindle whose tool is as high over a part as rapids run, mm."""
    below = max(settings.machine.spoil_board, settings.breakthrough)
    over = below + thickness + clamp_height(settings) + settings.clearance
    return least_stick_out(tool, settings, thickness) + chuck(settings) + over


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
    """Travel of Z, room below the spindle, shanks, and places in the tool changer."""
    machine, part = job.settings.machine, job.part.name
    yield from _span(job)
    if machine.nose_to_table is not None:
        yield from _room(job, machine.nose_to_table)
    if machine.collet is not None:
        yield from _shanks(job, machine.collet)
    count, pockets = len(job.tools), machine.pockets
    if 0 < pockets < count:
        message = f"part {part} takes {count} tools, the changer holds {pockets}"
        where, remedy = "cam.machine.pockets", "list fewer cutters in cam.tools, or change some by hand"
        yield Finding.warning("cam.pockets", where, message, count, pockets, "", remedy)


def _span(job: Job) -> Iterator[Finding]:
    """From the deepest cut to the height of rapids: what Z has to travel in any case."""
    settings, machine = job.settings, job.settings.machine
    wanted = job.thickness + settings.breakthrough + clamp_height(settings) + settings.clearance
    if wanted > machine.travel_z:
        message = (
            f"part {job.part.name} asks for {wanted:.1f} mm of travel in Z: {job.thickness:g} of stock, "
            f"{settings.breakthrough:g} below it, {clamp_height(settings):g} of clamps and "
            f"{settings.clearance:g} of clearance; the machine has {machine.travel_z:g}"
        )
        remedy = "take thinner stock, or hold it by tabs or from below"
        yield Finding.error(
            "cam.travel-z", "cam.machine.travel_z", message, wanted, machine.travel_z, "mm", remedy
        )


def _room(job: Job, nose: float) -> Iterator[Finding]:
    """Whether every tool gets over the part, and down to its deepest cut."""
    settings, machine, part = job.settings, job.settings.machine, job.part.name
    where = "cam.machine.nose_to_table"
    longest = max(job.tools, key=lambda one: height_of(one, settings, job.thickness), default=None)
    wanted = 0.0 if longest is None else height_of(longest, settings, job.thickness)
    if longest is not None and wanted > nose:
        message = (
            f"{longest.name} in its holder needs {wanted:.0f} mm between the table and the nose of the "
            f"spindle to pass over part {part}, and there are {nose:g}"
        )
        remedy = (
            "take a shorter tool, thinner stock or a thinner spoil board, or raise the spindle in its clamp"
        )
        yield Finding.error("cam.tool-too-long", where, message, wanted, nose, "mm", remedy)
    yield from _depth(job, nose - machine.travel_z)


def _depth(job: Job, lowest: float) -> Iterator[Finding]:
    """Whether every tool gets down to the deepest cut: the nose stays ``lowest`` mm over the table."""
    settings, machine = job.settings, job.settings.machine
    wanted = lowest - max(machine.spoil_board - settings.breakthrough, 0.0)
    for tool in job.tools:
        out = tool.longest_stick_out + chuck(settings)
        if out < wanted:
            message = (
                f"{tool.name} reaches {out:.0f} mm below the nose of the spindle at most, and has to reach "
                f"{wanted:.0f} to cut through part {job.part.name}: at the lower end of Z the nose is "
                f"{lowest:g} mm above the table"
            )
            board = math.ceil(machine.spoil_board + wanted - out)
            remedy = (
                f"lay a spoil board of {board} mm under the stock (spoil_board = {board}), lower the spindle "
                "in its clamp, or take a longer tool"
            )
            where = "cam.machine.nose_to_table"
            yield Finding.error("cam.tool-too-short", where, message, out, wanted, "mm", remedy)
            return


def fits_collet(tool: Tool, machine: Machine) -> bool:
    """Whether the spindle holds the shank of a tool, as far as its collet is known."""
    return machine.collet is None or _shank(tool) <= machine.collet + SAME


def _shank(tool: Tool) -> float:
    return tool.diameter if tool.shank_diameter is None else tool.shank_diameter


def _shanks(job: Job, collet: float) -> Iterator[Finding]:
    """Shanks that the collet does not take."""
    for tool in job.tools:
        if not fits_collet(tool, job.settings.machine):
            shank = _shank(tool)
            message = f"{tool.name} has a shank of {shank:g} mm, and the collet holds {collet:g} at most"
            remedy = f"take one with a shank of {collet:g} mm or less, or leave it out of cam.tools"
            yield Finding.error("cam.collet", "cam.machine.collet", message, shank, collet, "mm", remedy)
