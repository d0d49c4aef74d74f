"""What a spherical linkage of bent strips does whose bores are as made: error of output and path point."""

from collections.abc import Mapping, Sequence

import numpy as np

from mechwright import AsMade, MadePart
from mechwright.mechanics.linkage.made import Hole, Joint, MadeLink, joint, link, stuck
from mechwright.mechanics.linkage.made_error import EXACT, made_errors, room_figure
from mechwright_spherical.as_made.tolerances import ANGLE, POINT, SphericalTolerances
from mechwright_spherical.kinematics.linkage import Linkage, linkage_of
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.parts.flat import strip
from mechwright_spherical.parts.frame import ground_arcs, shells_of
from mechwright_spherical.parts.hardware import FlatTable
from mechwright_spherical.parts.places import link_arcs, second_size
from mechwright_spherical.parts.shells import Shells

NAMES = {ANGLE.name: "output.error", POINT.name: "point.error"}
RULE = "(Σ ρ/R) sin α3/|N| + |Σ (∂ψ/∂α) Δα|, every pin off in the worst direction; least: pins centred"

BORES = {
    "a0": ("ground", 0),
    "a": ("coupler", 0),
    "b": ("rocker", 0),
    "b0": ("ground", 1),
    "c": ("coupler", 1),
}
"""Joint to the strip in whose bore its pin turns, and which end of it."""


def as_made(params: SphericalParams, made: Mapping[str, Sequence[MadePart]]) -> AsMade:
    """Judge the linkage of flat strips, each bent as drawn."""
    linkage, shells, flat = linkage_of(params), shells_of(params), params.flat
    hardware = params.hardware
    arcs, strips = _shown(params, linkage, shells)
    if not set(strips.values()) <= set(made):
        return AsMade()
    strip_of = {name: made[part][0] for name, part in strips.items()}
    bore = hardware.pin_diameter + hardware.fit
    links: dict[str, MadeLink] = {}
    for name, angle in arcs.items():
        radius = shells.arc(name)[0]
        ends = Hole(0j, bore), Hole(complex(strip(angle, radius, flat).length), bore)
        found = link(strip_of[name], *ends)
        if found is None:
            return AsMade()
        stretch = _stretch(angle, radius, flat)
        links[name] = MadeLink(found.off / stretch, found.spread / stretch)
    pins = _pins(params, strip_of, arcs)
    radii = {name: shells.arc(_bores(arcs)[name][0])[0] for name in pins}
    if "ground-2" in links:
        # Both strips begin at the bridge.
        one, two = links["ground"], links.pop("ground-2")
        links["ground"] = MadeLink(one.off - two.off, one.spread + two.spread)
    model = SphericalTolerances(params, EXACT)
    contributor = {"a0": "crank-shaft", "a": "crank-pin", "b": "arm-pin", "c": "coupler-pin"}
    contributor["b0"] = model.joints[-1]
    joints: dict[str, Joint] = {}
    drawn: dict[str, float] = {}
    for name, pin in pins.items():
        scale = model.radius / radii[name]  # the model has all pins on the nominal radius
        joints[contributor[name]] = Joint(pin.name, scale * pin.room, scale * pin.spread)
        drawn[contributor[name]] = scale * hardware.fit / 2
    errors = made_errors(model, {model.names[name]: one for name, one in links.items()}, joints, drawn)
    figures = (
        *(one.figure(NAMES[one.output.name], RULE) for one in errors),
        room_figure([*pins.values()], hardware.fit),
    )
    jammed = stuck("spherical.as-made", list(pins.values()), "hardware.fit", hardware.fit)
    return AsMade(figures, tuple(one.curve("input") for one in errors), tuple(jammed))


def _bores(arcs: Mapping[str, float]) -> dict[str, tuple[str, int]]:
    """As BORES; with a ground on both sides the strips of both begin at the bridge."""
    return BORES | {"a0": ("ground-2", 1)} if "ground-2" in arcs else BORES


def _shown(
    params: SphericalParams, linkage: Linkage, shells: Shells
) -> tuple[dict[str, float], dict[str, str]]:
    """Arc, rad, and flat part of every link in the phase that is shown."""
    phase = linkage.shown
    other = second_size(linkage, shells) if phase.number == 2 else {}
    arcs = link_arcs(linkage) | ground_arcs(params) | other
    arcs |= {"coupler": float(np.arccos(float(phase.loop.ca)))}
    marks = dict.fromkeys(other, phase.mark) | {"coupler": phase.mark}
    return arcs, {name: f"flat-{name}{f'-{mark}' if (mark := marks.get(name)) else ''}" for name in arcs}


def _stretch(angle: float, radius: float, flat: FlatTable) -> float:
    """Change of a strip's length with its arc, mm/rad: facets grow with the tangent, bends with the angle."""
    half = angle / strip(angle, radius, flat).bends / 2
    return float(
        (radius - flat.bend_radius) / np.cos(half) ** 2 + flat.bend_radius + flat.neutral * flat.thickness
    )


def _pins(
    params: SphericalParams, strip_of: Mapping[str, MadePart], arcs: Mapping[str, float]
) -> dict[str, Joint]:
    """The joints whose bores are there; of a five-bar the one that the arm carries as well."""
    hardware, shells = params.hardware, shells_of(params)
    bore = hardware.pin_diameter + hardware.fit
    pins: dict[str, Joint] = {}
    for name, (plate, end) in _bores(arcs).items():
        if name == "b" and "arm" not in arcs:
            continue  # the output axis itself
        length = strip(arcs[plate], shells.arc(plate)[0], params.flat).length
        hole = Hole(complex(end * length), bore)
        found = joint(name, strip_of[plate], hole, hardware.pin_diameter)
        if found is not None:
            pins[name] = found
    return pins
