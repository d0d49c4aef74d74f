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
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

from mechwright import GeometryError, kept
from mechwright.geometry import Loop
from mechwright.mechanics.gearing import Rack, Round, RoundPair, Teeth, gear_loop, lever_fit
from mechwright.mechanics.gearing.shaper import involute
from mechwright_five_bar.params import FiveBarParams
from mechwright_five_bar.usual import ADDENDUM, DEDENDUM, IN_LINE, modules

PRESSURE_ANGLE = math.radians(20)
TIP_RADIUS = 0.38
"""Basic rack of ISO 53, profile A, in modules."""

TIP = 0.1
"""Least width of a tooth at its tip, in modules: a sharper one breaks."""


@dataclass(frozen=True)
class Train:
    """Lengths in mm; places x + i y in the ground's frame: origin A0, x to B0.

    Parameters
    ----------
    module
        Of all gears.
    teeth
        Of each gear, by name.
    places
        Its axis, by name, from the pinion to the wheel.
    """

    module: float
    teeth: dict[str, int]
    places: dict[str, complex]

    def radius(self, name: str) -> float:
        """Of the pitch circle."""
        return self.module * self.teeth[name] / 2

    def tip(self, name: str) -> float:
        """Of the tip circle."""
        return self.radius(name) + ADDENDUM * self.module

    def root(self, name: str) -> float:
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


@kept
def train_of(params: FiveBarParams) -> Train:
    """The gears of a design.

    Raises
    ------
    GeometryError
        They do not fill the ground, or two that shall not mesh do; the message names the parameter.
    """
    ground = params.ground
    least, most = modules(ground, params.crank_teeth, params.idler_teeth, params.arm_teeth)
    module = least if params.module is None else params.module
    if not params.idler_teeth:
        if abs(module - least) > IN_LINE * ground:
            raise GeometryError(
                f"module: without an idler the gears fill the ground of {ground:g} mm with a module of "
                f"{least:g} mm, not {module:g}; leave module out, or give an idler"
            )
        teeth = {"pinion": params.crank_teeth, "wheel": params.arm_teeth}
        return _with_tips(Train(module, teeth, {"pinion": 0j, "wheel": complex(ground)}), params.backlash)
    teeth = {"pinion": params.crank_teeth, "idler": params.idler_teeth, "wheel": params.arm_teeth}
    if module < least * (1 - IN_LINE):
        raise GeometryError(
            f"module: gears of {module:g} mm do not reach over the ground of {ground:g} mm; their module "
            f"is at least {least:.6g} mm"
        )
    if module > most:
        raise GeometryError(
            f"module: with {module:.6g} mm the gears of crank and arm meet, which turn the same way; it is "
            f"at most {most:.6g} mm, or give the idler more teeth"
        )
    one, two = (module * (params.idler_teeth + z) / 2 for z in (params.crank_teeth, params.arm_teeth))
    x = (ground**2 + one**2 - two**2) / (2 * ground)
    aside = math.sqrt(max(0.0, one**2 - x**2)) if params.module is not None else 0.0
    places = {"pinion": 0j, "idler": complex(x, -aside), "wheel": complex(ground)}
    return _with_tips(Train(module, teeth, places), params.backlash)


def _with_tips(train: Train, backlash: float) -> Train:
    """Gears whose teeth have tips: with much backlash both flanks would meet below the tip circle.

    A tooth of an involute gear is d_a (s/d + inv α - inv α_a) wide at its tip circle d_a, with its width s at
    the pitch circle d, and cos α_a = d cos α / d_a.
    """
    m = train.module
    for name in train.teeth:
        pitch, tip = 2 * train.radius(name), 2 * train.tip(name)
        narrower = involute(math.acos(pitch * math.cos(PRESSURE_ANGLE) / tip)) - involute(PRESSURE_ANGLE)
        most = math.pi * m - 2 * pitch * (TIP * m / tip + narrower)
        if backlash > most:
            raise GeometryError(
                f"backlash: {backlash:g} mm take the tips of the {name}'s teeth, of a module of {m:.4g} mm; "
                f"use at most {math.floor(1000 * most) / 1000:g} mm"
            )
    return train


def rack_of(params: FiveBarParams) -> Rack:
    """The rack that makes all gears."""
    m = train_of(params).module
    return Rack(m, PRESSURE_ANGLE, ADDENDUM * m, DEDENDUM * m, TIP_RADIUS * m, params.backlash)


@kept
def gear_outlines(params: FiveBarParams) -> dict[str, Loop]:
    """The toothed outside of each gear, in its frame."""
    train, rack = train_of(params), rack_of(params)
    fit = lever_fit(min(map(train.radius, train.teeth)) * math.cos(PRESSURE_ANGLE))
    return {name: _outside(train.radius(name), rack, count, fit) for name, count in train.teeth.items()}


@lru_cache(32)
def _outside(radius: float, rack: Rack, count: int, fit: float) -> Loop:
    return gear_loop(Teeth(Round(radius), rack, count, 0.0, fit=fit))[0]
