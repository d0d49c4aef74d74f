"""What the joints carry over a period, and which designs of a table certainly bear it.

Of a table bounds of masses and forces tell: a pin is at most as long as all layers are high, with its head; a
disc, a rod and a slider are taken without their bores.
"""

import math
from typing import Any

import numpy as np

from mechwright import Array
from mechwright.contracts.design_table import column
from mechwright.contracts.materials import material
from mechwright.mechanics.linkage import BUSHING_MATERIAL, PIN_MATERIAL
from mechwright.mechanics.planar.dynamics import Forces
from mechwright.mechanics.strength.turning_pair import TurningPair
from mechwright_slider_crank.kinematics.course import period_of
from mechwright_slider_crank.kinematics.forces import MILLI, joint_forces
from mechwright_slider_crank.kinematics.mechanism import Mechanism
from mechwright_slider_crank.kinematics.period_kernels import bars_of, circle_of, drives_of, most_force
from mechwright_slider_crank.kinematics.slider_crank import Bodies
from mechwright_slider_crank.parts.base import TAIL_SHARE
from mechwright_slider_crank.parts.layers import has_bounds
from mechwright_slider_crank.parts.masses import bodies_of
from mechwright_slider_crank.parts.plates import TURN_SAMPLES, layout_of

MOST_LAYERS = 4
"""Base, crank, rod, and slider with its rails."""

_CIRCLE = circle_of(TURN_SAMPLES)


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
    """Which designs (n, 1) of a table certainly tear at no bore."""
    if not has_bounds(m):
        return False
    limit = 2 * m.dimensions.wall * m.given.thickness * material(m.given.material).strength
    force = most_force(bars_of(m), drives_of(m), _inertias(m), _CIRCLE) * MILLI
    return force[:, None] <= limit


def _inertias(m: Mechanism) -> Array:
    """Bounds (n, 6) as :func:`most_force` wants them."""
    given, sizes = m.given, m.dimensions
    a, c = given.crank, given.rod
    sheet = material(given.material).density * 1e-6 * given.thickness
    turned = material(PIN_MATERIAL).density * 1e-6 * math.pi / 4
    high = MOST_LAYERS * (given.thickness + given.gap)
    wide, tall = sizes.head
    pin = turned * (sizes.pin**2 * high + wide**2 * tall)
    disc = np.maximum(a + sizes.pin_boss, sizes.shaft / 2 + sizes.wall)
    shaft = turned * sizes.shaft**2 * (high + TAIL_SHARE * sizes.shaft)
    bush = material(BUSHING_MATERIAL).density * 1e-6 * math.pi / 4 * sizes.rod_bore**2 * given.thickness
    parts = [
        sheet * sizes.slider_length * sizes.slider_width + pin,
        sheet * (2 * c * sizes.rod_boss + math.pi * sizes.rod_boss**2) + 2 * bush,
        c + sizes.rod_boss,
        sheet * math.pi * disc**2 + shaft + pin,
        a,
        np.abs(given.load) / MILLI,
    ]
    return np.concatenate([column(part, m.size) for part in parts], axis=1)
