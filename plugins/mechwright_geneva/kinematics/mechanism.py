"""From the parameters to the geometry of one mechanism, or of a table of them.

Every quantity is a number for one mechanism and a column (n, 1) for many; lengths in mm, angles in rad.
"""

import math
from collections.abc import Callable
from functools import cached_property
from typing import Any, cast

import numpy as np

from mechwright import Array
from mechwright.contracts.design_table import DesignTable, number, plain
from mechwright.mechanics.laws import Law
from mechwright_geneva.kinematics.drive import Driver, driver_of
from mechwright_geneva.kinematics.geometry import Frame, Points, Stroke, corner_angle, regime, stroke
from mechwright_geneva.kinematics.horn_clearance import greatest_discs
from mechwright_geneva.kinematics.laws import law_of
from mechwright_geneva.kinematics.slot_limits import FINE_SAMPLES, Measures, measure, sharpened
from mechwright_geneva.parameters import GenevaParams, Sizes
from mechwright_geneva.parts.openings import needed_radius, reach

LEAST_BITE = 2.0
"""Least depth of a concave arc in the wheel, mm: less is worn away before it locks anything."""

RIGHT = 1e-12
"""Radians by which a right angle is off that has been through degrees."""

BLOCK = 64
"""Mechanisms whose strokes are sampled at once: some arrays of half a megabyte."""


class Mechanism(DesignTable[GenevaParams]):
    """One mechanism, or mechanisms with one number of slots, one law and one kind of driver.

    Parameters
    ----------
    given
        The design table, whose law has no fault.
    size
        The number n of mechanisms; None for one with plain numbers.
    samples
        Of half a stroke, by which curved slots are measured. Critical radii of :data:`FINE_SAMPLES` are
        sharpened to rounding, where that may decide something.
    complete
        Adds the dimensions that a design table leaves open, of so many designs; None for tables that are
        complete.
    """

    def __init__(
        self,
        given: GenevaParams,
        size: int | None = None,
        samples: int = FINE_SAMPLES,
        complete: Callable[[GenevaParams, int | None], Sizes] | None = None,
    ) -> None:
        super().__init__(given, size)
        self.samples = samples
        self._complete = complete

    @cached_property
    def params(self) -> Sizes:
        """The design table with all that it leaves open."""
        if self._complete is None or isinstance(self.given, Sizes):
            return cast(Sizes, self.given)
        return self._complete(self.given, None if self.single else self.size)

    def row(self, place: int) -> "Mechanism":
        """One of the mechanisms, with plain numbers."""
        if self.single:
            return self
        return Mechanism(plain(self.given, place, self.size), None, self.samples, self._complete)

    @cached_property
    def law(self) -> Law:
        """Of the wheel's motion."""
        return law_of(self.given)

    @cached_property
    def frame(self) -> Frame:
        """The fixed geometry; of a table its columns."""
        found = frame_of(self.params)
        return found if self.single else found.columns(self.size)

    @property
    def straight(self) -> bool:
        """Whether the slots are straight."""
        return self.given.law == "straight"

    @property
    def slots(self) -> int:
        """Number of slots n."""
        return self.given.slots

    @cached_property
    def axes(self) -> float:
        """Distance of the axes a."""
        return number(self.frame.axes)

    @cached_property
    def crank(self) -> float:
        """Crank radius b."""
        return number(self.frame.crank)

    @cached_property
    def bottom(self) -> float:
        """Distance a - b of a slot's bottom from the wheel's axis."""
        return number(self.frame.bottom)

    @property
    def rim(self) -> float:
        """Radius l of the wheel."""
        return self.params.entry_radius

    @property
    def wheel_half(self) -> float:
        """θw0."""
        return math.pi / self.slots

    @property
    def crank_half(self) -> float:
        """θd0."""
        return number(self.frame.crank_half)

    @property
    def roller(self) -> float:
        """Roller radius r."""
        return self.params.roller_radius

    @property
    def groove(self) -> float:
        """Half the width of a slot: roller and half the clearance."""
        return self.params.roller_radius + self.params.groove_clearance / 2

    @property
    def pitch(self) -> float:
        """Crank angle from one roller to the next."""
        return math.tau / self.params.rollers

    @cached_property
    def driver(self) -> Driver:
        """How the driver turns."""
        return driver_of(self.params, self.crank_half)

    @property
    def ends(self) -> tuple[int, ...]:
        """The ends of a stroke that differ: of a symmetric law the way out is the way in, mirrored."""
        return (0,) if self.law.symmetric else (0, 1)

    @property
    def strokes(self) -> range:
        """The numbers of the strokes of a turn, counted as θd is: backwards below 0."""
        return range(0, self.driver.sense * self.params.rollers, self.driver.sense)

    @property
    def different_strokes(self) -> range:
        """The strokes of a turn that differ."""
        return self.strokes if self.driver.varies else self.strokes[:1]

    @cached_property
    def side(self) -> int:
        """-1: the island is on the right of the roller's way (regime A); +1: on the left (B)."""
        side: Any = number(regime(self.frame, self.law))
        found: int = side
        return found

    @cached_property
    def measures(self) -> Measures:
        """The figures (n, 1) of the curved slot as it is cut, clearance included."""
        return self.measured(self.groove)

    def measured(self, radius: "float | Array") -> Measures:
        """The figures (n, 1) of a curved slot for rollers of another radius."""
        frame, wide = self.frame.columns(self.size), np.broadcast_to(radius, (self.size, 1))
        found = measure(frame, self.law, wide, self.samples)
        return sharpened(found, frame, self.law, wide, always=self.single) if self._fine else found

    @property
    def _fine(self) -> bool:
        return self.samples == FINE_SAMPLES

    @cached_property
    def nearest(self) -> float:
        """Least distance of the roller's way from the crank's axis, wheel at rest."""
        return self.crank if self.straight else self._of_slot(self.measures.nearest)

    def _of_slot(self, values: Array) -> float:
        """What has been measured of one slot as a number."""
        return number(values[0, 0] if self.single else values)

    @cached_property
    def hub(self) -> float:
        """Radius about the wheel's axis that the slots must leave alone: opening or hub."""
        return number(np.maximum(self.opening, self.params.hub_diameter / 2))

    @cached_property
    def opening(self) -> float:
        """How far the wheel's shaft opening reaches from its axis."""
        params = self.params
        return number(reach(params.bore, params.keyway_width, params.keyway_relief))

    @cached_property
    def driver_opening(self) -> float:
        """How far the driver's shaft opening reaches from its axis."""
        params = self.params
        return number(reach(params.driver_bore, params.driver_keyway_width, params.keyway_relief))

    @cached_property
    def driver_radius(self) -> float:
        """Radius that the relief leaves of the locking disc about the crank's axis."""
        return self.axes - self.rim - self.params.lock_clearance

    @cached_property
    def needed_driver_radius(self) -> float:
        """Radius that opening, walls and dowels of the driver need."""
        params = self.params
        return number(needed_radius(self.driver_opening, params.least_wall, params.fixing))

    @property
    def least_lock(self) -> float:
        """Smallest locking disc that reaches into the wheel."""
        return self.axes - self.rim + LEAST_BITE - self.params.lock_clearance

    @property
    def most_lock(self) -> float:
        """Largest locking disc whose arcs leave the least wall to the slots."""
        return self.nearest - self.groove - self.params.lock_clearance - self.params.least_wall

    @cached_property
    def greatest_lock(self) -> float:
        """The largest one up to that whose ends no horn cuts."""
        return self.value_of_blocks(Mechanism._greatest_lock)

    def _greatest_lock(self) -> Array:
        least, most = (
            np.broadcast_to(one, (self.size, 1))[:, 0] for one in (self.least_lock, self.most_lock)
        )
        found = greatest_discs(
            self.frame.columns(self.size), self.law, least, most, np.asarray(self.params.lock_clearance)
        )
        return found[:, None]

    @property
    def lock(self) -> float:
        """Radius of the locking disc."""
        return self.greatest_lock if self.params.lock_radius is None else self.params.lock_radius

    @property
    def arc(self) -> float:
        """Radius of the wheel's concave arcs."""
        return self.lock + self.params.lock_clearance

    @cached_property
    def horn_angle(self) -> float:
        """Polar angle ψ_L of the corner between concave arc and rim from the middle of the arc."""
        angle: float = corner_angle(self.axes, self.rim, self.arc)
        return angle

    @cached_property
    def arc_half(self) -> float:
        """Half the angle of a concave arc, about the crank's axis; past it both horns are covered."""
        psi = self.horn_angle
        return number(np.arctan2(self.rim * np.sin(psi), self.axes - self.rim * np.cos(psi)))

    def lock_play(self, arc: Any, disc: Any, off_centre: Any = 0.0) -> Any:
        """Angle (...), rad, by which the locked wheel can turn either way where the disc covers both horns.

        A horn leaves the circle of the concave arc and meets that of the disc. Radii are in mm, as is
        ``off_centre``, by which the disc's axis is too far away.
        """
        horn = corner_angle(self.axes, self.rim, arc)
        return horn - corner_angle(self.axes + off_centre, self.rim, disc)

    def stroke(self, u: Array) -> Stroke:
        """The stroke at shares u (k,)."""
        return stroke(self.frame, self.law, u)

    def way(self, angle: Array) -> Stroke:
        """The stroke at crank angles (...), rad, from its start; before and after it the wheel rests."""
        share = angle / (2 * self.crank_half)
        run, moves = self.stroke(np.clip(share, 0, 1)), (share >= 0) & (share <= 1)
        phi = np.where(moves, run.phi, self.crank_half - angle)
        rates = (np.where(moves, rate, 0.0) for rate in (run.first, run.second, run.third))
        return Stroke(run.frame, phi, run.theta, *rates)

    def slot_normal(self, run: Stroke) -> Points:
        """Unit normal (...) of the slot, fixed axes; of a straight one also where the roller turns back."""
        return np.asarray(1j * run.centre / np.abs(run.centre)) if self.straight else run.normal

    def lever(self, run: Stroke) -> Array:
        """Lever (...) of that normal about the wheel's axis, mm, signed."""
        return run.lever(self.slot_normal(run))

    def value_of_blocks(self, function: "Callable[[Mechanism], Array]") -> float:
        """What a function gives (b, 1) of blocks of mechanisms, as a number or a column (n, 1)."""
        return self._of_slot(self.each(function, BLOCK))


def frame_of(sizes: Sizes) -> Frame:
    """The fixed geometry."""
    wheel, half = math.pi / sizes.slots, np.radians(sizes.crank_half_angle)
    if sizes.law == "straight":
        half = np.where(np.abs(half + wheel - math.pi / 2) < RIGHT, math.pi / 2 - wheel, half)
    return Frame.of(wheel, half, np.radians(sizes.offset_angle), sizes.entry_radius)
