"""From a design to drawings and proven programs: the order in which the CAM stage works."""

import json
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import cast, get_args

import shapely

from mechwright.design import Design
from mechwright.errors import DesignError, PluginError, ToolError
from mechwright.files import Output
from mechwright.findings import Finding, errors
from mechwright.host import Host
from mechwright.output import Post
from mechwright.part import Part
from mechwright.program import Program
from mechwright.tooling import CamSettings, Tool
from mechwright_cam.exporters import Curves, DxfExporter
from mechwright_cam.interpreter import DIALECTS, LINUXCNC, Dialect
from mechwright_cam.job import Job, make_job
from mechwright_cam.library import Library, load_library
from mechwright_cam.planning import choose_tools, lay_out, plan
from mechwright_cam.proof import Proof, prove
from mechwright_cam.reach import cut_outline
from mechwright_cam.setup_sheet import setup_html


@dataclass(frozen=True)
class Machined:
    """A part with its program and the proof of it."""

    job: Job
    program: Program
    files: dict[str, str]
    proof: Proof

    @property
    def text(self) -> str:
        """The program's text, all its files one after the other."""
        return "".join(self.files.values())


def plates(parts: Sequence[Part]) -> list[Part]:
    """The parts that are milled from a plate."""
    return [part for part in parts if part.outline is not None]


def prepare(design: Design, parts: Sequence[Part]) -> tuple[list[Finding], list[Job]]:
    """Choose cutters and lay the parts into their stock.

    Returns
    -------
    findings
        What the cutters cannot do, and what the family says of the parts as they leave them.
    jobs
        One for each part; fewer if a finding is an error.
    """
    library = _library(design)
    findings: list[Finding] = []
    jobs = []
    for part in parts:
        job, found = lay_out(part, design.cam, library)
        findings += dict.fromkeys(found)  # two features may have the same to say
        if job is not None and not errors(found):
            jobs.append(job)
    if len(jobs) == len(parts):
        cut = {job.part.name: _in_part_coordinates(cut_outline(job), job) for job in jobs}
        findings += design.family.check_cut(design.params, cut)
    return findings, jobs


def _library(design: Design) -> Library:
    """The cutters at hand; a name in ``cam.tools`` that is none of them is a mistake in the file."""
    library = load_library(design.tool_library)
    for name in design.cam.tools:
        try:
            library.get(name)
        except ToolError as error:
            raise ToolError(f"{design.path}: cam.tools: {error}") from error
    return library


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


def check(design: Design, host: Host) -> list[Finding]:
    """Find out whether the chosen cutters can make the parts, and what they leave."""
    found = list(_post(design, host).check(design.cam))
    return found + prepare(design, plates(design.family.parts(design.params)))[0]


def machine(job: Job, post: Post, place: int = 0) -> Machined:
    """Plan a program, post it, and prove the posted text.

    Programs of one design that have numbers are told apart by their ``place``.

    Raises
    ------
    ToolError
        A cutter that the work needs is not there.
    ProofError
        The program would not cut the right part.
    """
    cam = job.settings
    job = replace(job, tools=tuple(_measured(tool, cam) for tool in job.tools))
    posting = cam.post.model_copy(update={"program_number": cam.post.program_number + place})
    program = replace(plan(job), machine=cam.machine, posting=posting, measured=cam.measured)
    files = post.files(program)
    named = {name + post.suffix: text for name, text in files.items()}
    proof = prove(named if len(files) > 1 else next(iter(files.values())), job, dialect_of(post))
    proof.require()
    return Machined(job, program, files, proof)


def _measured(tool: Tool, cam: CamSettings) -> Tool:
    """The tool with the length that the design file gives it."""
    length = cam.measured.lengths.get(tool.name, tool.length)
    return tool if length == tool.length else tool.model_copy(update={"length": length})


def dialect_of(post: Post) -> Dialect:
    """How the post's control reads a program; raises PluginError if the post names none that is known."""
    try:
        return DIALECTS[post.dialect]
    except KeyError:
        raise PluginError(
            f"post {post.name!r} names the dialect {post.dialect!r}; known: {', '.join(DIALECTS)}"
        ) from None


def write_programs(design: Design, host: Host, output: Output, curves: str) -> list[Finding]:
    """Add drawing, program, tool table, setup sheet and proof of every plate part to ``output``.

    Findings come back; nothing is added if one of them is an error, or if no part is a plate.
    """
    post = _post(design, host)
    drawing = DxfExporter(curve_kind(curves))
    findings, jobs = prepare(design, plates(design.family.parts(design.params)))
    findings = [*post.check(design.cam), *findings]
    if errors(findings) or not jobs:
        return findings
    made = [machine(job, post, place) for place, job in enumerate(jobs)]
    for item in made:
        name = item.job.part.name
        output.add(f"{name}{drawing.suffix}", drawing.part(item.job.part))
        for stem, text in item.files.items():
            output.add(f"{stem}{post.suffix}", text)
    tools = {tool.number: tool for item in made for tool in item.program.tools}
    table, text = post.tool_table([tools[number] for number in sorted(tools)])
    if table:
        output.add(table, text)
    proofs = {item.program.name: item.proof.as_dict() for item in made}
    output.add("proof.json", json.dumps(proofs, indent=2) + "\n")
    sheets = [(item.job, item.program, proofs[item.program.name]) for item in made]
    page = setup_html(sheets, suffix=post.suffix, tool_table=table, design=design.path.name)
    output.add("setup.html", page)
    return findings


def verify(design: Design, part: Part, text: str, host: Host | None = None, control: str = "") -> Proof:
    """Prove a program that came from anywhere, with every cutter of the library at hand.

    It is read as ``control`` reads it, or else the control of the design file.
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
    library = _library(design)
    job = make_job(part, design.cam, choose_tools(part, design.cam, library))
    tools = tuple(_measured(tool, design.cam) for tool in library.tools)
    return prove(text, replace(job, tools=tools), dialect)
