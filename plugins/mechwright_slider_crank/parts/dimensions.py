"""Sizes of the plates that a design leaves open, and those that follow from others; numbers or columns."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from mechwright.contracts.design_table import Rowwise, number
from mechwright.mechanics.strength.allowed import PIN_BENDING
from mechwright_slider_crank.parameters import SliderCrankParams

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


@dataclass(frozen=True)
class Dimensions(Rowwise):
    """All sizes of a design, mm; widths and diameters, not halves."""

    pin: Any
    shaft: Any
    wall: Any
    bushing: Any
    slider_length: Any
    slider_width: Any
    rail: Any
    overhang: Any

    @property
    def dowel(self) -> Any:
        """Diameter of the rails' dowels: whole millimetres, as they are sold, but for the thinnest."""
        return dowel_of(self.pin)

    @property
    def rod_bore(self) -> Any:
        """Bore of the rod's ends: the outside of their bushings."""
        return self.pin + 2 * self.bushing

    @property
    def base_bore(self) -> Any:
        """Bore of the base: the outside of the shaft's bushing."""
        return self.shaft + 2 * self.bushing

    @property
    def rod_boss(self) -> Any:
        """Radius of the rod's bosses."""
        return self.rod_bore / 2 + self.wall

    @property
    def pin_boss(self) -> Any:
        """Radius of material around a pin that is pressed in."""
        return self.pin / 2 + self.wall

    @property
    def spacer(self) -> Any:
        """Radius of the spacers under rails that stand high."""
        return number(np.minimum(self.dowel / 2 + self.wall, self.rail / 2))

    @property
    def head(self) -> tuple[Any, Any]:
        """Diameter and height of a pin's head."""
        return HEAD_SHARE * self.pin, HEAD_HEIGHT_SHARE * self.pin


def dowel_of(pin: Any) -> Any:
    """Diameter of the dowels beside a pin.

    >>> dowel_of(6.0), dowel_of(1.5)
    (4.0, 1.5)
    """
    return number(np.maximum(LEAST_DOWEL, np.rint(DOWEL_SHARE * pin)))


def corner_of(half_length: Any, half_width: Any) -> Any:
    """Corner radius of a plate, smaller on what is small."""
    return number(np.minimum(CORNER, 0.4 * np.minimum(half_length, half_width)))


def dimensions_of(params: SliderCrankParams) -> Dimensions:
    """The sizes, with those that the designs leave open."""

    def given(name: str, default: Any) -> Any:
        value = getattr(params, name)
        return number(default if value is None else value)

    least, most = PIN_RANGE
    crank, shaft = params.crank, params.shaft
    common = np.minimum(np.maximum(least, np.rint(PIN_SHARE * crank)), most)
    for fine in FINE_PINS:
        beside = SHAFT_SHARE * common if shaft is None else shaft
        common = np.minimum(common, np.where(crank - (common + beside) / 2 < LEAST_WEB, fine, most))
    pin = given("pin", np.maximum(common, _bearing(params, most)))
    wall = given("wall", np.maximum(LEAST_WALL, WALL_SHARE * pin))
    width = given("slider_width", pin + 4 * wall)
    rail = given("rail", dowel_of(pin) + 2 * wall)
    return Dimensions(
        pin,
        given("shaft", SHAFT_SHARE * pin),
        wall,
        params.bushing,
        given("slider_length", 1.5 * width),
        width,
        rail,
        given("rail_overhang", rail),
    )


def _bearing(params: SliderCrankParams, most: float) -> Any:
    """The pin that bears the load, whole mm, as far as crank and shaft leave it room; 0 without a load.

    It is bent between the middles of crank and rod, which are side by side, and presses on the rod's bore.
    """
    crank, load, thickness, shaft = params.crank, params.load, params.thickness, params.shaft
    sine = np.minimum((crank + np.abs(params.offset)) / params.rod, _STEEPEST)
    force = np.abs(load) / np.sqrt(1 - sine * sine)
    arm = thickness / 2 + params.gap
    bent = np.cbrt(32 * force * arm / (math.pi * PIN_BENDING))
    room = 2 * (crank - LEAST_WEB)
    room = room / (1 + SHAFT_SHARE) if shaft is None else room - shaft
    found = np.minimum(np.ceil(np.maximum(bent, force / (MAX_PRESSURE * thickness))), np.floor(room))
    return np.where(np.asarray(load) == 0, 0.0, np.minimum(found, most))


def clear_overhang(dimensions: Dimensions, crank: Any, way: tuple[Any, Any], clearance: Any) -> Any:
    """How far rails go on, mm, whose dowels stand outside of all that crank and rod sweep about the pivot.

    ``way`` are the slider's positions at the ends of its stroke, the lower one first.
    """
    (low, high), own = way, dimensions
    swept = np.maximum(crank + np.maximum(own.pin_boss, own.rod_boss), own.shaft / 2 + own.wall)
    dowel = abs(low + high) / 2 + swept + own.spacer + clearance + SPARE
    needed = dowel + own.rail / 2 - (high - low + own.slider_length) / 2
    return number(np.maximum(own.rail, np.rint(needed + 0.5)))
