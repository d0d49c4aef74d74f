"""Reads and writes ``[cut]``."""

from pathlib import Path
from typing import Any

from mechwright.contracts.model_schema import model_schema
from mechwright.contracts.table import Table
from mechwright.designs.design import Design
from mechwright.designs.tables import read_table
from mechwright.designs.text import table_lines
from mechwright_cut.settings.cut_settings import CutSettings


class CutTable(Table[CutSettings]):
    """The table ``[cut]``."""

    name = "cut"
    settings = CutSettings

    def read(self, content: object, path: Path) -> CutSettings:
        """The settings."""
        return read_table(CutSettings, content, str(path), self.name)

    def text(self, value: CutSettings | None = None) -> list[str]:
        """The table; nothing for a design that says nothing of cutting."""
        if value is None or not value.model_fields_set:
            return []
        return table_lines(CutSettings, self.name, value)

    def schema(self) -> dict[str, Any]:
        """The keys."""
        return model_schema(CutSettings)


def cut_settings(design: Design) -> CutSettings:
    """What a design says of cutting."""
    return design.table(CutTable)
