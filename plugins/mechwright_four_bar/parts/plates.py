"""The linkage as plates, pins and bushings, and how they stand in its motion.

Shafts and pins are pressed into one plate, and turn in plain bushings of the other, or in reamed bores
without them.
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from mechwright import GROUND, Colour, GeometryError, Instance, KinematicsError, Outline, Part, Poses, kept
from mechwright import Joint as Held
from mechwright.contracts.joint import fixed
from mechwright.contracts.turned import Step, Turned
from mechwright.mechanics.linkage import Boss, Stack, bushing_part, pin_part
from mechwright.mechanics.linkage.clamp import screw_parts, stud_part
from mechwright.mechanics.linkage.stacking import STACK_SAMPLES
from mechwright.mechanics.linkage.turned import HEAD, HEAD_HEIGHT
from mechwright.mechanics.planar import BodyMotion, Turning
from mechwright.standards.parts import GREY
from mechwright_four_bar.kinematics.loop import close
from mechwright_four_bar.kinematics.reach import bar_of, course_of, is_lever, within
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.parts.joints import Joint, bosses, joints
from mechwright_four_bar.parts.layout import Layout, hidden, laid_out
from mechwright_four_bar.parts.marks import scales
from mechwright_four_bar.parts.phases import (
    clamp_of_design,
    phases_of,
    settings_of,
    slotted,
    spare_holes,
)
from mechwright_four_bar.parts.sizes import turning_bore

BOLT = 1.5
"""Length of a post's bolt under the lower plate, in its diameters: for a nut, or the machine's bed."""

THREAD = 5.0
"""Of the end under the lower plate where ``screw_hole`` is given, mm: it goes into a frame's pillars."""

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


def unloaded(params: FourBarParams) -> FourBarParams:
    """The same plates, at one load and speed: what is kept of them serves all loads and speeds."""
    return params.model_copy(update={"load_torque": 0.0, "speed": 60.0})


def layout_of(params: FourBarParams) -> Layout:
    """Plates and layers, on one ground plate where that goes or is asked for, else between two.

    Raises
    ------
    GeometryError
        The bend of the coupler does not fit, or no order of layers keeps all plates apart.
    """
    found = _layout(unloaded(params))
    if isinstance(found, str):
        raise GeometryError(found)
    return found


@kept
def _layout(params: FourBarParams) -> Layout | str:
    """The layout, or why there is none, which is asked for as often."""
    faults = []
    try:
        phases = _turns(params)
        for sides in TRIED[params.frame]:
            try:
                return laid_out(params, phases, sides)
            except GeometryError as error:
                faults.append(str(error))
    except GeometryError as error:
        return str(error)
    return faults[0]


def _turns(params: FourBarParams) -> list[dict[str, Poses]]:
    """Poses of all plates in each phase, that of the design first; phases that do not move are left out."""
    found = [_turn(params)]
    if not params.phases:
        return found
    try:
        shown, (a, b) = phases_of(params), (places for _, places in settings_of(params))
    except KinematicsError:
        return found
    for number, other in enumerate(shown[1:], start=1):
        bar = bar_of(other)
        if not bar.closes or (within(other) is None if is_lever(other) else bar.lines_up):
            continue
        poses = _turn(other)
        turned = poses["coupler"].rotation[:, 0, 0] + 1j * poses["coupler"].rotation[:, 1, 0]
        # The plate's frame is that of the first phase.
        direction = turned * abs(b[number] - a[number]) / (b[number] - a[number])
        x, y = poses["coupler"].position[:, 0], poses["coupler"].position[:, 1]
        place = np.asarray(x + 1j * y - a[number] * direction, dtype=np.complex128)
        poses["coupler"] = Poses.planar(place.real, place.imag, np.asarray(np.angle(direction), dtype=float))
        found.append(poses)
    return found


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
    found = _layout(unloaded(params))
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
    layout, marks = layout_of(params), scales(params)
    parts = [
        Part(
            name,
            layout.outlines[name],
            params.ground_thickness if name.startswith("ground") else params.thickness,
            params.material,
            (Instance("ground" if name == "ground-2" else name, layout.bottom(name)),),
            colour,
            details=marks.get(name, ()),
        )
        for name, colour in COLOURS.items()
        if name in layout.outlines
    ]
    return (
        *parts,
        *_pins(params, layout),
        *_bushings(params, layout),
        *_clamps(params, layout),
        *_posts(params, layout.stack),
    )


def pin_length(params: FourBarParams, name: str) -> float:
    """Length of a pin under its head, of a stud over it, or of a shaft, mm."""
    low, high = span_of(params, layout_of(params), name)
    one = joints_of(params)[name]
    return high - low + (one.below + one.above) * params.pin_diameter


def span_of(params: FourBarParams, layout: Layout, name: str) -> tuple[float, float]:
    """Heights of a pin's lower and upper end at its plates, mm: a stud ends under the coupler."""
    low, high = layout.stack.spans[name]
    if joints_of(params)[name].stud:
        return low + HEAD_HEIGHT * params.pin_diameter, layout.bottom("coupler")
    return low, high


def _pins(params: FourBarParams, layout: Layout) -> list[Part]:
    diameter, clamp = params.pin_diameter, clamp_of_design(params)
    head = (HEAD * diameter, HEAD_HEIGHT * diameter)
    parts = []
    for name, joint in joints_of(params).items():
        length, (low, high) = pin_length(params, name), span_of(params, layout, name)
        if joint.stud and clamp is not None:
            at = Instance("coupler" if name == "pin-a" else "coupler-b", low - head[1])
            parts.append(stud_part(name, diameter, length, head, clamp, at))
            continue
        instance = Instance(joint.frame, high + joint.above * diameter - length)
        parts.append(pin_part(name, diameter, length, (instance,), *(head if joint.head else (0.0, 0.0))))
    return parts


def bushed(params: FourBarParams) -> dict[str, tuple[str, complex, str]]:
    """Frames of the bores of links that have a bushing: body, place in it, mm, and plate."""
    found: dict[str, tuple[str, complex, str]] = {}
    for name, own, frame, end in (
        ("A", "coupler", "crank-a", ("crank", complex(params.crank))),
        ("B", "coupler-b", "follower-b", ("follower", complex(params.follower))),
    ):
        if slotted(params, name):
            found[frame] = (*end, end[0])
        else:
            found[own] = ("coupler", complex(params.coupler) if name == "B" else 0j, "coupler")
    found |= {name: ("coupler", at, "coupler") for name, at in spare_frames(params).items()}
    if sides_of(params) == 1:
        found["follower"] = ("follower", 0j, "follower")
    return found


def _bushings(params: FourBarParams, layout: Layout) -> list[Part]:
    if params.bushing_wall == 0:
        return []
    bore, outside = params.pin_diameter + params.running_fit, turning_bore(params)
    thin = [Instance(name, layout.bottom(plate)) for name, (_, _, plate) in bushed(params).items()]
    thick = [Instance("ground", layout.bottom("ground"))]
    if sides_of(params) == 2:
        thick.append(Instance("ground-b0", layout.bottom("ground-2")))
    if params.thickness == params.ground_thickness:
        return [bushing_part("bushing", bore, outside, params.thickness, thin + thick)]
    return [
        bushing_part("bushing", bore, outside, params.thickness, thin),
        bushing_part("bushing-ground", bore, outside, params.ground_thickness, thick),
    ]


def _clamps(params: FourBarParams, layout: Layout) -> list[Part]:
    """Screws and washers on the coupler."""
    clamp, top = clamp_of_design(params), layout.bottom("coupler") + params.thickness
    frames = [frame for name, frame in (("A", "coupler"), ("B", "coupler-b")) if slotted(params, name)]
    if clamp is None or not frames:
        return []
    return screw_parts("clamp", clamp, [Instance(frame, top) for frame in frames])


def _posts(params: FourBarParams, layers: Stack) -> list[Part]:
    """Tubes that hold two ground plates apart, and bolts that go through both and into what they stand on."""
    frames, diameter = posts_of(params), params.screw_hole or params.pin_diameter
    if not frames:
        return []
    under, over = layers.bottom("ground") + params.ground_thickness, layers.bottom("ground-2")
    low, high = layers.spans["post-1"]
    end = low - BOLT * diameter
    posts = [Instance(frame, under) for frame in frames]
    bolts = [Instance(frame, end) for frame in frames]
    tube = bushing_part("post", diameter, diameter + 2 * params.rim, over - under, posts, params.material)
    if params.screw_hole is None or diameter <= THREAD:
        return [
            tube,
            pin_part("bolt", diameter, high - end, bolts, HEAD * diameter, HEAD_HEIGHT * diameter),
        ]
    form = _threaded(diameter, low - end, high - low)
    return [tube, Part("bolt", None, 0.0, "steel", tuple(bolts), GREY, turned=form)]


def _threaded(diameter: float, end: float, grip: float) -> Turned:
    """A bolt whose end has a thread; its head is turned by two flats. Sizes in mm."""
    head = Step(HEAD * diameter, HEAD_HEIGHT * diameter)
    note = (
        f"thread M{THREAD:g} on the lower end, {end:g} long; two flats {1.3 * diameter:.1f} across the head"
    )
    return Turned((Step(THREAD, end), Step(diameter, grip), head), note=note)
