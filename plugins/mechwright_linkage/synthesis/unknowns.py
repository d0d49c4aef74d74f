"""The dimensions of a linkage of the catalogue as unknowns of a search, and its motion for many of them.

A length is its logarithm over that of the entry, a coordinate its difference from that of the entry over the
entry's mean length, an angle its difference in rad.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mechwright import Array
from mechwright.mechanics.linkage.linkage import Linkage
from mechwright.mechanics.planar.machine import Revolute
from mechwright.mechanics.planar.positions import Solution, solve
from mechwright.mechanics.planar.rigid import Turning
from mechwright.units import Unit
from mechwright_linkage.catalogue.entry import Entry

SPREAD, ASIDE = 0.45, 0.5
"""Of random linkages: standard deviation of the logarithms of lengths, of coordinates and angles."""


@dataclass(frozen=True)
class Unknowns:
    """The unknowns of an entry; rows (n, m) are linkages."""

    entry: Entry

    @cached_property
    def names(self) -> tuple[str, ...]:
        """The dimensions; signs and counts stay as they are."""
        return tuple(
            name for name in type(self.entry).model_fields if isinstance(getattr(self.entry, name), float)
        )

    @cached_property
    def size(self) -> float:
        """Mean of the lengths, mm."""
        lengths = [abs(float(getattr(self.entry, name))) for name in self.names if self._unit(name) == "mm"]
        return float(np.mean(lengths))

    def _unit(self, name: str) -> str:
        field = type(self.entry).model_fields[name]
        return next((one.symbol for one in field.metadata if isinstance(one, Unit)), "")

    def _is_length(self, name: str) -> bool:
        field = type(self.entry).model_fields[name]
        low = next((one.ge for one in field.metadata if hasattr(one, "ge")), None)
        return self._unit(name) == "mm" and low is not None and low > 0

    def random(self, count: int, rng: np.random.Generator) -> Array:
        """Random linkages (n, m) about the entry; the first is the entry itself."""
        spread = np.array([SPREAD if self._is_length(name) else ASIDE for name in self.names])
        found = spread * rng.standard_normal((count, len(self.names)))
        found[0] = 0.0
        return found

    def entry_of(self, x: Array) -> Entry:
        """The entry with columns (n, 1) of dimensions."""
        columns = {}
        for place, name in enumerate(self.names):
            value, change = float(getattr(self.entry, name)), x[:, place : place + 1]
            if self._is_length(name):
                columns[name] = value * np.exp(change)
            elif self._unit(name) == "mm":
                columns[name] = value + self.size * change
            else:
                columns[name] = value + np.degrees(change)
        return self.entry.model_copy(update=columns)

    def plain(self, x: Array, scale: float = 1.0) -> Entry:
        """The entry of one row (m,) with plain numbers; raises ValidationError beyond its bounds."""
        found = self.entry_of(x[None])
        values = {
            name: float(np.ravel(getattr(found, name))[0]) * (scale if self._unit(name) == "mm" else 1.0)
            for name in self.names
        }
        return type(self.entry).model_validate(self.entry.model_dump() | values)

    def moved(self, x: Array, inputs: Array) -> tuple[Linkage, Solution]:
        """The linkages of rows, and their motion at inputs (n, k) or (k,)."""
        linkage = self.entry_of(x).linkage()
        return linkage, solve(linkage.machine, [Turning.of(inputs, 1.0)])


def joint_distances(linkage: Linkage) -> Array:
    """Distances of the pins of each link (n, k), mm."""
    places: dict[str, list[Array]] = {}
    for joint in linkage.machine.joints:
        if isinstance(joint, Revolute):
            for link in joint.links:
                places.setdefault(link, []).append(np.asarray(joint.place(link), complex))
    found = [
        np.abs(one - two)
        for own in places.values()
        for number, one in enumerate(own)
        for two in own[:number]
        if np.any(np.abs(one - two) > 0)
    ]
    return np.concatenate(np.broadcast_arrays(*[np.atleast_2d(one) for one in found]), axis=-1)
