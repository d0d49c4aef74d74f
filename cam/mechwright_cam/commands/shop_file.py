"""The command ``shop``: a shop file to start from."""

from pathlib import Path
from typing import get_args

import typer

from mechwright.cli.hosting import open_host
from mechwright.cli.telling import echo
from mechwright.designs.files import read_toml
from mechwright.designs.inches import Units
from mechwright.designs.tables import unknown
from mechwright.errors import DesignError
from mechwright.output.folder import write_new
from mechwright_cam.controls.contract import Control
from mechwright_cam.shop.library import load_library
from mechwright_cam.shop.machine import MACHINES
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.shop_text import shop_text


def shop_file(
    output: Path | None, library: Path | None, units: str, control: str, machine: str, *, force: bool
) -> None:
    """Write or print a shop file; raises DesignError for an option that names nothing."""
    known: dict[str, Units] = {one: one for one in get_args(Units)}
    if units not in known:
        raise DesignError(f"--units: {units!r} is not known; one of: {', '.join(known)}")
    control = control or CamSettings().control
    open_host().get(Control, control)
    machines = tuple(read_toml(MACHINES)[0])
    if machine not in machines:
        raise DesignError(f"--machine: {unknown(machine, machines, 'machine')}")
    tools = load_library(library)
    text = shop_text(tools.tools, known[units], control, machine)
    if output is None:
        typer.echo(text, nl=False)
        return
    write_new(output, text, replace=force)
    lines = [f"{output}: written, {len(tools.tools)} tools; take out what you do not have"]
    lines += [f"note {line}" for line in tools.told]
    lines.append("for an editor that completes and checks it: mechwright schema shop -o shop.schema.json")
    echo(*lines)
