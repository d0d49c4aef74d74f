"""The analysis as data, as text, and as the lines that the page shows."""

import math
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from mechwright.contracts.tolerances import Contributor, Output
from mechwright.mechanics.tolerance import Analysis, Place, Result, Trial
from mechwright.pipeline.tolerances.by_process import SpreadTolerances
from mechwright.pipeline.tolerances.units import (
    degrees,
    input_position,
    limits,
    nominal,
    percent,
    shown,
    shown_unit,
)

_MISS = 0.05
"""Part of sigma by which the first order may miss that of the mechanisms before it is told."""


@dataclass(frozen=True)
class Line:
    """A contributor of one output, as text; ``share`` also as a number."""

    name: str
    nominal: str
    zone: str
    distribution: str
    sensitivity: str
    worst: str
    share: float


def lines(analysis: Analysis, result: Result, place: Place) -> list[Line]:
    """The contributors that change the output, the greatest share first."""
    found = []
    unit = result.output.unit
    for one, rate, share in zip(analysis.model.contributors, place.sensitivities, place.shares, strict=True):
        worst = abs(rate) * max(abs(one.mean + one.reach), abs(one.mean - one.reach))
        if rate or not math.isfinite(rate):
            found.append(
                Line(
                    one.name,
                    _nominal(one),
                    limits(one.lower, one.upper, one.unit),
                    _distribution(one),
                    f"{shown(rate * _per(one), unit)}",
                    shown(worst, unit),
                    share,
                )
            )
    return sorted(found, key=lambda line: -line.share)


def _nominal(one: Contributor) -> str:
    return (
        "on diameter"
        if one.directions == 2
        else "between walls"
        if one.directions
        else nominal(one.nominal, one.unit)
    )


def _per(one: Contributor) -> float:
    """What a sensitivity is shown per: a degree, or a millimetre."""
    return math.radians(1) if one.unit == "rad" else 1.0


def _distribution(one: Contributor) -> str:
    kinds = " ".join(dict.fromkeys(zone.distribution for zone in one.zones)) or "exact"
    return kinds + {0: "", 1: ", either side", 2: ", any direction"}[one.directions]


def where(analysis: Analysis, place: Place, output: Output) -> str:
    """The position of a first order, in words."""
    name, unit = analysis.model.input_name, analysis.model.input_unit
    if output.figure == "steady":
        return "in every position"
    if len(place.at) > 1:
        return f"between {name} = {degrees(place.at[0])} and {degrees(place.at[1])} deg"
    return f"at {name} = {input_position(place.at[0], unit)}"


def order(result: Result, place: Place) -> str:
    """Worst case and sigma of the first order, in words."""
    unit = result.output.unit
    if not math.isfinite(place.sigma):
        return "none, the position is singular"
    if result.output.figure != "at":
        low = f"{shown(place.low, unit)} to " if result.output.stays_above else ""
        worst = f"nominal {shown(place.nominal, unit)}, worst case {low}{shown(place.high, unit)}"
    elif result.output.components > 1:
        worst = f"worst case {shown(place.high, unit)}"
    elif abs(place.low + place.high) <= 1e-9 * abs(place.high):
        worst = f"worst case ±{shown(place.high, unit)}"
    else:
        worst = f"worst case {shown(place.low, unit)} to {shown(place.high, unit)}"
    return f"{worst}, mean {shown(place.mean, unit)}, sigma {shown(place.sigma, unit)} {shown_unit(unit)}"


def outcome(analysis: Analysis, output: Output, trial: Trial) -> list[str]:
    """What the mechanisms did, a line each."""
    unit, count = output.unit, f"{trial.samples:,}".replace(",", " ")
    place = "in every position" if output.figure == "steady" else "over the turn"
    if trial.at is not None:
        place = f"at {analysis.model.input_name} = {input_position(trial.at, analysis.model.input_unit)}"
    ends = f"{shown(trial.least, unit)} to {shown(trial.greatest, unit)}"
    said = [f"{count} mechanisms {place}: sigma {shown(trial.sigma, unit)}, {ends} {shown_unit(unit)}"]
    half = (shown(trial.half_95, unit), shown(trial.half_9973, unit))
    if output.stays_above:
        said.append(f"95 % have at least {half[0]}, 99.73 % at least {half[1]} {shown_unit(unit)}")
    else:
        sign = "±" if output.components == 1 and output.figure == "at" else ""
        said.append(f"95 % stay within {sign}{half[0]}, 99.73 % within {sign}{half[1]} {shown_unit(unit)}")
    if trial.kept is not None and trial.limit is not None:
        kept = trial.kept
        limit = "above 0" if output.stays_above else f"within {shown(trial.limit, unit)} {shown_unit(unit)}"
        between = f"{percent(kept.lower, 3)} to {percent(kept.upper, 3)}"
        said.append(f"yield {limit}: {percent(kept.value, 3)} ({between} with 95 % confidence)")
    if trial.apart:
        said.append(f"{trial.apart} of them cannot be assembled there")
    return said


def remarks(analysis: Analysis) -> Iterator[str]:
    """What is told besides: the model's own words, and where the first order is not enough."""
    yield from analysis.model.told
    if isinstance(analysis.tolerances, SpreadTolerances):
        yield 'plates stray as their process does; general = "proof" in [tolerances] leaves that out'
    unit = analysis.model.input_unit
    for result in analysis.results:
        name, places = result.output.name, {place.at[0]: place for place in result.places}
        if result.worst is None:
            yield f"{name}: there is no position with a first order"
            continue
        blind = [
            input_position(place.at[0], unit) for place in result.places if not math.isfinite(place.sigma)
        ]
        if blind:
            yield f"{name}: no first order at {', '.join(blind)}, so no mechanisms are tried there"
        gone = int(np.isnan(result.band.sigma).sum())
        if gone and not analysis.model.told:
            yield f"{name}: {gone} of {result.band.sigma.size} positions have no first order: a dead centre"
        places.setdefault(result.worst.at[0], result.worst)
        for trial in result.trials:
            place = places.get(trial.at) if trial.at is not None else None
            if place is None or not place.sigma or not math.isfinite(place.sigma):
                continue
            miss = trial.sigma / place.sigma - 1
            if not abs(miss) <= _MISS:
                at = input_position(trial.at or 0.0, unit)
                yield (
                    f"{name}: at {at} the first order misses the sigma of the "
                    f"mechanisms by {percent(-miss)}; believe the mechanisms"
                )


def as_text(analysis: Analysis) -> list[str]:
    """The analysis as lines of text."""
    said = []
    for result in analysis.results:
        output, places = result.output, [*result.places]
        if result.worst is not None:
            places.insert(0, result.worst)
        said += ["", f"{output.name}, {shown_unit(output.unit)}"]
        for number, place in enumerate(places):
            title = "worst case " if number == 0 and result.worst is not None else ""
            said.append(f"  first order {title}{where(analysis, place, output)}: {order(result, place)}")
            if math.isfinite(place.sigma):
                said += _table(analysis, result, place)
        for trial in result.trials:
            said += [f"  {line}" for line in outcome(analysis, output, trial)]
    told = [f"note: {line}" for line in remarks(analysis)]
    return [*said[1:], "", *told, *([""] if told else [])]


def _table(analysis: Analysis, result: Result, place: Place) -> list[str]:
    unit = shown_unit(result.output.unit)
    rows = [("contributor", "nominal", "tolerance", "distribution", f"{unit}/mm, /deg", "worst", "share")]
    rows += [
        (
            line.name,
            line.nominal,
            line.zone,
            line.distribution,
            line.sensitivity,
            line.worst,
            percent(line.share),
        )
        for line in lines(analysis, result, place)
    ]
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    return [
        "    "
        + "  ".join(
            cell.ljust(width) if i in {0, 3} else cell.rjust(width)
            for i, (cell, width) in enumerate(zip(row, widths, strict=True))
        ).rstrip()
        for row in rows
    ]


def as_data(analysis: Analysis) -> dict[str, Any]:
    """The analysis as plain data: mm and rad, nothing rounded; None for what is no number."""
    model = analysis.model
    data = {
        "input": model.input_name,
        "samples": analysis.tolerances.settings.samples,
        "seed": analysis.tolerances.settings.seed,
        "contributors": [
            {
                "name": one.name,
                "unit": one.unit,
                "nominal": one.nominal,
                "lower": one.lower,
                "upper": one.upper,
                "directions": one.directions,
                "distribution": _distribution(one),
            }
            for one in model.contributors
        ],
        "outputs": [
            {
                "name": result.output.name,
                "unit": result.output.unit,
                "components": result.output.components,
                "figure": result.output.figure,
                "worst": None if result.worst is None else _place(analysis, result.worst),
                "places": [_place(analysis, place) for place in result.places],
                "mechanisms": [asdict(trial) for trial in result.trials],
            }
            for result in analysis.results
        ],
        "notes": list(remarks(analysis)),
    }
    cleaned: dict[str, Any] = _clean(data)
    return cleaned


def _place(analysis: Analysis, place: Place) -> dict[str, Any]:
    names = [one.name for one in analysis.model.contributors]
    plain = asdict(place)
    for key in ("sensitivities", "shares"):
        plain[key] = dict(zip(names, plain[key], strict=True))
    return plain


def _clean(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _clean(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_clean(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
