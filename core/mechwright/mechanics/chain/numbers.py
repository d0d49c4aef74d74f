"""Numbers of a chain's stages that a search may change, by their keys."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from mechwright.contracts.parameters import Parameters
from mechwright.errors import DesignError
from mechwright.mechanics.chain.params import ChainParams, StageTable
from mechwright.mechanics.chain.wanted import FreeKey

_GRID = 4000
"""Steps of the bounds: what is found has few digits, and can be read."""

OWN = ("start", "turned", "gap")
"""Numbers of a stage besides those of its family."""


@dataclass(frozen=True)
class Numbers:
    """The free numbers of a chain.

    Parameters
    ----------
    free
        Keys and bounds.
    base
        The chain that they belong to.
    whole
        Whether each is a whole number.
    begin
        Where the chain itself stands within the bounds, 0 to 1 each, at their ends where it lies beyond.
    """

    free: tuple[FreeKey, ...]
    base: ChainParams
    whole: tuple[bool, ...]
    begin: tuple[float, ...]

    @classmethod
    def of(cls, free: tuple[FreeKey, ...], base: ChainParams) -> "Numbers":
        """Raises DesignError, with the key, for what is no number of a stage."""
        values = [number_at(base, one.key) for one in free]
        whole = tuple(isinstance(value, int) for value in values)
        shares = ((value - one.low) / (one.high - one.low) for one, value in zip(free, values, strict=True))
        return cls(free, base, whole, tuple(min(1.0, max(0.0, float(share))) for share in shares))

    def values(self, place: Sequence[float]) -> dict[str, float]:
        """Key to value at a place, rounded."""
        return {
            one.key: _rounded(one.low + share * (one.high - one.low), one, whole)
            for one, share, whole in zip(self.free, place, self.whole, strict=True)
        }

    def rounded(self, place: Sequence[float]) -> tuple[float, ...]:
        """The place of the rounded values."""
        values = self.values(place).values()
        return tuple(
            (value - one.low) / (one.high - one.low) for one, value in zip(self.free, values, strict=True)
        )

    def at(self, place: Sequence[float]) -> ChainParams:
        """The chain at a place; raises ValidationError where a family has no such mechanism."""
        stages = list(self.base.stage)
        changes: dict[int, dict[str, Any]] = {}
        for (key, value), whole in zip(self.values(place).items(), self.whole, strict=True):
            number, *way = key.split(".")[1:]
            told, at = int(value) if whole else value, int(number) - 1
            if way[0] in OWN:
                stages[at] = StageTable.model_validate({**dict(stages[at]), way[0]: told})
                continue
            own = changes.setdefault(at, _given(stages[at].parameters))
            if len(way) == 2:
                own[way[1]] = told
            else:
                row = list(own.get(way[1], getattr(stages[at].parameters, way[1])))
                row[int(way[2]) - 1] = told
                own[way[1]] = tuple(row)
        for at, own in changes.items():
            params = type(stages[at].parameters).model_validate(own)
            stages[at] = stages[at].model_copy(update={"parameters": params})
        return ChainParams(stage=tuple(stages))


def _given(params: Parameters) -> dict[str, Any]:
    """What a table says itself."""
    return params.model_dump(include=set(params.model_fields_set))


def _rounded(value: float, one: FreeKey, whole: bool) -> float:
    if whole:
        return float(round(value))
    step = (one.high - one.low) / _GRID
    return float(f"{one.low + round((value - one.low) / step) * step:.6g}")


def number_at(base: ChainParams, key: str) -> float:
    """The number that a key leads to; raises DesignError with the key where there is none."""
    parts = key.split(".")
    where = f"requirement.free: {key}"
    if len(parts) < 3 or parts[0] != "stage" or not parts[1].isdecimal():
        raise DesignError(f'{where} is no key of a stage; write one as "stage.1.parameters.teeth"')
    if not 1 <= int(parts[1]) <= len(base.stage):
        raise DesignError(f"{where}: there are {len(base.stage)} stages")
    stage = base.stage[int(parts[1]) - 1]
    found: Any = stage
    for name in parts[2:]:
        if isinstance(found, tuple) and name.isdecimal() and 1 <= int(name) <= len(found):
            found = found[int(name) - 1]
        elif isinstance(found, Parameters) and name in type(found).model_fields:
            found = getattr(found, name)
        else:
            raise DesignError(f"{where}: stage {parts[1]}, {stage.family}, has no {'.'.join(parts[2:])}")
    allowed = parts[2] in OWN if len(parts) == 3 else parts[2] == "parameters" and len(parts) <= 5
    if isinstance(found, bool) or not isinstance(found, int | float) or not allowed:
        raise DesignError(f"{where} is no number of the file; give it a value in its stage, or leave it out")
    return found
