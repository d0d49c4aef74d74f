"""A tool library of ours as a text."""

from collections.abc import Iterable

from mechwright.designs.text import toml
from mechwright_cam.shop.tool import CuttingData, Tool, ToolKind

HEAD = "# A tool library: the whole crib, so the built-in cutters are not at hand.\nbuilt_in = false\n"


def library_text(tools: Iterable[Tool]) -> str:
    """The TOML of a library that holds these tools and nothing else; what is as by default is left out."""
    return "\n".join([HEAD, *(_table(tool) for tool in tools)])


def _table(tool: Tool) -> str:
    said = tool.model_dump(mode="json", exclude={"cutting", "centre_cutting"}, exclude_defaults=True)
    lines = ["[[tool]]", *(f"{key} = {toml(value)}" for key, value in said.items())]
    if tool.centre_cutting == (tool.kind in {ToolKind.CHAMFER, ToolKind.THREAD_MILL}):
        lines.append(f"centre_cutting = {toml(tool.centre_cutting)}")
    if tool.cutting:
        lines.append("[tool.cutting]")
    return "\n".join([*lines, *(f"{name} = {_data(data)}" for name, data in tool.cutting.items())]) + "\n"


def _data(data: CuttingData) -> str:
    said = data.model_dump(exclude_defaults=True)
    return "{ " + ", ".join(f"{key} = {toml(value)}" for key, value in said.items()) + " }"
