"""The gears of a design, or of a table of designs."""

import math
from collections.abc import Callable, Iterator, Sequence
from functools import cached_property, partial
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from mechwright import Array, GeometryError, kept
from mechwright.contracts.design_table import column, number, plain
from mechwright.contracts.finding import Change
from mechwright.mechanics.gearing import MeshProof, Rack, Teeth
from mechwright.mechanics.gearing.checks import least_tip
from mechwright.mechanics.gearing.toothed_pair import Rim, ToothedPair
from mechwright_elliptic_gears.kinematics.ellipse import depth_in, perimeter_of
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.backlash import jamming_backlash, least_backlash, with_backlash
from mechwright_elliptic_gears.parts.gear import fillet_mill, rack_of, room, teeth_of
from mechwright_elliptic_gears.parts.layout import Layout, layout_of, sized_layout
from mechwright_elliptic_gears.parts.mesh_proof import prove
from mechwright_elliptic_gears.parts.teeth import Gears, Tips, tips_of
from mechwright_elliptic_gears.parts.tip_reach import that_clear


class GearTable(ToothedPair[EllipticGearParams]):
    """A pair or train, or designs that differ in their numbers; numbers of one, columns (n, 1) of many."""

    larger: ClassVar[str] = "module or semi_major"
    roomier: ClassVar[str] = "use more teeth or a smaller eccentricity"

    def row(self, place: int) -> "GearTable":
        """One of the designs, with plain numbers; it is computed once."""
        if self.single:
            return self
        if self._designs[place, 0] is None:
            given = plain(self.given, place, self.size)
            given.__dict__["teeth"] = round(given.teeth)
            self._designs[place, 0] = GearTable(given)
        found: GearTable = self._designs[place, 0]
        return found

    @cached_property
    def _designs(self) -> NDArray[np.object_]:
        return np.full((self.size, 1), None, dtype=object)

    @property
    def profile(self) -> Any:
        """The rack, in modules and degrees."""
        return self.given

    @cached_property
    def semi_major(self) -> Any:
        """Half the major axis a, mm: the perimeter 4 a E(e) is z pitches."""
        given = self.given
        if given.semi_major is not None:
            return given.semi_major
        return number(math.pi * np.asarray(given.module) * given.teeth / perimeter_of(given.eccentricity))

    @cached_property
    def module(self) -> Any:
        """Pitch over π, mm."""
        given = self.given
        if given.module is not None:
            return given.module
        return number(perimeter_of(given.eccentricity) * given.semi_major / (math.pi * given.teeth))

    @property
    def omega(self) -> Any:
        """Speed of gear 2, rad/s."""
        return self.given.speed * math.tau / 60

    @cached_property
    def layout(self) -> Layout:
        """Dimensions and heights of a train."""
        if self.single:
            return layout_of(self.given)

        def each(of: Callable[[EllipticGearParams], float]) -> Array:
            return np.array([[of(self.row(place).given)] for place in range(self.size)])

        return sized_layout(self.given, self.semi_major, each)

    @cached_property
    def gears(self) -> Gears:
        """The gears (n, 1) in semi-major axes."""
        given, a = self.given, self.semi_major
        each = (
            *(given.eccentricity, given.teeth, np.where(np.asarray(given.teeth) % 2 == 1, 0.0, 0.25)),
            *(self.module / a, self.backlash / a, np.radians(given.pressure_angle)),
            *(given.addendum, given.dedendum, given.tip_radius),
        )
        return Gears(*(column(one, self.size) for one in each))

    @cached_property
    def tips(self) -> Tips:
        """Ends of the flanks (n, 1)."""
        found = tips_of(self.gears)
        for place in np.flatnonzero(~found.found[:, 0]).tolist():
            (teeth,) = self.row(place).teeth_with(self.row(place).backlash)
            try:
                found.width[place] = least_tip([teeth])
                found.depth[place] = teeth.tip_height / teeth.rack.module
            except GeometryError:
                found.width[place] = -np.inf
        return found

    @property
    def tip_width(self) -> Any:
        """Width of the thinnest tip, modules: -inf in rows, GeometryError in one, whose flanks end before."""
        if self.single and np.isneginf(self.tips.width).any():
            return super().tip_width
        return number(self.tips.width[0, 0]) if self.single else self.tips.width

    @property
    def half_land(self) -> Any:
        """Half the flat end of a tooth of the rack, in semi-major axes; below 0 if its tip arcs overlap."""
        return self.gears.half_land

    @property
    def rack(self) -> Rack:
        """The generating rack of one design, mm."""
        return rack_of(self.given)

    @property
    def least_backlash(self) -> Any:
        """With which gears as made turn, mm."""
        return least_backlash(self.given)

    @property
    def jamming_backlash(self) -> Any:
        """Below which walls as they are planned jam, mm."""
        return jamming_backlash(self.given)

    @property
    def fillet_mill(self) -> float:
        """Diameter, mm, of the largest end mill that cuts every fillet of one design exactly."""
        return fillet_mill(self.given)

    def teeth_with(self, backlash: float) -> Sequence[Teeth]:
        """The teeth of one design with another backlash, mm; all gears have the same."""
        return [teeth_of(with_backlash(self.given, backlash))]

    @property
    def root_distance(self) -> Any:
        """From a focus to the nearest root, mm: its vertex is a (1 - e) away."""
        return self.semi_major * (1 - self.given.eccentricity) - self.given.dedendum * self.module

    @property
    def rim(self) -> Rim:
        """Between the shaft opening and the nearest root."""
        given = self.given
        if not np.any(np.asarray(given.keyway_width) > 0):
            root, blamed = self.root_distance, "bore" if np.any(given.bore) else "eccentricity"
            return Rim((root - given.bore / 2) / self.module, root, blamed)
        if self.single:
            return Rim.of(given, self.module, partial(room, given), "eccentricity")
        rims = [self.row(place).rim for place in range(self.size)]
        return Rim(np.array([[one.thickness] for one in rims]), np.array([[one.root] for one in rims]))

    def root_depth(self, x: Array, y: Array) -> Array:
        """Least distance (n, 1), mm, of places (n, k) about the axis from the root curve; below 0 outside."""
        found = depth_in(self.semi_major, self.given.eccentricity, x, y).min(axis=-1, keepdims=True)
        return np.asarray(found - self.given.dedendum * self.module)

    def proof(self) -> MeshProof:
        """The mesh proof of one design."""
        return prove(self.given)

    def clearing(self) -> Iterator[Change]:
        """Changes of one design that end its flanks below the tips, and leave room at the roots."""
        return that_clear(self.given, float(self.tips.depth[0, 0]))


def table_of(params: EllipticGearParams, size: int | None = None) -> GearTable:
    """The gears of a design, kept with all that is computed of them; or a table of ``size`` designs."""
    if size is not None:
        return GearTable(params, size)
    return _of_one(params, frozenset(params.model_fields_set))


@kept
def _of_one(params: EllipticGearParams, _given: frozenset[str]) -> GearTable:
    """One table for equal designs that leave out the same fields."""
    return GearTable(params)
