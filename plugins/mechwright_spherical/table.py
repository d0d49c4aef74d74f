"""One spherical linkage, or a table of four-bars that go as far as they can.

Formulas over a table hold for four-bars of one phase without a prescribed path, whose ground is outside of
all links and carries no motor; its angles are columns (n, 1), rad. All other linkages are single designs.
"""

import math
from collections.abc import Callable, Mapping
from functools import cached_property
from typing import Any

import numpy as np

from mechwright import Array, kept
from mechwright.contracts.design_table import DesignTable, column, items, plain, with_columns
from mechwright_spherical.kinematics import kernels
from mechwright_spherical.kinematics.clearances import SAMPLES, Approach
from mechwright_spherical.kinematics.linkage import SHORTEST, Linkage, linkage_of
from mechwright_spherical.kinematics.mobility import Courses, courses
from mechwright_spherical.kinematics.vectors import arc
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.parts.frame import frame_of, outside_approaches
from mechwright_spherical.parts.hardware import HardwareTable
from mechwright_spherical.parts.places import link_arcs
from mechwright_spherical.parts.seats import seats_of, slotted_of
from mechwright_spherical.parts.shells import Shells, one_side

_WAY = kernels.circle_of(SAMPLES)


class SphericalTable(DesignTable[SphericalParams]):
    """One linkage, or four-bars that differ in their dimensions.

    Parameters
    ----------
    given, size
        As of :class:`DesignTable`.
    complete
        Gives the table ``hardware`` with the sizes that designs of a table omit.
    """

    def __init__(
        self,
        given: SphericalParams,
        size: int | None = None,
        complete: "Callable[[SphericalTable], HardwareTable] | None" = None,
    ) -> None:
        super().__init__(given, size)
        self._complete = complete

    @classmethod
    def of(cls, params: SphericalParams) -> "SphericalTable":
        """The linkage of a design, kept with all that is computed of it."""
        return _of_one(params, frozenset(params.hardware.model_fields_set))

    def row(self, place: int) -> "SphericalTable":
        """One of the designs, with the sizes that it omits."""
        return self if self.single else self.of(with_columns(plain(self.given, place, self.size), {}))

    @property
    def params(self) -> SphericalParams:
        """The parameters with all sizes."""
        complete = self._complete
        if complete is None:
            return self.given
        return self.once("params", lambda: self.given.model_copy(update={"hardware": complete(self)}))

    def sized(self, hardware: HardwareTable) -> "SphericalTable":
        """The same linkages with links of other sizes."""
        given = self.given.model_copy(update={"hardware": hardware})
        if self.single:
            return self.of(given)
        changed = SphericalTable(given, self.size)
        changed._computed = {"courses": self.courses, "nearest": self.nearest}
        return changed

    @property
    def is_free(self) -> bool:
        """Whether these are four-bars of one phase that go as far as they can, without a path."""
        four = self.given.four_bar
        plain_bar = four.start is None and four.travel is None and not four.phases and not four.path
        return self.given.kind == "four-bar" and plain_bar

    @cached_property
    def linkage(self) -> Linkage:
        """The linkage of one design; raises PinError."""
        return linkage_of(self.given)

    @property
    def shells(self) -> Shells:
        """The shells of the links."""
        return frame_of(self.params).shells if self.single else one_side(self.params)

    @property
    def bridge(self) -> float | None:
        """Arc from the input axis to the bridge of a ground on both sides; None outside of the links."""
        return frame_of(self.params).bridge if self.single else None

    @property
    def bars(self) -> tuple[Array, ...]:
        """Arcs of ground, input, coupler and output of four-bars, columns."""
        four = self.given.four_bar
        arcs = (four.ground, four.input, four.coupler, four.output)
        return tuple(column(np.radians(angle), self.size) for angle in arcs)

    @property
    def has_short_arcs(self) -> Any:
        """Whether an arc of a four-bar is too short for a link, or too near to 180°."""
        degrees, limit = np.degrees(np.stack(self.bars)), math.degrees(SHORTEST)
        return ~np.all((degrees >= limit) & (degrees <= 180 - limit), axis=0)

    @property
    def courses(self) -> Courses:
        """How far the inputs of a table go."""
        return self.once("courses", lambda: courses(*self.bars))

    @property
    def rows_of_bars(self) -> tuple[Array, Array]:
        """Linkages (n, 5) and drives (n, 4) as compiled kernels take them."""
        ways, speed = self.courses, self.given.speed * (math.tau / 60)
        drives = items([ways.start, ways.travel, ways.rocks, speed], self.size)
        return items([*self.bars, self.given.four_bar.branch], self.size), drives

    @property
    def arcs(self) -> Mapping[str, Any]:
        """Arcs of the links with two joints, rad, those of phase 1 where phases differ."""
        if self.single:
            return link_arcs(self.linkage)
        ground, crank, _, rocker = self.bars
        return {"ground": ground, "crank": crank, "rocker": rocker}

    @property
    def coupler_arcs(self) -> list[Any]:
        """Arcs of the coupler in each phase, rad."""
        if self.single:
            return [math.acos(float(phase.loop.ca)) for phase in self.linkage.phases]
        return [self.bars[2]]

    @property
    def tool_arcs(self) -> list[tuple[str, Any]]:
        """Arcs from the path point to the places of each pin that is set in no slot, rad."""
        if self.single:
            point = self.linkage.phases[0].at_reference.p[0][:, 0]
            seats = [seat for seat in seats_of(self.linkage) if seat.name not in slotted_of(self.params)]
            return [(seat.name, float(arc(point, place))) for seat in seats for place in seat.own]
        four, coupler = self.given.four_bar, self.bars[2]
        kappa, level = np.radians(four.point_azimuth), np.cos(np.radians(four.point_elevation))
        ends = (("a", kappa), ("c", kappa - coupler))
        return [(name, np.arccos(np.clip(level * np.cos(angle), -1, 1))) for name, angle in ends]

    @property
    def approaches(self) -> tuple[Approach, ...]:
        """The nearest approaches of one design whose ground is outside of the links."""
        return outside_approaches(self.params)

    @property
    def rooms(self) -> Array:
        """Air (n, k), mm, between links that share a shell, where they are nearest."""
        return np.array([[near.room for near in self.approaches]]) if self.single else self.air(self.params)

    def air(self, params: SphericalParams) -> Array:
        """Air (n, 1), mm, between crank and rocker of a table, with the sizes of these parameters."""
        own, radius = params.hardware, one_side(params).links["crank"][0]
        beside, ends, cross = np.hsplit(self.nearest, 3)
        link, disc = np.arctan2(own.link_width / 2, radius), np.arctan2(own.boss_diameter / 2, radius)
        gaps = [np.where(cross > 0, 0.0, beside) - 2 * link, beside - link - disc, ends - 2 * disc]
        return np.asarray(radius * np.minimum.reduce(gaps))

    @property
    def nearest(self) -> Array:
        """Least angles from ends of crank or rocker to the other's arc and ends, and crossing (n, 3)."""

        def found() -> Array:
            cosines: Array = kernels.nearest(*self.rows_of_bars, _WAY)
            return np.column_stack([np.arccos(np.clip(cosines[:, :2], -1, 1)), cosines[:, 2]])

        return self.once("nearest", found)


@kept
def _of_one(params: SphericalParams, stated: frozenset[str]) -> SphericalTable:  # noqa: ARG001 - part of the key
    return SphericalTable(params)
