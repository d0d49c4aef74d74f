"""What the joints carry over a period, and which designs of a table certainly bear it.

Of a table bounds of masses and forces tell: a pin is at most as long as all layers are high, with its head; a
disc, a rod and a slider are taken without their bores.
"""

import math
from typing import Any

import numpy as np

from mechwright.contracts.design_table import column
from mechwright.contracts.materials import material
from mechwright.mechanics.linkage import BUSHING_MATERIAL, PIN_MATERIAL
from mechwright.mechanics.planar.dynamics import Forces
from mechwright.mechanics.strength.turning_pair import TurningPair
from mechwright_slider_crank.kinematics.course import drives, is_lever, least_of, period_of, some
from mechwright_slider_crank.kinematics.extremes import chain_of, drives_of
from mechwright_slider_crank.kinematics.forces import MILLI, joint_forces
from mechwright_slider_crank.kinematics.mechanism import Mechanism
from mechwright_slider_crank.kinematics.slider_crank import Bodies
from mechwright_slider_crank.parts.base import TAIL_SHARE
from mechwright_slider_crank.parts.layers import has_bounds
from mechwright_slider_crank.parts.masses import bodies_of
from mechwright_slider_crank.parts.plates import TURN_SAMPLES, layout_of

MOST_LAYERS = 4
"""Base, crank, rod, and slider with its rails."""


def carried(m: Mechanism) -> tuple[Bodies, Forces]:
    """The motion of one design over a period, and the forces of its joints."""

    def found() -> tuple[Bodies, Forces]:
        _, _, bodies = period_of(m, TURN_SAMPLES)
        return bodies, joint_forces(bodies, bodies_of(m), m.given.load)

    return m.once("carried", found)


def rod_force(m: Mechanism) -> float:
    """The greatest force on a bore of the rod, N."""
    joints = carried(m)[1].joints
    return float(max(np.abs(joints["crank-pin"]).max(), np.abs(joints["wrist-pin"]).max()))


def pairs_of(m: Mechanism) -> tuple[TurningPair, ...]:
    """Shaft, crank pin and wrist pin of one design over a period."""
    params, sizes, layers = m.given, m.dimensions, layout_of(m).stack
    bodies, found = carried(m)
    crank, rod = bodies.crank.turning.omega, bodies.rod.turning.omega
    # Pin to the plate that holds it, the one that turns on it, its diameter and bore, and how fast it turns.
    held = {
        "shaft": ("crank", "base", sizes.shaft, sizes.base_bore, crank),
        "crank-pin": ("crank", "rod", sizes.pin, sizes.rod_bore, rod - crank),
        "wrist-pin": ("slider", "rod", sizes.pin, sizes.rod_bore, rod),
    }
    return tuple(
        TurningPair(
            f"the {name.replace('-', ' ')}",
            np.abs(found.joints[name]),
            speed,
            pin,
            abs(layers.bottom(turns) - layers.bottom(holds)) - params.thickness / 2,
            params.thickness,
            bore,
            sizes.wall,
            params.material,
            params.bushing > 0,
        )
        for name, (holds, turns, pin, bore, speed) in held.items()
    )


def bears(m: Mechanism) -> Any:
    """Which designs (n, 1) of a table certainly tear at no bore.

    Per crank radian the rod turns with at most ω = a / (c sin μ), and its rate changes by at most
    (a + c ω²) / (c sin μ). Where these leave it open, the rates over a period tell.
    """
    if not has_bounds(m):
        return False
    (_, travel), a, c, k = drives(m), m.given.crank, m.given.rod, m.given.acceleration_ratio
    lean, fastest = np.sin(least_of(m)), m.omega * np.maximum(1.0, np.exp(k * travel))
    driven = np.where(is_lever(m), (travel**2 / 4 + abs(travel) / 2) * m.omega**2, (1 + abs(k)) * fastest**2)
    first = a / (c * lean)
    omega, alpha = first**2 * driven, ((a / c + first**2) / lean + first) * driven
    sure = _holds(m, driven, omega, alpha, a * driven + c * (omega + alpha))
    if (left := some(m, ~sure)).size:
        rest = m.rows(left)
        chain = chain_of(rest)
        way, rod = chain.way(rest.closed.joints[-1]), chain.turning("rod")
        rows = [(row, 1) for row in (way + 2, rod + 2, rod + 3, chain.drive + 1, chain.drive + 2)]
        found = np.abs(chain.extremes(drives_of(rest), rows, TURN_SAMPLES)).max(axis=2)
        slid, turn, alpha, speed, gain = found.T[:, :, None]
        sure = np.array(sure)
        sure[left] = _holds(rest, speed**2 + gain, turn**2, alpha, slid)
    return sure


def _holds(m: Mechanism, driven: Any, omega: Any, alpha: Any, slid: Any) -> Any:
    """Whether no bore tears with such rates at most.

    ``driven`` is the square of the crank's speed and its change, ``omega`` the square of the rod's, rad²/s²;
    ``alpha`` of the rod, rad/s², and ``slid`` of the slider, mm/s², are accelerations. The force in the
    wrist pin has the component p along the slide, which moves the slider, and q across the rod, which turns
    the rod; both directions are as far from each other as the rod from the slide's normal.
    """
    given, sizes, a, c = m.given, m.dimensions, m.given.crank, m.given.rod
    slider, rod, crank = _most_masses(m)
    reach = c + sizes.rod_boss
    p = slider * slid + np.abs(given.load) / MILLI
    q = rod * reach * (reach * alpha + a * driven) / c
    force = (p + q) / np.sin(least_of(m)) + rod * (a * driven + reach * (alpha + omega)) + crank * a * driven
    limit = 2 * sizes.wall * given.thickness * material(given.material).strength
    return column(force * MILLI <= limit, m.size) > 0


def _most_masses(m: Mechanism) -> tuple[Any, Any, Any]:
    """What slider, rod and crank weigh at most, kg."""
    given, sizes = m.given, m.dimensions
    sheet = material(given.material).density * 1e-6 * given.thickness
    turned = material(PIN_MATERIAL).density * 1e-6 * math.pi / 4
    high = MOST_LAYERS * (given.thickness + given.gap)
    wide, tall = sizes.head
    pin = turned * (sizes.pin**2 * high + wide**2 * tall)
    disc = np.maximum(given.crank + sizes.pin_boss, sizes.shaft / 2 + sizes.wall)
    shaft = turned * sizes.shaft**2 * (high + TAIL_SHARE * sizes.shaft)
    bush = material(BUSHING_MATERIAL).density * 1e-6 * math.pi / 4 * sizes.rod_bore**2 * given.thickness
    return (
        sheet * sizes.slider_length * sizes.slider_width + pin,
        sheet * (2 * given.rod * sizes.rod_boss + math.pi * sizes.rod_boss**2) + 2 * bush,
        sheet * math.pi * disc**2 + shaft + pin,
    )
