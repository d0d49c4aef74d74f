"""Whether a motor's flange has bushes, rings, threads and room."""

import math
from collections.abc import Iterator

from mechwright import DesignError, Finding, Procedure, Stage
from mechwright.contracts.finding import at_stage
from mechwright.tolerances import exceeds, falls_short
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.parts.frame import AIR, bridge_rooms, motor_opposite
from mechwright_spherical.parts.mount import (
    EDGE,
    bracket_of,
    flange_level,
    hubs_of,
    least_height,
    shaft_end,
    sizes,
    thread_of,
)
from mechwright_spherical.parts.stand import flange_diameter
from mechwright_spherical.table import SphericalTable

THREAD = 1.5
"""Least length of a thread in the base, in diameters: what aluminium needs."""


def _mount(m: SphericalTable) -> Iterator[Finding]:
    """Nothing without a flange."""
    params = m.params
    side = params.stand.motor_flange
    if side is None:
        return
    if params.kind == "five-bar" and not params.drive.gears:
        yield Finding.error(
            "spherical.mount",
            "drive.gears",
            "without its bevel drive a five-bar has two inputs, and a motor's flange is for one",
            remedy="set it to true, or leave the flange out",
            proposed=({"parameters.drive.gears": True}, {"parameters.stand.motor_flange": None}),
        )
        return
    diameter = params.hardware.pin_diameter
    if diameter not in sizes():
        works = min(sizes(), key=lambda size: (abs(size - diameter), size))
        sold = ", ".join(f"{size:g}" for size in sizes())
        yield Finding.error(
            "spherical.mount",
            "hardware.pin_diameter",
            f"there are no bushes, rings and couplings for shafts of {diameter:g} mm; one of: {sold}",
            diameter,
            works,
            "mm",
            f"make it {works:g}",
            proposed=({"parameters.hardware.pin_diameter": works},),
        )
        return
    yield from _threads(params)
    try:
        hubs_of(params)
    except DesignError as error:
        yield Finding.error(
            "spherical.mount",
            "hardware.link_thickness",
            f"the hub of the output has no room: {error}",
            remedy="take thicker links",
        )
        return
    yield from _through(m)
    yield from _room(m, side)


def _threads(params: SphericalParams) -> Iterator[Finding]:
    stand = params.stand
    try:
        size = thread_of(stand)
    except DesignError:
        yield Finding.error(
            "spherical.mount",
            "stand.screw",
            f"no screw fits holes of {stand.screw:g} mm",
            stand.screw,
            5.5,
            "mm",
            "make them 5.5",
            proposed=({"parameters.stand.screw": 5.5},),
        )
        return
    least = THREAD * size
    if falls_short(stand.plate_thickness, least):
        yield Finding.error(
            "spherical.mount",
            "stand.plate_thickness",
            f"a base of {stand.plate_thickness:g} mm is too thin for threads M{size:g}",
            stand.plate_thickness,
            least,
            "mm",
            f"make it {least:g}, or the screws smaller",
            proposed=({"parameters.stand.plate_thickness": least},),
        )


def _through(m: SphericalTable) -> Iterator[Finding]:
    """Whether a shaft can go through the centre to a motor: no link, nor the bridge, passes its far end."""
    params, bridge = m.params, m.bridge
    if bridge is None:
        return
    shells, hardware = m.shells, params.hardware
    rooms = bridge_rooms(params, m.linkage, shells, math.pi, hardware.pin_diameter)
    air = {name: float(room.min()) for name, room in rooms.items()}
    beside = 2 * shells.links["ground-2"][0] * math.sin((math.pi - bridge) / 2)
    air["bridge"] = beside - (hardware.boss_diameter + hardware.pin_diameter) / 2
    name = min(air, key=air.__getitem__)
    if falls_short(air[name], AIR):
        yield Finding.error(
            "spherical.mount",
            "stand.motor_flange",
            "the input's shaft ends inside the links, and cannot go on through the centre: at its far end "
            f"the {name} {'would run into it' if air[name] < 0 else 'comes too near'}",
            air[name],
            AIR,
            "mm",
            "leave the flange out, or take shorter arcs of input, coupler or output",
            proposed=({"parameters.stand.motor_flange": None},),
        )


def _room(m: SphericalTable, side: float) -> Iterator[Finding]:
    """Flange against post and output, all seen from the centre."""
    params, shells, stand = m.params, m.shells, m.params.stand
    far = motor_opposite(params)
    hubs = hubs_of(params)
    half, level = side / 2 + EDGE, flange_level(params)
    least_post = least_height(params)
    if falls_short(stand.height, least_post):
        yield Finding.error(
            "spherical.mount",
            "stand.height",
            "the arc over the bevel gears, which carries the motor, does not fit below the post's flange",
            stand.height,
            least_post,
            "mm",
            f"make it {least_post:g}",
            proposed=({"parameters.stand.height": float(least_post)},),
        )
        return
    flange = math.atan2(half, level)
    wide = max(hubs["b0"].diameter, params.hardware.boss_diameter)
    beside = math.atan2(wide / 2 + AIR, shells.links["ground"][0])
    arc = m.arcs["ground"]
    arc = math.pi - arc if far else arc
    # Over the gears the flange is farther out than the output's hub.
    if bracket_of(params) is None and exceeds(flange + beside, arc):
        most = 2 * (level * math.tan(max(arc - beside, 0.0)) - EDGE)
        yield Finding.error(
            "spherical.mount",
            "stand.motor_flange",
            f"a motor's flange of {side:g} mm runs into the hub of the output",
            side,
            max(most, 0.0),
            "mm",
            "take a larger radius, or fixed axes farther apart",
        )
        return
    # The post's flange is widest farthest out, past the whole bracket.
    post = max(
        math.atan2(params.hardware.boss_diameter / 2, shells.outside),
        math.atan2(
            flange_diameter(stand) / 2, shells.outside + stand.height - params.hardware.link_thickness
        ),
    )
    reach = shaft_end(params, "a0")
    needed = max(flange, math.atan2(half, reach)) + post
    tilt = 180.0 - stand.arc if far else stand.arc
    if exceeds(needed, math.radians(tilt)):
        least = math.floor(180 - math.degrees(needed)) if far else math.ceil(math.degrees(needed))
        yield Finding.error(
            "spherical.mount",
            "stand.arc",
            f"the motor's flange of {side:g} mm runs into the post",
            stand.arc,
            float(least),
            "deg",
            f"make it {least}, or the post higher",
            proposed=({"parameters.stand.arc": float(least)},),
        )


MOUNT = Procedure[SphericalTable](
    ("spherical.mount",),
    lambda m: at_stage(Stage.PARTS, _mount(m)),
    when=lambda t: t.params.stand.motor_flange is not None,
    stage=Stage.PARTS,
)
