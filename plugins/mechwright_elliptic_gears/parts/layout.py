"""How the parts of a train stand over each other, and the sizes that a design leaves open.

From below: base plate, spacers, gears 2 and 3, spacer, gears 4 and 5, joint spacers, coupler, heads of the
pins. Height 0 is the upper side of the base plate. Shafts and dowels end flush with the gears they carry:
the next gear or the coupler sweeps over them.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from mechwright import kept
from mechwright.contracts.design_table import Rowwise, number
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.clamp import clamp_of
from mechwright_elliptic_gears.parts.dividing import Dividing, circle_for, placed
from mechwright_elliptic_gears.parts.gear import ellipse_of, rack_of
from mechwright_elliptic_gears.parts.keeper import Keeper, keeper_for

COUPLER_THICKNESS, BASE_THICKNESS = 6.0, 10.0
"""Thickness of coupler and base plate, mm: stock sizes."""

SPACER = 1.5
"""Outside of spacers over their shaft: a wall of a quarter of the shaft."""

HEAD, HEAD_HEIGHT = 1.5, 0.4
"""Head of a joint pin over its shank, as flat heads of clevis pins (ISO 2341) have it."""

EYE = 2.0
"""Outside of the coupler's eyes over the pin: the usual edge distance, a diameter from the hole's middle."""

AXIAL_PLAY = 0.1
"""Between coupler and the heads of its pins, mm, so that it turns freely."""

STUB = 2.0
"""How far the input's shaft stands out below the base plate, in bores: room for a shaft coupling."""

MARGIN = 2.0
"""Of the base plate around the shafts' axes, in bores: one and a half bores of wall."""

BEYOND = 8.0
"""From the teeth to the screws of a frame, mm: half the head of an M5, and 3 mm of air."""

OUTWARDS = (0.5, math.sqrt(0.75))
"""Direction from the axes of gears 2 and 5 to those screws: a base plate about half as wide as it is long."""

EDGE = 1.5
"""From a screw's middle to the edge of the plate, in its holes."""

FIXING = 0.55
"""Holes that fix the base plate, in bores: 6.6 mm, M6, at a shaft of 12 mm."""

DOWELS = {"dowel-1": 0.0, "dowel-2": math.pi / 2, "dowel-3": 7 * math.pi / 6}
"""Bodies of the dowels and their directions on gear 3, rad. All three steps differ, so that gears 3 and 4 go
together in one way only, and not turned over."""

DOWEL_STRENGTH = 355.0
"""Shear stress, MPa, at which a hardened dowel breaks."""

PHASE_PIN = "phase-pin"
"""Part and body of the pin of a dividing circle. Its head lies on gear 4."""

PIN_KEEPER = "pin-keeper"
"""Part and body of what keeps that pin down."""

PIN_HEAD = 0.5
"""Height of its head in gaps: the coupler passes over it."""

DOWEL_GAP = 0.5
"""Between dowels and spacer, mm."""


@dataclass(frozen=True)
class Layout(Rowwise):
    """Sizes and heights of a train, mm.

    Parameters
    ----------
    semi_major, eccentricity
        Of the pitch ellipses.
    thickness
        Of the gears.
    bore, gap, pin, coupler, tracer, base, dowel, dowel_circle
        As the design says, or their defaults.
    crown
        From gears 4 and 5 to the coupler.
    stub_diameter, stub
        Of the input's shaft below the base plate, and its length.
    """

    semi_major: float
    eccentricity: float
    thickness: float
    bore: float
    gap: float
    pin: float
    coupler: float
    tracer: float
    base: float
    dowel: float
    dowel_circle: float
    crown: float
    stub_diameter: float
    stub: float

    @property
    def lower(self) -> float:
        """Underside of gears 2 and 3."""
        return self.gap

    @property
    def upper(self) -> float:
        """Underside of gears 4 and 5."""
        return self.lower + self.thickness + self.gap

    @property
    def link(self) -> float:
        """Underside of the coupler."""
        return self.upper + self.thickness + self.crown

    @property
    def spacer(self) -> float:
        """Outer diameter of the spacers on the shafts."""
        return SPACER * self.bore

    @property
    def eye(self) -> float:
        """Radius of the coupler's ends."""
        return EYE * self.pin / 2

    @property
    def focus(self) -> float:
        """From a gear's axis to its joint: 2 a e."""
        return 2 * self.semi_major * self.eccentricity


@kept
def layout_of(params: EllipticGearParams) -> Layout:
    """The layout of a train."""
    return sized_layout(params, ellipse_of(params).semi_major, lambda of: of(params))


def sized_layout(
    given: Any, semi_major: Any, each: Callable[[Callable[[EllipticGearParams], float]], Any]
) -> Layout:
    """The layout of a design, or of designs whose numbers are columns.

    ``each`` gives what follows from the parameters of one design alone.
    """
    bore, gap = given.bore, given.spacing
    pin = _or(given.pin_diameter, _stock_size(bore / 2))
    dowel = _or(given.dowel_diameter, _stock_size(bore / 3))
    pinned = given.phase_joint == "pins"
    return Layout(
        semi_major,
        given.eccentricity,
        given.thickness,
        bore,
        gap,
        pin,
        _or(given.coupler_thickness, COUPLER_THICKNESS),
        _or(given.tracer_diameter, pin),
        _or(given.base_thickness, BASE_THICKNESS),
        dowel,
        _or(given.dowel_circle, each(_pin_circle) if pinned else _spacer_circle(bore, dowel)),
        each(_crown) if given.adjustable else gap,
        _or(given.stub_diameter, bore),
        _or(given.stub_length, STUB * bore),
    )


def screw_offset_of(params: EllipticGearParams) -> float:
    """Of the screws of a frame from the axes of gears 2 and 5, mm."""
    ellipse = ellipse_of(params)
    reach = ellipse.semi_major * (1 + params.eccentricity) + rack_of(params).addendum
    found: float = _or(params.screw_offset, math.ceil(reach + BEYOND))
    return found


def screw_places(params: EllipticGearParams) -> tuple[complex, ...]:
    """Where screws of a frame go through the base plate, x + i y, mm; none without their holes."""
    if params.screw_hole is None:
        return ()
    out, reach = screw_offset_of(params), 2 * ellipse_of(params).semi_major
    x, y = reach + OUTWARDS[0] * out, OUTWARDS[1] * out
    return tuple(complex(a * x, b * y) for a in (-1, 1) for b in (-1, 1))


def _or(value: Any, default: Any) -> Any:
    return default if value is None else value


def _spacer_circle(bore: Any, dowel: Any) -> Any:
    """Diameter of the circle of dowels, mm: as small as the spacer allows."""
    return number(np.ceil(SPACER * bore + dowel + 2 * DOWEL_GAP))


def _pin_circle(params: EllipticGearParams) -> float:
    """That of the holes of a dividing circle."""
    if params.dowel_circle is not None:
        return params.dowel_circle
    dowel = _or(params.dowel_diameter, _stock_size(params.bore / 3))
    return circle_for(params, dowel, _spacer_circle(params.bore, dowel))


def clamp_screws(params: EllipticGearParams) -> tuple[str, ...]:
    """Bodies of the clamp's screws."""
    return tuple(f"clamp-screw-{number}" for number in range(1, clamp_of(params).screws + 1))


def _crown(params: EllipticGearParams) -> float:
    """From gear 4 to the coupler, mm: what sets the phase stands there."""
    if params.phase_joint == "clamp":
        return max(params.spacing, clamp_of(params).crown)
    keeper = _keeper(params)
    return max(params.spacing, 0.0 if keeper is None else keeper.crown)


@kept
def _keeper(params: EllipticGearParams) -> Keeper | None:
    if params.phase_joint != "pins":
        return None
    dowel = _or(params.dowel_diameter, _stock_size(params.bore / 3))
    dividing = placed(params.set_phases, params.eccentricity, dowel, _pin_circle(params) / 2)
    return keeper_for(params, dividing, (HEAD * dowel, PIN_HEAD * params.spacing))


def keeper_of(params: EllipticGearParams) -> Keeper | None:
    """What keeps the pin of a dividing circle down; None without such a pin, or without room."""
    return _keeper(params)


def joining_bodies(params: EllipticGearParams) -> tuple[str, ...]:
    """Bodies that join gears 3 and 4, beside keys."""
    if params.phase_joint == "pins":
        return (PHASE_PIN,) if keeper_of(params) is None else (PHASE_PIN, PIN_KEEPER)
    if params.phase_joint == "clamp":
        return clamp_screws(params)
    return tuple(DOWELS) if params.dowelled else ()


@kept
def dividing_of(params: EllipticGearParams) -> Dividing:
    """The holes of a train whose phase a pin sets; what has no place is left out and named."""
    layout = layout_of(params)
    return placed(params.set_phases, params.eccentricity, layout.dowel, layout.dowel_circle / 2)


def _stock_size(diameter: Any) -> Any:
    """Rounded to half a millimetre, at least that."""
    return number(np.maximum(0.5, np.round(2 * np.asarray(diameter)) / 2))
