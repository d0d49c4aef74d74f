"""Screws and clamps: preload, tightening torque, what friction holds.

Sources: VDI 2230 (stress area, tightening torque), ISO 898-1 (strength classes); split hubs and face clamps
by Coulomb's friction.
"""

import math

PROOF = {"8.8": 640.0, "10.9": 940.0, "12.9": 1100.0}
"""Strength class to R_p0.2, MPa (ISO 898-1, up to M16)."""

SHARE = 0.7
"""Of R_p0.2 that the preload takes."""

FRICTION = 0.12
"""Of oiled steel, in thread, under the head and between faces."""

_FLANK = 0.577
"""1/(2 cos 30°): friction on flanks of 60° (VDI 2230: 0.58)."""

CLAMP_SAFETY = 2.0
"""Of a clamp, or of what else joins two parts, against the peak torque."""


def stress_area(d: float, pitch: float) -> float:
    """π/4 (d - 0.9382 P)², mm².

    >>> round(stress_area(4, 0.7), 4)
    8.7787
    """
    return math.pi / 4 * (d - 0.9382 * pitch) ** 2


def preload(area: float, proof: float = PROOF["8.8"], share: float = SHARE) -> float:
    """What a screw is tightened to, N."""
    return share * proof * area


def tightening_torque(
    force: float, d: float, pitch: float, head: float, hole: float, friction: float = FRICTION
) -> float:
    """N m: F (P/2π + 0.577 d2 μ + (dk + dh)/4 μ) with the pitch diameter d2 = d - 0.6495 P."""
    flank = d - 0.6495 * pitch
    lever = pitch / math.tau + _FLANK * flank * friction + (head + hole) / 4 * friction
    return force * lever / 1000


def least_preload(force: float, count: int, friction: float = FRICTION, safety: float = 1.5) -> float:
    """Of each of ``count`` screws, N, so that nothing slips under a force across them."""
    return safety * force / (count * friction)


def head_pressure(force: float, head: float, hole: float) -> float:
    """Under a screw's head, MPa."""
    return force / (math.pi / 4 * (head**2 - hole**2))


def split_hub_torque(force: float, count: int, d: float, friction: float = FRICTION) -> float:
    """Of a split hub with ``count`` screws, N m, taken to touch along two lines: the low bound.

    Even pressure all round would hold π/2 times as much.
    """
    return force * count * friction * d / 1000


def face_radius(outer: float, inner: float) -> float:
    """Mean radius of a ring of radii, mm, under even pressure: 2/3 (ro³ - ri³)/(ro² - ri²)."""
    return 2 / 3 * (outer**3 - inner**3) / (outer**2 - inner**2)


def face_torque(force: float, count: int, outer: float, inner: float, friction: float = FRICTION) -> float:
    """Of two faces that ``count`` screws hold together, N m."""
    return count * force * friction * face_radius(outer, inner) / 1000


def lash(play: float, radius: float) -> float:
    """By how much a play, mm, at a radius lets a joint turn, rad."""
    return play / radius
