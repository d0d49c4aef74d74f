"""Spindle speed and feeds of a tool in a material on a machine."""

import math
from dataclasses import dataclass

from mechwright.errors import ToolError
from mechwright_cam.shop.cutter import approach
from mechwright_cam.shop.machine import Machine
from mechwright_cam.shop.tool import CuttingData, Tool

RAMP_SHARE = 0.5
"""Feed on the steepest ramps and helices: the cutter works with its end as well as with its side."""

MOST_THINNING = 3.0
"""Feed is raised no further for thin chips: with more, the cusps along the path show."""

SLOWEST = 0.5
"""Where the machine's fastest feed is too slow, the spindle gives way, down to this share of the cutting
speed: chips stay as thick as planned. Slower still, aluminium and steel build up on the edge."""

EXACT = 3
"""Decimals of a feed that all controls keep: speed times pitch of a tap is to have no more, mm/min."""
MOST_TURNS = 64
"""In steps of so many turns at most a speed is looked for that makes it so: 28 threads per inch take 7."""
NOISE = 1e-9
"""Noise of floating point in a product of both, mm."""

RUBS = 0.5
"""Below this share of its chip load a tooth rubs as much as it cuts: usual ranges reach about so far down."""

TOO_FAST = 1.01
"""Beyond this share of its cutting speed a cutter runs too fast: less is rounding."""


@dataclass(frozen=True)
class Rates:
    """Spindle in rev/min; feeds of the cutter's centre in mm/min."""

    spindle: float
    feed: float
    ramp: float
    plunge: float
    fastest: float
    """The machine's limit."""
    chip: float
    """Feed per tooth in a full cut, mm: the planned chip load, or less where the machine feeds too slowly."""
    full: float
    """Feed of a full cut: ``feed`` is above it where chips are thin."""

    def inside(self, path_radius: float, cutter_radius: float, feed: float | None = None) -> float:
        """Feed of the centre on a circle inside a wall, so that the cutting edge has the planned feed."""
        wanted = self.feed if feed is None else feed
        return max(self.plunge, round(wanted * path_radius / (path_radius + cutter_radius)))


def cutting_data(tool: Tool, material: str) -> CuttingData:
    """How the tool cuts the material; raises ToolError that lists the materials it knows."""
    try:
        return tool.cutting[material]
    except KeyError:
        known = ", ".join(sorted(tool.cutting)) or "no material"
        raise ToolError(
            f"cam.tools: tool {tool.name} has no cutting data for {material}, only for {known}; "
            f"add [tool.cutting] {material} to the tool library, or give cutting_speed and chip_load in "
            f"[cam.cutting.{tool.name}]"
        ) from None


def runs_too_fast(tool: Tool, material: str, machine: Machine, diameter: float | None = None) -> bool:
    """Whether the machine's slowest speed overspeeds a tool that has data for the material.

    It cuts with all of its width, or up to a ``diameter``, mm, as a spot drill does.
    """
    most = 1000 * cutting_data(tool, material).cutting_speed * TOO_FAST
    return machine.spindle_min * math.pi * (tool.diameter if diameter is None else diameter) > most


def rubs(tool: Tool, material: str, machine: Machine) -> bool:
    """Whether the machine feeds a tool so slowly that its teeth take next to nothing."""
    return rates(tool, material, machine).chip < RUBS * cutting_data(tool, material).chip_load


def rates(
    tool: Tool,
    material: str,
    machine: Machine,
    engagement: float = math.pi / 2,
    depth: float = math.inf,
) -> Rates:
    """Speeds within the machine's limits: n = 1000 v / (π d), feed = n z f_z (common workshop formulas).

    Where the machine feeds too slowly for that, the spindle slows down as well: a tooth that gets next to no
    feed rubs, which wears it more than any speed.

    With an ``engagement``, rad, below a right angle no chip gets thicker than f_z sin(engagement): the feed
    is raised so that it is the planned chip load all the same. So it is where a cut is less deep than the
    corner of a round mill: there h = f_z sin(κ), κ the greatest angle of the edge.
    """
    data = cutting_data(tool, material)
    wanted = 1000 * data.cutting_speed / (math.pi * tool.diameter)
    if tool.pitch is not None:
        return _tapping(tool, tool.pitch, wanted, machine)
    fed = machine.max_feed / (tool.flutes * data.chip_load)
    wanted = min(wanted, max(fed, SLOWEST * wanted))
    spindle = machine.speed(wanted)
    most = spindle * tool.flutes * data.chip_load
    thin = math.sin(min(engagement, math.pi / 2)) * float(approach(tool, depth))
    thinning = 1 / max(thin, 1 / MOST_THINNING)
    plain = max(1.0, math.floor(min(most, machine.max_feed)))
    feed = max(1.0, math.floor(min(most * thinning, machine.max_feed)))
    return Rates(
        spindle,
        feed,
        max(1.0, round(plain * RAMP_SHARE)),
        max(1.0, round(plain * data.plunge)),
        machine.max_feed,
        data.chip_load * min(1.0, machine.max_feed / most),
        plain,
    )


def _tapping(tool: Tool, pitch: float, wanted: float, machine: Machine) -> Rates:
    """Feed is speed times pitch, to the last decimal: the speed is the fastest one for which it is that.

    Raises ToolError where the machine's slowest speed feeds a tap faster than the machine can.
    """
    whole = (turns for turns in range(1, MOST_TURNS + 1) if _is_exact(turns * pitch))
    step = next(whole, 1)
    most = min(wanted, machine.spindle_max, machine.max_feed / pitch)
    spindle = float(max(math.floor(most / step), 1) * step)
    while spindle < machine.spindle_min:
        spindle += step
    feed = spindle * pitch
    if feed > machine.max_feed:
        raise ToolError(
            f"cam.tools: {tool.name} with its pitch of {pitch:g} mm goes {feed:.0f} mm/min at the slowest "
            f"speed of the machine, {machine.spindle_min:g} rpm, and it feeds {machine.max_feed:g} at most; "
            "mill the thread"
        )
    return Rates(spindle, feed, feed, feed, machine.max_feed, pitch / tool.flutes, feed)


def _is_exact(feed: float) -> bool:
    return abs(feed - round(feed, EXACT)) < NOISE
