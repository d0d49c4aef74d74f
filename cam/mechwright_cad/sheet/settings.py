"""What a design file says of its drawings in ``[drawings]``."""

from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field

from mechwright.contracts.inputs import InputFile
from mechwright.contracts.model_schema import model_schema
from mechwright.contracts.parameters import Parameters
from mechwright.contracts.table import Table
from mechwright.designs.tables import read_table
from mechwright.errors import DesignError
from mechwright_cad.sheet.fonts import default_font, embedded, is_plain

Words = Annotated[str, Field(max_length=60, pattern=r"^[^\x00-\x1f\x7f]*$")]
Short = Annotated[str, Field(max_length=24, pattern=r"^[^\x00-\x1f\x7f]*$")]


class DrawingSettings(Parameters):
    """The table ``[drawings]``: what the title block of every drawing says, and its projection."""

    owner: Words = Field("", description="Legal owner of the drawings, such as the firm.")
    title: Words = Field("", description="Title of the machine. Default: the design's name.")
    number: Short = Field("", description="Number of the set of drawings; each adds its part's name.")
    revision: Short = Field("", description="Index of the revision.")
    date: Short = Field("", description="Date of issue, such as 2026-11-30.")
    author: Short = Field("", description="Who drew it.")
    approved: Short = Field("", description="Who approved it.")
    font: InputFile = Field(
        InputFile(),
        description="TrueType font, a .ttf beside the design file, for letters that Helvetica has not. "
        "Default: DejaVu Sans, where Matplotlib is installed.",
    )
    projection: Literal["first", "third"] = Field(
        "first", description="Angle of the projection: first (ISO) or third (America)."
    )


class DrawingTable(Table[DrawingSettings]):
    """Reads and writes ``[drawings]``."""

    name = "drawings"
    settings = DrawingSettings

    def read(self, content: object, path: Path) -> DrawingSettings:
        """The settings; the defaults where the file has no table."""
        found = read_table(DrawingSettings, content, str(path), self.name, path)
        for key, text in found:
            if isinstance(text, str) and not is_plain(text):
                try:
                    embedded(found.font.data or default_font(), [text], found.font.name or "the font at hand")
                except DesignError as error:
                    raise DesignError(f"{path}: drawings.{key}: {error}") from error
        return found

    def schema(self) -> dict[str, Any]:
        """Of the settings."""
        return model_schema(DrawingSettings)

    def text(self, value: DrawingSettings | None = None) -> list[str]:
        """The whole table for a new design; nothing where a design says nothing of drawings."""
        if value is not None and value == DrawingSettings():
            return []
        from mechwright.designs.text import table_lines

        return table_lines(DrawingSettings, self.name, value)
