"""What ``solve``, ``model``, ``cam`` and ``build`` share: a run, and what is said of it."""

import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any, NoReturn

import typer

from mechwright.cli import telling
from mechwright.cli.hosting import open_host
from mechwright.cli.progress import fraction, standing
from mechwright.contracts.exporter import Exporter
from mechwright.contracts.finding import Finding, Severity, Stage
from mechwright.contracts.refused import RefusedError
from mechwright.errors import PluginError
from mechwright.pipeline import Wanted
from mechwright.plugins.host import Host
from mechwright.scripting.mechanism import Mechanism
from mechwright.scripting.performing import Written


def perform(path: Path, folder: Path, wanted: Wanted, empty: str = "", as_json: bool = False) -> None:
    """Run a command that writes a folder.

    Parameters
    ----------
    path, folder
        The design file, and where the files go.
    wanted
        The command's name, and what is asked for besides.
    empty
        What is wrong if no page has a file; it follows the family's name.
    as_json
        What is said goes to standard output as JSON, findings of any severity with it.
    """
    found = open_host()
    check_formats(found, wanted.formats)
    with standing(folder), Mechanism(path, found, wanted) as build:
        try:
            with fraction() as progress:
                written = build.write(folder, progress, empty)
        except RefusedError as refused:
            if as_json:
                _print(data_of(build.design.name, Written(folder, (), refused.findings), ok=False))
                raise typer.Exit(1) from None
            refuse(refused.findings, path)
        if as_json:
            _print(data_of(build.design.name, written, ok=True))
        else:
            say(path, wanted.extent.stage, written)


def say(path: Path, stage: Stage, written: Written, *, files: bool = True) -> None:
    """Tell what was found and left out, and which files were written, if that is asked for."""
    for finding in written.findings:
        if finding.severity is not Severity.NOTE:
            tell(path, finding)
    for fault in written.faults:
        tell(path, fault)
    if written.findings.errors or written.missing:
        said = ", ".join(written.missing)
        tell(
            path,
            f"written up to the {stage}; the errors above forbid what follows"
            + (f": {said}" if said else "")
            + ("; mechwright fix looks for a change that helps" if written.later else ""),
        )
    if files:
        telling.echo(f"{written.folder}: {len(written.files)} files written: {', '.join(written.files)}")


def data_of(name: str, said: Written, *, ok: bool, written: bool = True) -> dict[str, Any]:
    """What is told as JSON; ``ok`` is what the exit code says, whatever findings stopped nothing.

    Of what writes nothing there are the findings alone.
    """
    found = {"design": name, "ok": ok, "findings": [finding.as_dict() for finding in said.findings]}
    if not written:
        return found
    return {
        **found,
        "folder": str(said.folder),
        "files": list(said.files),
        "missing": list(said.missing),
        "faults": list(said.faults),
    }


def _print(data: dict[str, Any]) -> None:
    typer.echo(json.dumps(data, indent=2))


def check_formats(found: Host, names: Iterable[str]) -> None:
    """Raise PluginError, named as the option, where nothing is installed for one of some formats."""
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
        telling.echo(f"mechwright: {path}: {words}", err=True)
