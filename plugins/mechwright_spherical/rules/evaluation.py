"""Many spherical four-bars at once: what forbids them, and their figures.

It covers what :func:`covered` says. Where crank and rocker have no room in one shell, and the ground may
stand on both sides, a design is checked by itself; columns of the path point and of the coupler are those of
each motion.
"""

import math
from collections.abc import Collection
from typing import Any

import numpy as np

from mechwright import Array, Stage
from mechwright.contracts.by_arrays import Answer, Designs
from mechwright.contracts.sampling import SAMPLES
from mechwright.mechanics.planar.swing import TURN_BACK
from mechwright_spherical.kinematics import kernels
from mechwright_spherical.kinematics.clearances import SAMPLES as WAY_SAMPLES
from mechwright_spherical.kinematics.four_bar import FourBar
from mechwright_spherical.kinematics.linkage import SHORTEST
from mechwright_spherical.kinematics.mobility import mobility
from mechwright_spherical.rules.many_checks import Rooms, hardware_errors

_APART = {
    "kind",
    "path_tolerance",
    "five_bar",
    "drive",
    "hardware.frame",
    "hardware.section",
    "stand.motor_flange",
}
"""What is not varied here."""

_OWN = {"ground", "input", "coupler", "output", "branch", "point_azimuth", "point_elevation"}
"""What of the four-bar's table may be varied."""

_EDGE = 1e-9
"""Cosines that are so near to a limit are left to the check itself: rounding."""

_RATES = {
    "omega": kernels.OMEGA, "alpha": kernels.ALPHA, "jerk": kernels.JERK,
    "omega_psi": kernels.OMEGA_PSI, "alpha_psi": kernels.ALPHA_PSI, "jerk_psi": kernels.JERK_PSI,
}  # fmt: skip


def circle_of(samples: int) -> Array:
    """Cosine and sine of shares of a turn, and the shares (3, samples), both ends included."""
    share = np.linspace(0.0, 1.0, samples)
    return np.ascontiguousarray([np.cos(math.tau * share), np.sin(math.tau * share), share])


_CIRCLE, _WAY = circle_of(SAMPLES), circle_of(WAY_SAMPLES)


def covered(designs: Designs) -> bool:
    """Whether these are four-bars of one phase that go as far as they can, without path and motor."""
    one, four = designs.common, designs.common.four_bar
    strange = [
        name
        for name in designs.varied
        if name in _APART
        or name.partition(".")[0] in _APART
        or (name.startswith("four_bar.") and name.removeprefix("four_bar.") not in _OWN)
    ]
    plain = one.kind == "four-bar" and four.start is None and four.travel is None and not four.phases
    plain = plain and not four.path and one.hardware.frame != "two" and one.stand.motor_flange is None
    return plain and not strange


def answer(designs: Designs, columns: Collection[str], stage: Stage) -> Answer | None:
    """What is found of them; see :mod:`mechwright.contracts.by_arrays`."""
    if not covered(designs):
        return None
    found = Answer(len(designs))
    arcs = np.stack(
        [np.radians(designs.full(f"four_bar.{name}")) for name in ("ground", "input", "coupler", "output")]
    )
    for degrees in np.degrees(arcs):
        limit = math.degrees(SHORTEST)
        found.forbid("spherical.pins", ~((degrees >= limit) & (degrees <= 180 - limit)))
    bars = np.column_stack([*arcs, designs.full("four_bar.branch")]).astype(float)
    drives, least = _course(found, designs, arcs, stage)
    if stage is not Stage.MOTION:
        hardware_errors(found, designs, arcs, lambda places: _rooms(bars[places], drives[places]))
    _figures(found, columns, arcs, drives, least)
    left = found.left
    if set(columns) & {f"{name}.{end}" for name in _RATES for end in ("least", "greatest")}:
        told = kernels.extremes(bars[left], drives[left], _CIRCLE)
        for name in columns:
            channel, _, end = name.rpartition(".")
            if channel in _RATES:
                found.give(name, told[:, _RATES[channel], int(end == "greatest")], left)
    if {"psi.least", "psi.greatest"} & set(columns):
        _angles(found, bars, drives)
    return found


def _course(found: Answer, designs: Designs, arcs: Array, stage: Stage) -> tuple[Array, Array]:
    """Drives (n, 4), and the cosines (2, n) of the transmission angle at the ends of its range."""
    a1, a2, a3, a4 = arcs
    level, swing = np.cos(a1) * np.cos(a2), np.sin(a1) * np.sin(a2)
    less = 2 * np.sin(a3) * np.sin(a4) * math.sin(TURN_BACK / 2) ** 2
    highest = (np.cos(a3 - a4) - less - level) / swing
    lowest = (np.cos(a3 + a4) + less - level) / swing
    apart = (highest < -1) | (lowest > 1) | (lowest >= highest)
    near_edge = [np.abs(one - edge) < _EDGE for one in (highest, lowest) for edge in (-1.0, 1.0)]
    found.doubt(np.any([*near_edge, np.abs(lowest - highest) < _EDGE], axis=0))
    if stage is Stage.MOTION:
        found.doubt(apart)  # it may come apart, or stand in a dead centre, where parts alone are refused
    found.forbid("spherical.assembly", apart)
    near, far = np.arccos(np.clip(highest, -1, 1)), np.arccos(np.clip(lowest, -1, 1))
    inward, outward = highest >= 1, lowest <= -1
    full = inward & outward
    start = np.where(full, 0.0, np.where(inward, -far, near))
    stop = np.where(full, math.tau, np.where(inward | ~outward, far, math.tau - near))
    drives = np.stack(
        [start, stop - start, np.where(full, 0.0, 1.0), designs.full("speed") * math.tau / 60], axis=1
    )
    ends = [np.where(some, x, start) for some, x in ((inward, 0.0), (outward, math.pi))]
    ends += [np.where(full, 0.0, start), np.where(full, 0.0, stop)]
    cosines = [
        (level + swing * np.cos(x) - np.cos(a3) * np.cos(a4)) / (np.sin(a3) * np.sin(a4)) for x in ends
    ]
    return drives, np.stack([np.minimum.reduce(cosines), np.maximum.reduce(cosines)])


def _rooms(bars: Array, drives: Array) -> Rooms:
    """How near crank and rocker come."""
    told = kernels.nearest(bars, drives, _WAY)
    arc, end = np.arccos(np.clip(told[:, :2], -1, 1)).T
    return Rooms(arc, end, np.asarray(told[:, 2] > 0))


def _figures(found: Answer, columns: Collection[str], arcs: Array, drives: Array, cosines: Array) -> None:
    """The figures that need no samples."""
    asked = set(columns)
    for names, cosine in (
        (("transmission_min", "transmission_angle.least"), cosines[1]),
        (("transmission_max", "transmission_angle.greatest"), cosines[0]),
    ):
        for name in asked & set(names):
            found.give(name, np.degrees(np.arccos(np.clip(cosine, -1, 1))))
    if asked & {"T1", "T2", "T3", "T4"}:
        for name, value in zip(("T1", "T2", "T3", "T4"), mobility(*arcs).t, strict=True):
            if name in asked:
                found.give(name, np.degrees(value))
    if "time.least" in asked:
        found.give("time.least", np.zeros(found.size))
    if "time.greatest" in asked:
        found.give("time.greatest", math.tau / drives[:, 3])


def _angles(found: Answer, bars: Array, drives: Array) -> None:
    """Extremes of the output's angle."""
    left = found.left
    fields: list[Any] = [bars[left, place, None] for place in range(5)]
    start, travel, rocks, _ = drives[left].T[:, :, None]
    theta = np.where(rocks > 0, start + travel / 2 * (1 - _CIRCLE[0]), math.tau * _CIRCLE[2])
    psi = FourBar(*fields).output_angle(theta)
    psi = psi - math.tau * np.round(psi[:, :1] / math.tau)
    found.give("psi.least", np.degrees(psi.min(axis=1)), left)
    found.give("psi.greatest", np.degrees(psi.max(axis=1)), left)
