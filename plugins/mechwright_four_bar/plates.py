"""The linkage as plates, pins and bushings, and how they stand in its motion.

Shafts and pins are pressed into one plate, and turn in plain bushings of the other, or in reamed bores
without them.
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from mechwright import GROUND, Colour, GeometryError, Instance, Outline, Part, Poses, kept
from mechwright import Joint as Held
from mechwright.contracts.joint import fixed
from mechwright.mechanics.linkage import Boss, Stack, bushing_part, pin_part
from mechwright.mechanics.planar import BodyMotion, Turning
from mechwright_four_bar.joints import HEAD, HEAD_HEIGHT, Joint, bosses, joints, turning_bore
from mechwright_four_bar.layout import Layout, hidden, laid_out
from mechwright_four_bar.loop import close
from mechwright_four_bar.params import FourBarParams
from mechwright_four_bar.phases import spare_holes
from mechwright_four_bar.reach import bar_of, course_of

BOLT = 1.5
"""Length of a post's bolt under the lower plate, in pin diameters: for a nut, or the machine's bed."""

STACK_SAMPLES = 361
"""Positions of the crank, both ends of the turn included, at which plates are kept apart."""

TRIED = {"auto": (1, 2), "one": (1,), "two": (2,)}
"""On how many sides of the links ground plates are tried; fewer need fewer parts."""

COLOURS: Mapping[str, Colour] = {
    "ground": (0.62, 0.64, 0.66),
    "ground-2": (0.62, 0.64, 0.66),
    "crank": (0.78, 0.36, 0.30),
    "coupler": (0.45, 0.58, 0.70),
    "follower": (0.80, 0.68, 0.42),
}


def pivot_of(params: FourBarParams) -> complex:
    """A0, x + i y, mm."""
    return complex(params.pivot_x, params.pivot_y)


def layout_of(params: FourBarParams) -> Layout:
    """Plates and layers, on one ground plate where that goes or is asked for, else between two.

    Raises
    ------
    GeometryError
        The bend of the coupler does not fit, or no order of layers keeps all plates apart.
    """
    found = _layout(params)
    if isinstance(found, str):
        raise GeometryError(found)
    return found


@kept
def _layout(params: FourBarParams) -> Layout | str:
    """The layout, or why there is none, which is asked for as often."""
    faults = []
    try:
        poses = _turn(params)
        for sides in TRIED[params.frame]:
            try:
                return laid_out(params, poses, sides)
            except GeometryError as error:
                faults.append(str(error))
    except GeometryError as error:
        return str(error)
    return faults[0]


def _turn(params: FourBarParams) -> dict[str, Poses]:
    """Poses of all bodies over the motion, seen from the ground."""
    bar, course = bar_of(params), course_of(params)
    if bar.lines_up and not course.rocks:
        raise GeometryError("ground: all links line up, and nothing decides which way they go on")
    phi = course.way(STACK_SAMPLES)
    still = replace(bar, ground_angle=0.0)
    bodies = close(still, phi - bar.ground_angle).bodies(still, 1.0)
    ground = BodyMotion.about(0j, Turning.of(np.zeros_like(phi)))
    return {name: body.poses() for name, body in {"ground": ground, **bodies}.items()}


def hidden_point(params: FourBarParams) -> tuple[str, str] | None:
    """What covers the coupler point from above and from below, if it lies between two ground plates."""
    layout, point = layout_of(params), params.coupler_point
    return hidden(params, layout, _turn(params), point) if layout.posts and point is not None else None


def layout_or_none(params: FourBarParams) -> Layout | None:
    """As :func:`layout_of`; None where there is no layout."""
    found = _layout(params)
    return None if isinstance(found, str) else found


def sides_of(params: FourBarParams) -> int:
    """On how many sides of the links ground plates stand; without a layout, on those first asked for."""
    layout = layout_or_none(params)
    return TRIED[params.frame][0] if layout is None else layout.sides


def joints_of(params: FourBarParams) -> dict[str, Joint]:
    """Shafts and pins by name."""
    return joints(params, sides_of(params))


def bosses_of(params: FourBarParams) -> dict[str, tuple[Boss, ...]]:
    """The bosses of every plate, in its body's frame."""
    return bosses(params, sides_of(params))


def outlines_of(params: FourBarParams) -> Mapping[str, Outline]:
    """The outline of every plate; raises as :func:`layout_of`."""
    return layout_of(params).outlines


def stack_of(params: FourBarParams) -> Stack:
    """The layers of plates and the heights of pins; raises as :func:`layout_of`."""
    return layout_of(params).stack


def posts_of(params: FourBarParams) -> dict[str, complex]:
    """The frames of the posts between two ground plates, and where they stand on them, x + i y, mm."""
    layout = layout_or_none(params)
    posts = () if layout is None else layout.posts
    return {f"ground-post-{number}": at for number, at in enumerate(posts, start=1)}


def frames_of(params: FourBarParams, bodies: Mapping[str, BodyMotion]) -> dict[str, Poses]:
    """Poses of all bodies, and of the frames on the pins' axes, from the motion of the moving bodies."""
    bar, pivot = bar_of(params), pivot_of(params)
    ground = BodyMotion.about(0j, Turning.of(np.full_like(bodies["crank"].turning.theta, bar.ground_angle)))
    moving = {"ground": ground, **bodies}
    places = [(name, name, 0j) for name in moving]
    places += [(one.frame, one.body, one.place) for one in joints_of(params).values() if one.place]
    places.append(("coupler-b", "coupler", complex(params.coupler)))
    places += [(name, "coupler", at) for name, at in spare_frames(params).items()]
    if sides_of(params) == 2:
        places.append(("ground-b0", "ground", complex(params.ground)))
    places += [(name, "ground", at) for name, at in posts_of(params).items()]
    poses = {}
    for frame, body, place in places:
        at = moving[body].point(place).position + pivot
        poses[frame] = Poses.planar(at.real, at.imag, moving[body].turning.theta)
    return poses


def spare_frames(params: FourBarParams) -> dict[str, complex]:
    """The frames of the coupler's holes for other phases, and their places in it, mm."""
    return {f"coupler-spare-{n}": at for n, (_, at) in enumerate(spare_holes(params), start=1)}


def held_by(params: FourBarParams) -> dict[str, Held]:
    """What holds the bodies of :func:`frames_of`, the loop closed in B."""
    held = fixed(GROUND, "ground")
    for one in joints_of(params).values():
        if one.place:
            held |= fixed(one.body, one.frame)
    if sides_of(params) == 2:
        held |= fixed("ground", "ground-b0", *posts_of(params))
    return {
        **held,
        **fixed("coupler", "coupler-b", *spare_frames(params)),
        "A0": Held("revolute", "ground", "crank", drives=True),
        "B0": Held("revolute", "ground", "follower", (params.ground, 0.0, 0.0)),
        "A": Held("revolute", "crank", "coupler", (params.crank, 0.0, 0.0)),
        "B": Held("revolute", "coupler", "follower", (params.coupler, 0.0, 0.0)),
    }


def parts_of(params: FourBarParams) -> tuple[Part, ...]:
    """Plates, shafts, pins, bushings and posts, each standing in the mechanism.

    Raises
    ------
    GeometryError
        As :func:`layout_of`.
    """
    layout = layout_of(params)
    parts = [
        Part(
            name,
            layout.outlines[name],
            params.ground_thickness if name.startswith("ground") else params.thickness,
            params.material,
            (Instance("ground" if name == "ground-2" else name, layout.stack.bottom(name)),),
            colour,
        )
        for name, colour in COLOURS.items()
        if name in layout.outlines
    ]
    return (
        *parts,
        *_pins(params, layout.stack),
        *_bushings(params, layout.stack),
        *_posts(params, layout.stack),
    )


def pin_length(params: FourBarParams, layers: Stack, name: str) -> float:
    """Length of a pin under its head, or of a shaft, mm."""
    low, high = layers.spans[name]
    one = joints_of(params)[name]
    return high - low + (one.below + one.above) * params.pin_diameter


def _pins(params: FourBarParams, layers: Stack) -> list[Part]:
    diameter = params.pin_diameter
    parts = []
    for name, joint in joints_of(params).items():
        length = pin_length(params, layers, name)
        instance = Instance(joint.frame, layers.spans[name][1] + joint.above * diameter - length)
        head = (HEAD * diameter, HEAD_HEIGHT * diameter) if joint.head else (0.0, 0.0)
        parts.append(pin_part(name, diameter, length, (instance,), *head))
    return parts


def _bushings(params: FourBarParams, layers: Stack) -> list[Part]:
    if params.bushing_wall == 0:
        return []
    bore, outside = params.pin_diameter + params.running_fit, turning_bore(params)
    ends = ("coupler", "coupler-b", *spare_frames(params))
    thin = [Instance(name, layers.bottom("coupler")) for name in ends]
    thick = [Instance("ground", layers.bottom("ground"))]
    if sides_of(params) == 2:
        thick.append(Instance("ground-b0", layers.bottom("ground-2")))
    else:
        thin.append(Instance("follower", layers.bottom("follower")))
    if params.thickness == params.ground_thickness:
        return [bushing_part("bushing", bore, outside, params.thickness, thin + thick)]
    return [
        bushing_part("bushing", bore, outside, params.thickness, thin),
        bushing_part("bushing-ground", bore, outside, params.ground_thickness, thick),
    ]


def _posts(params: FourBarParams, layers: Stack) -> list[Part]:
    """Tubes that hold two ground plates apart, and bolts that go through both and into what they stand on."""
    frames, diameter = posts_of(params), params.pin_diameter
    if not frames:
        return []
    under, over = layers.bottom("ground") + params.ground_thickness, layers.bottom("ground-2")
    low, high = layers.spans["post-1"]
    end = low - BOLT * diameter
    posts = [Instance(frame, under) for frame in frames]
    bolts = [Instance(frame, end) for frame in frames]
    return [
        bushing_part("post", diameter, diameter + 2 * params.rim, over - under, posts, params.material),
        pin_part("bolt", diameter, high - end, bolts, HEAD * diameter, HEAD_HEIGHT * diameter),
    ]
