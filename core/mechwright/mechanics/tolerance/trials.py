"""Mechanisms made at random, each closed exactly, in chunks that stay in a processor's cache.

Deviations of mechanisms made at random.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.tolerances import CUT, Contributor, Output, ToleranceModel, Zone
from mechwright.mechanics.tolerance.proportion import Share, share_of


def draw(contributors: Sequence[Contributor], rng: np.random.Generator, count: int) -> list[Array]:
    """Deviations (m, count) of each contributor."""
    return [_one(contributor, rng, count) for contributor in contributors]


def _one(contributor: Contributor, rng: np.random.Generator, count: int) -> Array:
    total = np.zeros(count)
    for zone in contributor.zones:
        total += _within(zone, rng, count)
    if contributor.directions == 0:
        return total[None]
    total += contributor.nominal
    # Half the clearance; parts that would not go together are fitted until they do.
    radius = np.maximum(total, 0.0) / 2
    if contributor.directions == 1:
        return (radius * (2.0 * rng.integers(0, 2, count) - 1.0))[None]
    turn = rng.random(count) * (2 * np.pi)
    return np.stack([radius * np.cos(turn), radius * np.sin(turn)])


def _within(zone: Zone, rng: np.random.Generator, count: int) -> Array:
    """Deviations (count,) of one zone."""
    if zone.half == 0:
        return np.full(count, zone.middle)
    if zone.distribution == "uniform":
        return rng.uniform(zone.lower, zone.upper, count)
    if zone.distribution == "triangular":
        return rng.triangular(zone.lower, zone.middle, zone.upper, count)
    found = rng.standard_normal(count)
    while (beyond := np.flatnonzero(np.abs(found) > CUT)).size:
        found[beyond] = rng.standard_normal(beyond.size)
    return zone.middle + zone.half / CUT * found


_CHUNK = 20_000
"""Mechanisms at a time: an array of them is 160 kB."""

_BLOCK = 5000
"""Mechanisms at a time over a whole turn."""

_TURN = 90
"""Positions of a turn in which a mechanism is looked at where a figure of the whole turn is asked for: every
4°, where a play that goes like a cosine is within 0.06 % of its extremes."""


@dataclass(frozen=True)
class Trial:
    """What the mechanisms did.

    Parameters
    ----------
    at
        Input position, rad; None for figures of a whole turn.
    mean, sigma
        Of the error, or of the value; of a point the length of the mean, and the root of the mean square
        distance from it.
    least, greatest
        Of all mechanisms; of a point 0 and the greatest distance.
    half_95, half_9973
        What 95 % and 99.73 % of the errors stay within, plus and minus; of a least value what so many
        reach.
    apart
        Mechanisms that could not be assembled.
    kept
        Mechanisms within ``limit``; None without one.
    """

    at: float | None
    samples: int
    mean: float
    sigma: float
    least: float
    greatest: float
    half_95: float
    half_9973: float
    apart: int
    limit: float | None
    kept: Share | None


def trials(
    model: ToleranceModel,
    wanted: dict[str, float | None],
    limits: dict[str, float | None],
    count: int,
    seed: int,
) -> dict[str, Trial]:
    """Try ``count`` mechanisms.

    Parameters
    ----------
    model
        The design.
    wanted
        Names of outputs, each with its input position, rad, or None for figures of the whole turn.
    limits
        Allowed error of each output, or None.
    count, seed
        How many, and which random numbers: the same give the same mechanisms, whatever the position.
    """
    outputs = {one.name: one for one in model.outputs if one.name in wanted}
    found: dict[str, list[Array]] = {name: [] for name in outputs}
    for deviations in _chunks(model, count, seed):
        for name, values in _values(model, outputs, wanted, deviations):
            found[name].append(values)
    return {
        name: _trial(outputs[name], np.concatenate(values, axis=1), wanted[name], limits[name])
        for name, values in found.items()
    }


def _chunks(model: ToleranceModel, count: int, seed: int) -> Iterator[list[Array]]:
    rng = np.random.default_rng(seed)
    for start in range(0, count, _CHUNK):
        yield draw(model.contributors, rng, min(_CHUNK, count - start))


def _values(
    model: ToleranceModel,
    outputs: dict[str, Output],
    wanted: dict[str, float | None],
    deviations: list[Array],
) -> Iterator[tuple[str, Array]]:
    """Errors or figures (c, k) of the mechanisms of one chunk, by output."""
    turn = model.positions[:: max(1, (model.positions.size - 1) // _TURN)]
    for name, output in outputs.items():
        at = wanted[name]
        if at is not None:
            yield name, model.errors(name, deviations, np.array(at))
            continue
        if output.figure == "steady":
            at = float(turn[0])
            yield name, model.nominal(name, np.array(at)) + model.errors(name, deviations, np.array(at))
            continue
        blocks = [
            _figure(model, output, [one[:, start : start + _BLOCK] for one in deviations], turn)
            for start in range(0, deviations[0].shape[1], _BLOCK)
        ]
        yield name, np.concatenate(blocks)[None]


def _figure(model: ToleranceModel, output: Output, deviations: list[Array], turn: Array) -> Array:
    """The figure (k,) of the whole turn."""
    errors = model.errors(output.name, [one[..., None] for one in deviations], turn)[0]
    values = model.nominal(output.name, turn)[0] + errors
    least: Array = values.min(axis=-1)
    return least if output.figure == "least" else values.max(axis=-1) - least


def _trial(output: Output, values: Array, at: float | None, limit: float | None) -> Trial:
    count = values.shape[1]
    values = values[:, np.isfinite(values).all(axis=0)]
    apart = count - values.shape[1]
    least = output.stays_above
    limit = 0.0 if least else limit
    if not values.size:
        none = (float("nan"),) * 6
        return Trial(at, count, *none, apart, limit, None if limit is None else share_of(0, count))
    middle = values.mean(axis=1)
    sigma = float(np.sqrt(((values - middle[:, None]) ** 2).sum(axis=0).mean()))
    point = output.components > 1
    size = np.sqrt((values * values).sum(axis=0)) if point else np.abs(values[0])
    low, high = (0.0, size.max()) if point else (values[0].min(), values[0].max())
    within = np.quantile(values[0], (0.05, 0.0027)) if least else np.quantile(size, (0.95, 0.9973))
    kept = None
    if limit is not None:
        kept = share_of(int(((values[0] >= limit) if least else (size <= limit)).sum()), count)
    mean = float(np.sqrt((middle * middle).sum())) if point else float(middle[0])
    return Trial(
        at,
        count,
        mean,
        sigma,
        float(low),
        float(high),
        float(within[0]),
        float(within[1]),
        apart,
        limit,
        kept,
    )
