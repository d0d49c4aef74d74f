"""The designs that show an adjustable machine, one for each phase."""

import math
from typing import Any

import numpy as np

from mechwright import Array
from mechwright.mechanics.adjustable import Pins
from mechwright_spherical.defaults.complete_parameters import CompleteParams
from mechwright_spherical.kinematics.vectors import arc, azimuth, cross, dot, norm
from mechwright_spherical.parameters import (
    FiveBarPhase,
    FiveBarTable,
    FourBarPhase,
    FourBarTable,
    SphericalParams,
)
from mechwright_spherical.requirements import AdjustablePathRequirement

DIGITS = 12
"""Decimals of directions and degrees in design files."""


def designs_of(
    wanted: AdjustablePathRequirement, pins: Pins, theta: list[Array], targets: tuple[Array, ...]
) -> list[tuple[int, SphericalParams]]:
    """Designs with the number of the phase that each shows.

    They are one machine with all its phases. Where pins of the ground are set, each is a four-bar of one
    phase with the arcs and places of that.

    Parameters
    ----------
    pins
        (3, phases) in the pose of setting.
    theta
        Crank angles (n,) of the points of each phase, that of the pose first, rad.
    targets
        Path points (3, n) of each phase.
    """
    phases = range(len(theta))
    if wanted.linkage == "five-bar":
        five = _five_bar(wanted, pins, theta, targets)
        return [(k + 1, _design(wanted, five_bar=five.model_copy(update={"phase": k + 1}))) for k in phases]
    if wanted.moves != "moving" or len(theta) == 1:
        return [(k + 1, _design(wanted, four_bar=_four_bar(wanted, pins, theta, targets, k))) for k in phases]
    first = _four_bar(wanted, pins, theta, targets, 0)
    rows = tuple(
        FourBarPhase(
            crank_turn=_degrees(azimuth(pins.of(0).a0, pins.of(0).a, pins.of(k).a)),
            follower_turn=_degrees(azimuth(pins.of(0).b0, pins.of(0).c, pins.of(k).c)),
            **_course(wanted, pins, theta[k], targets[k], k),
        )
        for k in phases[1:]
    )
    changes = {"setting_angle": first.start, "phases": rows}
    return [
        (k + 1, _design(wanted, four_bar=first.model_copy(update={**changes, "phase": k + 1})))
        for k in phases
    ]


def _design(wanted: AdjustablePathRequirement, **table: FourBarTable | FiveBarTable) -> SphericalParams:
    return CompleteParams(
        kind=wanted.linkage,
        radius=wanted.radius,
        speed=wanted.speed,
        least_transmission=wanted.least_transmission,
        **table,
    )


def _degrees(angle: Array) -> float:
    return round(math.degrees(float(angle)), DIGITS)


def _course(
    wanted: AdjustablePathRequirement, pins: Pins, theta: Array, targets: Array, k: int
) -> dict[str, Any]:
    """Start, travel and path of a four-bar's phase, from 0, as its table has them."""
    one = pins.of(k)
    travel = math.copysign(360.0, theta[-1]) if wanted.full_turn else math.degrees(theta[-1])
    return {
        "start": _degrees(azimuth(one.a0, one.b0, one.a)),
        "travel": round(travel, DIGITS),
        "path": tuple(_row(one) for one in targets.T),
        "path_angles": tuple(np.degrees(theta).round(DIGITS).tolist()),
    }


def _four_bar(
    wanted: AdjustablePathRequirement,
    pins: Pins,
    theta: list[Array],
    targets: tuple[Array, ...],
    k: int,
) -> FourBarTable:
    one = pins.of(k)
    o, a, c, b, p = one.a0, one.a, one.b0, one.c, one.p
    m = cross(a, b) / norm(cross(a, b))
    arcs = {"ground": (o, c), "input": (o, a), "coupler": (a, b), "output": (c, b)}
    return FourBarTable(
        **{name: _degrees(arc(*ends)) for name, ends in arcs.items()},
        branch=1 if float(dot(c, cross(a, b))) > 0 else -1,
        point_azimuth=round(math.degrees(math.atan2(float(dot(p, cross(m, a))), float(dot(p, a)))), DIGITS),
        point_elevation=round(math.degrees(math.asin(max(-1.0, min(1.0, float(dot(p, m)))))), DIGITS),
        input_axis=_row(o),
        output_towards=_row(c),
        **_course(wanted, pins, theta[k], targets[k], k),
    )


def _five_bar(
    wanted: AdjustablePathRequirement, pins: Pins, theta: list[Array], targets: tuple[Array, ...]
) -> FiveBarTable:
    one, two = pins.of(0), pins.of(1)
    angles = [np.degrees(each).round(DIGITS - 2).tolist() for each in theta]
    paths = [tuple(_row(point) for point in each.T) for each in targets]
    return FiveBarTable(
        a0=_row(one.a0),
        a1=_row(one.a),
        a1n=_row(two.a),
        b0=_row(one.b0),
        b1=_row(one.b1),
        c1=_row(one.c),
        c1n=_row(two.c),
        point=_row(one.p),
        ratio=wanted.ratio,
        travel=angles[0][-1],
        travel_n=angles[1][-1],
        path=paths[0],
        path_angles=tuple(angles[0]),
        path_n=paths[1],
        path_angles_n=tuple(angles[1]),
        phases=tuple(
            FiveBarPhase(
                crank_turn=_degrees(azimuth(one.a0, one.a, pins.of(k).a)),
                rocker_turn=_degrees(azimuth(one.b1, one.c, pins.of(k).c)),
                travel=angles[k][-1],
                path=paths[k],
                path_angles=tuple(angles[k]),
            )
            for k in range(2, len(theta))
        ),
    )


def _row(v: Array) -> tuple[float, float, float]:
    x, y, z = v.round(DIGITS).tolist()
    return x, y, z
