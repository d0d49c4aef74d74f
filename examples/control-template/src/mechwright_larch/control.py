"""The Larch 300: as Fanuc, but for its coolant words and its tables of offsets."""

from collections.abc import Iterable, Sequence
from dataclasses import replace

from mechwright_cam.controls.fanuc import Fanuc
from mechwright_cam.controls.offsets import OffsetTables
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool

TABLE = "larch.ofs"
"""The file of its offsets."""


class Larch(Fanuc):
    """Larch 300: flood coolant is M108, coolant off M109; D is the radius, in one column."""

    name = "larch"
    title = "Larch 300"
    dialect = replace(Fanuc.dialect, m_words=((8, 108), (9, 109)))
    offsets = OffsetTables(d="radius")

    def tool_table(self, tools: Sequence[Tool]) -> tuple[str, str]:
        """``larch.ofs``: number and length of each tool; a length not measured yet stands at 0."""
        return TABLE, _text(f"H{tool.number:03d} {tool.length or 0.0:.3f}" for tool in tools)

    def offset_table(self, tools: Sequence[Tool], settings: CamSettings) -> tuple[str, str]:
        """The same, and what D holds as planned."""
        _, lengths = self.tool_table(tools)
        offsets = self.offsets.of_tools(tools, settings)
        return TABLE, lengths + _text(f"D{offset.number:03d} {offset.planned:.3f}" for offset in offsets)

    def table_words(self, table: str) -> str:
        """What to do with the file of offsets."""
        return f"Load {table} on the offset page, then correct H and D there."


def _text(lines: Iterable[str]) -> str:
    return "".join(f"{line}\n" for line in sorted(set(lines)))
