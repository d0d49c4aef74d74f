"""The plates of a slider-crank, the pins that join them, and the layers they stand in.

Base and rails belong to the body ``base``, whose coordinates are the slide frame: origin in A0, x along the
slide. The crank's pin and shaft are pressed into the crank, the slider's pin into the slider, the rails'
dowels into rails and base. Rod and base carry bushings.
"""

from collections.abc import Callable, Mapping, Set
from dataclasses import dataclass, replace
from typing import Any, cast

import numpy as np

from mechwright import (
    GROUND,
    Array,
    GeometryError,
    Joint,
    MechwrightError,
    Outline,
    Poses,
)
from mechwright.contracts.joint import fixed
from mechwright.mechanics.linkage import Boss, Closeness, Plate, Spindle, Stack, stack
from mechwright.mechanics.planar import BodyMotion, Turning
from mechwright_slider_crank.kinematics.course import course_of, ends_of
from mechwright_slider_crank.kinematics.mechanism import Mechanism
from mechwright_slider_crank.parameters import SliderCrankParams
from mechwright_slider_crank.parts.base import base_outline, hole_places, rim_of
from mechwright_slider_crank.parts.dimensions import Dimensions, clear_overhang
from mechwright_slider_crank.parts.outlines import crank_outline, rails_of, rod_outline, slider_outline
from mechwright_slider_crank.parts.rail_screws import NAMES, RailScrews, rail_screws, with_holes

TURN_SAMPLES = 361
"""Positions of a turn at which the layers are judged: a degree moves a 100 mm crank by 1.7 mm."""

MOVING = ("crank", "rod", "slider")
"""Plates that do not stand still."""


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
    rail_screws
        Those of the rails; None where dowels alone hold them.
    """

    sizes: Dimensions
    outlines: dict[str, Outline]
    rails: tuple[complex, complex]
    dowels: tuple[complex, ...]
    stack: Stack
    screws: tuple[complex, ...]
    heads: bool
    rail_screws: RailScrews | None = None

    @property
    def slider_bottom(self) -> float:
        """Height of the slider's underside, mm."""
        if lies_on_base("slider", self.stack.layer["slider"]):
            return self.stack.layers[0].bottom + self.stack.layers[0].thickness
        return self.stack.bottom("slider")

    def bushing(self, plate: str, other: str) -> tuple[float, float]:
        """Heights of the ends of a plate's bushing, mm: it reaches to another plate in the next layer."""
        layers, low = self.stack.layer, self.stack.bottom(plate)
        high = low + self.stack.layers[layers[plate]].thickness
        bottom = self.slider_bottom if other == "slider" else self.stack.bottom(other)
        top = bottom + self.stack.layers[layers[other]].thickness
        if abs(layers[plate] - layers[other]) != 1:
            return low, high
        return (top, high) if layers[plate] > layers[other] else (low, bottom)

    def has_head(self, pin: str) -> bool:
        """A pin has a head where the rod is on top of it: the plate it is pressed into needs none."""
        other = {"crank-pin": "crank", "wrist-pin": "slider"}[pin]
        return self.heads and self.stack.layer["rod"] > self.stack.layer[other]


def lies_on_base(name: str, layer: Any) -> Any:
    """Whether a plate is the slider in the first layer: it slides on the base, as its rails lie on that."""
    return (name == "slider") & (np.asarray(layer) == 1)


def layout_of(table: Mechanism) -> Layout:
    """All plates and their layers.

    Raises
    ------
    GeometryError
        A plate cannot be drawn, or no order of layers keeps the plates apart; the message says why.
    """
    return cast(Layout, table.layout)


def standing_dimensions(table: Mechanism) -> Dimensions:
    """The sizes as they stand: rails as they are stated, or longer ones where only those find layers."""
    return table.dimensions if table.layout_or_none is None else layout_of(table).sizes


def laid_out(table: Mechanism) -> Layout:
    """Draw all plates and find their layers, with longer rails where only those find some."""
    own = table.dimensions
    try:
        return _laid_out(table, own)
    except MechwrightError as error:
        if table.given.rail_overhang is not None:
            raise
        overhang = clear_overhang(own, table.given.crank, ends_of(table).way, table.given.clearance)
        try:
            return _laid_out(table, replace(own, overhang=overhang))
        except MechwrightError:
            raise error from None


def _laid_out(table: Mechanism, sizes: Dimensions) -> Layout:
    params = table.given
    outlines = {"crank": crank_outline(table), "rod": rod_outline(table)}
    outlines["slider"] = slider_outline(sizes)
    outlines["rail"], rails, dowels = rails_of(table, sizes)
    rim = rim_of(sizes, outlines["rail"], rails)
    poses = _link_poses(table, course_of(table).way(TURN_SAMPLES))
    screws: tuple[complex, ...] = ()
    if params.screw_hole is not None:
        still = seen_from_base(params, poses)
        swept = Closeness(_moving(params, outlines), (), still, params.clearance).swept(MOVING)
        screws = hole_places(params.screw_offset, params.screw_hole, swept, rim)
    holes = (Boss(0j, 0, sizes.base_bore, "shaft"), *(Boss(at, 0, sizes.dowel, "dowel") for at in dowels))
    outlines["base"] = base_outline(params.screw_hole, rim, holes, screws)
    plates = [
        Plate("base", "base", outlines["base"], params.thickness, (0,)),
        *_moving(params, outlines),
        *_rails(params, outlines["rail"], rails),
    ]
    for heads in (True, False):
        try:
            found = stack(
                plates,
                _spindles(params, sizes, dowels, heads=heads),
                poses,
                params.clearance,
                params.gap,
                neighbours=(("rail-1", "slider"), ("rail-2", "slider")),
                together=(("slider", "rail-1", "rail-2"),),
            )
        except GeometryError:
            if heads:
                continue
            raise
        screwed = None if params.screw_hole is None else _screwed(params, sizes, found, outlines)
        if screwed is not None:
            outlines["rail"] = with_holes(outlines["rail"], screwed.rail_holes)
            outlines["base"] = with_holes(outlines["base"], screwed.base_holes(rails))
        return Layout(sizes, outlines, rails, dowels, found, screws, heads, screwed)
    raise AssertionError("the loop returns or raises")


def _screwed(
    params: SliderCrankParams, sizes: Dimensions, found: Stack, outlines: Mapping[str, Outline]
) -> RailScrews | None:
    """The screws of the rails, through the base and what lifts the rails off it."""
    lowest = found.layer["rail-1"] == 1
    grip = params.thickness if lowest else found.bottom("rail-1") - found.bottom("base")
    x0, _, x1, _ = outlines["rail"].bounds
    dowel = (x1 - x0 - sizes.rail) / 2
    return rail_screws(sizes, dowel, grip, params.thickness)


def _moving(params: SliderCrankParams, outlines: Mapping[str, Outline]) -> list[Plate]:
    return [Plate(name, name, outlines[name], params.thickness) for name in MOVING]


def standing(
    table: Mechanism, wanted: Set[str]
) -> tuple[list[Plate], list[Spindle], dict[str, Poses], float]:
    """Some plates above the base, spindles without heads, poses, and the clearance that they keep.

    Plates are ``wanted`` by name, or ``"rail"``. Rails go on as far as the design says, or by their width.
    """
    params, sizes = table.given, table.dimensions
    made: dict[str, Callable[[], Outline]] = {
        "crank": lambda: crank_outline(table),
        "rod": lambda: rod_outline(table),
        "slider": lambda: slider_outline(sizes),
    }
    plates = [Plate(name, name, made[name](), params.thickness) for name in MOVING if name in wanted]
    rail, rails, dowels = rails_of(table, sizes)
    if "rail" in wanted:
        plates += _rails(params, rail, rails)
    poses = _link_poses(table, course_of(table).way(TURN_SAMPLES))
    return plates, _spindles(params, sizes, dowels, heads=False), poses, params.clearance


def _rails(params: SliderCrankParams, outline: Outline, places: tuple[complex, complex]) -> list[Plate]:
    return [
        Plate(f"rail-{number}", "base", outline.moved(place.real, place.imag), params.thickness)
        for number, place in enumerate(places, start=1)
    ]


def _spindles(
    params: SliderCrankParams, sizes: Dimensions, dowels: tuple[complex, ...], *, heads: bool
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


def body_poses(table: Mechanism, phi: Array) -> dict[str, Poses]:
    """Poses of all bodies at crank angles (n,), rad, and of the copies of parts that are fixed in them."""
    params = table.given
    bodies, base = table.closed.bodies(phi), _standing(params, phi)
    _, rails, dowels = rails_of(table, standing_dimensions(table))
    fixed = {f"rail-{number}": (base, place) for number, place in enumerate(rails, start=1)}
    fixed |= {f"dowel-{number}": (base, place) for number, place in enumerate(dowels, start=1)}
    if params.screw_hole is not None:
        screwed = layout_of(table).rail_screws
        places = (0.0, 0.0) if screwed is None else screwed.places
        there = (place + x for place in rails for x in places)
        fixed |= {name: (base, place) for name, place in zip(NAMES, there, strict=True)}
    fixed["crank-pin"] = (bodies.crank, complex(params.crank))
    fixed["rod-end"] = (bodies.rod, complex(params.rod))
    poses = _link_poses(table, phi)
    for name, (body, place) in fixed.items():
        poses[name] = BodyMotion(body.point(place), body.turning).poses()
    return poses


def _link_poses(table: Mechanism, phi: Array) -> dict[str, Poses]:
    """Poses of base, crank, rod and slider alone."""
    bodies = table.closed.bodies(phi)
    return {
        "base": _standing(table.given, phi).poses(),
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
    screws = () if params.screw_hole is None else NAMES
    return {
        **fixed(GROUND, "base"),
        **fixed("base", *rails, *dowels, *screws),
        **fixed("crank", "crank-pin"),
        **fixed("rod", "rod-end"),
        "shaft": Joint("revolute", "base", "crank", drives=True),
        "guide": Joint("prismatic", "base", "slider", (0.0, params.offset, 0.0), (1.0, 0.0, 0.0)),
        "pin-a": Joint("revolute", "crank", "rod", (params.crank, 0.0, 0.0)),
        "pin-b": Joint("revolute", "rod", "slider", (params.rod, 0.0, 0.0)),
    }
