"""The table of a coupon: the lines that are filled in, and what a filled one says."""

import csv
import io
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from mechwright.designs.files import read_text
from mechwright.errors import DesignError, did_you_mean
from mechwright.output.csv_text import csv_text
from mechwright_print.coupon.features import GAPS, ROWS, WORDS, trial_name

COLUMNS = ("feature", "nominal", "measured", "how")
"""Of the table; the third is filled in."""
TRIAL_HOW = f"the gauge pin: {', '.join(WORDS)}"
"""What is written into the line of a trial."""


@dataclass(frozen=True)
class Measured:
    """What was written: sizes by their rows, mm, and what the gauge pin did by its gap, mm."""

    sizes: Mapping[str, float]
    trials: Mapping[float, str] = field(default_factory=dict)


def empty_table() -> str:
    """The table to fill in."""
    rows = [(row.name, f"{row.nominal:g}", "", row.how) for row in ROWS]
    rows += [(trial_name(gap), f"{gap:.2f}", "", TRIAL_HOW) for gap in GAPS]
    return csv_text([COLUMNS, *rows])


def read_coupon(path: Path) -> Measured:
    """The sizes of a filled table, separated by commas or semicolons; the latter may have decimal commas.

    Raises OutputError where it cannot be read, and DesignError with a line for each row that is missing,
    unknown, twice there, empty, or no number.
    """
    text, _ = read_text(path)
    separator = ";" if text.partition("\n")[0].count(";") > text.partition("\n")[0].count(",") else ","
    rows = list(csv.reader(io.StringIO(text), delimiter=separator))
    head = [cell.strip().lower() for cell in rows[0]] if rows else []
    lacks = [name for name in ("feature", "measured") if name not in head]
    if lacks:
        raise DesignError(
            f"{path}: has no column {lacks[0]!r}; the table is that of mechwright print --coupon -o DIR"
        )
    name_at, value_at = head.index("feature"), head.index("measured")
    written: dict[str, str] = {}
    wrong: list[str] = []
    known = [*(row.name for row in ROWS), *(trial_name(gap) for gap in GAPS)]
    for number, cells in enumerate(rows[1:], start=2):
        if not any(cell.strip() for cell in cells):
            continue
        name = cells[name_at].strip() if len(cells) > name_at else ""
        value = cells[value_at].strip() if len(cells) > value_at else ""
        if name not in known:
            hint = did_you_mean(name, known) or "leave the names of the table as they are"
            wrong.append(f"{path}: line {number}: no feature is named {name!r}; {hint}")
        elif name in written:
            wrong.append(f"{path}: line {number}: {name} is there twice; leave one of them")
        else:
            written[name] = value
    sizes = {row.name: _number(row.name, written.get(row.name), separator, path, wrong) for row in ROWS}
    trials = {gap: _word(trial_name(gap), written.get(trial_name(gap), ""), path, wrong) for gap in GAPS}
    if wrong:
        raise DesignError("\n".join(wrong))
    return Measured(sizes, {gap: word for gap, word in trials.items() if word})


def _number(name: str, text: str | None, separator: str, path: Path, wrong: list[str]) -> float:
    if text is None:
        wrong.append(f"{path}: the row {name} is missing; add it, measured in mm")
        return 0.0
    if not text:
        wrong.append(f"{path}: {name} has no value; measure it, and write mm into the column measured")
        return 0.0
    try:
        return float(text.replace(",", ".") if separator == ";" else text)
    except ValueError:
        wrong.append(f"{path}: {name}: {text!r} is no number; write mm with a point, such as 5.02")
        return 0.0


def _word(name: str, text: str, path: Path, wrong: list[str]) -> str:
    word = text.lower()
    if word and word not in WORDS:
        wrong.append(f"{path}: {name}: {text!r} is none of {', '.join(WORDS)}")
        return ""
    return word
