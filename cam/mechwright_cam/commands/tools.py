"""The command ``tools``: what is in the crib, and what it does in a design."""

import json
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import typer

from mechwright.cli.hosting import open_host
from mechwright.cli.perform import refuse
from mechwright.cli.telling import echo
from mechwright.contracts.finding import errors
from mechwright.designs.design import Design, load
from mechwright.designs.inches import Units
from mechwright.pipeline import Build, Wanted
from mechwright.plugins.host import Host
from mechwright_cam.commands.tools_table import doing, listing, unneeded_lines
from mechwright_cam.machining import Machining
from mechwright_cam.planning.prepare import library_of
from mechwright_cam.planning.uses import Use, uses
from mechwright_cam.shop.exporting import export
from mechwright_cam.shop.lengths import Lengths
from mechwright_cam.shop.library import Library, load_library
from mechwright_cam.shop.shop_table import shop_of
from mechwright_cam.shop.table import CamTable
from mechwright_cam.shop.workshop_file import named_by, read_shop


def tools(
    path: Path | None, library: Path | None, as_json: bool, target: Path | None = None, *, force: bool = False
) -> None:
    """List the cutters of a library, or of a design with what they do in it, and export them."""
    done = dict[str, list[Use]]()
    if path is not None:
        host = open_host()
        design = _with(load(path, host), library)
        shop, crib, done = shop_of(design), library_of(design), _done(design, host)
    else:
        named = named_by()
        shop = None if named is None else read_shop(named)
        crib = load_library(library, None if shop is None else shop.library)
    if target is not None:
        files, lost = export(crib.tools, target, replace=force)
    needed = {use.tool.name for found in done.values() for use in found}
    spare = [tool for tool in crib if tool.name not in needed] if path is not None else []
    if as_json:
        said = _data(crib, done)
        if path is not None:
            said["unneeded"] = [tool.name for tool in spare]
        if target is not None:
            said |= {"files": [str(file) for file in files], "lost": lost}
        typer.echo(json.dumps(said, indent=2))
        return
    units: Units = "mm" if shop is None else shop.workshop.units
    lines = [*listing(crib.tools, Lengths(units)), *(f"note {line}" for line in crib.told)]
    for name, found in done.items():
        lines += ["", *doing(name, found)]
    if path is not None:
        lines += ["", *unneeded_lines(spare)]
    if target is not None:
        lines += [f"{file}: written" for file in files] if len(files) < MANY else _few(files)
        lines += [f"note {target} {line}" for line in lost]
    echo(*lines)


MANY = 4
"""From so many files on they are counted by folder."""


def _few(files: Sequence[Path]) -> list[str]:
    folder = files[-1].parent
    return [f"{files[0]}: written", f"{folder}: {len(files) - 1} files written"]


def _with(design: Design, library: Path | None) -> Design:
    """The design with a library in the place of its own."""
    if library is None:
        return design
    settings = replace(design.table(CamTable), tool_library=library)
    return replace(design, tables={**design.tables, CamTable.name: settings})


def _done(design: Design, host: Host) -> dict[str, list[Use]]:
    """Name of each program to what its tools do; ends with exit code 1 where there can be none."""
    with Build(design, host, Wanted("tools")) as build:
        build.require()
        machining = build.made(Machining)
        if stopping := errors(machining.findings):
            refuse(stopping, design.path)
        return {job.part.name: uses(job, machining.assignments.of(job)) for job in machining.jobs}


def _data(crib: Library, done: dict[str, list[Use]]) -> dict[str, object]:
    said: dict[str, object] = {
        "tools": [tool.model_dump(mode="json") for tool in crib],
        "told": list(crib.told),
    }
    if done:
        said["uses"] = {
            name: [{"tool": use.tool.name, "feature": use.feature, "doing": use.doing} for use in found]
            for name, found in done.items()
        }
    return said
