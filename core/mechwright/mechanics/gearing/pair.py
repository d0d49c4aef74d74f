"""Two pitch curves that roll on each other about fixed axes.

The driver turns about O1 = (0, 0), the driven gear about O2 = (σ a, 0), both angles counter-clockwise; σ is
+1 for two gears beside each other and -1 for a driver that runs in a ring. The pitch point lies at (r1, 0):
at -θ1 in the driver's body frame, and at π - θ2 in that of a driven gear, -θ2 in that of a ring. With
θ2 = f(θ1) and f' = dθ2/dθ1, below 0 where σ = 1 and from 0 to 1 where σ = -1, rolling without slip,
f' r2 = -σ r1, makes

    r1 = -σ a f'/(1 - f'),  r2 = a/(1 - f'),  σ r1 + r2 = a.
"""

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.gearing.pitch_curve import PitchCurve

POSITIONS_PER_TOOTH = 4
"""Of a run of the pair."""


@dataclass(frozen=True)
class Pair(ABC):
    """Two gears, or a gear in a ring.

    Parameters
    ----------
    driver, driven
        Pitch curves; their perimeters stand to each other as the numbers of teeth.
    distance
        Centre distance a, mm.
    """

    driver: PitchCurve
    driven: PitchCurve
    distance: float

    @property
    def side(self) -> int:
        """σ: 1 of two gears beside each other, -1 of one that runs in a ring."""
        return 1

    @property
    def axis(self) -> float:
        """The place σ a, mm, of the driven gear's axis on the line of centres."""
        return self.side * self.distance

    @abstractmethod
    def law(self, theta: Array) -> tuple[Array, Array]:
        """θ2 (...), rad, and its derivative f' (...) at angles θ1 (...), rad."""

    def pitch_radii(self, theta: Array) -> tuple[Array, Array]:
        """r1 and r2 (...), mm, at angles θ1 (...), rad."""
        r2 = self.distance / (1 - self.law(theta)[1])
        return self.side * (self.distance - r2), r2

    def turns(self, teeth: int) -> int:
        """Turns of a driver with so many teeth after which the same teeth meet again."""
        mate = round(teeth * self.driven.perimeter / self.driver.perimeter)
        return mate // math.gcd(teeth, mate)

    def pitch(self, teeth: int) -> float:
        """Distance, mm, of so many teeth of the driver along its pitch curve."""
        return self.driver.perimeter / teeth

    def run(self, teeth: int, positions: int | None = None) -> Array:
        """Arcs (n,), mm, of the driver's pitch point at equal steps until the same teeth meet again.

        ``positions`` is their number, four per tooth and one by default, which makes the step unrelated to
        the pitch, so that every part of the mesh cycle is met.
        """
        turns = self.turns(teeth)
        count = POSITIONS_PER_TOOTH * teeth * turns + 1 if positions is None else positions
        arcs: Array = turns * self.driver.perimeter * np.arange(count) / count
        return arcs

    def angles(self, arc: Array) -> tuple[Array, Array]:
        """θ1 and θ2 (n,), rad, with the pitch point at arcs (n,), mm, of the driver; steps are small."""
        theta: Array = -np.unwrap(self.driver.frame_at(arc).polar_angle)
        return theta, self.law(theta)[0]

    def tilt(self, arc: Array) -> Array:
        """ν (n,), rad, of both pitch curves in the pitch point, at arcs as in :meth:`angles`."""
        return self.driver.frame_at(arc).tilt

    def levers(self, arc: Array, pressure_angle: float) -> tuple[Array, Array]:
        """Distances (n,), mm, of axis O2 from the two lines of action, at arcs as in :meth:`angles`.

        The first belongs to the flank that stops the driven gear turning counter-clockwise, the second to the
        other: r2 cos(ν ± σ α). A normal play c lets the gear turn by c over the lever.
        """
        r2, tilt = self.pitch_radii(self.angles(arc)[0])[1], self.tilt(arc)
        alpha = self.side * pressure_angle
        return r2 * np.cos(tilt + alpha), r2 * np.cos(tilt - alpha)
