"""All rules, in the order of the report."""

from mechwright_cam.proof.held import clamp
from mechwright_cam.proof.machine_rules import (
    arcs,
    coolant,
    dwells,
    feeds,
    length_offset,
    modes,
    positions,
    program_end,
    speeds,
    spindle,
    tool_changes,
    tools_known,
    work_offset,
)
from mechwright_cam.proof.motion_rules import (
    entries,
    flutes,
    holder,
    rapid_height,
    rapids_in_stock,
    travel,
)
from mechwright_cam.proof.scene import Rule

RULES: tuple[Rule, ...] = (
    *(program_end, modes, tools_known, work_offset, length_offset, positions, tool_changes, spindle, coolant),
    *(arcs, feeds, speeds, dwells, travel, flutes, rapid_height, rapids_in_stock, entries, holder, clamp),
)
"""All rules, in the order of the report."""
