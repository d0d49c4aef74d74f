"""The whole analysis of one design."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from mechwright.contracts.tolerance_settings import Tolerances
from mechwright.contracts.tolerances import Output, ToleranceModel
from mechwright.errors import DesignError
from mechwright.mechanics.tolerance.places import Band, Place, band, finite, place_at, worst_place
from mechwright.mechanics.tolerance.trials import Trial, trials


@dataclass(frozen=True)
class Result:
    """One output.

    Parameters
    ----------
    output
        What it is.
    worst
        First order where the worst case is worst; None where no position has a first order.
    places
        First order in the positions that were asked for.
    trials
        What mechanisms made at random do: there, or in the worst position, or over the turn.
    band
        First order over the period.
    """

    output: Output
    worst: Place | None
    places: tuple[Place, ...]
    trials: tuple[Trial, ...]
    band: Band


@dataclass(frozen=True)
class Analysis:
    """All outputs of a design."""

    model: ToleranceModel
    tolerances: Tolerances
    results: tuple[Result, ...]


def analyse(model: ToleranceModel, tolerances: Tolerances) -> Analysis:
    """First order, worst case and random mechanisms.

    Raises
    ------
    DesignError
        A key of ``[tolerances]`` has no use for this family, names a contributor that it does not have, or a
        position that it does not come to.
    """
    check_keys(model, tolerances)
    settings = tolerances.settings
    asked = [_position(model, at) for at in settings.at]
    worst = {one.name: worst_place(model, one) for one in model.outputs}
    places = {
        one.name: tuple(place_at(model, one, at) for at in asked) if one.figure == "at" else ()
        for one in model.outputs
    }
    runs: dict[str, list[Trial]] = {one.name: [] for one in model.outputs}
    for wanted in _rounds(model, places, worst):
        limits = {name: _limit(tolerances, model, name) for name in wanted}
        for name, trial in trials(model, wanted, limits, settings.samples, settings.seed).items():
            runs[name].append(trial)
    return Analysis(
        model,
        tolerances,
        tuple(
            Result(
                one,
                worst[one.name],
                places[one.name],
                tuple(runs[one.name]),
                band(model, one, model.positions),
            )
            for one in model.outputs
        ),
    )


def check_keys(model: ToleranceModel, tolerances: Tolerances) -> None:
    """Refuse what the design file says and nothing here depends on."""
    names = [one.name for one in model.contributors]
    for name in tolerances.own:
        if name not in names:
            raise DesignError(
                f"tolerances.of.{name}: there is no such contributor; known: {', '.join(names)}"
            )
    used = {key for one in model.contributors for key in one.key.split()} | {"samples", "seed"}
    used |= {f"limit_{_KIND[one.unit]}" for one in model.outputs if not one.stays_above}
    if any(one.figure == "at" for one in model.outputs):
        used.add("at")
    defaults = type(tolerances.settings)()
    for key in type(tolerances.settings).model_fields:
        if key not in used and getattr(tolerances.settings, key) != getattr(defaults, key):
            raise DesignError(f"tolerances.{key}: nothing depends on it here; leave it out")


_KIND = {"rad": "angle", "mm": "length"}


def _position(model: ToleranceModel, at: float) -> float:
    """A position, degrees or mm, as the model counts it; raises DesignError if it does not come there."""
    low, high = float(model.positions.min()), float(model.positions.max())
    if model.input_unit != "rad":
        if low <= at <= high:
            return at
        raise DesignError(
            f"tolerances.at: {model.input_name} does not come to {at:g} {model.input_unit}; give {low:g} to "
            f"{high:g}"
        )
    at = math.radians(at)
    turned = low + (at - low) % math.tau
    slack = 1e-9  # rounding of degrees
    if turned <= high + slack:
        return min(turned, high)
    if turned - math.tau >= low - slack:
        return low
    raise DesignError(
        f"tolerances.at: {model.input_name} does not come to {math.degrees(at):g} deg; give "
        f"{math.degrees(low):g} to {math.degrees(high):g}"
    )


def _rounds(
    model: ToleranceModel, asked: Mapping[str, Sequence[Place]], worst: Mapping[str, Place | None]
) -> Iterator[dict[str, float | None]]:
    """Which outputs are tried where; each round makes the mechanisms once.

    Nothing is tried where there is no first order: close to a singular position a mechanism has no one
    solution that follows from the nominal one.
    """
    first: dict[str, float | None] = {one.name: None for one in model.outputs if one.figure != "at"}
    turns: list[list[float]] = []
    for one in model.outputs:
        if one.figure == "at":
            wanted = asked[one.name] or (worst[one.name],)
            turns.append([place.at[0] for place in wanted if place is not None and finite((place.sigma,))])
    names = [one.name for one in model.outputs if one.figure == "at"]
    for number in range(max([1, *map(len, turns)])):
        more = {
            name: places[number] for name, places in zip(names, turns, strict=True) if number < len(places)
        }
        yield {**first, **more} if number == 0 else {**more}


def _limit(tolerances: Tolerances, model: ToleranceModel, name: str) -> float | None:
    (output,) = (one for one in model.outputs if one.name == name)
    settings = tolerances.settings
    if output.stays_above:
        return 0.0
    if output.unit == "mm":
        return settings.limit_length
    return None if settings.limit_angle is None else math.radians(settings.limit_angle)
