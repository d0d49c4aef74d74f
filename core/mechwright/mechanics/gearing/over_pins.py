"""Pins in the tooth spaces of a gear, round or not: what a finished gear is measured by.

A pin of diameter D that touches both flanks of a space has its centre C on both flanks' parallels,

    C(s) = P(s) + (D/2)(sin α n - σ cos α t),

P being the flank point that the pitch point at arc s makes, whose normal passes through the pitch point
(:mod:`mechwright.mechanics.gearing.rack`); dC/ds = (sin²α + η/ρ + D sin α/(2ρ)) (t + σ cot α n). The two arcs
follow from C of both flanks by Newton's method.

On a round gear with z teeth of the thickness t on the pitch circle of radius r the centre is r cos α/cos φ
from the axis, with inv φ = inv α + D/(2 r cos α) + t/(2 r) - π/z.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.mechanics.gearing.rack import SIDES
from mechwright.mechanics.gearing.teeth import Teeth

LEAST, STEP = 1.68, 0.25
"""Least diameter of pins in modules, and the step of gauge pins, mm."""

FINE, FINE_STEP = 1.0, 0.05
"""Below this diameter, mm, gauge pins are finer stepped, by so much."""

STEPS, ARRIVED = 30, 1e-13
"""Newton's method, and its step over the module at which it has arrived."""

SINGULAR, CLOSED = 1e-12, 1e-9
"""Determinant of flanks that are parallel; distance of both centres over the module where they are one."""


def gauge_pin(module: float) -> float:
    """The diameter, mm, of the pins to measure a gear of a module with: they stand out over the tips.

    >>> gauge_pin(2.0), gauge_pin(1.5), gauge_pin(0.5)
    (3.5, 2.75, 0.85)
    """
    least = LEAST * module
    step = STEP if least > FINE else FINE_STEP
    return round(math.ceil(least / step - 1e-9) * step, 9)


@dataclass(frozen=True)
class Pins:
    """Pins in all spaces of a gear.

    Parameters
    ----------
    diameter
        mm.
    centres
        (z, 2) in the body frame of the gear, mm; NaN of a space without a place for the pin.
    heights
        (z, 2) of the points of contact over the pitch curve, mm.
    inside
        Whether they stand in a ring.
    """

    diameter: float
    centres: Array
    heights: Array
    inside: bool = False

    @property
    def outside(self) -> Array:
        """From the axis to the far side of each pin (z,), mm; in a ring to its near side."""
        radius: Array = np.linalg.norm(self.centres, axis=1)
        return radius + (-0.5 if self.inside else 0.5) * self.diameter

    def over(self, one: int, two: int) -> float:
        """Over two pins, mm; in a ring between them."""
        apart = float(np.hypot(*(self.centres[one] - self.centres[two])))
        return apart - self.diameter if self.inside else apart + self.diameter

    def opposite(self, middle: tuple[float, float] = (0.0, 0.0)) -> NDArray[np.intp]:
        """The space (z,) whose pin is nearest to opposite of each pin, as seen from a middle."""
        seen = self.centres - np.array(middle)
        angle = np.arctan2(seen[:, 1], seen[:, 0])
        off = np.abs((angle[None, :] - angle[:, None]) % math.tau - math.pi)
        return np.asarray(np.where(np.isfinite(off), off, np.inf).argmin(axis=1))


def pins_in(teeth: Teeth, diameter: float, *, inside: bool = False) -> Pins:
    """The pins of a diameter, mm, in all spaces of a gear; ``inside``: of a ring, between which one measures.

    A pin that would touch a flank beyond its ends, above the tip or in the fillet, has no place.
    """
    curve, rack, start = teeth.curve, teeth.rack, teeth.flank_arcs
    sin, cos = math.sin(rack.pressure_angle), math.cos(rack.pressure_angle)

    def centre(arc: Array) -> tuple[Array, Array, Array]:
        """Centres (z, 2, 2), their derivatives, and heights (z, 2) of the contacts."""
        frame = curve.frame_at(arc)
        u = arc - start
        height = SIDES * u * sin * cos
        out = sin * frame.normal - (SIDES * cos)[:, None] * frame.tangent
        place = frame.point - (u * cos * cos)[..., None] * frame.tangent + height[..., None] * frame.normal
        rate = sin * sin + (height + diameter / 2 * sin) / frame.radius
        way = frame.tangent + (SIDES * cos / sin)[:, None] * frame.normal
        return place + diameter / 2 * out, rate[..., None] * way, height

    # Where the pin touches a rack: both flanks are planes.
    depth = (diameter / (2 * cos) - teeth.half_space) * cos / sin
    arc = start + SIDES * (depth - diameter / 2 * sin) / (sin * cos)
    with np.errstate(all="ignore"):
        for _ in range(STEPS):
            place, rate, height = centre(arc)
            off = place[:, 0] - place[:, 1]
            matrix = np.stack([rate[:, 0], -rate[:, 1]], axis=-1)
            good = np.isfinite(matrix).all(axis=(1, 2)) & (np.abs(np.linalg.det(matrix)) > SINGULAR)
            matrix[~good], off[~good] = np.eye(2), 0.0
            step = np.clip(np.linalg.solve(matrix, off[..., None])[..., 0], -rack.module, rack.module)
            arc = arc - step
            if np.abs(step).max() < ARRIVED * rack.module:
                break
        place, _, height = centre(arc)
    found = place.mean(axis=1)
    tip = curve.arc(teeth.tip_trim[0]) - start
    tip -= curve.perimeter * np.round(tip / curve.perimeter)
    kept = ((height >= -rack.straight_depth) & (height <= SIDES * tip * sin * cos)).all(axis=1)
    kept &= np.abs(place[:, 0] - place[:, 1]).max(axis=1) < CLOSED * rack.module
    found[~kept] = np.nan
    return Pins(diameter, found, height, inside)
