r"""What a four-bar of plates as made does: error of the follower and of the coupler point.

With u, p the directions of coupler and follower (angles σ, ψ), a displacement v of any pin to its bore, or a
link that is too long by t along its own direction, adds to the loop a vector ε. To first order

    dψ = (u·ε) / N,  dσ = (p·ε) / M,  N = b sin(σ - ψ),  M = c sin(σ - ψ),

and the coupler point P = A + q e^{iσ} moves by dA + i q e^{iσ} dσ.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from mechwright import Array, AsMade, MadeCurve, MadeFigure, MadePart
from mechwright.mechanics.linkage.made import Hole, Joint, MadeLink, joint, link, offset, stuck
from mechwright.mechanics.planar import Plane
from mechwright_four_bar.dimensions import FourBar
from mechwright_four_bar.loop import close
from mechwright_four_bar.params import FourBarParams
from mechwright_four_bar.plates import bosses_of, posts_of
from mechwright_four_bar.reach import bar_of, course_of

SAMPLES = 361
DIRECTIONS = 32
"""Directions in which a pin may stand that are looked at, for the coupler point: to a half per cent."""
MICRO = 1e6


def output_rates(bar: FourBar, phi: Array) -> dict[str, Array]:
    """Rates (n,) of the follower's angle, rad/mm: with each link, and in ``pin`` with any pin that is off."""
    loop = close(bar, phi)
    u, p = loop.coupler.direction, loop.follower.direction
    n = bar.follower * (u * np.conj(p)).imag
    ground = np.exp(1j * np.asarray(bar.ground_angle))
    along = {"crank": np.exp(1j * phi), "coupler": u, "follower": -p, "ground": -ground}
    rates: dict[str, Array] = {name: (e * np.conj(u)).real / n for name, e in along.items()}
    return rates | {"pin": 1 / np.abs(n)}


def point_rates(bar: FourBar, point: complex, phi: Array) -> dict[str, Array]:
    """How far (n,) the coupler point moves, mm/mm: with each link, and with a pin at A0 or A, at B or B0."""
    loop = close(bar, phi)
    u, p = loop.coupler.direction, loop.follower.direction
    m = bar.coupler * (u * np.conj(p)).imag
    swing = 1j * point * u

    def moved(e: Plane, carried: float) -> Array:
        size: Array = np.abs(carried * e + swing * (e * np.conj(p)).real / m)
        return size

    ground = np.exp(1j * np.asarray(bar.ground_angle)) * np.ones_like(u)
    around = np.exp(2j * np.pi * np.arange(DIRECTIONS) / DIRECTIONS)[:, None] * np.ones_like(u)
    links = {"coupler": moved(u, 0.0), "follower": moved(-p, 0.0), "ground": moved(-ground, 0.0)}
    return links | {
        "crank": moved(np.exp(1j * phi), 1.0),
        "pin-a": np.max([moved(e, 1.0) for e in around], axis=0),
        "pin-b": np.abs(swing / m),
    }


def as_made(params: FourBarParams, made: Mapping[str, Sequence[MadePart]]) -> AsMade:
    """Judge the linkage with plates as made."""
    bosses = bosses_of(params)
    if not set(bosses) <= set(made):
        return AsMade()
    holes = {
        name: [Hole(boss.centre, boss.bore) for boss in own if boss.tag != "coupler-point"]
        for name, own in bosses.items()
    }
    links = {name: link(made[name][0], *own) for name, own in holes.items() if len(own) == 2}
    bushed = params.running_fit if params.bushing_wall > 0 else None
    turning = {"A0": ("ground", 0), "A": ("coupler", 0), "B": ("coupler", 1), "B0": ("follower", 0)}
    if "ground-2" in holes:
        turning["B0"] = ("ground-2", 0)
        links["ground"] = _between(params, made, holes["ground"][0], holes["ground-2"][0])
    joints = {
        name: joint(name, made[plate][0], holes[plate][end], params.pin_diameter, bushed)
        for name, (plate, end) in turning.items()
    }
    sure = {name: one for name, one in links.items() if one is not None}
    pins = {name: one for name, one in joints.items() if one is not None}
    if len(sure) < len(links) or len(pins) < len(joints):
        return AsMade()
    phi = np.sort(course_of(params).way(SAMPLES))
    bar = bar_of(params)
    rates = output_rates(bar, phi)
    figures, curves = [], []
    found = _worst(sure, pins, rates, dict.fromkeys(pins, rates["pin"]))
    drawn = len(pins) * rates["pin"] * params.running_fit / 2
    figures.append(_figure("follower.error", "greatest error of the follower", "µrad", drawn, found, MICRO))
    curves.append(_curve("Error of the follower", "µrad", phi, found, MICRO))
    if params.coupler_point is not None:
        moves = point_rates(bar, params.coupler_point, phi)
        near = {name: moves["pin-a" if name.startswith("A") else "pin-b"] for name in pins}
        found = _worst(sure, pins, moves, near)
        drawn = np.sum(list(near.values()), axis=0) * params.running_fit / 2
        figures.append(_figure("point.error", "greatest error of the coupler point", "mm", drawn, found, 1.0))
        curves.append(_curve("Error of the coupler point", "mm", phi, found, 1.0))
    least = min(pins.values(), key=lambda one: one.room - one.spread)
    figures.append(
        MadeFigure(
            "pin.room",
            f"least play of a pin, in joint {least.name}",
            "mm",
            0.0,
            params.running_fit,
            2 * least.room,
            2 * (least.room - least.spread),
            2 * (least.room + least.spread),
            "in diameter" + ("; that of the bushings" if bushed else ""),
        )
    )
    jammed = stuck("four-bar.as-made", list(pins.values()), "running_fit", params.running_fit)
    return AsMade(tuple(figures), tuple(curves), tuple(jammed))


def _between(
    params: FourBarParams, made: Mapping[str, Sequence[MadePart]], one: Hole, two: Hole
) -> MadeLink | None:
    """The distance of A0 and B0 in two plates that four bolts bring in line."""
    screws = [Hole(at, params.pin_diameter) for at in posts_of(params).values()]
    ends = offset(made["ground"][0], one, screws, 1 + 0j), offset(made["ground-2"][0], two, screws, 1 + 0j)
    if ends[0] is None or ends[1] is None:
        return None
    return MadeLink(ends[1].off - ends[0].off, ends[0].spread + ends[1].spread)


def _worst(
    links: Mapping[str, MadeLink],
    pins: Mapping[str, Joint],
    rates: Mapping[str, Array],
    pin_rates: Mapping[str, Array],
) -> tuple[Array, Array, Array]:
    """Error (n,): of the made links alone, with pins as far off as they can be, and over the corridor."""
    still = np.abs(np.sum([rates[name] * one.off for name, one in links.items()], axis=0))
    made = still + np.sum([pin_rates[name] * max(one.room, 0.0) for name, one in pins.items()], axis=0)
    more = np.sum([np.abs(rates[name]) * one.spread for name, one in links.items()], axis=0)
    more = more + np.sum([pin_rates[name] * one.spread for name, one in pins.items()], axis=0)
    return still, made, made + more


def _figure(
    name: str, title: str, unit: str, drawn: Array, found: tuple[Array, Array, Array], scale: float
) -> MadeFigure:
    still, made, most = (float(one.max()) * scale for one in found)
    rule = "(Σ ρ) / |N| + |Σ (∂/∂l) Δl|, every pin standing off in the worst direction; least: pins centred"
    return MadeFigure(name, title, unit, None, float(drawn.max()) * scale, made, still, most, rule)


def _curve(title: str, unit: str, phi: Array, found: tuple[Array, Array, Array], scale: float) -> MadeCurve:
    lines = {"as made": found[1] * scale, "over the path": found[2] * scale}
    return MadeCurve(title, "crank, degrees", unit, np.degrees(phi), lines)
