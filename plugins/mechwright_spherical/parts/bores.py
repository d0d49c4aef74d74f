"""The bores of links, frame and gear blanks, each in the frame of its body.

Bores for pins point at the centre of the sphere. Those of the ground's flanges do not.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from mechwright import Array
from mechwright.contracts.fits import running_hole, shaft_fit
from mechwright.contracts.free_form import FormBore
from mechwright_spherical.kinematics.bodies import pins_of_phase
from mechwright_spherical.kinematics.drive import Train
from mechwright_spherical.kinematics.linkage import Linkage
from mechwright_spherical.kinematics.vectors import arc, direction
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.parts.frame import frame_of, motor_opposite
from mechwright_spherical.parts.mount import HOLE, bracket_of, flange_level, gear_ends, hubs_of
from mechwright_spherical.parts.places import coupler_seats, in_ground, path_point
from mechwright_spherical.parts.seats import slotted_of
from mechwright_spherical.parts.shells import FLANGE, Shells, Span
from mechwright_spherical.parts.stand import FLANGE_SCREWS, post_direction

X = np.array([1.0, 0.0, 0.0])


def radial(name: str, at: Array, span: Span, diameter: float) -> FormBore:
    """A bore along a direction from the centre, between two radii."""
    low, high = span
    start, axis = (low * at).tolist(), at.tolist()
    return FormBore(name, tuple(start), tuple(axis), high - low, diameter)


def pin_bore(params: SphericalParams, name: str, at: Array, span: Span) -> FormBore:
    """That of a pin, drawn with the clearance of ``hardware.fit``."""
    return radial(name, at, span, params.hardware.pin_diameter + params.hardware.fit)


def link_bores(params: SphericalParams, shells: Shells, link: str, angle: float) -> tuple[FormBore, ...]:
    """Both of a link, named after its joints."""
    joints = {"crank": ("a0", "a"), "arm": ("b0", "b")}
    first, second = joints.get(link, ("b" if params.kind == "five-bar" else "b0", "c"))
    span = shells.links[link]
    return pin_bore(params, first, X, span), pin_bore(params, second, direction(angle), span)


def coupler_bores(params: SphericalParams, shells: Shells, linkage: Linkage) -> Iterator[FormBore]:
    """Those of the coupler: for pins that are not set in slots, one for each place; and for the tool."""
    frame, span = pins_of_phase(linkage, 1), shells.links["coupler"]
    for seat in coupler_seats(linkage, frame):
        if seat.name in slotted_of(params):
            continue
        if len(seat.own) == 1:
            yield pin_bore(params, seat.name, seat.own[0], span)
            continue
        # The pin is in one of them by turns, so all have the limits of the one that it turns in.
        pin = shaft_fit(params.hardware.pin_diameter, "h6")
        fit = running_hole(pin.size, params.hardware.fit, pin)
        for number, place in enumerate(seat.own, start=1):
            yield replace(
                pin_bore(params, f"{seat.name}-{number}", place, span), fit=fit, diameter=fit.middle
            )
    yield pin_bore(params, "tool", path_point(linkage, frame), span)


def ground_bores(
    params: SphericalParams, shells: Shells, linkage: Linkage, train: Train | None
) -> Iterator[FormBore]:
    """Those of the frame: fixed axes or their bushes, the idler's axis, screws of motor and post."""
    loop, bridge, over = linkage.shown.loop, frame_of(params).bridge, bracket_of(params)
    span, hubs = shells.links["ground"], hubs_of(params)
    axes = {"a0": X, "b0": direction(float(arc(loop.a0, loop.b0)))}
    inner = shells.links["ground-2"] if bridge is not None else span
    for name, at in axes.items():
        hub, beside = hubs.get(name), inner if name == "a0" else span
        if hub is None:
            yield pin_bore(params, name, at, beside)
            continue
        far = name == "a0" and bridge is not None
        if far or over is not None:
            # The second bush stands in a hub of its own: across the centre, or over the gears.
            yield radial(name, at, beside, hub.outside)
        out = f"{name}-2" if far or (over is not None and hub.span != span) else name
        if out != name or over is None:
            yield radial(out, -at if far else at, hub.span, hub.outside)
    if train is not None and train.idler_axis is not None:
        yield pin_bore(params, "idler", in_ground(linkage, train.idler_axis), span)
    if hubs:
        yield from flange_bores(params)
    yield from post_bores(params, shells)


def flange_bores(params: SphericalParams) -> Iterator[FormBore]:
    """The four screw holes of the motor's flange."""
    half, low = (params.stand.motor_flange or 0.0) / 2, flange_level(params)
    way = -1.0 if motor_opposite(params) else 1.0
    places = [(y, z) for y in (-half, half) for z in (-half, half)]
    for number, (y, z) in enumerate(places, start=1):
        yield FormBore(f"flange-{number}", (way * low, y, z), (way, 0.0, 0.0), FLANGE, HOLE)


def post_bores(params: SphericalParams, shells: Shells) -> Iterator[FormBore]:
    """The screw holes of the post's flange."""
    stand, deep = params.stand, params.hardware.link_thickness
    post = post_direction(stand)
    side, up = np.array([0.0, 0.0, 1.0]), np.cross(post, [0.0, 0.0, 1.0])
    foot = (shells.outside + stand.height - deep) * post
    for number, (one, two) in enumerate(FLANGE_SCREWS, start=1):
        start = foot + stand.plate * (one * side + two * up)
        yield FormBore(f"post-{number}", tuple(start.tolist()), tuple(post.tolist()), deep, stand.screw)


def gear_bore(params: SphericalParams, shells: Shells, train: Train, name: str) -> FormBore:
    """That of a gear blank for its shaft, through the cone and its hub."""
    return pin_bore(params, "shaft", X, gear_ends(params, shells, train, name))
