"""Which of many four-bars certainly bear their loads, without their layers: by bounds of masses and forces.

A pin is at most as long as all layers are high, with its head and what goes out of the plates; a link lies in
the hull of its bosses. What a bound leaves open is checked by itself.
"""

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mechwright import Array, material
from mechwright.contracts.design_table import column
from mechwright.mechanics.linkage import BUSHING_MATERIAL, PIN_MATERIAL
from mechwright.mechanics.linkage.kinematics.channel_extremes import drives_of
from mechwright.mechanics.linkage.turned import HEAD, HEAD_HEIGHT, SHAFT
from mechwright.mechanics.peak import PEAK_SAMPLES
from mechwright_four_bar.kinematics.compiled import NEAR_TOGGLE, compiled
from mechwright_four_bar.parts.usual import turning_bore
from mechwright_four_bar.table import FourBarTable

MILLI, MICRO = 1e-3, 1e-6
"""Forces are computed in mN, and moments in mN mm."""

MOST_PLATES, MOST_LAYERS = 3, 5
"""Links, and layers of them and two ground plates."""


def bears(table: FourBarTable) -> NDArray[np.bool_]:
    """Which designs (n, 1) certainly tear at no bore.

    A table's periods are sampled where the bound of the least transmission angle leaves it open.
    """
    params, inertias = table.params, _inertias(table)
    limit = column(material(params.material).strength * 2 * params.rim * params.thickness, table.size)[:, 0]
    least = column(table.transmission[0], table.size)[:, 0]
    doubtful = (least < NEAR_TOGGLE) | (column(params.coupler_bend, table.size)[:, 0] != 0)
    sure = ~doubtful & (_most_force(table, inertias, _bounded(table, np.sin(least))) <= limit)
    near = np.flatnonzero(~sure & ~doubtful)
    if near.size and not table.single:
        some = table.rows(near)
        sure[near] = _most_force(some, inertias[near], _sampled(some)) <= limit[near]
    return np.asarray(sure)[:, None]


def _inertias(table: FourBarTable) -> Array:
    """Bounds (n, 9).

    Of coupler and follower mass, the farthest that any of it lies from the first joint, and moment of inertia
    about that, kg, mm, kg mm², each of them or more; the crank's mass and farthest place; and the size of the
    follower's load, mN mm.
    """
    params, bar = table.params, table.bar
    pin, thickness, turning = params.pin_diameter, params.thickness, turning_bore(params)
    radius = turning / 2 + params.rim
    high = 2 * params.ground_thickness + MOST_PLATES * thickness + (MOST_LAYERS - 1) * params.washer
    heavy = material(PIN_MATERIAL).density * 1e-6 * math.pi / 4
    pinned = heavy * (pin**2 * (high + HEAD_HEIGHT * pin) + (HEAD * pin) ** 2 * HEAD_HEIGHT * pin)
    shaft = pinned + heavy * pin**2 * SHAFT * pin
    bush = material(BUSHING_MATERIAL).density * 1e-6 * math.pi / 4 * turning**2 * thickness
    sheet = material(params.material).density * 1e-6 * thickness
    half, turned = math.pi / 2 * radius**2, (HEAD * pin + turning) ** 2 / 8

    def link(length: Any, first: Any, last: Any) -> tuple[Array, Array, Array]:
        """Mass, farthest place and moment about the first joint, of a link with masses in its joints."""
        plate = 2 * radius * length * (length**2 + radius**2) / 3
        plate = plate + half * (radius**2 + length**2 + length * radius)
        mass = sheet * 2 * (radius * length + half) + first + last
        return mass, length + radius, sheet * plate + last * length**2 + (first + last) * turned

    crank, follower = link(bar.crank, shaft, pinned), link(bar.follower, shaft + bush, pinned)
    coupler = link(bar.coupler, bush, bush)
    if params.coupler_point is not None:
        away, there = np.abs(params.coupler_point), np.abs(params.coupler_point - bar.coupler)
        far = np.maximum(bar.coupler, away) + radius
        inside, around = bar.coupler * np.abs(np.imag(params.coupler_point)) / 2, bar.coupler + away + there
        mass = sheet * (inside + around * radius + 2 * half) + 2 * bush
        coupler = mass, far, mass * far**2
    parts = [*coupler, *follower, *crank[:2], np.abs(params.load_torque) / MICRO]
    return np.concatenate([column(part, table.size) for part in parts], axis=1)


class Rates(NamedTuple):
    """What speeds, rad/s, and accelerations of crank, coupler and follower do not exceed; the sine at B."""

    omega_a: Array
    alpha_a: Array
    omega_c: Array
    alpha_c: Array
    omega_b: Array
    alpha_b: Array
    sine: Array


def _bounded(table: FourBarTable, sine: Array) -> Rates:
    """What the sine of the least transmission angle allows."""
    a, c, b = (column(one, table.size)[:, 0] for one in table.bar.lengths[:3])
    _, travel, rocks, ratio, begins = drives_of(table).T
    grown = np.exp(np.maximum(ratio * travel, 0.0))
    speed = np.where(rocks > 0, np.abs(travel) / 2, grown) * begins
    gain = np.where(rocks > 0, np.abs(travel) / 2 * begins**2, np.abs(ratio) * speed**2)
    w, v = a / (c * sine), a / (b * sine)
    bend = (a + c * w * w + b * v * v) / sine
    alpha_c, alpha_b = bend / c * speed**2 + w * gain, bend / b * speed**2 + v * gain
    return Rates(speed, gain, w * speed, alpha_c, v * speed, alpha_b, sine)


def _sampled(table: FourBarTable) -> Rates:
    """The greatest over a period."""
    found = np.abs(compiled(table, Rates._fields[:6], PEAK_SAMPLES)).max(axis=2)
    return Rates._make([*found.T, np.sin(column(table.transmission[0], table.size)[:, 0])])


def _most_force(table: FourBarTable, inertias: Array, rates: Rates) -> Array:
    """What no joint force exceeds (n,), N.

    Moments of the follower about B0 and of the coupler about A give the components p and q of the force in B
    across both, so that it is at most (|p| + |q|) over the sine of the angle between them; the other joints
    add what accelerates the links.
    """
    a, c, b = (column(one, table.size)[:, 0] for one in table.bar.lengths[:3])
    m3, e3, j3, m4, e4, j4, m2, e2, load = inertias.T
    centripetal = rates.omega_a**2 + rates.alpha_a
    at_a = a * centripetal
    in_b = ((j4 * rates.alpha_b + load) / b + (j3 * rates.alpha_c + m3 * e3 * at_a) / c) / rates.sine
    in_a = in_b + m3 * (at_a + e3 * (rates.alpha_c + rates.omega_c**2))
    in_b0 = in_b + m4 * e4 * (rates.alpha_b + rates.omega_b**2)
    return np.asarray(np.maximum(in_a + m2 * e2 * centripetal, in_b0)) * MILLI
