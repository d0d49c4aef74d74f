"""The command ``check``."""

import json
from pathlib import Path

import typer

from mechwright.build import Build, Inspection, Wanted
from mechwright.build.tolerances import KEYS, as_data, as_text, required_analysis
from mechwright.cli.hosting import open_host
from mechwright.cli.telling import tell
from mechwright.contracts.finding import Finding, Severity, Stage, errors
from mechwright.remedies import proposed_tried, tried


def findings_of(build: Build) -> list[Finding]:
    """What the family says; then, if that allows it, what every inspection does."""
    found = list(build.findings)
    if not errors(found):
        asked = sorted(build.host.all(Inspection), key=lambda one: one.order)
        for one in asked:
            if build.wanted.command in one.commands:
                found += proposed_tried(build, one, one.findings(build))
    return found


def check(path: Path, as_json: bool, tolerances: bool = False) -> None:
    """Print the findings, and what tolerances do; the exit code is 1 if a finding is an error.

    Raises
    ------
    DesignError
        Tolerances are asked for, and the family has no analysis of them.
    """
    with Build(path, open_host(), Wanted("check")) as build:
        findings = findings_of(build)
        family = len(build.findings)
        findings[:family] = tried(build.design, findings[:family])
        name = build.design.name
        # A mechanism that does not move has no errors of its motion.
        moves = not errors(findings, Stage.MOTION) and not any(f.code == KEYS for f in findings)
        analysis = required_analysis(build) if tolerances and moves else None
    failed = bool(errors(findings))
    if as_json:
        said = {"design": name, "ok": not failed, "findings": [f.as_dict() for f in findings]}
        if analysis is not None:
            said["tolerances"] = as_data(analysis)
        typer.echo(json.dumps(said, indent=2))
    else:
        order = list(Severity)
        for finding in sorted(findings, key=lambda finding: order.index(finding.severity)):
            tell(finding)
        if analysis is not None:
            typer.echo("\n".join(as_text(analysis)))
        typer.echo(f"{path}: " + ("cannot be built" if failed else "can be built"))
    raise typer.Exit(1 if failed else 0)
