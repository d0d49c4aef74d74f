"""The table ``[machine]`` of a design file."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from mechwright.contracts.family import Family
from mechwright.contracts.model_schema import model_schema
from mechwright.contracts.parameters import Parameters
from mechwright.contracts.surroundings import Surroundings
from mechwright.contracts.table import Table
from mechwright.designs.tables import read_table
from mechwright.designs.text import table_lines
from mechwright.machine.settings import MachineSettings


class MachineTable(Table[MachineSettings]):
    """Reads and writes ``[machine]``."""

    name = "machine"
    settings = MachineSettings

    def read(self, content: object, path: Path) -> MachineSettings:
        """The settings; the defaults where the file has no table."""
        return read_table(MachineSettings, content, str(path), self.name)

    def laid_over(self, own: object, lent: Mapping[str, Any]) -> object:
        """A design without the table stays without a machine."""
        return super().laid_over(own, lent) if own else own

    def schema(self) -> dict[str, Any]:
        """Of the settings."""
        return model_schema(MachineSettings)

    def text(self, value: MachineSettings | None = None) -> list[str]:
        """The whole table for a new design; nothing where a design says nothing of a machine."""
        if value is not None and value == MachineSettings():
            return []
        return table_lines(MachineSettings, self.name, value)

    def surroundings(
        self, value: MachineSettings, family: Family[Any], params: Parameters
    ) -> Surroundings | None:
        """The frame, if one is asked for."""
        if value.frame == "none":
            return None
        from mechwright.machine.framed import framed

        return framed(value, family, params)
