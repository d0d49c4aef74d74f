"""A sweep: the tables of a study, its front, and the designs of it that build."""

import json
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

from mechwright.contracts.finding import errors
from mechwright.contracts.part import check_name
from mechwright.contracts.synthesis import Progress, unheard
from mechwright.designs.change import changed
from mechwright.extras import require
from mechwright.output.folder import Output
from mechwright.plugins.host import Host
from mechwright.scripting.mechanism import Mechanism
from mechwright.scripting.moving import moving
from mechwright.scripting.pareto import spread
from mechwright.sweep.folder import SUFFIX, SweepFolder
from mechwright.sweep.front import AROUND, MOST, Chosen, Front, around
from mechwright.sweep.page import page_of
from mechwright.sweep.shard import NUMBER, Counts, read_file, written
from mechwright.sweep.study import Study, design_of
from mechwright.sweep.task import Source, Task
from mechwright.sweep.workers import Workers

EVALUATED = 0.9
"""Share of a sweep's work that is the tables; the rest are the designs of the front."""

TRIES = 4
"""Times as many designs of the front as are asked for that are checked until there are enough that build."""


@dataclass(frozen=True)
class Swept:
    """What a sweep has found.

    Parameters
    ----------
    counts
        What became of all designs.
    front
        How many designs no other dominates.
    chosen
        Those of them that were checked, the best of each objective first.
    files
        What was written beside the tables.
    """

    counts: Counts
    front: int
    chosen: tuple[Chosen, ...]
    files: tuple[str, ...]


def sweep(study: Study, folder: Path, workers: Workers, host: Host, progress: Progress = unheard) -> Swept:
    """Evaluate the designs of a study, and write what was found.

    A folder in which the same study was stopped is gone on with: the result is the same.

    Raises
    ------
    OutputError
        The folder holds something else, or cannot be written; tables that are finished stay.
    PluginError
        pyarrow is not installed, or workers fail.
    """
    require("pyarrow")
    place = SweepFolder(folder, study, host)
    total = study.batches * study.batch + study.asked.refine * study.batch
    tasks = [Task(f"part-{number:06d}", number * study.batch, number) for number in range(study.batches)]
    _evaluated(place, study, tasks, workers, progress, 0, total)
    front, counts = Front(study), Counts(0, 0, {})
    for task in tasks:
        counts = counts.plus(place.counts(task.name))
        if study.objectives:
            front.take(_allowed(study, place.table(task.name)))
    first = study.count
    for number in range(study.asked.refine):
        extra = _around(study, front, number, first)
        _evaluated(place, study, extra, workers, progress, study.count + number * study.batch, total)
        for task in extra:
            counts = counts.plus(place.counts(task.name))
            front.take(_allowed(study, place.table(task.name)))
            first += len(next(iter(task.given.values())))
        tasks += extra
    chosen = _chosen(study, front, host, progress)
    return _written(place, study, counts, front, chosen, [place.table(task.name) for task in tasks])


def _evaluated(
    place: SweepFolder,
    study: Study,
    tasks: Sequence[Task],
    workers: Workers,
    progress: Progress,
    before: int,
    total: int,
) -> None:
    missing = [task for task in tasks if not place.has(task.name)]
    done = before + (len(tasks) - len(missing)) * study.batch
    for task, content in workers.done(Source.of(study), missing) if missing else ():
        place.store(task.name, content)
        done += study.batch
        progress(EVALUATED * min(done / total, 1.0), f"{min(done, total):,} of {total:,} designs")


def _allowed(study: Study, path: Path) -> dict[str, NDArray[Any]]:
    """The designs of a table that nothing forbids."""
    table = read_file(study, path)
    allowed = table.pop("forbidden", None)
    if allowed is None:
        return table
    return {name: values[allowed == ""] for name, values in table.items()}


def _around(study: Study, front: Front, number: int, first: int) -> list[Task]:
    places = spread(front.costs, min(MOST, max(1, study.count // AROUND)))
    if not places:
        return []
    values = around(front, number, sorted(places))
    size = len(next(iter(values.values())))  # none, where all is known
    return [
        Task(
            f"refine-{number:02d}-{start // study.batch:04d}",
            first + start,
            None,
            {name: column[start : start + study.batch] for name, column in values.items()},
        )
        for start in range(0, size, study.batch)
    ]


def _chosen(study: Study, front: Front, host: Host, progress: Progress) -> list[Chosen]:
    """Designs of the front that build up to their programs, and those that were tried for them."""
    wanted = study.asked.front
    found: list[Chosen] = []
    built = 0
    for place in spread(front.costs, TRIES * wanted) if len(front) else []:
        if built == wanted:
            break
        progress(EVALUATED + (1 - EVALUATED) * built / wanted, f"checking design {built + 1} of the front")
        name = check_name(f"{study.name}-{built + 1:0{len(str(wanted))}}", "name of a design")
        figures = {column: front.columns[column][place].item() for column in study.units}
        number = int(front.columns[NUMBER][place])
        said = errors(_mechanism(study, front, place, name, host).check())
        if said:
            found.append(Chosen(number, "", figures, f"[{said[0].code}] {said[0].message}"))
        else:
            built += 1
            found.append(Chosen(number, name, figures))
    return found


def _mechanism(study: Study, front: Front, place: int, name: str, host: Host) -> Mechanism:
    change = {f"parameters.{key}": value for key, value in front.design(place).items()}
    content = changed({"parameters": dict(study.content)}, change)["parameters"]
    return Mechanism(design_of(study, name, study.family.Params.model_validate(content), host), host)


def _written(
    place: SweepFolder,
    study: Study,
    counts: Counts,
    front: Front,
    chosen: Iterable[Chosen],
    tables: Sequence[Path],
) -> Swept:
    picked = tuple(chosen)
    output, pictures = Output(), dict[str, Any]()
    for one in picked:
        if one.name:
            number = front.columns[NUMBER].tolist().index(one.design)
            mechanism = _mechanism(study, front, number, one.name, place.host)
            output.add(f"{one.name}.toml", mechanism.toml)
            pictures[one.name] = moving(mechanism)
    if len(front):
        output.add(f"front{SUFFIX}", written(front.columns, study.units))
    summary = {
        "study": study.name,
        "family": study.family.name,
        "units": dict(study.units),
        "counts": asdict(counts),
        "front": len(front),
        "designs": [asdict(one) for one in picked],
    }
    output.add("summary.json", json.dumps(summary, indent=2) + "\n")
    output.add(
        "study.html", page_of(study, counts, front, picked, tables, {k: v for k, v in pictures.items() if v})
    )
    files = tuple(sorted(output.files))
    place.write(output)
    return Swept(counts, len(front), picked, files)
