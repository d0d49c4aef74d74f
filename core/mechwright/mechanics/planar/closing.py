"""Closing quantities of dyads: smooth functions of the input that are 0 where a dyad stops to close.

Each is above 0 where the dyad closes with a transmission angle above μ₀, and is known also where it does not
close. With d the vector between the outer joints:

* RRR: cos μ = (l₁² + l₂² - D²)/(2 l₁ l₂), so 1 - cos μ is 0 where the bars fold over each other,
  D = |l₁ - l₂|, and 1 + cos μ where they stretch, D = l₁ + l₂;
* RRP: u = (h - Im d)/l, 1 - u and 1 + u;
* RPR: D² - h², over the square of the machine's size;
* PRP and RPP: the sine X between the lines; the dyad closes on both sides of 0, where its pin is at infinity.

With μ₀ above 0, 1 ± c becomes cos μ₀ ± c, D² - h² becomes D² cos² μ₀ - h², and X becomes X² - sin² μ₀.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.planar.assembly_order import Dyad
from mechwright.mechanics.planar.free_bodies import GROUND
from mechwright.mechanics.planar.machine import GearPair, Machine, Prismatic, Revolute
from mechwright.mechanics.planar.outer_joints import (
    guide_line,
    neighbour,
    offset_across,
    offset_from_line,
    outer_pin,
)
from mechwright.mechanics.planar.rigid import BodyMotion


@dataclass(frozen=True)
class ClosingQuantity:
    """A closing quantity over the input.

    Parameters
    ----------
    limit
        What the dyad does at 0: ``"folded"``, ``"stretched"``, ``"square to the slide"``, ``"in line with the
        slide"`` or ``"parallel slides"``.
    value, slope
        The quantity and its derivative by the input (..., n).
    both_sides
        Whether the dyad closes below 0 too.
    """

    limit: str
    value: Array
    slope: Array
    both_sides: bool = False


def closing_quantities(
    machine: Machine, group: Dyad, bodies: Mapping[str, BodyMotion], transmission: float = 0.0
) -> tuple[ClosingQuantity, ...]:
    """The closing quantities of a dyad.

    Parameters
    ----------
    machine, group
        The machine and its dyad.
    bodies
        Motion of the links that the dyad is joined to, with the rates 1, 0, 0 of the input.
    transmission
        μ₀, rad: the least transmission angle with which the dyad counts as closed.
    """
    inner, (first, last), (one, two) = group.inner, group.outer, group.links
    short = 2 * math.sin(transmission / 2) ** 2
    if isinstance(first, Revolute) and isinstance(last, Revolute):
        ends = [outer_pin(joint, link, bodies, 1) for joint, link in ((first, one), (last, two))]
        d, rate = ends[1].position - ends[0].position, ends[1].velocity - ends[0].velocity
        distance, slope = np.abs(d), 2 * (np.conj(d) * rate).real
        if isinstance(inner, Revolute):
            a, b = (abs(inner.place(link) - joint.place(link)) for joint, link in ((first, one), (last, two)))
            folded = (distance - (a - b)) * (distance + (a - b)) / (2 * a * b) - short
            stretched = (a + b - distance) * (a + b + distance) / (2 * a * b) - short
            return (
                ClosingQuantity("folded", folded, slope / (2 * a * b)),
                ClosingQuantity("stretched", stretched, -slope / (2 * a * b)),
            )
        offset, share = offset_across(inner, first.place(one), last.place(two), one), math.cos(transmission)
        value = (share * distance - offset) * (share * distance + offset) / size_of(machine) ** 2
        return (ClosingQuantity("square to the slide", value, share**2 * slope / size_of(machine) ** 2),)
    assert isinstance(last, Prismatic)  # noqa: S101 - as groups are ordered
    stands = neighbour(last, two)
    line = guide_line(last, bodies[stands], stands, 1)
    if isinstance(inner, Revolute) and isinstance(first, Revolute):
        pin, length = outer_pin(first, one, bodies, 1), abs(inner.place(one) - first.place(one))
        d = (pin.position - line.point.position) / line.turning.direction
        rate = (pin.velocity - line.point.velocity) / line.turning.direction
        share = (offset_from_line(last, two, inner.place(two)) - d.imag) / length
        slope = -(rate.imag - line.turning.omega * d.real) / length
        return (
            ClosingQuantity("square to the slide", 1 - share - short, -slope),
            ClosingQuantity("square to the slide", 1 + share - short, slope),
        )
    if isinstance(first, Prismatic):
        stands = neighbour(first, one)
        mate = guide_line(first, bodies[stands], stands, 1).turning
        between, speed = mate.theta - line.turning.theta, mate.omega - line.turning.omega
    else:  # the angle between both slides is that between both lines of the second link
        between = _angle_in(inner, two) - _angle_in(last, two) + 0 * line.turning.theta
        speed = 0 * between
    sine, slope = np.sin(between), np.cos(between) * speed
    if transmission:
        value = sine**2 - math.sin(transmission) ** 2
        return (ClosingQuantity("parallel slides", value, 2 * sine * slope),)
    return (ClosingQuantity("parallel slides", sine, slope, both_sides=True),)


def _angle_in(joint: Revolute | Prismatic, link: str) -> Any:
    return joint.direction(link) if isinstance(joint, Prismatic) else 0.0


def size_of(machine: Machine) -> float:
    """A length within which the machine stays: the sum of the extents of its links, mm."""
    places: dict[str, list[complex]] = {GROUND: [0j]}
    for joint in machine.joints:
        if not isinstance(joint, GearPair):
            for link in joint.links:
                places.setdefault(link, []).append(complex(joint.place(link)))
    return sum(max(abs(a - b) for a in own for b in own) for own in places.values()) or 1.0
