"""Axial stacks of a machine: added up again from what the papers say of each length."""

import json
import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import product
from typing import Any

from mechwright.contracts.axial_stack import AxialStack
from mechwright.contracts.part import Part

NAME = "stacks.json"

SAME = 2e-6
"""Rounding of the file, mm."""


def stack_faults(
    parts: Sequence[Part], stacks: Sequence[AxialStack], files: Mapping[str, bytes]
) -> Iterator[str]:
    """Stacks that are not told, do not add up, do not close at their worst, or have lengths of their own."""
    if not stacks:
        return
    if NAME not in files:
        yield f"{NAME} is not there"
        return
    told = {one["name"]: one for one in json.loads(files[NAME])}
    yield from (f"{NAME}: no {one.name}" for one in stacks if one.name not in told)
    named = {part.name: part for part in parts}
    for stack in stacks:
        if stack.name in told:
            yield from _sums(told[stack.name], stack)
            yield from _lengths(told[stack.name], named)


def _sums(told: Mapping[str, Any], stack: AxialStack) -> Iterator[str]:
    low = sum(min(s * (n + l), s * (n + u)) for s, n, l, u in _rows(told))
    high = sum(max(s * (n + l), s * (n + u)) for s, n, l, u in _rows(told))
    if max(abs(low - told["worst"][0]), abs(high - told["worst"][1])) > SAME * len(told["lengths"]):
        yield f"{NAME}: {stack.name} is {low:.4f} to {high:.4f} mm, and {told['worst']} is told"
    if stack.shimming is not None:
        low, high = _with_rings(low, high, stack)
    least, most = told["meant"][0], math.inf if told["meant"][1] is None else told["meant"][1]
    if low < least - 1e-6 or high > most + 1e-6:
        yield f"{NAME}: {stack.name} closes to {low:.4f} to {high:.4f} mm, and {told['meant']} is meant"


def _rows(told: Mapping[str, Any]) -> list[tuple[int, float, float, float]]:
    return [(one["sign"], one["nominal"], one["lower"], one["upper"]) for one in told["lengths"]]


def _with_rings(low: float, high: float, stack: AxialStack) -> tuple[float, float]:
    """Least and greatest play after a fitter has measured a gap and put in rings: all gaps are tried."""
    shimming = stack.shimming
    assert shimming is not None
    left = []
    steps = max(2, math.ceil((high - low) / 0.001))
    for k, off in product(range(steps + 1), (-shimming.reading, 0.0, shimming.reading)):
        gap = low + (high - low) * k / steps
        rings = shimming.rings(gap + off)
        left += [gap - sum(rings), gap - sum(rings) + shimming.thinner * len(rings)]
    return min(left), max(left)


def _lengths(told: Mapping[str, Any], named: Mapping[str, Part]) -> Iterator[str]:
    """Lengths that their parts have otherwise."""
    for one in told["lengths"]:
        part = named.get(one["part"])
        if one["part"] and part is None:
            yield f"{NAME}: {told['name']} has a length of {one['part']}, which is no part"
        for own in part.turned.lengths if part is not None and part.turned is not None else ():
            if own.name == one["name"]:
                same = (own.nominal, own.lower, own.upper) == (one["nominal"], one["lower"], one["upper"])
                if not same:
                    yield f"{NAME}: {one['name']} of {part.name} differs from its drawing"
