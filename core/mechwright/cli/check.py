"""The command ``check``."""

import json
from pathlib import Path

import typer

from mechwright.build import Build, Inspection, Wanted
from mechwright.cli.hosting import open_host
from mechwright.contracts.finding import Finding, Severity, errors


def findings_of(build: Build) -> list[Finding]:
    """What the family says; then, if that allows it, what every inspection does."""
    found = list(build.findings)
    if not errors(found):
        asked = sorted(build.host.all(Inspection), key=lambda one: one.order)
        for one in asked:
            if build.wanted.command in one.commands:
                found += one.findings(build)
    return found


def check(path: Path, as_json: bool) -> None:
    """Print the findings; the exit code is 1 if one is an error."""
    with Build(path, open_host(), Wanted("check")) as build:
        findings = findings_of(build)
        name = build.design.name
    failed = bool(errors(findings))
    if as_json:
        said = {"design": name, "ok": not failed, "findings": [f.as_dict() for f in findings]}
        typer.echo(json.dumps(said, indent=2))
    else:
        order = list(Severity)
        for finding in sorted(findings, key=lambda finding: order.index(finding.severity)):
            typer.echo(str(finding))
        typer.echo(f"{path}: " + ("cannot be built" if failed else "can be built"))
    raise typer.Exit(1 if failed else 0)
