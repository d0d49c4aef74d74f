"""The pages of the CAM room: drawings, programs, their proofs, and the setup sheets.

Nothing heavy is imported before one of them is made.
"""

import json
from typing import TYPE_CHECKING, cast, get_args

from mechwright.errors import DesignError
from mechwright.output.folder import distinct_files
from mechwright.pipeline import Build, FileName, Page, Wanted
from mechwright_cad.assembly_guide.page import HTML as GUIDE
from mechwright_cad.assembly_guide.page import AssemblyGuide
from mechwright_cad.bill.page import HTML as BILL
from mechwright_cad.bill.page import BillOfMaterials
from mechwright_cad.exporters import Curves, DxfExporter

if TYPE_CHECKING:
    from mechwright_cam.machining import Machining

SUMMARY = "setup.html"
"""The page of the whole job."""

PROOFS = "proof.json"
"""What the proofs say."""

COMMANDS = frozenset({"cam", "build"})
DOING = "drawings and programs"
SHARE = 60.0


def _machining(build: Build) -> "Machining":
    from mechwright_cam.machining import Machining

    return build.made(Machining)


class DrawingFiles(Page):
    """A drawing of every plate, and of every nest."""

    name = "drawings"
    commands = COMMANDS
    doing = DOING
    share = SHARE

    def names(self, build: Build, wanted: Wanted) -> list[FileName]:  # noqa: ARG002
        """Those of plates and nests."""
        from mechwright_cam.pages.file_names import drawing_names, machined

        machining = machined(build)
        return [] if machining is None else [*drawing_names(machining, DxfExporter.suffix)]

    def files(self, build: Build) -> dict[str, bytes]:
        """DXF by part; none where nothing is milled."""
        return build.made_as_wanted(drawings)


def drawings(build: Build) -> dict[str, bytes]:
    """The drawings of a build with programs, by file."""
    machining = _machining(build)
    drawing = DxfExporter(curve_kind(build.wanted.curves))
    parts = [*machining.plates, *machining.nests] if machining.proven_programs else []
    made = ((part.name + drawing.suffix, drawing.part(part)) for part in parts)
    return distinct_files((name, content) for name, content in made if content is not None)


class ProgramFiles(Page):
    """The programs, and the control's table of their tools."""

    name = "programs"
    commands = COMMANDS
    doing = DOING

    def names(self, build: Build, wanted: Wanted) -> list[FileName]:  # noqa: ARG002
        """Those of all programs that there may be."""
        from mechwright_cam.pages.file_names import machined, program_names

        machining = machined(build)
        return [] if machining is None else [*program_names(machining)]

    def files(self, build: Build) -> dict[str, str]:
        """Program text by file."""
        machining = _machining(build)
        if not machining.proven_programs:
            return {}
        suffix = machining.control.suffix
        texts = [pair for item in machining.proven_programs for pair in item.files.items()]
        texts += machining.probing.values()
        texts += [pair for texts in machining.measuring.values() for pair in texts.items()]
        files = [(stem + suffix, text) for stem, text in texts]
        return distinct_files([*files, machining.table] if machining.table[0] else files)


class ProofFile(Page):
    """``proof.json``."""

    name = "proofs"
    commands = COMMANDS
    doing = DOING

    def names(self, build: Build, wanted: Wanted) -> list[FileName]:  # noqa: ARG002
        """The one file."""
        return [FileName(PROOFS, "the proofs")]

    def files(self, build: Build) -> dict[str, str]:
        """Every check of every program by name."""
        from mechwright_cam.pages.seen import Seen

        proofs = build.made(Seen).proofs
        return {PROOFS: json.dumps(proofs, indent=2) + "\n"} if proofs else {}


class SetupSheets(Page):
    """A sheet for each program, and the page of the whole job."""

    name = "setup-sheets"
    commands = COMMANDS
    doing = DOING

    def names(self, build: Build, wanted: Wanted) -> list[FileName]:  # noqa: ARG002
        """One for each job, and the page of all."""
        from mechwright_cam.pages.file_names import machined, named
        from mechwright_cam.pages.setup_sheet import SHEET

        machining = machined(build)
        if machining is None:
            return []
        sheets = [
            named(machining, job, job.part.name, SHEET, "the setup sheet of ") for job in machining.jobs
        ]
        return [*sheets, FileName(SUMMARY, "the page of the whole job")]

    def files(self, build: Build) -> dict[str, str]:
        """HTML by file."""
        return build.made_as_wanted(setup_sheets)


def setup_sheets(build: Build) -> dict[str, str]:
    """The setup sheets of a build, and the page of the whole job, by file."""
    from mechwright_cam.pages.job import JOB
    from mechwright_cam.pages.seen import Seen
    from mechwright_cam.pages.setup_sheet import SHEET, setup_html, summary_html
    from mechwright_cam.pages.setup_sheet.raster import simulated_view
    from mechwright_cam.pages.setup_sheet.walls import walls_view

    machining, seen = _machining(build), build.made(Seen)
    if not machining.proven_programs:
        return {}
    control, table, design = machining.control, machining.table[0], build.path.name
    files = {item.program.name: list(item.files) for item in machining.proven_programs}
    made = {}
    for item, simulation, walls in seen.measured:
        name = item.program.name
        made[name + SHEET] = setup_html(
            item.job,
            item.program,
            seen.proofs[name],
            control,
            tool_table=table,
            design=design,
            picture=simulated_view(simulation, item.job),
            deviation=walls_view(walls, item.job),
            summary=SUMMARY,
            files=files[name],
            probing="".join(machining.probing.get(name, ("",))[:1]),
            measuring=tuple(machining.measuring.get(name, ())),
            played=name + JOB,
        )
    sheets = [(item.job, item.program, seen.proofs[item.program.name]) for item in machining.proven_programs]
    written = build.wanted.command in BillOfMaterials.commands
    made[SUMMARY] = summary_html(
        sheets,
        control,
        name=build.design.name,
        tool_table=table,
        design=design,
        files=files,
        bill=BILL if written else "",
        guide=GUIDE if AssemblyGuide().shown(build) else "",
        played=JOB,
    )
    return made


class JobPages(Page):
    """A page for each program, on which it is played on its stock."""

    name = "job-pages"
    commands = COMMANDS
    doing = DOING

    def names(self, build: Build, wanted: Wanted) -> list[FileName]:  # noqa: ARG002
        """One for each job."""
        from mechwright_cam.pages.file_names import machined, named
        from mechwright_cam.pages.job import JOB

        machining = machined(build)
        if machining is None:
            return []
        return [named(machining, job, job.part.name, JOB, "the job page of ") for job in machining.jobs]

    def files(self, build: Build) -> dict[str, str]:
        """HTML by file."""
        from mechwright_cam.pages.job import JOB
        from mechwright_cam.pages.job.page import job_html
        from mechwright_cam.pages.setup_sheet import SHEET

        return {
            item.program.name + JOB: job_html(
                item.scene, item.proof, ", ".join(item.files), item.program.name + SHEET
            )
            for item in _machining(build).proven_programs
        }


def curve_kind(text: str) -> Curves:
    """Read the option ``--dxf-curves``; raises DesignError that lists the kinds."""
    for kind in get_args(Curves):
        if kind == text:
            return cast(Curves, kind)
    raise DesignError(f"--dxf-curves: {text!r} is not known; one of: {', '.join(get_args(Curves))}")
