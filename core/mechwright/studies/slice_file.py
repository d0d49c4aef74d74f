"""Slices of a batch that are finished, as files: they are kept until the batch's table is there."""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright.contracts.by_arrays import Answer
from mechwright.contracts.slices import Answered, Question, Singles, Work
from mechwright.studies.shard import frame_of, read_file, require, telling, written
from mechwright.studies.stamp import Stamp, sealed
from mechwright.studies.study import Study

UNIT, PLACE, CODE, UNDECIDED = "slice.unit", "slice.place", "slice.code", "slice.undecided"
"""Columns: to which chunk or question a row belongs, which design of the batch it is, what forbids it, and
whether it has to be asked singly."""

_UNITS, _DESIGNS = b"mechwright.slice", b"mechwright.designs"


def slice_of(study: Study, work: Work, stamp: Stamp) -> bytes:
    """The file of some work on a batch."""
    units: list[dict[str, Any]] = []
    rows: list[tuple[NDArray[Any], NDArray[Any], NDArray[Any], dict[str, NDArray[Any]]]] = []
    for chunk, (places, answer) in work.answers.items():
        given = [name for name in study.measured if name in answer.values]
        units.append({"chunk": chunk, "given": given})
        codes = np.array(answer.codes, dtype=object)[answer.forbidden]
        rows.append((places, codes, answer.undecided, {name: answer.values[name] for name in given}))
    for question, found in work.singles.items():
        units.append({"judged": question.judged, "columns": question.columns})
        rows.append((found.places, found.codes, np.zeros(found.places.size, bool), dict(found.values)))
    sizes = [row[0].size for row in rows]
    table: dict[str, NDArray[Any]] = {
        UNIT: np.repeat(np.arange(len(units)), sizes),
        PLACE: np.concatenate([row[0] for row in rows]).astype(np.int64),
        CODE: np.concatenate([row[1] for row in rows]).astype(object),
        UNDECIDED: np.concatenate([row[2] for row in rows]).astype(bool),
    }
    for name in study.measured:
        parts = [row[3].get(name, np.full(row[0].size, np.nan)) for row in rows]
        table[name] = np.concatenate(parts).astype(np.float64)
    said = {_UNITS: json.dumps(units), _DESIGNS: str(designs_in(study, work)), **stamp.metadata}
    return sealed(written(table, study.units, said))


def designs_in(study: Study, work: Work) -> int:
    """How many designs some work has finished: they are never evaluated again."""
    count = sum(found.places.size for found in work.singles.values())
    for _, answer in work.answers.values():
        whole = all(name in answer.values for name in study.measured)
        count += int((answer.forbidden != 0).sum()) + (int(answer.open.sum()) if whole else 0)
    return count


def saved_in(study: Study, path: Path, stamp: Stamp) -> int:
    """How many designs a file has finished; raises OutputError where it is not the slice with this stamp."""
    with telling(path):
        count = int(frame_of(study, path, stamp).metadata[_DESIGNS])
        require(0 <= count <= stamp.designs, "its designs are those of no batch")
        return count


def work_of(study: Study, path: Path, stamp: Stamp) -> Work:
    """The work in a file; raises OutputError where it is not the slice with this stamp."""
    with telling(path):
        frame = frame_of(study, path, stamp)
        units = json.loads(frame.metadata[_UNITS])
        columns = [UNIT, PLACE, CODE, UNDECIDED, *study.measured]
        require(frame.schema.to_arrow_schema().names == columns, "it has other columns")
        table = read_file(study, path)
        kinds = "".join(table[name].dtype.kind for name in columns if name != CODE)
        require(kinds == "iib" + "f" * len(study.measured) or not table[UNIT].size, "its columns hold others")
        place, unit = table[PLACE], table[UNIT]
        require(bool(((place >= 0) & (place < stamp.designs)).all()), "its designs are those of no batch")
        work = Work()
        for number, said in enumerate(units):
            _take(study, work, said, {name: values[unit == number] for name, values in table.items()})
        return work


def _take(study: Study, work: Work, said: dict[str, Any], rows: dict[str, NDArray[Any]]) -> None:
    places = rows[PLACE].astype(np.intp)
    if "chunk" in said:
        work.answers[int(said["chunk"])] = Answered(places, _answer(study, said["given"], rows))
        return
    asked = Question(bool(said["judged"]), _known(study, said["columns"]))
    work.add(asked, Singles(places, rows[CODE].astype(object), {name: rows[name] for name in asked.columns}))


def _answer(study: Study, given: Sequence[str], rows: dict[str, NDArray[Any]]) -> Answer:
    codes, which = np.unique(np.append(rows[CODE].astype(object), ""), return_inverse=True)
    answer = Answer(rows[PLACE].size)
    answer.codes = codes.tolist()  # the empty one is the first
    answer.forbidden = which[:-1].astype(np.int32)
    answer.undecided = rows[UNDECIDED].astype(bool)
    answer.values = {name: rows[name] for name in _known(study, given)}
    return answer


def _known(study: Study, columns: Sequence[str]) -> tuple[str, ...]:
    require(set(columns) <= set(study.measured), "it has other columns")
    return tuple(columns)
