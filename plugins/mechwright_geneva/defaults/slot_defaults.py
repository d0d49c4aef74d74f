"""Angles, wheel and roller that a design leaves open.

What is given stands. With the usual angles the roller is the largest standard one, up to a tenth of l in
diameter, with which the slots are sound. Where there is none, or where what is given asks for other angles (a
time, a roller, several rollers), those nearest to the usual ones are taken with which they are. A large
roller has a large wheel. Where nothing helps, the usual ones stay, and the checks say what is wrong with
them.
"""

import math
from dataclasses import dataclass

import numpy as np

from mechwright import Array
from mechwright_geneva.defaults.preferred_sizes import ROLLERS, largest, up_to
from mechwright_geneva.defaults.proportions import (
    ANGLES,
    FAIR_SHAFT,
    LEAST_ROLLER,
    ROLLER,
    STEP,
    WHEEL,
    least_rollers_of,
    least_room,
    roller_of,
    wall_of,
)
from mechwright_geneva.parameters import GenevaParams
from mechwright_geneva.rules.slot_search import allowed, locks, trial

DECIDES = (
    *("crank_half_angle", "offset_angle", "entry_radius", "centre_distance", "roller_radius", "least_wall"),
    *("groove_clearance", "lock_clearance", "bore", "hub_diameter", "driver_bore", "fixing"),
)
"""Keys of numbers on which the choice depends, besides law, slots and rollers."""

HALVES = np.arange(15.0, 105.1, 2.5)
OFFSETS = np.arange(-36.0, 30.1, 1.5)
"""Angles that are tried besides the usual ones, degrees: beyond them no sound slot has been found."""

SPARE = 1.04
"""Walls and rollers are tried so much larger: what is chosen is not on the edge of what can be made."""

SAMPLES = 33
"""Of half a stroke: a place within 1 % of its limit is told by the spare."""

AXES = 1.25
"""Centre distance over l with usual angles, between 1.07 and 2."""

GROWN = 1.8
"""So much larger than usual a wheel may become for the driver's sake before other angles are taken."""

_LOCKS = 40
"""Sound slots of which it is looked whether a disc locks the wheel, nearest first."""

MOST_WHEEL = 1000.0
"""Largest entry radius of the design table, mm."""


@dataclass(frozen=True, slots=True)
class _Tried:
    """Angles in degrees and wheels, (m,) each."""

    half: Array
    offset: Array
    wheel: Array

    @classmethod
    def of(cls, params: GenevaParams, half: Array, offset: Array) -> "_Tried":
        """All pairs of some angles, but for what is given."""
        if params.offset_angle is not None:
            offset = np.array([params.offset_angle])
        bound = params.entry_radius is not None and params.centre_distance is not None
        if params.crank_half_angle is not None:
            half = np.array([params.crank_half_angle])
        elif bound:
            half = half[:1]  # follows from both
        a, b = (grid.ravel() for grid in np.meshgrid(half, offset, indexing="ij"))
        if bound and params.crank_half_angle is None:
            a = _half_between(params, b)
        return cls(a, b, np.broadcast_to(wheels(params, a, b), a.shape))

    def roller(self, params: GenevaParams, radius: float) -> int | None:
        """The place of the one that is sound with this roller and nearest to the first; None if none is."""
        wheel = _about(params)
        wall = SPARE * (wall_of(wheel) if params.least_wall is None else params.least_wall)
        driver = params.driver_bore
        if driver is None:
            driver = 2 * (least_room(wheel) - wall)
        reach = 180 / params.slots + self.offset + self.half / 2
        able = (self.half >= 5) & (self.half <= 120) & (reach < 89) & (self.wheel <= GROWN * wheel)
        rows = np.flatnonzero(able)
        if rows.size:
            tried = trial(
                params,
                rows.size,
                SAMPLES,
                crank_half_angle=self.half[rows],
                offset_angle=self.offset[rows],
                entry_radius=self.wheel[rows],
                roller_radius=SPARE * radius,
                least_wall=wall,
                bore=0.05 * wheel if params.bore is None else params.bore,
                keyway_width=0.0,
                driver_bore=driver + (2 * (params.fixing + wall) if params.fixing else 0.0),
                driver_keyway_width=0.0,
                fixing=0.0,
            )
            able[rows] = allowed(tried)
        if not able.any():
            return None
        away = np.hypot(self.half - self.half[0], self.offset - self.offset[0])
        nearest = np.argsort(np.where(able, away, np.inf), kind="stable")[: min(int(able.sum()), _LOCKS)]
        return next((int(row) for row in nearest if self._locks(params, int(row))), None)

    def _locks(self, params: GenevaParams, row: int) -> bool:
        """Whether the horns leave the ends of a small locking disc."""
        angles = {"crank_half_angle": self.half, "offset_angle": self.offset, "entry_radius": self.wheel}
        one = trial(params, 1, SAMPLES, **{name: values[row : row + 1] for name, values in angles.items()})
        return locks(one, SPARE * one.least_lock)


def slot_of(params: GenevaParams) -> dict[str, float]:
    """Angles, degrees, wheel and roller, mm, of a design whose law has no fault, by their keys."""
    usual = (90 - 180 / params.slots, 0.0) if params.law == "straight" else ANGLES[params.slots]
    half, offset = np.array(usual[:1]), np.array(usual[1:])
    first = _Tried.of(params, half, offset)
    if params.law == "straight":
        return _slot(first, 0, _radii(params, float(first.wheel[0]))[0])
    ways = (first, _Tried.of(params, np.append(half, HALVES), np.append(offset, OFFSETS)))
    for least in least_rollers_of(_about(params)):
        for tried in ways:
            for radius in _radii(params, _about(params), least):
                found = tried.roller(params, radius)
                if found is not None:
                    return _slot(tried, found, radius)
    if params.entry_radius is None and params.centre_distance is None and params.roller_radius is not None:
        wheel = min(MOST_WHEEL, math.ceil(2 * params.roller_radius / ROLLER / STEP) * STEP)
        if wheel > WHEEL:
            return slot_of(params.model_copy(update={"entry_radius": wheel}))
    return _slot(first, 0, _radii(params, float(first.wheel[0]))[0])


def _slot(tried: _Tried, row: int, radius: float) -> dict[str, float]:
    return {
        "crank_half_angle": float(tried.half[row]),
        "offset_angle": float(tried.offset[row]),
        "entry_radius": float(tried.wheel[row]),
        "roller_radius": radius,
    }


def _about(params: GenevaParams) -> float:
    """The wheel for which walls and rollers are sized while the angles are open."""
    return params.entry_radius or (params.centre_distance or AXES * WHEEL) / AXES


def _radii(params: GenevaParams, wheel: float, least: float = 0.0) -> list[float]:
    """Rollers that are tried on a wheel, the largest first, down to a diameter."""
    if params.roller_radius is not None:
        return [params.roller_radius]
    most = roller_of(wheel)
    able = [one / 2 for one in up_to(ROLLERS, most) if one >= max(least, LEAST_ROLLER * wheel)]
    return able or [max(0.5, largest(ROLLERS, most) / 2)]


def wheels(params: GenevaParams, half: Array, offset: Array) -> Array:
    """Radius of the wheel with each pair of angles; one for all where it is given."""
    if params.entry_radius is not None:
        return np.asarray(params.entry_radius, dtype=float)
    entry = math.pi / params.slots + np.radians(offset)
    share = np.cos(entry) + np.sin(entry) / np.tan(np.radians(half))  # a/l
    if params.centre_distance is not None:
        return np.clip(params.centre_distance / np.where(share > 0, share, np.inf), 5, MOST_WHEEL)
    wanted = least_room(WHEEL, FAIR_SHAFT) + params.lock_clearance
    least = np.where(share > 1, wanted / np.where(share > 1, share - 1, 1.0), 0.0)
    larger = np.ceil(least / STEP - 1e-9) * STEP
    wheels: Array = np.where(least > WHEEL, np.clip(larger, WHEEL, MOST_WHEEL), WHEEL)
    return wheels


def _half_between(params: GenevaParams, offset: Array) -> Array:
    """Half angle of the crank with which wheel and centre distance are both as given, degrees."""
    entry = math.pi / params.slots + np.radians(offset)
    share = (params.centre_distance or 0.0) / (params.entry_radius or 1.0)
    half: Array = np.degrees(np.arctan2(np.sin(entry), share - np.cos(entry)))
    return half
