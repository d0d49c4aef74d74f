"""What ``solve``, ``model``, ``cam`` and ``build`` share: inspect a build, make its pages, write them."""

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from typing import NoReturn

import typer

from mechwright.build import Build, Inspection, Page, Wanted
from mechwright.cli import telling
from mechwright.cli.hosting import open_host
from mechwright.cli.progress import Step, progress
from mechwright.cli.provenance import facts
from mechwright.contracts.exporter import Exporter
from mechwright.contracts.finding import Finding, Severity, Stage, errors
from mechwright.errors import DesignError, MechwrightError, PluginError
from mechwright.output.folder import Output, check_folder, write_folder
from mechwright.plugins.host import Host


class Refused(Exception):  # noqa: N818 - it carries findings, which are no fault of the program
    """Findings forbid what is asked for."""

    def __init__(self, findings: Iterable[Finding]) -> None:
        super().__init__()
        self.findings = list(findings)


def perform(path: Path, folder: Path, wanted: Wanted, stage: Stage, empty: str = "") -> None:
    """Run a command that writes a folder.

    Parameters
    ----------
    path, folder
        The design file, and where the files go.
    wanted
        The command's name, and what is asked for besides.
    stage
        The last stage of the command's work: errors of later ones are told and stop nothing.
    empty
        What is wrong if no page has a file; it follows the family's name.
    """
    found = open_host()
    _check_formats(found, wanted.formats)
    check_folder(folder)
    pages = [page for page in found.all(Page) if wanted.command in page.commands]
    asked = [one for one in found.all(Inspection) if wanted.command in one.commands]
    output = Output()
    steps = 2 + len({page.doing for page in pages}) + len({one.doing for one in asked})
    with Build(path, found, wanted) as build, progress(steps) as step:
        try:
            told = _make(build, pages, asked, stage, output, step)
        except Refused as refused:
            refuse(refused.findings, path)
        if not output.files and empty:
            raise DesignError(f"{path}: family {build.design.family.name} {empty}")
        step("writing")
        write_folder(folder, output, wanted.command, facts(build.design, found))
    later = [finding for finding in errors(told) if _later(finding.stage, stage)]
    for finding in told:
        if finding.severity is not Severity.NOTE:
            # What a family advises has not been tried here, and stops nothing.
            tell(path, replace(finding, remedy="") if finding in later else finding)
    for fault in build.faults:
        tell(path, fault)
    if errors(told) or build.missing:
        said = ", ".join(build.missing)
        tell(
            path,
            f"written up to the {stage}; the errors above forbid what follows"
            + (f": {said}" if said else "")
            + ("; mechwright fix looks for a change that helps" if later else ""),
        )
    typer.echo(f"{folder}: {len(output.files)} files written: {', '.join(sorted(output.files))}")


def _make(
    build: Build, pages: list[Page], asked: list[Inspection], stage: Stage, output: Output, step: Step
) -> list[Finding]:
    """Fill the output; gives all findings in the order of inspection."""
    for page in pages:
        page.warm(build)
    step("checking")
    told: dict[str, list[Finding]] = {"": list(build.findings)}
    if stopping := errors(build.findings, stage):
        from mechwright.remedies import tried

        raise Refused(tried(build.design, stopping))
    for page in pages:
        page.begin(build)
    asked = sorted(asked, key=lambda one: one.order)
    late = [one for one in asked if one.late(build)]

    def ask(inspections: Iterable[Inspection]) -> None:
        for one in inspections:
            step(one.doing)
            try:
                told[one.name] = list(one.findings(build))
            except MechwrightError as error:
                if not _later(one.stage, stage):
                    raise
                build.leave_out(f"{one.doing} is not looked for", error)
                continue
            if _later(one.stage, stage):
                told[one.name] = errors(told[one.name])
            if stopping := errors(told[one.name], stage):
                raise Refused(stopping)

    def write(wanted: Iterable[Page]) -> None:
        doing = ""
        for page in wanted:
            if page.doing != doing:
                step(doing := page.doing)
            for name, content in page.files(build).items():
                output.add(name, content)

    try:
        ask(one for one in asked if one not in late)
        write(page for page in pages if not page.late(build))
    except (MechwrightError, Refused):
        ask(late)  # what is asked late is told first all the same
        raise
    ask(late)
    write(page for page in pages if page.late(build))
    order = ["", *(one.name for one in asked)]
    return [finding for name in order for finding in told.get(name, ())]


def _later(one: Stage, than: Stage) -> bool:
    order = list(Stage)
    return order.index(one) > order.index(than)


def _check_formats(found: Host, names: Iterable[str]) -> None:
    try:
        for name in names:
            found.get(Exporter, name)
    except PluginError as error:
        raise PluginError(f"--also: {error}") from error


def refuse(findings: Iterable[Finding], path: Path) -> NoReturn:
    """Tell the findings and end with exit code 1."""
    for finding in findings:
        tell(path, finding)
    raise typer.Exit(1)


def tell(path: Path, words: object) -> None:
    """Say something of a design on standard error."""
    if isinstance(words, Finding):
        telling.tell(words, err=True, path=path)
    else:
        typer.echo(f"mechwright: {path}: {words}", err=True)
