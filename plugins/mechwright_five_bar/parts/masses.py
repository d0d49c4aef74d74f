"""Masses of tables of five-bars of one phase: of their parts, as they are drawn, and of their bodies.

Formulas are those of designs whose layers are sure (:mod:`mechwright_five_bar.rules.layers`): from below
gears, ground plate, crank and arm in one layer, rocker, coupler. That is the flattest order there is, and of
those as flat none has shorter spindles or comes before it. Parts of other designs are drawn.
"""

import math
from collections.abc import Callable, Mapping
from functools import cached_property, partial
from typing import Any

import numpy as np

from mechwright import Array
from mechwright.contracts.design_table import column
from mechwright.contracts.figure import Figure, PartMass
from mechwright.contracts.mass import KILOGRAMS
from mechwright.contracts.masses import OF_BODY, OF_PART, UNIT
from mechwright.contracts.masses import masses_of as drawn_masses
from mechwright.contracts.materials import material
from mechwright.mechanics.gearing.round_area import round_area
from mechwright.mechanics.linkage import BUSHING_MATERIAL, PIN_MATERIAL
from mechwright.mechanics.linkage.areas import circle_area, hull_area, rectangle_area, straight_area
from mechwright.mechanics.linkage.outlines import FILLET
from mechwright.mechanics.linkage.turned import HEAD, HEAD_HEIGHT, SHAFT
from mechwright_five_bar.defaults.teeth import ADDENDUM, DEDENDUM
from mechwright_five_bar.kinematics.train import PRESSURE_ANGLE, TIP_RADIUS
from mechwright_five_bar.parts.bodies import masses_of as body_masses_of
from mechwright_five_bar.parts.parts import BELOW, parts_of
from mechwright_five_bar.rules.layers import layers_are_sure
from mechwright_five_bar.rules.strength import tooth_loads
from mechwright_five_bar.table import FiveBarTable

GEARS, GROUND, LINKS, ROCKER, COUPLER = range(5)
"""Layers: crank and arm are in that of the links."""

POSTS = 4


def masses_of(m: FiveBarTable) -> dict[str, PartMass] | None:
    """Of the parts that there are; None of designs of several phases."""
    if m.params.phases:
        return None
    weights = Weights(m)
    found: dict[str, tuple[Callable[[], Any], Any]] = {name: (one, 1) for name, one in weights.parts.items()}
    if m.params.screw_hole is None:
        found["post"] = weights.post, POSTS
    for number in range(len(weights.bushings)):
        mass, copies = weights.bushing(number)
        found[f"bushing-{number + 1}" if number else "bushing"] = partial(np.asarray, mass), copies
    return {name: PartMass(partial(_mass, m, OF_PART + name, one[0]), one[1]) for name, one in found.items()}


def body_masses(m: FiveBarTable) -> dict[str, Figure]:
    """Of bodies with what is fixed in them; none of designs of several phases."""
    bodies = {} if m.params.phases else Weights(m).bodies
    return {
        OF_BODY + body: Figure(partial(_mass, m, OF_BODY + body, one), UNIT) for body, one in bodies.items()
    }


def _mass(m: FiveBarTable, name: str, formula: Callable[[], Any]) -> Array:
    """A mass (n, 1): by its formula, or as it is drawn."""
    drawn = m.once("drawn masses", lambda: _drawn(m))
    sure = column(layers_are_sure(m), m.size) > 0
    return np.where(sure, formula(), drawn.get(name, math.nan))


def _drawn(m: FiveBarTable) -> Mapping[str, Array]:
    """Masses (n, 1) of designs whose layers are not sure, by columns of a study; NaN of the others."""
    found: dict[str, Array] = {}
    for place in np.flatnonzero(column(layers_are_sure(m), m.size)[:, 0] == 0).tolist():
        one = m.row(place)
        own = drawn_masses(parts_of(one))
        own |= {OF_BODY + body: mass.mass for body, mass in body_masses_of(one).items()}
        for name, value in own.items():
            found.setdefault(name, np.full((m.size, 1), math.nan))[place] = value
    return found


class Weights:
    """Masses (n, 1) of designs that stand so, kg."""

    def __init__(self, m: FiveBarTable) -> None:
        self.m, self.params = m, m.params
        self.sheet = KILOGRAMS * material(m.params.material).density

    @cached_property
    def width(self) -> Any:
        """Of the gears, mm."""
        return tooth_loads(self.m)[0]

    @property
    def parts(self) -> dict[str, Callable[[], Any]]:
        """Those of which there is one."""
        idler = ["pin-idler"] if self.params.idler_teeth else []
        pins = ("shaft-a0", "shaft-b0", "pin-a", "pin-b1", "pin-c", *idler)
        return {
            "ground": self.ground,
            **{name: partial(self._plate, name) for name in ("crank", "arm", "rocker", "coupler")},
            **{name: partial(self._gear, name) for name in self.m.train.teeth},
            **{name: partial(self._pin, name) for name in pins},
        }

    @property
    def bodies(self) -> dict[str, Callable[[], Any]]:
        """Bodies with what is fixed in them."""
        thin, gap = (lambda: self._tube(self.params.thickness)), self.params.washer
        long = lambda: self._tube(self.params.thickness + gap)  # noqa: E731 - as its neighbours
        gear = lambda: self._tube(self.width + gap)  # noqa: E731
        members: dict[str, tuple[Callable[[], Any], ...]] = {
            "crank": self._all("crank", "pinion", "shaft-a0", "pin-a"),
            "coupler": (*self._all("coupler"), thin, long),
            "rocker": (*self._all("rocker", "pin-c"), long),
            "arm": self._all("arm", "wheel", "shaft-b0", "pin-b1"),
        }
        if self.params.idler_teeth:
            members["idler"] = (*self._all("idler"), gear)
        return {body: partial(_sum, some) for body, some in members.items()}

    def _all(self, *names: str) -> tuple[Callable[[], Any], ...]:
        return tuple(self.parts[name] for name in names)

    def _plate(self, name: str) -> Any:
        """Crank, arm, rocker or coupler."""
        params, bore, pin = self.params, self.m.bore, self.params.pin_diameter
        small, large = pin / 2 + params.rim, bore / 2 + params.rim
        if name == "coupler":
            places = [np.ravel(params.coupler_point), 0j, np.ravel(params.coupler)]
            area = hull_area(places, [np.ravel(small), np.ravel(large), np.ravel(large)], len(self.m))[
                :, None
            ]
            bores = circle_area(pin) + 2 * circle_area(bore)
        else:
            turns = name == "rocker"
            boss = large if turns else small
            area = straight_area(getattr(params, name), boss, small, params.web_width, FILLET)
            bores = circle_area(pin) + circle_area(bore if turns else pin)
        return self.sheet * params.thickness * (area - bores)

    def ground(self) -> Any:
        """The plate over all gears, with the holes of its shafts and posts."""
        params, train, corner = self.params, self.m.train, self._post_radius
        tips = {name: train.tip(name) for name in train.places}
        least = np.minimum.reduce(list(tips.values()))

        def span(part: str) -> Any:
            along = {name: np.real(at) if part == "x" else np.imag(at) for name, at in train.places.items()}
            ends = [(along[name] - tip, along[name] + tip) for name, tip in tips.items()]
            low, high = (np.broadcast_arrays(*some) for some in zip(*ends, strict=True))
            return np.maximum.reduce(high) - np.minimum.reduce(low)

        out = np.maximum(0.0, (least + corner + params.clearance) / math.sqrt(2) - least) + params.post_offset
        more = 2 * (out + corner)
        holes = 2 * circle_area(self.m.bore) + POSTS * circle_area(self._post_bore)
        if self.params.idler_teeth:
            holes = holes + circle_area(params.pin_diameter)
        plate = rectangle_area(span("x") + more, span("y") + more, corner) - holes
        return self.sheet * params.ground_thickness * plate

    @property
    def _post_bore(self) -> Any:
        hole = self.params.screw_hole
        return self.params.pin_diameter if hole is None else hole

    @property
    def _post_radius(self) -> Any:
        return np.maximum(self.params.pin_diameter, self._post_bore) / 2 + self.params.rim

    def _gear(self, name: str) -> Any:
        m, params = self.m.train.module, self.params
        rack = PRESSURE_ANGLE, ADDENDUM * m, DEDENDUM * m, TIP_RADIUS * m, params.backlash
        bore = self.m.bore if name == "idler" else params.pin_diameter
        area = round_area(m, self.m.train.teeth[name], *rack) - circle_area(bore)
        return self.sheet * self.width * area

    @cached_property
    def _levels(self) -> tuple[list[Any], list[Any]]:
        """Heights of the undersides and of the tops of all layers, mm."""
        params = self.params
        thick = [self.width, params.ground_thickness, *[params.thickness] * 3]
        low: list[Any] = [0.0]
        for one in thick[:-1]:
            low.append(low[-1] + one + params.washer)
        return low, [bottom + one for bottom, one in zip(low, thick, strict=True)]

    def _pin(self, name: str) -> Any:
        pin, (low, high) = self.params.pin_diameter, self._levels
        head = HEAD**2 * HEAD_HEIGHT * pin
        length = {
            "shaft-a0": lambda: high[LINKS] - low[GEARS] + SHAFT * pin,
            "shaft-b0": lambda: high[LINKS] - low[GEARS],
            "pin-a": lambda: high[COUPLER] - low[LINKS] + head,
            "pin-b1": lambda: high[ROCKER] - low[LINKS] + head,
            "pin-c": lambda: high[COUPLER] - low[ROCKER] + head,
            "pin-idler": lambda: high[GROUND] - low[GEARS] + head,
        }[name]()
        return KILOGRAMS * material(PIN_MATERIAL).density * circle_area(pin) * length

    def post(self) -> Any:
        """A foot with its pin."""
        params = self.params
        foot = self._levels[0][GROUND] + HEAD_HEIGHT * params.pin_diameter + BELOW
        foot = circle_area(2 * self._post_radius) * foot
        return self.sheet * (foot + circle_area(params.pin_diameter) * params.ground_thickness)

    def _tube(self, length: Any) -> Any:
        """A bushing; nothing where there are none."""
        params = self.params
        ring = circle_area(self.m.bore) - circle_area(params.pin_diameter + params.running_fit)
        brass = KILOGRAMS * material(BUSHING_MATERIAL).density
        return np.where(np.asarray(params.bushing_wall) > 0, brass * ring * length, 0.0)

    @cached_property
    def bushings(self) -> list[tuple[Any, int]]:
        """Lengths of the bushings and how many there are: of ground, B1 and C, A, idler.

        They reach to the next plate, but for that of A: between it and the crank is the rocker's layer.
        """
        params = self.params
        gap = params.washer
        found = [(params.ground_thickness + gap, 2), (params.thickness + gap, 2), (params.thickness, 1)]
        if params.idler_teeth:
            found.append((self.width + gap, 1))
        return found if np.any(np.asarray(params.bushing_wall) > 0) else []

    def bushing(self, wanted: int) -> tuple[Any, Any]:
        """The mass of the bushings that are one part, and how many there are.

        Those of one length are one part, and parts are numbered as lengths come up, from 0.
        """
        lengths = [column(length, self.m.size) for length, _ in self.bushings]
        number, mass = np.full((self.m.size, 1), -1), np.full((self.m.size, 1), math.nan)
        copies = np.zeros((self.m.size, 1))
        for place, (length, _) in enumerate(self.bushings):
            new = np.all([lengths[place] != other for other in lengths[:place]], axis=0)
            number = number + new
            own = new & (number == wanted) & (np.asarray(self.params.bushing_wall) > 0)
            same = sum(
                count * (lengths[place] == other)
                for other, (_, count) in zip(lengths, self.bushings, strict=True)
            )
            copies = np.where(own, same, copies)
            mass = np.where(own, self._tube(length), mass)
        return mass, copies


def _sum(members: tuple[Callable[[], Any], ...]) -> Any:
    return sum(one() for one in members)
