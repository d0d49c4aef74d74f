"""All rules, in the order of the report."""

from mechwright_cam.proof.corridor import corridor
from mechwright_cam.proof.cutting_rules import chips, cutting_speed, pecks
from mechwright_cam.proof.depth_of_cut import depth_of_cut
from mechwright_cam.proof.held import clamp
from mechwright_cam.proof.machine_moves import machine_moves
from mechwright_cam.proof.machine_rules import (
    arcs,
    coolant,
    diameter_offset,
    dwells,
    feeds,
    length_offset,
    modes,
    positions,
    program_end,
    speeds,
    spindle,
    stops,
    tool_changes,
    tools_known,
    work_offset,
)
from mechwright_cam.proof.motion_rules import (
    beside,
    entries,
    flutes,
    holder,
    rapid_height,
    rapids_in_stock,
    travel,
    underside,
)
from mechwright_cam.proof.scene import Rule
from mechwright_cam.proof.tables import offset_tables

RULES: tuple[Rule, ...] = (
    *(program_end, modes, tools_known, work_offset, offset_tables, length_offset, diameter_offset),
    *(positions, machine_moves, corridor, tool_changes),
    *(stops, spindle, coolant, arcs, feeds, speeds, cutting_speed, chips, pecks, depth_of_cut, dwells),
    *(travel, flutes, underside, beside, rapid_height, rapids_in_stock, entries, holder, clamp),
)
"""All rules, in the order of the report."""
