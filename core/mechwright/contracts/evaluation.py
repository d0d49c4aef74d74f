"""Many designs at once: what a study varies, and what is found of every design, as columns."""

import math
import time
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError

from mechwright.arrays import Array
from mechwright.contracts.finding import Finding, Stage, errors
from mechwright.contracts.masses import is_mass, masses_of
from mechwright.contracts.parameters import Parameters, value_at
from mechwright.contracts.sampling import SAMPLES
from mechwright.contracts.slices import Slices
from mechwright.errors import MechwrightError, PluginFaultError

if TYPE_CHECKING:
    from mechwright.contracts.motion import Motion
    from mechwright.contracts.part import Part

P = TypeVar("P", bound=Parameters)
V = TypeVar("V", float, Array)

PARAMETERS = "parameters"
"""What forbids a design whose own table is refused, before its key: ``parameters.teeth``."""

MOTION = "motion"
"""What forbids a design whose check found nothing and whose motion is refused all the same."""


@dataclass(frozen=True)
class Batch(Generic[P]):
    """Designs that differ in some parameters.

    Parameters
    ----------
    model
        The family's table ``[parameters]``.
    content
        What all have in common, as a design file says it, defaults left out.
    varied
        Dotted name of a parameter to its values (n,) of the designs: numbers in the unit of the parameter, or
        texts.
    slices
        How far its evaluation goes now; None where it is not divided.
    """

    model: type[P]
    content: Mapping[str, Any]
    varied: Mapping[str, NDArray[Any]]
    slices: Slices | None = field(default=None, repr=False, compare=False)

    def __len__(self) -> int:
        return min((values.size for values in self.varied.values()), default=0)

    @cached_property
    def common(self) -> P:
        """What the designs have in common; of what is varied it has the first design's value."""
        return self.one(0)

    def __getitem__(self, name: str) -> NDArray[Any]:
        """The values (n,) of a parameter, varied or not; raises AttributeError where there is none."""
        if name in self.varied:
            return self.varied[name]
        return np.full(len(self), value_at(self.common, name))

    def at(self, places: NDArray[np.intp]) -> "Batch[P]":
        """Those at these places, not divided."""
        return Batch(self.model, self.content, {name: one[places] for name, one in self.varied.items()})

    def one(self, place: int) -> P:
        """One of the designs; raises pydantic's ValidationError where its table is refused."""
        content = _copied(self.content)
        for name, values in self.varied.items():
            *tables, key = name.split(".")
            table = content
            for step in tables:
                table = table.setdefault(step, {})
            table[key] = values[place].item()
        return self.model.model_validate(content)


def _copied(table: Mapping[str, Any]) -> dict[str, Any]:
    return {key: _copied(value) if isinstance(value, Mapping) else value for key, value in table.items()}


@dataclass(frozen=True)
class Columns:
    """What was found of the designs of a batch.

    Parameters
    ----------
    values
        Name of a column to its values (n,) float; NaN where a design is forbidden or has no such figure.
    forbidden
        (n,) of whole numbers: which of ``codes`` forbids the design.
    codes
        Codes of findings; the first is empty, which forbids nothing.
    """

    values: Mapping[str, Array]
    forbidden: NDArray[np.int32]
    codes: tuple[str, ...]

    @property
    def counts(self) -> dict[str, int]:
        """How many designs each code forbids, without those that are allowed, by name."""
        found = np.bincount(self.forbidden, minlength=len(self.codes))
        return {code: int(n) for code, n in sorted(zip(self.codes, found, strict=True)) if code and n}


def told_unit(unit: str) -> str:
    """The unit in which a column is told: angles are in degrees."""
    return "deg" if unit == "rad" else unit


def told(value: V, unit: str) -> V:
    """A number, or numbers, in the unit in which a column is told."""
    return value * math.degrees(1.0) if unit == "rad" else value


def figures(motion: "Motion") -> dict[str, tuple[float, str]]:
    """What a motion has for columns: its figures, and the extremes of every channel but the input.

    Name to value and unit. Names of channels are followed by ``.least`` and ``.greatest``.
    """
    found = {name: (one.value, one.unit) for name, one in motion.scalars.items()}
    for name, channel in motion.channels.items():
        if name != motion.input_name:
            found[f"{name}.least"] = float(channel.values.min()), channel.unit
            found[f"{name}.greatest"] = float(channel.values.max()), channel.unit
    return {name: (told(value, unit), told_unit(unit)) for name, (value, unit) in found.items()}


def one_by_one(
    judge: Callable[[P], Sequence[Finding]],
    solve: "Callable[[P, int], Motion]",
    batch: Batch[P],
    columns: Collection[str],
    stage: Stage,
    parts: "Callable[[P], Sequence[Part]] | None" = None,
    until: float = math.inf,
) -> Columns:
    """What :meth:`Family.evaluate` says, from ``judge`` and ``solve`` of one design after the other.

    Masses are those of ``parts``; without it, and up to the stage ``motion``, there are none. ``until`` is a
    reading of ``time.perf_counter``: from then on no design is begun but the first, and fewer are told of.
    """
    size = len(batch)
    values = {name: np.full(size, np.nan) for name in columns}
    forbidden = np.zeros(size, dtype=np.int32)
    codes: dict[str, int] = {"": 0}
    weighs = stage is not Stage.MOTION and any(map(is_mass, columns))
    moves = any(not is_mass(name) for name in columns)
    asked = _Asked(judge, solve if moves else None, parts if weighs else None, stage)
    for place in range(size):
        if place and time.perf_counter() >= until:
            values = {name: some[:place] for name, some in values.items()}
            return Columns(values, forbidden[:place], tuple(codes))
        code, found = _one(asked, batch, place)
        forbidden[place] = codes.setdefault(code, len(codes))
        for name in values.keys() & found.keys():
            values[name][place] = found[name]
    return Columns(values, forbidden, tuple(codes))


@dataclass(frozen=True)
class _Asked(Generic[P]):
    """How a design is judged, solved and weighed; None where that is not asked for."""

    judge: Callable[[P], Sequence[Finding]]
    solve: "Callable[[P, int], Motion] | None"
    parts: "Callable[[P], Sequence[Part]] | None"
    stage: Stage

    def found(self, params: P) -> dict[str, float]:
        """Column to its value; raises MechwrightError where the design does not move."""
        motion = {} if self.solve is None else figures(self.solve(params, SAMPLES))
        found = {name: value for name, (value, _) in motion.items()}
        return found if self.parts is None else found | masses_of(self.parts(params))


def _one(asked: _Asked[P], batch: Batch[P], place: int) -> tuple[str, dict[str, float]]:
    """What forbids a design, and its figures if nothing does."""
    try:
        params = batch.one(place)
    except ValidationError as error:
        keys = ".".join(str(step) for step in error.errors(include_url=False)[0]["loc"])
        return f"{PARAMETERS}.{keys}" if keys else PARAMETERS, {}
    stopping = errors(asked.judge(params), asked.stage)
    if stopping:
        return stopping[0].code, {}
    try:
        return "", asked.found(params)
    except PluginFaultError as error:  # no figure of the family's can be trusted then
        values = ", ".join(f"{name} = {values[place]}" for name, values in batch.varied.items())
        raise PluginFaultError(f"{error}; it was asked for {values}") from error
    except MechwrightError:
        return MOTION, {}
