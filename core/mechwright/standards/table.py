"""Reading the tables of standard sizes."""

import tomllib
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, TypeVar

T = TypeVar("T")

_FOLDER = Path(__file__).with_name("tables")


@dataclass(frozen=True)
class Table:
    """A table as its file has it: the standard's number, the source of the numbers, and its rows."""

    name: str
    standard: str
    source: str
    rows: tuple[dict[str, Any], ...]

    def of(self, kind: type[T]) -> tuple[T, ...]:
        """The rows as instances of a class whose fields have the names of the columns."""
        return tuple(kind(**row) for row in self.rows)


@cache
def table(name: str) -> Table:
    """The table of that name; a row of another length than the columns is a fault of the file: ValueError."""
    found = tomllib.loads((_FOLDER / f"{name}.toml").read_text(encoding="utf-8"))
    columns = found["columns"].split()
    rows = tuple(
        {key: tuple(v) if isinstance(v, list) else v for key, v in zip(columns, row, strict=True)}
        for row in found["rows"]
    )
    return Table(name, found["standard"], found["source"], rows)


def names() -> list[str]:
    """Of all tables."""
    return sorted(path.stem for path in _FOLDER.glob("*.toml"))
