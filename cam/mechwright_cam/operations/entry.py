"""The way onto a contour with cutter compensation, and off it.

A straight line, longer than D may ever be, turns compensation on; an arc, wider than D may ever be, follows
it tangentially and touches the contour. So every control does the same, whatever D is.

Glossary
--------
base
    Distance from the wall at which the contour runs: 0, or with ``compensation = "wear"`` the radius.
D
    What the control's offset holds, as a radius: that of the cutter, or its difference from the planned one.
lead
    The line and the arc from the place where the cutter is sunk to the contour.
"""

import math
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.errors import ToolError
from mechwright.geometry.segments import Point
from mechwright_cam.setup.job import LEAST_TURN
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool

ENTRY = 0.1
"""The straight entry and the arc of a lead are by this longer and wider than the largest D, mm."""
SAMPLES = 6
"""Places of a lead's arc that are tested, and of its line."""


@dataclass(frozen=True)
class Offsets:
    """What D may be, as a radius, mm."""

    base: float
    planned: float
    limit: float

    @property
    def least(self) -> float:
        """The smallest D."""
        return self.planned - self.limit

    @property
    def most(self) -> float:
        """The largest D."""
        return self.planned + self.limit

    @property
    def straight(self) -> float:
        """Length of the straight part of a lead, and least radius of its arc."""
        return self.most + ENTRY


def offsets_of(tool: Tool, settings: CamSettings) -> Offsets:
    """What D may be for a tool; raises ToolError where the wear allowed is as large as the tool."""
    limit = settings.wear_limit
    if limit + LEAST_TURN >= tool.radius:
        raise ToolError(
            f"cam.wear_limit: {limit:g} mm is too much for {tool.name}, whose radius is {tool.radius:g} mm; "
            f"use less than {tool.radius - LEAST_TURN:g} mm"
        )
    return _offsets(tool, settings)


def _offsets(tool: Tool, settings: CamSettings) -> Offsets:
    if settings.compensation == "wear":
        return Offsets(tool.radius, 0.0, settings.wear_limit)
    return Offsets(0.0, tool.radius, settings.wear_limit)


@dataclass(frozen=True)
class Lead:
    """The way onto a contour: a line of ``straight`` mm, then an arc of ``radius`` mm over ``sweep`` rad.

    Local coordinates: the contour is touched at 0, 0, x along the contour, y away from the wall.
    """

    radius: float
    sweep: float
    straight: float

    @property
    def turn(self) -> Point:
        """Where the line meets the arc."""
        return -self.radius * math.sin(self.sweep), self.radius * (1 - math.cos(self.sweep))

    @property
    def start(self) -> Point:
        """Where the cutter is sunk; D does not move it."""
        x, y = self.turn
        return x - self.straight * math.cos(self.sweep), y + self.straight * math.sin(self.sweep)


def ways(radius: float, straight: float, sweep: Array, d: float) -> Array:
    """Places (k, n, 2) of the tool's centre with this D along leads of these sweeps (k,), in order."""
    a = sweep[:, None] * np.linspace(1.0, 0.0, SAMPLES + 1)
    inner = radius - d
    arcs = np.stack((-inner * np.sin(a), radius - inner * np.cos(a)), axis=-1)
    t = np.linspace(0.0, 1.0, SAMPLES + 1)[:-1, None]
    lines = (1 - t) * starts(radius, straight, sweep)[:, None] + t * arcs[:, :1]
    return np.concatenate((lines, arcs), axis=1)


def starts(radius: float, straight: float, sweep: Array) -> Array:
    """Where leads of these sweeps (k,) start, (k, 2)."""
    s, c = np.sin(sweep), np.cos(sweep)
    return np.column_stack((-radius * s - straight * c, radius * (1 - c) + straight * s))


def lead_to(radius: float, straight: float, rise: float) -> Lead | None:
    """The lead that starts ``rise`` mm over the contour; None if no such lead turns by less than 90 degrees.

    radius (1 - cos a) + straight sin a = rise, solved for the sweep a.
    """
    far = math.hypot(radius, straight)
    if not radius - far <= rise <= radius + straight:
        return None
    sweep = math.asin(min(1.0, max(-1.0, (rise - radius) / far))) + math.atan2(radius, straight)
    return Lead(radius, max(sweep, 0.0), straight)


def leads(offsets: Offsets, radius: float, allowance: float) -> list[Lead]:
    """Leads to try for a tool of ``radius``, roomy ones first; the last start just outside the allowance."""
    least = offsets.straight - offsets.planned
    rises = sorted({radius, radius / 2, 2 * allowance, least, allowance}, reverse=True)
    wide = radius if offsets.planned == 0 else offsets.straight + radius / 2
    long = max(offsets.straight, radius / 2)
    turns = dict.fromkeys(max(turn, offsets.straight) for turn in (wide, wide / 2, offsets.straight))
    shapes = [
        lead_to(turn, straight, offsets.planned + rise)
        for rise in rises
        if rise >= allowance
        for straight in dict.fromkeys((long, offsets.straight))
        for turn in turns
    ]
    return [lead for lead in shapes if lead is not None]


def lead_length(tool: Tool, settings: CamSettings) -> float:
    """How far the least lead goes beside the end of a contour, with any D, mm."""
    if settings.compensation == "computer":
        return 0.0
    offsets = _offsets(tool, settings)
    return 2 * offsets.straight + offsets.limit


def bore_lead(offsets: Offsets, contour: float) -> Lead:
    """The lead onto a circular contour of this radius, from its middle, or from as near to it as it gets.

    Its start, the middles of its arc and of the circle are on one line, so the sweep is 180 degrees less
    atan(straight / radius), and the start is radius + sqrt(radius² + straight²) - contour from the middle.
    """
    straight = max(offsets.straight, contour / 3)  # a third of it leaves most of it to the arc
    radius = max((contour**2 - straight**2) / (2 * contour), offsets.straight)
    return Lead(radius, math.pi - math.atan2(straight, radius), straight)


def enters(tool: Tool, diameter: float, settings: CamSettings) -> bool:
    """Whether a tool has room in a bore to turn compensation on."""
    if settings.compensation == "computer":
        return True
    offsets = _offsets(tool, settings)
    contour = diameter / 2 - offsets.base
    if contour - offsets.most < LEAST_TURN or offsets.straight > contour:
        return False
    aside = bore_lead(offsets, contour).start[1] - contour
    return aside + tool.radius <= diameter / 2 - settings.stock_to_leave
