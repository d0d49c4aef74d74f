"""The smallest cam within limits of pressure angle and curvature.

For every place of the follower, an offset or a distance of the axes, there is a least base radius from which
on the limits are kept; the place is searched for whose cam reaches out least. A flat-faced slide has none.
"""

import math

import numpy as np

from mechwright import Array, Candidate, Finding, Progress, Rejected, Scalar, Synthesis
from mechwright.contracts.design_rule import Bools
from mechwright.contracts.finding import errors
from mechwright_cam_follower.kinematics.cycle import cycle_of
from mechwright_cam_follower.kinematics.extremes import (
    of_cams,
    outermost,
    pressure_peak,
    regular_limit,
    regularity,
    sharpest,
)
from mechwright_cam_follower.kinematics.mechanism import Mechanism, mechanism_of
from mechwright_cam_follower.parameters import CamParams
from mechwright_cam_follower.requirements import SMALLEST, SizeRequirement
from mechwright_cam_follower.rules.rule_table import RULES
from mechwright_cam_follower.rules.validity import bisected, first_good, fulfils, with_values

LARGEST = 500.0
"""Base radius, mm, beyond which no cam is looked for."""

_STEPS = 1.3
"""Ratio of base radii that are tried until one keeps the limits."""
_SAMPLES = 2881
"""Of a turn: eight each degree."""
_HALVINGS = 12
"""Of the last step: to a six-thousandth of the radius, with hundredths of a millimetre upwards after it."""
_PLACES, _ROUNDS, _SHRINK = 13, 6, 0.25
"""Places tried at once, how often, and the share of the range about the best that stays."""
_WIDEST = 3.0
"""Greatest offset, in strokes, and distance of the axes beyond its least, in arms, that are tried."""
_ROUND = 100.0
"""Sizes are given in hundredths of a millimetre."""


def smallest(wanted: SizeRequirement, progress: Progress) -> Synthesis[CamParams]:
    """The smallest cam, and of a slide the smallest in line besides."""
    key, low, high = _free(wanted)
    places: list[float | None] = [_best(wanted, key, low, high, progress)] if key else [None]
    if key == "offset":
        places.append(0.0)
    candidates: list[Candidate[CamParams]] = []
    rejected, why = Rejected(), ""
    for place in places:
        sizes = {key: place} if key and place is not None else {}
        base = _least_base(wanted, sizes) if not key or place is not None else None
        if base is None:
            continue
        params, why = _whole(wanted, {**sizes, "base_radius": base})
        if params is None:
            rejected.because("follower.not-buildable", why)
        elif all(params != one.params for one in candidates):
            candidates.append(Candidate(params, Scalar(0.0, "mm"), _figures(params, key)))
    candidates.sort(key=lambda one: one.figures["cam_radius"].value)
    if candidates:
        return Synthesis(tuple(candidates), (), rejected.reasons)
    fault = Finding.error(
        "follower.no-size",
        "greatest_pressure_angle",
        f"no cam up to a base radius of {LARGEST:g} mm keeps {wanted.greatest_pressure_angle:g} degrees and "
        f"{wanted.least_curvature_radius:g} mm" + (f": {why}" if why else ""),
        remedy="allow a larger pressure angle, longer angles of the cam, or a smaller stroke",
    )
    return Synthesis((), (fault,), rejected.reasons)


def _free(wanted: SizeRequirement) -> tuple[str, float, float]:
    """The size that is searched for, if any, and its range, mm."""
    design = wanted.design()
    if wanted.follower == "translating":
        if wanted.contact == "flat" or wanted.offset is not None:
            return "", 0.0, 0.0
        return "offset", -_WIDEST * design.stroke, _WIDEST * design.stroke
    if wanted.centre_distance is not None:
        return "", 0.0, 0.0
    arm = design.value("arm_length") if wanted.contact == "roller" else design.follower_width
    return "centre_distance", arm, (1 + _WIDEST) * arm


def _best(wanted: SizeRequirement, key: str, low: float, high: float, progress: Progress) -> float | None:
    """The place of the follower whose cam reaches out least."""
    best: tuple[float, float] | None = None
    a, b = low, high
    for number in range(_ROUNDS):
        for place in np.round(np.linspace(a, b, _PLACES), 2).tolist():
            base = _least_base(wanted, {key: place})
            if base is not None:
                params = wanted.design(**{key: place}, base_radius=base)
                reach = of_cams(mechanism_of(params), outermost).max().item()
                best = min(best or (math.inf, 0.0), (reach, place))
        progress((number + 1) / _ROUNDS, f"{key} {a:.2f} to {b:.2f} mm")
        if best is None:
            return None
        half = (b - a) * _SHRINK / 2
        a, b = max(low, best[1] - half), min(high, best[1] + half)
    return None if best is None else best[1]


def _least_base(wanted: SizeRequirement, sizes: dict[str, float]) -> float | None:
    """The least base radius, mm, in hundredths upwards, that keeps the limits; None if none does."""
    design = wanted.design(**sizes)

    def good(bases: Array) -> Bools:
        return keeps(with_values(design, base_radius=bases), wanted)

    ladder = [max(SMALLEST, wanted.bore / 2 + design.least_wall, _pressed(design, wanted))]
    while ladder[-1] * _STEPS <= LARGEST:
        ladder.append(ladder[-1] * _STEPS)
    ends = first_good(good, ladder)
    return None if ends is None else math.ceil(bisected(good, *ends, _HALVINGS) * _ROUND) / _ROUND


def _pressed(design: CamParams, wanted: SizeRequirement) -> float:
    """Base radius, mm, that the pressure angle of a slide with a roller asks for; 0 of others.

    |s' - e| <= tan α_max (s0 + s), s0 the height of the roller over the axis: s0 is at least the greatest of
    |s' - e|/tan α_max - s, seen at samples; hundredths upwards cover what they miss.
    """
    if not design.translating or design.contact == "flat":
        return 0.0
    rates, offset = cycle_of(design).at(np.linspace(0.0, math.tau, _SAMPLES)), design.value("offset")
    slope = math.tan(math.radians(wanted.greatest_pressure_angle))
    height = float((np.abs(rates.v - offset) / slope - rates.s).max())
    base = math.hypot(max(height, 0.0), offset) - design.value("roller_radius")
    return math.ceil(base * _ROUND) / _ROUND


def keeps(m: Mechanism, wanted: SizeRequirement) -> Bools:
    """Whether designs (n,) close and keep the limits of the requirement."""
    most = math.radians(wanted.greatest_pressure_angle)

    def limits(closed: Mechanism) -> Bools:
        found: Bools = np.all(of_cams(closed, regularity) >= regular_limit(closed), axis=1)
        if found.any():
            found &= np.all(of_cams(closed, pressure_peak) <= most, axis=1)
        if found.any():
            found &= np.all(of_cams(closed, sharpest) >= wanted.least_curvature_radius, axis=1)
        return found

    return fulfils(m, limits)


def _whole(wanted: SizeRequirement, sizes: dict[str, float]) -> tuple[CamParams | None, str]:
    """The design, made larger until all its parts have room, or why it cannot be built."""
    why = ""
    base = sizes["base_radius"]
    while base <= LARGEST:
        params = wanted.design(**{**sizes, "base_radius": base})
        faults = errors(RULES.findings(mechanism_of(params), quick=True))
        if not faults:
            return params, ""
        why = why or f"{faults[0].parameter}: {faults[0].message}"
        base = math.ceil(base * 1.05 * _ROUND) / _ROUND
    return None, why


def _figures(params: CamParams, key: str) -> dict[str, Scalar]:
    m = mechanism_of(params)
    place = {key: Scalar(params.value(key), "mm")} if key else {}
    return {
        "cam_radius": Scalar(of_cams(m, outermost).max().item(), "mm"),
        "base_radius": Scalar(params.base_radius, "mm"),
        **place,
        "greatest_pressure_angle": Scalar(of_cams(m, pressure_peak).max().item(), "rad"),
        "least_curvature_radius": Scalar(of_cams(m, sharpest).min().item(), "mm"),
    }
