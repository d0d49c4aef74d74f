"""The gears between crank and arm: sizes, where their axes stand, and how their teeth meet.

A gear's frame has a tooth on its x axis. With the pitch point in the direction α from a gear at θ1, its mate
has a space there where θ2 = α + π - π/z2 + (α - θ1) z1/z2.

Glossary
--------
pinion, idler, wheel
    On the crank's shaft, on a pin of the ground, on the arm's shaft.
"""

import cmath
import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from typing import Any

import numpy as np

from mechwright import kept
from mechwright.contracts.design_table import Rowwise, number
from mechwright.geometry import Loop
from mechwright.mechanics.gearing import Rack, Round, RoundPair, Teeth, gear_loop, lever_fit
from mechwright.mechanics.gearing.shaper import involute
from mechwright_five_bar.defaults.teeth import ADDENDUM, DEDENDUM, modules
from mechwright_five_bar.parameters import FiveBarParams

PRESSURE_ANGLE = math.radians(20)
TIP_RADIUS = 0.38
"""Basic rack of ISO 53, profile A, in modules."""

TIP = 0.1
"""Least width of a tooth at its tip, in modules: a sharper one breaks."""


@dataclass(frozen=True)
class Train(Rowwise):
    """Lengths in mm, or columns (n, 1) of them; places x + i y in the ground's frame: origin A0, x to B0.

    Parameters
    ----------
    module
        Of all gears.
    teeth
        Of each gear, by name.
    places
        Its axis, by name, from the pinion to the wheel.
    """

    module: Any
    teeth: Mapping[str, int]
    places: Mapping[str, Any]

    def radius(self, name: str) -> Any:
        """Of the pitch circle."""
        return self.module * self.teeth[name] / 2

    def tip(self, name: str) -> Any:
        """Of the tip circle."""
        return self.radius(name) + ADDENDUM * self.module

    def root(self, name: str) -> Any:
        """Of the root circle."""
        return self.radius(name) - DEDENDUM * self.module

    def meshes(self) -> list[tuple[str, str]]:
        """Pairs that mesh, the driver first."""
        names = list(self.places)
        return list(pairwise(names))

    def angles(self, crank: float) -> dict[str, float]:
        """Angles of all gears from the ground's x axis with the crank at an angle from it, rad."""
        found = {"pinion": crank}
        for one, two in self.meshes():
            towards = cmath.phase(self.places[two] - self.places[one])
            turn = (towards - found[one]) * self.teeth[one] / self.teeth[two]
            found[two] = towards + math.pi - math.pi / self.teeth[two] + turn
        return found

    def ratio(self, name: str) -> float:
        """Turns of a gear per turn of the crank."""
        sign = -1 if list(self.places).index(name) % 2 else 1
        return sign * self.teeth["pinion"] / self.teeth[name]

    def pair(self, one: str, two: str) -> RoundPair:
        """Two gears that mesh, for the proof of their teeth."""
        return RoundPair.of(self.radius(one), self.radius(two), math.pi - math.pi / self.teeth[two])


def train_of(params: FiveBarParams) -> Train:
    """The gears of a design whose numbers of teeth and module go together, or of designs.

    Without a module they stand in line and fill the ground; an idler of a module that is larger stands aside.
    """
    ground = params.ground
    module = modules_of(params)[0] if params.module is None else params.module
    if not params.idler_teeth:
        teeth = {"pinion": params.crank_teeth, "wheel": params.arm_teeth}
        return Train(module, teeth, {"pinion": 0j, "wheel": ground + 0j})
    teeth = {"pinion": params.crank_teeth, "idler": params.idler_teeth, "wheel": params.arm_teeth}
    one, two = (module * (params.idler_teeth + z) / 2 for z in (params.crank_teeth, params.arm_teeth))
    x = (ground**2 + one**2 - two**2) / (2 * ground)
    idler = np.array(x, dtype=complex)
    idler.imag = -0.0 if params.module is None else -np.sqrt(np.maximum(0.0, one**2 - x**2))
    return Train(module, teeth, {"pinion": 0j, "idler": number(idler), "wheel": ground + 0j})


def modules_of(params: FiveBarParams) -> tuple[Any, Any]:
    """Between which modules the gears of a design reach over the ground, and stand clear, mm."""
    return modules(params.ground, params.crank_teeth, params.idler_teeth, params.arm_teeth)


def greatest_backlash(train: Train, name: str) -> Any:
    """Backlash that leaves the teeth of a gear their tips, mm: with more both flanks meet below the tips.

    A tooth of an involute gear is d_a (s/d + inv α - inv α_a) wide at its tip circle d_a, with its width s at
    the pitch circle d, and cos α_a = d cos α / d_a.
    """
    m, teeth = train.module, train.teeth[name]
    shares = teeth, teeth + 2 * ADDENDUM  # both diameters in modules
    narrower = involute(math.acos(shares[0] * math.cos(PRESSURE_ANGLE) / shares[1])) - involute(
        PRESSURE_ANGLE
    )
    return m * (math.pi - 2 * shares[0] * (TIP / shares[1] + narrower))


def rack_of(params: FiveBarParams) -> Rack:
    """The rack that makes all gears."""
    m = train_of(params).module
    return Rack(m, PRESSURE_ANGLE, ADDENDUM * m, DEDENDUM * m, TIP_RADIUS * m, params.backlash)


@kept
def gear_teeth(params: FiveBarParams) -> dict[str, Teeth]:
    """The teeth of each gear, in its frame."""
    train, rack = train_of(params), rack_of(params)
    fit = lever_fit(min(map(train.radius, train.teeth)) * math.cos(PRESSURE_ANGLE))
    return {name: _teeth(train.radius(name), rack, count, fit) for name, count in train.teeth.items()}


@lru_cache(32)
def _teeth(radius: float, rack: Rack, count: int, fit: float) -> Teeth:
    return Teeth(Round(radius), rack, count, 0.0, fit=fit)


@kept
def gear_outlines(params: FiveBarParams) -> dict[str, Loop]:
    """The toothed outside of each gear, in its frame."""
    return {name: _outside(teeth) for name, teeth in gear_teeth(params).items()}


@lru_cache(32)
def _outside(teeth: Teeth) -> Loop:
    return gear_loop(teeth)[0]
