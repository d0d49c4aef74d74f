"""Random designs of a family inside the published bounds, each from a seed of its own.

``likely``: every key is left out half of the time; else a third are the default, a third lie between half and
twice of it, and a third anywhere within the bounds, as in the test kit. ``whole``: every key is drawn evenly
from all of its bounds. Lists and free texts are left out; tables that validation refuses are drawn again, and
after 200 of them the keys that the refusals speak of are left out.
:func:`near` draws about a design: each number that its file says is kept half of the time, else it lies
between 0.7 and 1.4 times what it is.
"""

import copy
from collections.abc import Iterator, Mapping
from itertools import count
from pathlib import Path
from typing import Any

import numpy as np

from mechwright import Design, DesignError, Family, Host
from mechwright.designs.change import changed
from mechwright.designs.design import design_of
from mechwright.remedies.keys import Key, keys_of, named

WAYS = ("likely", "whole")
_AGAIN = 200
"""Tables that are drawn anew; of the next ones what they may not say is left out. Families whose keys belong
to one of many laws have hardly any table that is right by chance."""


def designs(
    family: Family[Any], host: Host, seed: int, numbers: range, way: str, again: int = _AGAIN
) -> Iterator[Design]:
    """The designs with these numbers; the same seed and number, and tables drawn anew, give the same one."""
    head = {"format": 1, "family": family.name, "name": "random"}
    start = design_of(head, Path("random.toml"), "", host)
    keys = [
        key for key in keys_of(start).values() if key.path.startswith("parameters.") and key.kind != "other"
    ]
    for number in numbers:
        rng = np.random.default_rng([seed, number, WAYS.index(way)])
        for tried in count():
            table = _table(keys, rng, way)
            try:
                yield design_of({**head, "parameters": table}, Path("random.toml"), "", host)
            except DesignError as error:
                content = {**head, "parameters": table}
                fewer = without(keys, content, str(error), rng, host) if tried >= again else None
                if fewer is None:
                    continue
                yield fewer
            break


def without(
    keys: list[Key], content: Mapping[str, Any], refusal: str, rng: np.random.Generator, host: Host
) -> Design | None:
    """The design without the keys that refusals speak of, or else those of the tables that they speak of.

    One by one; None where refusals speak of none.
    """
    known = {key.path: key for key in keys}
    while True:
        every = [key for key in keys if key.stands_in(content)]
        named_here = [key for key in named(refusal, known) if key in every]
        stand = named_here or [key for key in every if f"{key.path.rpartition('.')[0]}:" in refusal]
        if not stand:
            return None
        content = changed(content, {stand[rng.integers(len(stand))].path: None})
        try:
            return design_of(content, Path("random.toml"), "", host)
        except DesignError as error:
            refusal = str(error)


def near(start: Design, host: Host, seed: int, numbers: range) -> Iterator[Design]:
    """Designs about one with these numbers; the same seed and number give the same one."""
    keys = [
        key
        for key in keys_of(start).values()
        if key.numeric and key.path.startswith("parameters.") and key.stands_in(start.content)
    ]
    for number in numbers:
        rng = np.random.default_rng([seed, number, len(WAYS)])
        while True:
            content = copy.deepcopy(dict(start.content))
            for key in keys:
                if rng.integers(2):
                    continue
                value = min(max(float(f"{key.now(content) * rng.uniform(0.7, 1.4):.4g}"), key.low), key.high)
                *tables, name = key.path.split(".")
                inner = content
                for one in tables:
                    inner = inner[one]
                inner[name] = round(value) if key.kind == "integer" else value
            try:
                yield design_of(content, Path("random.toml"), "", host)
            except DesignError:
                continue
            break


def _table(keys: list[Key], rng: np.random.Generator, way: str) -> Mapping[str, Any]:
    table: dict[str, Any] = {}
    for key in keys:
        if way == "likely" and rng.integers(2):
            continue
        inner = table
        *tables, name = key.path.split(".")[1:]
        for one in tables:
            inner = inner.setdefault(one, {})
        inner[name] = drawn(key, rng, way)
    return table


def drawn(key: Key, rng: np.random.Generator, way: str) -> Any:
    """A value of a key."""
    if not key.numeric:
        return key.choices[rng.integers(len(key.choices))]
    low, high = key.low, key.high
    if way == "likely" and isinstance(key.default, int | float):
        choice = rng.integers(3)
        if choice == 0:
            return key.default
        if choice == 1 and key.default:
            near = sorted((key.default / 2, key.default * 2))
            low, high = max(low, near[0]), min(high, near[1])
    if key.kind == "integer":
        return int(rng.integers(np.ceil(low), np.floor(high), endpoint=True))
    return min(max(float(f"{rng.uniform(low, high):.4g}"), key.low), key.high)
