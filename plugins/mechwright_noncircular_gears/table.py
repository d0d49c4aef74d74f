"""One pair of gears by a law, or a table of pairs.

Glossary
--------
shared law
    The law of a table whose designs differ in none of its fields.
"""

import copy
import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cached_property, partial
from typing import Any

import numpy as np

from mechwright import Array, Outline, kept
from mechwright.contracts.design_table import Rows, by_row
from mechwright.contracts.finding import Change
from mechwright.mechanics.gearing import (
    MeshProof,
    Rack,
    RatioLaw,
    RolledCurve,
    RolledPair,
    SectorTeeth,
    Teeth,
    exact_fit,
    prove_mesh,
)
from mechwright.mechanics.gearing.checks import FULL_RIM
from mechwright.mechanics.gearing.ring_plate import RingPlate, outside_for
from mechwright.mechanics.gearing.toothed_pair import Rim, ToothedPair
from mechwright_noncircular_gears.fields import LAW_FIELDS
from mechwright_noncircular_gears.kinematics.law import (
    COLUMN_LAWS,
    Extremes,
    LawRows,
    alike,
    extremes_of,
    fastest_of,
    law_of,
    slowest_of,
    stated_law,
)
from mechwright_noncircular_gears.kinematics.laws.window import WindowLaw
from mechwright_noncircular_gears.parameters import NoncircularParams
from mechwright_noncircular_gears.parts.cutter import CutterProfile, profile_of
from mechwright_noncircular_gears.parts.mesh import collides, prove, toothed

NAMES = ("gear-1", "gear-2")
"""Bodies and parts: driver and driven gear."""

LEAST_ADDENDUM = 0.3
"""Modules: the least of the design table."""

_CURVE_POINTS = 2880
"""Points of a pitch curve from which distances are measured: an eighth of a degree."""


class GearTable(ToothedPair[NoncircularParams]):
    """One pair, or pairs whose numbers are columns (n, 1); teeth are those of one pair."""

    larger = "module or centre_distance"
    roomier = "use more teeth, or a law that changes its ratio less"

    @property
    def upright(self) -> float:
        """Cosine of the greatest slope of the pitch curves."""
        return math.cos(self.extremes.steepest.value)

    def row(self, place: int) -> "GearTable":
        """Give one design with its own defaults."""
        if self.single:
            return self
        one = super().row(place)
        one.given.__dict__.update(one.given.fitted())
        return one

    def _stated(self, place: int) -> NoncircularParams:
        """One design without the defaults that take long."""
        return super().row(place).given

    def of_rows(self, value: "Callable[[GearTable], float]") -> Any:
        """A number of one pair, computed for each pair of a table."""
        return by_row(value)(self)

    @property
    def omega(self) -> Any:
        """Speed of the driver, rad/s."""
        return self.given.speed * math.tau / 60

    @cached_property
    def shares_law(self) -> bool:
        """Whether all designs have one law."""
        fields = (*LAW_FIELDS[self.given.law], "sector")
        return self.single or not any(isinstance(getattr(self.given, name), np.ndarray) for name in fields)

    @cached_property
    def law(self) -> RatioLaw:
        """The law of all designs, whose numbers are columns where designs differ in them."""
        given = self.given
        if self.shares_law:
            return law_of(self._stated(0))
        if given.law in COLUMN_LAWS and given.sector is None:
            return stated_law(given)
        return LawRows(tuple(law_of(self._stated(place)) for place in range(self.size)))

    @cached_property
    def extremes(self) -> Extremes:
        """Of the shared law."""
        return extremes_of(self.row(0).given)

    @cached_property
    def ends(self) -> Array:
        """Least and greatest ratio of designs with a column law: in a window and beyond it, or of a lobe."""
        law = self.law
        if isinstance(law, WindowLaw):
            ends = [np.broadcast_to(one, (self.size, 1)) for one in (law.ratio, law.beyond)]
            return np.concatenate(ends, axis=1)
        half = np.array([[0.0, law.period / 2]])
        return np.broadcast_to(law.rates(half)[0], (self.size, 2))

    @property
    def slowest(self) -> Any:
        """The least ratio; not above 0 if the driven gear turns back."""
        if self.shares_law:
            return slowest_of(self.law).value
        if isinstance(self.law, LawRows):
            return self.law.each(lambda law: slowest_of(law).value)
        return self.ends.min(axis=1, keepdims=True)

    @property
    def fastest(self) -> Any:
        """The greatest ratio; a ring has no centre where it is not below 1."""
        if self.shares_law:
            return fastest_of(self.law).value
        if isinstance(self.law, LawRows):
            return self.law.each(lambda law: fastest_of(law).value)
        return self.ends.max(axis=1, keepdims=True)

    def rows(self, places: Rows) -> "GearTable":
        """Give some of the designs; a law whose numbers are columns is made anew."""
        taken = super().rows(places)
        if not self.shares_law and not isinstance(self.__dict__.get("law"), LawRows):
            taken.__dict__.pop("law", None)
        return taken

    @property
    def distance(self) -> Any:
        """Of the axes, mm."""
        if self.given.centre_distance is not None:
            return self.given.centre_distance
        return self.of_rows(lambda one: one.pair.distance)

    @cached_property
    def pair(self) -> RolledPair:
        """Both pitch curves of one pair; a module asks for a centre distance of its own."""
        given = self.given
        if given.centre_distance is not None:
            return alike(RolledPair.of(self.law, given.centre_distance, given.side))
        return alike(RolledPair.of_pitch(self.law, math.pi * (given.module or 0.0), given.teeth, given.side))

    @property
    def profile(self) -> CutterProfile:
        """The cutter of one pair."""
        return profile_of(self.given)

    @property
    def module(self) -> float:
        """Pitch over π of one pair, mm."""
        given = self.given
        return self.pair.rolled / (math.pi * given.teeth) if given.module is None else given.module

    @cached_property
    def rack(self) -> Rack:
        """The cutter of one pair, mm; with a ring, that of the driver."""
        return self.profile.sized(self.module, self.backlash)

    @cached_property
    def teeth(self) -> tuple[Teeth, Teeth]:
        """Of driver and driven gear of one pair."""
        return self.teeth_with(self.backlash)

    def addendum(self, gear: int) -> tuple[str, float]:
        """Field and value, modules, of the tooth height of gear 0 or 1."""
        if gear and self.given.internal:
            return "ring_addendum", self.given.value("ring_addendum")
        return "addendum", self.profile.addendum

    def teeth_with(self, backlash: float) -> tuple[Teeth, Teeth]:
        """Teeth of both gears of one pair with any backlash, mm.

        Tooth centres of the driver lie at arcs (j + δ) p from the pitch point at φ = 0, those of the driven
        gear at (j + δ + 1/2) p. The contact runs clockwise in the driver and in a ring, against their arcs'
        sense.
        """
        given, pair = self.given, self.pair
        rack = replace(self.rack, backlash=backlash)
        mate = replace(rack, addendum=self.addendum(1)[1] * rack.module) if given.internal else rack
        offset, count = given.tooth_offset, given.teeth
        fit = exact_fit(pair, count, math.radians(given.pressure_angle))
        if given.sector is not None:
            hub = self.hub / 2
            one = SectorTeeth.over(pair.driver, rack, count, (-count, 0), -offset, hub)
            two = SectorTeeth.over(pair.driven, mate, count, (0, count), offset + 0.5, hub)
            return alike(replace(one, fit=fit)), alike(replace(two, fit=fit))
        return (
            alike(Teeth(pair.driver, rack, count, -offset % 1.0, fit=fit)),
            alike(Teeth(pair.driven, mate, given.mate_teeth, given.side * (offset + 0.5) % 1.0, fit=fit)),
        )

    @property
    def sectors(self) -> list[SectorTeeth]:
        """The teeth of both sectors."""
        return [one for one in self.teeth if isinstance(one, SectorTeeth)]

    @property
    def hub(self) -> float:
        """Diameter, mm, of the hubs of sectors."""
        if self.given.sector_hub is not None:
            return self.given.sector_hub
        opening, rack = self.opening, self.rack
        reach = 0.0 if opening is None else float(np.hypot(*opening.loop().flatten().T).max())
        return math.ceil(2 * (reach + FULL_RIM * (rack.addendum + rack.dedendum)))

    @cached_property
    def outlines(self) -> tuple[Outline, Outline]:
        """Outlines of driver and driven gear, each about its axis; keyways point along +x.

        Teeth of a ring are its first opening.

        Raises
        ------
        GeometryError
            The curves do not close; ``check`` says which parameter is to blame, and is to be asked first.
        """
        holes = () if self.opening is None else (self.opening.loop(),)
        (one, off), (two, more) = map(toothed, self.teeth)
        ring = self.given.internal
        return Outline(one, holes, off), self.ring_plate.outline(two, more) if ring else Outline(
            two, holes, more
        )

    @cached_property
    def ring_plate(self) -> RingPlate:
        """What lies around the teeth of a driven gear that is a ring."""
        given, rack = self.given, self.teeth[1].rack
        t = np.linspace(0.0, math.tau, _CURVE_POINTS, endpoint=False)
        root = float(np.hypot(*self.pair.driven.frame(t).offset(-rack.dedendum).T).max())
        holes, depth = given.value("ring_holes"), rack.addendum + rack.dedendum
        hole = given.value("ring_hole") if holes else 0.0
        outside = float(outside_for(root, hole, depth)) if given.ring_outside is None else given.ring_outside
        return RingPlate(root, outside, holes, hole, rack.module, depth)

    @property
    def pitch_points(self) -> tuple[Array, Array]:
        """Points (n, 2), mm, of both pitch curves, each in the frame of its gear."""
        return curve_points(self.pair.driver), curve_points(self.pair.driven)

    def room(self, gear: int, points: Array) -> float:
        """Least distance, mm, of points (n, 2) of a gear, 0 or 1, from its root curve; below 0 beyond it."""
        curve = self.pitch_points[gear]
        between = np.hypot(points[:, None, 0] - curve[:, 0], points[:, None, 1] - curve[:, 1])
        return float(between.min()) - self.rack.dedendum

    @cached_property
    def rim(self) -> Rim:
        """The thinner one of both gears, which have one bore; of a gear in a ring its own."""
        gears = range(1 if self.given.internal else 2)
        rims = [Rim.of(self.given, self.rack.module, partial(self.room, gear), "law") for gear in gears]
        return min(rims, key=lambda one: float(one.thickness))

    def proof(self) -> MeshProof:
        """Both finished outlines run against each other until the same teeth meet again."""
        return prove(self.pair, self.teeth, self.given.teeth, self.given.internal)

    def prove_outlines(self, driver: Array, driven: Array, allowance: float) -> MeshProof:
        """Run outlines (n, 2) and (m, 2), mm, material on the left, each about its axis, against each other.

        ``allowance`` is the depth, mm, that the making of the outlines itself can cause.
        """
        return prove_mesh(self.pair, self.rack, self.given.teeth, (driver, driven), allowance)

    @property
    def collides(self) -> bool:
        """Whether coarse outlines stand in each other: all but the least collisions, in less time."""
        return collides(self.pair, self.teeth, self.given.teeth, self.given.internal)

    def clearing(self) -> Iterator[Change]:
        """Lower teeth that clear the fillets and tips of their mates; they have been tried."""
        heights = dict(map(self.addendum, range(2)))
        for less in (0.1, 0.2):
            lower = {name: round(value - less, 3) for name, value in heights.items()}
            if min(lower.values()) >= LEAST_ADDENDUM and not self.changed(**lower).collides:
                yield {f"parameters.{name}": value for name, value in lower.items()}
                return

    def changed(self, **fields: Any) -> "GearTable":
        """One pair with other parameters, which are not validated."""
        return table_of(self.given.model_copy(update=fields))

    @property
    def fillet_mill(self) -> float:
        """Diameter, mm, of the largest end mill that cuts every fillet exactly.

        A fillet is tightest at its bottom, where the pitch curve is flattest, or hollow the most.
        """
        least = math.inf
        for teeth in self.teeth:
            rack = teeth.rack
            curvature = 1 / teeth.curve.frame_at(teeth.arc_centres).radius + rack.curvature
            # Its bottom is the path of the tip arc's centre, widened by the arc: by Euler and Savary.
            depth = rack.arc_depth
            least = min(least, rack.tip_radius + depth**2 / (float(1 / curvature.min()) + depth))
        return 2 * least


def table_of(params: NoncircularParams) -> GearTable:
    """One pair; it is kept with all that has been computed of it."""
    found: GearTable = _kept(params)
    if found.given.model_fields_set == params.model_fields_set:
        return found
    stated = copy.copy(found)  # equal designs may differ in what they leave out
    stated.given = params
    return stated


_kept = kept(GearTable)


@kept
def curve_points(curve: RolledCurve) -> Array:
    """Points (n, 2), mm, of a pitch curve."""
    points: Array = curve.frame(curve.around(_CURVE_POINTS)).point
    return points
