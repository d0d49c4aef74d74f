"""How large a locking disc may be whose ends the wheel's horns do not cut off.

A horn sweeps through the disc's relief while the wheel turns. It has to be outside the disc's circle before
it comes round to the locking arc: with a large disc and a long stroke it is not, and cuts the end of the arc
away. The driver's frame is that of :mod:`mechwright_geneva.relief`.
"""

import math

import numpy as np
from numpy.typing import NDArray

from mechwright import Array
from mechwright.mechanics.laws import Law
from mechwright_geneva.kinematics import Frame, stroke

_RADII = 201
"""Discs tried between the least and the greatest."""

_BLOCK = 20
"""Discs tried at a time, from the greatest on: mostly it is one of the first."""

_SAMPLES = 801
"""Of the stroke."""

SPARE = 1.01
"""A horn is to be so much farther out than the disc."""


def clear(frame: Frame, law: Law, discs: Array, clearance: float) -> NDArray[np.bool_]:
    """Whether the horns miss the locking arc.

    Parameters
    ----------
    frame, law
        Of one design.
    discs
        (k,) radii of locking discs, mm, that reach the wheel.
    clearance
        Of the disc, mm.
    """
    axes, rim, half = float(frame.axes), float(frame.entry_radius) + clearance, float(frame.crank_half)
    horn = np.arccos(np.clip((axes**2 + rim**2 - discs**2) / (2 * axes * rim), -1, 1))[:, None]
    run = stroke(frame, law, np.linspace(0, 1, _SAMPLES))
    missed = np.ones(discs.shape, dtype=bool)
    for phi, theta in ((run.phi, run.theta), (-run.phi[::-1], 2 * frame.wheel_half - run.theta[::-1])):
        tip = (axes - rim * np.exp(1j * (theta - horn))) * np.exp(-1j * phi)
        inside = (theta > horn) & (np.abs(tip) < SPARE * discs[:, None])
        if not inside.any():
            continue
        # The locking arc begins at -θd0 and runs on from there with the angle falling.
        turned = np.unwrap(np.angle(tip), axis=-1)
        cut = inside & (turned < -half)
        missed &= ~cut.any(axis=-1)
    return missed


def greatest_disc(frame: Frame, law: Law, least: float, most: float, clearance: float) -> float:
    """The largest disc between two radii whose locking arc the horns miss; ``most`` if none is, mm."""
    if not least < most:
        return most
    if clear(frame, law, np.array([most]), clearance).all():
        return most
    discs = np.linspace(least, most, _RADII)[-2::-1]
    for block in range(0, discs.size, _BLOCK):
        tried = discs[block : block + _BLOCK]
        able = tried[clear(frame, law, tried, clearance)]
        if able.size:
            return math.floor(100 * float(able[0])) / 100
    return most
