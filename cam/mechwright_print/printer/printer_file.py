"""Reading and writing ``printer.toml``."""

from pathlib import Path

from mechwright.designs.files import read_toml
from mechwright.designs.tables import read_table
from mechwright.designs.text import table_lines
from mechwright.errors import DesignError
from mechwright_print.printer.settings import Printer

TABLE = "printer"
"""What messages call the file's head."""


def read_printer(path: Path) -> Printer:
    """The printer that a file describes.

    Raises OutputError where it cannot be read, DesignError with a line for each wrong key.
    """
    content, _ = read_toml(path)
    if "parameters" in content or "family" in content:
        raise DesignError(
            f"{path}: is a design file; name a file of a printer, as mechwright print --measured writes it"
        )
    return read_table(Printer, content, str(path), TABLE, path)


def printer_text(printer: Printer, *head: str) -> str:
    """The file of a printer, every key with a comment; ``head`` lines stand above, as comments."""
    lines = table_lines(Printer, TABLE, printer)[1:]  # its keys stand at the head of the file
    said = [line.replace(f"[{TABLE}.", "[", 1) if line.startswith(f"[{TABLE}.") else line for line in lines]
    return "\n".join([*(f"# {line}" for line in head), *said]) + "\n"
