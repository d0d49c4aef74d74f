"""Screws and clamps: preload, tightening torque, what friction holds.

Sources: VDI 2230 (stress area, tightening torque), ISO 898-1 (strength classes); split hubs and face clamps
by Coulomb's friction.
"""

import math

PROOF = {"8.8": 640.0, "10.9": 940.0, "12.9": 1100.0, "A2-70": 450.0}
"""Strength class to R_p0.2, MPa (ISO 898-1 up to M16, ISO 3506-1)."""

SHARE = 0.7
"""Of R_p0.2 that the preload takes: it leaves 30 % for the load, and a torque wrench is 15 % off."""

UTILISED = 0.9
"""Of R_p0.2 that tension and torsion may take together while a screw is tightened (VDI 2230)."""

FRICTION = 0.12
"""Of oiled steel, in thread, under the head and between faces."""

STAINLESS_FRICTION = 0.2
"""Of stainless screws with paste; dry ones gall."""

_FLANK, _LEAN = 0.57735, 1.155
"""Friction on flanks of 60°, 1/(2 cos 30°) and its double, as VDI 2230 prints it."""

_MEAN, _PITCH = 0.938194, 0.649519
"""By how many pitches the diameter of the stress area and the pitch diameter are below the nominal one."""

CLAMP_SAFETY = 2.0
"""Of a clamp, or of what else joins two parts, against the peak torque."""


def stress_area(d: float, pitch: float) -> float:
    """π/4 (d - 0.9382 P)², mm².

    >>> round(stress_area(4, 0.7), 4)
    8.7787
    """
    return math.pi / 4 * (d - _MEAN * pitch) ** 2


def preload(area: float, proof: float = PROOF["8.8"], share: float = SHARE) -> float:
    """What a screw is tightened to, N."""
    return share * proof * area


def friction_of(grade: str) -> float:
    """In the thread and under the head of a screw of a strength class."""
    return STAINLESS_FRICTION if grade.startswith("A") else FRICTION


def yield_preload(
    d: float, pitch: float, proof: float, friction: float = FRICTION, share: float = UTILISED
) -> float:
    """At which tension and the torsion of tightening take a share of R_p0.2 together, N (VDI 2230).

    ν R_p0.2 A_S/√(1 + 3 (1.5 d2/d_S (P/(π d2) + 1.155 μ))²) with A_S = π/4 d_S².

    >>> round(yield_preload(5, 0.8, PROOF["8.8"]))
    7202
    """
    area, flank = stress_area(d, pitch), d - _PITCH * pitch
    lean = pitch / (math.pi * flank) + _LEAN * friction
    torsion = 1.5 * flank / math.sqrt(4 * area / math.pi) * lean
    return share * proof * area / math.sqrt(1 + 3 * torsion**2)


def tightening_torque(
    force: float, d: float, pitch: float, head: float, hole: float, friction: float = FRICTION
) -> float:
    """N m: F (P/2π + 0.577 d2 μ + (dk + dh)/4 μ) with the pitch diameter d2 = d - 0.6495 P."""
    flank = d - _PITCH * pitch
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
