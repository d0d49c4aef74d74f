"""Whether a motor's flange has bushes, rings, threads and room."""

import math
from collections.abc import Iterator

from mechwright import DesignError, Finding
from mechwright.tolerances import exceeds, falls_short
from mechwright_spherical.frame import AIR, frame_of, shells_of
from mechwright_spherical.linkage import linkage_of
from mechwright_spherical.mount import EDGE, hubs_of, shaft_end, sizes, thread_of
from mechwright_spherical.params import SphericalParams
from mechwright_spherical.places import link_arcs
from mechwright_spherical.shells import RISE
from mechwright_spherical.stand import flange_diameter

THREAD = 1.5
"""Least length of a thread in the base, in diameters: what aluminium needs."""


def mount_findings(params: SphericalParams) -> Iterator[Finding]:
    """Nothing without a flange."""
    side = params.stand.motor_flange
    if side is None:
        return
    if frame_of(params).bridge is not None:
        yield Finding.error(
            "spherical.mount",
            "stand.motor_flange",
            "the input's shaft ends inside the links, where no motor goes",
            remedy='leave it out, or with other arcs set hardware.frame = "one"',
            proposed=({"parameters.stand.motor_flange": None},),
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
    yield from _room(params, side)


def _threads(params: SphericalParams) -> Iterator[Finding]:
    stand = params.stand
    try:
        size = thread_of(stand)
    except DesignError:
        yield Finding.error(
            "spherical.mount",
            "stand.screw",
            f"no screw goes through holes of {stand.screw:g} mm",
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


def _room(params: SphericalParams, side: float) -> Iterator[Finding]:
    """Flange against post and output, all seen from the centre."""
    shells, stand = shells_of(params), params.stand
    hubs = hubs_of(params)
    half, level = side / 2 + EDGE, shells.outside + RISE
    flange = math.atan2(half, level)
    wide = max(hubs["b0"].diameter, params.hardware.boss_diameter)
    beside = math.atan2(wide / 2 + AIR, shells.links["ground"][0])
    arc = link_arcs(linkage_of(params))["ground"]
    if exceeds(flange + beside, arc):
        most = 2 * (level * math.tan(max(arc - beside, 0.0)) - EDGE)
        yield _too_wide(side, most, "the hub of the output")
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
    if exceeds(needed, math.radians(stand.arc)):
        least = math.ceil(math.degrees(needed))
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


def _too_wide(side: float, most: float, what: str) -> Finding:
    return Finding.error(
        "spherical.mount",
        "stand.motor_flange",
        f"a motor's flange of {side:g} mm runs into {what}",
        side,
        max(most, 0.0),
        "mm",
        "take a larger radius, or fixed axes farther apart",
    )
