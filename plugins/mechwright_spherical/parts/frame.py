"""The ground link of a four-bar: outside the other links, or on both sides of them.

Outside, crank and rocker share a shell, and both shafts come from there. Where their arcs pass each other, as
those of a double crank do, the input's axis goes into an arc inside all links, the output's into one outside,
and each link has a shell of its own. A radial bridge joins both arcs on the great circle of the fixed axes,
beyond all that moves.
"""

import math
from dataclasses import dataclass

import numpy as np

from mechwright import Array, kept
from mechwright_spherical.kinematics.clearances import SAMPLES, Approach, Link, approaches, pin_apart
from mechwright_spherical.kinematics.linkage import Linkage, Phase, linkage_of
from mechwright_spherical.kinematics.vectors import arc, dot, norm, rotate
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.parts.seats import stud_room
from mechwright_spherical.parts.shells import Shells, one_side, two_sides

AIR = 0.5
"""Least air between two links that pass each other, mm: what deflection and play of a hand-made linkage
need."""

_FARTHEST = 175
"""Degrees of the inner arc: a longer one has no plane of its own."""


@dataclass(frozen=True)
class Frame:
    """What carries both fixed axes.

    Parameters
    ----------
    shells
        Of all links.
    bridge
        Arc, rad, from the input axis, away from the output's, to what joins both sides; None with one side.
    """

    shells: Shells
    bridge: float | None = None


@kept
def frame_of(params: SphericalParams) -> Frame:
    """On one side of the links where they have room for that, else on both."""
    linkage, outside = linkage_of(params), one_side(params, stud_room(params))
    if linkage.four_bar is None or params.hardware.frame == "one":
        return Frame(outside)
    if params.hardware.frame == "auto":
        near = min(found.room for found in outside_approaches(params))
        if not near < AIR:
            return Frame(outside)
    around = two_sides(params)
    place = _bridge(params, linkage, around)
    return Frame(outside) if place is None else Frame(around, place)


@kept
def outside_approaches(params: SphericalParams) -> tuple[Approach, ...]:
    """The nearest approaches of links whose ground is outside of them."""
    return tuple(approaches(params, linkage_of(params), one_side(params, stud_room(params))))


def shells_of(params: SphericalParams) -> Shells:
    """The shells of a design."""
    return frame_of(params).shells


def ground_arcs(params: SphericalParams) -> dict[str, float]:
    """Arcs of the ground between its bores, rad: one, or from the bridge to each fixed axis."""
    loop, bridge = linkage_of(params).shown.loop, frame_of(params).bridge
    whole = float(arc(loop.a0, loop.b0))
    return {"ground": whole} if bridge is None else {"ground": whole + bridge, "ground-2": bridge}


def motor_opposite(params: SphericalParams) -> bool:
    """Whether the input's shaft goes through the centre to a motor's flange at the far end of its axis.

    Of a ground on both sides the input's axis ends inside all links, and nothing else is about the centre.
    """
    return params.stand.motor_flange is not None and frame_of(params).bridge is not None


def ground_beyond(params: SphericalParams) -> float:
    """Arc, rad, that the outer ground link goes on beyond the input's axis: to post, bridge and motor."""
    ends = [math.radians(params.stand.arc), frame_of(params).bridge or 0.0]
    return max([*ends, math.pi] if motor_opposite(params) else ends)


def bridge_rooms(
    params: SphericalParams, linkage: Linkage, shells: Shells, place: float, diameter: float | None = None
) -> dict[str, Array]:
    """Air (samples,), mm, between a bridge at that arc and each link that passes it, in the worst phase.

    A bridge is as thick as a boss; a shaft in its place has a ``diameter`` of its own.
    """
    found: dict[str, Array] = {}
    thick = params.hardware.boss_diameter if diameter is None else diameter
    for phase in linkage.phases:
        for name, room in _phase_rooms(params, phase, shells, place, thick).items():
            found[name] = np.minimum(found[name], room) if name in found else room
    return found


def _phase_rooms(
    params: SphericalParams, phase: Phase, shells: Shells, place: float, diameter: float
) -> dict[str, Array]:
    """The same in one phase."""
    hardware, loop, state = params.hardware, phase.loop, phase.state(SAMPLES)
    a, c, p = state.a[0], state.c[0], state.p[0]
    a0, b0 = (np.broadcast_to(axis[:, None], a.shape) for axis in (loop.a0, loop.b0))
    normal = np.cross(loop.a0, loop.b0) / norm(np.cross(loop.a0, loop.b0))
    at = np.broadcast_to(rotate(normal, -place, loop.a0)[:, None], a.shape)
    near = a if float(dot(a[:, 0], p[:, 0])) > float(dot(c[:, 0], p[:, 0])) else c
    links: dict[str, list[Link]] = {"crank": [(a0, a)], "rocker": [(b0, c)], "coupler": [(a, c), (near, p)]}
    halves = (diameter / 2, hardware.link_width / 2, hardware.boss_diameter / 2)
    found = {}
    for name, arcs in links.items():
        radius = shells.links[name][0]
        step = max(float(norm(np.diff(end, axis=1)).max()) for one in arcs for end in one)
        rooms = [pin_apart(at, one, *halves, radius) for one in arcs]
        # Between two samples no point of a link moves farther than half a step of its faster end.
        found[name] = np.asarray(np.min(rooms, axis=0) - radius * step / 2)
    return found


def _bridge(params: SphericalParams, linkage: Linkage, shells: Shells) -> float | None:
    """The nearest whole degree for the bridge where all passes it, and its boss that of the axis."""
    boss, radius = params.hardware.boss_diameter + AIR, shells.links["ground-2"][0]
    beside = math.degrees(2 * math.atan(boss / 2 / radius)) if radius > 0 else 0.0
    degrees = math.ceil(beside) + 1
    while degrees <= _FARTHEST:
        place = math.radians(degrees)
        rooms = bridge_rooms(params, linkage, shells, place)
        lack = {name: AIR - float(room.min()) for name, room in rooms.items()}
        if max(lack.values()) <= 0:
            return place
        # Room grows at most as fast as the bridge moves past a link: no place that is nearer has enough.
        reach = {name: shells.links[name][0] for name, air in lack.items() if air > 0}
        on = max((math.degrees(lack[name] / radius) for name, radius in reach.items() if radius), default=0)
        degrees += max(1, math.ceil(on - 1e-9))
    return None
