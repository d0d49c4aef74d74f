"""How the coupler takes its two pins: a bore, a bore for each phase, or a slot in which a stud is clamped.

In the pose of setting the coupler stands still, the crank turns about a0 and the rocker about B, so the
places of a pin lie on a circle about that axis. Places whose bosses stand clear of each other have a bore
each; nearer ones share one slot. There the pin is a stud, clamped by a screw from inside the coupler, and
turns in the crank's or the rocker's bore.
"""

import math
from dataclasses import dataclass

import numpy as np

from mechwright import Array, kept
from mechwright.mechanics.linkage.clamp import Clamp, clamps
from mechwright_spherical.kinematics.linkage import Linkage, linkage_of
from mechwright_spherical.kinematics.vectors import arc, azimuth, rotate
from mechwright_spherical.parameters import SphericalParams

SAME_PLACE = 1e-6
"""rad. Places nearer to each other than this are one: a ten-thousandth of a millimetre."""

HEAD, HEAD_HEIGHT = 1.6, 0.3
"""Diameter and height of a stud's head, in pin diameters: those of small rivets and clevis pins."""

END_PLAY = 0.2
"""Of a link along a stud, mm."""

MARK, MARK_WIDTH, MARK_DEPTH = 2.0, 0.5, 0.3
"""Length, width and depth of a line of the scale, mm."""


@dataclass(frozen=True)
class Seat:
    """Where the coupler takes a pin.

    Parameters
    ----------
    name
        Of the pin: a or c.
    axis
        About which the pin is set, a unit vector (3,).
    places
        Of the pin in all phases, unit vectors (3,) in the pose of setting, phase 1 first.
    """

    name: str
    axis: Array
    places: tuple[Array, ...]

    @property
    def angles(self) -> list[float]:
        """About the axis from the place of phase 1 to those of all phases, rad, -π to π."""
        return [float(azimuth(self.axis, self.places[0], place)) for place in self.places]

    @property
    def own(self) -> tuple[Array, ...]:
        """Places that differ, in the order of the phases."""
        found: list[Array] = []
        for place in self.places:
            if all(float(arc(place, other)) > SAME_PLACE for other in found):
                found.append(place)
        return tuple(found)

    @property
    def ends(self) -> tuple[Array, Array]:
        """First and last place along the circle, so that the way between them is the shortest that has all.

        >>> z = np.array([0.0, 0, 1])
        >>> at = [np.array([math.cos(t), math.sin(t), 0.0]) for t in (0.0, 0.4, -0.2)]
        >>> [round(float(math.atan2(y, x)), 6) for x, y, _ in Seat("a", z, tuple(at)).ends]
        [-0.2, 0.4]
        """
        order = sorted(range(len(self.places)), key=lambda k: self.angles[k])
        turns = [self.angles[k] for k in order]
        gaps = [(two - one) % math.tau for one, two in zip(turns, [*turns[1:], turns[0]], strict=True)]
        widest = max(range(len(gaps)), key=lambda k: gaps[k])
        return self.places[order[(widest + 1) % len(order)]], self.places[order[widest]]

    @property
    def sweep(self) -> float:
        """From the first to the last of the ends, rad, 0 and more."""
        return float(azimuth(self.axis, *self.ends)) % math.tau if len(self.own) > 1 else 0.0

    def points(self) -> Array:
        """Points (3, n) along the way between the ends, or all places of a seat with bores."""
        steps = np.linspace(0.0, self.sweep, 61)  # a sixtieth of a slot is far less than a pin
        return rotate(self.axis[:, None], steps, self.ends[0][:, None])

    def chord(self, radius: float) -> float:
        """Least distance of two places at that radius, mm; infinite where there is one place alone."""
        own = self.own
        chords = [2 * radius * math.sin(float(arc(x, y)) / 2) for k, x in enumerate(own) for y in own[:k]]
        return min(chords, default=math.inf)


def seats_of(linkage: Linkage) -> tuple[Seat, Seat]:
    """Those of the pins A and C, in space in the pose of setting."""
    states = [phase.at_reference for phase in linkage.phases]
    a, c = (tuple(getattr(state, name)[0][:, 0] for state in states) for name in "ac")
    return Seat("a", linkage.phases[0].loop.a0, a), Seat("c", states[0].b[0][:, 0], c)


@kept
def slotted_of(params: SphericalParams) -> tuple[str, ...]:
    """The pins, a or c, that are set in slots."""
    radius, boss = params.radius + params.hardware.standoff, params.hardware.boss_diameter
    return tuple(one.name for one in seats_of(linkage_of(params)) if one.chord(radius) < boss)


def plate_of(params: SphericalParams) -> float:
    """Thickness of a link at its bosses, mm."""
    return params.hardware.link_thickness + 2 * params.hardware.boss_height


def head_of(params: SphericalParams) -> tuple[float, float]:
    """Diameter and height of a stud's head, mm."""
    return HEAD * params.hardware.pin_diameter, HEAD_HEIGHT * params.hardware.pin_diameter


def stud_length(params: SphericalParams) -> float:
    """Of a stud without its head, from the coupler through the gap and the other link, mm."""
    return params.hardware.gap + plate_of(params) + END_PLAY


@kept
def clamp_of(params: SphericalParams) -> Clamp | None:
    """The largest clamp for the studs; None where nothing is set in a slot, or no screw fits."""
    if not slotted_of(params):
        return None
    length = stud_length(params) + head_of(params)[1]
    found = clamps(params.hardware.pin_diameter, plate_of(params), length)
    return next((one for one in found if 2 * one.reach <= params.hardware.boss_diameter), None)


def stud_room(params: SphericalParams) -> float:
    """What heads and play of studs take over crank and rocker, mm."""
    return 0.0 if clamp_of(params) is None else head_of(params)[1] + END_PLAY


def clamped(params: SphericalParams) -> tuple[str, ...]:
    """The pins, a or c, that are studs and clamped."""
    return () if clamp_of(params) is None else slotted_of(params)


def slot_width(params: SphericalParams) -> float:
    """Of a slot, mm: the screw's clearance hole, or what a pin needs where no screw fits."""
    clamp = clamp_of(params)
    return clamp.width if clamp is not None else params.hardware.pin_diameter + params.hardware.fit


def land_width(params: SphericalParams) -> float:
    """Of the coupler along a slot, mm: washers lie on it and, beyond them on one side, the scale."""
    clamp = clamp_of(params)
    boss = params.hardware.boss_diameter
    return boss if clamp is None else max(boss, 2 * (clamp.reach + MARK))
