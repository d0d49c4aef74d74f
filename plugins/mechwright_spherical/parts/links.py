"""The solid parts of a design without their bores: what each is made of, in its body's own frame.

Imports the CAD kernel.
"""

import math
from functools import lru_cache

import cadquery as cq

from mechwright import Array
from mechwright_spherical.kinematics.bodies import pins_of_phase
from mechwright_spherical.kinematics.drive import Train, train_of
from mechwright_spherical.kinematics.linkage import Linkage, linkage_of
from mechwright_spherical.kinematics.vectors import arc, cross, direction, norm, rotate
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.parts.bores import X
from mechwright_spherical.parts.frame import frame_of, ground_beyond, motor_opposite, shells_of
from mechwright_spherical.parts.mount import EDGE, bracket_of, flange_level, gear_ends, hubs_of
from mechwright_spherical.parts.places import (
    coupler_seats,
    gear_cones,
    gear_span,
    in_ground,
    link_arcs,
    path_point,
    second_size,
)
from mechwright_spherical.parts.seats import (
    MARK,
    MARK_DEPTH,
    MARK_WIDTH,
    Seat,
    clamp_of,
    land_width,
    slot_width,
    slotted_of,
)
from mechwright_spherical.parts.shells import FLANGE, Shells, Span
from mechwright_spherical.parts.solids import (
    Slot,
    arc_body,
    cylinder,
    frustum,
    fused,
    shell,
    shell_strip,
    stroke,
)
from mechwright_spherical.parts.stand import flange_diameter, post_direction

PITCH_PLAY = 0.05
"""How much thinner pitch cones are drawn, mm, so that two that touch do not cut each other."""

_CACHED = 64
"""Solids that are kept: those of some four designs."""


@lru_cache(_CACHED)
def body(params: SphericalParams, name: str) -> cq.Solid:
    """The solid of the part of that name without its bores; the same one for the same design.

    Raises
    ------
    GeometryError
        The kernel cannot make it.
    """
    linkage, shells = linkage_of(params), shells_of(params)
    train = train_of(linkage, params.drive)
    if name == "ground":
        return ground(params, shells, linkage, train)
    if name == "coupler":
        return coupler(params, shells, linkage)
    if train is not None and name in gear_cones(train):
        return gear(params, shells, train, name)
    own = name.removesuffix("-n")
    arcs = link_arcs(linkage) if own == name else second_size(linkage, shells)
    return link(params, shells, own, arcs[own])


def link(params: SphericalParams, shells: Shells, name: str, angle: float) -> cq.Solid:
    """A link with two joints: an arc with a boss at each end."""
    hardware = params.hardware
    ends = (X, direction(angle))
    span = shells.links[name]
    return fused(
        [
            _arc(params, *ends, shells.arc(name)),
            *(cylinder(end, span, hardware.boss_diameter) for end in ends),
        ]
    )


def _arc(
    params: SphericalParams, u: Array, v: Array, span: Span, *, start: float = 0.0, meets: bool = False
) -> cq.Solid:
    """An arc of a link; ``meets`` says whether it meets another one of the same link.

    The sides of true strips are cones about the centre. Of two cones that share their tip the kernel finds no
    line in which they meet, and drops one strip; as a free-form solid it keeps both.
    """
    if params.hardware.section != "shell":
        return arc_body(u, v, span, params.hardware.link_width, start=start)
    strip = shell_strip(u, v, span, params.hardware.link_width, start=start)
    return cq.Solid(strip.toNURBS().wrapped) if meets else strip


_OVER = 1.0
"""How far cutters reach over the faces that they go through, mm."""


def coupler(params: SphericalParams, shells: Shells, linkage: Linkage) -> cq.Solid:
    """The coupler: bosses or slots for its two pins, and an arm to the path point."""
    hardware = params.hardware
    frame = pins_of_phase(linkage, 1)
    point = path_point(linkage, frame)
    seats = coupler_seats(linkage, frame)
    span, arcs = shells.links["coupler"], shells.arc("coupler")
    # Seats and bosses are trimmed to one spherical shell: their own ends differ by hundredths of a
    # millimetre, and the kernel would make slivers of that.
    beyond = (span[0] - _OVER, span[1] + _OVER)
    bodies: list[cq.Solid] = []
    holes: list[cq.Solid] = []
    for seat in seats:
        if seat.name in slotted_of(params):
            slot = Slot(seat.axis, *seat.ends)
            bodies.append(slot.surroundings(beyond, land_width(params)))
            holes += slot.swept(beyond, slot_width(params))
            holes += marks(params, seat, span)
        else:
            bodies += [cylinder(place, beyond, hardware.boss_diameter) for place in seat.own]
    first = seats[0].places[0], seats[1].places[0]
    bodies.append(_arc(params, *first, arcs))
    bodies.append(cylinder(point, beyond, hardware.boss_diameter))
    pins = [place for seat in seats for place in seat.own]
    for seat, start in zip(seats, first, strict=True):
        if seat.name not in slotted_of(params):
            bodies += [_arc(params, start, place, arcs, meets=True) for place in seat.own[1:]]
    nearest = min(pins, key=lambda pin: float(arc(pin, point)))
    bodies.append(_arc(params, nearest, point, arcs, meets=True))
    return fused(bodies, holes, within=shell(span, point))


def marks(params: SphericalParams, seat: Seat, span: Span) -> list[cq.Solid]:
    """The scale of a slot, cut into the coupler's inner face: at each place as many lines as its phase says.

    The lines stand beside the washer, away from the axis about which the pin is set.
    """
    clamp = clamp_of(params)
    if clamp is None:
        return []
    pitch = 2 * MARK_WIDTH / (span[0] * float(norm(cross(seat.axis, seat.places[0]))))
    deep = (span[0] - _OVER, span[0] + MARK_DEPTH)
    found = []
    for number, place in enumerate(seat.places, start=1):
        for line in range(number):
            at = rotate(seat.axis, (line - (number - 1) / 2) * pitch, place)
            found.append(stroke(seat.axis, at, deep, (clamp.reach, clamp.reach + MARK + _OVER), MARK_WIDTH))
    return found


def ground(params: SphericalParams, shells: Shells, linkage: Linkage, train: Train | None) -> cq.Solid:
    """The frame: both fixed axes, the idler's on an arc of its own, and the post with its flange."""
    hardware, stand = params.hardware, params.stand
    loop, bridge = linkage.shown.loop, frame_of(params).bridge
    axes = [X, direction(float(arc(loop.a0, loop.b0)))]
    span, arcs = shells.links["ground"], shells.arc("ground")
    bodies = [_arc(params, axes[0], axes[1], arcs, start=-ground_beyond(params))]
    if bridge is not None:
        # The input axis has an arc of its own inside the links, and a radial piece joins both arcs.
        inner, at = shells.links["ground-2"], direction(-bridge)
        bodies.append(_arc(params, at, X, shells.arc("ground-2")))
        bodies.append(cylinder(at, (inner[0], span[1]), hardware.boss_diameter))
        near, hub = axes.pop(0), hubs_of(params).get("a0")
        wide = hardware.boss_diameter if hub is None else max(hub.diameter, hardware.boss_diameter)
        bodies.append(cylinder(near, inner, wide))
        if hub is not None:
            # The input's shaft goes on through the centre.
            axes.insert(0, -near)
    if train is not None and train.idler_axis is not None:
        axes.append(in_ground(linkage, train.idler_axis))
        bodies.append(_arc(params, axes[0], axes[2], arcs, meets=True))
        bodies.append(_arc(params, axes[1], axes[2], arcs, meets=True))
    over = bracket_of(params)
    if over is not None:
        # The arc with the motor's flange goes from the post over the gears.
        recess = hardware.boss_height
        bodies.append(_arc(params, post_direction(stand), X, (over[0] + recess, over[1] - recess)))
    if hubs := hubs_of(params):
        carried = axes[:2]
        axes = axes[2:]
        for at, hub in zip(carried, hubs.values(), strict=True):
            wide = max(hub.diameter, hardware.boss_diameter)
            if over is not None:
                bodies.append(cylinder(at, span, wide))
            bodies.append(cylinder(at, hub.span, wide))
        bodies.append(motor_flange(params))
    bodies += [cylinder(axis, span, hardware.boss_diameter) for axis in axes]
    post = post_direction(stand)
    top = shells.outside + stand.height
    flange = (top - hardware.link_thickness, top)
    bodies.append(cylinder(post, (span[0], top), hardware.boss_diameter))
    bodies.append(cylinder(post, flange, flange_diameter(stand)))
    return fused(bodies)


def motor_flange(params: SphericalParams) -> cq.Solid:
    """The square flange about the input axis."""
    side, low = (params.stand.motor_flange or 0.0) + 2 * EDGE, flange_level(params)
    at = cq.Vector(-low - FLANGE if motor_opposite(params) else low, -side / 2, -side / 2)
    found = cq.Solid.makeBox(FLANGE, side, side, at)
    assert isinstance(found, cq.Solid)  # noqa: S101 - a box is one
    return found


def gear(params: SphericalParams, shells: Shells, train: Train, name: str) -> cq.Solid:
    """A gear blank: the pitch cone, and its hub to what is beside it."""
    half, span = gear_cones(train)[name][1], gear_span(params, shells, train)
    cone = frustum(X, half, span, PITCH_PLAY)
    ends, own = gear_ends(params, shells, train, name), [end * math.cos(half) for end in span]
    rest = (ends[0], own[0]) if ends[0] < own[0] else (own[1], ends[1])
    if not rest[0] < rest[1]:
        return cone
    return fused([cone, cylinder(X, rest, hubs_of(params)["a0"].outside)])
