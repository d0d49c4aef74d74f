"""The commands that work on a design file."""

import json
from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

import typer

from mechwright.cli.listing import warn_broken
from mechwright.cli.progress import progress
from mechwright.cli.provenance import facts
from mechwright.cli.solids import SolidWork, collisions, motion_page
from mechwright.contracts.exporter import Exporter
from mechwright.contracts.finding import Finding, Severity, errors
from mechwright.design.design import SIZE_LIMIT, Design, load, machine_file, read_text
from mechwright.errors import DesignError, MechwrightError, PluginError, ProgramError
from mechwright.output.folder import Output, check_folder, write_folder
from mechwright.plugins.host import Host, host

if TYPE_CHECKING:
    from mechwright.contracts.motion import Motion

PROGRAM_SIZE_LIMIT = 100 * SIZE_LIMIT
"""Bytes: surfacing programs are long, but not longer than this."""


def _host() -> Host:
    found = host()
    warn_broken(found)
    return found


def _open(path: Path) -> tuple[Design, Host]:
    found = _host()
    return load(path, found), found


def _refuse(findings: list[Finding], path: Path) -> NoReturn:
    for finding in errors(findings):
        typer.echo(f"mechwright: {path}: {finding}", err=True)
    raise typer.Exit(1)


def _findings(design: Design, found: Host) -> list[Finding]:
    """What the family says; then, if that allows it, whether plates collide, and what the cutters say."""
    findings = list(design.family.check(design.params))
    if not errors(findings):
        from mechwright_cam import pipeline

        findings += collisions(design, solids=False)
        findings += pipeline.check(design, found)
    return findings


def check(path: Path, as_json: bool) -> None:
    """Print the findings."""
    design, found = _open(path)
    findings = _findings(design, found)
    failed = bool(errors(findings))
    if as_json:
        typer.echo(
            json.dumps(
                {"design": design.name, "ok": not failed, "findings": [f.as_dict() for f in findings]},
                indent=2,
            )
        )
    else:
        order = list(Severity)
        for finding in sorted(findings, key=lambda finding: order.index(finding.severity)):
            typer.echo(str(finding))
        typer.echo(f"{path}: " + ("cannot be built" if failed else "can be built"))
    raise typer.Exit(1 if failed else 0)


def write(
    path: Path,
    folder: Path,
    command: str,
    *,
    samples: int = 2,
    also: str = "",
    curves: str = "spline",
    at: str = "",
) -> None:
    """Run ``solve``, ``model``, ``cam`` or ``build`` and write its files."""
    found = _host()
    exporters = _more_formats(found, also, {"step", "dxf"} if command == "build" else {"step"})
    check_folder(folder)
    output = Output()
    with ExitStack() as stack:
        step = stack.enter_context(progress({"build": 6, "solve": 3}.get(command, 4)))
        work = None
        if command in {"model", "build"}:
            work = SolidWork([found.exporter("step"), *exporters], build=command == "build")
            stack.enter_context(work)
        step("checking")
        design = load(path, found)
        findings = list(design.family.check(design.params))
        if errors(findings):
            _refuse(findings, path)

        def add(files: Mapping[str, bytes]) -> None:
            for name, content in files.items():
                output.add(name, content)

        if work is not None:
            work.begin(design, *_pose(design, at))
        if command in {"solve", "build"}:
            from mechwright.output.motion_files import motion_csv, summary_json

            step("motion")
            motion = design.family.solve(design.params, samples)
            output.add("motion.csv", motion_csv(motion))
            output.add("summary.json", summary_json(motion))
            if command == "solve":
                add(motion_page(design, solids=False))

        def compare() -> None:
            step("interference")
            met = collisions(design, solids=False) if work is None else work.collisions()
            findings.extend(met)
            if errors(met):
                _refuse(met, path)

        # What a second process compares is asked for last; a collision is told first all the same.
        late = work is not None and work.beside
        if command != "solve" and not late:
            compare()
        if command in {"cam", "build"}:
            step("drawings and programs")
            try:
                made = _programs(design, found, output, curves)
            except MechwrightError:
                if late:
                    compare()
                raise
            if late:
                compare()
            findings += made
            if errors(made):
                _refuse(made, path)
            if command == "cam" and not output.files:
                raise DesignError(
                    f"{path}: family {design.family.name} makes no plate part, so there is nothing to mill; "
                    "use mechwright model"
                )
        if work is not None:
            step("solids")
            add(work.files())
        step("writing")
        write_folder(folder, output, command, _facts(design, found))
    for finding in findings:
        if finding.severity is Severity.WARNING:
            typer.echo(f"mechwright: {path}: {finding}", err=True)
    typer.echo(f"{folder}: {len(output.files)} files written: {', '.join(sorted(output.files))}")


def _programs(design: Design, found: Host, output: Output, curves: str) -> list[Finding]:
    from mechwright_cam import pipeline

    return pipeline.write_programs(design, found, output, curves)


def _more_formats(found: Host, also: str, written: set[str]) -> list[Exporter]:
    """The exporters that ``--also`` names, without those whose files are written anyway."""
    names = [name.strip() for name in also.split(",") if name.strip()]
    try:
        exporters = {name: found.exporter(name) for name in names}
    except PluginError as error:
        raise PluginError(f"--also: {error}") from error
    return [exporter for name, exporter in exporters.items() if name not in written]


def _pose(design: Design, at: str) -> "tuple[Motion, int]":
    """A motion, and the sample of it that the assembly shows."""
    if not at:
        return design.family.solve(design.params, 2), 0
    from mechwright.cli import pose

    motion = design.family.solve(design.params, pose.SAMPLES)
    return motion, pose.sample_at(motion, at)


def _facts(design: Design, found: Host) -> dict[str, Any]:
    inputs = {design.path.name: design.digest}
    if design.tool_library is not None:
        inputs[design.cam.tool_library] = read_text(design.tool_library)[1]
    for cam in (design.cam, *design.part_cam.values()):
        machine = machine_file(design.path, cam)
        if machine is not None:
            inputs[cam.machine.model] = read_text(machine)[1]
    return facts(design.name, design.family, inputs, found)


def verify(programs: Sequence[Path], path: Path, part_name: str, as_json: bool, control: str = "") -> None:
    """Prove a program that came from anywhere, in one file or in several that are run in order."""
    from mechwright_cam import pipeline

    design, found = _open(path)
    # Comments may be of any age.
    texts = {str(file): read_text(file, PROGRAM_SIZE_LIMIT, older="latin-1")[0] for file in programs}
    if len(texts) < len(programs):
        raise DesignError("PROGRAM: a file is named twice; name each once, in the order they are run")
    program, *rest = texts
    text = texts if rest else texts[program]
    program += f" to {rest[-1]}" if rest else ""
    findings = list(design.family.check(design.params))
    if errors(findings):
        _refuse(findings, path)
    parts = pipeline.cut_parts(design)
    from mechwright_cam.planning.setups import UNDERSIDE

    name = part_name if part_name in parts else part_name.removesuffix(UNDERSIDE)
    if name not in parts:
        raise DesignError(f"--part: {part_name!r} is no part of {path}; it has: {', '.join(sorted(parts))}")
    try:
        proof = pipeline.verify(design, parts[name], text, found, control, underside=name != part_name)
    except ProgramError as error:  # of several files it names the one
        raise ProgramError(f"{program}: {error}" if len(texts) == 1 else str(error)) from error
    if as_json:
        typer.echo(json.dumps(proof.as_dict(), indent=2))
    else:
        for check in proof.checks.values():
            if check.passed:
                typer.echo(f"pass [{check.name}] {check.message}")
        for check in proof.failures:
            typer.echo(f"mechwright: {program}: FAIL [{check.name}] {check.message}", err=True)
        typer.echo(f"{program}: " + ("proven" if proof.ok else "does not cut the part"))
    raise typer.Exit(0 if proof.ok else 1)
