"""What a spherical linkage of bent strips does whose bores are as made: error of the output link.

With the unit vectors a and b of the pins that coupler and output link turn on, c of the pin that joins them,
a·c = cos α3, the output link turns about b by

    dψ = -(δa·c + a·δc + sin α3 dα3) / N,  N = a·(b x c),

δa and δc being what arcs that are too long make of a, and of c at constant ψ. A pin that stands off its bore
by ρ on a radius R is an arc that is off by ρ/R: whichever pin it is, it adds at most ρ/R sin α3/|N|.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from mechwright import Array, AsMade, MadeCurve, MadeFigure, MadePart
from mechwright.mechanics.linkage.made import Hole, Joint, MadeLink, joint, link, stuck
from mechwright_spherical.flat import strip
from mechwright_spherical.frame import ground_arcs, shells_of
from mechwright_spherical.linkage import Linkage, Phase, linkage_of
from mechwright_spherical.params import FlatTable, SphericalParams
from mechwright_spherical.places import link_arcs, second_size
from mechwright_spherical.shells import Shells
from mechwright_spherical.vectors import cross, dot, norm

SAMPLES = 361
MICRO = 1e6

BORES = {
    "a0": ("ground", 0),
    "a": ("coupler", 0),
    "b": ("rocker", 0),
    "b0": ("ground", 1),
    "c": ("coupler", 1),
}
"""Joint to the strip in whose bore its pin turns, and which end of it."""


def output_rates(phase: Phase, ground: float, samples: int = SAMPLES) -> dict[str, Array]:
    """Change (n,) of the output link's angle, rad/rad, with each arc, and with any pin that is off.

    ``ground`` is the arc between the fixed axes, rad.
    """
    state = phase.state(samples)
    a, b, c = state.a[0], state.b[0], state.c[0]
    a0, b0 = (np.broadcast_to(np.asarray(v)[:, None], a.shape) for v in (phase.loop.a0, phase.loop.b0))
    sin3 = norm(cross(a, c))
    n = dot(a, cross(b, c))

    def away(moved: Array, fixed: Array) -> Array:
        """Unit vectors along the arc from a fixed pin, at the moved one."""
        arc = norm(cross(fixed, moved))
        direction: Array = (dot(fixed, moved) * moved - fixed) / arc
        return direction

    normal = cross(a0, b0) / np.sin(ground)
    rates: dict[str, Array] = {
        "crank": -dot(away(a, a0), c) / n,
        "coupler": -sin3 / n,
        "rocker": -dot(a, away(c, b)) / n,
        "ground": -dot(a, cross(normal, c)) / n,
        "pin": sin3 / np.abs(n),
    }
    if norm(b - b0).max() > 0:  # an arm carries b
        rates["arm"] = -dot(a, cross(cross(b0, b) / norm(cross(b0, b)), c)) / n
    return rates


def as_made(params: SphericalParams, made: Mapping[str, Sequence[MadePart]]) -> AsMade:
    """Judge the linkage of flat strips, each bent as drawn."""
    linkage, shells, flat = linkage_of(params), shells_of(params), params.flat
    phase, hardware = linkage.shown, params.hardware
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
    rates = output_rates(phase, link_arcs(linkage)["ground"])
    still = np.abs(np.sum([rates[name] * one.off for name, one in links.items()], axis=0))
    off = still + rates["pin"] * sum(max(one.room, 0.0) / radii[name] for name, one in pins.items())
    more = np.sum([np.abs(rates[name]) * one.spread for name, one in links.items()], axis=0)
    more = more + rates["pin"] * sum(one.spread / radii[name] for name, one in pins.items())
    drawn = rates["pin"] * sum(hardware.fit / 2 / radii[name] for name in pins)
    least = min(pins.values(), key=lambda one: one.room - one.spread)
    turned = np.degrees(phase.sweep(SAMPLES))
    figures = (
        MadeFigure(
            "output.error",
            "greatest error of the output link",
            "µrad",
            None,
            float(np.nanmax(drawn)) * MICRO,
            float(np.nanmax(off)) * MICRO,
            float(np.nanmax(still)) * MICRO,
            float(np.nanmax(off + more)) * MICRO,
            "(Σ ρ/R) sin α3/|N| + |Σ (∂ψ/∂α) Δα|, every pin off in the worst direction; least: pins centred",
        ),
        MadeFigure(
            "pin.room",
            f"least play of a pin, in joint {least.name}",
            "mm",
            0.0,
            hardware.fit,
            2 * least.room,
            2 * (least.room - least.spread),
            2 * (least.room + least.spread),
            "in diameter",
        ),
    )
    curve = MadeCurve(
        "Error of the output link",
        "input, degrees",
        "µrad",
        turned,
        {"as drawn": drawn * MICRO, "as made": off * MICRO, "over the path": (off + more) * MICRO},
    )
    jammed = stuck("spherical.as-made", list(pins.values()), "hardware.fit", hardware.fit)
    return AsMade(figures, (curve,), tuple(jammed))


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
    second = {*other, *(("coupler",) if phase.number == 2 else ())}
    return arcs, {name: f"flat-{name}{'-n' if name in second else ''}" for name in arcs}


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
