"""The table ``[fits]`` of a design file, with single pairs in ``[fits.of]``."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from mechwright.contracts.fit_settings import Fits, FitSettings, hole_name
from mechwright.contracts.model_schema import model_schema
from mechwright.contracts.table import Table
from mechwright.designs.tables import read_table
from mechwright.designs.text import table_lines, toml
from mechwright.errors import DesignError

_OWN = (
    "",
    "# The hole's class of a single pair, by the names of both parts:",
    "# [fits.of]",
    '# "shaft in crank" = "N7"',
)


class FitsTable(Table[Fits]):
    """Reads and writes ``[fits]``."""

    name = "fits"
    settings = FitSettings
    lender = True

    def lends(self, value: Fits) -> Mapping[str, Mapping[str, Any]]:
        """The fit of pins that turn, where the file says one, to the analysis of tolerances."""
        running = value.settings.running
        return {} if running is None else {"tolerances": {"fit": f"{running}/{value.settings.shaft}"}}

    def read(self, content: object, path: Path) -> Fits:
        """The settings, and the classes of single pairs."""
        if not isinstance(content, Mapping):
            return Fits(read_table(FitSettings, content, str(path), self.name))
        settings = {key: value for key, value in content.items() if key != "of"}
        own = content.get("of", {})
        if not isinstance(own, Mapping):
            raise DesignError(f"{path}: fits.of: is {own!r}; write a table [fits.of]")
        for pair, text in own.items():
            _check_pair(f'{path}: fits.of."{pair}"', pair, text)
        return Fits(read_table(FitSettings, settings, str(path), self.name), dict(own))

    def schema(self) -> dict[str, Any]:
        """The settings, and the classes of single pairs."""
        whole = model_schema(FitSettings)
        whole["properties"]["of"] = {
            "type": "object",
            "additionalProperties": {"type": "string"},
            "description": 'Class of the hole of single pairs, by "PIN in PART".',
        }
        return whole

    def text(self, value: Fits | None = None) -> list[str]:
        """The whole table for a new design; nothing where a design says nothing of fits."""
        if value is None:
            return [*table_lines(FitSettings, self.name), *_OWN]
        if value == Fits():
            return []
        lines = table_lines(FitSettings, self.name, value.settings)
        if value.own:
            lines += [
                "",
                f"[{self.name}.of]",
                *(f"{toml(pair)} = {toml(of)}" for pair, of in value.own.items()),
            ]
        return lines


def _check_pair(where: str, pair: str, text: object) -> None:
    """Raise DesignError for what is no pair of parts, or no class of holes."""
    if " in " not in pair:
        raise DesignError(f'{where}: names no pair; write the parts, such as "shaft in crank"')
    try:
        hole_name(text)
    except ValueError as error:
        raise DesignError(f"{where}: {text!r} {error}") from error
