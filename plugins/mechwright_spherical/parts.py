"""The parts of a design: links and pins as solids, base plate and flat strips as plates."""

import math
from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from mechwright.motion import Array
from mechwright.part import Colour, Instance, Part
from mechwright_spherical.bodies import pins_of_phase
from mechwright_spherical.drive import Train, train_of
from mechwright_spherical.flat import strip, strip_outline
from mechwright_spherical.linkage import Linkage, linkage_of
from mechwright_spherical.params import SphericalParams
from mechwright_spherical.shells import Shells, shells_of
from mechwright_spherical.stand import base_outline
from mechwright_spherical.vectors import arc

if TYPE_CHECKING:
    import cadquery as cq

COLOURS: dict[str, Colour] = {
    "ground": (0.55, 0.58, 0.62),
    "base": (0.45, 0.48, 0.52),
    "crank": (0.80, 0.30, 0.25),
    "rocker": (0.25, 0.50, 0.75),
    "arm": (0.90, 0.65, 0.20),
    "coupler": (0.35, 0.65, 0.40),
    "pin": (0.82, 0.82, 0.84),
    "gear": (0.75, 0.68, 0.45),
    "flat": (0.70, 0.70, 0.72),
}

ONE_SIZE = 0.02
"""mm. Pins of both phases that lie nearer to one circle than this share a link: less than the play of a
bore."""


def link_arcs(linkage: Linkage) -> dict[str, float]:
    """Arcs of the links with two joints, rad, those of phase 1 where phases differ."""
    loop = linkage.phases[0].loop
    found = {
        "ground": float(arc(loop.a0, loop.b0)),
        "crank": float(arc(loop.a0, loop.a1)),
        "rocker": math.acos(float(loop.cb)),
    }
    if linkage.five_bar is not None:
        found["arm"] = float(arc(loop.b0, loop.b1))
    return found


def second_size(linkage: Linkage, shells: Shells) -> dict[str, float]:
    """Links that phase 2 needs in another size, and their arcs then, rad."""
    mechanism = linkage.five_bar
    if mechanism is None:
        return {}
    pairs = {"crank": mechanism.crank_arcs, "rocker": mechanism.rocker_arcs}
    return {
        name: float(two)
        for name, (one, two) in pairs.items()
        if abs(float(one) - float(two)) * shells.links[name][1] > ONE_SIZE
    }


def parts_of(params: SphericalParams) -> tuple[Part, ...]:
    """All parts; those of the phase that is shown stand in the assembly."""
    linkage, shells = linkage_of(params), shells_of(params)
    train = train_of(linkage, params.drive)
    return (
        *_links(params, linkage, shells, train),
        *_pins(params, linkage, shells, train),
        *_gears(params, shells, train),
        *_plates(params, linkage, shells),
    )


def _solid(name: str, params: SphericalParams, body: str, build: "partial[cq.Solid]", *, shown: bool = True,
           kind: str = "") -> Part:  # fmt: skip
    pin = kind in {"pin", "gear"}
    return Part(
        name,
        None,
        0.0,
        params.hardware.pin_material if pin else params.hardware.material,
        instances=(Instance(body),) if shown else (),
        colour=COLOURS[kind or body],
        build=build,
    )


def _links(params: SphericalParams, linkage: Linkage, shells: Shells, train: Train | None) -> Iterator[Part]:
    yield _solid("ground", params, "ground", partial(_ground, params, shells, linkage, train))
    other = second_size(linkage, shells)
    second = linkage.shown.number == 2
    for name, angle in link_arcs(linkage).items():
        if name == "ground":
            continue
        shown = not (second and name in other)
        yield _solid(name, params, name, partial(_link, params, shells, name, angle), shown=shown)
        if name in other:
            build = partial(_link, params, shells, name, other[name])
            yield _solid(f"{name}-n", params, name, build, shown=second)
    yield _solid("coupler", params, "coupler", partial(_coupler, params, shells, linkage))


def _pins(params: SphericalParams, linkage: Linkage, shells: Shells, train: Train | None) -> Iterator[Part]:
    arcs = link_arcs(linkage)
    if linkage.shown.number == 2:
        arcs |= second_size(linkage, shells)
    places = {
        "a": ("crank", arcs["crank"]),
        "c": ("rocker", arcs["rocker"]),
        "a0": ("crank", 0.0),
        "b0": ("arm" if "arm" in arcs else "rocker", 0.0),
    }
    if "arm" in arcs:
        places["b"] = ("arm", arcs["arm"])
    if train is not None and train.idler_axis is not None:
        places["idler"] = ("idler", 0.0)
    for name, (body, angle) in places.items():
        title = f"pin-{name}" if name in {"a", "b", "c"} else f"shaft-{name}"
        at = np.array([math.cos(angle), math.sin(angle), 0.0])
        build = partial(_pin, shells.pins[name], at, params.hardware.pin_diameter)
        yield _solid(title, params, body, build, kind="pin")
    yield _solid("tool", params, "coupler", partial(_tool, params, shells, linkage), kind="pin")


def _gears(params: SphericalParams, shells: Shells, train: Train | None) -> Iterator[Part]:
    if train is None:
        return
    cones = {"pinion": ("pinion", train.pinion), "wheel": ("arm", train.wheel)}
    if train.idler_axis is not None:
        cones["idler"] = ("idler", train.idler)
    span = gear_span(params, shells, train)
    for name, (body, angle) in cones.items():
        yield _solid(name, params, body, partial(_gear, params, span, angle), kind="gear")


def gear_span(params: SphericalParams, shells: Shells, train: Train) -> tuple[float, float]:
    """From where to where pitch cones go, mm along them: the widest one's flat end clears the ground."""
    widest = max(train.pinion, train.wheel, train.idler)
    inner = (shells.outside + params.hardware.gap) / math.cos(widest)
    return inner, inner + params.drive.face_width


def _plates(params: SphericalParams, linkage: Linkage, shells: Shells) -> Iterator[Part]:
    hardware, stand, flat = params.hardware, params.stand, params.flat
    yield Part(
        "base",
        base_outline(stand),
        stand.plate_thickness,
        hardware.material,
        instances=(Instance("base"),),
        colour=COLOURS["base"],
    )
    if not flat.make:
        return
    arcs = link_arcs(linkage) | {f"{n}-n": a for n, a in second_size(linkage, shells).items()}
    arcs |= {
        f"coupler{'-n' if phase.number == 2 else ''}": math.acos(float(phase.loop.ca))
        for phase in linkage.phases
    }
    for name, angle in arcs.items():
        radius = shells.arc(name.removesuffix("-n"))[0]
        outline = strip_outline(
            strip(angle, radius, flat), hardware.boss_diameter, hardware.pin_diameter + hardware.fit
        )
        yield Part(f"flat-{name}", outline, flat.thickness, hardware.material, colour=COLOURS["flat"])


# The kernel is imported when a solid is wanted.


def _link(params: SphericalParams, shells: Shells, name: str, angle: float) -> "cq.Solid":
    from mechwright_spherical import links

    return links.link(params, shells, name, angle)


def _coupler(params: SphericalParams, shells: Shells, linkage: Linkage) -> "cq.Solid":
    from mechwright_spherical import links

    return links.coupler(params, shells, linkage)


def _ground(params: SphericalParams, shells: Shells, linkage: Linkage, train: Train | None) -> "cq.Solid":
    from mechwright_spherical import links

    return links.ground(params, shells, linkage, train)


def _pin(span: tuple[float, float], at: Array, diameter: float) -> "cq.Solid":
    from mechwright_spherical import links

    return links.pin(span, at, diameter)


def _tool(params: SphericalParams, shells: Shells, linkage: Linkage) -> "cq.Solid":
    from mechwright_spherical import links

    frame = pins_of_phase(linkage, 1)
    return links.tool(params, shells, links.path_point(linkage, frame))


def _gear(params: SphericalParams, span: tuple[float, float], angle: float) -> "cq.Solid":
    from mechwright_spherical import links

    return links.gear(params, span, angle)
