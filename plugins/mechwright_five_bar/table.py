"""One five-bar, or a table of them: links, how far the crank goes, and the transmission angle.

Every quantity is a number for one linkage and a column (n, 1) for many; lengths in mm, angles in rad.
"""

import math
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any, ClassVar, cast

import numpy as np
from numpy.typing import NDArray

from mechwright import Array
from mechwright.contracts.design_table import column, plain, with_columns
from mechwright.mechanics.linkage.linkage import Linkage
from mechwright.mechanics.linkage.planar_table import PlanarTable
from mechwright.mechanics.planar import swing
from mechwright.mechanics.planar.course import Ways
from mechwright.mechanics.planar.efforts import PointLoad
from mechwright.mechanics.planar.swing import TURN_BACK
from mechwright_five_bar.kinematics.dimensions import FiveBar, bar_of
from mechwright_five_bar.kinematics.phases import in_phase, phases_of
from mechwright_five_bar.kinematics.reach import (
    Interval,
    angles_of_distance,
    bounds_of_distance,
    range_of_distance,
    reach,
)
from mechwright_five_bar.kinematics.train import Train, train_of
from mechwright_five_bar.parameters import FiveBarParams
from mechwright_five_bar.parts.hardware import turning_bore
from mechwright_five_bar.parts.layout import Layout, laid_out

DISTANCE_BLOCK = 256
"""Linkages whose distances are sampled at once: arrays stay in the cache."""


class FiveBarTable(PlanarTable[FiveBarParams]):
    """One five-bar, or five-bars whose gears have the same teeth; see :class:`PlanarTable`."""

    code = "five-bar"
    dead_sine = 1e-6
    unloading: ClassVar[Mapping[str, Any]] = {"load_x": 0.0, "load_y": 0.0, "speed": 1.0}

    def row(self, place: int) -> "FiveBarTable":
        """One of the linkages, with what its table leaves out."""
        if self.single:
            return self
        return FiveBarTable.of(with_columns(plain(self.given, place, self.size), {}))

    def each_shape(self) -> "list[FiveBarTable]":
        """All of the linkages one by one, in their first phase, with gears of the default width."""
        if self.single:
            return [self]
        return [FiveBarTable(plain(self.params, place, self.size)) for place in range(self.size)]

    @cached_property
    def params(self) -> FiveBarParams:
        """The parameters of a design that shows its first phase.

        Raises KinematicsError for one whose links cannot be joined in the pose of setting.
        """
        return in_phase(self.given)

    @cached_property
    def phases(self) -> "tuple[FiveBarTable, ...]":
        """The linkage in its other phases."""
        size = None if self.single else self.size
        return tuple(FiveBarTable(one, size) for one in phases_of(self.params)[1:])

    @property
    def bar(self) -> FiveBar:
        """The dimensions."""
        return bar_of(self.params)

    @property
    def linkage(self) -> Linkage:
        """Crank, coupler, rocker and arm, and the coupler point P."""
        points = {"coupler": {"P": self.params.coupler_point}}
        return Linkage(self.bar.machine, points, "coupler", {"P": ("coupler", "P")})

    @property
    def loads(self) -> Sequence[PointLoad]:
        """That on the coupler point."""
        params = self.params
        return [PointLoad("coupler", params.coupler_point, params.load_x + 1j * params.load_y)]

    def laid_out(self) -> Any:
        """Plates and layers that keep apart in all phases; raises as :func:`laid_out`."""
        return laid_out(self.params, (self, *self.phases))

    @property
    def layout(self) -> Layout:  # type: ignore[override]
        """The same, of the plates of this family; raises GeometryError where there are none."""
        return cast("Layout", super().layout)

    @property
    def train(self) -> Train:
        """The gears; teeth, module and ground go together."""
        return train_of(self.params)

    @property
    def pivot(self) -> Any:
        """A0, x + i y."""
        return self.params.pivot_x + 1j * self.params.pivot_y

    @property
    def bore(self) -> Any:
        """Diameter of a plate's bore in which a pin turns."""
        return turning_bore(self.params)

    @cached_property
    def squares(self) -> Array:
        """Least and greatest D² (n, 2) over a whole period."""
        found, period = [], math.tau * self.bar.turns
        for start in range(0, self.size, DISTANCE_BLOCK):
            places = np.arange(start, min(start + DISTANCE_BLOCK, self.size))
            found.append(range_of_distance(self.bar.rows(places, self.size), 0.0, period, places.size))
        return np.concatenate(found)

    def _pair(self, both: Array) -> tuple[Any, Any]:
        """Two columns (n, 1) of what is found (n, 2), or two numbers."""
        return (both[0, 0].item(), both[0, 1].item()) if self.single else (both[:, :1], both[:, 1:])

    @property
    def closure(self) -> Any:
        """The room, mm², by which D² comes into its bounds; below 0 the links cannot be joined anywhere."""
        (near, far), (inner, outer) = self._pair(self.squares), bounds_of_distance(self.bar, TURN_BACK)
        return np.minimum(outer - near, far - inner)

    @property
    def turns_fully(self) -> Any:
        """Whether the crank turns on and on."""
        (near, far), (inner, outer) = self._pair(self.squares), bounds_of_distance(self.bar, TURN_BACK)
        return (near >= inner) & (far <= outer)

    @property
    def requested(self) -> tuple[Any, Any] | None:
        """Between which angles the design says that the crank swings."""
        params = self.params
        if params.swing_from is None or params.swing_to is None:
            return None
        return np.radians(params.swing_from), np.radians(params.swing_to)

    @property
    def is_lever(self) -> Any:
        """Whether the crank swings, because it cannot turn fully or because the design says between where."""
        return ~np.asarray(self.turns_fully) if self.requested is None else np.asarray(True)

    @property
    def levers(self) -> NDArray[np.bool_]:
        """Which of the designs (n,) are levers."""
        return self._truth(self.is_lever)

    def _truth(self, value: Any) -> NDArray[np.bool_]:
        """Truth values (n,) of a number or column."""
        return column(value, self.size)[:, 0] > 0

    @cached_property
    def swings(self) -> Array:
        """Both ends (n, 2) of a lever's swing, the first one first; NaN where it is out of reach."""
        found = np.full((self.size, 2), math.nan)
        if self.single:
            found[0] = _swing_of(self) or math.nan
            return found
        if self.requested is not None:
            found[:] = np.concatenate([column(one, self.size) for one in self.requested], axis=1)
        rest = np.flatnonzero(~self._truth(self.turns_fully))
        if rest.size:
            found[rest] = [one.ends for one in self.rows(rest).each_shape()]
        return found

    @property
    def ends(self) -> tuple[Any, Any]:
        """The same as two columns."""
        return self._pair(self.swings)

    @property
    def reaches(self) -> Any:
        """Whether a lever reaches its swing."""
        return ~np.isnan(self.ends[0])

    @property
    def closed_ways(self) -> Ways:
        """From 0 on, and of levers from end to end."""
        (one, two), lever = self.ends, self.is_lever
        if self.requested is None and self.sense < 0:
            one, two = two, one
        turn = self.sense * self.bar.turns * math.tau
        return Ways(np.where(lever, one, 0.0), np.where(lever, two - one, turn), lever)

    @cached_property
    def angles(self) -> Array:
        """Smallest and largest acute transmission angle (n, 2) over a period."""
        found = angles_of_distance(self.bar, self.squares)
        places = np.flatnonzero(self.levers)
        if places.size:
            some = self.rows(places)
            found[places] = some.each(
                lambda one: angles_of_distance(one.bar, range_of_distance(one.bar, *one.ends, one.size)),
                DISTANCE_BLOCK // 4,
            )
        return found

    @property
    def transmission(self) -> tuple[Any, Any]:
        """The same as two columns."""
        return self._pair(self.angles)


def _swing_of(m: FiveBarTable) -> Interval | None:
    """The swing of a lever, rad from X, its first end first; None where the links cannot reach it.

    Left to itself a lever goes as far as it can on the widest of its ways.
    """
    ways, period = reach(m.bar, TURN_BACK), math.tau * m.bar.turns
    if m.requested is None:
        return max(ways, key=lambda way: way[1] - way[0], default=None)
    one, two = m.requested
    if ways == ((0.0, period),):
        return one, two
    low, high = min(one, two), max(one, two)
    for way in ways:
        start, end = swing.beside(way, (one + two) / 2, period)
        if start - swing.SLACK <= low and high <= end + swing.SLACK:
            return min(max(one, start), end), min(max(two, start), end)
    return None


def ways_of(m: FiveBarTable) -> list[Interval]:
    """All ways in degrees, by whole periods as near to the swing that a design gives as they can be."""
    middle = 0.0 if m.requested is None else sum(m.requested) / 2
    found = (swing.beside(way, middle, math.tau * m.bar.turns) for way in reach(m.bar, TURN_BACK))
    return sorted((math.degrees(low), math.degrees(high)) for low, high in found)
