"""What gears take up as bodies: the torque on a driven gear by its inertia and the load behind it."""

from typing import TypeVar

import numpy as np

from mechwright.arrays import Array
from mechwright.geometry import Outline
from mechwright.mechanics.linkage.mass import Mass, plate_mass

V = TypeVar("V", float, Array)

TO_NM = 1e-6
"""From kg mm²/s² to N m."""

STEADY = 0.02
"""Share of the greatest torque that has to be turned back before a tooth counts as loaded on both sides."""


def body(outline: Outline, thickness: float, material: str) -> tuple[Mass, float]:
    """A gear's mass, and its moment of inertia about its axis, kg mm²."""
    mass = plate_mass(outline, thickness, material)
    return mass, mass.about(0j)


def driven_torque(inertia: V, alpha: Array, load: V) -> Array:
    """Torque (n,), N m, on a driven gear, positive where its mate drives it on: J α + T.

    ``inertia`` is in kg mm², ``alpha`` (n,) in rad/s² and positive where the gear gets faster, and ``load``
    the torque against it, N m.

    >>> driven_torque(1e3, np.array([100.0, -100.0]), 0.05).round(9).tolist()
    [0.15, -0.05]
    """
    torque: Array = inertia * alpha * TO_NM + load
    return torque


def turned_back(torque: Array) -> bool:
    """Whether a torque (n,) changes its sign, so that both flanks of a tooth are loaded."""
    most = float(np.abs(torque).max())
    return bool(torque.min() < -STEADY * most and torque.max() > STEADY * most)
