"""The folder of a sweep: each file in one step, so that a sweep that was stopped goes on where it stood.

Besides the tables there are *slices* of batches that are not finished, and *checks* of designs of the front.
Both are gone when the sweep is done.
"""

import contextlib
import json
import os
import re
from collections.abc import Iterable
from pathlib import Path

from mechwright.contracts.slices import Work
from mechwright.errors import OutputError
from mechwright.output.folder import Output, write_folder
from mechwright.output.staging import move
from mechwright.plugins.host import Host
from mechwright.reading import read_bytes, regular
from mechwright.scripting.provenance import run_facts
from mechwright.studies.fingerprint import fingerprint_of
from mechwright.studies.shard import Counts, counts_of
from mechwright.studies.slice_file import saved_in, slice_of, work_of
from mechwright.studies.stamp import Stamp
from mechwright.studies.study import Study
from mechwright.studies.task import Task

COMMAND = "sweep"
BEGUN = "study.json"
BEGUN_LIMIT = 10_000
"""Bytes of that file, which holds three short texts."""
SHARDS = "tables"
SLICES = "slices"
CHECKS = "checks"
SUFFIX = ".parquet"
UNREAD = 1000
"""Tables that are read to tell whether they are whole when a sweep is stopped before it has read them."""
_PART = ".part"
_NUMBERED = re.compile(r"(.+)-(\d{6,})")
"""Name of a slice: the task's, and its number."""


class SweepFolder:
    """Where the tables of a study go.

    Parameters
    ----------
    path
        The folder: new, empty, or that of the same study.

    Raises
    ------
    OutputError
        It holds something else, or cannot be written.
    """

    def __init__(self, path: Path, study: Study, host: Host) -> None:
        self.path, self.study, self.host = path, study, host
        self._whole: set[str] = set()
        own = {"study": study.digest, "program": fingerprint_of(study.family), "batch": study.batch}
        found = self._begun()
        if found is None:
            self.write(Output({BEGUN: _said(own)}))
        elif found != own:
            differs = " and another ".join(key for key in own if found.get(key) != own[key])
            raise OutputError(
                f"{path}: holds a sweep that was begun with another {differs}; give a new folder with -o, or "
                "go on with the study and the program that began it"
            )
        try:
            (path / SHARDS).mkdir(exist_ok=True)
            for name in (SHARDS, SLICES, CHECKS):
                for part in (path / name).glob(f"*{_PART}"):
                    part.unlink()
        except OSError as error:
            raise OutputError(f"{path / SHARDS}: cannot be written: {error.strerror or error}") from error

    def _begun(self) -> dict[str, object] | None:
        """What is said of the study that was begun here; None where none was."""
        path = self.path / BEGUN
        if not os.path.lexists(path):
            return None
        try:
            found = json.loads(read_bytes(path, BEGUN_LIMIT, anew=True))
        except (OutputError, ValueError, RecursionError):
            found = None
        if not isinstance(found, dict):
            raise OutputError(f"{path}: does not say which study was begun here; give a new folder with -o")
        return found

    def table(self, name: str) -> Path:
        """The file of a task."""
        return self.path / SHARDS / f"{name}{SUFFIX}"

    def has(self, task: Task) -> bool:
        """Whether a task is done; raises as :meth:`counts` does where its file is no table of the study."""
        if not regular(self.table(task.name)):
            return False
        self.counts(task)
        self._whole.add(task.name)
        return True

    def whole(self, tasks: Iterable[Task]) -> set[str]:
        """The names of tasks that are done; many tables that were not read in this run are not read."""
        there = [task for task in tasks if regular(self.table(task.name))]
        known = {task.name for task in there if task.name in self._whole}
        unread = [task for task in there if task.name not in known]
        return known | {task.name for task in unread if len(unread) > UNREAD or self._is_whole(task)}

    def _is_whole(self, task: Task) -> bool:
        try:
            return self.has(task)
        except OutputError:
            return False

    def counts(self, task: Task) -> Counts:
        """What was counted in a task that is done."""
        return counts_of(self.study, self.table(task.name), self.stamp(task))

    def stamp(self, task: Task, path: Path | None = None) -> Stamp:
        """The stamp of the table of a task, or of a slice of it by the number in the name of its file."""
        number = None if path is None else int(path.stem.rpartition("-")[2])
        return Stamp.of(self.study, task.first, task.size(self.study), number)

    def saved_in(self, task: Task, path: Path) -> int:
        """How many designs a slice has finished; raises OutputError where the file is not that slice."""
        return saved_in(self.study, path, self.stamp(task, path))

    def work_in(self, task: Task, path: Path) -> Work:
        """The work in the file of a slice; raises OutputError where it is not that slice."""
        return work_of(self.study, path, self.stamp(task, path))

    def store(self, name: str, content: bytes) -> None:
        """Write the table of a task, in whose place its slices go."""
        self._whole.add(name)
        self._put(self.table(name), content)
        self.drop(self.slices(name))

    def slices(self, name: str) -> list[Path]:
        """The files of slices of a task."""
        return self.all_slices().get(name, [])

    def all_slices(self) -> dict[str, list[Path]]:
        """The files of slices by the names of their tasks, in the order of their numbers."""
        found: dict[str, list[Path]] = {}
        for path in sorted((self.path / SLICES).glob(f"*{SUFFIX}")):
            if match := _NUMBERED.fullmatch(path.stem):
                found.setdefault(match[1], []).append(path)
        return found

    def store_slice(self, task: Task, number: int, work: Work) -> Path:
        """Write a slice of a task."""
        path = self.path / SLICES / f"{task.name}-{number:06d}{SUFFIX}"
        self._put(path, slice_of(self.study, work, self.stamp(task, path)))
        return path

    def next_number(self, name: str) -> int:
        """The number of the next slice of a task."""
        taken = [int(match[2]) for path in self.slices(name) if (match := _NUMBERED.fullmatch(path.stem))]
        return max(taken, default=-1) + 1

    def checks(self) -> list[Path]:
        """The files of designs of the front that were checked."""
        return sorted((self.path / CHECKS).glob("*.json"))

    def store_check(self, name: str, content: bytes) -> None:
        """Write what the check of a design found."""
        self._put(self.path / CHECKS / f"{name}.json", content)

    def drop(self, paths: Iterable[Path]) -> None:
        """Remove slices or checks that nobody needs any more, and their folder with the last one."""
        try:
            for path in paths:
                path.unlink(missing_ok=True)
            for name in (SLICES, CHECKS):
                with contextlib.suppress(OSError):  # others are left, or it is not there
                    (self.path / name).rmdir()
        except OSError as error:
            raise OutputError(f"{path}: cannot be removed: {error.strerror or error}") from error

    def _put(self, path: Path, content: bytes) -> None:
        """Write a file: it is there as a whole, or not at all."""
        part = path.with_suffix(_PART)
        try:
            path.parent.mkdir(exist_ok=True)
            with part.open("wb") as file:
                file.write(content)
                file.flush()
                os.fsync(file.fileno())
            move(part, path)
        except OSError as error:
            with contextlib.suppress(OSError):
                part.unlink(missing_ok=True)
            raise OutputError(f"{path}: cannot be written: {error.strerror or error}") from error

    def write(self, output: Output) -> None:
        """Write the files beside the tables, in one step."""
        facts = run_facts(
            self.study.name, self.study.family, {self.study.path.name: self.study.digest}, self.host
        )
        if BEGUN not in output.files:
            output.add(BEGUN, read_bytes(self.path / BEGUN, BEGUN_LIMIT, anew=True))
        write_folder(self.path, output, COMMAND, facts)


def _said(table: object) -> bytes:
    return (json.dumps(table, indent=2, sort_keys=True) + "\n").encode()
