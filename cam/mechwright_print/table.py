"""The table ``[print]`` of a design file, with the printer that it names."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from mechwright.contracts.model_schema import model_schema
from mechwright.contracts.table import Table
from mechwright.designs.design import Design
from mechwright.designs.files import beside
from mechwright.designs.tables import read_table
from mechwright.designs.text import table_lines
from mechwright_print.printer.printer_file import TABLE, read_printer
from mechwright_print.printer.settings import Printer
from mechwright_print.settings import PRINT, PrintSettings


@dataclass(frozen=True)
class Printing:
    """What a design file says of printing, and the printer that it names."""

    settings: PrintSettings = field(default_factory=PrintSettings)
    printer: Printer = field(default_factory=Printer)


class PrintTable(Table[Printing]):
    """Reads and writes ``[print]``."""

    name = PRINT
    settings = PrintSettings

    def read(self, content: object, path: Path) -> Printing:
        """The settings, and the printer of the file that they name."""
        settings = read_table(PrintSettings, content, str(path), self.name)
        if not settings.printer:
            return Printing(settings)
        return Printing(settings, read_printer(beside(path, settings.printer, "print.printer")))

    def text(self, value: Printing | None = None) -> list[str]:
        """The table where a design says something of printing; most are not printed."""
        if value is None or value.settings == PrintSettings():
            return []
        return table_lines(PrintSettings, self.name, value.settings)

    def schema(self) -> dict[str, Any]:
        """The settings."""
        return model_schema(PrintSettings)

    def file_schema(self) -> dict[str, Any]:
        """That of a file of a printer."""
        return {**model_schema(Printer), "title": TABLE}

    def inputs(self, value: Printing, path: Path) -> Mapping[str, Path]:
        """The file of the printer."""
        name = value.settings.printer
        return {name: beside(path, name, "print.printer")} if name else {}

    def carried(self, value: Printing, path: Path) -> tuple[Printing, Mapping[str, Path]]:
        """The same settings; the file of the printer goes along."""
        if not value.settings.printer:
            return value, {}
        file = beside(path, value.settings.printer, "print.printer")
        settings = value.settings.model_copy(update={"printer": file.name})
        return Printing(settings, value.printer), {file.name: file}


def printing_of(design: Design) -> Printing:
    """What a design says of printing."""
    return design.table(PrintTable)


def is_printed(design: Design) -> bool:
    """Whether a design file has the table."""
    return PrintTable.name in design.content
