"""Whether a linkage can be set from phase to phase, how, and whether its slots and clamps have room."""

import math
from collections.abc import Iterator
from itertools import combinations

import numpy as np

from mechwright import Array, Finding, KinematicsError, Procedure, Stage
from mechwright.contracts.finding import at_stage
from mechwright.mechanics.linkage.clamp import least_stud
from mechwright.mechanics.linkage.setting_findings import Turned, setting_order
from mechwright.tolerances import exceeds, falls_short
from mechwright_spherical.defaults.preferred_sizes import WALL
from mechwright_spherical.kinematics.vectors import arc
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.parts.seats import Seat, clamp_of, plate_of, seats_of, slot_width, slotted_of
from mechwright_spherical.table import SphericalTable

LONGEST_SLOT = 170.0
"""Degrees about the axis: a longer slot nearly cuts its middle out."""


def _setting(m: SphericalTable) -> Iterator[Finding]:
    """Whether the machine can be set, and in which order."""
    params, linkage = m.params, m.linkage
    if len(linkage.phases) == 1:
        return iter(())
    five = params.kind == "five-bar"
    follower = "rocker" if five else "output link"

    def pose() -> list[Turned]:
        seats, radius = seats_of(linkage), params.radius + params.hardware.standoff
        if not all(np.isfinite(place).all() for seat in seats for place in seat.places):
            said = params.four_bar.setting_angle
            raise KinematicsError(
                f"setting_angle: the links of phase 1 cannot be joined at the input angle {said:g}°; set the "
                "machine where they can"
            )
        first = linkage.phases[0]
        angles = [math.degrees(first.reference), 0.0]  # a five-bar's count from the pose of setting
        if first.four_bar is not None:
            angles[1] = math.degrees(float(first.four_bar.output_angle(first.reference)))
        return [
            Turned(
                seat.name, link, angle, radius * math.sin(float(arc(seat.axis, seat.places[0]))),
                seat.name in slotted_of(params),
            )
            for seat, link, angle in zip(seats, ("crank", follower), angles, strict=True)
        ]  # fmt: skip

    def steps(own: list[str]) -> tuple[str, ...]:
        if five:
            opened = "take the bevel gears out of mesh and hold the arm"
            return opened, own[0], "bring the gears into mesh again", own[1], "let the coupler go"
        return (*own, "let the coupler go")

    return setting_order(
        "spherical.setting",
        pose,
        None if five else params.four_bar.setting_angle,
        _turns(params, seats_of(linkage)),
        steps,
        table="five_bar." if five else "four_bar.",
        hold="hold the coupler",
    )


def _turns(params: SphericalParams, seats: tuple[Seat, Seat]) -> list[tuple[float, float]]:
    """Of crank and rocker from phase 1 to each further one, degrees."""
    if params.kind == "four-bar":
        return [(row.crank_turn, row.follower_turn) for row in params.four_bar.phases]
    return [
        (math.degrees(a), math.degrees(c)) for a, c in zip(*(seat.angles[1:] for seat in seats), strict=True)
    ]


def _slots(m: SphericalTable) -> Iterator[Finding]:
    """Openings of the coupler that come too near to each other, and the clamps."""
    params, seats, names = m.params, seats_of(m.linkage), slotted_of(m.params)
    if not any(len(seat.own) > 1 for seat in seats):
        return
    if names and m.bridge is not None:
        radius, boss = m.shells.links["coupler"][0], params.hardware.boss_diameter
        chord = min(seat.chord(radius) for seat in seats)
        yield Finding.error(
            "spherical.slot",
            "four_bar.phases",
            "between two arcs of the ground there is no way to the screws of a slot, and two places of a pin "
            f"are {chord:.4g} mm apart",
            chord,
            boss,
            "mm",
            f"set the phases so that they are {boss:g} mm apart, each with its bore, or keep crank and "
            "output link clear of each other with narrower links or a larger radius",
        )
        return
    yield from _apart(m, seats, names)
    if names:
        yield from _clamped(params, seats, names)


def _apart(m: SphericalTable, seats: tuple[Seat, Seat], names: tuple[str, ...]) -> Iterator[Finding]:
    params, hardware, clamp = m.params, m.params.hardware, clamp_of(m.params)
    bore = hardware.pin_diameter + hardware.fit
    around = slot_width(params) / 2 if clamp is None else clamp.reach
    point = m.linkage.phases[0].at_reference.p[0][:, :1]
    openings: list[tuple[str, Array, float]] = [("the path point", point, hardware.pin_diameter / 2)]
    for seat in seats:
        if seat.name in names:
            openings.append((f"the slot of pin {seat.name}", seat.points(), around))
        else:
            openings.append((f"a bore of pin {seat.name}", np.stack(seat.own, axis=1), bore / 2))
    radius = m.shells.links["coupler"][0]
    for (one, here, half), (two, there, other) in combinations(openings, 2):
        nearest = float(np.arccos(np.clip(np.einsum("in,im->nm", here, there), -1, 1)).min())
        apart, least = 2 * radius * math.tan(nearest / 2), half + other + WALL
        if falls_short(apart, least):
            yield Finding.error(
                "spherical.slot",
                "five_bar.c1n" if params.kind == "five-bar" else "four_bar.phases",
                f"{one} and {two} come as near as {apart:.4g} mm on the coupler and run into each other",
                apart,
                least,
                "mm",
                f"keep them {least:g} mm apart: use thinner pins or a larger radius",
            )


def _clamped(params: SphericalParams, seats: tuple[Seat, Seat], names: tuple[str, ...]) -> Iterator[Finding]:
    hardware, clamp = params.hardware, clamp_of(params)
    if clamp is None:
        least = least_stud()
        yield Finding.warning(
            "spherical.clamp",
            "hardware.pin_diameter",
            f"no screw clamps a pin of {hardware.pin_diameter:g} mm in a slot of a coupler "
            f"{plate_of(params):g} mm thick with bosses of {hardware.boss_diameter:g} mm: pins stay loose",
            hardware.pin_diameter,
            least,
            "mm",
            f"take pins of {least:g} mm or more, bosses of twice that, and links of 5 mm",
            Stage.PARTS,
            proposed=(
                {"parameters.hardware.pin_diameter": least},
                {
                    "parameters.hardware.pin_diameter": 6.0,
                    "parameters.hardware.boss_diameter": max(12.0, hardware.boss_diameter),
                    "parameters.hardware.link_thickness": 5.0,
                },
            ),
        )
        return
    for seat in seats:
        if seat.name not in names:
            continue
        if exceeds(math.degrees(seat.sweep), LONGEST_SLOT):
            yield Finding.error(
                "spherical.slot",
                "five_bar.phases" if params.kind == "five-bar" else "four_bar.phases",
                f"the slot of pin {seat.name} would go {math.degrees(seat.sweep):.4g}° about its axis",
                math.degrees(seat.sweep),
                LONGEST_SLOT,
                "deg",
                "set the phases nearer to each other, or use a larger radius, so that each has its bore",
            )
        yield Finding.note(
            "spherical.clamp",
            f"pin {seat.name} is set in a slot {clamp.width:g} mm wide and {math.degrees(seat.sweep):.4g}° "
            f"about its axis, clamped by an M{clamp.size.size:g} from inside, tightened with "
            f"{clamp.tightening:.3g} N m; it holds {clamp.holds:.4g} N by friction",
            clamp.holds,
            "N",
        )
    inwards = clamp.washer[1] + clamp.size.head_height
    if falls_short(hardware.standoff, inwards):
        yield Finding.warning(
            "spherical.clamp",
            "hardware.standoff",
            f"heads of the screws stand {inwards:g} mm out of the coupler, through the sphere of the path "
            "point",
            hardware.standoff,
            inwards,
            "mm",
            f"use a standoff of {inwards:g} mm or more",
        )


SETTING = Procedure[SphericalTable](("spherical.setting",), _setting, when=lambda t: t.single)
SLOTS = Procedure[SphericalTable](
    ("spherical.slot", "spherical.clamp"),
    lambda m: at_stage(Stage.PARTS, _slots(m)),
    when=lambda t: t.single,
    stage=Stage.PARTS,
)
"""Tables have linkages of one phase."""
