"""The designs that show an adjustable machine: one per phase of a four-bar, one per pair of a five-bar."""

import math

import numpy as np

from mechwright import Array
from mechwright.mechanics.adjustable import Pins
from mechwright_spherical.params import FiveBarTable, FourBarTable, SphericalParams
from mechwright_spherical.requirements import AdjustablePathRequirement
from mechwright_spherical.vectors import arc, azimuth, cross, dot, norm

DIGITS = 12
"""Decimals of directions and degrees in design files."""


def designs_of(
    wanted: AdjustablePathRequirement, pins: Pins, theta: list[Array], targets: tuple[Array, ...]
) -> list[tuple[int, SphericalParams]]:
    """Designs with the number of the phase that each shows.

    A four-bar has one per phase, with the arcs and places of that phase. A five-bar has one for each phase,
    with the pins of phase 1 and of another one, phase 2 where it shows the first.

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
    if wanted.linkage == "four-bar":
        return [(k + 1, _four_bar(wanted, pins.of(k), theta[k], targets[k])) for k in phases]
    return [(k + 1, _five_bar(wanted, pins, theta, targets, max(k, 1), 1 + (k > 0))) for k in phases]


def _four_bar(wanted: AdjustablePathRequirement, pins: Pins, theta: Array, targets: Array) -> SphericalParams:
    o, a, c, b, p = pins.a0, pins.a, pins.b0, pins.c, pins.p
    m = cross(a, b) / norm(cross(a, b))
    arcs = {"ground": (o, c), "input": (o, a), "coupler": (a, b), "output": (c, b)}
    degrees = {name: round(math.degrees(float(arc(*ends))), DIGITS) for name, ends in arcs.items()}
    travel = math.copysign(360.0, theta[-1]) if wanted.full_turn else math.degrees(theta[-1])
    table = FourBarTable(
        **degrees,
        branch=1 if float(dot(c, cross(a, b))) > 0 else -1,
        point_azimuth=round(math.degrees(math.atan2(float(dot(p, cross(m, a))), float(dot(p, a)))), DIGITS),
        point_elevation=round(math.degrees(math.asin(max(-1.0, min(1.0, float(dot(p, m)))))), DIGITS),
        start=round(math.degrees(float(azimuth(o, c, a))), DIGITS),
        travel=round(travel, DIGITS),
        input_axis=_row(o),
        output_towards=_row(c),
        path=tuple(_row(one) for one in targets.T),
        path_angles=tuple(np.degrees(theta).round(DIGITS).tolist()),
    )
    return SphericalParams(
        kind="four-bar",
        radius=wanted.radius,
        speed=wanted.speed,
        least_transmission=wanted.least_transmission,
        four_bar=table,
    )


def _five_bar(
    wanted: AdjustablePathRequirement,
    pins: Pins,
    theta: list[Array],
    targets: tuple[Array, ...],
    other: int,
    shown: int,
) -> SphericalParams:
    one, two = pins.of(0), pins.of(other)
    angles = [np.degrees(theta[k]).round(DIGITS - 2).tolist() for k in (0, other)]
    table = FiveBarTable(
        a0=_row(one.a0),
        a1=_row(one.a),
        a1n=_row(two.a),
        b0=_row(one.b0),
        b1=_row(one.b1),
        c1=_row(one.c),
        c1n=_row(two.c),
        point=_row(one.p),
        ratio=wanted.ratio,
        phase=2 if shown == 2 else 1,
        travel=angles[0][-1],
        travel_n=angles[1][-1],
        path=tuple(_row(point) for point in targets[0].T),
        path_angles=tuple(angles[0]),
        path_n=tuple(_row(point) for point in targets[other].T),
        path_angles_n=tuple(angles[1]),
    )
    return SphericalParams(
        kind="five-bar",
        radius=wanted.radius,
        speed=wanted.speed,
        least_transmission=wanted.least_transmission,
        five_bar=table,
    )


def _row(v: Array) -> tuple[float, float, float]:
    x, y, z = v.round(DIGITS).tolist()
    return x, y, z
