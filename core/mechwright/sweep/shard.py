"""The table of one batch as bytes of a Parquet file, with what was counted: the same for the same batch."""

import io
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright.contracts.evaluation import Batch, Columns
from mechwright.errors import OutputError
from mechwright.extras import optional
from mechwright.sweep.study import Study

NUMBER = "design"
"""Column of the number of a design in its study."""
FORBIDDEN = "forbidden"
"""Column of the code that forbids a design, where all are kept."""
CONSTRAINT = "constraint"
"""What comes before the column of a constraint in the code of one that is not kept."""
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
    found = study.family.evaluate(batch, study.measured, study.stage)
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
    return _counted(table, study.units, Counts(len(batch), int(feasible.sum()), told))


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


def _counted(table: Mapping[str, NDArray[Any]], units: Mapping[str, str], counts: Counts) -> bytes:
    said = {"designs": counts.designs, "feasible": counts.feasible, "forbidden": dict(counts.forbidden)}
    return written(table, units, {_COUNTS: json.dumps(said, sort_keys=True)})


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


def counts_of(path: Path) -> Counts:
    """What was counted for the file of a batch; raises OutputError where it is no such file."""
    try:
        said = json.loads(optional("pyarrow.parquet").read_schema(path).metadata[_COUNTS])
        return Counts(said["designs"], said["feasible"], said["forbidden"])
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise OutputError(f"{path}: is no table of a sweep: {error}; move it away and start again") from error


def read(content: bytes | Path, columns: Sequence[str] | None = None) -> dict[str, NDArray[Any]]:
    """Columns of a shard by name."""
    source = io.BytesIO(content) if isinstance(content, bytes) else content
    table = optional("pyarrow.parquet").read_table(source, columns=columns)
    found = {name: table.column(name).to_numpy() for name in table.column_names}
    return {name: values.astype(str) if values.dtype == object else values for name, values in found.items()}
