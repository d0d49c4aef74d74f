"""What cannot be taken apart again without damage: pins in blind holes, and bonded seats."""

from collections.abc import Iterator

from mechwright.mechanics.mating.rounds import Match
from mechwright_cad.assembly_order.order import Order

GRIP = 3.0
"""Length of a pin outside of its hole at which pliers or a puller hold it, mm."""

OPEN = 0.5
"""A hole ends at a face if it comes so near to it, mm."""


def locked(order: Order) -> Iterator[Match]:
    """Pins that are pressed into a blind hole and leave nothing to grip: no drift reaches them."""
    for match in order.seats.matches:
        if order.seats.kind(match) == "pressed" and _is_blind(order, match) and not _stands_out(match):
            yield match


def bonded(order: Order) -> Iterator[Match]:
    """Seats that retaining compound holds for good."""
    return (one for one in order.seats.matches if not one.missing_fits and order.seats.kind(one) == "bonded")


def _is_blind(order: Order, match: Match) -> bool:
    part = order.bodies[match.hole].part
    if part.outline is None:
        return False
    return match.inside.low > OPEN or match.inside.high < part.thickness - OPEN


def _stands_out(match: Match) -> bool:
    inside, pin = match.inside, match.outside
    seat = inside.high - inside.low
    return pin.high - pin.low > seat + GRIP
