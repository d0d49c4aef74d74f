"""What ``solve``, ``model``, ``cam`` and ``build`` share: a run of a build, and the folder it writes."""

from dataclasses import dataclass, field, replace
from pathlib import Path

from mechwright.contracts.exporter import Exporter
from mechwright.contracts.finding import Findings, Severity, errors
from mechwright.contracts.refused import RefusedError
from mechwright.contracts.synthesis import Progress, unheard
from mechwright.errors import DesignError
from mechwright.output.folder import check_folder, write_folder
from mechwright.pipeline import Build, Run
from mechwright.pipeline.page import pages_of
from mechwright.pipeline.run import REFUSED
from mechwright.pipeline.steps import WRITING
from mechwright.reading import once
from mechwright.remedies import with_remedies
from mechwright.scripting.provenance import facts


@dataclass(frozen=True)
class Written:
    """What a run has written, and what there is to say of it.

    Parameters
    ----------
    folder, files
        Where, and the names, sorted.
    findings
        Everything that was found, in order, with remedies that were tried.
    later
        Those that forbid what comes after the run: they stopped nothing.
    missing
        What is left out because of findings or faults, each in a few words.
    faults
        What could not be done and stops nothing, in whole sentences.
    """

    folder: Path
    files: tuple[str, ...]
    findings: Findings
    later: Findings = field(default_factory=Findings)
    missing: tuple[str, ...] = ()
    faults: tuple[str, ...] = ()

    def __repr__(self) -> str:
        return f"<Written {self.folder}: {', '.join(self.files)}>"


def perform(build: Build, folder: Path, progress: Progress = unheard, empty: str = "") -> Written:
    """Make the pages of a build's command, and write them into a folder as one.

    Parameters
    ----------
    build
        What is asked of it says the command and how far the run goes; it is closed afterwards.
    folder
        New, empty, or written by an earlier run.
    progress
        Told how far it is.
    empty
        What is wrong if no page has a file; it follows the family's name.

    Raises
    ------
    RefusedError
        Findings forbid it; nothing is written.
    MechwrightError
        It cannot be made, which a check tells as ``build.refused``, or written; nothing is written.
    """
    found, wanted, work = build.host, build.wanted, build.wanted.extent
    for name in wanted.formats:
        found.get(Exporter, name)
    check_folder(folder)
    run = Run(build, work, progress)
    with build, once():
        try:
            output = run.make(pages_of(found, wanted.command))
        except RefusedError as refused:
            if run.raised is not None and all(one.code == REFUSED for one in refused.findings):
                raise run.raised from None  # a mistake in the file, in its own words
            raise RefusedError(build.path, errors(with_remedies(run), work.stage)) from refused
        if not output.files and empty:
            raise DesignError(f"{build.path}: family {build.design.family.name} {empty}")
        run.step(WRITING)
        write_folder(folder, output, wanted.command, facts(build.design, found))
    told = with_remedies(run)
    later = Findings(one for one in told if one.severity is Severity.ERROR)
    # Against what stops nothing nothing was sought, and words alone are no remedy.
    said = Findings(replace(one, remedy="") if one in later else one for one in told)
    files = tuple(sorted(output.files))
    return Written(folder, files, said, later, tuple(build.missing), tuple(build.faults))
