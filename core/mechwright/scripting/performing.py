"""What ``solve``, ``model``, ``cam`` and ``build`` share: inspect a build, make its pages, write them."""

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from pathlib import Path

from mechwright.build import Build, Inspection, Page
from mechwright.contracts.exporter import Exporter
from mechwright.contracts.finding import Finding, Findings, Severity, Stage, errors
from mechwright.contracts.refused import RefusedError
from mechwright.contracts.synthesis import Progress, unheard
from mechwright.errors import DesignError, MechwrightError
from mechwright.output.folder import Output, check_folder, write_folder
from mechwright.reading import once
from mechwright.scripting.provenance import facts
from mechwright.scripting.steps import CHECKING, WRITING, Steps, shares


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


def perform(
    build: Build, folder: Path, stage: Stage, progress: Progress = unheard, empty: str = ""
) -> Written:
    """Make the pages of a build's command, and write them into a folder as one.

    Parameters
    ----------
    build
        What is asked of it says the command; it is closed afterwards.
    folder
        New, empty, or written by an earlier run.
    stage
        The last stage of the work: errors of later ones are told and stop nothing.
    progress
        Told how far it is.
    empty
        What is wrong if no page has a file; it follows the family's name.

    Raises
    ------
    RefusedError
        Findings forbid it; nothing is written.
    MechwrightError
        It cannot be made or written; nothing is written.
    """
    found, wanted = build.host, build.wanted
    for name in wanted.formats:
        found.get(Exporter, name)
    check_folder(folder)
    pages = [page for page in found.all(Page) if wanted.command in page.commands]
    asked = [one for one in found.all(Inspection) if wanted.command in one.commands]
    output = Output()
    step = Steps(build, shares([*asked, *pages]), progress)
    with build, once():
        told = _make(build, pages, asked, stage, output, step)
        if not output.files and empty:
            raise DesignError(f"{build.path}: family {build.design.family.name} {empty}")
        step(WRITING)
        write_folder(folder, output, wanted.command, facts(build.design, found))
    later = Findings(finding for finding in errors(told) if _later(finding.stage, stage))
    # Against what stops nothing nothing was sought, and words alone are no remedy.
    said = (replace(one, remedy="") if one in later else one for one in _advised(build, told))
    files = tuple(sorted(output.files))
    return Written(folder, files, Findings(said), later, tuple(build.missing), tuple(build.faults))


def _make(
    build: Build, pages: list[Page], asked: list[Inspection], stage: Stage, output: Output, step: Steps
) -> list[Finding]:
    """Fill the output; gives all findings in the order of inspection."""
    for page in pages:
        page.warm(build)
    step(CHECKING)
    told: dict[str, list[Finding]] = {"": list(build.findings)}
    if stopping := errors(build.findings, stage):
        from mechwright.remedies import tried

        raise RefusedError(build.path, tried(build.design, stopping))
    for page in pages:
        page.begin(build)
    asked = sorted(asked, key=lambda one: one.order)
    late = [one for one in asked if one.late(build)]

    def ask(inspections: Iterable[Inspection]) -> None:
        for one in inspections:
            step(one.doing)
            try:
                told[one.name] = list(one.findings(build))
                if any(finding.severity is not Severity.NOTE for finding in told[one.name]):
                    from mechwright.remedies import proposed_tried

                    told[one.name] = proposed_tried(build, one, told[one.name])
            except MechwrightError as error:
                if not _later(one.stage, stage):
                    raise
                build.leave_out(f"{one.doing} is not looked for", error)
                continue
            if _later(one.stage, stage):
                told[one.name] = errors(told[one.name])
            if stopping := errors(told[one.name], stage):
                raise RefusedError(build.path, stopping)

    def write(wanted: Iterable[Page]) -> None:
        for page in wanted:
            step(page.doing)
            for name, content in page.files(build).items():
                output.add(name, content)

    try:
        ask(one for one in asked if one not in late)
        write(page for page in pages if not page.late(build))
    except MechwrightError:
        ask(late)  # what is asked late is told first all the same
        raise
    ask(late)
    write(page for page in pages if page.late(build))
    order = ["", *(one.name for one in asked)]
    return [finding for name in order for finding in told.get(name, ())]


def _advised(build: Build, told: list[Finding]) -> list[Finding]:
    """The findings, warnings of the family with remedies that were tried."""
    mine = [one for one in told if one.severity is Severity.WARNING and one in build.findings]
    if not mine:
        return told
    from mechwright.remedies import tried

    known = dict(zip(map(id, mine), tried(build.design, mine), strict=True))
    return [known.get(id(one), one) for one in told]


def _later(one: Stage, than: Stage) -> bool:
    order = list(Stage)
    return order.index(one) > order.index(than)
