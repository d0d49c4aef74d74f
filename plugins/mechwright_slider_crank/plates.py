"""The plates of a slider-crank, the pins that join them, and the layers they stand in.

Base and rails belong to the body ``base``, whose coordinates are the slide frame: origin in A0, x along the
slide. The crank's pin and shaft are pressed into the crank, the slider's pin into the slider, the rails'
dowels into rails and base. Rod and base carry bushings.
"""

from collections.abc import Callable, Mapping, Set
from dataclasses import dataclass, replace

import numpy as np

from mechwright import (
    GROUND,
    Array,
    Colour,
    GeometryError,
    Instance,
    Joint,
    MechwrightError,
    Outline,
    Part,
    Poses,
    kept,
)
from mechwright.contracts.joint import fixed
from mechwright.mechanics.linkage import (
    BUSHING_MATERIAL,
    PIN_MATERIAL,
    Boss,
    Closeness,
    Mass,
    Plate,
    Spindle,
    Stack,
    bushing_part,
    cylinder_mass,
    pin_part,
    plate_mass,
    stack,
    together,
)
from mechwright.mechanics.planar import BodyMotion, Turning
from mechwright.standards.parts import GREY, dowel_part
from mechwright_slider_crank.base import (
    base_outline,
    hole_places,
    rim_of,
    shaft_end,
    shaft_form,
    shaft_masses,
)
from mechwright_slider_crank.course import course_of, ends_of
from mechwright_slider_crank.outlines import crank_outline, rails_of, rod_outline, slider_outline
from mechwright_slider_crank.params import SliderCrankParams
from mechwright_slider_crank.sizes import Sizes, clear_overhang, sizes_of

TURN_SAMPLES = 361
"""Positions of a turn at which the layers are judged: a degree moves a 100 mm crank by 1.7 mm."""

MOVING = ("crank", "rod", "slider")
"""Plates that do not stand still."""

COLOURS: dict[str, Colour] = {
    "base": (0.78, 0.80, 0.82),
    "rail": (0.60, 0.66, 0.72),
    "crank": (0.80, 0.45, 0.30),
    "rod": (0.35, 0.52, 0.70),
    "slider": (0.85, 0.70, 0.35),
}


@dataclass(frozen=True)
class Layout:
    """Everything that is made, and where it stands.

    Parameters
    ----------
    sizes
        All sizes.
    outlines
        Plate to its outline in its body's coordinates; both rails are one part.
    rails
        Where the rails' coordinates stand in the base's, mm.
    dowels
        The rails' dowels in the base's coordinates, mm.
    stack
        The layers.
    screws
        The base's holes for screws, counter-clockwise from the lower left one; none without.
    heads
        Whether the joint pins have heads.
    """

    sizes: Sizes
    outlines: dict[str, Outline]
    rails: tuple[complex, complex]
    dowels: tuple[complex, ...]
    stack: Stack
    screws: tuple[complex, ...]
    heads: bool


def unloaded(params: SliderCrankParams) -> SliderCrankParams:
    """The same plates, at one load and speed: what is kept of them serves all loads and speeds."""
    plain = params.model_copy(update={"load": 0.0, "speed": 60.0})
    pin = sizes_of(params).pin
    # A pin that is left out may be thicker for the load.
    return plain if sizes_of(plain).pin == pin else plain.model_copy(update={"pin": pin})


def layout_of(params: SliderCrankParams) -> Layout:
    """Draw all plates and find their layers.

    Raises
    ------
    GeometryError
        A plate cannot be drawn, or no order of layers keeps the plates apart; the message says why.
    KinematicsError
        The crank cannot turn.
    """
    return _layout(unloaded(params), standing_sizes(params))


def standing_sizes(params: SliderCrankParams) -> Sizes:
    """The sizes as they stand: the usual rails, or longer ones where only with those layers are found."""
    return _standing_sizes(unloaded(params))


@kept
def _standing_sizes(params: SliderCrankParams) -> Sizes:
    usual = sizes_of(params)
    if params.rail_overhang is not None or _has_layers(params, usual):
        return usual
    try:
        ends = ends_of(params)
    except MechwrightError:
        return usual
    low, high = sorted((ends.near_position, ends.far_position))
    longer = replace(usual, overhang=clear_overhang(usual, params.crank, (low, high), params.clearance))
    return longer if _has_layers(params, longer) else usual


def _has_layers(params: SliderCrankParams, sizes: Sizes) -> bool:
    try:
        _layout(params, sizes)
    except MechwrightError:
        return False
    return True


@kept
def _layout(params: SliderCrankParams, sizes: Sizes) -> Layout:
    ends = ends_of(params)
    outlines = {"crank": crank_outline(params), "rod": rod_outline(params)}
    outlines["slider"] = slider_outline(sizes)
    outlines["rail"], rails, dowels = rails_of(params, sizes, ends)
    rim = rim_of(sizes, outlines["rail"], rails)
    poses = _link_poses(params, course_of(params).way(TURN_SAMPLES))
    screws: tuple[complex, ...] = ()
    if params.screw_hole is not None:
        still = seen_from_base(params, poses)
        swept = Closeness(_moving(params, outlines), (), still, params.clearance).swept(MOVING)
        screws = hole_places(params, params.screw_hole, swept, rim)
    holes = (Boss(0j, 0, sizes.base_bore, "shaft"), *(Boss(at, 0, sizes.dowel, "dowel") for at in dowels))
    outlines["base"] = base_outline(params.screw_hole, rim, holes, screws)
    for heads in (True, False):
        try:
            found = _stack(params, sizes, outlines, rails, dowels, heads)
        except GeometryError:
            if heads:
                continue
            raise
        return Layout(sizes, outlines, rails, dowels, found, screws, heads)
    raise AssertionError("the loop returns or raises")


def _moving(params: SliderCrankParams, outlines: Mapping[str, Outline]) -> list[Plate]:
    return [Plate(name, name, outlines[name], params.thickness) for name in MOVING]


def standing(
    params: SliderCrankParams, wanted: Set[str]
) -> tuple[list[Plate], list[Spindle], dict[str, Poses], float]:
    """Some plates above the base, spindles without heads, poses, and the clearance that they keep.

    Plates are ``wanted`` by name, or ``"rail"``. Rails go on as far as the design says, or by their width.
    """
    sizes = sizes_of(params)
    made: dict[str, Callable[[], Outline]] = {
        "crank": lambda: crank_outline(params),
        "rod": lambda: rod_outline(params),
        "slider": lambda: slider_outline(sizes),
    }
    plates = [Plate(name, name, made[name](), params.thickness) for name in MOVING if name in wanted]
    rail, rails, dowels = rails_of(params, sizes, ends_of(params))
    if "rail" in wanted:
        plates += _rails(params, rail, rails)
    poses = _link_poses(params, course_of(params).way(TURN_SAMPLES))
    return plates, _spindles(params, sizes, dowels, heads=False), poses, params.clearance


def _above(
    params: SliderCrankParams, outlines: Mapping[str, Outline], rails: tuple[complex, complex]
) -> list[Plate]:
    """The plates above the base."""
    return _moving(params, outlines) + _rails(params, outlines["rail"], rails)


def _rails(params: SliderCrankParams, outline: Outline, places: tuple[complex, complex]) -> list[Plate]:
    return [
        Plate(f"rail-{number}", "base", outline.moved(place.real, place.imag), params.thickness)
        for number, place in enumerate(places, start=1)
    ]


def _spindles(
    params: SliderCrankParams, sizes: Sizes, dowels: tuple[complex, ...], *, heads: bool
) -> list[Spindle]:
    head = sizes.head[0] / 2 if heads else 0.0
    return [
        Spindle("shaft", "crank", 0j, sizes.shaft / 2, ("base", "crank")),
        Spindle("crank-pin", "crank", complex(params.crank), sizes.pin / 2, ("crank", "rod"), head),
        Spindle("wrist-pin", "slider", 0j, sizes.pin / 2, ("rod", "slider"), head),
        *(
            Spindle(f"dowel-{number}", "base", at, sizes.spacer, ("base", f"rail-{1 + (number > 2)}"))
            for number, at in enumerate(dowels, start=1)
        ),
    ]


def _stack(
    params: SliderCrankParams,
    sizes: Sizes,
    outlines: dict[str, Outline],
    rails: tuple[complex, complex],
    dowels: tuple[complex, ...],
    heads: bool,
) -> Stack:
    base = Plate("base", "base", outlines["base"], params.thickness, (0,))
    return stack(
        [base, *_above(params, outlines, rails)],
        _spindles(params, sizes, dowels, heads=heads),
        _link_poses(params, course_of(params).way(TURN_SAMPLES)),
        params.clearance,
        params.gap,
        neighbours=(("rail-1", "slider"), ("rail-2", "slider")),
        together=(("slider", "rail-1", "rail-2"),),
    )


def body_poses(params: SliderCrankParams, phi: Array) -> dict[str, Poses]:
    """Poses of all bodies at crank angles (n,), rad, and of the copies of parts that are fixed in them."""
    bodies, base = params.linkage.bodies(phi), _standing(params, phi)
    _, rails, dowels = rails_of(params, standing_sizes(params), ends_of(params))
    fixed = {f"rail-{number}": (base, place) for number, place in enumerate(rails, start=1)}
    fixed |= {f"dowel-{number}": (base, place) for number, place in enumerate(dowels, start=1)}
    fixed["crank-pin"] = (bodies.crank, complex(params.crank))
    fixed["rod-end"] = (bodies.rod, complex(params.rod))
    poses = _link_poses(params, phi)
    for name, (body, place) in fixed.items():
        poses[name] = BodyMotion(body.point(place), body.turning).poses()
    return poses


def _link_poses(params: SliderCrankParams, phi: Array) -> dict[str, Poses]:
    """Poses of base, crank, rod and slider alone."""
    bodies = params.linkage.bodies(phi)
    return {
        "base": _standing(params, phi).poses(),
        "crank": bodies.crank.poses(),
        "rod": bodies.rod.poses(),
        "slider": bodies.slider.poses(),
    }


def _standing(params: SliderCrankParams, phi: Array) -> BodyMotion:
    return BodyMotion.about(0j, Turning.of(np.full(phi.shape, params.linkage.direction)))


def seen_from_base(params: SliderCrankParams, poses: Mapping[str, Poses]) -> dict[str, Poses]:
    """The same poses in the base's coordinates."""
    turn = Poses.planar(np.zeros(1), np.zeros(1), np.full(1, -params.linkage.direction)).rotation[0]
    return {name: Poses(one.position @ turn.T, turn @ one.rotation) for name, one in poses.items()}


def held_by(params: SliderCrankParams) -> dict[str, Joint]:
    """What holds the bodies of :func:`body_poses`, the loop closed in the slider's pin."""
    rails = [f"rail-{number}" for number in (1, 2)]
    dowels = [f"dowel-{number}" for number in range(1, 5)]
    return {
        **fixed(GROUND, "base"),
        **fixed("base", *rails, *dowels),
        **fixed("crank", "crank-pin"),
        **fixed("rod", "rod-end"),
        "shaft": Joint("revolute", "base", "crank", drives=True),
        "guide": Joint("prismatic", "base", "slider", (0.0, params.offset, 0.0), (1.0, 0.0, 0.0)),
        "pin-a": Joint("revolute", "crank", "rod", (params.crank, 0.0, 0.0)),
        "pin-b": Joint("revolute", "rod", "slider", (params.rod, 0.0, 0.0)),
    }


def parts_of(params: SliderCrankParams) -> tuple[Part, ...]:
    """All parts, plates first.

    Raises
    ------
    GeometryError, KinematicsError
        As :func:`layout_of`.
    """
    layout = layout_of(params)
    sizes, heights, spans = layout.sizes, layout.stack, layout.stack.spans
    at: dict[str, tuple[Instance, ...]] = {
        name: (Instance(name, heights.bottom(name)),) for name in ("base", "crank", "rod", "slider")
    }
    under, over = heights.bottom("base") + params.thickness, heights.bottom("rail-1")
    lowest = heights.layer["rail-1"] == 1  # rails of the first layer lie on the base, others on spacers
    foot = under if lowest else over
    at["rail"] = tuple(Instance(name, foot) for name in ("rail-1", "rail-2"))
    parts = [
        Part(name, layout.outlines[name], params.thickness, params.material, at[name], COLOURS[name])
        for name in ("base", "rail", "crank", "rod", "slider")
    ]
    parts += _shaft_parts(params, spans["shaft"])
    for name, body in (("crank-pin", "crank-pin"), ("wrist-pin", "slider")):
        low, high = spans[name]
        head = sizes.head if _has_head(layout, name) else (0.0, 0.0)
        length = high - low + (params.gap if head[0] else 0.0)
        parts.append(pin_part(name, sizes.pin, length, (Instance(body, low),), *head))
    low, high = spans["dowel-1"]
    dowels = tuple(Instance(f"dowel-{number}", low) for number in range(1, 5))
    parts.append(dowel_part("dowel", sizes.dowel, round(high - low - (over - foot), 6), dowels))
    if not lowest:
        spacers = tuple(Instance(f"dowel-{number}", under) for number in range(1, 5))
        parts.append(
            bushing_part("spacer", sizes.dowel, 2 * sizes.spacer, over - under, spacers, params.material)
        )
    if params.bushing > 0:
        rod = tuple(Instance(name, heights.bottom("rod")) for name in ("rod", "rod-end"))
        parts.append(bushing_part("bushing", sizes.pin, sizes.rod_bore, params.thickness, rod))
        base = (Instance("base", heights.bottom("base")),)
        parts.append(bushing_part("shaft-bushing", sizes.shaft, sizes.base_bore, params.thickness, base))
    return tuple(parts)


def _shaft_parts(params: SliderCrankParams, span: tuple[float, float]) -> list[Part]:
    """The crank's shaft, and the circlip on it under the base."""
    (low, high), end = span, shaft_end(params)
    at = Instance("crank", low - end.whole)
    form = shaft_form(params, high - low)
    parts = [Part("shaft", None, 0.0, PIN_MATERIAL, (at,), GREY, turned=form)]
    if end.ring is not None:
        under = (Instance("crank", low - params.gap - end.ring.thickness),)
        name = f"circlip-{end.ring.size:g}"
        parts.append(Part(name, None, 0.0, PIN_MATERIAL, under, GREY, bought=end.ring.bought))
    return parts


def _has_head(layout: Layout, pin: str) -> bool:
    """A pin has a head where the rod is on top of it: the plate it is pressed into needs none."""
    other = {"crank-pin": "crank", "wrist-pin": "slider"}[pin]
    return layout.heads and layout.stack.layer["rod"] > layout.stack.layer[other]


def masses_of(params: SliderCrankParams) -> dict[str, Mass]:
    """Mass of crank, rod and slider, each with the pins and bushings that are fixed in it."""
    layout = layout_of(params)
    sizes, spans = layout.sizes, layout.stack.spans

    def plate(name: str) -> Mass:
        return plate_mass(layout.outlines[name], params.thickness, params.material)

    def pin(name: str, centre: complex) -> list[Mass]:
        low, high = spans[name]
        found = [cylinder_mass(sizes.pin, high - low, PIN_MATERIAL, centre)]
        if _has_head(layout, name):
            found += [
                cylinder_mass(sizes.pin, params.gap, PIN_MATERIAL, centre),
                cylinder_mass(*sizes.head, PIN_MATERIAL, centre),
            ]
        return found

    low, high = spans["shaft"]
    shaft = shaft_masses(params, high - low)
    bushings = [
        cylinder_mass(sizes.rod_bore, params.thickness, BUSHING_MATERIAL, complex(x), sizes.pin)
        for x in (0.0, params.rod)
        if params.bushing > 0
    ]
    return {
        "crank": together([plate("crank"), *shaft, *pin("crank-pin", complex(params.crank))]),
        "rod": together([plate("rod"), *bushings]),
        "slider": together([plate("slider"), *pin("wrist-pin", 0j)]),
    }
