"""The command ``synthesize``."""

import json
from collections.abc import Sequence
from pathlib import Path

import typer

from mechwright.cli.hosting import open_host
from mechwright.cli.progress import fraction, standing
from mechwright.cli.telling import echo
from mechwright.contracts.finding import Severity, errors
from mechwright.contracts.synthesis import BEYOND, Candidate, Reason
from mechwright.designs.requirement import load_requirement
from mechwright.output.folder import check_folder
from mechwright.scripting.synthesis import sought

FIGURES = 3
"""Figures of a candidate on its line of the listing; synthesis.json has all of them."""


def synthesize(path: Path, folder: Path, as_json: bool, minutes: bool) -> None:
    """Write the designs that meet a requirement, best first; the exit code is 1 if none meets it."""
    installed = open_host()
    asked = load_requirement(path, installed)
    check_folder(folder)
    with standing(folder), fraction() as progress:
        found = sought(asked, installed, progress)
        failed = bool(errors(found.result.findings))
        files = () if failed else found.write(folder, minutes)
    if as_json:
        said = {"ok": not failed, **found.summary, "folder": str(folder), "files": list(files)}
        typer.echo(json.dumps(said, indent=2))
        raise typer.Exit(int(failed))
    for finding in found.result.findings:
        if finding.severity is not Severity.NOTE:
            echo(f"mechwright: {path}: {finding}", err=True)
    if failed:
        echo(f"mechwright: {path}: {found.told}", err=True)
        _tell_reasons(found.result.rejected, err=True)
        raise typer.Exit(1)
    for (name, _), candidate in zip(found.texts, found.result.candidates, strict=True):
        echo(f"{name}.toml: {_line(candidate)}")
    for finding in found.result.findings:
        if finding.severity is Severity.NOTE:
            echo(str(finding))
    echo(found.told)
    _tell_reasons(found.result.rejected)
    many = f"{len(found)} design{'s' * (len(found) != 1)}"
    echo(f"{folder}: {many} written, best first, gallery.html and synthesis.json")


def _tell_reasons(reasons: Sequence[Reason], *, err: bool = False) -> None:
    """What speaks against the designs that are not given, in the words of the first of each kind."""
    for reason in reasons:
        first = "" if reason.count == 1 or reason.code == BEYOND else ", the first"
        echo(f"  {reason}{first}: {reason.message}", err=err)


def _line(candidate: Candidate[object]) -> str:  # type: ignore[type-var]
    shown = dict(list(candidate.shown.items())[: 1 + FIGURES])
    return ", ".join(f"{name} {one.value:.6g} {one.unit}".rstrip() for name, one in shown.items())
