"""What a family says of its stresses: which is the worst, how safe it is, and what would make it safe.

A stress up to what is allowed is a note; above that a warning, for it wears or tires; from what the material
yields or breaks at an error. What a remedy names has been tried.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError

from mechwright.contracts.design_table import DesignTable, column
from mechwright.contracts.finding import Change, Finding, Severity, Stage, at_stage
from mechwright.contracts.parameters import Parameters
from mechwright.errors import MechwrightError
from mechwright.tolerances import exceeds

P = TypeVar("P", bound=Parameters)
D = TypeVar("D", bound=DesignTable[Any])

STUD_SHARE, SHEAR_SHARE = 0.4, 0.2
"""Share of the endurance limit of a polished bar that pins, studs and shafts bear in bending and in shear: a
press fit or a shoulder takes 1.7 of it, and a safety of 1.5. Of steel 120 and 60 MPa, as in
handbooks."""

SLOWEST = 1.0
"""rev/min. A mechanism that would have to run slower to bear its load is no longer the one that was asked
for: its speed is no remedy."""

_LOOKS = 6
"""At values of a key, each from the slope of the two before: stresses are powers of it, or nearly so."""

_NEAR = 0.03
"""Share of what is allowed that a value may leave unused."""

_AIM = 0.005
"""That is aimed at."""

_FLAT = 0.05
"""Power of a key below which it does not help: another load is the larger one."""

_LEAST = 1e-12
"""Share that counts as no load."""

_FARTHEST = math.log(500)
"""A value is changed up to 500 times, or to a 500th: more is another design."""

_DIGITS = 3
"""Of a value that is named."""


@dataclass(frozen=True)
class Stress:
    """One stress of a part.

    Parameters
    ----------
    what
        Where it is and what makes it: ``"bending at the root of gear 2's teeth"``.
    value, limit
        The stress, and what is allowed for long, in ``unit``.
    breaks
        From where the part yields or breaks; None where more than allowed only wears.
    unit
        Of all three.
    """

    what: str
    value: float
    limit: float
    breaks: float | None = None
    unit: str = "MPa"

    @property
    def used(self) -> float:
        """Share of what is allowed."""
        return self.value / self.limit

    @property
    def severity(self) -> Severity:
        """Of the finding that says it."""
        if not exceeds(self.value, self.limit):
            return Severity.NOTE
        fails = self.breaks is not None and exceeds(self.value, self.breaks)
        return Severity.ERROR if fails else Severity.WARNING


def worst(stresses: Sequence[Stress]) -> Stress:
    """The one that fails, else that with the greatest share of what is allowed."""
    return max(stresses, key=lambda one: (one.severity is Severity.ERROR, one.used))


@dataclass(frozen=True)
class Way:
    """A key of the design that helps, and its value now: ``up`` where more of it does, else less."""

    key: str
    now: float
    up: bool = True


def judged(
    code: str,
    params: P,
    stresses_of: Callable[[P], Sequence[Stress]],
    ways: Sequence[Way],
    load: str = "",
    *,
    advise: bool = True,
) -> Iterator[Finding]:
    """One finding on the worst of a group's stresses.

    Parameters
    ----------
    code
        Of the finding.
    params
        The design.
    stresses_of
        The stresses of any design; where there are none, or all are 0, there is nothing to say.
    ways
        What helps, the best first: those whose values have been found to help are named. The finding has
        the first of them as its parameter, with ``advise`` and without.
    load
        What loads the parts, for the message: ``"408 N at 12 degrees"``.
    advise
        Whether values that help are sought, each of which takes the stresses of a few more designs: a judge,
        asked of one design after the other, has no use for them.
    """
    stresses = stresses_of(params)
    if not stresses:
        return
    one = worst(stresses)
    if one.value == 0:
        return
    under = f"{load}: " if load else ""
    said = f"{under}{one.what} {one.value:.4g} {one.unit}, {one.limit:g} allowed"
    if one.severity is Severity.NOTE:
        yield Finding.note(code, said, one.value, one.unit)
        return
    asked = ways if advise else ()
    helps = [(way, value) for way in asked if (value := _tried(params, stresses_of, way)) is not None]
    words = [f"{way.key} at {'least' if way.up == (value > 0) else 'most'} {value:g}" for way, value in helps]
    changes: list[Change] = [{f"parameters.{way.key}": value} for way, value in helps]
    fails = one.severity is Severity.ERROR and one.breaks is not None
    yield Finding(
        code,
        one.severity,
        ways[0].key,
        said + (f", and it fails from {one.breaks:.4g}" if fails else ""),
        one.value,
        one.limit,
        one.unit,
        f"make {', or '.join(words)}" if words else "take a stronger material, larger parts or less load",
        proposed=tuple(changes),
    )


@dataclass(frozen=True)
class StressRule(Generic[D]):
    """The worst of a group of stresses, as a rule of a family (:mod:`mechwright.contracts.design_rule`).

    Parameters
    ----------
    code
        Of the finding.
    stresses
        The stresses of a design; of a table their values, and what depends on the design, are columns.
    ways
        What helps, the best first.
    again
        The same mechanism with other parameters.
    load
        What loads the parts.
    stage
        Of the finding.
    bears
        Which designs certainly bear their loads, a truth value or a column found cheaply: a table and the
        quick judge ask no stresses of them.
    """

    code: str
    stresses: Callable[[D], Sequence[Stress]]
    ways: Callable[[D], Sequence[Way]]
    again: Callable[[Any], D]
    load: Callable[[D], str] | None = None
    stage: Stage = Stage.PARTS
    bears: Callable[[D], Any] | None = None

    @property
    def codes(self) -> Sequence[str]:
        """Its code."""
        return (self.code,)

    def forbids(self, table: D, stage: Stage) -> NDArray[np.bool_] | None:
        """Give the designs (n,) in which a stress breaks a part; None if the stage is an earlier one."""
        if self.stage.is_after(stage):
            return None
        if self.bears is None or table.single:
            return self._breaks(table)
        wrong: NDArray[np.bool_] = column(self.bears(table), table.size)[:, 0] == 0
        if wrong.any():
            wrong[wrong] = self._breaks(table.rows(np.flatnonzero(wrong)))
        return wrong

    def _breaks(self, table: D) -> NDArray[np.bool_]:
        wrong = np.zeros(table.size, bool)
        for one in self.stresses(table):
            if one.breaks is not None:
                fails = exceeds(one.value, one.limit) & np.asarray(exceeds(one.value, one.breaks))
                wrong |= column(fails, table.size)[:, 0] > 0
        return wrong

    def findings(self, m: D, *, quick: bool) -> Iterator[Finding]:
        """Give the finding of one design, with sizes that bear the load if it is not ``quick``."""
        if quick and self.bears is not None and np.all(self.bears(m)):
            return
        own = m.params
        found = judged(
            self.code,
            own,
            lambda params: self.stresses(m if params is own else self.again(params)),
            self.ways(m),
            "" if self.load is None else self.load(m),
            advise=not quick,
        )
        yield from at_stage(
            self.stage, (one for one in found if not (quick and one.severity is Severity.NOTE))
        )


@dataclass(frozen=True)
class RowStressRule(StressRule[D]):
    """A rule of stresses that are those of one design; ``breaks`` is whether one of them breaks a part."""

    breaks: bool = False

    def forbids(self, table: D, stage: Stage) -> NDArray[np.bool_] | None:
        """Give the designs (n,) in which a stress breaks a part, found row by row; None where none can."""
        return super().forbids(table, stage) if self.breaks else None

    def _breaks(self, table: D) -> NDArray[np.bool_]:
        return np.array([self._fails(table.row(place)) for place in range(table.size)], bool)

    def _fails(self, m: D) -> bool:
        found = self.stresses(m)
        return bool(found) and worst(found).severity is Severity.ERROR


def _tried(params: P, stresses_of: Callable[[P], Sequence[Stress]], way: Way) -> float | None:
    """The value of a key nearest to what it is with which all stresses are allowed; None without one."""
    if way.now == 0:
        return None
    # Logarithms of the change and of the share that is used; a power law is a straight line in them.
    at, over = 0.0, _share(stresses_of(params))
    step = over / 3
    best: tuple[float, float] | None = None
    for _ in range(_LOOKS):
        change = min(at + step, _FARTHEST)
        value = _rounded(way.now * math.exp(change if way.up else -change), way.up)
        try:
            better = type(params).model_validate(params.model_dump() | {way.key: value})
            used = _share(stresses_of(better))
        except (ValidationError, MechwrightError):  # there is no such design
            break
        if used <= 0:
            best = min(best or (change, value), (change, value))
            if used > -_NEAR:
                break
        if change == at:
            break
        slope = (over - used) / (change - at)
        at, over = change, used
        if slope < _FLAT:
            break
        step = (used + _AIM) / slope
    return None if best is None else best[1]


def _share(stresses: Sequence[Stress]) -> float:
    """The logarithm of the greatest share of what is allowed; a hair too much passes, as in a finding."""
    used = max((one.used for one in stresses), default=0.0)
    return math.log(max(used, _LEAST)) if exceeds(used, 1.0) else min(0.0, math.log(max(used, _LEAST)))


def _rounded(value: float, up: bool) -> float:
    """To three digits, up or down; of a value below 0 its size is.

    >>> _rounded(12.341, True), _rounded(12.349, False), _rounded(-0.12349, False)
    (12.4, 12.3, -0.123)
    """
    step = 10.0 ** (math.floor(math.log10(abs(value))) - _DIGITS + 1)
    size = (math.ceil if up else math.floor)(abs(value) / step) * step
    return math.copysign(float(f"{size:.{_DIGITS}g}"), value)
