"""What must hold before anything of a design can be computed: the law and the angles."""

import math
from collections.abc import Iterator

from mechwright import Finding, Stage, kept, of_stage
from mechwright.contracts.finding import Change, errors
from mechwright.mechanics.laws.faults import LawFault, polynomial_faults, table_faults
from mechwright.tolerances import exceeds, falls_short
from mechwright_geneva.driver import driver_of
from mechwright_geneva.mechanism import frame_of
from mechwright_geneva.params import GenevaParams, Sizes
from mechwright_geneva.sizes import sized
from mechwright_geneva.sound import LEAST_LOCKED

LEAST_FLOOR = 0.5
"""Least depth of a groove and length of a roller, mm."""

ANGLE_SLACK = 1e-6
"""Degrees by which the angles of a straight slot may be off: rounding of the design file."""

LENGTH_SLACK = 1e-3
"""mm by which a centre distance may be off that is given besides what tells it: decimals of a drawing."""

FLATTEST = 1.0
"""Degrees that W + θd0/2 stays below 90, and W above 0: beyond, the slot's bottom is on the wheel's axis, or
the crank has no length."""


@kept
def feasibility(params: GenevaParams) -> tuple[Finding, ...]:
    """Errors that leave nothing to compute."""
    found = list(_law(params))
    if not errors(found):
        sizes = sized(params)
        found += _straight(sizes) if params.law == "straight" else _angles(sizes)
        found += [*_centres(params), *_rollers(sizes), *_driver(sizes), *_floor(sizes)]
    return tuple(found)


def _law(params: GenevaParams) -> Iterator[Finding]:
    faults: Iterator[LawFault] = iter(())
    if params.law == "polynomial":
        faults = polynomial_faults(params.polynomial or ())
    elif params.law == "table":
        faults = table_faults(params.table or ())
    for fault in faults:
        yield Finding.error(
            "geneva.law",
            params.law,
            fault.message,
            fault.value,
            fault.limit,
            remedy=f"{fault.remedy}, or take the nearest law that is one, as proposed",
            proposed=tuple(_laws_instead(params)),
        )


def _laws_instead(params: GenevaParams) -> Iterator[Change]:
    """Laws near to a table or polynomial that is none, the nearest first."""
    from mechwright.mechanics.laws.mended import instead, rows_of

    rows = params.table if params.law == "table" else rows_of(params.polynomial or ())
    for law, table in instead(rows or ()):
        found = None if table is None else [list(row) for row in table]
        yield {
            f"parameters.{params.law}": None,
            "parameters.law": law,
            **({} if found is None else {"parameters.table": found}),
        }


def _driver(params: Sizes) -> Iterator[Finding]:
    """A driver that slows down and stops before its turn is over."""
    driver = driver_of(params, math.radians(params.crank_half_angle))
    stops, given = driver.stops(), params.driver_acceleration
    if stops is not None and given is not None and not exceeds(stops, math.tau):
        least = driver.speed**2 / (2 * math.tau)
        faster = math.sqrt(-2 * given * math.tau) * 60 / math.tau
        yield Finding.error(
            "geneva.driver-stops",
            "driver_acceleration",
            f"the driver stands still after {math.degrees(stops):.4g} degrees of its turn",
            given,
            -least,
            "rad/s^2",
            f"keep driver_acceleration above {-math.floor(least * 1e4) / 1e4:g}, or begin with more than "
            f"{math.ceil(faster * 10) / 10:g} rev/min",
        )


def _straight(params: Sizes) -> Iterator[Finding]:
    wanted = 90 - 180 / params.slots
    if abs(params.crank_half_angle - wanted) > ANGLE_SLACK:
        yield Finding.error(
            "geneva.straight",
            "crank_half_angle",
            f"a straight slot turns the crank by {wanted:g} degrees on either side",
            params.crank_half_angle,
            wanted,
            "deg",
            f"use crank_half_angle = {wanted:g}, leave it out, or choose another law",
        )
    if params.offset_angle != 0:
        yield Finding.error(
            "geneva.straight",
            "offset_angle",
            "a straight slot has one mouth",
            params.offset_angle,
            0.0,
            "deg",
            "use offset_angle = 0, leave it out, or choose another law",
        )


def _centres(params: GenevaParams) -> Iterator[Finding]:
    """Wheel and angles tell the distance of the axes: one that is given as well has to agree.

    Angles that leave no crank tell none; they are refused for themselves.
    """
    if params.centre_distance is None:
        return
    sizes = sized(params)
    axes = float(frame_of(sizes).axes)
    if axes <= 0 or abs(axes - params.centre_distance) <= LENGTH_SLACK:
        return
    wheel = sizes.entry_radius * params.centre_distance / axes
    cure = f"use centre_distance = {axes:.4f}, or leave it out"
    if 5 <= wheel <= 1000 and params.entry_radius is not None:
        cure = f"use entry_radius = {wheel:.4f} or leave it out, or {cure}"
    yield Finding.error(
        "geneva.centre-distance",
        "centre_distance",
        f"a wheel of {sizes.entry_radius:g} mm whose slots turn the crank by {2 * sizes.crank_half_angle:g} "
        f"degrees stands {axes:.4f} mm from the driver",
        params.centre_distance,
        axes,
        "mm",
        cure,
    )


def _angles(params: Sizes) -> Iterator[Finding]:
    frame = frame_of(params)
    entry, half = math.degrees(frame.entry_angle), math.degrees(frame.crank_half)
    reach = entry + half / 2
    limit = 90 - FLATTEST
    if exceeds(reach, limit):
        wheel = math.degrees(frame.wheel_half)
        most, offset = 2 * (limit - entry), limit - half / 2 - wheel
        cures = []
        if most >= 5:
            cures.append(f"make crank_half_angle at most {math.floor(most * 100) / 100:g}")
        cures.append(f"make offset_angle at most {math.floor(offset * 100) / 100:g}")
        yield Finding.error(
            "geneva.angles",
            "crank_half_angle",
            f"180/n + offset_angle + crank_half_angle/2 is {reach:.4g} degrees: the slot's bottom would be "
            + ("on" if reach < 90 else "beyond")
            + " the wheel's axis",
            reach,
            limit,
            "deg",
            ", or ".join(cures),
            Stage.MOTION if reach == 90 else Stage.PARTS,  # through the axis itself no force has a lever
        )
    elif falls_short(entry, FLATTEST):
        yield Finding.error(
            "geneva.angles",
            "offset_angle",
            f"180/n + offset_angle is {entry:.4g} degrees: nothing is left of the crank",
            entry,
            FLATTEST,
            "deg",
            f"make offset_angle at least {FLATTEST - 180 / params.slots:g}",
            Stage.PARTS if entry > 0 else Stage.MOTION,
        )


def _rollers(params: Sizes) -> Iterator[Finding]:
    half = math.degrees(frame_of(params).crank_half)
    turn = 360 / params.rollers
    locked = turn - 2 * half
    least = math.degrees(LEAST_LOCKED)
    if locked >= least - ANGLE_SLACK:
        return
    most = max(1, math.floor(360 / (2 * half + least)))
    cure = f"make crank_half_angle at most {math.floor((turn - least) * 50) / 100:g}"
    yield Finding.error(
        "geneva.rollers",
        "rollers",
        f"{params.rollers} rollers, {turn:g} degrees apart, leave {locked:.4g} degrees of the crank's "
        f"turn to lock the wheel between strokes of {2 * half:g} degrees",
        locked,
        least,
        "deg",
        cure if params.rollers == most else f"use at most {most} rollers, or {cure}",
        Stage.PARTS if locked >= 0 else Stage.MOTION,  # strokes that do not overlap can be run
    )


@of_stage(Stage.PARTS)
def _floor(params: Sizes) -> Iterator[Finding]:
    length = params.roller_length
    if params.slots_made != "through" and length < LEAST_FLOOR:
        most = params.thickness - params.axial_gap - LEAST_FLOOR
        yield Finding.error(
            "geneva.floor",
            "floor",
            f"a floor of {params.floor:g} mm and a gap of {params.axial_gap:g} mm leave "
            f"{length:.3g} mm of the wheel's {params.thickness:g} mm for the rollers",
            params.floor,
            most,
            "mm",
            f"make floor at most {math.floor(most * 100) / 100:g}"
            if most >= 0.2
            else "make thickness larger, or axial_gap smaller",
        )
