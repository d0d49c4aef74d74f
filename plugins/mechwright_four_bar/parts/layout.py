"""How the links stand: on one ground plate, or between two that posts hold apart.

One plate carries both pivots from below. Where the ground is the shortest link, each pivot lies inside the
circle of the other one's link, so that the higher of crank and follower sends its shaft through the lower: no
order of layers is free. Then A0 stays in the first plate and B0 goes into a second one. Their four posts
stand outside everything that moves.

Where A or B is set in a slot of the coupler, its pin is a stud that is clamped there and turns in crank or
follower.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from mechwright import GeometryError, KinematicsError, Outline, Poses
from mechwright.mechanics.linkage import Boss, Closeness, Plate, Spindle, Stack, bent_link, rectangle, stack
from mechwright.mechanics.linkage.outlines import FILLET
from mechwright.mechanics.linkage.parts.axes import axes_of
from mechwright.mechanics.linkage.parts.layout import TRIED, Layout
from mechwright.mechanics.linkage.parts.outlines import (
    Eyes,
    Rectangle,
    eyes_of,
    ground_rectangle,
    link_outline,
)
from mechwright.mechanics.linkage.parts.pins import pins_of
from mechwright.mechanics.linkage.parts.scheme import GROUND_PLATES, Scheme
from mechwright.mechanics.linkage.scale import WIDTH
from mechwright.mechanics.linkage.slots import ArcSlot
from mechwright.mechanics.linkage.stacking import STACK_SAMPLES
from mechwright.mechanics.linkage.turned import HEAD, HEAD_HEIGHT
from mechwright.mechanics.planar import BodyMotion, Turning
from mechwright.mechanics.planar.dynamics import GROUND
from mechwright_four_bar.kinematics.loop import close
from mechwright_four_bar.kinematics.machine import FourBarMachine, linkage_of
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.parts.phases import (
    clamp_of_design,
    phases_of,
    set_joints,
    settings_of,
    slotted,
    spare_holes,
)

BEND = 2.0
"""Radius of the bent coupler's middle line, in web widths: its inner edge keeps 1.5 of them."""

MOVING = ("crank", "follower", "coupler")
"""Of several orders of layers that of the first of them is taken."""


def laid_out(table: FourBarMachine) -> Layout:
    """Plates and layers, on one ground plate where that goes or is asked for, else between two.

    Raises
    ------
    GeometryError
        The bend of the coupler does not fit, the bores of the ground plate run into each other, no order of
        layers keeps all plates apart, or a second ground plate would lie over clamps.
    """
    faults, phases = [], _phases(table)
    for sides in TRIED[table.params.frame]:
        try:
            return _laid_out(table, phases, bare(table, sides))
        except GeometryError as error:
            faults.append(error)
    raise faults[0]


def bare(table: FourBarMachine, sides: int) -> Layout:
    """Links and pins with ground plates on that many sides, without outlines and layers."""
    params, clamp, scheme = table.params, clamp_of_design(table.params), Scheme(sides)
    if sides == 2:
        scheme = Scheme(sides, frozenset({"B0"}))
    linkage, pins = linkage_of(table.bar, 0j, 0.0, params), []
    for pin in pins_of(linkage, axes_of(linkage), (), scheme):
        if clamp is not None and pin.eye in {"A", "B"} and slotted(params, pin.eye):
            turns = ((pin.body, pin.body),)
            pins.append(replace(pin, body="coupler", pressed=("coupler",), turning=turns, clamp=clamp))
        else:
            pins.append(replace(pin, head=sides == 1 and not pin.below))
    height = HEAD_HEIGHT * params.pin_diameter
    raised = {pin.turning[0][0]: height for pin in pins if pin.clamp is not None}
    spares = {f"coupler-spare-{n}": ("coupler", at) for n, (_, at) in enumerate(spare_holes(params), start=1)}
    return Layout(linkage, table.sizes, scheme, tuple(pins), (), {}, Stack({}, (), {}), (), raised, spares)


def layout_or_bare(table: FourBarMachine) -> Layout:
    """The layout; without one the pins on as many sides as are tried first."""
    return table.layout_or_none or bare(table, TRIED[table.params.frame][0])


def bosses(table: FourBarMachine, layout: Layout) -> dict[str, tuple[Boss, ...]]:
    """The bosses of every plate, in its body's frame."""
    found = {}
    for plate in (*GROUND_PLATES[: layout.scheme.sides], "crank", "coupler", "follower"):
        own = eyes_of(layout.linkage, layout.sizes, layout.scheme, layout.pins, (), plate).bosses
        found[plate] = own[::-1] if plate == "follower" else own
    bore, rim = layout.sizes.turning_bore, layout.sizes.rim
    for name, at in spare_holes(table.params):
        found["coupler"] += (Boss(at, bore / 2 + rim, bore, f"{name}-spare"),)
    for way in set_joints(table.params).values():
        if way.slot is not None:
            found["coupler"] += way.slot.bosses(_land(table.params, way.slot))
    return found


def _land(params: FourBarParams, slot: ArcSlot) -> float:
    """From a slot's centre line to the plate's edge: its rim, and room for the washer and a scale, mm."""
    clamp = clamp_of_design(params)
    return max(slot.width / 2 + params.rim, 0.0 if clamp is None else clamp.reach + WIDTH)


def _phases(table: FourBarMachine) -> list[dict[str, Poses]]:
    """Poses of all plates in each phase, that of the design first; phases that do not move are left out."""
    found, params = [_poses(table)], table.params
    if not params.phases:
        return found
    try:
        shown, (a, b) = phases_of(params), (places for _, places in settings_of(params))
    except KinematicsError:
        return found
    for number, other in enumerate(map(table.of, shown[1:]), start=1):
        if not other.bar.closes or math.isnan(other.closed_ways.course.travel) or other.through:
            continue
        poses = _poses(other)
        turned = poses["coupler"].rotation[:, 0, 0] + 1j * poses["coupler"].rotation[:, 1, 0]
        # The plate's frame is that of the first phase.
        direction = turned * abs(b[number] - a[number]) / (b[number] - a[number])
        x, y = poses["coupler"].position[:, 0], poses["coupler"].position[:, 1]
        place = np.asarray(x + 1j * y - a[number] * direction, dtype=np.complex128)
        poses["coupler"] = Poses.planar(place.real, place.imag, np.asarray(np.angle(direction), dtype=float))
        found.append(poses)
    return found


def _poses(table: FourBarMachine) -> dict[str, Poses]:
    """Poses of all bodies over the motion, seen from the ground."""
    if table.through:
        raise GeometryError("ground: all links line up, and nothing decides which way they go on")
    phi = table.closed_ways.course.way(STACK_SAMPLES)
    still = replace(table.bar, ground_angle=0.0)
    bodies = close(still, phi - table.bar.ground_angle).bodies(still, 1.0)
    ground = BodyMotion.about(0j, Turning.of(np.zeros_like(phi)))
    return {name: body.poses() for name, body in {"ground": ground, **bodies}.items()}


def _laid_out(table: FourBarMachine, phases: Sequence[Mapping[str, Poses]], layout: Layout) -> Layout:
    sizes, sides, own = layout.sizes, layout.scheme.sides, bosses(table, layout)
    if sides == 2 and layout.raised:
        raise GeometryError("clamps of the coupler are set from above, where a second ground plate would lie")
    if sides == 1:
        one, two = own["ground"]
        if abs(two.centre - one.centre) < (one.bore + two.bore) / 2 + sizes.rim:
            raise GeometryError("the bores of one ground plate leave less than a rim between them")
    outlines = {name: _outline(table, name, own[name]) for name in ("crank", "coupler", "follower")}
    plates = [
        Plate(name, name, outlines[name], sizes.thickness + layout.raised.get(name, 0.0)) for name in MOVING
    ]
    frame = ground_rectangle([*own["ground"], *own.get("ground-2", ())], sizes)
    if sides == 2:
        frame = _around(frame, [Closeness(plates, (), one, sizes.clearance).swept(MOVING) for one in phases])
    holes = [Boss(at, sizes.corner, sizes.hole, "screw") for at in frame.screws]
    for name in GROUND_PLATES[:sides]:
        outlines[name] = rectangle(frame.low, frame.high, sizes.corner, (*own[name], *holes))
        layers = (0,) if name == GROUND else ()
        plates.append(Plate(name, GROUND, outlines[name], sizes.ground_thickness, layers))
    spindles = [pin.spindle(sizes) for pin in layout.pins]
    for number, at in enumerate(frame.screws if sides == 2 else (), start=1):
        head = HEAD * sizes.hole / 2
        spindles.append(Spindle(f"post-{number}", GROUND, at, sizes.corner, GROUND_PLATES, head))
    dealt = _dealt(layout, plates, spindles, phases)
    return replace(layout, outlines=outlines, stack=dealt, screws=frame.screws)


def _around(frame: Rectangle, swept: Sequence[tuple[float, float, float, float]]) -> Rectangle:
    """With posts on whole millimetres outside of what is swept."""
    corner, low, high = frame.corner, frame.low, frame.high
    y0, y1 = min(one[1] for one in swept), max(one[3] for one in swept)
    low = complex(low.real, math.floor(min(y0 - corner, low.imag + corner)) - corner)
    high = complex(high.real, math.ceil(max(y1 + corner, high.imag - corner)) + corner)
    return Rectangle(low, high, corner)


def _dealt(
    layout: Layout,
    plates: Sequence[Plate],
    spindles: Sequence[Spindle],
    phases: Sequence[Mapping[str, Poses]],
) -> Stack:
    """Layers of plates; a coupler with clamps is on top."""
    clearance, washer = layout.sizes.clearance, layout.sizes.washer
    if not layout.raised:
        return stack(plates, spindles, phases, clearance, washer)
    faults: list[GeometryError] = []
    for top in range(2, len(MOVING) + 1):
        layers = {"coupler": (top,), "crank": tuple(range(1, top)), "follower": tuple(range(1, top))}
        dealt = [replace(plate, layers=layers.get(plate.name, plate.layers)) for plate in plates]
        try:
            return stack(dealt, spindles, phases, clearance, washer)
        except GeometryError as error:
            faults.append(error)
    raise faults[-1]


def hidden_point(table: FourBarMachine) -> tuple[str, str] | None:
    """What stands over and under the coupler point at some time, between two ground plates.

    None where one way out is always free.
    """
    layout, point = table.layout, table.params.coupler_point
    if not layout.posts or point is None:
        return None
    plates = [Plate(name, layout.link(name), outline, 1.0) for name, outline in layout.outlines.items()]
    pin = Spindle("point", "coupler", point, layout.sizes.pin_diameter / 2, ("coupler",))
    close_by = Closeness(plates, (pin,), _poses(table), layout.sizes.clearance)
    own = layout.stack.layer["coupler"]
    over, under = "", ""
    for name in (*MOVING, *GROUND_PLATES):
        plate = next(one for one in plates if one.name == name)
        layer = layout.stack.layer[name]
        if layer != own and close_by.spindle(pin, plate, pin.radius):
            over, under = (name, under) if layer > own else (over, name)
    return (over, under) if over and under else None


def _outline(table: FourBarMachine, name: str, own: tuple[Boss, ...]) -> Outline:
    """Crank and follower straight, the coupler straight, bent or about its point."""
    params = table.params
    if name == "coupler" and params.coupler_bend != 0:
        elbow = complex(params.coupler / 2, params.coupler_bend)
        return bent_link(own[0], own[1], elbow, params.web_width, FILLET, BEND * params.web_width)
    plain = link_outline(Eyes(own, ()), table.sizes)
    if name != "coupler":
        return plain
    slots = (way.slot.loop(f"{key}-slot") for key, way in set_joints(params).items() if way.slot is not None)
    return Outline(plain.outer, (*plain.inner, *slots))


def bend_fault(table: FourBarMachine) -> str:
    """Why the bent coupler cannot be drawn; nothing where it can."""
    try:
        _outline(table, "coupler", bosses(table, bare(table, 1))["coupler"])
    except GeometryError as error:
        return str(error)
    return ""
