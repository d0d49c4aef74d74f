"""How tightly keys sit in shafts, and keyed hubs on them.

A key h9 in a seat N9 may have 0.03 mm of play. Where the torque changes its sense within a turn, it would
knock and wear: its seat is P9, and the hub sits on j6, which light blows bring on and off. A hub's keyway is
JS9 in either case: a milled one is right to 0.02 mm at best, and P9 leaves less.
"""

from collections.abc import Sequence
from dataclasses import replace

from mechwright.contracts.fit_settings import FitSettings
from mechwright.contracts.fits import shaft_fit
from mechwright.contracts.part import Part
from mechwright.contracts.turned import KeySeat, Step, Turned

TIGHT, LIGHT = "P9", "N9"
"""Classes of a key's seat in a shaft."""

SLIDING, PUSHED = "h6", "j6"
"""Classes of a shaft under a keyed hub that slides on, and under one that must not knock."""


def with_key_seats(parts: Sequence[Part], settings: FitSettings, *, reverses: bool) -> list[Part]:
    """The parts, their key seats with the class that the settings or the torque of the drive ask for."""
    chosen = settings.key if settings.key != "auto" else TIGHT if reverses else LIGHT
    return [
        replace(part, turned=_seated(part.turned, chosen), build=None)
        if part.turned is not None and part.turned.seats and part.bought is None
        else part
        for part in parts
    ]


def _seated(turned: Turned, chosen: str) -> Turned:
    seats = tuple(replace(seat, limits=chosen) for seat in turned.seats)
    if chosen != TIGHT:
        return replace(turned, seats=seats)
    steps = tuple(
        replace(step, fit=shaft_fit(step.diameter, PUSHED))
        if step.fit is not None and step.fit.name == SLIDING and _has_seat(low, step, turned.seats)
        else step
        for low, step in zip(turned.starts, turned.steps, strict=True)
    )
    return replace(turned, seats=seats, steps=steps)


def _has_seat(low: float, step: Step, seats: Sequence[KeySeat]) -> bool:
    """Whether the middle of a key seat lies in a step that begins at ``low``, mm."""
    return any(low < seat.at + seat.length / 2 < low + step.length for seat in seats)
