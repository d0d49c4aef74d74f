"""Measured values of the parts of a design: the table to fill in, and what a filled one says."""

import csv
import io
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from mechwright.contracts.inspected import Dimension, inspected
from mechwright.contracts.part import Part
from mechwright.designs.files import read_text
from mechwright.errors import MOST_LINES, DesignError, did_you_mean
from mechwright.output.csv_text import csv_text

COLUMNS = ("part", "copy", "feature", "measured", "nominal", "least", "greatest", "what")
"""Of the table; the fourth is filled in."""
INCH = 25.4
"""mm."""
GROSS = 0.2
"""Nobody measures a part that is off by so much of its size."""


@dataclass(frozen=True)
class Reading:
    """A value, mm, that was measured of a dimension of a copy of a part."""

    part: Part
    copy: str
    dimension: Dimension
    value: float

    @property
    def off(self) -> float:
        """By how much it is more than the middle of its limits, mm."""
        return self.value - self.dimension.target

    @property
    def is_within(self) -> bool:
        """Whether it is within its limits."""
        return self.dimension.is_within(self.value)


def empty_table(parts: Sequence[Part]) -> str:
    """The table of all dimensions of the parts that are made, a line for each copy."""
    rows = []
    for part in parts:
        for copy in range(1, max(1, len(part.instances)) + 1):
            for one in inspected(part):
                limits = (
                    "" if size is None else f"{size:.4f}" for size in (one.nominal, one.least, one.greatest)
                )
                rows.append((part.name, copy, one.name, "", *limits, one.what))
    return csv_text([COLUMNS, *rows])


def read_readings(path: Path, parts: Sequence[Part]) -> list[Reading]:
    """The values of a table; lines without one are skipped.

    Raises OutputError where it cannot be read, and DesignError with a line for each value that is wrong: of
    no part or feature of the design, there twice, no number, in inches, or far off its size.
    """
    text, _ = read_text(path)
    first = text.partition("\n")[0]
    separator = ";" if first.count(";") > first.count(",") else ","
    rows = list(csv.reader(io.StringIO(text), delimiter=separator))
    head = [cell.strip().lower() for cell in rows[0]] if rows else []
    for name in ("part", "feature", "measured"):
        if name not in head:
            raise DesignError(
                f"{path}: has no column {name!r}; the table is that of mechwright measure DESIGN -o FILE"
            )
    known = {part.name: {one.name: one for one in inspected(part)} for part in parts}
    by_name = {part.name: part for part in parts}
    found: dict[tuple[str, str, str], Reading] = {}
    wrong: list[str] = []
    for number, cells in enumerate(rows[1:], start=2):
        row = {key: cell.strip() for key, cell in zip(head, cells, strict=False)}
        if not row.get("measured"):
            continue
        key = (row.get("part", ""), row.get("copy", "") or "1", row.get("feature", ""))
        where = f"{path}: line {number}"
        try:
            if key in found:
                raise DesignError(f"{key[2]} of copy {key[1]} of {key[0]} is there twice; leave one of them")
            dimension = _dimension(key, known)
            value = _value(row["measured"], dimension, separator)
            found[key] = Reading(by_name[key[0]], key[1], dimension, value)
        except DesignError as error:
            wrong.append(f"{where}: {error}")
    if not found and not wrong:
        wrong.append(f"{path}: has no value; write mm into the column measured")
    if wrong:
        raise DesignError("\n".join(wrong[:MOST_LINES]))
    return list(found.values())


def _dimension(key: tuple[str, str, str], known: dict[str, dict[str, Dimension]]) -> Dimension:
    part, _, feature = key
    if part not in known:
        raise DesignError(f"no part is named {part!r}; {did_you_mean(part, known) or _listed(known)}")
    if feature not in known[part]:
        hint = did_you_mean(feature, known[part]) or _listed(known[part])
        raise DesignError(f"part {part} has no dimension {feature!r}; {hint}")
    return known[part][feature]


def _listed(names: Iterable[str]) -> str:
    return f"there is: {', '.join(names) or 'none'}"


def _value(text: str, dimension: Dimension, separator: str) -> float:
    try:
        value = float(text.replace(",", ".") if separator == ";" else text)
    except ValueError:
        raise DesignError(f"{text!r} is no number; write mm with a point, such as 5.02") from None
    if abs(value - dimension.nominal) <= GROSS * dimension.nominal:
        return value
    if abs(value * INCH - dimension.nominal) <= GROSS * dimension.nominal:
        raise DesignError(f"{value:g} is {value * INCH:.3f} mm: it was measured in inches; write mm")
    raise DesignError(
        f"{dimension.name}: {value:g} mm is far off {dimension.nominal:g} mm; the line is another one's, or "
        "measure it again"
    )
