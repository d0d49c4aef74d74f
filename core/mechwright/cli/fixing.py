"""The command ``fix``."""

import difflib
import json
import os
from dataclasses import replace
from pathlib import Path

import typer

from mechwright.cli.check import stage_of
from mechwright.cli.hosting import open_host
from mechwright.cli.progress import fraction
from mechwright.cli.streams import plain
from mechwright.cli.telling import echo, tell
from mechwright.contracts.finding import Change, Stage
from mechwright.designs.bounded_toml import require_rewritable
from mechwright.designs.change import changed, rewritten
from mechwright.designs.design import Design, design_of, load
from mechwright.designs.files import read_bytes, read_text
from mechwright.designs.hints import schemas_of
from mechwright.designs.inches import written
from mechwright.errors import OutputError
from mechwright.output.folder import rewrite
from mechwright.plugins.host import Host
from mechwright.remedies import MOST_CHANGES, Repair, repaired
from mechwright.remedies.words import each


def fix(path: Path, to: str, output: Path | None, write: bool, as_json: bool) -> None:
    """Print what makes a design build, and write it where asked for; the exit code is 1 if nothing does.

    Raises
    ------
    DesignError
        There is no such stage; the file cannot be changed, or the new one could not be read.
    OutputError
        The file is there already, or cannot be written.
    """
    stage = stage_of(to) or Stage.OUTPUT
    target = _target(path, output, write)
    found = open_host()
    text, digest = read_text(path)
    require_rewritable(text, f"{path}:")
    design = load(path, found)
    with fraction() as progress:
        repair = repaired(design, found, stage, progress)
    new = text
    if repair.change:
        change = written(repair.change, design.units, schemas_of(found, design.content, "parameters"))
        new = rewritten(text, change)
        _reads(design, repair.change, target or path, found)
    if target == path and not repair.change:
        target = None  # nothing to change
    if target is not None and repair.builds:
        rewrite(target, new, like=path, known=digest if write else None)
    if as_json:
        typer.echo(json.dumps(_data(design, repair), indent=2))
    else:
        _say(path, target, repair, text, new)
    raise typer.Exit(0 if repair.builds else 1)


def _target(path: Path, output: Path | None, write: bool) -> Path | None:
    """Where the new file goes; None if it is only shown."""
    if write and output is not None:
        raise OutputError(f"{output}: --write is for {path} itself; give one of --write and -o")
    if write:
        return path
    if output is not None and output.exists():
        hint = ", or --write to change it" if output.resolve() == path.resolve() else ""
        raise OutputError(f"{output}: is there already; give another name{hint}")
    return output


def _reads(design: Design, change: Change, target: Path, host: Host) -> None:
    """Raise DesignError or OutputError if the changed file, or one it names, cannot be read in its place."""
    new = design_of(changed(design.content, change), target, design.digest, host)
    for reader in new.readers:
        for file in reader.inputs(new.tables[reader.name], target).values():
            read_bytes(file)


def _data(design: Design, repair: Repair) -> dict[str, object]:
    return {
        "design": design.name,
        "ok": repair.builds,
        "findings": [finding.as_dict() for finding in repair.found],
        "fix": None if repair.change is None else dict(repair.change),
        "left": [finding.as_dict() for finding in repair.left],
        "nearest": None if repair.nearest is None else dict(repair.nearest),
    }


def _say(path: Path, target: Path | None, repair: Repair, text: str, new: str) -> None:
    if repair.change is None:
        for finding in repair.left:
            tell(finding)
        echo(
            f"{path}: cannot be built, and no change of at most {MOST_CHANGES} keys was found with which it "
            f"can, in {repair.bench.tries} tries"
        )
        if repair.nearest is not None:
            echo(f"the nearest design that can is another in {len(repair.nearest)} keys:")
            for line in each(repair.bench, repair.nearest):
                echo(f"  {line}")
        return
    if not repair.change:
        echo(f"{path}: can be built as it is" + (f"; written to {target}" if target else ""))
        return
    for finding in repair.found:
        tell(replace(finding, remedy=""))  # what was tried follows
    for line in each(repair.bench, repair.change):
        typer.echo(_styled(plain(line), typer.colors.GREEN))
    shown = difflib.unified_diff(
        text.splitlines(), new.splitlines(), str(path), str(target or path), lineterm=""
    )
    for line in shown:
        typer.echo(_coloured(plain(line.expandtabs())))
    done = "written" if target else "nothing was written, -o FILE or --write does"
    echo(f"{target or path}: can be built with this; {done}")


def _coloured(line: str) -> str:
    """A line of a difference; typer drops the colour where no terminal shows it."""
    colour = {"+": typer.colors.GREEN, "-": typer.colors.RED}.get(line[:1])
    return line if colour is None or line.startswith(("+++", "---")) else _styled(line, colour)


def _styled(line: str, colour: str) -> str:
    return line if os.environ.get("NO_COLOR") else typer.style(line, fg=colour)
