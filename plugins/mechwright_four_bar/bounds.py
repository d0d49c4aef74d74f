"""Which of many four-bars certainly bear their loads, without their layers: by bounds of masses and forces.

A pin is at most as long as all layers are high, with its head and what goes out of the plates; a link lies in
the hull of its bosses. What a bound leaves open is checked by itself.
"""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright import Array
from mechwright.contracts.by_arrays import Designs
from mechwright.contracts.materials import material
from mechwright.mechanics.linkage import BUSHING_MATERIAL, PIN_MATERIAL
from mechwright.mechanics.linkage.turned import HEAD, HEAD_HEIGHT, SHAFT
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.kinematics.period_kernels import most_force
from mechwright_four_bar.masses import MICRO, MILLI
from mechwright_four_bar.parts.sizes import OF_BORE
from mechwright_four_bar.parts.usual import bore_about
from mechwright_four_bar.period import CIRCLE, Period, bars_of

MOST_PLATES, MOST_LAYERS = 3, 5
"""Links, and layers of them and two ground plates."""


def bears(designs: Designs, bar: FourBar, period: Period, least: Array) -> NDArray[np.bool_]:
    """Which designs (n,) certainly tear at no bore.

    ``least`` is the least transmission angle (n,), rad; above 0.
    """
    strength = designs.figures("material", lambda name: material(name).strength)
    limit = strength * 2 * designs["rim"] * designs["thickness"]
    inertias = _inertias(designs, bar)
    sure = _rough(bar, period, inertias, np.sin(least)) * MILLI <= limit
    near = np.flatnonzero(~sure)
    if near.size:
        bars, drives = bars_of(bar, sure.size)[near], period.rows[near]
        sure[near] = (
            most_force(bars, drives, inertias[near], CIRCLE) * MILLI
            <= np.broadcast_to(limit, sure.shape)[near]
        )
    return np.asarray(sure)


def _inertias(designs: Designs, bar: FourBar) -> Array:
    """Bounds (n, 9) as :func:`most_force` wants them."""
    pin, thickness = designs["pin_diameter"], designs["thickness"]
    turning = bore_about(*(designs[name] for name in OF_BORE))
    radius = turning / 2 + designs["rim"]
    high = 2 * designs["ground_thickness"] + MOST_PLATES * thickness + (MOST_LAYERS - 1) * designs["washer"]
    heavy = material(PIN_MATERIAL).density * 1e-6 * math.pi / 4
    pinned = heavy * (pin**2 * (high + HEAD_HEIGHT * pin) + (HEAD * pin) ** 2 * HEAD_HEIGHT * pin)
    shaft = pinned + heavy * pin**2 * SHAFT * pin
    bush = material(BUSHING_MATERIAL).density * 1e-6 * math.pi / 4 * turning**2 * thickness
    sheet = designs.figures("material", lambda name: material(name).density) * 1e-6 * thickness
    half, turned = math.pi / 2 * radius**2, (HEAD * pin + turning) ** 2 / 8

    def link(length: Any, first: Any, last: Any) -> tuple[Array, Array, Array]:
        """Mass, farthest place and moment about the first joint, of a link with masses in its joints."""
        plate = 2 * radius * length * (length**2 + radius**2) / 3
        plate = plate + half * (radius**2 + length**2 + length * radius)
        mass = sheet * 2 * (radius * length + half) + first + last
        return mass, length + radius, sheet * plate + last * length**2 + (first + last) * turned

    crank, follower = link(bar.crank, shaft, pinned), link(bar.follower, shaft + bush, pinned)
    coupler = link(bar.coupler, bush, bush)
    if designs.common.coupler_point is not None:
        x, y = designs["coupler_point_x"], designs["coupler_point_y"]
        away, there = np.hypot(x, y), np.hypot(x - bar.coupler, y)
        far = np.maximum(bar.coupler, away) + radius
        mass = (
            sheet * (bar.coupler * np.abs(y) / 2 + (bar.coupler + away + there) * radius + 2 * half)
            + 2 * bush
        )
        coupler = mass, far, mass * far**2
    load = np.abs(designs.full("load_torque")) / MICRO
    parts = [*coupler, *follower, *crank[:2], load]
    return np.stack([np.broadcast_to(part, len(designs)) for part in parts], axis=1).astype(float)


def _rough(bar: FourBar, period: Period, inertias: Array, sine: Array) -> Array:
    """The same bound from the greatest rates that the sine of the least transmission angle allows, mN."""
    a, c, b, _ = bar.lengths
    grown = np.exp(np.maximum(period.ratio * period.travel, 0.0))
    speed = np.where(period.rocks, np.abs(period.travel) / 2, grown) * period.speed
    gain = np.where(
        period.rocks, np.abs(period.travel) / 2 * period.speed**2, np.abs(period.ratio) * speed**2
    )
    w, v = a / (c * sine), a / (b * sine)
    bend = (a + c * w * w + b * v * v) / sine
    alpha_c, alpha_b = bend / c * speed**2 + w * gain, bend / b * speed**2 + v * gain
    m3, e3, j3, m4, e4, j4, m2, e2, load = inertias.T
    at_a = a * (speed**2 + gain)
    in_b = ((j4 * alpha_b + load) / b + (j3 * alpha_c + m3 * e3 * at_a) / c) / sine
    in_a = in_b + m3 * (at_a + e3 * (alpha_c + (w * speed) ** 2))
    in_b0 = in_b + m4 * e4 * (alpha_b + (v * speed) ** 2)
    return np.asarray(np.maximum(in_a + m2 * e2 * (speed**2 + gain), in_b0))
