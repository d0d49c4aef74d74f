"""The folder of a sweep: each table in one step, so that a sweep that was stopped goes on where it stood."""

import contextlib
import json
import os
from pathlib import Path

from mechwright.errors import OutputError
from mechwright.output.folder import Output, write_folder
from mechwright.plugins.host import Host
from mechwright.reading import read_bytes, regular
from mechwright.scripting.provenance import run_facts
from mechwright.sweep.shard import Counts, counts_of
from mechwright.sweep.study import Study
from mechwright.sweep.task import fingerprint

COMMAND = "sweep"
BEGUN = "study.json"
BEGUN_LIMIT = 10_000
"""Bytes of that file, which holds three short texts."""
SHARDS = "tables"
SUFFIX = ".parquet"


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
        own = {"study": study.digest, "program": fingerprint(study.family.name), "batch": study.batch}
        found = self._begun()
        if found is None:
            self.write(Output({BEGUN: _said(own)}))
        elif found != own:
            differs = ", ".join(key for key in own if found.get(key) != own[key])
            raise OutputError(
                f"{path}: holds the sweep of another study ({differs}); give a new folder with -o, or go on "
                "with the study and the program that began it"
            )
        try:
            (path / SHARDS).mkdir(exist_ok=True)
            for part in (path / SHARDS).glob("*.part"):
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

    def has(self, name: str) -> bool:
        """Whether a task is done; raises as :meth:`counts` does where its file is no table of the study."""
        if not regular(self.table(name)):
            return False
        self.counts(name)
        return True

    def counts(self, name: str) -> Counts:
        """What was counted in a task that is done."""
        return counts_of(self.study, self.table(name))

    def store(self, name: str, content: bytes) -> None:
        """Write the table of a task: it is there as a whole, or not at all."""
        path = self.table(name)
        part = path.with_suffix(".part")
        try:
            with part.open("wb") as file:
                file.write(content)
                file.flush()
                os.fsync(file.fileno())
            part.replace(path)
        except OSError as error:
            with contextlib.suppress(OSError):
                part.unlink(missing_ok=True)
            raise OutputError(
                f"{path}: cannot be written: {error.strerror or error}; what is finished stays, and the same "
                "command goes on with it"
            ) from error

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
