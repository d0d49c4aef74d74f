"""The command ``measure``."""

import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import typer

from mechwright.cli.hosting import open_host
from mechwright.cli.telling import echo
from mechwright.errors import DesignError
from mechwright.output.folder import write_new
from mechwright.pipeline import Wanted
from mechwright.pipeline.measured.corrections import Correction, corrections
from mechwright.pipeline.measured.pairing import Pairing, pairings
from mechwright.pipeline.measured.readings import Reading, empty_table, read_readings
from mechwright.pipeline.measured.running import as_measured
from mechwright.pipeline.tolerances.compared import ComparedOutput
from mechwright.pipeline.tolerances.units import percent, shown, shown_unit
from mechwright.scripting.mechanism import Mechanism


def measure(design: Path, values: Path | None, output: Path | None, *, force: bool, as_json: bool) -> None:
    """Write the table to fill in, or tell what a filled one says; exit code 1 where a limit does not hold."""
    with Mechanism(design, open_host(), Wanted()) as build:
        build.require()
        if values is None:
            if output is None:
                raise DesignError("say a table of measured values, or -o FILE for an empty one")
            write_new(output, empty_table(build.parts), replace=force)
            echo(
                f"{output}: written; fill in the column measured, in mm",
                f"then: mechwright measure {design} {output}",
            )
            return
        if output is not None or force:
            raise DesignError("--output, --force: only without a table of values")
        readings = read_readings(values, build.parts)
        found = corrections(build, readings)
        pairs = pairings(build, readings)
        running = as_measured(build, pairs, found)
    failed = [one for one in readings if not one.is_within]
    if as_json:
        typer.echo(json.dumps(_data(readings, found, pairs, running), indent=2))
    else:
        echo(*_lines(readings, found, pairs, running))
        echo(
            f"{values}: {len(readings)} values, "
            + ("all within limits" if not failed else f"{len(failed)} out")
        )
    raise typer.Exit(1 if failed else 0)


def _lines(
    readings: Sequence[Reading],
    found: Sequence[Correction],
    pairs: Sequence[Pairing],
    running: Sequence[ComparedOutput],
) -> Iterator[str]:
    for one in readings:
        limits = f"{_mm(one.dimension.least)} to {_mm(one.dimension.greatest)}"
        held = "holds" if one.is_within else f"out by {_out(one):.3f} mm"
        yield f"{one.part.name} {one.copy} {one.dimension.name}: {one.value:g} mm, {limits}: {held}"
    for each in found:
        said = f"{each.off:+.4f} mm, standard error {each.error:.4f} mm, {each.count} sizes"
        yield f"{each.process}, {each.walls} walls: stock on each {said}" + (
            f"; {each.words}" if each.words else ""
        )
    for pair in pairs:
        names = ", ".join(f"{pair.shafts[i]} in {pair.holes[j]}" for i, j in pair.chosen)
        yield (
            f"{pair.shaft} in {pair.hole}{_joint(pair)}: greatest play {pair.as_chosen:.3f} mm with {names}; "
            f"{pair.as_numbered:.3f} mm as numbered"
        )
    for output in running:
        unit = output.output.unit
        before = "" if output.designed is None else f", as designed {shown(output.designed, unit)}"
        what = "have at least" if output.output.stays_above else "stay within"
        kept = "" if output.kept is None else f"; {percent(output.kept)} within the limit"
        half = f"{shown(output.half, unit)} {shown_unit(unit)}"
        yield f"{output.output.name}: 99.73 % {what} {half}{before}{kept}"


def _joint(pair: Pairing) -> str:
    return f", joint {' and '.join(pair.joints)}" if pair.joints else ""


def _mm(value: float | None) -> str:
    return "–" if value is None else f"{value:.4g}" if value >= 1000 else f"{value:.3f}"


def _out(one: Reading) -> float:
    least, greatest = one.dimension.least, one.dimension.greatest
    below = 0.0 if least is None else least - one.value
    above = 0.0 if greatest is None else one.value - greatest
    return max(below, above)


def _data(
    readings: Sequence[Reading],
    found: Sequence[Correction],
    pairs: Sequence[Pairing],
    running: Sequence[ComparedOutput],
) -> dict[str, Any]:
    return {
        "ok": all(one.is_within for one in readings),
        "values": [
            {
                "part": one.part.name,
                "copy": one.copy,
                "feature": one.dimension.name,
                "measured": one.value,
                "least": one.dimension.least,
                "greatest": one.dimension.greatest,
                "within": one.is_within,
            }
            for one in readings
        ],
        "corrections": [vars(one) for one in found],
        "pairs": [
            {
                "shaft": pair.shaft,
                "hole": pair.hole,
                "joints": pair.joints,
                "together": [[pair.shafts[i], pair.holes[j]] for i, j in pair.chosen],
                "greatest": pair.as_chosen,
                "as_numbered": pair.as_numbered,
            }
            for pair in pairs
        ],
        "outputs": [
            {"name": one.output.name, "unit": one.output.unit, "designed": one.designed, "measured": one.half}
            for one in running
        ],
    }
