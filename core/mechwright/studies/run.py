"""A sweep: the tables of a study, its front, and the designs of it that build."""

import json
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

from mechwright.contracts.synthesis import Progress, unheard
from mechwright.extras import require
from mechwright.output.folder import Output
from mechwright.plugins.host import Host
from mechwright.scripting.moving import moving
from mechwright.scripting.pareto import spread
from mechwright.studies.checks import checked, mechanism_of
from mechwright.studies.folder import SUFFIX, SweepFolder
from mechwright.studies.front import AROUND, MOST, Chosen, Front, around
from mechwright.studies.page import page_of
from mechwright.studies.schedule import Schedule, without_tables
from mechwright.studies.shard import NUMBER, Counts, read_file, written
from mechwright.studies.standing import Standing
from mechwright.studies.study import Study
from mechwright.studies.task import Source, Task
from mechwright.studies.task_queue import Workers

EVALUATED = 0.9
"""Share of a sweep's work that is the tables; the rest are the designs of the front."""


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

    def __str__(self) -> str:
        counts = self.counts
        return f"{counts.designs:,} designs, {counts.feasible:,} allowed, {self.front:,} on the front"


FRONT = f"front{SUFFIX}"
"""The file of the designs that no other one dominates."""


def evaluate(
    study: Study,
    folder: Path,
    workers: Workers,
    host: Host,
    progress: Progress = unheard,
    standing: Standing | None = None,
) -> Swept:
    """Evaluate the designs of a study, and write what was found.

    A folder in which the same study was stopped is gone on with: the result is the same. ``standing`` says at
    any time, and when an error has come, what of it is saved.

    Raises
    ------
    OutputError
        The folder holds something else, or cannot be written.
    PluginError
        pyarrow is not installed, or workers fail.
    """
    require("pyarrow")
    standing = standing or Standing(study)
    tasks = [Task(f"part-{number:06d}", number * study.batch, number) for number in range(study.batches)]
    standing.tasks += tasks
    standing.place = place = SweepFolder(folder, study, host)
    bar = _Bar(study, progress)
    _evaluated(place, standing, tasks, workers, bar)
    front, counts = Front(study), Counts(0, 0, {})
    counts = _taken(place, study, tasks, front, counts, bar)
    first = study.count
    for number in range(study.asked.refine):
        extra = _around(study, front, number, first)
        standing.tasks += extra
        what = f"round {number + 1} of {study.asked.refine} around the front: "
        bar.begin(what, sum(task.size(study) for task in extra))
        _evaluated(place, standing, extra, workers, bar)
        counts = _taken(place, study, extra, front, counts, bar)
        first += sum(task.size(study) for task in extra)
        tasks += extra
    standing.begun = True
    chosen = checked(
        place, front, workers.local, lambda part, what: progress(EVALUATED + (1 - EVALUATED) * part, what)
    )
    found = _written(place, study, counts, front, chosen, [place.table(task.name) for task in tasks])
    place.drop(place.checks())
    return found


class _Bar:
    """How far the evaluation is, in its rounds."""

    def __init__(self, study: Study, progress: Progress) -> None:
        self._progress = progress
        self._whole = study.count + study.asked.refine * min(study.count, MOST * AROUND)
        self._before = 0
        self.begin("", study.count)

    def begin(self, what: str, size: int) -> None:
        """Begin with the designs that are drawn, or with a round of search."""
        self._before += getattr(self, "_size", 0)
        self._what, self._size = what, size

    def say(self, saved: int) -> None:
        """Say how many designs of it are saved."""
        part = min((self._before + saved) / self._whole, 1.0)
        self._progress(EVALUATED * part, f"{self._what}{saved:,} of {self._size:,} designs saved")

    def read(self, number: int, tables: int) -> None:
        """Say how many tables have been read for the front."""
        part = min((self._before + self._size) / self._whole, 1.0)
        self._progress(EVALUATED * part, f"{self._what}front of {number:,} of {tables:,} tables")


def _evaluated(
    place: SweepFolder, standing: Standing, tasks: Sequence[Task], workers: Workers, bar: "_Bar"
) -> None:
    study = place.study
    missing = without_tables(place, tasks)
    before = sum(task.size(study) for task in tasks) - sum(task.size(study) for task in missing)
    schedule = Schedule(place, standing, missing, workers.count)
    bar.say(before + schedule.saved)
    for task, found in workers.done(Source.of(study), schedule) if missing else ():
        schedule.put(task, found)
        bar.say(before + schedule.finished + schedule.saved)


def _taken(
    place: SweepFolder, study: Study, tasks: Sequence[Task], front: Front, counts: Counts, bar: _Bar
) -> Counts:
    """The counts with those of some tables, whose designs the front has taken."""
    for number, task in enumerate(tasks):
        bar.read(number, len(tasks))
        counts = counts.plus(place.counts(task))
        if study.objectives:
            front.take(_allowed(study, place.table(task.name)))
    return counts


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
            mechanism = mechanism_of(study, front.design(number), one.name, place.host)
            output.add(f"{one.name}.toml", mechanism.toml)
            pictures[one.name] = moving(mechanism)
    if len(front):
        output.add(FRONT, written(front.columns, study.units))
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
