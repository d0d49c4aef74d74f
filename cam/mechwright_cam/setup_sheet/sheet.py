"""The setup sheet as one HTML page. Imports jinja2."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import jinja2
from markupsafe import Markup

from mechwright.program import Program
from mechwright_cam.job import Job
from mechwright_cam.picture import plan_view
from mechwright_cam.setup_sheet import facts
from mechwright_cam.setup_sheet.levels import side_view
from mechwright_cam.setup_sheet.procedure import origin_words, steps
from mechwright_cam.svg import signed
from mechwright_cam.trace import trace


def setup_html(
    job: Job,
    program: Program,
    proof: Mapping[str, Any] | None = None,
    *,
    file_name: str = "",
    tool_table: str = "",
    design: str = "",
) -> str:
    """The setup sheet of one program.

    Parameters
    ----------
    job
        What is made, from what, and how it is held.
    program
        What the mill does.
    proof
        The contents of ``proof.json`` for this program; keys that are missing are left out of the sheet, and
        without a proof the sheet says that the program is not proven.
    file_name
        The program's file; by default its name.
    tool_table
        The file of the control's tool table; empty if there is none.
    design
        The design file it all comes from.

    Returns
    -------
    html
        A page that needs no other file and no network, and prints on A4. The same input gives the same text.
    """
    proof = proof or {}
    traced = trace(program)
    operations = facts.operation_rows(program, traced, proof)
    tools = facts.tool_rows(job, program, traced, proof)
    spots = facts.spot_rows(proof)
    marks = [(spot["x"] or 0.0, spot["y"] or 0.0) for spot in spots]
    deepest = min((row.bottom for row in tools), default=0.0)
    file_name = file_name or program.name
    return _template().render(
        job=job,
        program=program,
        proof=proof,
        verdict=facts.verdict(proof),
        checks=facts.check_rows(proof),
        spots=spots,
        tools=tools,
        operations=operations,
        steps=steps(job, [row.tool.number for row in tools], file_name=file_name, deepest=deepest),
        origin=origin_words(job),
        # Our own markup; all text in it is escaped where it is made.
        plan=Markup(plan_view(job, program, marks, traced)),  # noqa: S704
        side=Markup(side_view(job, program, deepest)),  # noqa: S704
        file_name=file_name,
        tool_table=tool_table,
        design=design,
        duration=facts.duration,
        signed=signed,
    )


def _template() -> jinja2.Template:
    environment = jinja2.Environment(
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    return environment.from_string(Path(__file__).with_name("template.html").read_text("utf-8"))
