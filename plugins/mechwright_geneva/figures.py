"""Figures of the whole motion: peaks per power of the crank's speed, and over time, walls, shares of time."""

import math
from typing import Any

import numpy as np

from mechwright import Scalar, kept
from mechwright.mechanics.laws import Peaks
from mechwright_geneva.contact import loads
from mechwright_geneva.mechanism import Mechanism
from mechwright_geneva.straight import StraightSlot
from mechwright_geneva.walls import switches

_GRID = 2001
"""Samples of a stroke that find the peak of a rate under a driver whose speed varies; twice as many again
about it find its value to a millionth."""


def peaks_of(mechanism: Mechanism) -> Peaks:
    """Largest θw', θw'', θw''' of a stroke, per powers of the crank's angle."""
    way, time = 2 * mechanism.wheel_half, 2 * mechanism.crank_half
    of = mechanism.law.peaks
    return Peaks(way / time * of.v, way / time**2 * of.a, way / time**3 * of.j)


def straight_peaks(slots: int) -> Peaks:
    """The same of the straight slot with as many slots; its jerk is infinite at the ends besides."""
    law = StraightSlot(slots)
    way, time = 2 * law.wheel_half_angle, 2 * law.crank_half_angle
    return Peaks(
        *(value * way / time**k for k, value in enumerate((law.peaks.v, law.peaks.a, law.peaks.j), 1))
    )


@kept
def rate_peaks(m: Mechanism) -> Peaks:
    """Largest velocity, acceleration and jerk of the wheel over time: rad/s, rad/s², rad/s³."""
    of, speed = peaks_of(m), m.driver.speed
    if not m.driver.varies:
        return Peaks(of.v * speed, of.a * speed**2, of.j * speed**3)
    return Peaks(*(max(_rate_peak(m, stroke, rate) for stroke in m.strokes) for rate in range(3)))


def _rate_peak(m: Mechanism, stroke: int, rate: int) -> float:
    u = np.linspace(0, 1, _GRID)
    values = np.zeros(0)
    for _ in range(2):
        run = m.stroke(u)
        turning = m.driver.at(2 * m.crank_half * u + stroke * m.pitch)
        values = np.abs(turning.carried(run.first, run.second, run.third)[rate])
        most = int(np.argmax(values))
        u = np.linspace(u[max(most - 1, 0)], u[min(most + 1, u.size - 1)], _GRID)
    return float(values.max())


def dwell_share(m: Mechanism) -> float:
    """Share of the time of a turn in which the wheel rests."""
    if not m.driver.varies:
        return 1 - m.params.rollers * 2 * m.crank_half / math.tau
    ends = np.array([[0.0, 2 * m.crank_half]]) + m.pitch * np.array([list(m.strokes)]).T
    moving = float(np.abs(np.diff(m.driver.time(ends))).sum())
    whole = m.driver.time(np.asarray(m.driver.start + m.driver.sense * math.tau))
    return 1 - moving / float(whole)


def sizes_and_times(m: Mechanism) -> dict[str, tuple[Any, str]]:
    """Sizes, times and peaks of the law, with their units; of many designs columns (m, 1)."""
    peaks, straight, rates = peaks_of(m), straight_peaks(m.slots), rate_peaks(m)
    there, back = (m.driver.time(np.asarray(angle)) for angle in (0.0, 2 * m.crank_half))
    return {
        "centre_distance": (m.axes, "mm"),
        "crank_radius": (m.crank, "mm"),
        "slot_bottom_radius": (m.bottom, "mm"),
        "index_angle": (2 * m.wheel_half, "rad"),
        "index_time": (abs(back - there), "s"),
        "dwell_share": (dwell_share(m), ""),
        "omega_w_max": (rates.v, "rad/s"),
        "alpha_w_max": (rates.a, "rad/s^2"),
        "jerk_w_max": (rates.j, "rad/s^3"),
        "velocity_peak": (peaks.v, ""),
        "acceleration_peak": (peaks.a, ""),
        "jerk_peak": (peaks.j, ""),
        "straight_velocity_peak": (straight.v, ""),
        "straight_acceleration_peak": (straight.a, ""),
        "straight_jerk_peak": (straight.j, ""),
        "entry_acceleration_jump": (abs(m.law.jumps[0]) * m.wheel_half / (2 * m.crank_half**2), ""),
    }


def figures(m: Mechanism) -> dict[str, Scalar]:
    """The figures by name."""
    load = loads(m)
    return {
        **{name: Scalar(float(value), unit) for name, (value, unit) in sizes_and_times(m).items()},
        "contact_force_max": Scalar(load.force, "N"),
        **({"contact_pressure_max": Scalar(load.pressure, "MPa")} if m.params.roller_length > 0 else {}),
        "crank_torque_max": Scalar(load.crank_torque, "N*m"),
        **_walls(m),
    }


def _walls(m: Mechanism) -> dict[str, Scalar]:
    """Where the roller changes walls, at which speed of the driver, and how hard it meets the other one."""
    found = {}
    for number, one in enumerate(switches(m), start=1):
        found[f"wall_switch_{number}"] = Scalar(math.degrees(one.theta), "deg")
        found[f"wall_switch_{number}_speed"] = Scalar(abs(one.omega) * 60 / math.tau, "rpm")
        if one.impact is not None:
            found[f"wall_switch_{number}_impact"] = Scalar(one.impact, "mm/s")
    return found
