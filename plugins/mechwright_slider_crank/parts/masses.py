"""Masses of bodies with their pins and bushings, and of the parts of a table of designs, as they are drawn.

How long spindles are follows from the layers that :mod:`.layers` finds.
"""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from mechwright.contracts.design_table import column
from mechwright.contracts.figure import PartMass
from mechwright.contracts.mass import KILOGRAMS, mass_moments
from mechwright.contracts.materials import material
from mechwright.mechanics.linkage import (
    BUSHING_MATERIAL,
    PIN_MATERIAL,
    Mass,
    cylinder_mass,
    plate_mass,
    together,
)
from mechwright.mechanics.linkage.areas import circle_area, rectangle_area, two_discs_area
from mechwright.standards.dowels import dowels
from mechwright.standards.parts import dowel_part
from mechwright_slider_crank.kinematics.course import ends_of
from mechwright_slider_crank.kinematics.mechanism import Mechanism
from mechwright_slider_crank.parts.base import shaft_masses
from mechwright_slider_crank.parts.dimensions import CORNER, corner_of
from mechwright_slider_crank.parts.layers import DOWELS, has_bounds, layers_of
from mechwright_slider_crank.parts.plates import layout_of, lies_on_base
from mechwright_slider_crank.parts.rail_screws import dowel_span


def bodies_of(table: Mechanism) -> dict[str, Mass]:
    """Crank, rod and slider, each with the pins and bushings that are fixed in it.

    The moments of inertia of a table's plates are left out; nothing that is computed of a table needs them.
    """
    return table.unloaded.once("bodies", partial(_bodies, table)) if table.single else _bodies(table)


def _bodies(table: Mechanism) -> dict[str, Mass]:
    parts, own, crank = Weights(table), table.dimensions, table.given.crank
    bushings = [
        cylinder_mass(own.rod_bore, parts.bushing_length(end), BUSHING_MATERIAL, x + 0j, own.pin)
        for end, x in (("crank", 0.0), ("slider", table.given.rod))
    ]
    return {
        "crank": together([parts.plate("crank"), *parts.shaft(), *parts.pin("crank", crank + 0j)]),
        "rod": together([parts.plate("rod"), *bushings]),
        "slider": together([parts.plate("slider"), *parts.pin("slider", 0j)]),
    }


def masses_of(table: Mechanism) -> dict[str, PartMass] | None:
    """Masses of the parts of a table; None where its plates have other shapes than those of the formulas."""
    return Weights(table).parts if has_bounds(table) else None


class Weights:
    """Masses of the parts of designs that have layers."""

    def __init__(self, table: Mechanism) -> None:
        self.table, self.given, self.stand = table, table.given, layers_of(table)
        self.own = self.stand.sizes
        self.high = self.given.thickness + self.given.gap
        self.low, self.far = ends_of(table).way
        self.half = (self.far - self.low + self.own.slider_length) / 2 + self.own.overhang

    @property
    def parts(self) -> dict[str, PartMass]:
        """Part to its mass; NaN where a design has none."""
        own, steel = self.own, partial(_total, self.shaft)
        one, two = (self.bushing_length(end) for end in ("crank", "slider"))
        alike = np.isclose(one, two)
        found: dict[str, tuple[Callable[[], Any], Any]] = {
            **{name: (partial(self._plate, name), 1) for name in ("base", "crank", "rod", "slider")},
            "rail": (partial(self._plate, "rail"), 2),
            "shaft": (steel, 1),
            "crank-pin": (partial(_total, partial(self.pin, "crank", 0j)), 1),
            "wrist-pin": (partial(_total, partial(self.pin, "slider", 0j)), 1),
            "dowel": (self._dowel, DOWELS),
            "spacer": (self._spacer, DOWELS),
            "bushing": (partial(self._tube, own.pin, own.rod_bore, one), 1 + np.asarray(alike)),
            "bushing-2": (lambda: np.where(alike, np.nan, self._tube(own.pin, own.rod_bore, two)), 1),
            "shaft-bushing": (partial(self._tube, own.shaft, own.base_bore, self._base_bushing), 1),
        }
        return {name: PartMass(value, copies) for name, (value, copies) in found.items()}

    def plate(self, name: str) -> Mass:
        """Crank, rod or slider."""
        if self.table.single:
            outline = layout_of(self.table).outlines[name]
            return plate_mass(outline, self.given.thickness, self.given.material)
        mass, own = self._plate(name), self.own
        if name == "rod":
            return Mass(mass, self.given.rod / 2 + 0j)
        # A disc about the shaft lacks the bore of its pin.
        lacking = self._sheet(circle_area(own.pin)) if name == "crank" else 0.0
        return Mass(mass, -lacking * self.given.crank / mass + 0j)

    def shaft(self) -> list[Mass]:
        """The crank's shaft, and the ring on it."""
        return shaft_masses(self.table, self.stand.crank * self.high + self.given.thickness)

    def pin(self, name: str, centre: complex) -> list[Mass]:
        """The pin of rod and crank or slider: a gap longer and with a head where the rod is on top of it."""
        layer, rod, pin = getattr(self.stand, name), self.stand.rod, self.own.pin
        head: Any = np.asarray(self.stand.heads) & np.asarray(rod > layer)
        length = np.abs(rod - layer) * self.high + self.given.thickness + head * self.given.gap
        wide, tall = self.own.head
        return [
            cylinder_mass(pin, length, PIN_MATERIAL, centre),
            cylinder_mass(wide, head * tall, PIN_MATERIAL, centre),
        ]

    def _plate(self, name: str) -> Any:
        return self._sheet(getattr(self, f"_{name}")())

    def _sheet(self, area: Any) -> Any:
        return KILOGRAMS * material(self.given.material).density * self.given.thickness * area

    def _crank(self) -> Any:
        own = self.own
        radius = np.maximum(self.given.crank + own.pin_boss, own.shaft / 2 + own.wall)
        return circle_area(2 * radius) - circle_area(own.shaft) - circle_area(own.pin)

    def _rod(self) -> Any:
        boss = self.own.rod_boss
        return two_discs_area(self.given.rod, boss, boss) - 2 * circle_area(self.own.rod_bore)

    def _slider(self) -> Any:
        long, wide = self.own.slider_length, self.own.slider_width
        return rectangle_area(long, wide, corner_of(long / 2, wide / 2)) - circle_area(self.own.pin)

    def _rail(self) -> Any:
        wide = self.own.rail
        area = rectangle_area(2 * self.half, wide, corner_of(self.half, wide / 2))
        return area - 2 * circle_area(self.own.dowel)

    def _base(self) -> Any:
        """A rectangle about the shaft's bore with its wall, and the rails."""
        own, offset = self.own, self.given.offset
        reach, middle = own.base_bore / 2 + own.wall, (self.low + self.far) / 2
        apart = own.slider_width / 2 + self.given.play + own.rail
        long = np.maximum(reach, middle + self.half) - np.minimum(-reach, middle - self.half)
        wide = np.maximum(reach, offset + apart) - np.minimum(-reach, offset - apart)
        bores = circle_area(own.base_bore) + DOWELS * circle_area(own.dowel)
        return rectangle_area(long, wide, CORNER) - bores

    def _dowel(self) -> Any:
        """Bought where one of its length is sold, with its chamfers."""
        size = column(self.own.dowel, self.table.size)
        # Rails of the first layer lie on the base.
        lies = np.where(self.stand.slider == 1, self.given.gap, 0.0)
        length = self.stand.slider * self.high + self.given.thickness - lies
        length = column(np.round(length, 6), self.table.size)
        thick = column(self.given.thickness, self.table.size)
        spans = zip(size.ravel(), length.ravel(), thick.ravel(), strict=True)
        length = np.array([dowel_span(*map(float, one))[1] for one in spans], dtype=float).reshape(-1, 1)
        found = KILOGRAMS * material(PIN_MATERIAL).density * circle_area(size) * length
        standards: tuple[Any, ...] = ("ISO 8734", "ISO 2338")
        sold = {float(one) for each in dowels() for name in standards for one in each.lengths(name)}
        for long in sold & set(np.unique(length).tolist()):
            for wide in np.unique(size[length == long]).tolist():
                part = dowel_part("dowel", wide, long, ())
                found[(length == long) & (size == wide)] = mass_moments(part)[3, 3]
        return found

    def _spacer(self) -> Any:
        """Under rails that stand above the first layer."""
        layer, density = self.stand.slider, KILOGRAMS * material(self.given.material).density
        length = (layer - 1) * self.high + self.given.gap
        ring = circle_area(2 * self.own.spacer) - circle_area(self.own.dowel)
        return np.where(layer > 1, density * ring * length, np.nan)

    def bushing_length(self, end: str) -> Any:
        """Of the rod's bushing at crank or slider, mm: it reaches to the plate next to it."""
        near = np.abs(self.stand.rod - getattr(self.stand, end)) == 1
        more = self.given.gap * (1 + lies_on_base(end, self.stand.slider) * (self.stand.rod > 1))
        return self.given.thickness + np.where(near, more, 0.0)

    @property
    def _base_bushing(self) -> Any:
        return self.given.thickness + np.where(self.stand.crank == 1, self.given.gap, 0.0)

    def _tube(self, inside: Any, outside: Any, length: Any) -> Any:
        ring = (circle_area(outside) - circle_area(inside)) * length
        brass = KILOGRAMS * material(BUSHING_MATERIAL).density
        return np.where(np.asarray(self.given.bushing) > 0, brass * ring, np.nan)


def _total(masses: Callable[[], list[Mass]]) -> Any:
    return sum(one.mass for one in masses())
