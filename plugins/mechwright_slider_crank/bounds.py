"""Which of many slider-cranks certainly bear their loads, by bounds of masses and forces.

A pin is at most as long as all layers are high, with its head; a disc, a rod and a slider are taken without
their bores. What a bound leaves open is checked by itself.
"""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright import Array
from mechwright.contracts.by_arrays import Designs
from mechwright.contracts.materials import material
from mechwright.mechanics.linkage import BUSHING_MATERIAL, PIN_MATERIAL
from mechwright_slider_crank.base import TAIL_SHARE
from mechwright_slider_crank.forces import MILLI
from mechwright_slider_crank.many import Cranks
from mechwright_slider_crank.period_kernels import circle_of, most_force
from mechwright_slider_crank.plates import TURN_SAMPLES
from mechwright_slider_crank.sizes import Sizes

MOST_LAYERS = 4
"""Base, crank, rod, and slider with its rails."""

_CIRCLE = circle_of(TURN_SAMPLES)


def bears(designs: Designs, many: Cranks, sizes: Sizes) -> NDArray[np.bool_]:
    """Which designs (n,) certainly tear at no bore."""
    limit = (
        2
        * sizes.wall
        * designs["thickness"]
        * designs.figures("material", lambda name: material(name).strength)
    )
    force = most_force(many.bars, many.drives, _inertias(designs, many, sizes), _CIRCLE) * MILLI
    return np.asarray(force <= limit)


def _inertias(designs: Designs, many: Cranks, sizes: Sizes) -> Array:
    """Bounds (n, 6) as :func:`most_force` wants them."""
    a, c = many.bars[:, 0], many.bars[:, 1]
    thickness, gap = designs["thickness"], designs["gap"]
    sheet = designs.figures("material", lambda name: material(name).density) * 1e-6 * thickness
    turned = material(PIN_MATERIAL).density * 1e-6 * math.pi / 4
    high = MOST_LAYERS * (thickness + gap)

    def pin(diameter: Any) -> Any:
        wide, tall = sizes.head
        return turned * (diameter**2 * high + wide**2 * tall)

    disc = np.maximum(a + sizes.pin_boss, sizes.shaft / 2 + sizes.wall)
    shaft = turned * sizes.shaft**2 * (high + TAIL_SHARE * sizes.shaft)
    bush = material(BUSHING_MATERIAL).density * 1e-6 * math.pi / 4 * sizes.rod_bore**2 * thickness
    parts = [
        sheet * sizes.slider_length * sizes.slider_width + pin(sizes.pin),
        sheet * (2 * c * sizes.rod_boss + math.pi * sizes.rod_boss**2) + 2 * bush,
        c + sizes.rod_boss,
        sheet * math.pi * disc**2 + shaft + pin(sizes.pin),
        a,
        np.abs(designs["load"]) / MILLI,
    ]
    return np.stack([np.broadcast_to(part, len(designs)) for part in parts], axis=1).astype(float)
