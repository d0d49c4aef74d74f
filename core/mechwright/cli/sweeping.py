"""The command ``sweep``."""

import json
import os
from dataclasses import asdict
from pathlib import Path

import typer

from mechwright.cli.hosting import open_host
from mechwright.cli.progress import fraction
from mechwright.cli.stopping import StoppedError, deaf
from mechwright.cli.streams import say
from mechwright.errors import DesignError, MechwrightError
from mechwright.extras import require
from mechwright.sweep.run import Swept, sweep
from mechwright.sweep.standing import Standing
from mechwright.sweep.study import load_study
from mechwright.sweep.workers import Alone, Cluster, Processes, Workers
from mechwright.worker_pool.budget import available_cores

ADDRESS = "DASK_SCHEDULER_ADDRESS"
"""Environment variable: the scheduler that is asked where the command names none."""


def run(path: Path, folder: Path, count: int | None, scheduler: str, as_json: bool) -> None:
    """Evaluate the designs of a study; the exit code is 1 if none is allowed."""
    workers = _workers(count, scheduler)
    installed = open_host()
    study = load_study(path, installed)
    standing = Standing(study)
    try:
        with fraction(lines=True) as progress:
            found = sweep(study, folder, workers, installed, progress, standing)
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


def _workers(count: int | None, scheduler: str) -> Workers:
    address = scheduler or ("" if count else os.environ.get(ADDRESS, ""))
    if scheduler and count:
        raise DesignError(
            "--workers: goes with processes of this machine, and --scheduler with a cluster; take one"
        )
    if address:
        require("distributed", by="--scheduler" if scheduler else ADDRESS)
        return Cluster(address)
    number = count or available_cores()
    return Alone() if number == 1 else Processes(number)


def _say(folder: Path, found: Swept) -> None:
    counts = found.counts
    if not counts.feasible:
        first = max(counts.forbidden.items(), key=lambda one: one[1])
        typer.echo(
            f"mechwright: no design is allowed: [{first[0]}] forbids {first[1]:,} of {counts.designs:,}; "
            "widen the ranges or ease the constraints",
            err=True,
        )
    for one in found.chosen:
        told = ", ".join(f"{name} {_shown(value)}" for name, value in one.figures.items())
        typer.echo(f"{one.name}.toml: {told}" if one.name else f"design {one.design}: refused: {one.refused}")
    typer.echo(
        f"{folder}: {counts.designs:,} designs, {counts.feasible:,} allowed, {found.front:,} on the front; "
        f"{', '.join(found.files)}"
    )


def _shown(value: object) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)
