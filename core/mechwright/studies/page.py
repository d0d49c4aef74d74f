"""The page of a study, one file: parallel coordinates, scatter and table of its designs, with brushes."""

import base64
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright.output.templates import templates
from mechwright.scripting.moving import SHOWING, for_script
from mechwright.studies.front import Chosen, Front
from mechwright.studies.shard import NUMBER, Counts, read_file
from mechwright.studies.study import Study

SHOWN = 100_000
"""Designs on the page besides the front, and of the front: some megabytes, and a brush still follows the
pointer."""


def page_of(
    study: Study,
    counts: Counts,
    front: Front,
    chosen: Iterable[Chosen],
    tables: Sequence[Path],
    pictures: Mapping[str, Any],
) -> str:
    """The page; of many designs every so-manieth is on it, and the whole front unless that is as many.

    ``pictures`` are those of :func:`mechwright.scripting.moving.moving`, by the names of the designs.
    """
    shown, every = _shown(study, counts, front, tables)
    best = np.isin(shown[NUMBER], front.columns[NUMBER]) if len(front) else np.zeros(len(shown[NUMBER]), bool)
    columns = [_column(name, unit, shown[name]) for name, unit in study.units.items()]
    data = {
        "columns": columns,
        "number": _packed(shown[NUMBER].astype(np.float64), "<f8"),
        "front": _packed(best, "u1"),
        "objectives": dict(study.objectives),
        "count": len(best),
    }
    picked = list(chosen)
    forbidden = sorted(counts.forbidden.items(), key=lambda one: -one[1])
    return (
        templates(Path(__file__).parent, SHOWING)
        .get_template("study.html")
        .render(study=study, counts=counts, front=len(front), chosen=picked, every=every,
                thinned=_step(len(front)), data=for_script(data), forbidden=forbidden, shown=len(best),
                pictures=list(pictures), moving=for_script(list(pictures.values())))
    )  # fmt: skip


def _shown(
    study: Study, counts: Counts, front: Front, tables: Sequence[Path]
) -> tuple[dict[str, NDArray[Any]], int]:
    """Columns of the designs on the page, in the order of their numbers, and of how many each is one."""
    rows = counts.designs if study.asked.keep == "all" else counts.feasible
    every = _step(rows)
    names = [NUMBER, *study.units]
    best = slice(None, None, _step(len(front)))
    parts = [{name: front.columns[name][best] for name in names}] if len(front) else []
    seen = 0
    for path in tables:
        table = read_file(study, path, names)
        size = table[NUMBER].size
        some = np.arange(-seen % every, size, every)
        seen += size
        parts.append({name: values[some] for name, values in table.items()})
    joined = {name: np.concatenate([part[name] for part in parts]) for name in names}
    _, once = np.unique(joined[NUMBER], return_index=True)
    return {name: values[once] for name, values in joined.items()}, every


def _step(count: int) -> int:
    """Of how many designs one is on the page."""
    return max(1, -(-count // SHOWN))


def _column(name: str, unit: str, values: NDArray[Any]) -> dict[str, Any]:
    if values.dtype.kind in "fiu":
        return {"name": name, "unit": unit, "values": _packed(values.astype(np.float64), "<f4")}
    choices, codes = np.unique(values.astype(str), return_inverse=True)
    return {"name": name, "unit": "", "choices": choices.tolist(), "values": _packed(codes, "<f4")}


def _packed(values: NDArray[Any], kind: str) -> str:
    return base64.b64encode(values.astype(kind).tobytes()).decode()
