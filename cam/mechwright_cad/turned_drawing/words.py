"""What a drawing says in words and numbers."""

import re

from mechwright.contracts.fits import signed
from mechwright.contracts.limits import limits
from mechwright.contracts.turned import EndThread, Flats, Groove, KeySeat, Step, Turned, limited
from mechwright.errors import DesignError
from mechwright.standards.keys import depth_tolerance, length_tolerance
from mechwright_cad.sheet.words import FAIR, FINE, GENERAL, number

"""Roughness of seats that are pressed, and of those that turn or slide, µm."""

_PRESSED = re.compile("[jkmnp][4-7]")

SLENDER = 4.0
"""From this length in diameters on a part is turned between centres."""


def of_step(step: Step) -> str:
    """The diameter of a step, with fit and roughness where it has one.

    >>> of_step(Step(8.0, 4.0)), of_step(Step(6.0, 4.0, start=0.0))
    ('⌀8', '⌀0 to ⌀6, cone')
    """
    if step.start is not None:
        return f"⌀{number(step.start)} to ⌀{number(step.diameter)}, cone"
    if step.fit is None:
        return f"⌀{number(step.diameter)}"
    rough = FINE if _PRESSED.fullmatch(step.fit.name) else FAIR
    return f"⌀{step.fit.text} {rough}"


def of_groove(groove: Groove) -> str:
    """The diameter and width of a groove."""
    limits = f" (0/{signed(-groove.under)})" if groove.under else ""
    return f"⌀{number(groove.diameter)}{limits}, {number(groove.width)} H13 wide"


def of_seat_width(seat: KeySeat) -> str:
    """The width of a key seat with its class, and the limit deviations where the table of limits has them."""
    try:
        lower, upper = limits(seat.width, seat.limits)
    except DesignError:
        return f"{number(seat.width)} {seat.limits}"
    return f"{number(seat.width)} {seat.limits} ({signed(upper / 1000)}/{signed(lower / 1000)})"


def of_seat_depth(seat: KeySeat, step: float) -> str:
    """What is left of a step's diameter under a seat, as it is measured."""
    return f"{number(step / 2 + seat.floor)} (0/{signed(-depth_tolerance(seat.width))})"


def of_seat_length(seat: KeySeat, part: float) -> str:
    """The length of a seat over all, mm; that of a closed one is its key's and has the key's tolerance."""
    if seat.round_ends(part) != (True, True):
        return number(seat.length)
    return limited(seat.length, 0.0, length_tolerance(seat.length))


def of_bore(turned: Turned) -> str:
    """The bore, all through."""
    if turned.bore_fit is not None:
        return f"⌀{turned.bore_fit.text} {FAIR}, through"
    return f"⌀{number(turned.bore)} through"


def of_thread(thread: EndThread) -> str:
    """The thread in an end and the hole that is drilled for it, each with its depth (ISO 6410-1).

    >>> of_thread(EndThread("upper", 4.0, 0.7, 10.0))
    'M4 x 10 / ⌀3.3 x 12.1'
    """
    drill = round(thread.diameter - thread.pitch, 2)
    return (
        f"M{number(thread.diameter)} x {number(thread.depth)} / ⌀{number(drill)} x {number(thread.drilled)}"
    )


def of_flats(flats: Flats) -> str:
    """Width across, length and place of flats for a spanner.

    >>> of_flats(Flats(17.0, 6.0, 10.0))
    'Two flats 10 (0/-0.2) across, 6 long, 17 from the lower end'
    """
    wide = limited(flats.across, -0.2, 0.0)
    return f"Two flats {wide} across, {number(flats.length)} long, {number(flats.at)} from the lower end"


def notes(turned: Turned) -> list[str]:
    """What holds for the whole part."""
    found = [*GENERAL]
    if turned.chamfer:
        found.append(f"Both ends {number(turned.chamfer)} x 45°")
    fits = [step for step in turned.steps if step.fit is not None]
    if len(fits) > 1:
        found.append("Run-out of fitted diameters to each other 0.02")
    if turned.length > SLENDER * turned.greatest and turned.bore == 0:
        found.append("Centre holes ISO 6411 may stay")
    found += map(of_flats, turned.flats)
    return [*found, turned.note] if turned.note else found
