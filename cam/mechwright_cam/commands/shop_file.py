"""The command ``shop``: a shop file to start from."""

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import get_args

import typer

from mechwright.cli.hosting import open_host
from mechwright.cli.telling import echo
from mechwright.designs.inches import Units
from mechwright.designs.tables import unknown
from mechwright.errors import DesignError
from mechwright.output.folder import write_new
from mechwright_cam.controls.contract import Control
from mechwright_cam.shop.bench import bench, mills_of, remarks, sheet_of
from mechwright_cam.shop.library import load_library
from mechwright_cam.shop.machine import known_machines
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.shop_text import bench_text, shop_text

FIRST = "bench-mill"
"""The mill of a file for which none is named."""
SCHEMA = "for an editor that completes and checks it: mechwright schema shop -o shop.schema.json"


@dataclass(frozen=True)
class BenchWords:
    """Options of the shop of a small machine, as they were typed."""

    mills: str = ""
    sheets: tuple[str, ...] = ()
    spindle: str = ""
    homing: bool | None = None
    gap: float | None = None
    spoil_board: float | None = None


def shop_file(
    output: Path | None,
    library: Path | None,
    units: str,
    control: str,
    machine: str,
    words: BenchWords,
    *,
    force: bool,
) -> None:
    """Write or print a shop file; raises DesignError for an option that names nothing."""
    if control:
        open_host().get(Control, control)
    asked = output is None and library is None and not machine and words == BenchWords()
    if asked and sys.stdin.isatty() and sys.stdout.isatty():
        output, machine, words = _questions()
    if words.mills:
        if library is not None or units != "mm":
            raise DesignError(
                "--mills: stands for the tools of a shop in mm; leave --library and --units out"
            )
        text, lines = _bench(machine, control, words)
    elif words != BenchWords():
        raise DesignError(
            "--mills: is missing; give the diameters of your mills in mm, such as --mills 3.175,2,1"
        )
    else:
        text, lines = _shop(library, units, control, machine or FIRST)
    if output is None:
        typer.echo(text, nl=False)
        return
    write_new(output, text, replace=force)
    echo(f"{output}: written, {lines[0]}", *lines[1:], SCHEMA)


def _shop(library: Path | None, units: str, control: str, machine: str) -> tuple[str, list[str]]:
    """The text of a shop with a whole library, and what to say of it."""
    known: dict[str, Units] = {one: one for one in get_args(Units)}
    if units not in known:
        raise DesignError(f"--units: {units!r} is not known; one of: {', '.join(known)}")
    machines = known_machines()
    if machine not in machines:
        raise DesignError(f"--machine: {unknown(machine, tuple(machines), 'machine')}")
    tools = load_library(library)
    preset = machines[machine][1]
    text = shop_text(tools.tools, known[units], control or preset.control or CamSettings().control, machine)
    return text, [
        f"{len(tools.tools)} tools; take out what you do not have",
        *(f"note {line}" for line in tools.told),
    ]


def _bench(machine: str, control: str, words: BenchWords) -> tuple[str, list[str]]:
    """The text of the shop of a small machine, and what to say of it."""
    if not machine:
        raise DesignError("--machine: is missing; name yours, such as --machine 3018")
    sheets = [sheet_of(one) for one in words.sheets]
    made = bench(
        machine, control, homing=words.homing, spindle=words.spindle, gap=words.gap, board=words.spoil_board
    )
    tools = mills_of(words.mills, made, sheets)
    lines = [f"{made.machine.name}, {len(tools)} mills", *(f"note {line}" for line in remarks(made, tools))]
    return bench_text(made, tools, sheets), lines


def _questions() -> tuple[Path, str, BenchWords]:
    """Ask on the terminal, each question with the answer that holds where one presses return."""
    names = known_machines()
    typer.echo(f"Machines: {', '.join(names)}")
    machine = typer.prompt("Your machine", default="3018")
    while machine not in names:
        typer.echo(f"{machine} is none of them; take the one that is most like yours")
        machine = typer.prompt("Your machine", default="3018")
    figures, preset = names[machine]
    mills = typer.prompt("Diameters of your mills in mm", default="3.175,2,1")
    sheets = []
    while sheet := typer.prompt(
        "A sheet in hand, such as 200x150x6 acrylic; return for none or no more",
        default="",
        show_default=False,
    ):
        try:
            sheet_of(sheet)
        except DesignError as error:
            typer.echo(str(error))
            continue
        sheets.append(sheet)
    homing = typer.confirm(
        "Has it switches for homing", default=figures.get("homing", "switches") == "switches"
    )
    spindle = ""
    if "spindle" in preset.unknown:
        spindle = typer.prompt("Slowest and fastest speed of its spindle", default="10000-30000")
    gap = typer.prompt(
        "With Z fully up, mm from the table to the nose of the spindle; 0 if not measured", default=0.0
    )
    board = typer.prompt("Thickness of the spoil board, mm", default=10.0)
    output = typer.prompt("File", default="shop.toml")
    words = BenchWords(mills, tuple(sheets), spindle, homing, gap or None, board)
    return Path(output), machine, words
