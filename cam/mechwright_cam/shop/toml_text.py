"""A tool library of ours as a text."""

from collections.abc import Iterable
from typing import Any

from mechwright.designs.inches import Units, written
from mechwright.designs.text import bare_key, toml
from mechwright_cam.shop.tool import HOLLOW, Tool

HEAD = "# A tool library: the whole crib, so the built-in cutters are not at hand.\nbuilt_in = false\n"


def library_text(tools: Iterable[Tool]) -> str:
    """The TOML of a library that holds these tools and nothing else; what is as by default is left out."""
    return "\n".join([HEAD, *(tool_table(tool) for tool in tools)])


def tool_table(tool: Tool, units: Units = "mm") -> str:
    """A tool as a table of a file in these units; in an inch file millimetres stand with their unit."""
    said = tool.model_dump(mode="json", exclude={"cutting", "centre_cutting"}, exclude_defaults=True)
    lines = ["[[tool]]", *(f"{key} = {toml(value)}" for key, value in _in(units, said).items())]
    if tool.centre_cutting == (tool.kind in HOLLOW):
        lines.append(f"centre_cutting = {toml(tool.centre_cutting)}")
    if tool.cutting:
        lines.append("[tool.cutting]")
    for name, data in tool.cutting.items():
        # A dot, as in 1.4301, is none of a path.
        where = f"cutting.{name.replace('.', '-')}."
        keys = _in(units, data.model_dump(exclude_defaults=True), where)
        written_out = ", ".join(f"{key} = {toml(value)}" for key, value in keys.items())
        lines.append(f"{bare_key(name)} = {{ {written_out} }}")
    return "\n".join(lines) + "\n"


def _in(units: Units, said: dict[str, Any], where: str = "") -> dict[str, Any]:
    change = {f"tool.{where}{key}": value for key, value in said.items()}
    schemas = {} if units == "mm" else {"tool": Tool.model_json_schema()}
    return {key.rpartition(".")[2]: value for key, value in written(change, units, schemas).items()}
