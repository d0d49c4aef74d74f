"""Whether links, pins, drive, stand and strips have room."""

import math
from collections.abc import Iterator

import numpy as np

from mechwright import Finding, Severity, Stage, kept
from mechwright.contracts.finding import at_stage
from mechwright.tolerances import exceeds, falls_short
from mechwright_spherical.defaults.preferred_sizes import WALL, least_boss, told
from mechwright_spherical.kinematics.clearances import Approach, approaches
from mechwright_spherical.kinematics.drive import Train, internal, train_of
from mechwright_spherical.kinematics.linkage import Linkage, linkage_of
from mechwright_spherical.kinematics.vectors import arc
from mechwright_spherical.parameters import MOST_RADIUS, SphericalParams
from mechwright_spherical.parts.frame import (
    AIR,
    bridge_rooms,
    frame_of,
    ground_arcs,
    ground_beyond,
    shells_of,
)
from mechwright_spherical.parts.places import gear_span, link_arcs
from mechwright_spherical.parts.seats import seats_of, slotted_of
from mechwright_spherical.parts.shells import Shells
from mechwright_spherical.parts.stand import MOUNTING_SCREWS, flange_diameter
from mechwright_spherical.parts.strips import strip_findings
from mechwright_spherical.rules.mount_checks import mount_findings
from mechwright_spherical.rules.setting_checks import slot_findings


def clear_radius(diameter: float, angle: float) -> float:
    """Radius, mm, outside which two radial cylinders of one diameter, ``angle`` rad apart, do not touch.

    >>> round(clear_radius(12, math.radians(9.704142066385073)), 6)
    70.681672
    >>> clear_radius(12, 0.0)
    inf
    """
    return diameter / 2 / math.tan(angle / 2) if angle > 0 else math.inf


def hardware_findings(params: SphericalParams) -> Iterator[Finding]:
    """All of them, and the sizes that were chosen."""
    yield from hardware_found(params)
    yield from told(params)


@kept
def hardware_found(params: SphericalParams) -> tuple[Finding, ...]:
    """All of them, whether sizes are given or chosen."""
    return tuple(at_stage(Stage.PARTS, hardware_seeking(params)))


def hardware_seeking(params: SphericalParams) -> Iterator[Finding]:
    """The same, each as it is found: who asks for the first error need not wait for the rest."""
    linkage, shells = linkage_of(params), shells_of(params)
    yield from _bosses(params, shells)
    yield from _shafts(params, linkage, shells)
    yield from _sideways(params, linkage, shells)
    yield from slot_findings(params)
    yield from _drive(params, linkage, shells)
    yield from _stand(params, linkage, shells)
    yield from mount_findings(params)
    yield from strip_findings(params, linkage, shells)


def _bosses(params: SphericalParams, shells: Shells) -> Iterator[Finding]:
    hardware = params.hardware
    least = least_boss(hardware.pin_diameter, hardware.fit)
    if falls_short(hardware.boss_diameter, least):
        yield Finding.error(
            "spherical.boss",
            "hardware.boss_diameter",
            f"bosses of {hardware.boss_diameter:g} mm leave less than {WALL:g} mm around the bores",
            hardware.boss_diameter,
            least,
            "mm",
            f"make them {least:g} mm at least, or the pins thinner",
        )
    half = hardware.boss_diameter / 2
    # The flat end of a boss reaches further out at its rim than in its middle; outer shells matter less.
    rise = math.hypot(shells.inside[1], half) - shells.inside[1]
    if hardware.gap <= rise:
        yield Finding.error(
            "spherical.gap",
            "hardware.gap",
            f"the rims of flat bosses of {hardware.boss_diameter:g} mm stand {rise:.3f} mm over their shell "
            f"and rub in a gap of {hardware.gap:g} mm",
            hardware.gap,
            rise,
            "mm",
            f"use more than {rise:.3f} mm, smaller bosses, or a larger radius",
        )


def _shafts(params: SphericalParams, linkage: Linkage, shells: Shells) -> Iterator[Finding]:
    hardware = params.hardware
    bored = hardware.pin_diameter + hardware.fit + WALL
    pairs: list[tuple[str, float, float, str]] = []
    for phase in linkage.phases:
        coupler = math.acos(float(phase.loop.ca))
        said = f"pins a and c of phase {phase.number}" if len(linkage.phases) > 1 else "pins a and c"
        pairs.append((said, coupler, hardware.boss_diameter + AIR, "crank"))
    names = {
        "ground": "both fixed axes",
        "crank": "the pins of the crank",
        "rocker": "the pins of the rocker",
    }
    names["arm"] = "the pins of the arm"
    arcs = link_arcs(linkage)
    if frame_of(params).bridge is not None:
        del arcs["ground"]  # the fixed axes have shells of their own
        pairs += [
            ("a fixed axis and the bridge", angle, hardware.boss_diameter + AIR, link)
            for link, angle in ground_arcs(params).items()
        ]
    pairs += [(names[link], angle, bored, link) for link, angle in arcs.items()]
    point = linkage.phases[0].at_reference.p[0][:, 0]
    for seat in seats_of(linkage):
        if seat.name not in slotted_of(params):  # those of a slot are looked at with it
            pairs += [
                (f"tool and pin {seat.name}", float(arc(point, place)), bored, "coupler")
                for place in seat.own
            ]
    for said, angle, diameter, link in pairs:
        needed, there = clear_radius(diameter, angle), shells.links[link][0]
        if needed - there > MOST_RADIUS - params.radius:
            key = "four_bar.point_azimuth" if params.kind == "four-bar" else "five_bar.point"
            tool = said.startswith("tool")
            yield Finding.error(
                "spherical.shafts",
                key if tool else "radius",
                f"{said} are {math.degrees(angle):.4g}° apart, and {diameter:g} mm do not fit side by side "
                f"on any sphere up to {MOST_RADIUS:g} mm",
                math.degrees(angle),
                math.degrees(2 * math.atan(diameter / 2 / there)),
                "deg",
                "move the path point away from the pin" if tool else "use longer arcs, or smaller pins",
            )
        elif exceeds(needed, there):
            # The shells move outwards with the sphere.
            radius = math.ceil(10 * (params.radius + needed - there)) / 10
            yield Finding.error(
                "spherical.shafts",
                "radius",
                f"{said} are {math.degrees(angle):.4g}° apart, and {diameter:g} mm do not fit side by side "
                f"at {there:.4g} mm from the centre",
                params.radius,
                radius,
                "mm",
                f"use a radius of {radius:g} mm or more, smaller pins and bosses, or a shorter projection",
            )


def _sideways(params: SphericalParams, linkage: Linkage, shells: Shells) -> Iterator[Finding]:
    bridge = frame_of(params).bridge
    if bridge is not None:
        yield from _around(params, linkage, shells, bridge)
        return
    found = list(approaches(params, linkage, shells))
    for near in found:
        if falls_short(near.room, AIR):
            yield _collision(params, linkage, near)
    tightest = min(found, key=lambda near: near.room)
    if not falls_short(tightest.room, AIR):
        one, two = tightest.bodies
        yield Finding(
            "spherical.clearance",
            Severity.NOTE,
            "hardware",
            f"{one} and {two} come nearest, {tightest.room:.3g} mm{_when(linkage, tightest)}",
            tightest.room,
            AIR,
            "mm",
        )


def _around(params: SphericalParams, linkage: Linkage, shells: Shells, bridge: float) -> Iterator[Finding]:
    """Of a ground on both sides: shells that come too near to the centre, and where the bridge stands."""
    low = shells.pins["a0"][0]
    least = params.hardware.boss_diameter
    if low < least:
        radius = math.ceil(10 * (params.radius + least - low)) / 10
        yield Finding.error(
            "spherical.centre",
            "radius",
            f"the ground's inner arc leaves {low:.4g} mm about the centre, where bosses and shaft meet",
            params.radius,
            radius,
            "mm",
            f"use a radius of {radius:g} mm or more, or thinner links",
        )
    rooms = bridge_rooms(params, linkage, shells, bridge)
    name = min(rooms, key=lambda link: float(rooms[link].min()))
    at = float(linkage.shown.sweep(rooms[name].size)[int(np.argmin(rooms[name]))])
    yield Finding.note(
        "spherical.clearance",
        f"the ground is on both sides, its bridge {math.degrees(bridge):.4g}° from the input axis; the "
        f"{name} comes nearest to it, {rooms[name].min():.3g} mm, at the input angle {math.degrees(at):.4g}°",
        float(rooms[name].min()),
        "mm",
    )


def _when(linkage: Linkage, near: Approach) -> str:
    phase = f" of phase {near.phase}" if len(linkage.phases) > 1 else ""
    return f", at the input angle {math.degrees(near.angle):.4g}°{phase}"


def _collision(params: SphericalParams, linkage: Linkage, near: Approach) -> Finding:
    one, two = near.bodies
    other = params.kind == "four-bar" and params.hardware.frame == "one"
    verb = (
        f"run into each other by {-near.room:.3g} mm"
        if near.room < 0
        else f"come as near as {near.room:.3g} mm"
    )
    return Finding.error(
        "spherical.clearance",
        "hardware.boss_diameter",
        f"{one} and {two} {verb}{_when(linkage, near)}",
        near.room,
        AIR,
        "mm",
        ('set hardware.frame = "auto", or ' if other else "")
        + "use narrower links and bosses, a larger radius, a shorter travel, or other arcs",
    )


def _drive(params: SphericalParams, linkage: Linkage, shells: Shells) -> Iterator[Finding]:
    mechanism = linkage.five_bar
    if mechanism is None or not params.drive.gears:
        return
    train = train_of(linkage, params.drive)
    shafts = float(arc(mechanism.a0, mechanism.b0))
    if train is None:
        least = math.degrees((1 - params.drive.share) * shafts / 2)
        yield Finding.error(
            "spherical.drive",
            "drive.idler",
            f"an idler of {params.drive.idler:g}° does not reach both gears",
            params.drive.idler,
            least,
            "deg",
            f"use more than {least:.4g}°, or a larger share",
        )
        return
    yield from _cones(params, shells, train)
    said = f"pitch cones of {_cone(train.pinion)} on the crank and {_cone(train.wheel)} on the arm"
    if train.idler_axis is not None:
        said += f", an idler of {_cone(train.idler)}"
        if mechanism.ratio < 1:
            inner, outer = internal(shafts, mechanism.ratio)
            said += f"; an internal pair would have {_cone(inner)} and {_cone(outer)}"
    yield Finding("spherical.drive", Severity.NOTE, "drive", said)


def _cone(angle: float) -> str:
    return f"{math.degrees(angle):.4f}°"


def _cones(params: SphericalParams, shells: Shells, train: Train) -> Iterator[Finding]:
    hardware = params.hardware
    inner, _ = gear_span(params, shells, train)
    least = least_boss(hardware.pin_diameter, hardware.fit)
    cones = {"pinion": train.pinion, "wheel": train.wheel}
    if train.idler_axis is not None:
        cones["idler"] = train.idler
    for name, angle in cones.items():
        diameter = 2 * inner * math.sin(angle)
        if falls_short(diameter, least) or angle >= math.pi / 2:
            yield Finding.error(
                "spherical.drive",
                "drive.idler" if name == "idler" else "drive.share",
                f"the {name} has a pitch diameter of {diameter:.4g} mm at its small end, or is no cone",
                diameter,
                least,
                "mm",
                f"it needs {least:g} mm: use a larger radius, thinner pins, or no gears",
            )


def _stand(params: SphericalParams, linkage: Linkage, shells: Shells) -> Iterator[Finding]:
    stand = params.stand
    whole = math.degrees(link_arcs(linkage)["ground"] + ground_beyond(params))
    if exceeds(whole, LONGEST_GROUND):
        yield Finding.error(
            "spherical.stand",
            "stand.arc",
            f"the ground link would be an arc of {whole:.4g}°",
            whole,
            LONGEST_GROUND,
            "deg",
            f"use at most {LONGEST_GROUND - whole + stand.arc:.4g}°",
        )
    yield from _post(params, linkage, shells)
    # Mounting holes, a screw's head of material around them, and the flange must all fit on the plate.
    rim = (0.5 - abs(MOUNTING_SCREWS[0][0])) * stand.plate
    if falls_short(rim, stand.screw) or exceeds(flange_diameter(stand), stand.plate):
        most = min(rim, (stand.plate / 2 - (flange_diameter(stand) / 2 - 1.5 * stand.screw)) / 1.5)
        yield Finding.error(
            "spherical.stand",
            "stand.screw",
            f"screws of {stand.screw:g} mm are too large for a base plate of {stand.plate:g} mm",
            stand.screw,
            most,
            "mm",
            f"use at most {math.floor(100 * most) / 100:g} mm, or a larger plate",
        )
    if falls_short(stand.height, params.hardware.link_thickness):
        yield Finding.error(
            "spherical.stand",
            "stand.height",
            "the flange is thicker than the post is high",
            stand.height,
            params.hardware.link_thickness,
            "mm",
            f"make the post {params.hardware.link_thickness:g} mm at least",
        )


LONGEST_GROUND = 330.0
"""Degrees of the ground link from post to far axis: with more, its ends meet."""


def _post(params: SphericalParams, linkage: Linkage, shells: Shells) -> Iterator[Finding]:
    """Post and flange against bosses and gears next to them."""
    stand, hardware = params.stand, params.hardware
    radius = shells.outside
    wide = max(hardware.boss_diameter, flange_diameter(stand) * radius / (radius + stand.height))
    half = math.atan2(wide / 2, radius)
    train = train_of(linkage, params.drive)
    needed = math.atan2(hardware.boss_diameter / 2 + AIR, radius)
    if train is not None:
        needed = max(needed, train.pinion)
    if falls_short(math.radians(stand.arc), needed + half):
        least = math.degrees(needed + half)
        yield Finding.error(
            "spherical.stand",
            "stand.arc",
            "post and flange stand in the way of what sits on the input axis",
            stand.arc,
            least,
            "deg",
            f"use {math.ceil(10 * least) / 10:g}° or more, a smaller plate, or a higher post",
        )
