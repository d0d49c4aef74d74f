"""Turned parts: pins and bushings. They are bought or turned, so they have a solid and no plate outline."""

from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING

from mechwright.contracts.part import Colour, Instance, Part

if TYPE_CHECKING:
    import cadquery as cq

PIN_MATERIAL, BUSHING_MATERIAL = "steel", "brass"
"""Of what is bought or turned."""

STEEL: Colour = (0.62, 0.64, 0.67)
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
    build = partial(_pin, diameter, length, head_diameter, head_height)
    return Part(name, None, 0.0, material, tuple(instances), STEEL, build=build)


def bushing_part(
    name: str,
    bore: float,
    diameter: float,
    length: float,
    instances: Sequence[Instance],
    material: str = BUSHING_MATERIAL,
) -> Part:
    """A plain bushing that stands on z = 0."""
    build = partial(_ring, bore, diameter, length)
    return Part(name, None, 0.0, material, tuple(instances), BRONZE, build=build)


def _pin(diameter: float, length: float, head_diameter: float, head_height: float) -> "cq.Solid":
    """One profile turned about the axis: nothing is fused, so that no edge is left over."""
    r, h = diameter / 2, length
    profile = [(0.0, 0.0), (r, 0.0), (r, h)]
    if head_diameter > diameter and head_height > 0:
        profile += [(head_diameter / 2, h), (head_diameter / 2, h + head_height), (0.0, h + head_height)]
    else:
        profile += [(0.0, h)]
    return _turned(profile)


def _ring(bore: float, diameter: float, length: float) -> "cq.Solid":
    inner, outer = bore / 2, diameter / 2
    return _turned([(inner, 0.0), (outer, 0.0), (outer, length), (inner, length)])


def _turned(profile: Sequence[tuple[float, float]]) -> "cq.Solid":
    """The profile (r, z) turned about z."""
    import cadquery as cq

    wire = cq.Wire.makePolygon([cq.Vector(r, 0, z) for r, z in profile], close=True)
    return cq.Solid.revolve(wire, [], 360.0, cq.Vector(0, 0, 0), cq.Vector(0, 0, 1))
