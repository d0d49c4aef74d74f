"""A sweep as scripts ask for it, and the tables that it gives."""

import tempfile
from collections.abc import Mapping
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mechwright.contracts.finding import Change
from mechwright.contracts.shown import html_table
from mechwright.contracts.synthesis import Progress, unheard
from mechwright.designs.change import changed
from mechwright.extras import optional, require
from mechwright.plugins.host import Host, host
from mechwright.scripting.changes import change_of
from mechwright.scripting.mechanism import Mechanism
from mechwright.studies.checks import mechanism_of
from mechwright.studies.folder import SHARDS, SUFFIX
from mechwright.studies.run import FRONT, Swept, evaluate
from mechwright.studies.shard import NUMBER, Counts
from mechwright.studies.study import TABLE, Study, load_study, study_of
from mechwright.studies.workers import workers_of

if TYPE_CHECKING:
    import pandas
    import pyarrow


class Sweep:
    """Designs of a study, with what was found of them.

    :func:`sweep` gives one.

    Parameters
    ----------
    study
        The study.
    found
        The counts, and the designs of the front that were checked.
    folder
        Folder that holds the tables.
    known
        The installed plugins.
    """

    def __init__(self, study: Study, found: Swept, folder: Path, known: Host) -> None:
        self.study, self.found = study, found
        self.folder: Path | None = folder
        """The folder that was written; None if it was a temporary one."""
        self._place, self._host = folder, known

    def __repr__(self) -> str:
        return f"<Sweep {self.study.name}: {self.found}>"

    def _repr_html_(self) -> str:
        columns = list(self.study.units)
        rows = (
            [one.name or f"{one.design}: {one.refused}", *(one.figures[column] for column in columns)]
            for one in self.found.chosen
        )
        return f"<p>{self.found}</p>" + html_table(["design", *columns], rows)

    @property
    def counts(self) -> Counts:
        """How many ``designs`` there were, how many are ``feasible``, and how many each code forbids."""
        return self.found.counts

    @property
    def rates(self) -> dict[str, float]:
        """The share, 0 to 1, of the designs that are ``allowed``, then of those that each code forbids.

        The codes are those of findings, ``constraint.COLUMN`` and ``parameters.KEY``; most frequent first.
        """
        counts = self.counts
        most = sorted(counts.forbidden.items(), key=lambda one: -one[1])
        return {name: count / counts.designs for name, count in [("allowed", counts.feasible), *most]}

    @cached_property
    def table(self) -> "pyarrow.Table":
        """Number, parameters and columns of each design that is allowed, or of all with ``keep="all"``.

        The metadata of a field has its ``unit``. The tables of a folder are read at the first use.
        """
        parquet = optional("pyarrow.parquet")
        tables = [parquet.read_table(path) for path in sorted((self._place / SHARDS).glob(f"*{SUFFIX}"))]
        return optional("pyarrow").concat_tables([one.replace_schema_metadata() for one in tables])

    @cached_property
    def front(self) -> "pyarrow.Table":
        """The rows of the designs that no other one dominates; none without objectives."""
        path = self._place / FRONT
        return optional("pyarrow.parquet").read_table(path) if self.found.front else self.table.slice(0, 0)

    @cached_property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        """The designs of the front that build, the best of each objective first."""
        rows = {row[NUMBER]: row for row in self.front.to_pylist()}
        return tuple(
            mechanism_of(
                self.study,
                {axis.name: rows[one.design][axis.name] for axis in self.study.axes},
                one.name,
                self._host,
            )
            for one in self.found.chosen
            if one.name
        )

    def to_pandas(self) -> "pandas.DataFrame":
        """The table of pandas with the columns of :attr:`table`.

        Raises PluginError where pandas is not installed.
        """
        require("pandas", by="to_pandas")
        return self.table.to_pandas()

    def in_memory(self) -> "Sweep":
        """Read the tables of a folder that will be removed."""
        _ = self.table, self.front
        self.folder = None
        return self


def sweep(
    study: str | PathLike[str] | Mapping[str, Any] | Mechanism,
    /,
    folder: str | PathLike[str] | None = None,
    *,
    workers: int | None = None,
    scheduler: str | None = None,
    progress: Progress = unheard,
    **keys: object,
) -> Sweep:
    """Evaluate many designs of one family, as ``mechwright sweep`` does.

    Parameters
    ----------
    study
        A study file; what such a file says, as a mapping; or a mechanism, whose ranges are keyword arguments.
    folder
        Folder for the tables and the designs of the front. A folder in which the same study was stopped is
        completed. By default the tables are in memory alone.
    workers
        Processes of this machine; by default one for each core.
    scheduler
        Address of a Dask cluster that works in their place, such as ``"tcp://host:8786"``.
    progress
        Called with the part that is done, 0 to 1, and with words.
    keys
        Keys of the table ``[study]``, such as ``ranges={"crank": {"least": 20, "greatest": 45}}``. They
        replace those of a file.

    Raises
    ------
    DesignError
        The study is wrong.
    OutputError
        A file cannot be read, or the folder holds something else or cannot be written.
    PluginError
        The family, or the extra ``scale``, is not installed, or workers fail.

    Examples
    --------
    61 designs, each with another rod::

        rods = {"rod": {"least": 60, "greatest": 120, "count": 61}}
        sweep({"family": "slider-crank", "name": "rods"}, method="grid", ranges=rods)
    """
    require("pyarrow", by="sweep")
    chosen = workers_of(workers, scheduler)
    installed = study.host if isinstance(study, Mechanism) else host()
    read = _study(study, change_of(installed, keys, TABLE), installed)

    def into(place: Path) -> Sweep:
        return Sweep(read, evaluate(read, place, chosen, installed, progress), place, installed)

    if folder is not None:
        return into(Path(folder))
    with tempfile.TemporaryDirectory(prefix="mechwright-") as place:
        return into(Path(place)).in_memory()


def _study(
    study: str | PathLike[str] | Mapping[str, Any] | Mechanism, change: Change, installed: Host
) -> Study:
    if isinstance(study, Mechanism):
        return study_of(changed(study.design.content, change), study.design.path, installed)
    if isinstance(study, Mapping):
        return study_of(changed(study, change), Path(f"{study.get('name', TABLE)}.toml"), installed)
    return load_study(Path(study), installed, change)
