"""What many tables leave open, as :mod:`mechwright_geneva.sizes` says it of one.

Angles and rollers that are left out of curved slots are sought design by design.
"""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright import Array
from mechwright.contracts.by_arrays import Designs
from mechwright_geneva.kinematics import Frame
from mechwright_geneva.law import law_of
from mechwright_geneva.many import Mechanisms, Table
from mechwright_geneva.mechanism import RIGHT
from mechwright_geneva.openings import around, reaches
from mechwright_geneva.params import GenevaParams
from mechwright_geneva.series import PINS, SLACK
from mechwright_geneva.slot_choice import wheels
from mechwright_geneva.usual import (
    FAIR_SHAFT,
    LEAST_SHAFT,
    PIN,
    SHAFT,
    cranks_of,
    dowels_of,
    floors_of,
    loads_of,
    walls_of,
)

_PINS = np.array(PINS)

Places = NDArray[np.bool_]
"""Which of the pins (m, 20) of many designs."""

CONTINUOUS = (
    "crank_half_angle",
    "offset_angle",
    "entry_radius",
    "centre_distance",
    "roller_radius",
    "groove_clearance",
    "lock_radius",
    "lock_clearance",
    "least_wall",
    "thickness",
    "floor",
    "bore",
    "hub_diameter",
    "hub_height",
    "driver_bore",
    "crank_thickness",
    "pin_diameter",
    "fixing",
    "axial_gap",
    "speed",
    "load_inertia",
    "load_torque",
)
"""Keys that may differ between designs that are taken as one."""


def completed(common: GenevaParams, designs: Designs) -> Mechanisms | None:
    """The mechanisms of designs that differ in lengths, angles and loads; None where their sizes are sought.

    Designs whose law has no fault, at a constant speed.
    """
    straight = common.law == "straight"
    varied = {
        key: np.asarray(designs[key], dtype=float)[:, None] for key in designs.varied if key in CONTINUOUS
    }
    table = Table(common, varied)
    bound = table.entry_radius is not None and table.centre_distance is not None
    if straight and not (bound and table.crank_half_angle is None):
        half, offset = (
            default if getattr(table, key) is None else getattr(table, key)
            for key, default in (("crank_half_angle", 90 - 180 / common.slots), ("offset_angle", 0.0))
        )
    else:
        half, offset = table.crank_half_angle, table.offset_angle
    open_wheel = table.entry_radius is None and (table.centre_distance is None or half is None)
    if half is None or offset is None or table.roller_radius is None or (open_wheel and not straight):
        return None
    size = (len(designs), 1)
    half, offset = (np.broadcast_to(np.asarray(value, dtype=float), size) for value in (half, offset))
    wheel = np.broadcast_to(wheels(table, half, offset), size)  # type: ignore[arg-type]
    columns: dict[str, Any] = {"crank_half_angle": half, "offset_angle": offset, "entry_radius": wheel}
    if "floor" not in common.model_fields_set | varied.keys():
        columns["floor"] = floors_of(np.asarray(table.thickness))
    if table.least_wall is None:
        columns["least_wall"] = walls_of(wheel)
    table = Table(common, varied | columns)
    if table.load_inertia is None:
        columns["load_inertia"] = loads_of(wheel)
    if table.pin_diameter is None:
        columns["pin_diameter"] = largest_of(PIN * np.asarray(table.roller_radius))
    if table.crank_thickness is None:
        pin = columns.get("pin_diameter", table.pin_diameter)
        columns["crank_thickness"] = cranks_of(np.asarray(pin))
    frame = Frame(np.asarray(math.pi / common.slots), _half(common, half), np.radians(offset), wheel)
    table = Table(common, varied | columns)
    columns |= _driver(table, frame) | _wheel(table, frame)
    if table.centre_distance is None:
        columns["centre_distance"] = frame.axes
    columns = {key: np.broadcast_to(np.asarray(value, dtype=float), size) for key, value in columns.items()}
    return Mechanisms.of(Table(common, varied | columns), law_of(common), frame)


def _half(common: GenevaParams, degrees: Array) -> Array:
    half, wheel = np.radians(degrees), math.pi / common.slots
    if common.law == "straight":
        return np.where(np.abs(half + wheel - math.pi / 2) < RIGHT, math.pi / 2 - wheel, half)
    return half


def largest_of(most: Any) -> Array:
    """As :func:`mechwright_geneva.series.largest` of the pins."""
    place = np.searchsorted(_PINS, most * (1 + SLACK), side="right") - 1
    return np.asarray(_PINS[np.maximum(place, 0)])


def _shafts(wheel: Array) -> Places:
    """Which of the pins (m, 20) are shafts that are worth having."""
    able = SHAFT * wheel * (1 + SLACK) >= _PINS
    worth = able & (np.floor(LEAST_SHAFT * wheel) <= _PINS)
    found = np.where(worth.any(axis=1, keepdims=True), worth, able)
    found[:, 0] |= ~found.any(axis=1)
    return found


def _largest(able: Places) -> Array:
    """The largest pin (m, 1) of those that are able (m, 20), below 0 where none is."""
    largest: Array = np.where(able, _PINS, -1.0).max(axis=1, keepdims=True)
    return largest


def _least(able: Places) -> Array:
    """The least pin (m, 1) of those that are able (m, 20), infinite where none is."""
    least: Array = np.where(able, _PINS, np.inf).min(axis=1, keepdims=True)
    return least


def _first(able: Places, fits: Places) -> Array:
    """The largest of the pins that are able and fit (m, 1), else the least able one."""
    largest = _largest(able & fits)
    return np.where(largest > 0, largest, _least(able))


def _driver(table: Table, frame: Frame) -> dict[str, Array]:
    """Dowels and bore of the driver, in the room that its relief leaves about its axis."""
    wheel, wall = frame.entry_radius, table.least_wall
    room = frame.axes - wheel - table.lock_clearance
    given, keyway = table.driver_bore, (table.driver_keyway_width, table.keyway_relief)
    if given is None:
        shafts = _shafts(wheel)
        fair = _least(shafts & (np.floor(FAIR_SHAFT * wheel) <= _PINS))
        fair = np.where(np.isfinite(fair), fair, _largest(shafts))
    else:
        fair = given
    dowel = table.fixing
    if dowel is None:
        thick = dowels_of(wheel)
        able = (thick * (1 + SLACK) >= _PINS) & (thick / 2 <= _PINS)
        dowel = np.maximum(_largest(able & (around(reaches(fair, *keyway), wall, _PINS) <= room)), 0.0)
    bore = _first(shafts, around(reaches(_PINS, *keyway), wall, dowel) <= room) if given is None else given
    return {"fixing": dowel, "driver_bore": bore}


def _wheel(table: Table, frame: Frame) -> dict[str, Array]:
    """Bore of the wheel, inside the slots' bottoms."""
    if table.bore is not None:
        return {}
    room = frame.bottom - table.roller_radius - table.groove_clearance / 2 - table.least_wall
    opening = reaches(_PINS, table.keyway_width, table.keyway_relief)
    fits = np.maximum(opening, table.hub_diameter / 2) <= room
    return {"bore": _first(_shafts(frame.entry_radius), fits)}
