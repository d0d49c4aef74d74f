"""Whether bosses, pins and links have room on their shells."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from mechwright import DesignRule, Finding, Procedure, Severity, Stage
from mechwright.contracts.design_rule import Failure
from mechwright.contracts.design_table import items
from mechwright.contracts.finding import at_stage
from mechwright.tolerances import falls_short
from mechwright_spherical.defaults.preferred_sizes import WALL, least_boss
from mechwright_spherical.kinematics.clearances import Approach
from mechwright_spherical.parameters import MOST_RADIUS
from mechwright_spherical.parts.frame import AIR, bridge_rooms, ground_arcs
from mechwright_spherical.table import SphericalTable

Rule = DesignRule[SphericalTable]
Fails = Failure[SphericalTable]


def clear_radius(diameter: Any, angle: Any) -> Any:
    """Radius, mm, outside which two radial cylinders of one diameter, ``angle`` rad apart, do not touch.

    >>> round(float(clear_radius(12, math.radians(9.704142066385073))), 6)
    70.681672
    >>> float(clear_radius(12, 0.0))
    inf
    """
    with np.errstate(divide="ignore"):
        return np.divide(diameter / 2, np.tan(angle / 2))


BOSS = Rule(
    "spherical.boss",
    "hardware.boss_diameter",
    f"bosses of {{value:g}} mm leave less than {WALL:g} mm around the bores",
    value=lambda t: t.params.hardware.boss_diameter,
    limit=lambda t: least_boss(t.params.hardware.pin_diameter, t.params.hardware.fit),
    unit="mm",
    remedy="make them {limit:g} mm at least, or the pins thinner",
)


def _rise(t: SphericalTable) -> Any:
    """How far the rim of a boss is over its shell, mm; it matters less on outer shells."""
    radius = t.shells.inside[1]
    return np.hypot(radius, t.params.hardware.boss_diameter / 2) - radius


GAP = Rule(
    "spherical.gap",
    "hardware.gap",
    "the rims of flat bosses of {m.params.hardware.boss_diameter:g} mm stand {limit:.3f} mm over their shell "
    "and rub in a gap of {value:g} mm",
    value=lambda t: t.params.hardware.gap,
    limit=_rise,
    unit="mm",
    remedy="use more than {limit:.3f} mm, smaller bosses, or a larger radius",
    must_be="above",
)


def _pairs(m: SphericalTable) -> list[tuple[str, Any, Any, str]]:
    """What two radial cylinders are, the arc between them, their diameter, and the link on whose shell."""
    hardware = m.params.hardware
    bored, bossed = hardware.pin_diameter + hardware.fit + WALL, hardware.boss_diameter + AIR
    pairs: list[tuple[str, Any, Any, str]] = []
    couplers = m.coupler_arcs
    for number, angle in enumerate(couplers, start=1):
        said = f"pins a and c of phase {number}" if len(couplers) > 1 else "pins a and c"
        pairs.append((said, angle, bossed, "crank"))
    names = {"ground": "both fixed axes"}
    names |= {link: f"the pins of the {link}" for link in ("crank", "rocker", "arm")}
    arcs = dict(m.arcs)
    if m.bridge is not None:
        del arcs["ground"]  # the fixed axes have shells of their own
        pairs += [
            ("a fixed axis and the bridge", angle, bossed, link)
            for link, angle in ground_arcs(m.params).items()
        ]
    pairs += [(names[link], angle, bored, link) for link, angle in arcs.items()]
    return pairs + [(f"tool and pin {name}", angle, bored, "coupler") for name, angle in m.tool_arcs]


def _shafts(f: Fails) -> tuple[str, str, tuple[float, float], str, str]:
    """Key, message, value and limit, unit and remedy of two cylinders that do not fit side by side."""
    said, angle, diameter, _ = _pairs(f.m)[f.item]
    params, tool, degrees = f.m.params, said.startswith("tool"), math.degrees(angle)
    said = f"{said} are {degrees:.4g}° apart, and {diameter:g} mm do not fit side by side"
    if f.value - f.limit > MOST_RADIUS - params.radius:
        point = "four_bar.point_azimuth" if params.kind == "four-bar" else "five_bar.point"
        remedy = "move the path point away from the pin" if tool else "use longer arcs, or smaller pins"
        least = math.degrees(2 * math.atan(diameter / 2 / f.limit))
        said += f" on any sphere up to {MOST_RADIUS:g} mm"
        return point if tool else "radius", said, (degrees, least), "deg", remedy
    # The shells move outwards with the sphere.
    radius = math.ceil(10 * (params.radius + f.value - f.limit)) / 10
    remedy = f"use a radius of {radius:g} mm or more, smaller pins and bosses, or a shorter projection"
    return "radius", f"{said} at {f.limit:.4g} mm from the centre", (params.radius, radius), "mm", remedy


SHAFTS = Rule(
    "spherical.shafts",
    lambda f: _shafts(f)[0],
    lambda f: _shafts(f)[1],
    value=lambda t: items([clear_radius(diameter, angle) for _, angle, diameter, _ in _pairs(t)], t.size),
    limit=lambda t: items([t.shells.links[link][0] for *_, link in _pairs(t)], t.size),
    unit=lambda f: _shafts(f)[3],
    remedy=lambda f: _shafts(f)[4],
    must_be="at most",
    reported=lambda f: _shafts(f)[2],
)


def _when(m: SphericalTable, near: Approach) -> str:
    phase = f" of phase {near.phase}" if len(m.linkage.phases) > 1 else ""
    return f", at the input angle {math.degrees(near.angle):.4g}°{phase}"


def _collision(f: Fails) -> str:
    near = f.m.approaches[f.item]
    room = f"run into each other by {-f.value:.3g} mm" if f.value < 0 else f"come as near as {f.value:.3g} mm"
    return f"{' and '.join(near.bodies)} {room}{_when(f.m, near)}"


def _room_remedy(f: Fails) -> str:
    params = f.m.params
    other = params.kind == "four-bar" and params.hardware.frame == "one"
    return (
        'set hardware.frame = "auto", or ' if other else ""
    ) + "use narrower links and bosses, a larger radius, a shorter travel, or other arcs"


CLEARANCE = Rule(
    "spherical.clearance",
    "hardware.boss_diameter",
    _collision,
    value=lambda t: t.rooms,
    limit=AIR,
    unit="mm",
    remedy=_room_remedy,
    when=lambda t: t.bridge is None,
)


def _nearest(m: SphericalTable) -> Iterator[Finding]:
    """Where links come nearest that do not collide."""
    if m.bridge is not None:
        rooms = bridge_rooms(m.params, m.linkage, m.shells, m.bridge)
        name = min(rooms, key=lambda link: float(rooms[link].min()))
        at = float(m.linkage.shown.sweep(rooms[name].size)[int(np.argmin(rooms[name]))])
        yield Finding.note(
            "spherical.clearance",
            f"the ground is on both sides, its bridge {math.degrees(m.bridge):.4g}° from the input axis; the "
            f"{name} comes nearest to it, {rooms[name].min():.3g} mm, at the input angle "
            f"{math.degrees(at):.4g}°",
            float(rooms[name].min()),
            "mm",
        )
        return
    tightest = min(m.approaches, key=lambda near: near.room)
    if not falls_short(tightest.room, AIR):
        one, two = tightest.bodies
        yield Finding(
            "spherical.clearance",
            Severity.NOTE,
            "hardware",
            f"{one} and {two} come nearest, {tightest.room:.3g} mm{_when(m, tightest)}",
            tightest.room,
            AIR,
            "mm",
        )


def _centre_radius(f: Fails) -> float:
    return math.ceil(10 * (f.m.params.radius + f.limit - f.value)) / 10


CENTRE = Rule(
    "spherical.centre",
    "radius",
    "the ground's inner arc leaves {value:.4g} mm about the centre, where bosses and shaft meet",
    value=lambda t: t.shells.pins["a0"][0],
    limit=lambda t: t.params.hardware.boss_diameter,
    unit="mm",
    remedy=lambda f: f"use a radius of {_centre_radius(f):g} mm or more, or thinner links",
    reported=lambda f: (f.m.params.radius, _centre_radius(f)),
    when=lambda t: t.bridge is not None,
)

NEAREST = Procedure[SphericalTable](
    ("spherical.clearance",), lambda m: at_stage(Stage.PARTS, _nearest(m)), warns=True
)

LINKS = (BOSS, GAP, SHAFTS, CLEARANCE, CENTRE, NEAREST)
"""Of pins and bosses, then of links beside each other."""
