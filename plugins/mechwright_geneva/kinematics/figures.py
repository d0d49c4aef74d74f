"""Figures of the whole motion: peaks per power of the crank's speed, and over time, walls, shares of time."""

import math
from functools import partial
from typing import Any

import numpy as np

from mechwright import Array
from mechwright.contracts.design_table import number
from mechwright.contracts.figure import Figure
from mechwright.mechanics.laws import Peaks
from mechwright_geneva.kinematics.contact_forces import loads
from mechwright_geneva.kinematics.mechanism import BLOCK, Mechanism
from mechwright_geneva.kinematics.straight_slot import StraightSlot
from mechwright_geneva.kinematics.wall_change import switches

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


def rate_peaks(m: Mechanism) -> Peaks:
    """Largest velocity, acceleration and jerk of the wheel over time: rad/s, rad/s², rad/s³."""
    of, speed = peaks_of(m), m.driver.speed
    if not m.driver.varies:
        return Peaks(of.v * speed, of.a * speed**2, of.j * speed**3)
    return Peaks(*(m.once(("rate", rate), partial(_greatest_rate, m, rate)) for rate in range(3)))


def _greatest_rate(m: Mechanism, rate: int) -> Any:
    each = (m.each(partial(_rate_peak, stroke=stroke, rate=rate), BLOCK) for stroke in m.strokes)
    found = np.max(list(each), axis=0)
    return found.item() if m.single else found


def _rate_peak(m: Mechanism, stroke: int, rate: int) -> Array:
    """Peak (n, 1) of a rate over a stroke."""
    u, half = np.linspace(0, 1, _GRID)[None], np.reshape(m.crank_half, (-1, 1))
    values = np.zeros((m.size, 1))
    for _ in range(2):
        run = m.stroke(u)
        turning = m.driver.at(2 * half * u + stroke * m.pitch)
        values = np.abs(turning.carried(run.first, run.second, run.third)[rate])
        values = np.broadcast_to(values, (m.size, _GRID))
        most = np.argmax(values, axis=-1, keepdims=True)
        ends = (np.clip(most + step, 0, _GRID - 1) for step in (-1, 1))
        low, high = (np.take_along_axis(np.broadcast_to(u, values.shape), end, axis=-1) for end in ends)
        u = low + (high - low) * np.linspace(0, 1, _GRID)
    peak: Array = values.max(axis=-1, keepdims=True)
    return peak


def dwell_share(m: Mechanism) -> Any:
    """Share of the time of a turn in which the wheel rests."""
    if not m.driver.varies:
        return 1 - m.params.rollers * 2 * m.crank_half / math.tau
    ends = [m.pitch * stroke + end for stroke in m.strokes for end in (0.0, 2 * m.crank_half)]
    times = [m.driver.time(np.asarray(end)) for end in ends]
    moving = sum(np.abs(two - one) for one, two in zip(times[::2], times[1::2], strict=True))
    whole = m.driver.time(np.asarray(m.driver.start + m.driver.sense * math.tau))
    return number(1 - moving / whole)


def figures(m: Mechanism) -> dict[str, Figure]:
    """The figures by name: sizes, times, peaks of the law, loads, and of one mechanism changes of walls."""
    peaks, straight = peaks_of(m), straight_peaks(m.slots)
    there, back = (m.driver.time(np.asarray(angle)) for angle in (0.0, 2 * m.crank_half))
    return {
        "centre_distance": Figure(m.axes, "mm"),
        "crank_radius": Figure(m.crank, "mm"),
        "slot_bottom_radius": Figure(m.bottom, "mm"),
        "index_angle": Figure(2 * m.wheel_half, "rad"),
        "index_time": Figure(abs(back - there), "s"),
        "dwell_share": Figure(lambda: dwell_share(m)),
        "omega_w_max": Figure(lambda: rate_peaks(m).v, "rad/s"),
        "alpha_w_max": Figure(lambda: rate_peaks(m).a, "rad/s^2"),
        "jerk_w_max": Figure(lambda: rate_peaks(m).j, "rad/s^3"),
        "velocity_peak": Figure(peaks.v),
        "acceleration_peak": Figure(peaks.a),
        "jerk_peak": Figure(peaks.j),
        "straight_velocity_peak": Figure(straight.v),
        "straight_acceleration_peak": Figure(straight.a),
        "straight_jerk_peak": Figure(straight.j),
        "entry_acceleration_jump": Figure(abs(m.law.jumps[0]) * m.wheel_half / (2 * m.crank_half**2)),
        "contact_force_max": Figure(lambda: loads(m).force, "N"),
        "contact_pressure_max": Figure(lambda: np.where(_bears(m), loads(m).pressure, np.nan), "MPa"),
        "crank_torque_max": Figure(lambda: loads(m).crank_torque, "N*m"),
        **(_wall_changes(m) if m.single else {}),
    }


def _bears(m: Mechanism) -> Any:
    """Whether the rollers have a length that bears."""
    return np.asarray(m.params.roller_length) > 0


def _wall_changes(m: Mechanism) -> dict[str, Figure]:
    """Where the roller changes walls, at which speed of the driver, and how hard it meets the other one."""
    found = {}
    for count, one in enumerate(switches(m), start=1):
        found[f"wall_switch_{count}"] = Figure(math.degrees(one.theta), "deg")
        found[f"wall_switch_{count}_speed"] = Figure(abs(one.omega) * 60 / math.tau, "rpm")
        if one.impact is not None:
            found[f"wall_switch_{count}_impact"] = Figure(one.impact, "mm/s")
    return found
