"""How large a locking disc may be whose ends the wheel's horns do not cut off.

A horn sweeps through the disc's relief while the wheel turns. It has to be outside the disc's circle before
it comes round to the locking arc: with a large disc and a long stroke it is not, and cuts the end of the arc
away. The driver's frame is that of :mod:`mechwright_geneva.relief`.
"""

import numpy as np
from numpy.typing import NDArray

from mechwright import Array
from mechwright.mechanics.laws import Law
from mechwright_geneva.kinematics import Frame

_RADII = 201
"""Discs between the least and the greatest, both included, among which the largest is sought."""

_SAMPLES = 801
"""Of the stroke."""

SPARE = 1.01
"""A horn is to be so much farther out than the disc."""


def clear(frame: Frame, law: Law, discs: Array, clearance: "float | Array") -> NDArray[np.bool_]:
    """Whether the horns miss the locking arc.

    A horn at x beyond the line of centres is at the angle -β(x) - φ of the driver's frame, with
    tan β = l sin x/(a - l cos x); the locking arc begins at -θd0, and from there the angle falls.

    Parameters
    ----------
    frame, law
        Of one design, or of many as columns (m, 1).
    discs
        (k,) radii of locking discs, mm, that reach the wheel; of many designs one each, (m,).
    clearance
        Of the disc, mm; of many designs a number or (m, 1).
    """
    axes, rim, half = frame.axes, frame.entry_radius + clearance, frame.crank_half
    disc = discs[:, None]
    horn = np.arccos(np.clip((axes**2 + rim**2 - disc**2) / (2 * axes * rim), -1, 1))
    share = np.linspace(0, 1, _SAMPLES)
    theta, way = 2 * frame.wheel_half * law.at(share).s, 2 * half * share
    missed = np.ones(discs.shape, dtype=bool)
    # A symmetric law leaves as it enters, backwards.
    both = ((way, theta), (2 * half - way[..., ::-1], 2 * frame.wheel_half - theta[..., ::-1]))
    for turned, angle in both[: 1 if law.symmetric else 2]:
        cos, sin = _beyond(angle, horn)
        tip = axes**2 + rim**2 - 2 * axes * rim * cos
        inside = (angle > horn) & (tip < (SPARE * disc) ** 2)
        missed &= ~(inside & (np.arctan2(rim * sin, axes - rim * cos) > turned)).any(axis=-1)
    return missed


def _beyond(angle: Array, horn: Array) -> tuple[Array, Array]:
    """Cosine and sine (m, k) of an angle (k,) or (m, k) less another (m, 1)."""
    cos, sin, of, over = np.cos(angle), np.sin(angle), np.cos(horn), np.sin(horn)
    return cos * of + sin * over, sin * of - cos * over


def greatest_discs(frame: Frame, law: Law, least: Array, most: Array, clearance: "float | Array") -> Array:
    """The largest discs (m,) between two radii whose locking arcs the horns miss; ``most`` if none is, mm.

    Of some radii between the two the largest is taken that is missed, where those below it are missed too.
    """
    found = most.copy()
    doubtful = (least < most) & ~clear(frame, law, most, clearance)
    rows = np.flatnonzero(doubtful)
    if not rows.size:
        return found
    part, room = frame.rows(doubtful), np.broadcast_to(clearance, (most.size, 1))[doubtful]
    low, step = least[rows], (most[rows] - least[rows]) / (_RADII - 1)
    missed, cut = np.zeros(rows.size, dtype=np.int64), np.full(rows.size, _RADII - 1)
    able = clear(part, law, low, room)
    while (cut - missed > 1).any():
        middle = (missed + cut) // 2
        good = clear(part, law, low + middle * step, room)
        missed, cut = np.where(good, middle, missed), np.where(good, cut, middle)
    found[rows[able]] = np.floor(100 * (low + missed * step)[able]) / 100
    return found


def greatest_disc(frame: Frame, law: Law, least: float, most: float, clearance: float) -> float:
    """As :func:`greatest_discs` of one design."""
    one = Frame.of([frame.wheel_half], [frame.crank_half], [frame.offset], [frame.entry_radius])
    return float(greatest_discs(one, law, np.array([least]), np.array([most]), clearance)[0])
