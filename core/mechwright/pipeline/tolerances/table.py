"""The table ``[tolerances]`` of a design file, with the tables ``[tolerances.of.NAME]``."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from mechwright.contracts.model_schema import model_schema
from mechwright.contracts.part import Part
from mechwright.contracts.table import Table
from mechwright.contracts.tolerance_settings import OwnTolerance, Tolerances, ToleranceSettings
from mechwright.designs.tables import read_table
from mechwright.designs.text import table_lines, toml
from mechwright.errors import DesignError

_OWN = (
    "",
    "# Any contributor by its name, as check --tolerances lists them, in mm or degrees:",
    "# [tolerances.of.NAME]",
    '# lower = -0.01  # or fit = "H7/f7" of a pin',
    "# upper = 0.02",
)
_BARE = re.compile(r"[A-Za-z0-9_-]+")


class TolerancesTable(Table[Tolerances]):
    """Reads and writes ``[tolerances]``."""

    name = "tolerances"
    settings = ToleranceSettings

    def read(self, content: object, path: Path) -> Tolerances:
        """The settings, and what single contributors have of their own."""
        if not isinstance(content, Mapping):
            return Tolerances(read_table(ToleranceSettings, content, str(path), self.name))
        settings = {key: value for key, value in content.items() if key != "of"}
        own = content.get("of", {})
        if not isinstance(own, Mapping):
            raise DesignError(f"{path}: tolerances.of: is {own!r}; write tables [tolerances.of.NAME]")
        return Tolerances(
            read_table(ToleranceSettings, settings, str(path), self.name),
            {
                name: read_table(OwnTolerance, table, str(path), f"{self.name}.of.{name}")
                for name, table in own.items()
            },
        )

    def parts(self, value: Tolerances, parts: Sequence[Part], path: Path) -> Sequence[Part]:  # noqa: ARG002
        """The parts with their lengths between holes, which have these tolerances, to be measured."""
        from mechwright.contracts.datum import over_pins

        return [
            replace(part, measures=(*part.measures, *found)) if (found := over_pins(part, value)) else part
            for part in parts
        ]

    def schema(self) -> dict[str, Any]:
        """The settings, and the tables of single contributors."""
        whole, own = model_schema(ToleranceSettings), model_schema(OwnTolerance)
        defs = {**own.pop("$defs", {}), **whole.pop("$defs", {}), "own": own}
        whole["properties"]["of"] = {
            "type": "object",
            "additionalProperties": {"$ref": "#/$defs/own"},
            "description": "Tables of single contributors, by name.",
        }
        return {**whole, "$defs": defs}

    def text(self, value: Tolerances | None = None) -> list[str]:
        """The whole table for a new design; nothing where a design says nothing of tolerances."""
        if value is None:
            return [*table_lines(ToleranceSettings, self.name), *_OWN]
        if value == Tolerances():
            return []
        lines = table_lines(ToleranceSettings, self.name, value.settings)
        for name, own in value.own.items():
            key = name if _BARE.fullmatch(name) else toml(name)
            lines += ["", *table_lines(OwnTolerance, f"{self.name}.of.{key}", own)]
        return lines
