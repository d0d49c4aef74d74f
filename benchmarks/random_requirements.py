"""Requirements of every family and kind, drawn near what they are by default."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
from pydantic import ValidationError

from mechwright import Family, Parameters
from mechwright.plugins.host import host

EFFORT = ("starts", "tried", "atlas", "seed", "designs")
"""Keys that say how long is sought, and what is given: as by default."""

CHANGED = 3
"""Most numbers of a requirement that are drawn anew."""

TRIES = 200
"""Draws after which a kind has no requirement near its default."""


def kinds() -> list[tuple[str, str]]:
    """Family and kind of every synthesis that is installed."""
    families = (host().family(name) for name in host().of(Family))
    return [(family.name, kind) for family in families for kind in family.requirements]


def near_default(family: str, kind: str, rng: np.random.Generator) -> dict[str, Any]:
    """Keys of a requirement that its model takes."""
    model = host().family(family).requirements[kind]
    for _ in range(TRIES):
        table = dict(drawn(model, rng))
        try:
            model.model_validate(table)
        except ValidationError:
            continue
        return table
    raise LookupError(f"{family} {kind}: no requirement near its default is valid")


def drawn(model: type[Parameters], rng: np.random.Generator) -> Iterator[tuple[str, Any]]:
    """Lists of numbers, all of one by one factor and each by one of its own, and some single numbers."""
    fields = {
        name: field.get_default(call_default_factory=True) for name, field in model.model_fields.items()
    }
    whole = rng.uniform(0.7, 1.5)
    noise = float(rng.choice((0.0, 0.01, 0.04)))
    for name, value in fields.items():
        if isinstance(value, tuple) and value and isinstance(value[0], tuple):
            yield name, _scaled(value, whole, noise, rng)
    single = [
        name
        for name, value in fields.items()
        if name not in EFFORT and isinstance(value, float | int) and not isinstance(value, bool) and value
    ]
    for name in rng.choice(single, min(len(single), int(rng.integers(1, CHANGED + 1))), replace=False):
        value = fields[str(name)] * math.exp(rng.uniform(-0.4, 0.4))
        yield str(name), round(value) if isinstance(fields[str(name)], int) else float(f"{value:.3g}")


def _scaled(value: Any, whole: float, noise: float, rng: np.random.Generator) -> Any:
    if isinstance(value, tuple):
        return [_scaled(one, whole, noise, rng) for one in value]
    return round(float(value) * whole * (1 + noise * rng.normal()), 4)
