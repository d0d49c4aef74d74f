"""What is wrong with a law that a user wrote."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from mechwright.mechanics.laws.law import Law
from mechwright.mechanics.laws.polynomial import Polynomial

ENDS = 1e-6
"""How far s and ds/du may be off at the ends: a thousandth of a degree on the largest stroke there is."""

REST = 0.05
"""Velocity ds/du at an end of a table that still counts as rest: 5 % of the mean velocity. The slope of
eleven rows of a usual law is known no better."""

BACKWARDS = 1e-9
"""Negative velocity ds/du that is rounding."""

RIPPLE = 0.005
"""Negative velocity ds/du of a table that is the rounding of its rows to five digits."""

LEAST_ROWS = 11
"""Rows of a table: a quintic through fewer is a guess."""

WIDEST_STEP = 0.1
"""Widest step of a table in u: shorter than an eighth, the shortest piece of the named laws."""

GAP = 3.0
"""A step of a table this many times its median step is a gap where rows are missing."""


@dataclass(frozen=True, slots=True)
class LawFault:
    """One fault: what it is about (``"ends"``, ``"rest"``, ``"monotone"``, ``"gap"``, ``"rows"``), in words.

    ``value`` was found, ``limit`` is what it is compared with, ``remedy`` says what to do.
    """

    kind: str
    message: str
    value: float
    limit: float
    remedy: str


def polynomial_faults(coefficients: Sequence[float]) -> Iterator[LawFault]:
    """What keeps coefficients c0, c1, … from being a law.

    >>> [fault.kind for fault in polynomial_faults([0, 0, 1])]
    ['rest']
    """
    law = Polynomial(coefficients)
    found = list(_end_faults(law))
    yield from found
    if not found:
        yield from _backwards(law, BACKWARDS * max(1.0, law.peaks.v))


def table_faults(rows: Sequence[tuple[float, float]]) -> Iterator[LawFault]:
    """What keeps rows of (u, s) from being a law."""
    if len(rows) < LEAST_ROWS:
        yield LawFault(
            "rows", f"the table has {len(rows)} rows", len(rows), LEAST_ROWS, f"give {LEAST_ROWS} or more"
        )
        return
    u, s = np.asarray(rows, dtype=float).T
    steps = np.diff(u)
    if not (steps > 0).all():
        at = int(np.argmin(steps))
        yield LawFault(
            "rows",
            f"row {at + 2} has u = {u[at + 1]:g} after u = {u[at]:g}",
            float(steps[at]),
            0.0,
            "sort the rows by u, each u once",
        )
        return
    for end, what in ((0, "first"), (-1, "last")):
        wanted = float(end != 0)
        for value, name in ((u[end], "u"), (s[end], "s")):
            if abs(value - wanted) > ENDS:
                yield LawFault(
                    "ends",
                    f"the {what} row has {name} = {value:g}",
                    float(value),
                    wanted,
                    f"the table runs from (0, 0) to (1, 1): make it {wanted:g}",
                )
                return
    widest = min(WIDEST_STEP, GAP * float(np.median(steps)))
    if steps.max() > widest * (1 + ENDS):
        at = int(np.argmax(steps))
        yield LawFault(
            "gap",
            f"no row between u = {u[at]:g} and u = {u[at + 1]:g}",
            float(steps[at]),
            widest,
            f"give rows at most {math.floor(widest * 1e4) / 1e4:g} apart there",
        )
        return
    falls = np.diff(s)
    if falls.min() < 0:
        at = int(np.argmin(falls))
        yield LawFault(
            "monotone",
            f"s falls from {s[at]:g} to {s[at + 1]:g} after u = {u[at]:g}",
            float(falls[at]),
            0.0,
            "s never falls",
        )
        return
    from mechwright.mechanics.laws.table import Table

    law = Table(rows)
    for velocity, what in zip(law.end_velocities, ("start", "end"), strict=True):
        if abs(velocity) > REST:
            yield LawFault(
                "rest",
                f"the rows {what} with ds/du = {velocity:.3f}",
                velocity,
                REST,
                f"let s be level at its {what}",
            )
            return
    yield from _backwards(law, RIPPLE)


def _end_faults(law: Law) -> Iterator[LawFault]:
    ends = law.at(np.array([0.0, 1.0]))
    for wanted in (0, 1):
        place = f"u = {wanted}"
        if abs(ends.s[wanted] - wanted) > ENDS:
            yield LawFault(
                "ends",
                f"s = {ends.s[wanted]:.6g} at {place}",
                float(ends.s[wanted]),
                float(wanted),
                f"s has to be {wanted} there",
            )
        elif abs(ends.v[wanted]) > ENDS:
            yield LawFault(
                "rest",
                f"ds/du = {ends.v[wanted]:.4g} at {place}: the law is not at rest there",
                float(ends.v[wanted]),
                ENDS,
                "ds/du has to be 0 at both ends",
            )


def _backwards(law: Law, rounding: float) -> Iterator[LawFault]:
    if law.least_velocity < -rounding:
        yield LawFault(
            "monotone",
            f"ds/du falls to {law.least_velocity:.4g}: the output would run backwards",
            law.least_velocity,
            0.0,
            "s never falls",
        )
