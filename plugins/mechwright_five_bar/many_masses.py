"""Masses of many five-bars of one phase: of their parts, as they are drawn, and of their bodies.

Designs are those that :func:`mechwright_five_bar.bounds.stands` is sure of: from below gears, ground plate,
crank and arm in one layer, rocker, coupler. That is the flattest order there is, and of those as flat none
has shorter spindles or comes before it.
"""

import math
from collections.abc import Collection
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from mechwright import Array
from mechwright.contracts.by_arrays import Answer, Designs
from mechwright.contracts.mass import KILOGRAMS
from mechwright.contracts.masses import OF_PART, TOTAL, is_mass
from mechwright.contracts.materials import material
from mechwright.mechanics.gearing.round_area import round_area
from mechwright.mechanics.linkage import BUSHING_MATERIAL, PIN_MATERIAL
from mechwright.mechanics.linkage.areas import circle_area, hull_area, rectangle_area, straight_area
from mechwright.mechanics.linkage.outlines import FILLET
from mechwright.mechanics.linkage.turned import HEAD, HEAD_HEIGHT, SHAFT
from mechwright_five_bar.bounds import Gears
from mechwright_five_bar.masses import MOVING
from mechwright_five_bar.plates import BELOW
from mechwright_five_bar.train import PRESSURE_ANGLE, TIP_RADIUS
from mechwright_five_bar.usual import ADDENDUM, DEDENDUM

GEARS, GROUND, LINKS, ROCKER, COUPLER = range(5)
"""Layers: crank and arm are in that of the links."""

POSTS = 4

BODIES = tuple(f"mass_{name}" for name in MOVING)


def give_masses(found: Answer, columns: Collection[str], designs: Designs, bore: Any) -> None:
    """Give the masses that are asked for of the designs that are open; ``bore`` is what a pin turns in."""
    asked = [name for name in columns if is_mass(name) or name in BODIES]
    left = found.left
    if not asked or not left.size:
        return
    weights = Weights(designs.some(left), np.broadcast_to(bore, found.size)[left])
    for name in asked:
        if (value := weights.told(name)) is not None:
            found.give(name, value, left)


@dataclass(frozen=True)
class Weights:
    """Masses (n,) of designs that stand so, kg; ``bore`` (n,) is what a pin turns in, mm."""

    designs: Designs
    bore: Array

    def told(self, column: str) -> Any:
        """A column; None of a part or body that no such design has."""
        value: Any = None
        if column == TOTAL:
            value = sum(copies * mass for mass, copies in self.parts.values())
            value = value + sum(copies * tube for _, copies, tube in self._bushings)
        elif column.startswith(f"{OF_PART}bushing"):
            value = self._bushing(column)
        elif is_mass(column):
            value = self.parts.get(column.removeprefix(OF_PART), (None,))[0]
        else:
            value = self.bodies.get(column)
        return None if value is None else np.broadcast_to(value, len(self.designs))

    @cached_property
    def parts(self) -> dict[str, tuple[Any, int]]:
        """Part to its mass, and how many there are; without bushings."""
        found = {name: (mass, 1) for name, mass in {**self._plates, **self._gears, **self._pins}.items()}
        if self.designs["screw_hole"] is None:
            found["post"] = self._post, POSTS
        return found

    @cached_property
    def bodies(self) -> dict[str, Any]:
        """Masses of bodies with what is fixed in them."""
        plates, pins, gears = self._plates, self._pins, self._gears
        thin = self._tube(self.designs["thickness"])
        found = {
            "mass_crank": plates["crank"] + gears["pinion"] + pins["shaft-a0"] + pins["pin-a"],
            "mass_arm": plates["arm"] + gears["wheel"] + pins["shaft-b0"] + pins["pin-b1"],
            "mass_rocker": plates["rocker"] + pins["pin-c"] + thin,
            "mass_coupler": plates["coupler"] + 2 * thin,
        }
        if "idler" in gears:
            found["mass_idler"] = gears["idler"] + self._tube(self.designs["gear_thickness"])
        return found

    @cached_property
    def _sheet(self) -> Any:
        """Density of the plates, kg/mm³."""
        names, which = np.unique(self.designs.full("material").astype(str), return_inverse=True)
        return KILOGRAMS * np.array([material(name).density for name in names.tolist()])[which]

    @cached_property
    def _train(self) -> Gears:
        return Gears.of(self.designs)

    @cached_property
    def _plates(self) -> dict[str, Any]:
        d, pin, bore = self.designs, self.designs["pin_diameter"], self.bore
        sheet, pressed = self._sheet * d["thickness"], circle_area(pin)
        small, large = pin / 2 + d["rim"], bore / 2 + d["rim"]

        def straight(length: Any, one: Any) -> Any:
            return straight_area(length, one, small, d["web_width"], FILLET)

        point = np.broadcast_to(d["coupler_point_x"] + 1j * d["coupler_point_y"], len(d))
        hull = hull_area([point, 0j, d["coupler"]], [small, large, large], len(d))
        return {
            "ground": self._sheet * d["ground_thickness"] * self._ground,
            "crank": sheet * (straight(d["crank"], small) - 2 * pressed),
            "arm": sheet * (straight(d["arm"], small) - 2 * pressed),
            "rocker": sheet * (straight(d["rocker"], large) - pressed - circle_area(bore)),
            "coupler": sheet * (hull - pressed - 2 * circle_area(bore)),
        }

    @cached_property
    def _ground(self) -> Any:
        """Area of the plate over all gears, with the holes of its shafts and posts."""
        d, train = self.designs, self._train
        tips = {name: train.tip(name) for name in train.places}
        ends = [(at - tips[name], at + tips[name]) for name, at in train.places.items()]
        long = np.maximum.reduce([high for _, high in ends]) - np.minimum.reduce([low for low, _ in ends])
        wide, least = 2 * np.maximum.reduce(list(tips.values())), np.minimum.reduce(list(tips.values()))
        corner = self._post_radius
        out = np.maximum(0.0, (least + corner + d["clearance"]) / math.sqrt(2) - least) + d["post_offset"]
        more = 2 * (out + corner)
        holes = 2 * circle_area(self.bore) + POSTS * circle_area(self._post_bore)
        if "idler" in train.places:
            holes = holes + circle_area(d["pin_diameter"])
        return rectangle_area(long + more, wide + more, corner) - holes

    @property
    def _post_bore(self) -> Any:
        hole = self.designs["screw_hole"]
        return self.designs["pin_diameter"] if hole is None else hole

    @property
    def _post_radius(self) -> Any:
        return np.maximum(self.designs["pin_diameter"], self._post_bore) / 2 + self.designs["rim"]

    @cached_property
    def _gears(self) -> dict[str, Any]:
        m, d = self._train.module, self.designs
        rack = PRESSURE_ANGLE, ADDENDUM * m, DEDENDUM * m, TIP_RADIUS * m, d["backlash"]
        bores = {"pinion": d["pin_diameter"], "wheel": d["pin_diameter"], "idler": self.bore}
        return {
            name: self._sheet * d["gear_thickness"] * (round_area(m, teeth, *rack) - circle_area(bores[name]))
            for name, teeth in self._train.teeth.items()
        }

    @cached_property
    def _levels(self) -> tuple[list[Any], list[Any]]:
        """Heights of the undersides and of the tops of all layers, mm."""
        d = self.designs
        thick = [d["gear_thickness"], d["ground_thickness"], *[d["thickness"]] * 3]
        low: list[Any] = [0.0]
        for one in thick[:-1]:
            low.append(low[-1] + one + d["washer"])
        return low, [bottom + one for bottom, one in zip(low, thick, strict=True)]

    @cached_property
    def _pins(self) -> dict[str, Any]:
        pin, steel = self.designs["pin_diameter"], KILOGRAMS * material(PIN_MATERIAL).density
        (low, high), across = self._levels, circle_area(pin)
        head = circle_area(HEAD * pin) * HEAD_HEIGHT * pin
        found = {
            "shaft-a0": across * (high[LINKS] - low[GEARS] + SHAFT * pin),
            "shaft-b0": across * (high[LINKS] - low[GEARS]),
            "pin-a": across * (high[COUPLER] - low[LINKS]) + head,
            "pin-b1": across * (high[ROCKER] - low[LINKS]) + head,
            "pin-c": across * (high[COUPLER] - low[ROCKER]) + head,
        }
        if "idler" in self._train.places:
            found["pin-idler"] = across * (high[GROUND] - low[GEARS]) + head
        return {name: steel * volume for name, volume in found.items()}

    @cached_property
    def _post(self) -> Any:
        d = self.designs
        foot = self._levels[0][GROUND] + HEAD_HEIGHT * d["pin_diameter"] + BELOW
        foot = circle_area(2 * self._post_radius) * foot
        return self._sheet * (foot + circle_area(d["pin_diameter"]) * d["ground_thickness"])

    def _tube(self, length: Any) -> Any:
        """A bushing; nothing where there are none."""
        d = self.designs
        ring = circle_area(self.bore) - circle_area(d["pin_diameter"] + d["running_fit"])
        brass = KILOGRAMS * material(BUSHING_MATERIAL).density
        return np.where(np.asarray(d["bushing_wall"]) > 0, brass * ring * length, 0.0)

    @property
    def _bushings(self) -> list[tuple[Any, int, Any]]:
        """Length of the bushings of ground, links and idler, how many there are, and the mass of one."""
        d = self.designs
        lengths: list[tuple[str, int]] = [("ground_thickness", 2), ("thickness", 3)]
        if "idler" in self._train.places:
            lengths.append(("gear_thickness", 1))
        return [(d.full(name), count, self._tube(d[name])) for name, count in lengths]

    def _bushing(self, column: str) -> Any:
        """Those of one length are one part; parts are numbered as lengths come up."""
        wanted = int(column.rpartition("-")[2]) - 1 if "-" in column else 0
        value = np.full(len(self.designs), np.nan)
        number, before = np.full(len(self.designs), -1), list[Any]()
        for length, _, mass in self._bushings:
            new = np.all([length != other for other in before], axis=0) if before else True
            number = number + new
            value = np.where(new & (number == wanted) & (mass > 0), mass, value)
            before.append(length)
        return value
