"""Pins and bushings of linkages: turned parts, so they have a solid, a drawing, and no plate outline."""

from collections.abc import Sequence
from dataclasses import replace

from mechwright.contracts.part import Colour, Instance, Part
from mechwright.contracts.turned import Length, Step, Turned, tube
from mechwright.standards.parts import GREY

PIN_MATERIAL, BUSHING_MATERIAL = "steel", "brass"
"""Of what is turned."""

HEAD, HEAD_HEIGHT = 1.6, 0.3
"""Diameter and height of a pin's head, in pin diameters: those of small rivets and clevis pins."""

SHAFT = 3.0
"""Length of a shaft beyond its ground plate or gear, in pin diameters: room for a coupling."""

LENGTH, LIMIT = "length of the bushing, which keeps links apart", 0.05
"""Name of that length, and its limit deviations, plus and minus, mm."""

STEEL = GREY
BRONZE: Colour = (0.76, 0.58, 0.30)


def pin_part(
    name: str,
    diameter: float,
    length: float,
    instances: Sequence[Instance],
    head_diameter: float = 0.0,
    head_height: float = 0.0,
    material: str = PIN_MATERIAL,
) -> Part:
    """A pin that stands on z = 0, with a flat head on top of ``length``, mm, if it has one."""
    steps = [Step(diameter, length)]
    if head_diameter > diameter and head_height > 0:
        steps.append(Step(head_diameter, head_height))
    return Part(name, None, 0.0, material, tuple(instances), STEEL, turned=Turned(tuple(steps)))


def bushing_part(
    name: str,
    bore: float,
    diameter: float,
    length: float,
    instances: Sequence[Instance],
    material: str = BUSHING_MATERIAL,
    *,
    spaces: float = 0.0,
) -> Part:
    """A plain bushing that stands on z = 0.

    ``spaces`` is how far it stands out of its plate, mm: it keeps links apart, and its length has limits.
    """
    form = tube(bore, diameter, length)
    if spaces > 0:
        form = replace(form, lengths=(Length(LENGTH, 0.0, length, -LIMIT, LIMIT),))
    return Part(name, None, 0.0, material, tuple(instances), BRONZE, turned=form, play=spaces)
