"""Which of many five-bars certainly have layers that keep their plates apart, and teeth that bear.

With crank and arm in one layer, the rocker above them and the coupler on top, all is apart if

* crank and arm, seen as discs about their shafts, do not reach each other;
* pin A stays clear of the rocker, and the head of pin B1 of the coupler: with μ the transmission angle, A is
  c sin μ off the line from B1 to C, and B1 is l sin μ off the line from A to C.

Between two samples of the motion a plate moves on; half of that is added, as where it is measured. What a
bound leaves open is checked by itself.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright import Array
from mechwright.contracts.by_arrays import Designs
from mechwright.contracts.materials import material
from mechwright.mechanics.linkage import BUSHING_MATERIAL, PIN_MATERIAL
from mechwright.mechanics.linkage.stacking import STACK_SAMPLES
from mechwright.mechanics.linkage.turned import HEAD, HEAD_HEIGHT
from mechwright.mechanics.strength.allowed import ROOT_SAFETY, allowed
from mechwright.mechanics.strength.tooth_bending import root_stress
from mechwright_five_bar.masses import MILLI
from mechwright_five_bar.reach import bar_of
from mechwright_five_bar.usual import ADDENDUM, DEDENDUM

APART = 0.2
"""mm. What is called clear in plan besides the clearance: chords of the outlines that are compared."""

BEND = 1.1
"""A path between two samples over its chord, at most; as where plates are compared."""

FINE_PLAY = 0.2
"""Backlash in modules up to which teeth of the usual rack keep lands."""

LENGTHS = ("crank", "coupler", "rocker", "arm", "ground")

LINKS_HIGH, GAPS = 4, 6
"""Plates of links above each other, with one to spare, and gaps between layers."""


@dataclass(frozen=True)
class Bars:
    """Dimensions (n,) of many five-bars, mm and rad, as those of :class:`FiveBar`, gears alike."""

    crank: Array
    coupler: Array
    rocker: Array
    arm: Array
    ground: Array
    ground_angle: Array
    offset: Array
    branch: Array
    ratio: float
    turns: int

    @classmethod
    def of(cls, designs: Designs) -> "Bars":
        """Of designs whose gears have the same teeth."""
        one = bar_of(designs.common)
        crank, coupler, rocker, arm, ground = (designs.full(name) for name in LENGTHS)
        turned, offset = (np.radians(designs.full(name)) for name in ("ground_angle", "arm_angle"))
        branch = np.where(designs.full("branch") == "open", 1.0, -1.0)
        return cls(crank, coupler, rocker, arm, ground, turned, offset, branch, one.ratio, one.turns)

    @property
    def rows(self) -> Array:
        """(n, 8), for the kernels."""
        parts = (self.crank, self.coupler, self.rocker, self.arm, self.ground, self.ground_angle)
        return np.stack([*parts, self.offset, self.branch], axis=1).astype(float)


@dataclass(frozen=True)
class Gears:
    """Those of designs without a module of their own: their axes stand in line and they fill the ground.

    Module and places (n,), mm; places are how far along the ground an axis stands, from the crank's on.
    """

    module: Array
    teeth: dict[str, int]
    places: dict[str, Array]

    @classmethod
    def of(cls, designs: Designs) -> "Gears":
        """As :func:`mechwright_five_bar.train.train_of` sets them."""
        one, ground = designs.common, designs.full("ground")
        first, idler, last = one.crank_teeth, one.idler_teeth, one.arm_teeth
        module = 2 * ground / (first + 2 * idler + last)
        if not idler:
            return cls(module, {"pinion": first, "wheel": last}, {"pinion": 0 * ground, "wheel": ground})
        return cls(
            module,
            {"pinion": first, "idler": idler, "wheel": last},
            {"pinion": 0 * ground, "idler": module * (idler + first) / 2, "wheel": ground},
        )

    def radius(self, name: str) -> Array:
        """Of the pitch circle."""
        return self.module * self.teeth[name] / 2

    def tip(self, name: str) -> Array:
        """Of the tip circle."""
        return self.radius(name) + ADDENDUM * self.module

    def root(self, name: str) -> Array:
        """Of the root circle."""
        return self.radius(name) - DEDENDUM * self.module


def stands(designs: Designs, bars: Bars, gears: Gears, bore: Any, sine: Array) -> NDArray[np.bool_]:
    """Which designs (n,) certainly have a layout; ``sine`` (n,) is that of the least transmission angle.

    ``bore`` is the diameter of what a pin turns in, mm.
    """
    pin, rim, limit = designs["pin_diameter"], designs["rim"], designs["clearance"] + APART
    step = math.tau * bars.turns / (STACK_SAMPLES * bars.turns - 1)
    half = bore / 2 + rim
    reach = np.hypot(designs["coupler_point_x"], designs["coupler_point_y"])
    way, turning = _ways(bars), _turning(bars, sine)
    a, b, spread = bars.crank, bars.arm, np.maximum(bars.coupler, reach) + half

    def slack(*moved: Array) -> Array:
        return BEND * step * np.asarray(sum(moved)) / 2

    crank, arm = a + half, np.abs(bars.ratio) * (b + half)
    rocker = way[1] + turning[1] * (bars.rocker + half)
    coupler = way[0] + turning[0] * spread
    sure = bars.ground - a - b - 2 * half > limit + slack(crank, arm)
    sure &= bars.coupler * sine - half > limit + pin / 2 + slack(rocker, a)
    beside = -np.sign(bars.branch) * designs["coupler_point_y"]
    sure &= bars.rocker * sine - half - np.maximum(beside, 0) > limit + HEAD * pin / 2 + slack(
        coupler, way[1]
    )
    return np.asarray(sure & _gears_stand(designs, gears, bore, lambda name: slack(gears.tip(name))))


def _gears_stand(designs: Designs, gears: Gears, bore: Any, slack: Any) -> NDArray[np.bool_]:
    """Whether gears leave walls about their bores, and clear the shafts of others."""
    pin, rim, limit = designs["pin_diameter"], designs["rim"], designs["clearance"] + APART
    sure = designs.full("backlash") <= FINE_PLAY * gears.module
    for name, at in gears.places.items():
        sure &= gears.root(name) - bore / 2 >= rim
        for other, there in gears.places.items():
            if other != name:
                away = np.abs(at - there)
                sure &= away - gears.tip(name) > limit + pin / 2 + slack(name)
                sure &= away >= bore + rim
    if "idler" in gears.places:
        tips = gears.tip("pinion") + gears.tip("wheel")
        sure &= designs["ground"] - tips > limit + slack("pinion") + slack("wheel")
    return np.asarray(sure)


def teeth_bear(
    designs: Designs,
    bars: Bars,
    gears: Gears,
    bore: Any,
    sine: Array,
    omega: Array,
    share: float = ROOT_SAFETY,
) -> NDArray[np.bool_]:
    """Whether no tooth (n,) breaks at its root, by bounds of masses and accelerations.

    ``omega`` is the crank's speed (n,), rad/s, and ``share`` how much of what roots are allowed may be used:
    by default up to where they break.
    """
    (m3, e3, j3), (m4, e4, j4), reach = *_inertias(designs, bars, bore), _reach(designs)
    way, (w, v) = _ways(bars), _turning(bars, sine)
    a, b, c, l = bars.crank, bars.arm, bars.coupler, bars.rocker
    bend = (a + bars.ratio**2 * b + c * w * w + l * v * v) / sine
    at_a, at_b = a * omega**2, way[1] * abs(bars.ratio) * omega**2
    alpha_c, alpha_r = bend / c * omega**2, bend / l * omega**2
    load = np.hypot(designs.full("load_x"), designs.full("load_y")) / MILLI
    across = (j3 * alpha_c + m3 * e3 * at_a + load * reach) / c + (j4 * alpha_r + m4 * e4 * at_b) / l
    in_b1 = across / sine + m4 * (at_b + e4 * (alpha_r + (v * omega) ** 2))
    force = b * in_b1 * MILLI / gears.radius("wheel")
    face: Any = designs["gear_thickness"]
    module: Any = gears.module
    breaks = designs.figures("material", lambda name: share * allowed(name).root)
    sure = np.ones(len(designs), bool)
    for teeth in gears.teeth.values():
        sure &= root_stress(force, face, module, float(teeth)) <= breaks
    return sure


def _ways(bars: Bars) -> tuple[Array, Array]:
    """By how much A and B1 move with the crank's angle, mm/rad."""
    return bars.crank, np.asarray(np.abs(bars.ratio) * bars.arm)


def _turning(bars: Bars, sine: Array) -> tuple[Array, Array]:
    """What coupler and rocker turn at most with the crank."""
    one, two = _ways(bars)
    most = (one + two) / sine
    return np.asarray(most / bars.coupler), np.asarray(most / bars.rocker)


def _reach(designs: Designs) -> Array:
    return np.asarray(np.hypot(designs.full("coupler_point_x"), designs.full("coupler_point_y")))


def _inertias(designs: Designs, bars: Bars, bore: Any) -> list[tuple[Array, Array, Array]]:
    """Of coupler and rocker, or more: mass, kg, farthest place, mm, and moment about A or B1, kg mm²."""
    pin, thickness, half = designs["pin_diameter"], designs["thickness"], bore / 2 + designs["rim"]
    high = designs["gear_thickness"] + designs["ground_thickness"]
    high = high + LINKS_HIGH * thickness + GAPS * designs["washer"]
    heavy = material(PIN_MATERIAL).density * 1e-6 * math.pi / 4
    pinned = heavy * (pin**2 * high + (HEAD * pin) ** 2 * HEAD_HEIGHT * pin)
    bush = material(BUSHING_MATERIAL).density * 1e-6 * math.pi / 4 * bore**2 * thickness
    sheet = designs.figures("material", lambda name: material(name).density) * 1e-6 * thickness
    x, y, c = designs["coupler_point_x"], designs["coupler_point_y"], bars.coupler
    away, there = np.hypot(x, y), np.hypot(x - c, y)
    area = c * np.abs(y) / 2 + (c + away + there) * half + math.pi * half**2
    found = []
    for far, plate, more in (
        (np.maximum(c, away) + half, area, 2 * bush),
        (bars.rocker + half, 2 * bars.rocker * half + math.pi * half**2, pinned + 2 * bush),
    ):
        mass = sheet * plate + more
        found.append((mass, far, mass * far**2))
    return found
