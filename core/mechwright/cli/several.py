"""``build``, ``cam`` and ``check`` of several designs: side by side, and a table of what became of each."""

import json
import time
from collections.abc import Callable, Sequence
from contextlib import closing
from pathlib import Path
from typing import Any

import typer

from mechwright.cli.check import check as check_one
from mechwright.cli.check import shown, stage_of, verdict
from mechwright.cli.hosting import open_host
from mechwright.cli.orders import Order, Outcome, done, into, killed
from mechwright.cli.perform import check_formats, data_of, perform, say
from mechwright.cli.progress import fraction, stamp
from mechwright.cli.stopping import StoppedError
from mechwright.cli.telling import echo, tell
from mechwright.contracts.finding import Stage
from mechwright.errors import DesignError
from mechwright.output.folder import check_folder
from mechwright.pipeline import Wanted
from mechwright.plugins.host import host
from mechwright.scripting.checking import unmade
from mechwright.worker_pool.budget import available_cores, limit_cores
from mechwright.worker_pool.sharing import side_by_side

COLUMNS = ("design", "outcome", "seconds", "reason")


def write(
    designs: Sequence[Path],
    folder: Path,
    wanted: Wanted,
    workers: int | None,
    empty: str = "",
    as_json: bool = False,
) -> None:
    """Write designs: one into a folder, and of several each into a folder of its own in it.

    The exit code is 1 if one of several could not be written.

    Raises
    ------
    DesignError
        Two files have one name; nothing is written then.
    StoppedError
        The keyboard stopped it; it says what stands.
    """
    if len(designs) == 1:
        _keep(workers)
        perform(designs[0], folder, wanted, empty, as_json)
        return
    check_formats(open_host(), wanted.formats)
    places = into(designs, folder)
    for place in places.values():
        check_folder(place)
    orders = [Order(path, wanted, place, empty) for path, place in places.items()]
    _run(orders, workers, as_json, ("written", "refused"), _say_written, folder)


def check(
    designs: Sequence[Path],
    wanted: Wanted,
    to: str,
    workers: int | None,
    as_json: bool,
    tolerances: bool,
    figures: bool,
) -> None:
    """Check designs; the exit code is 1 if one cannot be built.

    Raises
    ------
    DesignError
        An option is not known, or goes with none of the others.
    """
    stage = stage_of(to)
    if wanted.formats and stage not in {Stage.ASSEMBLY, Stage.OUTPUT}:
        raise DesignError(f"--also: goes with --to {Stage.ASSEMBLY} or --to {Stage.OUTPUT}, which make files")
    check_formats(open_host(), wanted.formats)
    if len(designs) == 1:
        _keep(workers)
        check_one(designs[0], wanted, stage, as_json=as_json, tolerances=tolerances, figures=figures)
    if tolerances or figures:
        raise DesignError("--tolerances and --figures tell of one design; give one, and not several")
    orders = [Order(path, wanted, to=stage) for path in dict.fromkeys(designs)]
    # What they were judged without is the same for all of them.
    remark = verdict(stage, unmade(host(), stage), failed=False).removeprefix("can be built")
    _run(orders, workers, as_json, ("can be built", "cannot be built"), _say_checked, remark=remark)


def _keep(workers: int | None) -> None:
    if workers is not None:
        limit_cores(workers)


def _run(
    orders: Sequence[Order],
    workers: int | None,
    as_json: bool,
    words: tuple[str, str],
    say_one: Callable[[Outcome], None],
    folder: Path | None = None,
    remark: str = "",
) -> None:
    before = {order.path: stamp(order.folder) for order in orders}
    found: dict[int, Outcome] = {}
    try:
        _all(orders, workers, found)
    except KeyboardInterrupt:
        if folder is None:
            raise
        raise StoppedError(_standing(orders, before, folder)) from None
    outcomes = [found[place] for place in range(len(orders))]
    failed = sum(not one.ok for one in outcomes)
    if as_json:
        told = {"ok": not failed, "designs": [_data(one, words) for one in outcomes]}
        typer.echo(json.dumps(told, indent=2))
        raise typer.Exit(int(bool(failed)))
    for one in outcomes:
        say_one(one)
    echo(*_table(outcomes, words))
    echo(f"{len(outcomes)} designs: {len(outcomes) - failed} {words[0]}, {failed} {words[1]}{remark}")
    raise typer.Exit(int(bool(failed)))


def _all(orders: Sequence[Order], workers: int | None, found: dict[int, Outcome]) -> None:
    """Do all orders; each outcome goes into ``found`` by its place as soon as it is there."""
    parts = [0.0] * len(orders)
    begun = time.perf_counter()
    with fraction() as progress:

        def heard(place: int, part: float, what: str) -> None:
            parts[place] = part
            at = f"{len(found)} of {len(orders)} done; {orders[place].path.stem}: {what}"
            progress(sum(parts) / len(parts), at)

        with closing(side_by_side(done, orders, workers or available_cores(), heard)) as outcomes:
            for place, outcome in outcomes:
                found[place] = outcome or killed(orders[place], time.perf_counter() - begun)
                heard(place, 1.0, "done")


def _standing(orders: Sequence[Order], before: dict[Path, Any], folder: Path) -> str:
    """What stands in a folder after the keyboard has stopped the work: folders are exchanged as a whole."""
    new = [order.path.stem for order in orders if stamp(order.folder) != before[order.path]]
    others = len(orders) - len(new)
    whole = f"all of {', '.join(new)} is written in {folder}" if new else f"nothing was written in {folder}"
    return f"{whole}; {others} of {len(orders)} designs are as they were"


def _say_written(outcome: Outcome) -> None:
    if not outcome.said.findings and outcome.fault:
        echo(f"mechwright: {_located(outcome)}", err=True)
    elif outcome.ok:
        say(outcome.order.path, outcome.order.wanted.extent.stage, outcome.said, files=False)
    else:
        _say_findings(outcome)


def _say_checked(outcome: Outcome) -> None:
    if outcome.fault:
        echo(f"mechwright: {_located(outcome)}", err=True)
    _say_findings(outcome)


def _say_findings(outcome: Outcome) -> None:
    for finding in shown(outcome.said.findings):
        tell(finding, err=True, path=outcome.order.path)


def _located(outcome: Outcome) -> str:
    path = str(outcome.order.path)
    return outcome.fault if outcome.fault.startswith(path) else f"{path}: {outcome.fault}"


def _data(outcome: Outcome, words: tuple[str, str]) -> dict[str, Any]:
    return {
        "file": str(outcome.order.path),
        "outcome": words[not outcome.ok],
        "seconds": round(outcome.seconds, 2),
        "reason": outcome.reason,
        **data_of(outcome.name, outcome.said, ok=outcome.ok, written=outcome.order.folder is not None),
    }


def _table(outcomes: Sequence[Outcome], words: tuple[str, str]) -> list[str]:
    """The outcomes in columns, a line each."""
    rows = [COLUMNS] + [
        (str(one.order.path), words[not one.ok], f"{one.seconds:.1f}", one.reason) for one in outcomes
    ]
    wide = [max(len(row[column]) for row in rows) for column in range(3)]
    return [f"{a:<{wide[0]}}  {b:<{wide[1]}}  {c:>{wide[2]}}  {d}".rstrip() for a, b, c, d in rows]
