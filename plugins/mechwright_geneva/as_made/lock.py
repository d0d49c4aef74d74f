"""The lock as made: how far the disc stands from the concave arcs, and what turn it leaves."""

from dataclasses import dataclass

import numpy as np

from mechwright import Array, MadePart
from mechwright_geneva.kinematics.mechanism import Mechanism

NEAR = 0.1
"""A wall so near to the circle of disc or arc belongs to it, mm."""


@dataclass(frozen=True)
class Lock:
    """Disc and concave arcs; lengths in mm.

    Parameters
    ----------
    m
        The mechanism.
    arc, disc
        Mean radii, about where the axes are by the bores as made.
    least
        Least clearance anywhere, with the axes at their distance.
    corridor
        Of both walls together.
    """

    m: Mechanism
    arc: float
    disc: float
    least: float
    corridor: float

    @classmethod
    def of(cls, m: Mechanism, wheel: MadePart, disc: MadePart) -> "Lock":
        """As wheel and disc are made."""
        step = 2 * m.wheel_half * np.arange(m.slots)
        arcs = _radii(wheel, m.params.bore, m.axes * np.exp(1j * step), m.arc)
        discs = _radii(disc, m.params.driver_bore, np.zeros(1), m.lock)
        return cls(
            m,
            float(arcs.mean()),
            float(discs.mean()),
            float(arcs.min() - discs.max()),
            wheel.corridor + disc.corridor,
        )

    def play(self, off_centre: float = 0.0, more: float = 0.0) -> float:
        """Turn of the locked wheel either way, rad, in the middle of the dwell.

        Parameters
        ----------
        off_centre
            By how much the axes are too far apart, mm.
        more
            Added to the clearance, mm.
        """
        return float(self.m.lock_play(self.arc + more, self.disc, off_centre))


def _radii(part: MadePart, bore: float, centres: Array, radius: float) -> Array:
    """Distances (k,) from centres of those through walls that lie on a circle about one, axis at the bore."""
    points = np.concatenate([ring.points for ring in part.outline.rings]) - part.bore_middle(bore)
    away = np.abs(points @ (1, 1j) - centres[:, None])
    return np.asarray(away[np.abs(away - radius) < NEAR])
