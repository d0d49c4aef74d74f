"""Masses of many slider-cranks: of their parts, as they are drawn, and of their bodies, pins and bushings in.

Outlines are lines and arcs; how long spindles are follows from the layers that :mod:`.dealing` finds.
"""

from collections.abc import Callable, Collection
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from mechwright import Array
from mechwright.contracts.by_arrays import Answer, Designs
from mechwright.contracts.mass import KILOGRAMS, mass_moments
from mechwright.contracts.masses import OF_PART, TOTAL, is_mass
from mechwright.contracts.materials import material
from mechwright.mechanics.linkage import BUSHING_MATERIAL, PIN_MATERIAL
from mechwright.mechanics.linkage.areas import circle_area, rectangle_area, two_discs_area
from mechwright.standards.dowels import dowels
from mechwright.standards.parts import dowel_part
from mechwright_slider_crank.base import TAIL_SHARE
from mechwright_slider_crank.dealing import DOWELS, Dealt, dealt
from mechwright_slider_crank.many import Cranks
from mechwright_slider_crank.rooms import Rooms
from mechwright_slider_crank.sizes import CORNER, Sizes, corner_of

BODIES = ("mass_crank", "mass_rod", "mass_slider")
BALANCES = (
    "balance_rod_x", "balance_rod_y", "balance_crank_x", "balance_crank_y", "balance_rod_weight",
)  # fmt: skip


def give_masses(
    found: Answer, columns: Collection[str], designs: Designs, many: Cranks, rooms: Rooms
) -> None:
    """Give the masses that are asked for, and the balance, of the designs that are open."""
    asked = [name for name in columns if is_mass(name) or name in BODIES + BALANCES]
    left = found.left
    if not asked or not left.size:
        return
    chosen, cranks = designs.some(left), many.some(left)
    stand = dealt(chosen, cranks, rooms.some(left))
    weights = Weights(chosen, cranks, stand)
    for name in asked:
        if (value := weights.told(name)) is not None:
            found.give(name, value, left)


@dataclass(frozen=True)
class Weights:
    """Masses (n,) of designs that stand so, kg."""

    designs: Designs
    many: Cranks
    stand: Dealt

    def told(self, column: str) -> Array | None:
        """A column; None of a part that no such design has."""
        if column == TOTAL:
            value: Any = sum(copies * np.nan_to_num(make()) for make, copies in self._parts.values())
        elif is_mass(column):
            part = column.removeprefix(OF_PART)
            value = self._parts[part][0]() if part in self._parts else None
        else:
            value = self._bodies[column]()
        return None if value is None else np.broadcast_to(value, len(self.designs))

    @property
    def _parts(self) -> dict[str, tuple[Callable[[], Any], int]]:
        """Part to how it is weighed, and how many there are; NaN where a design has none."""
        found: dict[str, tuple[Callable[[], Any], int]] = {
            "base": (lambda: self._base, 1), "rail": (lambda: self._rail, 2),
            "crank": (lambda: self._crank, 1), "rod": (lambda: self._rod, 1),
            "slider": (lambda: self._slider, 1), "shaft": (lambda: self._shaft, 1),
            "crank-pin": (lambda: self._pin(self.stand.crank), 1),
            "wrist-pin": (lambda: self._pin(self.stand.slider), 1),
            "dowel": (lambda: self._dowel, DOWELS), "spacer": (lambda: self._spacer, DOWELS),
            "bushing": (lambda: self._bushing, 2), "shaft-bushing": (lambda: self._shaft_bushing, 1),
        }  # fmt: skip
        return found

    @property
    def _bodies(self) -> dict[str, Callable[[], Any]]:
        return {
            "mass_crank": lambda: self.crank[0],
            "mass_rod": lambda: self.rod[0],
            "mass_slider": lambda: self.slider,
            "balance_rod_x": lambda: self._on_rod,
            "balance_rod_y": lambda: 0.0,
            "balance_crank_x": lambda: self._on_crank,
            "balance_crank_y": lambda: 0.0,
            "balance_rod_weight": lambda: np.abs(self._on_rod) / self.many.bars[:, 0],
        }

    @property
    def crank(self) -> tuple[Any, Any]:
        """Mass of the crank with its shaft and pin, kg, and mass times place, kg mm; of the shaft none."""
        sizes, arm = self._sizes, self.many.bars[:, 0]
        pin, bore = self._pin(self.stand.crank), self._sheet * circle_area(sizes.pin)
        return self._crank + self._shaft + pin, (pin - bore) * arm

    @property
    def rod(self) -> tuple[Any, Any]:
        """Mass of the rod with its bushings, and mass times place; its middle is its centre."""
        mass = self._rod + 2 * np.nan_to_num(self._bushing)
        return mass, mass * self.many.bars[:, 1] / 2

    @property
    def slider(self) -> Any:
        """Mass of the slider with its pin, whose axis is its centre."""
        return self._slider + self._pin(self.stand.slider)

    @property
    def _on_rod(self) -> Any:
        return -self.slider * self.many.bars[:, 1] - self.rod[1]

    @property
    def _on_crank(self) -> Any:
        arm = self.many.bars[:, 0]
        carried = self.rod[0] + np.abs(self._on_rod) / arm + self.slider
        return -carried * arm - self.crank[1]

    @property
    def _sizes(self) -> Sizes:
        return self.stand.sizes

    @cached_property
    def _sheet(self) -> Any:
        """Mass of a plate for each area, kg/mm²."""
        return self._density * self.designs["thickness"]

    @cached_property
    def _density(self) -> Any:
        """Of the plates, kg/mm³."""
        names, which = np.unique(self.designs.full("material").astype(str), return_inverse=True)
        found = np.array([material(name).density for name in names.tolist()])[which]
        return KILOGRAMS * found

    @cached_property
    def _high(self) -> Any:
        """From a layer to the next one, mm."""
        return self.designs["thickness"] + self.designs["gap"]

    @cached_property
    def _crank(self) -> Any:
        sizes = self._sizes
        radius = np.maximum(self.many.bars[:, 0] + sizes.pin_boss, sizes.shaft / 2 + sizes.wall)
        return self._sheet * (circle_area(2 * radius) - circle_area(sizes.shaft) - circle_area(sizes.pin))

    @cached_property
    def _rod(self) -> Any:
        boss = self._sizes.rod_boss
        hull = two_discs_area(self.many.bars[:, 1], boss, boss)
        return self._sheet * (hull - 2 * circle_area(self._sizes.rod_bore))

    @cached_property
    def _slider(self) -> Any:
        long, wide = self._sizes.slider_length, self._sizes.slider_width
        area = rectangle_area(long, wide, corner_of(long / 2, wide / 2))
        return self._sheet * (area - circle_area(self._sizes.pin))

    @cached_property
    def _way(self) -> tuple[Array, Array]:
        """Ends (n,) of the slider's way, the lower one first, mm."""
        ends = self.many.ends
        low, high = np.sort(np.stack([ends.near_position, ends.far_position]), axis=0)
        return low, high

    @cached_property
    def _half(self) -> Any:
        """Half a rail's length, mm."""
        low, high = self._way
        return (high - low + self._sizes.slider_length) / 2 + self._sizes.overhang

    @cached_property
    def _rail(self) -> Any:
        wide = self._sizes.rail
        area = rectangle_area(2 * self._half, wide, corner_of(self._half, wide / 2))
        return self._sheet * (area - 2 * circle_area(self._sizes.dowel))

    @cached_property
    def _base(self) -> Any:
        """A rectangle about the shaft's bore with its wall, and the rails."""
        sizes, offset = self._sizes, self.many.bars[:, 2]
        reach, middle = sizes.base_bore / 2 + sizes.wall, sum(self._way) / 2
        apart = sizes.slider_width / 2 + self.designs["play"] + sizes.rail
        long = np.maximum(reach, middle + self._half) - np.minimum(-reach, middle - self._half)
        wide = np.maximum(reach, offset + apart) - np.minimum(-reach, offset - apart)
        bores = circle_area(sizes.base_bore) + DOWELS * circle_area(sizes.dowel)
        return self._sheet * (rectangle_area(long, wide, CORNER) - bores)

    @cached_property
    def _steel(self) -> float:
        return KILOGRAMS * material(PIN_MATERIAL).density

    @cached_property
    def _shaft(self) -> Any:
        size = self._sizes.shaft
        length = self.stand.crank * self._high + self.designs["thickness"] + TAIL_SHARE * size
        return self._steel * circle_area(size) * length

    def _pin(self, layer: Any) -> Any:
        """A pin in the rod and a plate in a layer; a gap longer and with a head where the rod is on top."""
        sizes, (wide, tall) = self._sizes, self._sizes.head
        length = np.abs(self.stand.rod - layer) * self._high + self.designs["thickness"]
        head = self.stand.heads & (self.stand.rod > layer)
        more = circle_area(sizes.pin) * self.designs["gap"] + circle_area(wide) * tall
        return self._steel * (circle_area(sizes.pin) * length + np.where(head, more, 0.0))

    @cached_property
    def _dowel(self) -> Any:
        """Bought where one of its length is sold, with its chamfers."""
        size = np.broadcast_to(self._sizes.dowel, len(self.designs)).astype(float)
        lies = np.where(
            self.stand.slider == 1, self.designs["gap"], 0.0
        )  # rails of the first layer on the base
        length = np.round(self.stand.slider * self._high + self.designs["thickness"] - lies, 6)
        found = np.array(self._steel * circle_area(size) * length)
        sold = {float(one) for each in dowels() for name in _STANDARDS for one in each.lengths(name)}
        for long in sold & set(np.unique(length).tolist()):
            for wide in np.unique(size[length == long]).tolist():
                part = dowel_part("dowel", wide, long, ())
                found[(length == long) & (size == wide)] = mass_moments(part)[3, 3]
        return found

    @cached_property
    def _spacer(self) -> Any:
        """Under rails that stand above the first layer."""
        sizes, layer = self._sizes, self.stand.slider
        length = (layer - 1) * self._high + self.designs["gap"]
        ring = circle_area(2 * sizes.spacer) - circle_area(sizes.dowel)
        return np.where(layer > 1, self._density * ring * length, np.nan)

    @cached_property
    def _bushing(self) -> Any:
        return self._tube(self._sizes.pin, self._sizes.rod_bore)

    @cached_property
    def _shaft_bushing(self) -> Any:
        return self._tube(self._sizes.shaft, self._sizes.base_bore)

    def _tube(self, inside: Any, outside: Any) -> Any:
        ring = (circle_area(outside) - circle_area(inside)) * self.designs["thickness"]
        brass = KILOGRAMS * material(BUSHING_MATERIAL).density
        return np.where(np.asarray(self.designs["bushing"]) > 0, brass * ring, np.nan)


_STANDARDS: tuple[Any, ...] = ("ISO 8734", "ISO 2338")
