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
from mechwright_geneva.horns import clear
from mechwright_geneva.kinematics import Frame
from mechwright_geneva.law import law_of
from mechwright_geneva.params import GenevaParams
from mechwright_geneva.series import ROLLERS, largest, up_to
from mechwright_geneva.sound import LEAST_BITE, Walls, sound
from mechwright_geneva.usual import (
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
class Slot:
    """Angles in degrees, lengths in mm."""

    slots: int
    crank_half_angle: float
    offset_angle: float
    entry_radius: float
    roller_radius: float

    def sizes(self) -> dict[str, float]:
        """What of it are keys of the design table."""
        return {
            "crank_half_angle": self.crank_half_angle,
            "offset_angle": self.offset_angle,
            "entry_radius": self.entry_radius,
            "roller_radius": self.roller_radius,
            "centre_distance": self.axes,
        }

    @property
    def _frame(self) -> Frame:
        half, offset = math.radians(self.crank_half_angle), math.radians(self.offset_angle)
        return Frame.of(math.pi / self.slots, half, offset, self.entry_radius)

    @property
    def axes(self) -> float:
        """Distance of the axes a."""
        return float(self._frame.axes)

    @property
    def bottom(self) -> float:
        """Distance of the slot's bottom from the wheel's axis, a - b."""
        return float(self._frame.bottom)


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
        return cls(a, b, wheels(params, a, b))

    def roller(self, params: GenevaParams, radius: float) -> int | None:
        """The place of the one that is sound with this roller and nearest to the first; None if none is."""
        wheel = _about(params)
        wall = SPARE * (params.least_wall or wall_of(wheel))
        bore = params.bore if params.bore is not None else 0.05 * wheel
        hub = max(bore, params.hub_diameter) / 2
        driver = least_room(wheel)
        if params.driver_bore is not None:
            driver = params.driver_bore / 2 + wall
        if params.fixing:
            driver += params.fixing + wall
        walls = Walls(wall, hub, driver, params.lock_clearance, params.rollers)
        groove = SPARE * radius + params.groove_clearance / 2
        half, offset = np.radians(self.half), np.radians(self.offset)
        reach = math.pi / params.slots + offset + half / 2
        able = (self.half >= 5) & (self.half <= 120) & (reach < math.radians(89))
        able &= self.wheel <= GROWN * wheel
        if able.any():
            rows = np.flatnonzero(able)
            able[rows] = sound(
                law_of(params),
                math.pi / params.slots,
                half[rows],
                offset[rows],
                self.wheel[rows],
                np.full(rows.shape, groove),
                walls,
                SAMPLES,
            )
        if not able.any():
            return None
        away = np.hypot(self.half - self.half[0], self.offset - self.offset[0])
        nearest = np.argsort(np.where(able, away, np.inf), kind="stable")[: min(int(able.sum()), _LOCKS)]
        return next((int(row) for row in nearest if self._locks(params, int(row))), None)

    def _locks(self, params: GenevaParams, row: int) -> bool:
        """Whether the horns leave the ends of a small locking disc."""
        half, offset = math.radians(self.half[row]), math.radians(self.offset[row])
        frame = Frame.of(math.pi / params.slots, half, offset, self.wheel[row])
        least = float(frame.axes - frame.entry_radius) + LEAST_BITE - params.lock_clearance
        return bool(clear(frame, law_of(params), np.array([SPARE * least]), params.lock_clearance).all())


def slot_of(params: GenevaParams) -> Slot:
    """Angles, wheel and roller of a design whose law has no fault."""
    usual = (90 - 180 / params.slots, 0.0) if params.law == "straight" else ANGLES[params.slots]
    half, offset = np.array(usual[:1]), np.array(usual[1:])
    first = _Tried.of(params, half, offset)
    if params.law == "straight":
        return _slot(params, first, 0, _radii(params, float(first.wheel[0]))[0])
    ways = (first, _Tried.of(params, np.append(half, HALVES), np.append(offset, OFFSETS)))
    for least in least_rollers_of(_about(params)):
        for tried in ways:
            for radius in _radii(params, _about(params), least):
                found = tried.roller(params, radius)
                if found is not None:
                    return _slot(params, tried, found, radius)
    if params.entry_radius is None and params.centre_distance is None and params.roller_radius is not None:
        wheel = min(MOST_WHEEL, math.ceil(2 * params.roller_radius / ROLLER / STEP) * STEP)
        if wheel > WHEEL:
            return slot_of(params.model_copy(update={"entry_radius": wheel}))
    return _slot(params, first, 0, _radii(params, float(first.wheel[0]))[0])


def _slot(params: GenevaParams, tried: _Tried, row: int, radius: float) -> Slot:
    wheel = float(tried.wheel[row])
    return Slot(params.slots, float(tried.half[row]), float(tried.offset[row]), wheel, radius)


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
    """Radius of the wheel with each pair of angles."""
    if params.entry_radius is not None:
        return np.broadcast_to(np.asarray(params.entry_radius, dtype=float), half.shape)
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
