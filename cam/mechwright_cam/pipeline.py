"""From a design to drawings and proven programs: the order in which the CAM stage works."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import cast, get_args

import shapely

from mechwright.contracts.finding import Finding, Severity, errors
from mechwright.contracts.part import Part
from mechwright.design.design import Design
from mechwright.errors import DesignError, PluginError, ToolError
from mechwright.output.folder import Output
from mechwright.plugins.host import Host
from mechwright.plugins.host import host as default_host
from mechwright_cad.exporters import Curves, DxfExporter
from mechwright_cam.controls.contract import Post
from mechwright_cam.controls.reading import DIALECTS, LINUXCNC, Dialect
from mechwright_cam.operations.contract import Operation
from mechwright_cam.pages.setup_sheet import SHEET, setup_html, summary_html
from mechwright_cam.pages.setup_sheet.raster import simulated_view
from mechwright_cam.pages.setup_sheet.walls import walls_view
from mechwright_cam.planning import choose_tools, plan
from mechwright_cam.planning.assign import Assignments
from mechwright_cam.planning.cut import cut_outlines
from mechwright_cam.planning.nesting import arranged
from mechwright_cam.planning.setups import carried, lay_out_setups
from mechwright_cam.program.moves import Program
from mechwright_cam.proof import Proof, cut_away, prove, read
from mechwright_cam.proof.simulation import simulate
from mechwright_cam.proof.walls import wall_deviation
from mechwright_cam.setup.job import Job
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.setup.limits import check_machine
from mechwright_cam.setup.measured import check_measured
from mechwright_cam.setup.nest import Nest
from mechwright_cam.setup.sides import sides
from mechwright_cam.shop.library import Library, load_library
from mechwright_cam.shop.settings import CamSettings

SUMMARY = "setup.html"
"""The page of the whole job."""


@dataclass(frozen=True)
class Machined:
    """A part with its program and the proof of it."""

    job: Job
    program: Program
    files: dict[str, str]
    proof: Proof
    proven: str | dict[str, str]
    """What the proof has read: the text, or several files by name."""

    @property
    def text(self) -> str:
        """The program's text, all its files one after the other."""
        return "".join(self.files.values())


def plates(parts: Sequence[Part]) -> list[Part]:
    """The parts that are milled from a plate."""
    return [part for part in parts if part.outline is not None]


def prepare(
    design: Design, parts: Sequence[Part], assignments: Assignments | None = None
) -> tuple[list[Finding], list[Job]]:
    """Choose cutters and lay the parts into their stock; who cuts what is kept in ``assignments``.

    Returns
    -------
    findings
        What the cutters cannot do, and what the family says of the parts as they leave them.
    jobs
        One for each part, and one more where the underside is milled as well; fewer if a finding is an
        error.
    """
    assignments = assignments or Assignments()
    library = _library(design)
    cut_parts = arranged(design, parts, library, assignments)
    _check_part_names(design, (*parts, *cut_parts))
    findings: list[Finding] = []
    jobs: list[Job] = []
    for part in cut_parts:
        cam = design.cam_of(part.name)
        tools = library.cutting(cam.cutting).measured(cam.measured.lengths)
        laid, found = lay_out_setups(part, cam, tools, assignments)
        found = [*found, *(finding for job in laid for finding in check_machine(job))]
        findings += dict.fromkeys(found)  # two features may have the same to say
        if not errors(found):
            jobs += laid
    findings += check_measured(jobs)
    tops = [job for job in jobs if job.side == "top"]
    if len(tops) == len(cut_parts):
        copies: dict[str, list[shapely.Polygon]] = {}
        for job in tops:
            for name, outline in _cut_parts(job, assignments):
                copies.setdefault(name, []).append(outline)
        # The copies of a part in a nest may be left different by their neighbours: the family sees all.
        for number in range(max(map(len, copies.values()), default=0)):
            cut = {name: found[min(number, len(found) - 1)] for name, found in copies.items()}
            findings += [f for f in design.family.check_cut(design.params, cut) if f not in findings]
        findings += _unused_data(design, jobs)
    return findings, jobs


def _unused_data(design: Design, jobs: Sequence[Job]) -> list[Finding]:
    """Cutting data in the design for tools that no job has."""
    named = dict.fromkeys(name for cam in (design.cam, *design.part_cam.values()) for name in cam.cutting)
    used = {tool.name for job in jobs for tool in job.tools}
    return [
        Finding(
            "cam.cutting-unused",
            Severity.NOTE,
            f"cam.cutting.{name}",
            f"{name} is not used here, so its cutting data change nothing",
        )
        for name in named
        if name not in used
    ]


def _cut_parts(job: Job, assignments: Assignments | None = None) -> list[tuple[str, shapely.Polygon]]:
    """Name of each part of a job, and what the cutters leave of it, in its own coordinates."""
    cut = [_in_part_coordinates(outline, job) for outline in cut_outlines(job, assignments)]
    if isinstance(job.part, Nest):
        return [(one.part.name, one.back(left)) for one, left in zip(job.part.placed, cut, strict=True)]
    return [(job.part.name, cut[0])]


def _library(design: Design) -> Library:
    """The cutters at hand; the name of one that is none of them is a mistake in the file."""
    library = load_library(design.tool_library)
    tables = {"cam": design.cam, **{f"cam.part.{name}": cam for name, cam in design.part_cam.items()}}
    for where, cam in tables.items():
        named = {"tools": cam.tools, "cutting": cam.cutting, "measured.lengths": cam.measured.lengths}
        for key, name in ((key, name) for key, names in named.items() for name in names):
            try:
                library.get(name)
            except ToolError as error:
                raise ToolError(f"{design.path}: {where}.{key}: {error}") from error
    return library.cutting(design.cam.cutting)


def _check_part_names(design: Design, parts: Sequence[Part]) -> None:
    """Refuse a table ``[cam.part.NAME]`` of no plate part."""
    known = sorted({part.name for part in parts})
    for name in design.part_cam:
        if name not in known:
            raise DesignError(
                f"{design.path}: cam.part.{name}: no plate part has this name; "
                f"there is: {', '.join(known) or 'none'}"
            )


def _in_part_coordinates(polygon: shapely.Polygon, job: Job) -> shapely.Polygon:
    return shapely.transform(polygon, lambda points: points + job.origin)


def curve_kind(text: str) -> Curves:
    """Read the option ``--dxf-curves``; raises DesignError that lists the kinds."""
    for kind in get_args(Curves):
        if kind == text:
            return cast(Curves, kind)
    raise DesignError(f"--dxf-curves: {text!r} is not known; one of: {', '.join(get_args(Curves))}")


def _post(design: Design, host: Host) -> Post:
    try:
        return host.post(design.cam.control)
    except PluginError as error:
        raise PluginError(f"{design.path}: cam.control: {error}") from error


def check(design: Design, host: Host, operations: Sequence[Operation] = ()) -> list[Finding]:
    """Find out whether the chosen cutters can make the parts, and what they leave.

    A design may ask for ``operations`` besides the built-in ones by their names.
    """
    post = _post(design, host)
    parts = plates(design.family.parts(design.params))
    findings, jobs = prepare(design, parts, Assignments(operations))
    return _control(post, design.cam, jobs) + findings


def _control(post: Post, cam: CamSettings, jobs: Sequence[Job]) -> list[Finding]:
    """What the control cannot do, for both sides."""
    every = [cam, *(job.settings for job in jobs)]
    return list(dict.fromkeys(finding for settings in every for finding in post.check(settings)))


def second_setup(first: Machined, job: Job, post: Post) -> Job:
    """The second setup of a part, with what the first one has left of the plate."""
    cut = cut_away(first.proven, first.job, dialect_of(post))
    return replace(job, gone=carried(cut, first.job, job))


def machine(job: Job, post: Post, place: int = 0, assignments: Assignments | None = None) -> Machined:
    """Plan a program, post it, and prove the posted text.

    Who cuts what is taken from ``assignments``, if it has been decided. Programs of one design that have
    numbers are told apart by their ``place``.

    Raises
    ------
    ToolError
        A cutter that the work needs is not there.
    ProofError
        The program would not cut the right part.
    """
    cam = job.settings
    measured = Library(job.tools).measured(cam.measured.lengths).tools
    if measured != job.tools:
        job = replace(job, tools=measured)
    posting = cam.post.model_copy(update={"program_number": cam.post.program_number + place})
    program = replace(plan(job, assignments), machine=cam.machine, posting=posting, measured=cam.measured)
    files = post.files(program)
    named = {name + post.suffix: text for name, text in files.items()}
    text = named if len(files) > 1 else next(iter(files.values()))
    proof = prove(text, job, dialect_of(post))
    proof.require()
    return Machined(job, program, files, proof, text)


def dialect_of(post: Post) -> Dialect:
    """How the post's control reads a program; raises PluginError if the post names none that is known."""
    try:
        return DIALECTS[post.dialect]
    except KeyError:
        raise PluginError(
            f"post {post.name!r} names the dialect {post.dialect!r}; known: {', '.join(DIALECTS)}"
        ) from None


def cut_parts(design: Design) -> dict[str, Part]:
    """Every part of a design by its name, and the nests of its plates."""
    parts = design.family.parts(design.params)
    return {part.name: part for part in (*parts, *arranged(design, plates(parts), _library(design)))}


def write_programs(
    design: Design, host: Host, output: Output, curves: str, operations: Sequence[Operation] = ()
) -> list[Finding]:
    """Add drawing, program, tool table, setup sheet and proof of every plate part to ``output``.

    Findings come back; nothing is added if one of them is an error, or if no part is a plate. A design may
    ask for ``operations`` besides the built-in ones by their names.
    """
    post = _post(design, host)
    drawing = DxfExporter(curve_kind(curves))
    parts = plates(design.family.parts(design.params))
    assignments = Assignments(operations)
    findings, jobs = prepare(design, parts, assignments)
    findings = [*_control(post, design.cam, jobs), *findings]
    if errors(findings) or not jobs:
        return findings
    if {"control", "wear"} <= {job.settings.compensation for job in jobs}:
        raise DesignError(
            f'{design.path}: cam.compensation: "control" and "wear" in one job would ask D for two things at '
            "once; use one of them"
        )
    made: list[Machined] = []
    for place, job in enumerate(jobs):
        laid = job
        if job.side == "underside":  # what the first side leaves changes how it is cut, and not by whom
            laid = assignments.carry(job, second_setup(made[-1], job, post))
        made.append(machine(laid, post, place, assignments))
    nests = [job.part for job in jobs if isinstance(job.part, Nest)]
    for part in (*parts, *nests):
        output.add(f"{part.name}{drawing.suffix}", drawing.part(part))
    for item in made:
        for stem, text in item.files.items():
            output.add(f"{stem}{post.suffix}", text)
    tools = {tool.number: tool for item in made for tool in item.program.tools}
    listed = [tools[number] for number in sorted(tools)]
    compensated = next((job.settings for job in jobs if job.settings.compensation != "computer"), None)
    table, text = post.offset_table(listed, compensated) if compensated else post.tool_table(listed)
    if table:
        output.add(table, text)
    runs = {item.program.name: read(item.proven, item.job, dialect_of(post)) for item in made}
    seen = {item.program.name: simulate(runs[item.program.name], item.job) for item in made}
    walls = {item.program.name: wall_deviation(runs[item.program.name], item.job) for item in made}
    proofs = {
        item.program.name: {
            **item.proof.as_dict(),
            "simulation": seen[item.program.name].as_dict(),
            "walls": walls[item.program.name].as_dict(),
        }
        for item in made
    }
    output.add("proof.json", json.dumps(proofs, indent=2) + "\n")
    sheets = [(item.job, item.program, proofs[item.program.name]) for item in made]
    pictures = {item.program.name: simulated_view(seen[item.program.name], item.job) for item in made}
    deviations = {item.program.name: walls_view(walls[item.program.name], item.job) for item in made}
    named = {"suffix": post.suffix, "tool_table": table, "design": design.path.name}
    files = {item.program.name: list(item.files) for item in made}
    for sheet in sheets:
        page = setup_html(
            [sheet], **named, pictures=pictures, deviations=deviations, summary=SUMMARY, files=files
        )
        output.add(sheet[1].name + SHEET, page)
    output.add(SUMMARY, summary_html(sheets, name=design.name, **named, files=files))
    return findings


def verify(
    design: Design,
    part: Part,
    text: str | Mapping[str, str],
    host: Host | None = None,
    control: str = "",
    *,
    underside: bool = False,
    operations: Sequence[Operation] = (),
) -> Proof:
    """Prove a program that came from anywhere, with every cutter of the library at hand.

    It is one text, or several files by name in the order they are run. It is read as ``control`` reads it, or
    else the control of the design file. It cuts the first side of the part, or its underside.
    """
    dialect = LINUXCNC
    if host is not None:
        dialect = dialect_of(_post(design, host))
    if control:
        try:
            dialect = (
                DIALECTS[control] if control in DIALECTS or host is None else dialect_of(host.post(control))
            )
        except (KeyError, PluginError):
            known = sorted({*DIALECTS, *(host.posts if host else ())})
            raise PluginError(f"--control: {control!r} is not known; one of: {', '.join(known)}") from None
    cam, assignments = design.cam_of(part.name), Assignments(operations)
    library = _library(design).cutting(cam.cutting)
    parts = plates(design.family.parts(design.params))
    _check_part_names(design, (*parts, *arranged(design, parts, library, assignments)))
    _, under = sides(part)
    if underside or under:
        jobs, found = lay_out_setups(part, cam, library, assignments)
        chosen = [job for job in jobs if (job.side == "underside") == underside]
        if errors(found) or not chosen:
            fault = str(errors(found)[0]) if errors(found) else f"part {part.name} is cut from above only"
            raise DesignError(f"{design.path}: {fault}")
        (job,) = chosen
        if underside:  # on the plate as our own program for the first side leaves it
            post = _post(design, host or default_host())
            job = second_setup(machine(jobs[0], post, assignments=assignments), job, post)
    else:
        job = make_job(part, cam, choose_tools(part, cam, library, assignments))
    tools = library.measured(cam.measured.lengths).tools
    return prove(text, replace(job, tools=tools), dialect)
