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
    def drawn(cls, m: Mechanism) -> "Lock":
        """As the design has it."""
        return cls(m, m.arc, m.lock, m.params.lock_clearance, 0.0)

    @classmethod
    def of(cls, m: Mechanism, wheel: MadePart, disc: MadePart) -> "Lock":
        """As wheel and disc are made."""
        rim, side = _about_bore(wheel, m.params.bore), _about_bore(disc, m.params.driver_bore)
        step = 2 * m.wheel_half * np.arange(m.slots)
        centres = m.axes * np.column_stack((np.cos(step), np.sin(step)))
        arcs = np.concatenate([_on(rim, centre, m.arc) for centre in centres])
        discs = _on(side, np.zeros(2), m.lock)
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
        play: float = self.m.lock_play(self.arc + more, self.disc, off_centre)
        return play


def _about_bore(part: MadePart, diameter: float) -> Array:
    """Points (n, 2) of all through walls, mm, about the middle of the bore as made."""
    points: Array = np.concatenate([ring.points for ring in part.outline.rings])
    return points - part.bore_middle(diameter)


def _on(points: Array, centre: Array, radius: float) -> Array:
    """Distances (k,) from the centre of those points that lie on a circle about it."""
    away = np.hypot(*(points - centre).T)
    on: Array = away[np.abs(away - radius) < NEAR]
    return on
