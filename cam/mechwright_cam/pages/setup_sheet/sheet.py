"""The setup sheets of a design as one HTML page. Imports jinja2."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import jinja2
from markupsafe import Markup

from mechwright_cam.controls.contract import Control
from mechwright_cam.pages.picture import plan_view
from mechwright_cam.pages.setup_sheet import facts
from mechwright_cam.pages.setup_sheet.compensation import value
from mechwright_cam.pages.setup_sheet.levels import side_view
from mechwright_cam.pages.setup_sheet.procedure import datum_edges, origin_words, quantity, steps
from mechwright_cam.pages.svg import signed
from mechwright_cam.pages.trace import trace
from mechwright_cam.program.moves import Program
from mechwright_cam.setup.job import Job


def setup_html(
    programs: Sequence[tuple[Job, Program, Mapping[str, Any] | None]],
    control: Control,
    *,
    tool_table: str = "",
    design: str = "",
    pictures: Mapping[str, str] | None = None,
    deviations: Mapping[str, str] | None = None,
    summary: str = "",
    files: Mapping[str, Sequence[str]] | None = None,
) -> str:
    """The setup sheets of some programs.

    Parameters
    ----------
    programs
        For each program what is made, from what, and how it is held; what the mill does; and its part of
        ``proof.json``. Keys that the proof lacks are left out of the sheet, and without a proof the sheet
        says that the program is not proven.
    control
        The control that reads them.
    tool_table
        The file of the control's tool table; empty if there is none.
    design
        The design file it all comes from.
    pictures
        Program name to the picture of its simulated stock, an ``<svg>`` element of our own.
    deviations
        Program name to the picture of the deviation along its walls, the same.
    summary
        The page of the whole job, which a sheet then leads to.
    files
        Program name to the names of its files in order, without their ending; by default one of its own name.

    Returns
    -------
    html
        A page that needs no other file and no network, and prints on A4. The same input gives the same text.
    """
    pages = environment()
    template = pages.get_template("sheet.html")
    sheets = []
    for job, program, proof in programs:
        sheet = _sheet(job, control, program, proof or {}, file_names(program, control.suffix, files))
        sheet["simulated"] = Markup((pictures or {}).get(program.name, ""))  # noqa: S704 - our own markup
        sheet["deviation"] = Markup((deviations or {}).get(program.name, ""))  # noqa: S704 - ours as well
        sheet["places"] = facts.place_rows(proof or {})
        table_words = control.table_words(tool_table) if tool_table else ""
        body = template.render(**sheet, table_words=table_words, design=design)
        sheets.append({**sheet, "body": Markup(body)})  # noqa: S704 - the template has escaped it
    titles = [job.part.name for job, _, _ in programs]
    return pages.get_template("page.html").render(sheets=sheets, titles=titles, summary=summary)


def file_names(program: Program, suffix: str, files: Mapping[str, Sequence[str]] | None) -> list[str]:
    """The names of a program's files in order; see :func:`setup_html`."""
    return [name + suffix for name in (files or {}).get(program.name, [program.name])]


def span(names: Sequence[str]) -> str:
    """Names of files in few words."""
    return names[0] if len(names) == 1 else f"{names[0]} to {names[-1]}"


def _sheet(
    job: Job, control: Control, program: Program, proof: Mapping[str, Any], names: Sequence[str]
) -> dict[str, Any]:
    """What the template of one sheet shows."""
    traced = trace(program)
    tools = facts.tool_rows(job, program, traced, proof)
    spots = facts.spot_rows(proof)
    marks = [(spot["x"] or 0.0, spot["y"] or 0.0) for spot in spots]
    offsets = {offset.tool.number: offset for offset in control.offsets.of_program(program)}
    deepest = min((row.bottom for row in tools), default=0.0)
    return {
        "job": job,
        "program": program,
        "proof": proof,
        "verdict": facts.verdict(proof),
        "checks": facts.check_rows(proof),
        "spots": spots,
        "tools": tools,
        "operations": facts.operation_rows(program, traced, proof),
        "offsets": offsets,
        "loads": facts.load_rows(proof),
        "steps": steps(
            job,
            control,
            [row.tool.number for row in tools],
            file_names=names,
            deepest=deepest,
            reach=facts.reach(traced),
            offsets=tuple(offsets.values()),
            by_file=program.posting.tool_change == "files",
        ),
        "origin": origin_words(job),
        "edges": datum_edges(job),
        "quantity": quantity(job),
        "control": control.name,
        "by_hand": not control.offsets.lengths,
        # Our own markup; all text in it is escaped where it is made.
        "plan": Markup(plan_view(job, program, marks, traced)),  # noqa: S704
        "side": Markup(side_view(job, program, deepest)),  # noqa: S704
        "file_name": span(names),
    }


def environment() -> jinja2.Environment:
    """The templates of this folder, with the functions that they use."""
    found = jinja2.Environment(
        loader=jinja2.FileSystemLoader(Path(__file__).parent),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    found.globals.update(duration=facts.duration, signed=signed, d_value=value)
    return found
