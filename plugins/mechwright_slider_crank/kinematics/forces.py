"""Forces of joints and drive, and what balances the moving masses."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from mechwright.mechanics.linkage import Mass
from mechwright.mechanics.planar.dynamics import Forces
from mechwright.mechanics.planar.efforts import PointLoad, efforts
from mechwright_slider_crank.kinematics.slider_crank import Bodies

MILLI = 1e-3
"""From N mm to N m."""


def joint_forces(bodies: Bodies, masses: Mapping[str, Mass], load: float = 0.0) -> Forces:
    """Forces at the samples of a motion, N and N mm: of shaft, crank-pin, wrist-pin and guide.

    Parameters
    ----------
    bodies
        The motion (n,) in time.
    masses
        Of ``"crank"``, ``"rod"`` and ``"slider"``, kg and mm.
    load
        Force on the slider along the slide, N, through its pin.
    """
    along = load * np.exp(1j * np.asarray(bodies.linkage.direction))
    return efforts(bodies.linkage.machine, bodies.solution, masses, [PointLoad("slider", 0j, along)])


@dataclass(frozen=True, slots=True)
class Balance:
    """What full force balance takes: mass times lever, kg mm, as x + i y in each body's coordinates.

    Parameters
    ----------
    rod
        To add to the rod, from A: then rod and slider together balance about A, m3 r3 = -m4 c.
    crank
        To add to the crank, from A0, once the rod is balanced: m2 r2 = -(m3 + m4) a. The rod's counterweight
        is part of m3, and its mass is the less the longer its lever.
    rod_weight
        Mass of the rod's counterweight, kg, at a lever of a crank's length, which ``crank`` counts on.
    """

    rod: Any
    crank: Any
    rod_weight: Any


def balance(crank: Any, rod: Any, masses: Mapping[str, Mass]) -> Balance:
    """Counterweights that make the shaking force vanish at every instant.

    >>> found = balance(50.0, 150.0, {"crank": Mass(0.0), "rod": Mass(0.0), "slider": Mass(2.0)})
    >>> found.rod.real, found.crank.real, found.rod_weight
    (-300.0, -400.0, 6.0)
    """
    m2, m3, m4 = masses["crank"], masses["rod"], masses["slider"]
    on_rod = -m4.mass * rod - m3.mass * m3.centre
    weight = abs(on_rod) / crank
    on_crank = -(m3.mass + weight + m4.mass) * crank - m2.mass * m2.centre
    return Balance(on_rod, on_crank, weight)
