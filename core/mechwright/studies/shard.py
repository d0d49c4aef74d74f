"""The table of one batch as bytes of a Parquet file, with what was counted: the same for the same batch."""

import contextlib
import io
import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright.contracts.evaluation import Batch, Columns
from mechwright.errors import MechwrightError, OutputError
from mechwright.extras import optional
from mechwright.reading import read_bytes
from mechwright.studies.stamp import Stamp, require_sealed, sealed
from mechwright.studies.study import Study

NUMBER = "design"
"""Column of the number of a design in its study."""
FORBIDDEN = "forbidden"
"""Column of the code that forbids a design, where all are kept."""
CONSTRAINT = "constraint"
"""What comes before the column of a constraint in the code of one that is not kept."""
FRAME_BYTES = 1 << 20
"""Of a table: names, units and counts."""
WIDEST = 64
"""Bytes of a value, on average: numbers have 8, texts are codes and choices of a few words."""
_COUNTS = b"mechwright.counts"
_UNIT = b"unit"


@dataclass(frozen=True)
class Counts:
    """What became of some designs: how many there were, are kept, and are forbidden by which code."""

    designs: int
    feasible: int
    forbidden: Mapping[str, int]

    def plus(self, other: "Counts") -> "Counts":
        """Of both together."""
        codes = sorted({*self.forbidden, *other.forbidden})
        both = {code: self.forbidden.get(code, 0) + other.forbidden.get(code, 0) for code in codes}
        return Counts(self.designs + other.designs, self.feasible + other.feasible, both)


def shard_of(study: Study, batch: Batch[Any], first: int) -> bytes:
    """Evaluate a batch, and write the designs that are kept; ``first`` is the number of its first design."""
    return table_of(study, batch, first, study.family.evaluate(batch, study.measured, study.stage))


def table_of(study: Study, batch: Batch[Any], first: int, found: Columns) -> bytes:
    """The table of a batch that is evaluated."""
    values = {**{name: batch[name] for name in batch.varied}, **found.values}
    forbidden, codes = _constrained(study, found, values)
    feasible = forbidden == 0
    rows = np.arange(len(batch)) if study.asked.keep == "all" else np.flatnonzero(feasible)
    counts = np.bincount(forbidden, minlength=len(codes))
    told = {code: int(n) for code, n in sorted(zip(codes, counts, strict=True)) if code and n}
    table = {NUMBER: np.arange(first, first + len(batch))[rows]}
    table |= {name: values[name][rows] for name in study.units}
    if study.asked.keep == "all":
        table[FORBIDDEN] = np.array(codes, dtype=object)[forbidden[rows]]
    counted = Counts(len(batch), int(feasible.sum()), told)
    return _counted(table, study.units, counted, Stamp.of(study, first, len(batch)))


def _constrained(
    study: Study, found: Columns, values: Mapping[str, NDArray[Any]]
) -> tuple[NDArray[np.int32], list[str]]:
    """What forbids each design, with the constraints of the study after the codes of the family."""
    codes, forbidden = list(found.codes), found.forbidden.copy()
    for bound in study.bounds:
        codes.append(f"{CONSTRAINT}.{bound.column}")
        column = values[bound.column]
        with np.errstate(invalid="ignore"):
            kept = (column >= bound.low) & (column <= bound.high)  # no number keeps none
        forbidden[(forbidden == 0) & ~kept] = len(codes) - 1
    return forbidden, codes


def _counted(
    table: Mapping[str, NDArray[Any]], units: Mapping[str, str], counts: Counts, stamp: Stamp
) -> bytes:
    said = {"designs": counts.designs, "feasible": counts.feasible, "forbidden": dict(counts.forbidden)}
    return sealed(written(table, units, {_COUNTS: json.dumps(said, sort_keys=True), **stamp.metadata}))


def written(
    table: Mapping[str, NDArray[Any]], units: Mapping[str, str], said: Mapping[bytes, str] | None = None
) -> bytes:
    """A table as bytes of a Parquet file; columns say their units, the file what is ``said`` besides."""
    arrow, parquet = optional("pyarrow"), optional("pyarrow.parquet")
    arrays = {name: arrow.array(values) for name, values in table.items()}
    fields = [
        arrow.field(name, array.type, metadata={_UNIT: units.get(name, "")}) for name, array in arrays.items()
    ]
    schema = arrow.schema(fields, metadata=dict(said or {}))
    buffer = io.BytesIO()
    parquet.write_table(
        arrow.Table.from_arrays(list(arrays.values()), schema=schema), buffer, compression="zstd"
    )
    return buffer.getvalue()


def counts_of(study: Study, path: Path, stamp: Stamp) -> Counts:
    """What was counted for the file of a batch; raises OutputError where it is not the one with this stamp.

    No more is unpacked than its frame, which tells how much the rest is.
    """
    with telling(path):
        frame = frame_of(study, path, stamp)
        require(_COUNTS in (frame.metadata or {}), "it has no counts")
        said = json.loads(frame.metadata[_COUNTS])
        counts = Counts(said["designs"], said["feasible"], dict(said["forbidden"]))
        numbers = (counts.designs, counts.feasible, *counts.forbidden.values())
        require(all(type(one) is int and one >= 0 for one in numbers), "its counts are no whole numbers")
        require(counts.feasible <= counts.designs == stamp.designs, "its counts are those of no batch")
        every = study.asked.keep == "all"
        rows = counts.designs if every else counts.feasible
        require(frame.num_rows == rows, f"it has {frame.num_rows:,} designs, and counts {rows:,}")
        schema = frame.schema.to_arrow_schema()
        expected = [NUMBER, *study.units, *([FORBIDDEN] if every else ())]
        require(schema.names == expected, "it has other columns")
        for name in (NUMBER, *study.objectives):
            kind = np.dtype(schema.field(name).type.to_pandas_dtype()).kind
            require(kind in "biuf", f"its column {name} holds no numbers")
        return counts


def frame_of(study: Study, path: Path, stamp: Stamp) -> Any:
    """Metadata of a file; raises ValueError where it is too large for a batch, or has another stamp."""
    frame = optional("pyarrow.parquet").read_metadata(io.BytesIO(_content(study, path)))
    size = sum(frame.row_group(number).total_byte_size for number in range(frame.num_row_groups))
    require(0 <= size <= _most_bytes(study), "it is too large when it is unpacked")
    stamp.require_in(frame.metadata or {})
    return frame


def read_file(study: Study, path: Path, columns: Sequence[str] | None = None) -> dict[str, NDArray[Any]]:
    """Columns by name of the file of a batch; raises OutputError where it cannot be read."""
    with telling(path):
        return read(_content(study, path), columns)


def _content(study: Study, path: Path) -> bytes:
    content = read_bytes(path, _most_bytes(study), anew=True)
    require_sealed(content)
    return content


def _most_bytes(study: Study) -> int:
    """Of the table of a batch."""
    return FRAME_BYTES + WIDEST * study.batch * (len(study.units) + 4)


def require(kept: bool, what: str) -> None:
    """Raise ValueError with ``what`` is wrong unless it is kept."""
    if not kept:
        raise ValueError(what)


@contextlib.contextmanager
def telling(path: Path) -> Iterator[None]:
    """Errors of what reads Parquet as one line that names the file."""
    try:
        yield
    except MechwrightError:
        raise
    except (OSError, ValueError, LookupError, TypeError, RecursionError, NotImplementedError) as error:
        said = str(error).partition("\n")[0].rstrip(".")
        raise OutputError(
            f"{path}: is no table of this sweep: {said}; move it away, and the same command makes it again"
        ) from error


def read(content: bytes, columns: Sequence[str] | None = None) -> dict[str, NDArray[Any]]:
    """Columns by name of a table that was written as bytes."""
    table = optional("pyarrow.parquet").read_table(io.BytesIO(content), columns=columns)
    found = {name: table.column(name).to_numpy() for name in table.column_names}
    return {name: values.astype(str) if values.dtype == object else values for name, values in found.items()}
