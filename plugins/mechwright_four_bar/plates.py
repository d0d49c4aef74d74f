"""The linkage as plates, pins and bushings, and the layers they stand in.

Joints: the crank's shaft and its pin A are pressed into the crank, pin B into the follower, pin B0 into the
ground plate. Shaft, coupler (twice) and follower turn in plain bushings, or in reamed bores without them.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from mechwright import GROUND, Array, Colour, Instance, Outline, Part, Poses, kept
from mechwright import Joint as Held
from mechwright.contracts.joint import fixed
from mechwright.contracts.motion import travelled
from mechwright.mechanics.linkage import (
    Boss,
    Plate,
    Spindle,
    Stack,
    bent_link,
    bushing_part,
    hull_link,
    pin_part,
    rectangle,
    stack,
    web_link,
)
from mechwright.mechanics.planar import BodyMotion, Turning
from mechwright_four_bar.dimensions import FourBar
from mechwright_four_bar.loop import close
from mechwright_four_bar.params import FourBarParams

FILLET = 5.0
"""Radius between web and boss, mm: end mills up to 10 mm go round it. Links too short for it get none."""

BEND = 2.0
"""Radius of the bent coupler's middle line, in web widths: its inner edge keeps 1.5 of them."""

HEAD, HEAD_HEIGHT = 1.6, 0.3
"""Diameter and height of a pin's head, in pin diameters: those of small rivets and clevis pins."""

SHAFT = 3.0
"""Length of the crank's shaft below the ground plate, in pin diameters: room for a coupling."""

STACK_SAMPLES = 361
"""Positions of the crank, both ends of the turn included, at which plates are kept apart."""


COLOURS: Mapping[str, Colour] = {
    "ground": (0.62, 0.64, 0.66),
    "crank": (0.78, 0.36, 0.30),
    "coupler": (0.45, 0.58, 0.70),
    "follower": (0.80, 0.68, 0.42),
}


def bar_of(params: FourBarParams) -> FourBar:
    """The dimensions."""
    return FourBar(
        params.crank,
        params.coupler,
        params.follower,
        params.ground,
        math.radians(params.ground_angle),
        1 if params.branch == "open" else -1,
    )


def pivot_of(params: FourBarParams) -> complex:
    """A0, x + i y, mm."""
    return complex(params.pivot_x, params.pivot_y)


def turning_bore(params: FourBarParams) -> float:
    """Diameter of a plate's bore in which a pin turns, with or without a bushing, mm."""
    if params.bushing_wall > 0:
        return params.pin_diameter + 2 * params.bushing_wall
    return params.pin_diameter + params.running_fit


@dataclass(frozen=True)
class Joint:
    """A pin.

    Parameters
    ----------
    body
        The body it is pressed into.
    frame
        The frame of the motion on its axis that moves with that body.
    place
        Its axis in the body, x + i y, mm.
    plates
        The plates it joins.
    """

    body: str
    frame: str
    place: complex
    plates: tuple[str, str]


def joints_of(params: FourBarParams) -> dict[str, Joint]:
    """Shaft and pins by name."""
    return {
        "shaft": Joint("crank", "crank", 0j, ("ground", "crank")),
        "pin-a": Joint("crank", "crank-a", complex(params.crank), ("crank", "coupler")),
        "pin-b": Joint("follower", "follower-b", complex(params.follower), ("follower", "coupler")),
        "pin-b0": Joint("ground", "ground-b0", complex(params.ground), ("ground", "follower")),
    }


def bosses_of(params: FourBarParams) -> dict[str, tuple[Boss, ...]]:
    """The bosses of every plate, in its body's frame."""
    pressed, turning = params.pin_diameter, turning_bore(params)

    def boss(x: complex, bore: float, tag: str) -> Boss:
        return Boss(complex(x), bore / 2 + params.rim, bore, tag)

    point = params.coupler_point
    third = () if point is None else (boss(point, pressed, "coupler-point"),)
    return {
        "ground": (boss(0, turning, "A0"), boss(params.ground, pressed, "B0")),
        "crank": (boss(0, pressed, "A0"), boss(params.crank, pressed, "A")),
        "coupler": (boss(0, turning, "A"), boss(params.coupler, turning, "B"), *third),
        "follower": (boss(0, turning, "B0"), boss(params.follower, pressed, "B")),
    }


@kept
def outlines_of(params: FourBarParams) -> dict[str, Outline]:
    """The outline of every plate, in its body's frame: origin in its first joint, x to its second.

    Raises
    ------
    GeometryError
        The bend of the coupler does not fit.
    """
    bosses = bosses_of(params)
    outlines = {name: _straight(bosses[name], params.web_width) for name in ("crank", "follower")}
    if params.coupler_bend != 0:
        one, two = bosses["coupler"]
        elbow = complex(params.coupler / 2, params.coupler_bend)
        outlines["coupler"] = bent_link(one, two, elbow, params.web_width, FILLET, BEND * params.web_width)
    elif params.coupler_point is None:
        outlines["coupler"] = _straight(bosses["coupler"], params.web_width)
    else:
        outlines["coupler"] = hull_link(bosses["coupler"])
    outlines["ground"] = _base(params, bosses["ground"])
    return outlines


def _straight(bosses: tuple[Boss, ...], width: float) -> Outline:
    """A web between two bosses, or the hull where there is no room for its fillets."""
    one, two = bosses
    half, least = width / 2, min(one.radius, two.radius)
    if half < least:
        taken = sum(math.sqrt((boss.radius + FILLET) ** 2 - (half + FILLET) ** 2) for boss in (one, two))
        if taken < abs(two.centre - one.centre):
            return web_link(one, two, width, FILLET)
    return hull_link((one, two))


def _base(params: FourBarParams, bosses: tuple[Boss, ...]) -> Outline:
    """A plate under both pivots, with a bore for a screw of the pins' diameter in each corner."""
    corner = params.pin_diameter / 2 + params.rim
    reach = max(boss.radius for boss in bosses)
    low = complex(-reach - 2 * corner, -reach - corner)
    high = complex(params.ground, 0) - low
    screws = [
        Boss(complex(x, y), corner, params.pin_diameter, "screw")
        for x in (low.real + corner, high.real - corner)
        for y in (low.imag + corner, high.imag - corner)
    ]
    return rectangle(low, high, corner, (*bosses, *screws))


def frames_of(params: FourBarParams, bodies: Mapping[str, BodyMotion]) -> dict[str, Poses]:
    """Poses of all bodies, and of the frames on the pins' axes, from the motion of the moving bodies."""
    bar, pivot = bar_of(params), pivot_of(params)
    ground = BodyMotion.about(0j, Turning.of(np.full_like(bodies["crank"].turning.theta, bar.ground_angle)))
    moving = {"ground": ground, **bodies}
    places = [(name, name, 0j) for name in moving]
    places += [(one.frame, one.body, one.place) for one in joints_of(params).values() if one.place]
    places.append(("coupler-b", "coupler", complex(params.coupler)))
    poses = {}
    for frame, body, place in places:
        at = moving[body].point(place).position + pivot
        poses[frame] = Poses.planar(at.real, at.imag, moving[body].turning.theta)
    return poses


def held_by(params: FourBarParams) -> dict[str, Held]:
    """What holds the bodies of :func:`frames_of`, the loop closed in B."""
    held = fixed(GROUND, "ground")
    for one in joints_of(params).values():
        if one.place:
            held |= fixed(one.body, one.frame)
    return {
        **held,
        **fixed("coupler", "coupler-b"),
        "A0": Held("revolute", "ground", "crank", drives=True),
        "B0": Held("revolute", "ground", "follower", (params.ground, 0.0, 0.0)),
        "A": Held("revolute", "crank", "coupler", (params.crank, 0.0, 0.0)),
        "B": Held("revolute", "coupler", "follower", (params.coupler, 0.0, 0.0)),
    }


def crank_angles(params: FourBarParams, samples: int) -> Array:
    """Crank angles (samples,), rad, from X, over one turn in its sense."""
    return travelled(math.tau if params.direction == "ccw" else -math.tau, samples)


@kept
def stack_of(params: FourBarParams) -> Stack:
    """The layers of plates and the heights of pins.

    Raises
    ------
    GeometryError
        No order of layers keeps all plates apart.
    """
    outlines = outlines_of(params)
    plates = [
        Plate(
            name,
            name,
            outline,
            params.ground_thickness if name == "ground" else params.thickness,
            (0,) if name == "ground" else (),
        )
        for name, outline in outlines.items()
    ]
    bar, phi = bar_of(params), crank_angles(params, STACK_SAMPLES)
    poses = frames_of(params, close(bar, phi).bodies(bar, 1.0))
    head = HEAD * params.pin_diameter / 2
    spindles = [
        Spindle(
            name,
            joint.body,
            joint.place,
            params.pin_diameter / 2,
            joint.plates,
            0.0 if name == "shaft" else head,
        )
        for name, joint in joints_of(params).items()
    ]
    return stack(plates, spindles, poses, params.clearance, params.washer)


def parts_of(params: FourBarParams) -> tuple[Part, ...]:
    """Plates, shaft, pins and bushings, each standing in the mechanism.

    Raises
    ------
    GeometryError
        As :func:`outlines_of` and :func:`stack_of`.
    """
    layers = stack_of(params)
    parts = [
        Part(
            name,
            outline,
            params.ground_thickness if name == "ground" else params.thickness,
            params.material,
            (Instance(name, layers.bottom(name)),),
            COLOURS[name],
        )
        for name, outline in sorted(
            outlines_of(params).items(), key=lambda item: list(COLOURS).index(item[0])
        )
    ]
    return (*parts, *_pins(params, layers), *_bushings(params, layers))


def pin_length(params: FourBarParams, layers: Stack, name: str) -> float:
    """Length of a pin under its head, or of the shaft, mm."""
    low, high = layers.spans[name]
    return high - low + (SHAFT * params.pin_diameter if name == "shaft" else 0.0)


def _pins(params: FourBarParams, layers: Stack) -> list[Part]:
    diameter = params.pin_diameter
    parts = []
    for name, joint in joints_of(params).items():
        length = pin_length(params, layers, name)
        instance = Instance(joint.frame, layers.spans[name][1] - length)
        head = (0.0, 0.0) if name == "shaft" else (HEAD * diameter, HEAD_HEIGHT * diameter)
        parts.append(pin_part(name, diameter, length, (instance,), *head))
    return parts


def _bushings(params: FourBarParams, layers: Stack) -> list[Part]:
    if params.bushing_wall == 0:
        return []
    bore, outside = params.pin_diameter + params.running_fit, turning_bore(params)
    thin = [
        Instance("coupler", layers.bottom("coupler")),
        Instance("coupler-b", layers.bottom("coupler")),
        Instance("follower", layers.bottom("follower")),
    ]
    thick = [Instance("ground", layers.bottom("ground"))]
    if params.thickness == params.ground_thickness:
        return [bushing_part("bushing", bore, outside, params.thickness, thin + thick)]
    return [
        bushing_part("bushing", bore, outside, params.thickness, thin),
        bushing_part("bushing-ground", bore, outside, params.ground_thickness, thick),
    ]
