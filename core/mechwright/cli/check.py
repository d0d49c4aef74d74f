"""The command ``check``."""

import json
from collections.abc import Iterable, Sequence
from pathlib import Path

import typer

from mechwright.cli.hosting import open_host
from mechwright.cli.progress import fraction
from mechwright.cli.telling import echo, tell
from mechwright.contracts.finding import Finding, Severity, Stage, errors
from mechwright.errors import DesignError
from mechwright.pipeline import Wanted
from mechwright.pipeline.process import ProcessSettings, ProcessTable
from mechwright.pipeline.process_options import (
    ProcessOption,
    options_sentence,
    options_table,
    process_options,
)
from mechwright.pipeline.tolerances import KEYS, as_data, as_text, required_analysis
from mechwright.scripting.checking import unmade
from mechwright.scripting.mechanism import Mechanism


def check(
    path: Path, wanted: Wanted, to: Stage | None, *, as_json: bool, tolerances: bool, figures: bool
) -> None:
    """Print the verdict, and what led to it; the exit code is 1 if a finding is an error.

    Raises
    ------
    DesignError
        Tolerances are asked for, and the family has no analysis of them.
    """
    with Mechanism(path, open_host(), wanted) as build, fraction() as progress:
        findings = build.check(progress, to)
        name = build.design.name
        # A mechanism that does not move has no errors of its motion.
        moves = not errors(findings, Stage.MOTION) and not any(f.code == KEYS for f in findings)
        analysis = required_analysis(build) if tolerances and moves else None
        named = build.design.table(ProcessTable) != ProcessSettings()
        options = _options(build, findings, to) if as_json or figures or named else []
    failed, open_ = bool(errors(findings)), unmade(build.host, to)
    if as_json:
        said = {
            "design": name,
            "ok": not failed,
            "to": to or Stage.OUTPUT,
            "unmade": list(open_),
            "findings": [f.as_dict() for f in findings],
        }
        if options:
            said["processes"] = [one.as_dict() for one in options]
        if analysis is not None:
            said["tolerances"] = as_data(analysis)
        typer.echo(json.dumps(said, indent=2))
    else:
        for finding in shown(findings):
            tell(finding)
        if figures:
            echo(*table(findings), *options_table(options))
        if analysis is not None:
            echo(*as_text(analysis))
        if named and options:
            echo(options_sentence(options))
        echo(f"{path}: {verdict(to, open_, failed=failed)}")
    raise typer.Exit(1 if failed else 0)


def _options(build: Mechanism, findings: Iterable[Finding], to: Stage | None) -> list[ProcessOption]:
    """The processes of each plate, where the check comes to machining, and there are parts."""
    early = to is not None and Stage.MACHINING.is_after(to)
    return [] if early or errors(findings, Stage.PARTS) else process_options(build)


def stage_of(text: str) -> Stage | None:
    """The stage that the option ``--to`` names, None where it is left out; raises DesignError for another."""
    if not text:
        return None
    if text not in list(Stage):
        raise DesignError(f"--to: {text!r} is not known; one of: {', '.join(Stage)}")
    return Stage(text)


def verdict(to: Stage | None, unmade: Sequence[str], *, failed: bool) -> str:
    """Whether a design can be built, the stage up to which this holds, and what it does not rest on."""
    if failed:
        return "cannot be built"
    if to is None and unmade:
        return f"can be built, as judged without {' and '.join(unmade)}; check --to {Stage.OUTPUT} makes them"
    return "can be built" if to in {None, Stage.OUTPUT} else f"can be built up to {to}"


def shown(findings: Iterable[Finding]) -> list[Finding]:
    """What there is something to do about, the gravest first; what several parts have in common, once."""
    order = list(Severity)
    told = (one for one in findings if one.severity is not Severity.NOTE)
    once = {(one.code, one.parameter, one.message, one.remedy): one for one in told}
    return sorted(once.values(), key=lambda finding: order.index(finding.severity))


def table(findings: Iterable[Finding]) -> list[str]:
    """The notes in columns: what was found, its value, and what that means."""
    notes = dict.fromkeys(one for one in findings if one.severity is Severity.NOTE)
    rows = [
        (one.code, "" if one.value is None else f"{one.value:.6g} {one.unit}".rstrip(), one.message)
        for one in notes
    ]
    wide = [max((len(row[column]) for row in rows), default=0) for column in range(2)]
    return [f"{code:<{wide[0]}}  {value:>{wide[1]}}  {said}" for code, value, said in rows]
