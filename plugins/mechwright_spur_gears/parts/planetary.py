"""Carrier and pins of a planetary set: planets run on pins that are pressed into a plate below them."""

import math

from mechwright import Bore, Instance, Outline, Part
from mechwright.contracts.fits import hole_fit, shaft_fit
from mechwright.contracts.part import Feature, Profile
from mechwright.contracts.turned import Step, Turned
from mechwright.geometry import Loop, circle
from mechwright.mechanics.linkage.turned import HEAD, HEAD_HEIGHT, PIN_MATERIAL, STEEL
from mechwright_spur_gears.gear_table import AXIAL_GAP, CARRIER_WALL, GearTable

CARRIER = (0.62, 0.66, 0.62)
"""Colour."""


def carrier_parts(m: GearTable) -> list[Part]:
    """The carrier and its pins."""
    return [_carrier(m), _pin(m)]


def _carrier(m: GearTable) -> Part:
    given, away, pin = m.dimensions, float(m.distance), m.dimensions.pin_diameter
    depth, fit = given.carrier_thickness, hole_fit(pin, "P7")
    outer = Loop((circle((0.0, 0.0), away + pin / 2 + max(CARRIER_WALL, pin / 2)),))
    centres = [(away * math.cos(at), away * math.sin(at)) for at in m.places[0].tolist()]
    features: list[Feature] = [
        Bore(f"pin-{k}", centre, fit.middle, 0, depth, fit) for k, centre in enumerate(centres, start=1)
    ]
    holes = [Loop((circle(centre, fit.middle / 2),)).reversed() for centre in centres]
    opening = m.opening
    if opening is not None:
        holes.append(opening.loop())
        features.append(Bore("bore", (0.0, 0.0), given.bore, 0, depth))
        if opening.has_keyway:
            features.append(Profile("keyway", opening.loop(), "inside", 0, depth))
    features.append(Profile("outside", outer, "outside", 0, depth))
    place = Instance("carrier", -AXIAL_GAP - depth, CARRIER)
    return Part(
        "carrier", Outline(outer, tuple(holes)), depth, given.material, (place,), machined=tuple(features)
    )


def _pin(m: GearTable) -> Part:
    """From the underside of the carrier through a planet, with a head above it."""
    given, size = m.dimensions, m.dimensions.pin_diameter
    foot = -AXIAL_GAP - given.carrier_thickness
    steps = (
        Step(size, given.thickness + AXIAL_GAP - foot, shaft_fit(size, "h6")),
        Step(HEAD * size, HEAD_HEIGHT * size),
    )
    instances = tuple(Instance(f"pin-{k}", foot) for k in range(1, given.planets + 1))
    return Part("pin", None, 0.0, PIN_MATERIAL, instances, STEEL, turned=Turned(steps))
