"""The keys that a new file has: those that one sets first."""

from pydantic import Field

from mechwright import FIRST, Parameters
from mechwright.contracts.parameters import SHORT, first_fields
from mechwright.designs.text import table_lines
from mechwright.units import Millimetres


class Inner(Parameters):
    depth: Millimetres = Field(1.0, ge=0, le=9, description="Depth.", json_schema_extra=FIRST)
    width: Millimetres = Field(2.0, ge=0, le=9, description="Width.")


class Marked(Parameters):
    size: Millimetres = Field(3.0, gt=0, lt=9, description="Size.", json_schema_extra=FIRST)
    other: Millimetres = Field(3.0, ge=0, le=9, description="Other.")
    inner: Inner = Field(Inner(), description="A table.")
    rest: Millimetres = Field(3.0, gt=0, le=9, description="Rest.")


class Plain(Parameters):
    bore: Millimetres | None = Field(None, description="Left out.")
    inner: Inner | None = Field(None, description="A table.")


for number in range(12):
    Plain.model_fields[f"key{number}"] = Marked.model_fields["other"]


def test_marked_fields_and_the_tables_that_hold_such():
    assert first_fields(Marked) == ("size", "inner")
    assert table_lines(Marked, "m", first=True) == [
        "[m]",
        "size = 3.0  # Size. (mm, above 0, below 9)",
        "",
        "[m.inner]",
        "depth = 1.0  # Depth. (mm, 0 to 9)",
    ]
    assert len(table_lines(Marked, "m")) == 8


def test_without_a_mark_the_first_ten_that_have_a_value():
    assert first_fields(Plain) == tuple(f"key{number}" for number in range(SHORT))
