"""The solid parts of a design: what each is made of, in its body's own frame. Imports the CAD kernel."""

import math
from functools import lru_cache

import cadquery as cq
import numpy as np

from mechwright import Array
from mechwright_spherical.kinematics.bodies import pins_of_phase
from mechwright_spherical.kinematics.chain import orientation
from mechwright_spherical.kinematics.drive import Train, train_of
from mechwright_spherical.kinematics.linkage import Linkage, linkage_of
from mechwright_spherical.kinematics.vectors import arc, cross, norm, rotate
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.parts.frame import frame_of, ground_beyond, motor_opposite, shells_of
from mechwright_spherical.parts.mount import EDGE, HOLE, bracket_of, flange_level, hubs_of
from mechwright_spherical.parts.places import (
    gear_cones,
    gear_span,
    link_arcs,
    pin_places,
    second_size,
    tool_of,
)
from mechwright_spherical.parts.seats import (
    MARK,
    MARK_DEPTH,
    MARK_WIDTH,
    Seat,
    clamp_of,
    land_width,
    seats_of,
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
from mechwright_spherical.parts.stand import FLANGE_SCREWS, flange_diameter, post_direction

PITCH_PLAY = 0.05
"""How much thinner pitch cones are drawn, mm, so that two that touch do not cut each other."""

_CACHED = 64
"""Solids that are kept: those of some four designs."""

X = np.array([1.0, 0.0, 0.0])


def direction(angle: float) -> Array:
    """The direction in a link's frame at an arc, rad, from its first joint."""
    return np.array([math.cos(angle), math.sin(angle), 0.0])


@lru_cache(_CACHED)
def solid(params: SphericalParams, name: str) -> cq.Solid:
    """The solid of the part of that name; the same one for the same design.

    Raises
    ------
    GeometryError
        The kernel cannot make it.
    """
    linkage, shells = linkage_of(params), shells_of(params)
    train = train_of(linkage, params.drive)
    pins = pin_places(params)
    if name in pins:
        span, _, angle = pins[name]
        return cylinder(direction(angle), shells.pins[span], params.hardware.pin_diameter)
    if name == "shaft-idler":
        return cylinder(X, shells.pins["idler"], params.hardware.pin_diameter)
    if name == "tool":
        return tool(params, shells, path_point(linkage, pins_of_phase(linkage, 1)))
    if name == "ground":
        return ground(params, shells, linkage, train)
    if name == "coupler":
        return coupler(params, shells, linkage)
    if train is not None and name in (cones := gear_cones(train)):
        return gear(params, gear_span(params, shells, train), cones[name][1])
    own = name.removesuffix("-n")
    arcs = link_arcs(linkage) if own == name else second_size(linkage, shells)
    return link(params, shells, own, arcs[own])


def link(params: SphericalParams, shells: Shells, name: str, angle: float) -> cq.Solid:
    """A link with two joints: an arc with a boss and a bore at each end."""
    hardware = params.hardware
    ends = (X, direction(angle))
    span = shells.links[name]
    return fused(
        [
            _arc(params, *ends, shells.arc(name)),
            *(cylinder(end, span, hardware.boss_diameter) for end in ends),
        ],
        [bore(params, end, span) for end in ends],
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


def bore(params: SphericalParams, at: Array, span: Span) -> cq.Solid:
    """What a pin's bore takes away: from inside the span to outside, never through the centre."""
    hardware = params.hardware
    return cylinder(at, (span[0] - _OVER, span[1] + _OVER), hardware.pin_diameter + hardware.fit)


_OVER = 1.0
"""How far cutters reach over the faces that they go through, mm."""


def coupler(params: SphericalParams, shells: Shells, linkage: Linkage) -> cq.Solid:
    """The coupler: bores or slots for its two pins, and an arm to the path point."""
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
            holes += [bore(params, place, span) for place in seat.own]
    first = seats[0].places[0], seats[1].places[0]
    bodies.append(_arc(params, *first, arcs))
    bodies.append(cylinder(point, beyond, hardware.boss_diameter))
    pins = [place for seat in seats for place in seat.own]
    for seat, start in zip(seats, first, strict=True):
        if seat.name not in slotted_of(params):
            bodies += [_arc(params, start, place, arcs, meets=True) for place in seat.own[1:]]
    nearest = min(pins, key=lambda pin: float(arc(pin, point)))
    bodies.append(_arc(params, nearest, point, arcs, meets=True))
    return fused(bodies, [*holes, bore(params, point, span)], within=shell(span, point))


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


def path_point(linkage: Linkage, frame: Array) -> Array:
    """The path point in the coupler's frame."""
    return np.asarray(frame.T @ linkage.phases[0].at_reference.p[0][:, 0])


def coupler_seats(linkage: Linkage, frame: Array) -> tuple[Seat, Seat]:
    """Where the coupler takes its two pins, in its frame."""
    a, c = (
        Seat(seat.name, frame.T @ seat.axis, tuple(frame.T @ place for place in seat.places))
        for seat in seats_of(linkage)
    )
    return a, c


def ground(params: SphericalParams, shells: Shells, linkage: Linkage, train: Train | None) -> cq.Solid:
    """The frame: both fixed axes, the idler's on an arc of its own, and the post with its flange."""
    hardware, stand = params.hardware, params.stand
    loop, bridge = linkage.shown.loop, frame_of(params).bridge
    axes = [X, direction(float(arc(loop.a0, loop.b0)))]
    span, arcs = shells.links["ground"], shells.arc("ground")
    bodies = [_arc(params, axes[0], axes[1], arcs, start=-ground_beyond(params))]
    holes: list[cq.Solid] = []
    if bridge is not None:
        # The input axis has an arc of its own inside the links, and a radial piece joins both arcs.
        inner, at = shells.links["ground-2"], direction(-bridge)
        bodies.append(_arc(params, at, X, shells.arc("ground-2")))
        bodies.append(cylinder(at, (inner[0], span[1]), hardware.boss_diameter))
        near, hub = axes.pop(0), hubs_of(params).get("a0")
        if hub is None:
            bodies.append(cylinder(near, inner, hardware.boss_diameter))
            holes.append(bore(params, near, inner))
        else:
            # The input's shaft goes on through the centre.
            bodies.append(cylinder(near, inner, max(hub.diameter, hardware.boss_diameter)))
            holes.append(cylinder(near, (inner[0] - _OVER, inner[1] + _OVER), hub.outside + hardware.fit))
            axes.insert(0, -near)
    if train is not None and train.idler_axis is not None:
        axes.append(_in_ground(linkage, train.idler_axis))
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
            if over is not None:
                bodies.append(cylinder(at, span, max(hub.diameter, hardware.boss_diameter)))
                holes.append(cylinder(at, (span[0] - _OVER, span[1] + _OVER), hub.outside + hardware.fit))
            bodies.append(cylinder(at, hub.span, max(hub.diameter, hardware.boss_diameter)))
            holes.append(cylinder(at, (hub.span[0] - _OVER, hub.span[1] + _OVER), hub.outside + hardware.fit))
        bodies.append(motor_flange(params))
        holes += flange_holes(params)
    bodies += [cylinder(axis, span, hardware.boss_diameter) for axis in axes]
    holes += [bore(params, axis, span) for axis in axes]
    post = post_direction(stand)
    top = shells.outside + stand.height
    flange = (top - hardware.link_thickness, top)
    bodies.append(cylinder(post, (span[0], top), hardware.boss_diameter))
    bodies.append(cylinder(post, flange, flange_diameter(stand)))
    side, up = np.array([0.0, 0.0, 1.0]), np.cross(post, [0.0, 0.0, 1.0])
    for one, two in FLANGE_SCREWS:
        at = stand.plate * (one * side + two * up)
        holes.append(
            cq.Solid.makeCylinder(
                stand.screw / 2,
                hardware.link_thickness + 2 * _OVER,
                cq.Vector(*(at + (flange[0] - _OVER) * post).tolist()),
                cq.Vector(*post.tolist()),
            )
        )
    return fused(bodies, holes)


def motor_flange(params: SphericalParams) -> cq.Solid:
    """The square flange about the input axis."""
    side, low = (params.stand.motor_flange or 0.0) + 2 * EDGE, flange_level(params)
    at = cq.Vector(-low - FLANGE if motor_opposite(params) else low, -side / 2, -side / 2)
    found = cq.Solid.makeBox(FLANGE, side, side, at)
    assert isinstance(found, cq.Solid)  # noqa: S101 - a box is one
    return found


def flange_holes(params: SphericalParams) -> list[cq.Solid]:
    """What its four screw holes take away."""
    half, low = (params.stand.motor_flange or 0.0) / 2, flange_level(params) - _OVER
    way = -1 if motor_opposite(params) else 1
    places = [cq.Vector(way * low, y, z) for y in (-half, half) for z in (-half, half)]
    return [cq.Solid.makeCylinder(HOLE / 2, FLANGE + 2 * _OVER, at, cq.Vector(way, 0, 0)) for at in places]


def _in_ground(linkage: Linkage, axis: Array) -> Array:
    loop = linkage.shown.loop
    return np.asarray(orientation(loop.a0, loop.b0).T @ axis)


def tool(params: SphericalParams, shells: Shells, at: Array) -> cq.Solid:
    """The tool: a pin in the coupler whose cone ends on the sphere."""
    low, high = shells.pins["tool"]
    cone, shank = tool_of(params, shells).steps
    radius, tip = shank.diameter / 2, low + cone.length
    point = cq.Solid.makeCone(
        0.0, radius, cone.length, cq.Vector(*(low * at).tolist()), cq.Vector(*at.tolist())
    )
    return fused([point, cylinder(at, (tip, high), shank.diameter)])


def gear(params: SphericalParams, span: Span, half_angle: float) -> cq.Solid:
    """A gear blank: the pitch cone, with a bore for its shaft."""
    blank = frustum(X, half_angle, span, PITCH_PLAY)
    return fused([blank], [bore(params, X, (span[0] / 2, 2 * span[1]))])
