"""What a finished gear is measured by: over pins in its spaces, and from its axis to pins."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from mechwright.contracts.measure import Measure
from mechwright.mechanics.gearing.over_pins import Pins, gauge_pin, pins_in
from mechwright.mechanics.gearing.teeth import Teeth

ALIKE = 1e-6
"""mm. Pins of a round gear are so far from its axis to within this."""

SHARE = 0.25
"""Of the pair's backlash: by so much a tooth may be thicker or thinner, so that half of the play is left."""

PLACES = 4
"""Spaces of a gear that is not round from whose pins the axis is measured."""


def gear_measures(
    teeth: Teeth,
    middle: tuple[float, float] = (0.0, 0.0),
    *,
    backlash: float | None = None,
    inside: bool = False,
    turn: float = 0.0,
) -> tuple[Measure, ...]:
    """Sizes over pins of a gear; none where no gauge pin has a place in it.

    Parameters
    ----------
    middle
        The point of the body frame across which spaces are opposite, mm.
    backlash
        Of the pair, mm, from which limits follow. Default: the rack's.
    inside
        Whether it is a ring.
    turn
        The angle of the body frame in the part's, rad.
    """
    diameter = gauge_pin(teeth.rack.module)
    pins = pins_in(teeth, diameter, inside=inside)
    places = np.flatnonzero(np.isfinite(pins.centres).all(axis=1))
    if not places.size:
        return ()
    play = SHARE * (teeth.rack.backlash if backlash is None else backlash)
    others = [pins_in(_thicker(teeth, change), diameter, inside=inside) for change in (-play, play)]
    rows = _rows(pins, places, middle, turn)
    return tuple(
        _measure(what, [_size(one, at) for one in (pins, *others)], play)
        for what, at in rows
        if all(np.isfinite(one.centres[list(at)]).all() for one in others)
    )


def _thicker(teeth: Teeth, change: float) -> Teeth:
    """Teeth that are thicker by so much, mm."""
    return replace(teeth, thickness=teeth.rack.pitch - 2 * teeth.half_space + change)


def _size(pins: Pins, at: tuple[int, ...]) -> float:
    return pins.over(*at) if len(at) == 2 else float(pins.outside[at[0]])


def _measure(what: str, sizes: list[float], play: float) -> Measure:
    nominal, *limits = sizes
    if play <= 0:
        return Measure(what, nominal)
    return Measure(what, nominal, min(limits), max(limits), "backlash")


def _rows(
    pins: Pins, places: np.ndarray, middle: tuple[float, float], turn: float
) -> Iterator[tuple[str, tuple[int, ...]]]:
    """What is measured, and in which spaces."""
    over = "between" if pins.inside else "over"
    angles = np.degrees(np.arctan2(*pins.centres.T[::-1]) + turn) % 360

    def across(one: int, two: int) -> tuple[str, tuple[int, ...]]:
        at = " and ".join(f"{angles[space]:.1f}°" for space in (one, two))
        return f"{over} pins ⌀{pins.diameter:g} at {at}", (one, two)

    if len(places) == len(pins.centres):
        mates = pins.opposite(middle)
        if np.ptp(pins.outside) < ALIKE:
            yield across(0, int(mates[0]))
            return
        sizes = np.array([pins.over(one, int(two)) for one, two in enumerate(mates)])
        yield across(int(sizes.argmax()), int(mates[sizes.argmax()]))
        yield across(int(sizes.argmin()), int(mates[sizes.argmin()]))
    side = "near" if pins.inside else "far"
    for place in np.unique(np.linspace(0, len(places) - 1, PLACES + 1).round().astype(int)[:PLACES]):
        space = int(places[place])
        yield f"axis to the {side} side of a pin ⌀{pins.diameter:g} at {angles[space]:.1f}°", (space,)
