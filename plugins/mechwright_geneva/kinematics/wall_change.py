"""Where the roller changes from one wall of its slot to the other, and how hard it meets it.

The wall carries on which torque and lever have one sign: it changes in the middle of a curved stroke, where
the lever's sign does, and where the torque's does. From there on no wall pushes: the wheel goes on under its
load alone, the driver leads or lags it by D with D'' = T_w/J, and meets the other wall when lever times D is
the clearance. Each change is taken by itself, as if the roller had lain on the wall until then.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from mechwright import Array
from mechwright_geneva.kinematics.contact_forces import contact, drive_of
from mechwright_geneva.kinematics.geometry import LEFT, RIGHT
from mechwright_geneva.kinematics.mechanism import Mechanism

_GRID = 2001
"""Samples of a stroke among which the torque's changes of sign are found."""

_NOTHING = 1e-9
"""Part of the greatest torque below which one is rounding."""

_FLIGHT = 4001
"""Samples of a free flight, denser at its start."""

_BEGUN = 100
"""Sample of a flight, a 1600th of the rest of the stroke, that shows which way the gap opens."""

_AFTER = 1e-4
"""Share of a stroke after a change at which one asks which wall carries."""


@dataclass(frozen=True, slots=True)
class Switch:
    """A change of walls.

    Parameters
    ----------
    theta
        Crank angle θd, rad.
    omega
        Speed of the driver there, rad/s, below 0 backwards.
    wall
        The wall that carries from there on: left or right, as the roller sees it on its way forwards; of a
        straight slot, which is run along there and back, ahead or behind.
    impact
        Speed across the clearance with which the roller meets it, mm/s; None if it does not come to that.
    """

    theta: float
    omega: float
    wall: str
    impact: float | None


def torque(m: Mechanism, u: Array, stroke: int) -> Array:
    """T_w (k,), N·m, at shares u (k,) of a stroke."""
    run = m.stroke(u)
    drive = drive_of(m, run, stroke)
    return drive.accelerating(run) + drive.pushing(run)


def switches(m: Mechanism) -> tuple[Switch, ...]:
    """The changes of a turn in the order in which the driver comes to them; of a stroke if all are alike."""
    return m.once("switches", lambda: tuple(_switches(m)))


def _switches(m: Mechanism) -> Iterator[Switch]:
    for stroke in m.different_strokes:
        for u in _shares(m, stroke):
            yield _switch(m, float(u), stroke)


def _shares(m: Mechanism, stroke: int) -> list[float]:
    """Shares u of a stroke, in the driver's order, at which the wall changes."""
    grid = np.linspace(0, 1, _GRID)
    values = torque(m, grid, stroke)
    least = _NOTHING * float(np.abs(values).max())
    there = np.flatnonzero(np.abs(values) > least)
    changes = np.flatnonzero(values[there[:-1]] * values[there[1:]] < 0)
    found = [
        float(brentq(lambda u: float(torque(m, np.array([u]), stroke)[0]), *ends, xtol=1e-15))
        for ends in zip(grid[there[changes]].tolist(), grid[there[changes + 1]].tolist(), strict=True)
    ]
    if not m.straight:
        middle = 0.5
        near = [u for u in found if abs(u - middle) < _AFTER**2]
        found = [u for u in found if u not in near] if near else [*found, middle]
        if not there.size:
            found = []
    return sorted(found, reverse=m.driver.sense < 0)


def _switch(m: Mechanism, u: float, stroke: int) -> Switch:
    ahead = m.driver.sense
    theta = 2 * m.crank_half * u + stroke * m.pitch
    after = np.array([np.clip(u + ahead * _AFTER, 0, 1)])
    carrier = int(contact(m, m.stroke(after), stroke).carrier[0])
    if m.straight:
        wall = "ahead" if (carrier == RIGHT) == (after[0] <= 0.5) else "behind"
    else:
        wall = {LEFT: "left", RIGHT: "right"}[carrier]
    omega = float(m.driver.at(np.array([theta])).omega[0])
    return Switch(theta, omega, wall, _impact(m, u, stroke))


def _impact(m: Mechanism, u: float, stroke: int) -> float | None:
    """Speed across the clearance when it is closed, mm/s; 0 without a clearance."""
    clearance = m.params.groove_clearance
    if clearance == 0:
        return 0.0
    end = 1.0 if m.driver.sense > 0 else 0.0
    way = u + (end - u) * np.linspace(0, 1, _FLIGHT) ** 2
    run = m.stroke(way)
    time = m.driver.time(2 * m.crank_half * way + stroke * m.pitch)
    if m.params.load_inertia == 0 or not np.isfinite(time).all():
        return None
    steps = np.diff(time)
    pull = torque(m, way, stroke) / m.params.load_inertia
    speed = np.concatenate(([0.0], np.cumsum(steps * (pull[1:] + pull[:-1]) / 2)))
    lead = np.concatenate(([0.0], np.cumsum(steps * (speed[1:] + speed[:-1]) / 2)))
    gap = m.lever(run) * lead
    gap *= np.sign(gap[_BEGUN])
    closed, back = np.flatnonzero(gap >= clearance), np.flatnonzero(gap[_BEGUN:] < 0)
    if not closed.size or (back.size and back[0] + _BEGUN < closed[0]):
        return None
    at = int(closed[0])
    return float((gap[at] - gap[at - 1]) / (time[at] - time[at - 1]))
