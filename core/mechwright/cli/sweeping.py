"""The command ``sweep``."""

import json
from dataclasses import asdict
from pathlib import Path

import typer

from mechwright.cli.hosting import open_host
from mechwright.cli.progress import fraction
from mechwright.cli.stopping import StoppedError, deaf
from mechwright.cli.streams import say
from mechwright.cli.telling import echo
from mechwright.errors import MechwrightError
from mechwright.studies.run import Swept, evaluate
from mechwright.studies.standing import Standing
from mechwright.studies.study import load_study
from mechwright.studies.workers import workers_of


def run(path: Path, folder: Path, count: int | None, scheduler: str | None, as_json: bool) -> None:
    """Evaluate the designs of a study; the exit code is 1 if none is allowed."""
    workers = workers_of(count, scheduler)
    installed = open_host()
    study = load_study(path, installed)
    standing = Standing(study)
    try:
        with fraction(lines=True) as progress:
            found = evaluate(study, folder, workers, installed, progress, standing)
    except KeyboardInterrupt:
        deaf()
        raise StoppedError(standing.sentence()) from None
    except MemoryError:
        raise MechwrightError(f"there is not enough memory for this; {standing.sentence()}") from None
    except MechwrightError as error:
        if standing.begun:
            error.args = (f"{error}; {standing.sentence()}",)
        raise
    except Exception:
        if standing.begun:
            say(f"mechwright: {standing.sentence()}")
        raise
    if as_json:
        typer.echo(
            json.dumps({"ok": found.counts.feasible > 0, "folder": str(folder), **asdict(found)}, indent=2)
        )
    else:
        _say(folder, found)
    raise typer.Exit(int(not found.counts.feasible))


def _say(folder: Path, found: Swept) -> None:
    counts = found.counts
    if not counts.feasible:
        first = max(counts.forbidden.items(), key=lambda one: one[1])
        echo(
            f"mechwright: no design is allowed: [{first[0]}] forbids {first[1]:,} of {counts.designs:,}; "
            "widen the ranges or ease the constraints",
            err=True,
        )
    for one in found.chosen:
        told = ", ".join(f"{name} {_shown(value)}" for name, value in one.figures.items())
        echo(f"{one.name}.toml: {told}" if one.name else f"design {one.design}: refused: {one.refused}")
    echo(f"{folder}: {found}; {', '.join(found.files)}")


def _shown(value: object) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)
