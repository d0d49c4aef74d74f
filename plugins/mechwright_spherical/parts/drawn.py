"""What the drawings of links, frame and gear blanks state beside their bores, and how they are made."""

import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

import numpy as np

from mechwright import Array
from mechwright.contracts.free_form import (
    AngleSize,
    FormBore,
    FormSize,
    FreeForm,
    LengthSize,
    RadiusSize,
)
from mechwright.contracts.joint import Vector
from mechwright_spherical.kinematics.drive import train_of
from mechwright_spherical.kinematics.linkage import linkage_of
from mechwright_spherical.kinematics.vectors import arc, direction
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.parts.frame import ground_beyond, motor_opposite, shells_of
from mechwright_spherical.parts.mount import EDGE, FACE, flange_level, gear_ends
from mechwright_spherical.parts.places import gear_cones, gear_span
from mechwright_spherical.parts.seats import clamp_of, seats_of, slot_width, slotted_of
from mechwright_spherical.parts.shells import FLANGE, Span
from mechwright_spherical.parts.stand import flange_diameter, post_direction

if TYPE_CHECKING:
    import cadquery as cq

MILLED = "five-axis milling from the STEP file, or printing; bores reamed"
"""Of links and frame: bores that point at one centre need a tilting table on a milling machine."""

CUT = "bevel gear cut by a gear maker on this pitch cone; drawn without teeth"
"""Of gear blanks."""

CENTRE: Vector = (0.0, 0.0, 0.0)
X: Vector = (1.0, 0.0, 0.0)


def free_form(
    params: SphericalParams, name: str, body: "Callable[[], cq.Solid]", bores: tuple[FormBore, ...]
) -> FreeForm:
    """The form of a link, the frame or a gear blank, by its part name."""
    train = train_of(linkage_of(params), params.drive)
    cones = {} if train is None else gear_cones(train)
    if name in cones and train is not None:
        shells = shells_of(params)
        sizes = _cone(
            cones[name][1], gear_span(params, shells, train), gear_ends(params, shells, train, name)
        )
        return FreeForm(body, CUT, bores, tuple(sizes), centre=True)
    own = name.removesuffix("-n")
    stated = [*_arc_sizes(params, own, bores)]
    # Axes that miss the centre by more than the play of the pins make the linkage bind.
    notes = [
        f"Axes of the bores for pins pass the centre within {params.hardware.fit:g}",
        f"Faces of the bores ±{FACE:g}",
    ]
    if own == "ground":
        stated += _stand_sizes(params)
    if own == "coupler":
        notes += _slots(params)
    return FreeForm(body, MILLED, bores, tuple(stated), centre=True, notes=tuple(notes))


def _tuple(at: Array) -> Vector:
    x, y, z = at.tolist()
    return x, y, z


def _arc_sizes(params: SphericalParams, link: str, bores: tuple[FormBore, ...]) -> Iterator[FormSize]:
    """Angle between the joints' axes, both radii of the arc, its width, and the bosses' diameter."""
    hardware, shells = params.hardware, shells_of(params)
    low, high = shells.arc(link)
    angle = _angle(params, link, bores)
    ends = _tuple(direction(angle))
    yield AngleSize(CENTRE, X, ends)
    sphere = hardware.section == "shell" or link == "coupler"
    where = (0.35, 0.65)
    if link == "ground":
        # Beyond the input's axis, where only the arc to the post is.
        angle = -min(ground_beyond(params), math.radians(params.stand.arc))
    for radius, share in zip((low, high), where, strict=True):
        yield RadiusSize(CENTRE, radius, _tuple(direction(share * angle)), sphere)
    half = hardware.link_width / 2
    middle, across = (low + high) / 2 * direction(angle / 2), np.array([0.0, 0.0, half])
    yield LengthSize(_tuple(middle - across), _tuple(middle + across))
    if link != "ground":
        inner, outer = shells.links[link]
        boss = np.array([outer if link != "coupler" else inner, 0.0, hardware.boss_diameter / 2])
        yield LengthSize(_tuple(boss * (1, 1, -1)), _tuple(boss), diameter=True)


def _angle(params: SphericalParams, link: str, bores: tuple[FormBore, ...]) -> float:
    """From the first joint to the second one, rad."""
    loop = linkage_of(params).phases[0].loop
    if link == "ground":
        return float(arc(loop.a0, loop.b0))
    if link == "coupler":
        return math.acos(float(loop.ca))
    x, y, _ = bores[1].axis
    return math.atan2(y, x)


def _stand_sizes(params: SphericalParams) -> Iterator[FormSize]:
    """The post's direction and flange, and the motor's flange."""
    stand, hardware = params.stand, params.hardware
    post = post_direction(stand)
    yield AngleSize(CENTRE, X, _tuple(post))
    top = (shells_of(params).outside + stand.height) * post
    across = np.array([0.0, 0.0, flange_diameter(stand) / 2])
    yield LengthSize(_tuple(top - across), _tuple(top + across), diameter=True)
    yield RadiusSize(CENTRE, float(np.linalg.norm(top)), _tuple(post), flat=True)
    yield RadiusSize(CENTRE, float(np.linalg.norm(top)) - hardware.link_thickness, _tuple(post), flat=True)
    if stand.motor_flange is None:
        return
    way = -1.0 if motor_opposite(params) else 1.0
    low, half = flange_level(params), stand.motor_flange / 2 + EDGE
    yield LengthSize((way * low, -half, -half), (way * low, half, -half))
    yield LengthSize((way * (low + FLANGE), 0.0, -half), (way * (low + FLANGE), 0.0, half))
    yield LengthSize((way * low, half, half), (way * (low + FLANGE), half, half))
    yield LengthSize((0.0, half, half), (way * low, half, half))


def _slots(params: SphericalParams) -> Iterator[str]:
    """The slots of the coupler in words: width, angle, and the scale."""
    for seat in seats_of(linkage_of(params)):
        if seat.name in slotted_of(params):
            yield (
                f"Slot {seat.name}: {slot_width(params):g} wide, {math.degrees(seat.sweep):.3f}° about the "
                "axis of its link, as the STEP file has it"
            )
    if clamp_of(params) is not None:
        yield "Lines of the scales cut into the inner face"


def _cone(half_angle: float, span: Span, ends: Span) -> Iterator[FormSize]:
    """Angle of the pitch cone from its axis, its ends along the axis, and its greatest diameter."""
    low, high = (end * math.cos(half_angle) for end in span)
    yield AngleSize(CENTRE, X, _tuple(direction(half_angle)))
    yield LengthSize((low, 0.0, 0.0), (high, 0.0, 0.0))
    if ends != (low, high):
        yield LengthSize((ends[0], 0.0, 0.0), (ends[1], 0.0, 0.0))
    radius = high * math.tan(half_angle)
    yield LengthSize((high, 0.0, -radius), (high, 0.0, radius), diameter=True)
