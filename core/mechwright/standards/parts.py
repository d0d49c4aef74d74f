"""Parts of a mechanism that are bought if a standard has their size, and made if it does not."""

from collections.abc import Sequence

from mechwright.contracts.fits import shaft_fit
from mechwright.contracts.part import Colour, Instance, Part
from mechwright.contracts.shape import Shape, box
from mechwright.contracts.turned import Step, Turned
from mechwright.geometry.keyway import Opening
from mechwright.standards.dowels import dowel
from mechwright.standards.keys import key

STEEL = "steel"
"""Material of both."""

GREY: Colour = (0.62, 0.64, 0.67)
"""Colour of plain steel."""


def dowel_part(
    name: str, diameter: float, length: float, instances: Sequence[Instance], colour: Colour = GREY
) -> Part:
    """A dowel on z = 0, mm: ISO 8734 or ISO 2338 where one is sold in this size, else turned to m6."""
    sold = dowel(diameter, length) or dowel(diameter, length, "ISO 2338")
    if sold is not None:
        return Part(name, None, 0.0, STEEL, tuple(instances), colour, bought=sold.bought)
    made = Turned((Step(diameter, length, shaft_fit(diameter, "m6")),))
    return Part(name, None, 0.0, STEEL, tuple(instances), colour, turned=made)


def key_part(
    name: str, opening: Opening, length: float, instances: Sequence[Instance], colour: Colour = GREY
) -> Part:
    """The key in a seat that is open at the end of its shaft, on z = 0, ``length`` mm long.

    It is one of DIN 6885, form B, where that is sold in this length, else it is cut from a bar.
    """
    sold = key(opening.width, length, "B")
    if sold is not None:
        return Part(name, None, 0.0, STEEL, tuple(instances), colour, bought=sold.bought(opening.bore))
    x = (opening.bore / 2 - opening.seat_depth, opening.key_top)
    half = opening.width / 2
    made = Shape((box(x, (-half, half), (0.0, length)),))
    return Part(name, None, 0.0, STEEL, tuple(instances), colour, build=made)
