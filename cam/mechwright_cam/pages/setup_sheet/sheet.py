"""The setup sheet of a program as an HTML page. Imports jinja2."""

from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import jinja2
from markupsafe import Markup

from mechwright.output.templates import templates
from mechwright_cam.controls.contract import Control
from mechwright_cam.pages.picture import plan_view
from mechwright_cam.pages.picture.isometric import isometric_view
from mechwright_cam.pages.setup_sheet import facts
from mechwright_cam.pages.setup_sheet.compensation import value
from mechwright_cam.pages.setup_sheet.hand_machine import by_hand_lines, room_of
from mechwright_cam.pages.setup_sheet.inspection import inspection
from mechwright_cam.pages.setup_sheet.levels import side_view
from mechwright_cam.pages.setup_sheet.procedure import steps
from mechwright_cam.pages.setup_sheet.several import quantity_text
from mechwright_cam.pages.setup_sheet.zero import datum_edges, origin_words
from mechwright_cam.pages.trace import trace
from mechwright_cam.program.moves import Program
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.lengths import Lengths


def setup_html(
    job: Job,
    program: Program,
    proof: Mapping[str, Any] | None,
    control: Control,
    *,
    tool_table: str = "",
    design: str = "",
    picture: str = "",
    deviation: str = "",
    summary: str = "",
    files: Sequence[str] = (),
    probing: str = "",
    measuring: Sequence[str] = (),
    played: str = "",
) -> str:
    """The setup sheet of a program: a page that needs no other file and no network, and prints on A4.

    Parameters
    ----------
    job, program
        What is made, from what, and how it is held; what the mill does.
    proof
        The program's part of ``proof.json``. Keys that it lacks are left out of the sheet, and without a
        proof the sheet says that the program is not proven.
    control
        The control that reads it.
    tool_table
        The file of the control's tool table; empty if there is none.
    design
        The design file it all comes from.
    picture, deviation
        The simulated stock, and the deviation along the walls, ``<svg>`` elements of our own.
    summary
        The page of the whole job, to which the sheet leads.
    played
        The page that plays the program, to which the sheet leads.
    files
        The names of the program's files in order, without their ending; by default one of its own name.
    probing
        The name of the program that probes its zero, without its ending; empty if there is none.
    measuring
        The names of the programs that measure its tools, in order.
    """
    proof, names = proof or {}, file_names(program, control.suffix, files)
    traced = trace(program)
    to = Lengths(control.units)
    tools = facts.tool_rows(job, program, traced, proof, to)
    spots = proof.get("unreachable") or ()
    marks = [(spot["x"], spot["y"]) for spot in spots]
    offsets = {offset.tool.number: offset for offset in control.offsets.of_program(program)}
    deepest = min((row.bottom for row in tools), default=0.0)
    shown = {
        "job": job,
        "program": program,
        "proof": proof,
        "verdict": facts.verdict(proof),
        "checks": facts.check_rows(proof),
        "spots": spots,
        "places": facts.place_rows(proof),
        "tools": tools,
        "operations": facts.operation_rows(program, traced, proof),
        "offsets": offsets,
        "loads": proof.get("simulation", {}).get("tools", ()),
        "steps": steps(
            job,
            control,
            [row.tool.number for row in tools],
            file_names=names,
            deepest=deepest,
            reach=facts.reach(traced),
            offsets=tuple(offsets.values()),
            probing=probing + control.suffix if probing else "",
            measuring=[name + control.suffix for name in measuring],
            by_file=program.posting.tool_change == "files",
            by_hand=tuple(
                by_hand_lines(
                    job,
                    room_of(traced, program.clearance),
                    {section.tool.number: section.spindle for section in program.sections},
                    to,
                )
            ),
        ),
        "origin": origin_words(job),
        "edges": datum_edges(job, to),
        "inspection": inspection(job, to),
        **words(to),
        "quantity": quantity_text(job),
        "control": control.name,
        "by_hand": not control.offsets.lengths,
        "length_place": control.length_place,
        "length_words": control.length_words,
        "offset_words": control.offset_words,
        "offset_name": ", ".join(map(control.offset_words, program.offsets)),
        "table_words": control.table_words(tool_table) if tool_table else "",
        "design": design,
        "summary": summary,
        "played": played,
        "file_name": span(names),
        # Our own markup; all text in it is escaped where it is made.
        "plan": Markup(plan_view(job, program, traced, marks, control.units)),  # noqa: S704
        "side": Markup(side_view(job, program, deepest, to)),  # noqa: S704
        "iso": Markup(isometric_view(job)),  # noqa: S704
        "simulated": Markup(picture),  # noqa: S704
        "deviation": Markup(deviation),  # noqa: S704
    }
    return environment().get_template("page.html").render(shown)


def words(to: Lengths) -> dict[str, Any]:
    """How the templates write lengths."""
    return {
        "unit": to.unit,
        "unit_name": "mm" if to.units == "mm" else "inches",
        "signed": to.signed,
        "fixed": to.fixed,
        "plain": to.plain,
        "coarse": 2 if to.units == "mm" else 1,  # digits that a narrow table has room for
        "size": to.size,
        "d_value": partial(value, to=to),
    }


def file_names(program: Program, suffix: str, files: Sequence[str]) -> list[str]:
    """The names of a program's files in order; see :func:`setup_html`."""
    return [name + suffix for name in files or [program.name]]


def span(names: Sequence[str]) -> str:
    """Names of files in few words."""
    return names[0] if len(names) == 1 else f"{names[0]} to {names[-1]}"


def environment(*folders: Path) -> jinja2.Environment:
    """The templates of some folders and of this one, with the functions that they use."""
    found = templates(*folders, Path(__file__).parent)
    found.globals.update(duration=facts.duration)
    return found
