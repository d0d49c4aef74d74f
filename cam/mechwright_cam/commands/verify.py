"""Proving programs that come from anywhere."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import typer

from mechwright.cli.hosting import open_host
from mechwright.cli.perform import refuse
from mechwright.cli.progress import fraction
from mechwright.cli.telling import echo
from mechwright.contracts.finding import errors
from mechwright.contracts.synthesis import Progress
from mechwright.designs.files import SIZE_LIMIT, read_text
from mechwright.errors import DesignError, PluginError, ProgramError
from mechwright.output.folder import write_new
from mechwright.pipeline import Build, Wanted
from mechwright.pipeline.process import plates_of
from mechwright_cam.commands.verify_drawing import drawn_scene, job_of
from mechwright_cam.controls.contract import Control
from mechwright_cam.machining import Machining, machine, second_setup
from mechwright_cam.planning import choose_tools
from mechwright_cam.planning.prepare import Preparation
from mechwright_cam.planning.setups import UNDERSIDE, lay_out_setups
from mechwright_cam.proof.found_tabs import with_found_tabs
from mechwright_cam.proof.judge import judge
from mechwright_cam.proof.report import Proof
from mechwright_cam.proof.rules import Rule
from mechwright_cam.proof.scene import Scene
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.setup.sides import sides
from mechwright_cam.shop.table import settings_of

PROGRAM_SIZE_LIMIT = 100 * SIZE_LIMIT
"""Bytes: surfacing programs are long, but not longer than this."""


@dataclass(frozen=True)
class Report:
    """What is told of a program, and where."""

    as_json: bool = False
    page: Path | None = None
    """An HTML page to write."""
    job: Path | None = None
    """A page to write on which the program is played on its stock."""


def verify(programs: Sequence[Path], path: Path, part_name: str, report: Report, control: str = "") -> None:
    """Prove a program in one file, or in several that are run in order; exit code 1 if it is not proven."""
    with Build(path, open_host(), Wanted("verify")) as build:
        _ = build.design
        text, program = read_programs(programs)
        with fraction() as progress:
            progress(0.0, "checking the design")
            if not (stopping := errors(build.findings)):
                scene, rules = scene_of(build, part_name, text, control)
                proof = judged(scene, rules, program, _after(CHECKED, progress))
        if stopping:
            refuse(stopping, path)
        report_proof(scene, proof, program, report)


CHECKED = 0.5
"""Part of the work that is done when the design is checked and its part laid out: as measured on a gear."""


def _after(share: float, progress: Progress) -> Progress:
    """The progress of what comes after a share of the work."""
    return lambda done, what: progress(share + (1 - share) * done, what)


def verify_drawing(programs: Sequence[Path], dxf: Path, report: Report, **wanted: Any) -> None:
    """Prove a program against a drawing; ``wanted`` is what :func:`verify_drawing.job_of` takes."""
    text, program = read_programs(programs)
    scene, rules = drawn_scene(text, job_of(dxf, **wanted), open_host())
    with fraction() as progress:
        proof = judged(scene, rules, program, progress)
    report_proof(scene, proof, program, report)


def read_programs(programs: Sequence[Path]) -> tuple[str | dict[str, str], str]:
    """One text, or several by their files' names; and what to call them."""
    # Comments may be of any age.
    texts = {
        str(file): read_text(file, PROGRAM_SIZE_LIMIT, older="latin-1", mark=True)[0] for file in programs
    }
    if len(texts) < len(programs):
        raise DesignError("PROGRAM: a file is named twice; name each once, in the order they are run")
    program, *rest = texts
    return (texts, f"{program} to {rest[-1]}") if rest else (texts[program], program)


def judged(scene: Scene, rules: Sequence[Rule], program: str, progress: Progress) -> Proof:
    """What the rules say of a program; raises ProgramError that names its file where it cannot be read."""
    try:
        return judge(scene, rules, progress)
    except ProgramError as error:  # of several files it names the one
        raise ProgramError(f"{program}: {error}" if isinstance(scene.text, str) else str(error)) from error


def report_proof(scene: Scene, proof: Proof, program: str, report: Report) -> None:
    """Tell what was found, and end with exit code 1 if the program is not proven."""
    if report.page is not None:
        from mechwright_cam.pages.report.report import report_html

        write_new(report.page, report_html(with_found_tabs(scene), proof, program), replace=True)
    if report.job is not None:
        from mechwright_cam.pages.job.page import job_html

        write_new(report.job, job_html(with_found_tabs(scene), proof, program), replace=True)
    if report.as_json:
        typer.echo(json.dumps(proof.as_dict(), indent=2))
    else:
        for check in proof.checks.values():
            if check.passed:
                echo(f"pass [{check.name}] {check.message}")
        for note in proof.notes:
            echo(f"note {note}")
        for check in proof.failures:
            echo(f"mechwright: {program}: FAIL [{check.name}] {check.message}", err=True)
        echo(f"{program}: " + ("proven" if proof.ok else "does not cut the part"))
    raise typer.Exit(0 if proof.ok else 1)


def scene_of(
    build: Build, part_name: str, text: str | Mapping[str, str], control: str = ""
) -> tuple[Scene, list[Rule]]:
    """A program and one part of a design, with every cutter of the library at hand, and the rules.

    Parameters
    ----------
    build
        Of the design.
    part_name
        A part or nest; with ``-underside`` behind it, its second side.
    text
        One text, or several files by name in the order they are run.
    control
        Name of the control that reads it; by default that of the design.
    """
    design = build.design
    assignments = build.made(Machining).assignments
    preparation = Preparation(design, plates_of(build.parts), assignments)
    known = {part.name: part for part in (*build.parts, *preparation.cut)}
    name = part_name if part_name in known else part_name.removesuffix(UNDERSIDE)
    if name not in known:
        raise DesignError(
            f"--part: {part_name!r} is no part of {design.path}; it has: {', '.join(sorted(known))}"
        )
    reader, rules = _reader(build, control), build.host.all(Rule)
    part, underside = known[name], name != part_name
    cam = preparation.settings.of(part.name)
    library = preparation.library.cutting(cam.cutting)
    if underside or sides(part)[1]:
        jobs, found = lay_out_setups(part, cam, library, assignments)
        chosen = [job for job in jobs if (job.side == "underside") == underside]
        if errors(found) or not chosen:
            fault = str(errors(found)[0]) if errors(found) else f"part {part.name} is cut from above only"
            raise DesignError(f"{design.path}: {fault}")
        (job,) = chosen
        if underside:  # on the plate as our own program for the first side leaves it
            own = build.made(Machining).control
            job = second_setup(machine(jobs[0], own, assignments=assignments, rules=rules), job)
    else:
        job = make_job(part, cam, choose_tools(part, cam, library, assignments))
    job = replace(job, tools=library.measured(cam.measured.lengths).tools)
    return Scene(text, job, reader), rules


def _reader(build: Build, name: str) -> Control:
    """The control that reads the program."""
    if not name:
        return build.made(Machining).control
    try:
        units = settings_of(build.design).cam.post.units
        return build.host.get(Control, name).speaking(units or "mm")
    except PluginError:
        known = ", ".join(sorted(build.host.of(Control)))
        raise PluginError(f"--control: {name!r} is not known; one of: {known}") from None
