"""How a press fit is made at its step: on which ring or face, with which mandrel, and on what support."""

import math
from collections.abc import Callable

from mechwright.mechanics.mating.rounds import Match, rounds_of
from mechwright_cad.assembly_order.groups import is_bearing
from mechwright_cad.assembly_order.levels import Step
from mechwright_cad.assembly_order.order import Order
from mechwright_cad.assembly_order.press import FREE, ROOM, support

BENCH = "Press it in a vice or arbor press, with support right under the hole."
"""How a press fit is made where the room under the hole is free."""

WHOLE = 1e-6
"""Hundredths of a millimetre that rounding may take from a diameter."""


def pressed(order: Order, step: Step, match: Match, name: Callable[[int], str]) -> str:
    """What a step says of a press: its support, and where the force acts."""
    hole, pin = order.bodies[match.hole], order.bodies[match.pin]
    if match.hole in step.moved:
        tube = f"a tube a little wider than {match.outside.diameter:g} mm"
        where = "on its inner ring only" if is_bearing(hole) else "right beside its bore"
        return f"Press {where}, with {tube}, and stand {name(match.pin)} on its other end."
    found = support(order, step, match)
    if found.bears == "tube":
        words = BENCH
    elif not found.packings:
        words = "It is supported by what lies under the hole: use a press or a clamp."
    else:
        pieces = ", ".join(f"{thick:.1f} mm on {name(k)}" for k, thick in found.packings)
        words = f"Put packings under the hole first ({pieces}), and draw it in with a clamp."
    if is_bearing(pin):
        return f"{words} Press on the outer ring only."
    if match.pin in step.moved and order.seats.is_bush(match.pin):
        inner = [one for one in rounds_of(pin, order.sample) if one.inside]
        bores = [math.floor(100 * one.limits[0] + WHOLE) / 100 for one in inner]
        wide = math.ceil(match.inside.diameter + 2 * ROOM)
        mandrel = f"a mandrel of ⌀{min(bores):g} with a shoulder" if bores else "a stepped mandrel"
        reamed = ""
        if pin.part.turned is not None and inner and inner[0].fit is not None:
            fit = inner[0].fit
            size = fit.short if fit.name else fit.text
            reamed = f" The press narrows its bore: ream it to ⌀{size} afterwards."
        return (
            f"{words} Use {mandrel}; a tube of at least ⌀{wide}, {FREE:g} mm long, lets it through.{reamed}"
        )
    return words
