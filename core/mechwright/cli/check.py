"""The command ``check``."""

import json
from pathlib import Path

import typer

from mechwright.build import Wanted
from mechwright.build.tolerances import KEYS, as_data, as_text, required_analysis
from mechwright.cli.hosting import open_host
from mechwright.cli.progress import fraction
from mechwright.cli.telling import tell
from mechwright.contracts.finding import Severity, Stage, errors
from mechwright.scripting.mechanism import Mechanism


def check(path: Path, as_json: bool, tolerances: bool = False) -> None:
    """Print the findings, and what tolerances do; the exit code is 1 if a finding is an error.

    Raises
    ------
    DesignError
        Tolerances are asked for, and the family has no analysis of them.
    """
    with Mechanism(path, open_host(), Wanted("check")) as build, fraction() as progress:
        findings = build.check(progress)
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
