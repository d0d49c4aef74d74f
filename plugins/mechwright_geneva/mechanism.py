"""From the parameters to the geometry of one mechanism."""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mechwright import kept
from mechwright.mechanics.laws import Law
from mechwright_geneva.driver import Driver, driver_of
from mechwright_geneva.horns import greatest_disc
from mechwright_geneva.kinematics import Frame, Stroke, regime, stroke
from mechwright_geneva.law import law_of
from mechwright_geneva.limits import FINE_SAMPLES, Measures, measure, sharpened
from mechwright_geneva.params import GenevaParams, Sizes
from mechwright_geneva.sizes import sized
from mechwright_geneva.sound import LEAST_BITE

RIGHT = 1e-12
"""Radians by which a right angle is off that has been through degrees."""


@dataclass(frozen=True, eq=False)
class Mechanism:
    """One mechanism; lengths in mm, angles in rad.

    Parameters
    ----------
    params
        The design with all its sizes.
    law
        Of the wheel's motion.
    frame
        The fixed geometry, of scalars.
    """

    params: Sizes
    law: Law
    frame: Frame

    @property
    def straight(self) -> bool:
        """Whether the slots are straight."""
        return self.params.law == "straight"

    @property
    def slots(self) -> int:
        """Number of slots n."""
        return self.params.slots

    @property
    def axes(self) -> float:
        """Distance of the axes a."""
        return float(self.frame.axes)

    @property
    def crank(self) -> float:
        """Crank radius b."""
        return float(self.frame.crank)

    @property
    def bottom(self) -> float:
        """A - b."""
        return float(self.frame.bottom)

    @property
    def rim(self) -> float:
        """Radius l of the wheel."""
        return self.params.entry_radius

    @property
    def wheel_half(self) -> float:
        """θw0."""
        return float(self.frame.wheel_half)

    @property
    def crank_half(self) -> float:
        """θd0."""
        return float(self.frame.crank_half)

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
    def strokes(self) -> range:
        """The numbers of the strokes of a turn, counted as θd is: backwards below 0."""
        return range(0, self.driver.sense * self.params.rollers, self.driver.sense)

    @cached_property
    def side(self) -> int:
        """-1: the island is on the right of the roller's way (regime A); +1: on the left (B)."""
        return int(regime(self.frame, self.law))

    @cached_property
    def measures(self) -> Measures:
        """The figures of the curved slot as it is cut, clearance included."""
        return measure_at(self, self.groove)

    @cached_property
    def nearest(self) -> float:
        """Least distance of the roller's way from the crank's axis, wheel at rest."""
        return self.crank if self.straight else float(self.measures.nearest[0])

    @property
    def least_lock(self) -> float:
        """Smallest locking disc that reaches into the wheel."""
        return self.axes - self.rim + LEAST_BITE - self.params.lock_clearance

    @cached_property
    def greatest_lock(self) -> float:
        """Largest locking disc whose arcs leave the least wall to the slots, and whose ends no horn cuts."""
        most = self.nearest - self.groove - self.params.lock_clearance - self.params.least_wall
        return greatest_disc(self.frame, self.law, self.least_lock, most, self.params.lock_clearance)

    @property
    def lock(self) -> float:
        """Radius of the locking disc."""
        return self.params.lock_radius or self.greatest_lock

    @property
    def arc(self) -> float:
        """Radius of the wheel's concave arcs."""
        return self.lock + self.params.lock_clearance

    def stroke(self, u: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> Stroke:
        """The stroke at shares u (k,)."""
        return stroke(self.frame, self.law, u)


def measure_at(mechanism: Mechanism, radius: float, samples: int = FINE_SAMPLES) -> Measures:
    """The figures of a curved slot for a roller of another radius, its critical radii to rounding."""
    frame = mechanism.frame
    one = Frame.of([frame.wheel_half], [frame.crank_half], [frame.offset], [frame.entry_radius])
    return sharpened(measure(one, mechanism.law, np.array([[radius]]), samples), one, mechanism.law)


@kept
def mechanism_of(params: GenevaParams) -> Mechanism:
    """The mechanism of a design that has no faulty law."""
    sizes = sized(params)
    return Mechanism(sizes, law_of(params), frame_of(sizes))


def frame_of(sizes: Sizes) -> Frame:
    """The fixed geometry."""
    wheel, half = math.pi / sizes.slots, math.radians(sizes.crank_half_angle)
    if sizes.law == "straight" and abs(half + wheel - math.pi / 2) < RIGHT:
        half = math.pi / 2 - wheel
    return Frame.of(wheel, half, math.radians(sizes.offset_angle), sizes.entry_radius)
