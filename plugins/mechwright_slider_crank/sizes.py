"""Sizes of the plates that a design leaves open, and those that follow from others."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from mechwright.mechanics.strength.allowed import PIN_BENDING
from mechwright_slider_crank.params import SliderCrankParams

PIN_SHARE = 0.125
"""Pin diameter over crank: slender enough that slider and rails keep out of the crank's way."""
PIN_RANGE = (2.0, 20.0)
"""mm: the smallest and the largest dowel pin that is easy to get."""
FINE_PINS = (1.5, 1.0)
"""mm: dowel pins of cranks that are too short for the smallest usual one."""
LEAST_WEB = 1.0
"""mm between two bores, or a bore and the rim: thinner webs spread when a pin is pressed in."""
SHAFT_SHARE = 1.5
"""Shaft diameter over pin diameter: the shaft is twisted as well as bent."""
WALL_SHARE = 0.5
"""Wall around a bore over the pin's diameter: the least for pressed joints in aluminium."""
DOWEL_SHARE = 0.6
"""Diameter of the rails' dowels over that of the joint pins: there are four, and they hardly move."""
SPARE = 0.2
"""mm by which dowels stand farther out than they need to: curves are judged as polygons."""
LEAST_WALL = 2.0
"""mm, so that the wall of a small bore survives clamping."""
LEAST_DOWEL = 1.5
"""mm, the thinnest dowel whose hole a usual drill or end mill makes."""
MAX_PRESSURE = 20.0
"""Pressure of a pin on the plate it turns in, MPa: usual for greased bronze at low speed."""
_STEEPEST = 0.95
"""Sine of the rod's angle beyond which a pin is not sized for it: there the slider jams."""
CORNER = 2.0
"""Corner radius of slider, rails and base, mm: sharp enough to look square, blunt enough to handle."""
HEAD_SHARE = 1.6
"""Head diameter over pin diameter, as of clevis pins (ISO 2341)."""
HEAD_HEIGHT_SHARE = 0.3
"""Head height over pin diameter, as of clevis pins."""


@dataclass(frozen=True, slots=True)
class Sizes:
    """All sizes of a design, mm; widths and diameters, not halves."""

    pin: float
    shaft: float
    wall: float
    bushing: float
    slider_length: float
    slider_width: float
    rail: float
    overhang: float

    @property
    def dowel(self) -> float:
        """Diameter of the rails' dowels: whole millimetres, as they are sold, but for the thinnest."""
        found: float = dowel_of(self.pin)
        return found

    @property
    def rod_bore(self) -> float:
        """Bore of the rod's ends: the outside of their bushings."""
        return self.pin + 2 * self.bushing

    @property
    def base_bore(self) -> float:
        """Bore of the base: the outside of the shaft's bushing."""
        return self.shaft + 2 * self.bushing

    @property
    def rod_boss(self) -> float:
        """Radius of the rod's bosses."""
        return self.rod_bore / 2 + self.wall

    @property
    def pin_boss(self) -> float:
        """Radius of material around a pin that is pressed in."""
        return self.pin / 2 + self.wall

    @property
    def spacer(self) -> float:
        """Radius of the spacers under rails that stand high."""
        found: float = _smaller(self.dowel / 2 + self.wall, self.rail / 2)
        return found

    @property
    def head(self) -> tuple[float, float]:
        """Diameter and height of a pin's head."""
        return HEAD_SHARE * self.pin, HEAD_HEIGHT_SHARE * self.pin


def dowel_of(pin: Any) -> Any:
    """Diameter of the dowels beside a pin.

    >>> dowel_of(6.0), dowel_of(1.5)
    (4.0, 1.5)
    """
    return _larger(LEAST_DOWEL, 1.0 * _whole(DOWEL_SHARE * pin))


def _whole(value: Any) -> Any:
    return np.rint(value) if isinstance(value, np.ndarray) else round(value)


def _where(which: Any, one: float, two: float) -> Any:
    return np.where(which, one, two) if isinstance(which, np.ndarray) else one if which else two


def _larger(one: Any, two: Any) -> Any:
    arrays = isinstance(one, np.ndarray) or isinstance(two, np.ndarray)
    return np.maximum(one, two) if arrays else max(one, two)


def _smaller(one: Any, two: Any) -> Any:
    arrays = isinstance(one, np.ndarray) or isinstance(two, np.ndarray)
    return np.minimum(one, two) if arrays else min(one, two)


def corner_of(half_length: Any, half_width: Any) -> Any:
    """Corner radius of a plate, smaller on what is small."""
    return _smaller(CORNER, 0.4 * _smaller(half_length, half_width))


def sizes_of(params: SliderCrankParams) -> Sizes:
    """The sizes, those left out filled in."""
    return filled_in(partial(getattr, params))


def filled_in(table: Callable[[str], Any]) -> Sizes:
    """The same from parameters by their names, which may be arrays over many designs."""

    def given(name: str, default: Any) -> Any:
        value = table(name)
        return default if value is None else value

    least, most = PIN_RANGE
    crank, shaft = table("crank"), table("shaft")
    usual = _smaller(_larger(least, _whole(PIN_SHARE * crank)), most)
    for fine in FINE_PINS:
        beside = SHAFT_SHARE * usual if shaft is None else shaft
        usual = _smaller(usual, _where(crank - (usual + beside) / 2 < LEAST_WEB, fine, most))
    usual = _larger(usual, _bearing(table, most))
    pin = given("pin", usual)
    wall = given("wall", _larger(LEAST_WALL, WALL_SHARE * pin))
    width = given("slider_width", pin + 4 * wall)
    rail = given("rail", dowel_of(pin) + 2 * wall)
    return Sizes(
        pin,
        given("shaft", SHAFT_SHARE * pin),
        wall,
        table("bushing"),
        given("slider_length", 1.5 * width),
        width,
        rail,
        given("rail_overhang", rail),
    )


def _bearing(table: Callable[[str], Any], most: float) -> Any:
    """The pin that bears the load, whole mm, as far as crank and shaft leave it room; 0 without a load.

    It is bent between the middles of crank and rod, which are side by side, and presses on the rod's bore.
    """
    crank, load, thickness, shaft = (table(name) for name in ("crank", "load", "thickness", "shaft"))
    sine = np.minimum((crank + np.abs(table("offset"))) / table("rod"), _STEEPEST)
    force = np.abs(load) / np.sqrt(1 - sine * sine)
    arm = thickness / 2 + table("gap")
    bent = np.cbrt(32 * force * arm / (math.pi * PIN_BENDING))
    room = 2 * (crank - LEAST_WEB)
    room = room / (1 + SHAFT_SHARE) if shaft is None else room - shaft
    found = np.minimum(np.ceil(np.maximum(bent, force / (MAX_PRESSURE * thickness))), np.floor(room))
    found = np.where(np.asarray(load) == 0, 0.0, np.minimum(found, most))
    return found if found.ndim else float(found)


def clear_overhang(sizes: Sizes, crank: Any, ends: tuple[Any, Any], clearance: Any) -> Any:
    """How far rails go on, mm, whose dowels stand outside of all that crank and rod sweep about the pivot.

    ``ends`` are the slider's positions at the ends of its stroke, the lower one first.
    """
    low, high = ends
    swept = _larger(crank + _larger(sizes.pin_boss, sizes.rod_boss), sizes.shaft / 2 + sizes.wall)
    dowel = abs(low + high) / 2 + swept + sizes.spacer + clearance + SPARE
    needed = dowel + sizes.rail / 2 - (high - low + sizes.slider_length) / 2
    return _larger(sizes.rail, 1.0 * _whole(needed + 0.5))
