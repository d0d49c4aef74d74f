"""The page of a whole job: its programs, the tools of all of them, times and proofs. Imports jinja2."""

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any

from mechwright_cam.controls.contract import Control
from mechwright_cam.pages.setup_sheet import facts
from mechwright_cam.pages.setup_sheet.several import quantity, runs
from mechwright_cam.pages.setup_sheet.sheet import environment, file_names, span, words
from mechwright_cam.pages.trace import trace
from mechwright_cam.program.moves import Program
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.lengths import Lengths
from mechwright_cam.shop.settings import Sheet
from mechwright_cam.shop.tool import Tool

SHEET = ".setup.html"
"""Ending of the sheet of one program."""

_FIGURES = ("gouge_max_mm", "leftover_reachable_max_mm", "unreachable_area_mm2", "unreachable_max_mm")
"""What the page shows of a proof, in the order of its columns."""


def summary_html(
    programs: Sequence[tuple[Job, Program, Mapping[str, Any] | None]],
    control: Control,
    *,
    name: str,
    tool_table: str = "",
    design: str = "",
    files: Mapping[str, Sequence[str]] = MappingProxyType({}),
    bill: str = "",
    guide: str = "",
    played: str = "",
) -> str:
    """The page of a whole job; it leads to the sheet of each program.

    For each program there are its job, itself and its proof, as for
    :func:`mechwright_cam.pages.setup_sheet.setup_html`; ``files`` has the names of its files by its own name.
    ``bill`` is the name of the bill of materials, ``guide`` that of the page of the assembly, where they are
    written, ``played`` the ending of the pages that play the programs.
    """
    to = Lengths(control.units)
    rows = [
        _row(
            job,
            program,
            proof or {},
            control,
            file_names(program, control.suffix, files.get(program.name, ())),
        )
        for job, program, proof in programs
    ]
    sheet = programs[0][0].settings.sheet if programs else Sheet()
    verdicts = [row["verdict"] for row in rows]
    times = [row["all_seconds"] for row in rows if row["all_seconds"] is not None]
    return (
        environment()
        .get_template("summary.html")
        .render(
            name=name,
            design=design,
            bill=bill,
            guide=guide,
            played=played,
            table_words=control.table_words(tool_table) if tool_table else "",
            rows=rows,
            revision=sheet.revision,
            date=sheet.date,
            **words(to),
            tools=_tools(programs, control),
            verdict=False if False in verdicts else None if None in verdicts else True,
            total=sum(times) if times else None,
        )
    )


def _row(
    job: Job, program: Program, proof: Mapping[str, Any], control: Control, names: Sequence[str]
) -> dict[str, Any]:
    x0, y0, x1, y1 = job.stock
    to = Lengths(control.units)
    seconds = proof.get("time_estimate_s")
    count = quantity(job)
    return {
        "part": job.part.name,
        "side": job.side,
        "name": program.name,
        "sheet": program.name + SHEET,
        "file_names": names,
        "file_name": span(names),
        "quantity": count,
        "stock": f"{to.fixed(x1 - x0, 1)} × {to.fixed(y1 - y0, 1)} × {to.plain(job.thickness)}",
        "material": job.part.material,
        "work_offset": ", ".join(map(control.offset_words, program.offsets)),
        "tools": len(program.tools),
        "seconds": seconds,
        "all_seconds": None if seconds is None else runs(job) * seconds,
        "verdict": facts.verdict(proof),
        "figures": [proof.get(figure) for figure in _FIGURES],
        "failed": [title for title, passed, _ in facts.check_rows(proof) if not passed],
    }


def _tools(
    programs: Sequence[tuple[Job, Program, Mapping[str, Any] | None]], control: Control
) -> list[dict[str, Any]]:
    """One row per tool, by number, with what all programs ask of it."""
    found: dict[int, dict[str, Any]] = {}
    for job, program, proof in programs:
        compensated = {tool.number for tool in program.compensated}
        for row in facts.tool_rows(job, program, trace(program), proof or {}, Lengths(control.units)):
            tool: Tool = row.tool
            mine = found.setdefault(
                tool.number,
                {
                    "tool": tool,
                    "description": row.description,
                    "length": control.length_place(tool.number) if control.offsets.lengths else "–",
                    "diameter": "–",
                    "programs": [],
                    "bottom": 0.0,
                    "stick_out": 0.0,
                    "seconds": None,
                },
            )
            mine["programs"].append(program.name)
            if tool.number in compensated:
                mine["diameter"] = f"D{tool.d_number}"
            mine["bottom"] = min(mine["bottom"], row.bottom)
            mine["stick_out"] = max(mine["stick_out"], row.stick_out)
            if row.seconds is not None:
                mine["seconds"] = (mine["seconds"] or 0.0) + runs(job) * row.seconds
    return [found[number] for number in sorted(found)]
