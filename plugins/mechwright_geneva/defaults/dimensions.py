"""What a design table leaves open, from what it gives: every dimension of the mechanism.

In this order, each from those before it (docs/geneva.md, "Defaults"):

    angles and roller   those of :mod:`mechwright_geneva.defaults.slot_defaults`
    l                   as the centre distance wants it, or 100 mm, more where the driver's shaft needs it
    pin                 the largest standard one up to 1.2 r
    crank plate         8 mm, of pins below 2 mm three and a half of them
    locking disc        the thinnest plate that is sold and as thick as wheel and gap
    dowels              0.06 l, 2 to 4 mm; down to half of it where the driver has less room, or none
    bores               the largest standard shaft up to 0.12 l that leaves the walls
    load                0.01 kg m², of a wheel below 100 mm as that of a disc, with the fourth power of l
"""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright import Array, kept
from mechwright.contracts.design_table import plain
from mechwright_geneva.defaults.preferred_sizes import PINS, SLACK
from mechwright_geneva.defaults.proportions import (
    FAIR_SHAFT,
    LEAST_SHAFT,
    PIN,
    SHAFT,
    crank_of,
    dowel_of,
    load_of,
    sold_disc,
    wall_of,
)
from mechwright_geneva.defaults.slot_defaults import DECIDES, slot_of, wheels
from mechwright_geneva.kinematics.geometry import Frame
from mechwright_geneva.kinematics.mechanism import Mechanism, frame_of
from mechwright_geneva.parameters import GenevaParams, Sizes
from mechwright_geneva.parts.openings import needed_radius, reach

LEFT_OPEN = tuple(name for name, field in Sizes.model_fields.items() if field.is_required())
"""The keys that a design file may leave out and that have a value here."""

_PINS = np.array(PINS)

_Able = NDArray[np.bool_]
"""Which of the pins (n, 20) of n designs."""


@kept
def complete(params: GenevaParams) -> Sizes:
    """The table of one design with all that it leaves out. Its law has been found free of faults before."""
    return completed(params)


def completed(given: GenevaParams, size: int | None = None) -> Sizes:
    """The table with all that it leaves out.

    Parameters
    ----------
    given
        The design table, or one whose numbers are columns (n, 1); its law has no fault.
    size
        The number n of designs; None for one with plain numbers.

    Returns
    -------
    sizes
        The open dimensions of one design are numbers, those of a table columns (n, 1).
    """
    if isinstance(given, Sizes):
        return given
    values: dict[str, Any] = {name: getattr(given, name) for name in GenevaParams.model_fields}
    values |= _slot(given, size)
    wheel = np.asarray(values["entry_radius"])

    def leave(name: str, value: Any) -> None:
        if getattr(given, name) is None:
            values[name] = value

    leave("least_wall", wall_of(wheel))
    leave("load_inertia", load_of(wheel))
    leave("pin_diameter", _largest_pin(PIN * np.asarray(values["roller_radius"])))
    leave("crank_thickness", crank_of(np.asarray(values["pin_diameter"]), values["material"]))
    leave("disc_thickness", sold_disc(values["thickness"], values["axial_gap"], values["material"]))
    frame = frame_of(Sizes.model_construct(**values))
    leave("centre_distance", frame.axes)
    for name, value in (_driver(values, frame) | _wheel(values, frame)).items():
        leave(name, value)
    values["left_out"] = tuple(name for name in LEFT_OPEN if getattr(given, name) is None)
    found = Sizes.model_construct(set(values), **values)
    return plain(found, 0, 1) if size is None else found


@kept
def mechanism_of(params: GenevaParams) -> Mechanism:
    """The mechanism of a design."""
    return Mechanism(params, complete=completed)


def table_of(params: GenevaParams, size: int | None) -> Mechanism:
    """The same of one design, or of a table of so many."""
    return mechanism_of(params) if size is None else Mechanism(params, size, complete=completed)


def _slot(given: GenevaParams, size: int | None) -> dict[str, Any]:
    """Angles, wheel and roller."""
    straight = given.law == "straight"
    half, offset = given.crank_half_angle, given.offset_angle
    bound = given.entry_radius is not None and given.centre_distance is not None
    if straight and not (bound and half is None):
        half = 90 - 180 / given.slots if half is None else half
        offset = 0.0 if offset is None else offset
    open_wheel = given.entry_radius is None and (
        given.centre_distance is None or given.crank_half_angle is None
    )
    if half is None or offset is None or given.roller_radius is None or (open_wheel and not straight):
        return _sought(given, size)
    angles = np.asarray(half, dtype=float), np.asarray(offset, dtype=float)
    return {
        "crank_half_angle": angles[0],
        "offset_angle": angles[1],
        "entry_radius": wheels(given, *angles),
    }


def _sought(given: GenevaParams, size: int | None) -> dict[str, Any]:
    """The same where they are sought: of designs that differ in what decides it, one after the other."""
    deciding = [getattr(given, name) for name in DECIDES if isinstance(getattr(given, name), np.ndarray)]
    if size is None or not deciding:
        return slot_of(plain(given, 0, size or 1))
    rows = np.concatenate([np.broadcast_to(one, (size, 1)) for one in deciding], axis=1)
    _, first, kind = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    found = [slot_of(plain(given, place, size)) for place in first.tolist()]
    return {name: np.array([one[name] for one in found])[kind.ravel(), None] for name in found[0]}


def _largest_pin(most: Array) -> Array:
    """The largest pins (...) that are not above ``most``, or the smallest of all."""
    place = np.searchsorted(_PINS, most * (1 + SLACK), side="right") - 1
    return np.asarray(_PINS[np.maximum(place, 0)])


def _shafts(wheel: Array) -> _Able:
    """Which of the pins (n, 20) are shafts that are worth having."""
    able = SHAFT * wheel * (1 + SLACK) >= _PINS
    worth = able & (np.floor(LEAST_SHAFT * wheel) <= _PINS)
    found = np.where(worth.any(axis=-1, keepdims=True), worth, able)
    found[..., 0] |= ~found.any(axis=-1)
    return found


def _largest(able: _Able) -> Array:
    """The largest pin (n, 1) of those that are able (n, 20), below 0 where none is."""
    largest: Array = np.where(able, _PINS, -1.0).max(axis=-1, keepdims=True)
    return largest


def _least(able: _Able) -> Array:
    """The least pin (n, 1) of those that are able (n, 20), infinite where none is."""
    least: Array = np.where(able, _PINS, np.inf).min(axis=-1, keepdims=True)
    return least


def _first(able: _Able, fits: _Able) -> Array:
    """The largest of the pins that are able and fit (n, 1), else the least able one."""
    largest = _largest(able & fits)
    return np.where(largest > 0, largest, _least(able))


def _driver(values: Mapping[str, Any], frame: Frame) -> dict[str, Array]:
    """Dowels and bore of the driver, in the room that its relief leaves about its axis."""
    wheel, wall = np.atleast_1d(frame.entry_radius), values["least_wall"]
    room = frame.axes - wheel - values["lock_clearance"]
    keyway = values["driver_keyway_width"], values["keyway_relief"]
    shafts = _shafts(wheel)
    fair = values["driver_bore"]
    if fair is None:
        fair = _least(shafts & (np.floor(FAIR_SHAFT * wheel) <= _PINS))
        fair = np.where(np.isfinite(fair), fair, _largest(shafts))
    dowel = values["fixing"]
    if dowel is None:
        thick = dowel_of(wheel)
        able = (thick * (1 + SLACK) >= _PINS) & (thick / 2 <= _PINS)
        fits = needed_radius(reach(fair, *keyway), wall, _PINS) <= room
        dowel = np.maximum(_largest(able & fits), 0.0)
    bore = _first(shafts, needed_radius(reach(_PINS, *keyway), wall, dowel) <= room)
    return {"fixing": dowel, "driver_bore": bore}


def _wheel(values: Mapping[str, Any], frame: Frame) -> dict[str, Array]:
    """Bore of the wheel, inside the slots' bottoms."""
    room = frame.bottom - values["roller_radius"] - values["groove_clearance"] / 2 - values["least_wall"]
    opening = reach(_PINS, values["keyway_width"], values["keyway_relief"])
    fits = np.maximum(opening, values["hub_diameter"] / 2) <= room
    return {"bore": _first(_shafts(np.atleast_1d(frame.entry_radius)), np.atleast_1d(fits))}
