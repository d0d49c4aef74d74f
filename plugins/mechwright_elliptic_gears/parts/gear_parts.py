"""All parts of a design. Gears: which are alike, where their keyways stand, and which holes they have.

Marks on gears: which tooth meets which space as the driver's far vertex is on the line of centres.
"""

import math
from collections.abc import Collection
from dataclasses import dataclass

import numpy as np

from mechwright import (
    Bore,
    Colour,
    Feature,
    FittingMark,
    Instance,
    Loop,
    Measure,
    Outline,
    Part,
    Point,
    Profile,
    circle,
    kept,
)
from mechwright.arrays import Array
from mechwright.contracts.axial_stack import AxialStack
from mechwright.contracts.details import Detail
from mechwright.contracts.fits import Fit
from mechwright.mechanics.gearing import gear_data, gear_measures, tip_sites
from mechwright.mechanics.gearing.usual import DOT
from mechwright.mechanics.openings import keyway_measures, opening_of
from mechwright_elliptic_gears.kinematics.equations import phase_offset
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.bushes import bush_parts, bush_seat
from mechwright_elliptic_gears.parts.clamp import clamp_of
from mechwright_elliptic_gears.parts.clamp_parts import (
    clamp_plates,
    clamp_screw_part,
    core_of,
    scale,
    screw_holes,
    threads,
)
from mechwright_elliptic_gears.parts.dividing import START
from mechwright_elliptic_gears.parts.gear import ellipse_of, outline_of, rack_of, teeth_of
from mechwright_elliptic_gears.parts.layout import DOWELS, Layout, dividing_of, keeper_of, layout_of
from mechwright_elliptic_gears.parts.plates import base_part, coupler_part
from mechwright_elliptic_gears.parts.retainers import disc_parts, discs_of, keep_of
from mechwright_elliptic_gears.parts.turned import input_shaft, keeper_parts, round_parts


def gear_marks(
    params: EllipticGearParams, name: str, bodies: Collection[str], key: float | None
) -> tuple[FittingMark, ...]:
    """One dot under the tooth with which a gear drives, two about the space in which it is driven.

    A part whose copies do both has both. ``key`` is the direction of the keyway, rad.
    """
    tooth, space = meeting_teeth(params)
    drivers = {"gear-2"} if params.stages == 1 else {"gear-2", "gear-4"}
    marks = []
    if drivers & set(bodies):
        marks.append(
            FittingMark(
                f"Where {name} drives, its one dot goes between the two dots of the gear that it drives, "
                "once a turn.",
                (tooth,),
            )
        )
    if set(bodies) - drivers:
        marks.append(
            FittingMark(
                f"Where {name} is driven, the one dot of its driver goes between its two dots.", space
            )
        )
    if key is not None:
        angle = math.degrees(key) % 360
        marks.append(
            FittingMark(
                f"The keyway of {name} stands at {angle:.1f}° to its long axis, counted from its far vertex."
            )
        )
    return tuple(marks)


def meeting_teeth(params: EllipticGearParams) -> tuple[Point, tuple[Point, Point]]:
    """The dot of a driving gear, and those of the driven one, in the frame that all gears share, mm.

    With the far vertex of the driver on the line of centres, its tooth nearest to that line stands in the
    space of its mate between the two teeth nearest to it.
    """
    tips = _tips(params)
    apart = 2 * ellipse_of(params).semi_major
    driver = int(np.argmin(np.abs(np.angle(tips))))
    there = tips[driver] - apart  # the same place, seen from the mate, which stands unturned
    away = np.abs(np.angle(tips / there))
    one, two = np.argsort(away)[:2]
    dots = _below(tips, params)
    first, second = sorted((int(one), int(two)))
    return dots[driver], (dots[first], dots[second])


def _tips(params: EllipticGearParams) -> Array:
    """Middles of all tips (z,), x + i y, mm."""
    places = [segment.at(0.5)[0] for segment in outline_of(params).outer.segments if segment.tag == "tip"]
    return np.array([complex(x, y) for x, y in places])


def _below(tips: Array, params: EllipticGearParams) -> list[Point]:
    """A place under each tooth."""
    rack = rack_of(params)
    deep = rack.addendum + rack.dedendum + DOT
    inwards = tips * (1 - deep / np.abs(tips))
    return [(round(float(at.real), 4), round(float(at.imag), 4)) for at in inwards]


COLOURS: dict[str, Colour] = {
    "gear-2": (0.45, 0.58, 0.70),
    "gear-3": (0.62, 0.74, 0.60),
    "gear-4": (0.80, 0.68, 0.42),
    "gear-5": (0.66, 0.56, 0.72),
}
"""Body of each gear to its colour."""


@dataclass(frozen=True)
class Gear:
    """One gear part.

    Parameters
    ----------
    name
        Of the part.
    bodies
        Each copy's body in the motion, and the height of its underside, mm.
    key
        Direction of the keyway from the far vertex, counter-clockwise seen from above, rad; None without one.
    holes
        Holes beside the bore.
    seat
        Limits of the bore where it is not that of the shaft.
    details
        Threads and engraved lines.
    """

    name: str
    bodies: tuple[tuple[str, float], ...]
    key: float | None = None
    holes: tuple[Bore, ...] = ()
    seat: Fit | None = None
    details: tuple[Detail, ...] = ()


@kept
def gears_of(params: EllipticGearParams) -> tuple[Gear, ...]:
    """The gear parts of a design.

    A single pair has one part twice. In a train gears 2 and 3 are alike if a key holds them, gear 4 has its
    keyway -φ from its far vertex, so that it comes to θ3 + φ on the key of gear 3, and gear 5 idles on its
    shaft. Without a key three dowels join gear 3 to gear 4, whose holes are turned by -φ in the same way.

    Where a pin sets the phase, gear 3 has a hole for each, gear 4 one on each circle; both idle on their
    shaft, and a key holds gear 2 alone.
    """
    key = 0.0 if params.keyway_width > 0 else None
    phase = params.phase_angle
    if phase is None:
        return (Gear("gear", (("gear-2", 0.0), ("gear-4", 0.0)), key),)
    layout = layout_of(params)
    low, high = layout.lower, layout.upper
    back = -phase_offset(phase, params.eccentricity) % math.tau
    joint = Bore("joint", (layout.focus, 0.0), layout.pin, 0, layout.thickness)
    seat = bush_seat(params, params.thickness)
    last = Gear("gear-5", (("gear-5", high),), None, (joint,), seat)
    if params.phase_joint == "pins":
        keeper = keeper_of(params)
        held = () if keeper is None else (keeper.hole(layout.thickness),)
        threaded = () if keeper is None else (keeper.thread(layout.thickness),)
        return (
            Gear("gear-2", (("gear-2", low),), key),
            Gear("gear-3", (("gear-3", low),), None, _dividing_holes(params), seat),
            Gear("gear-4", (("gear-4", high),), None, (joint, *_pin_holes(params), *held), seat, threaded),
            last,
        )
    if params.phase_joint == "clamp":
        clamp = clamp_of(params)
        drilled = screw_holes(clamp, core_of(clamp), layout.thickness)
        return (
            Gear("gear-2", (("gear-2", low),), key),
            Gear("gear-3", (("gear-3", low),), None, drilled, seat, threads(params)),
            Gear("gear-4", (("gear-4", high),), None, (joint,), clamp.seat, (scale(params),)),
            last,
        )
    if key is not None:
        return (
            Gear("gear", (("gear-2", low), ("gear-3", low)), key),
            Gear("gear-4", (("gear-4", high),), back, (joint,)),
            last,
        )
    return (
        Gear("gear-2", (("gear-2", low),)),
        Gear("gear-3", (("gear-3", low),), None, _dowel_holes(layout, 0.0)),
        Gear("gear-4", (("gear-4", high),), None, (joint, *_dowel_holes(layout, back))),
        last,
    )


def _dowel_holes(layout: Layout, turn: float) -> tuple[Bore, ...]:
    radius = layout.dowel_circle / 2
    return tuple(
        Bore(
            name,
            (radius * math.cos(angle + turn), radius * math.sin(angle + turn)),
            layout.dowel,
            0,
            layout.thickness,
        )
        for name, angle in DOWELS.items()
    )


def _dividing_holes(params: EllipticGearParams) -> tuple[Bore, ...]:
    """Holes of gear 3, named by their phases in degrees."""
    dividing = dividing_of(params)
    return tuple(
        _fitted(params, f"phase-{hole.phase:g}".replace(".", "_"), dividing.centre(hole))
        for hole in dividing.holes
    )


def _pin_holes(params: EllipticGearParams) -> tuple[Bore, ...]:
    """Holes of gear 4, one on each circle."""
    return tuple(
        _fitted(params, f"pin-{number}", complex(radius * math.cos(START), radius * math.sin(START)))
        for number, radius in enumerate(dividing_of(params).rings, start=1)
    )


def _fitted(params: EllipticGearParams, name: str, centre: complex) -> Bore:
    size = dividing_of(params).hole_size
    return Bore(name, (centre.real, centre.imag), size.middle, 0, params.thickness, size)


def gear_opening(params: EllipticGearParams, gear: Gear) -> Loop | None:
    """The gear's shaft opening, clockwise, in its part frame; None without a bore."""
    opening = opening_of(params)
    if opening is None:
        return None
    if gear.key is None:
        bore = opening.bore if gear.seat is None else gear.seat.middle
        return Loop((circle((0.0, 0.0), bore / 2, clockwise=True, tag="bore"),))
    return opening.loop().moved(0.0, 0.0, gear.key)


@kept
def measures_of(params: EllipticGearParams) -> tuple[Measure, ...]:
    """Over pins across the middle of the ellipse, the axis being its focus."""
    return gear_measures(teeth_of(params), (ellipse_of(params).focal_distance, 0.0))


def gear_part(params: EllipticGearParams, gear: Gear) -> Part:
    """The gear with its features: bore, keyway, holes, then the outside, which tabs may hold at the tips."""
    whole, depth = outline_of(params), params.thickness
    inner: list[Loop] = []
    features: list[Feature] = []
    opening = gear_opening(params, gear)
    if opening is not None:
        inner.append(opening)
        bore = params.bore if gear.seat is None else gear.seat.middle
        features.append(Bore("bore", (0.0, 0.0), bore, 0, depth, gear.seat))
        if gear.key is not None:
            features.append(Profile("keyway", opening, "inside", 0, depth))
    features += gear.holes
    for hole in gear.holes:
        inner.append(Loop((circle(hole.centre, hole.diameter / 2, clockwise=True, tag=hole.name),)))
    features.append(Profile("outside", whole.outer, "outside", 0, depth, tip_sites(whole.outer)))
    return Part(
        gear.name,
        Outline(whole.outer, tuple(inner), whole.deviation),
        depth,
        params.material,
        instances=tuple(Instance(body, z, COLOURS[body]) for body, z in gear.bodies),
        machined=tuple(features),
        details=gear.details,
        marks=gear_marks(params, gear.name, [body for body, _ in gear.bodies], gear.key),
        measures=(*measures_of(params), *(() if gear.key is None else keyway_measures(opening_of(params)))),
        data=(
            *gear_data(teeth_of(params)),
            ("ellipse, semi-axis", f"{ellipse_of(params).semi_major:.6g}"),
            ("eccentricity", f"{params.eccentricity:.4g}"),
        ),
        vacant=tuple(hole.name for hole in gear.holes) if params.phase_joint == "pins" else (),
    )


def parts_of(params: EllipticGearParams) -> tuple[Part, ...]:
    """The gears; of a train also its coupler, base plate and round parts. ``check`` has found no error."""
    gears = tuple(gear_part(params, gear) for gear in gears_of(params))
    if params.stages == 1:
        return gears
    layout, opening = layout_of(params), opening_of(params)
    assert opening is not None  # noqa: S101 - a train has a bore
    plates: tuple[Part, ...] = (coupler_part(params, layout), base_part(params, layout))
    pin = dividing_of(params).pin_size if params.phase_joint == "pins" else None
    discs, keep = discs_of(params, layout), keep_of(params, layout)
    turned = round_parts(
        layout,
        opening,
        keyed=params.keyed_phase,
        dowelled=params.dowelled,
        phase_pin=pin,
        discs=discs,
        keep=keep,
    )
    turned += tuple(disc_parts(discs, layout))
    if keep is not None:
        turned += tuple(keep.parts(layout))
    if params.phase_joint == "clamp":
        plates += clamp_plates(params, layout)
        turned += (clamp_screw_part(params, layout),)
    if (keeper := keeper_of(params)) is not None:
        turned += keeper_parts(keeper, layout)
    return (*gears, *plates, *turned, *bush_parts(params, layout))


def stacks_of(params: EllipticGearParams) -> tuple[AxialStack, ...]:
    """The axial stacks of a train; none of a pair, whose shafts are a frame's."""
    if params.stages == 1:
        return ()
    layout, opening = layout_of(params), opening_of(params)
    keep, seat = keep_of(params, layout), opening if opening is not None and opening.has_keyway else None
    found = [disc.stack() for disc in discs_of(params, layout)]
    if keep is not None:
        found.append(keep.stack(layout, input_shaft(layout, seat, keep)))
    return tuple(found)
