"""How the five-bar stands: gears below the ground plate, links above it, the coupler on top.

From below: the disc that clamps the arm's gear, where there are phases; the gears, in one layer; the ground
plate on its posts; crank, arm and rocker in the flattest order that works in all phases; the coupler, so that
its clamps and its point are free from above.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from mechwright import GeometryError, Outline, Poses, circle
from mechwright.geometry import Loop
from mechwright.mechanics.linkage import (
    Boss,
    Closeness,
    Plate,
    Spindle,
    Stack,
    disc,
    hull_link,
    rectangle,
    stack,
    web_link,
)
from mechwright.mechanics.linkage.kinematics.period import course_of
from mechwright.mechanics.linkage.outlines import FILLET
from mechwright.mechanics.linkage.planar_table import AnyPlanarTable
from mechwright.mechanics.linkage.stacking import STACK_SAMPLES
from mechwright.mechanics.planar import BodyMotion, Turning
from mechwright_five_bar.kinematics.phases import settings_of
from mechwright_five_bar.kinematics.train import Train, gear_outlines, train_of
from mechwright_five_bar.parameters import FiveBarParams
from mechwright_five_bar.parts.hardware import clamp_of_design, head_of, turning_bore
from mechwright_five_bar.parts.hub import Hub, hub_of
from mechwright_five_bar.parts.joints import LINKS, bosses_of, joints_of, raised, running, slot_loops
from mechwright_five_bar.rules.gears import require_gears


@dataclass(frozen=True)
class Layout:
    """What the plates look like and where they stand.

    Parameters
    ----------
    outlines
        Plate to its outline in its body's frame.
    stack
        The layers.
    posts
        Axes of the posts under the ground plate, or of its screw holes, x + i y in its frame, mm.
    heights
        Height of each plate's underside, mm.
    """

    outlines: Mapping[str, Outline]
    stack: Stack
    posts: tuple[complex, ...]
    heights: Mapping[str, float]


def laid_out(params: FiveBarParams, phases: Sequence[AnyPlanarTable]) -> Layout:
    """Plates and their layers; ``params`` shows its first phase, the first of the ``phases``.

    Raises
    ------
    GeometryError
        The gears do not fit, the bores of the ground plate run into each other, or no order of layers keeps
        all plates apart.
    """
    require_gears(phases[0])
    train, hub = train_of(params), hub_of(params)
    bores = _gear_bores(params, train)
    # Gears keep off by their tip circles; their teeth take longer than all the layers and are drawn last.
    outlines = {name: disc(train.tip(name), ()) for name in train.places}
    if hub is not None:
        outlines["clamp"] = _clamp(params, hub, train)
    outlines["ground"], posts = _ground(params, train)
    outlines |= {name: link_outline(params, name) for name in LINKS}
    low = 1 if hub is not None else 0
    found = _dealt(params, outlines, [poses_of(params, one, k) for k, one in enumerate(phases)], low)
    outlines |= _gears(params, bores, hub)
    up = raised(params)
    heights = {name: found.bottom(name) + up.get(name, 0.0) for name in outlines}
    if hub is not None:  # it lies on the gear that it clamps, and leaves its layer by the gap
        heights["clamp"] = heights["wheel"] - params.gear_thickness
    return Layout(outlines, found, posts, heights)


def _dealt(
    params: FiveBarParams, outlines: Mapping[str, Outline], phases: list[dict[str, Poses]], gears: int
) -> Stack:
    """Layers with the coupler on top, as few as will do."""
    up = raised(params)
    fixed: dict[str, tuple[int, float, str]] = {
        "clamp": (0, params.gear_thickness, "arm"),
        "pinion": (gears, params.gear_thickness, "crank"),
        "idler": (gears, params.gear_thickness, "idler"),
        "wheel": (gears, params.gear_thickness, "wheel"),
        "ground": (gears + 1, params.ground_thickness, "ground"),
    }
    first, train = gears + 2, train_of(params)
    faults: list[GeometryError] = []
    spindles, measured = _spindles(params), list[Closeness]()
    for top in range(first + 1, first + len(LINKS)):
        plates = []
        for name, outline in outlines.items():
            if name in fixed:
                layer, thickness, body = fixed[name]
                plates.append(Plate(name, body, outline, thickness, (layer,)))
            else:
                layers = (top,) if name == "coupler" else tuple(range(first, top))
                plates.append(Plate(name, name, outline, params.thickness + up.get(name, 0.0), layers))
        measured = measured or [Closeness(plates, spindles, one, params.clearance) for one in phases]
        try:
            return stack(
                plates,
                spindles,
                phases,
                params.clearance,
                params.washer,
                train.meshes(),
                measured=measured,
            )
        except GeometryError as error:
            faults.append(error)
    raise faults[-1]


def poses_of(params: FiveBarParams, shown: AnyPlanarTable, number: int) -> dict[str, Poses]:
    """Poses of all plates over the period of a phase, from 0, seen from the ground.

    The coupler's are those of its plate, whose frame is that of the first phase.
    """
    course, ground = course_of(shown), math.radians(params.ground_angle)
    turns = max(1.0, abs(course.travel) / math.tau)
    theta = course.way(math.ceil(STACK_SAMPLES * turns))
    found = shown.solved_at(theta, 0).bodies
    bodies = {name: found[name].poses() for name in LINKS}
    a, c = (places[number] for _, places in settings_of(params))
    direction = found["coupler"].turning.direction * abs(c - a) / (c - a)
    place = found["coupler"].origin.position - a * direction
    bodies["coupler"] = Poses.planar(place.real, place.imag, np.angle(direction))
    still = {"ground": np.full_like(theta, ground), "idler": theta, "wheel": theta}
    train = train_of(params)
    for name, angle in still.items():
        at = train.places.get(name, 0j) * complex(math.cos(ground), math.sin(ground))
        bodies[name] = BodyMotion.about(at, Turning.of(angle)).poses()
    return bodies


def _spindles(params: FiveBarParams) -> list[Spindle]:
    clamp, head = clamp_of_design(params), head_of(params)[0] / 2
    found = []
    for name, one in joints_of(params).items():
        above = head if one.head else clamp.reach if one.stud and clamp is not None else 0.0
        found.append(Spindle(name, one.body, one.place, params.pin_diameter / 2, one.plates, above))
    return found


def link_outline(params: FiveBarParams, name: str) -> Outline:
    """Crank, arm and rocker straight, the coupler about its point."""
    bosses = bosses_of(params)[name]
    if name == "coupler":
        hull = hull_link(bosses)
        return Outline(hull.outer, (*hull.inner, *slot_loops(params)))
    one, two = bosses
    half, least = params.web_width / 2, min(one.radius, two.radius)
    if half < least:
        taken = sum(math.sqrt((boss.radius + FILLET) ** 2 - (half + FILLET) ** 2) for boss in bosses)
        if taken < abs(two.centre - one.centre):
            return web_link(one, two, params.web_width, FILLET)
    return hull_link(bosses)


def _gear_bores(params: FiveBarParams, train: Train) -> dict[str, float]:
    """Diameter of each gear's bore, mm, which has to leave a rim below the teeth."""
    bores = {"pinion": params.pin_diameter, "idler": turning_bore(params), "wheel": running(params)}
    found = {name: bores[name] for name in train.teeth}
    for name, bore in found.items():
        wall = train.root(name) - bore / 2
        if wall < params.rim:
            teeth = {"pinion": "crank_teeth", "idler": "idler_teeth", "wheel": "arm_teeth"}[name]
            raise GeometryError(
                f"{teeth}: the {name} has {wall:.4g} mm between bore and teeth, and the rim is "
                f"{params.rim:g} mm"
            )
    return found


def _gears(params: FiveBarParams, bores: Mapping[str, float], hub: Hub | None) -> dict[str, Outline]:
    found = {}
    for name, outside in gear_outlines(params).items():
        holes = [_hole(0j, bores[name])]
        if name == "wheel" and hub is not None:
            holes += [_hole(at, core_of(hub)) for at in screw_places(hub)]
        found[name] = Outline(outside, tuple(holes))
    return found


def screw_places(hub: Hub) -> tuple[complex, ...]:
    """Where the screws stand in the wheel's frame: in the slots in every phase."""
    return tuple(complex(slot.at(0.0) * np.exp(-1j * hub.first)) for slot in hub.slots)


def core_of(hub: Hub) -> float:
    """Diameter of the holes for threads, mm."""
    return hub.clamp.size.tap_drill


def _clamp(params: FiveBarParams, hub: Hub, train: Train) -> Outline:
    """The disc below the wheel."""
    others = {name: at for name, at in train.places.items() if name != "wheel"}
    for name, at in others.items():
        room = abs(at - train.places["wheel"]) - hub.outside - params.clearance - head_of(params)[0] / 2
        if room < 0:
            raise GeometryError(
                f"ground: the clamp of the arm's gear, {2 * hub.outside:g} mm wide, meets the shaft of the "
                f"{name}; "
                f"{-room:.3g} mm are missing"
            )
    round_ = disc(hub.outside, ())
    return Outline(
        round_.outer, (_hole(0j, params.pin_diameter), *(slot.loop("clamp-slot") for slot in hub.slots))
    )


def _hole(at: complex, diameter: float) -> Loop:
    return Loop((circle((at.real, at.imag), diameter / 2, clockwise=True, tag="bore"),))


def _ground(params: FiveBarParams, train: Train) -> tuple[Outline, tuple[complex, ...]]:
    """A plate over all gears, its posts outside of them."""
    turning, corner = turning_bore(params), post_radius(params)
    axes = [Boss(train.places["pinion"], 0.0, turning, "A0"), Boss(train.places["wheel"], 0.0, turning, "B0")]
    if "idler" in train.places:
        axes.append(Boss(train.places["idler"], 0.0, params.pin_diameter, "idler"))
    for number, one in enumerate(axes):
        for two in axes[:number]:
            if abs(one.centre - two.centre) < (one.bore + two.bore) / 2 + params.rim:
                raise GeometryError(
                    "ground: the bores of the ground plate leave less than a rim between them"
                )
    tips = {name: train.tip(name) for name in train.places}
    low = complex(*(min(_part(at, k) - tips[name] for name, at in train.places.items()) for k in (0, 1)))
    high = complex(*(max(_part(at, k) + tips[name] for name, at in train.places.items()) for k in (0, 1)))
    # A post in the corner beside the smallest gear clears it by its own radius.
    least = min(tips.values())
    out = max(0.0, (least + corner + params.clearance) / math.sqrt(2) - least) + params.post_offset
    low, high = low - out * (1 + 1j), high + out * (1 + 1j)
    posts = tuple(complex(x, y) for x in (low.real, high.real) for y in (low.imag, high.imag))
    edge = corner * (1 + 1j)
    bore, tag = (params.pin_diameter, "post") if params.screw_hole is None else (params.screw_hole, "screw")
    holes = [*axes, *(Boss(at, corner, bore, tag) for at in posts)]
    return rectangle(low - edge, high + edge, corner, holes), posts


def _part(z: complex, number: int) -> float:
    return (z.real, z.imag)[number]


def post_radius(params: FiveBarParams) -> float:
    """Of posts, and of the ground plate's corners about them or about its screws, mm."""
    return max(params.pin_diameter, params.screw_hole or 0.0) / 2 + params.rim
