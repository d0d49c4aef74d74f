"""A shop file to start from: every key with a comment, and tools that are there to be replaced."""

from collections.abc import Sequence

from mechwright.designs.inches import Units
from mechwright.designs.text import toml
from mechwright_cam.shop.bench import Bench, Sheet
from mechwright_cam.shop.toml_text import tool_table
from mechwright_cam.shop.tool import Tool
from mechwright_cam.shop.workshop import LAYOUT

STOCK = {"mm": (5.0, 6.0, 8.0, 10.0, 12.0, 15.0, 20.0), "inch": (0.1875, 0.25, 0.375, 0.5, 0.75)}
"""Thicknesses of the plates that a new file lists, in its units."""
PINS = {"mm": (3.0, 4.0, 5.0, 6.0, 8.0), "inch": (0.125, 0.25)}
"""The same of its pins."""
HOLDER = {"mm": 40.0, "inch": 1.575}
"""Diameter of a collet chuck's nut, in both."""


def bench_text(of: Bench, tools: Sequence[Tool], sheets: Sequence[Sheet]) -> str:
    """The shop of a small machine: tools without cutting data get estimates when a part is cut."""
    known = f"machine = {toml(of.model)}"
    if of.changes:
        known = "\n".join(
            [
                "",
                "[machine]",
                f"model = {toml(of.model)}",
                *(f"{k} = {toml(v)}" for k, v in of.changes.items()),
            ]
        )
    head, rest = ([known], []) if not of.changes else ([], [known])
    lines = [
        "# A shop: its machine, its mills, its sheets. Name it in the head of a design file:",
        '#   shop = "shop.toml"',
        f"format = {LAYOUT}",
        'name = "my bench"',
        f"control = {toml(of.control)}",
        *head,
        *rest,
    ]
    for sheet in sheets:
        lines += [
            "",
            "[[stock]]",
            f"material = {toml(sheet.material)}",
            f"thickness = [{sheet.thickness:g}]",
            f"# measured = {sheet.thickness:g}  # by callipers: plywood 6 is 5.2 to 6.3; plates follow it",
            f"length = {sheet.length:g}",
            f"width = {sheet.width:g}",
        ]
    lines += ["", "[prefer.cam]", f"coolant = {toml(of.preset.coolant)}", ""]
    for tool in tools:
        lines += [
            tool_table(tool).rstrip(),
            "# cutting.acrylic = { cutting_speed = 75, chip_load = 0.03, step_down = 0.2 }",
            "",
        ]
    return "\n".join(lines)


def shop_text(tools: Sequence[Tool], units: Units, control: str, machine: str) -> str:
    """A shop with these tools; lengths of tools stand with their unit, so that they are right in any file."""
    return "\n".join(
        [
            "# A shop: its tools, its machine, and what is in hand. Name it in the head of a design file:",
            '#   shop = "shop.toml"',
            "# or for all designs that name none, in the environment: MECHWRIGHT_SHOP=/path/to/shop.toml",
            f"format = {LAYOUT}",
            'name = "my shop"',
            f"units = {toml(units)}  # of bare numbers here, of programs, tables and sheets (mm | inch)",
            f"control = {toml(control)}",
            f"machine = {toml(machine)}  # a known mill, a machine file (.toml) beside this one, or a table",
            '# crib = "tools.tbl"  # a library of another program instead of the [[tool]] tables, or besides',
            'screws = ["M3", "M4", "M5", "M6"]  # that are kept; check names all others',
            f"pins = {toml(list(PINS[units]))}  # diameters of dowels",
            "",
            "[[stock]]  # plates in hand; with length and width they are ready blanks",
            'material = "aluminium"',
            f"thickness = {toml(list(STOCK[units]))}",
            "",
            "[holder.ER20]",
            f"diameter = {toml(HOLDER[units])}",
            "",
            "[prefer.cam]  # keys of [cam] that hold where a design says nothing of them",
            'coolant = "flood"',
            "",
            "[prefer.machine]  # the same of [machine], for designs with a frame",
            '# bearing = "60"',
            "",
            "# What a tool is for, its stick-out, its measured length and its wear go into its table:",
            '# purpose = "walls", stick_out = 25, length = 77.05, wear_length = -0.01, wear_diameter = -0.02',
            "",
            *(_tool(tool, units) for tool in tools),
        ]
    )


def _tool(tool: Tool, units: Units) -> str:
    """A tool in its holder."""
    usual: float = Tool.model_fields["holder_diameter"].default
    held = 'holder = "ER20"\n' if tool.holder_diameter == usual else ""
    head, kind, rest = tool_table(tool, units).partition("kind = ")
    return head + held + kind + rest
