"""The command ``synthesize``."""

import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

import typer

from mechwright.build import Build, Wanted
from mechwright.cli.check import findings_of
from mechwright.cli.hosting import open_host
from mechwright.cli.progress import fraction
from mechwright.cli.provenance import run_facts
from mechwright.contracts.finding import Finding, Severity, errors
from mechwright.contracts.part import check_name
from mechwright.contracts.synthesis import Candidate, Progress, Reason, Rejected, Synthesis
from mechwright.designs.files import read_text
from mechwright.designs.requirement import Requirement, load_requirement
from mechwright.designs.text import design_text
from mechwright.output.folder import Output, check_folder, write_folder
from mechwright.plugins.host import Host

FIGURES = 3
"""Figures of a candidate on its line of the listing; synthesis.json has all of them."""


def synthesize(path: Path, folder: Path) -> None:
    """Write the designs that meet a requirement, best first."""
    found = open_host()
    asked = load_requirement(path, found)
    check_folder(folder)
    with fraction() as progress:
        result = sifted(asked, asked.family.synthesise(asked.kind, asked.table, progress), found, progress)
    for finding in result.findings:
        if finding.severity is not Severity.NOTE:
            typer.echo(f"mechwright: {path}: {finding}", err=True)
    told = _told(result)
    if not result.candidates:
        typer.echo(f"mechwright: {path}: {told}", err=True)
    if errors(result.findings):
        raise typer.Exit(1)
    inputs = {path.name: asked.digest, **{name: read_text(file)[1] for name, file in asked.inputs.items()}}
    output = Output()
    for name, file in asked.files.items():
        output.add(name, read_text(file)[0])
    listing = []
    width = len(str(len(result.candidates)))
    for number, candidate in enumerate(result.candidates, start=1):
        name = check_name(f"{asked.name}-{number:0{width}}", "name of a design")
        output.add(f"{name}.toml", design_text(asked.family, name, candidate.params, asked.tables))
        found_in_it = [finding.as_dict() for finding in asked.family.check(candidate.params)]
        listing.append({"design": f"{name}.toml", **candidate.as_dict(), "findings": found_in_it})
        typer.echo(f"{name}.toml: {_line(candidate)}")
    summary = {
        "family": asked.family.name,
        "kind": asked.kind,
        "requirement": asked.table.model_dump(mode="json"),
        "findings": [finding.as_dict() for finding in result.findings],
        "rejected": [asdict(reason) for reason in result.rejected],
        "candidates": listing,
    }
    output.add("synthesis.json", json.dumps(summary, indent=2) + "\n")
    write_folder(folder, output, "synthesize", run_facts(asked.name, asked.family, inputs, found))
    if result.rejected:
        typer.echo(told)
    count = len(result.candidates)
    typer.echo(f"{folder}: {count} design{'s' * (count != 1)} written, best first, and synthesis.json")


def sifted(asked: Requirement, result: Synthesis[Any], found: Host, progress: Progress) -> Synthesis[Any]:
    """The result without the designs that cannot be built as the requirement file has its tables."""
    rejected = Rejected(result.rejected)
    kept: list[Candidate[Any]] = []
    for number, candidate in enumerate(result.candidates):
        progress(number / len(result.candidates), "checking the designs")
        with Build(asked.design(asked.name, candidate.params), found, Wanted("check")) as build:
            if not rejected.by(findings_of(build)):
                kept.append(candidate)
    said = result.findings
    if result.candidates and not kept:
        said = (*said, _unbuildable(rejected.reasons[0]))
    return Synthesis(tuple(kept), said, rejected.reasons)


def _unbuildable(reason: Reason) -> Finding:
    said = f"no design that meets it can be built as its tables say: {reason.message}"
    return Finding.error("synthesis.unbuildable", "", said, remedy="change the tables, or what is asked for")


def _told(result: Synthesis[Any]) -> str:
    """How many designs were found and are given, and why the others are not."""
    given = len(result.candidates)
    found = given + sum(reason.count for reason in result.rejected)
    why = ", ".join(map(str, result.rejected))
    return f"{found} found, {given} given" + (f": {why}" if why else "")


def _line(candidate: Candidate[object]) -> str:  # type: ignore[type-var]
    shown = dict(list(candidate.shown.items())[: 1 + FIGURES])
    return ", ".join(f"{name} {one.value:.6g} {one.unit}".rstrip() for name, one in shown.items())
