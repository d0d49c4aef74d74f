"""Masses of the parts, as :mod:`mechwright_cam_follower.parts.parts` draws them.

Outlines are lines and arcs, but for the cam's: of that, Green's theorem gives the area as an integral over
the turn. With the pitch curve c in the cam's frame, V its rate over the cam's angle and R the roller's radius

    A = A_c - R L + π R²,  2 A_c = ∫ Im(c̄ V) dθ over the cam,  L = ∫ |V| dθ

(the parallel curve of one that winds once), and with the support function h of a flat face, whose normal
stands under β, and the radius of curvature ρ

    2 A = ∫ h ρ |β'| dθ.

Between breaks of the law all this is smooth, and Gauss' quadrature meets it.
"""

import math
from collections.abc import Callable
from functools import partial
from itertools import pairwise
from typing import Any

import numpy as np

from mechwright import Array, material
from mechwright.contracts.design_table import by_row
from mechwright.contracts.figure import PartMass
from mechwright.contracts.mass import KILOGRAMS
from mechwright.mechanics.laws import Rates
from mechwright.mechanics.linkage.areas import (
    circle_area,
    hull_area,
    rectangle_area,
    strip_area,
    two_discs_area,
)
from mechwright_cam_follower.kinematics.contact import contact_of, roller_motion, velocity_of
from mechwright_cam_follower.kinematics.extremes import face_ends
from mechwright_cam_follower.kinematics.mechanism import Mechanism
from mechwright_cam_follower.kinematics.motion import ROLLERS
from mechwright_cam_follower.parts.follower_dimensions import (
    CORNER,
    follower_depth,
    slide_height,
    slide_sides,
)
from mechwright_cam_follower.parts.parts import BOSSES, carriage_holes
from mechwright_cam_follower.parts.shaft_opening import opening_area
from mechwright_cam_follower.parts.slide_dimensions import bar_width, shaft_room
from mechwright_cam_follower.parts.spring_parts import SPRING_MASSES, spring_hole_area
from mechwright_cam_follower.spring.choice import spring_tail

NODES = 24
"""Of a smooth piece of the turn: those of the laws, up to a whole turn wide, are met to 1e-9."""

_GAUSS = np.polynomial.legendre.leggauss(NODES)


def masses_of(m: Mechanism) -> dict[str, PartMass]:
    """Give the masses of the parts, kg, by their names."""

    def part(area: Callable[[Mechanism], Any], depth: Any, copies: int = 1) -> PartMass:
        density = KILOGRAMS * material(m.given.material).density
        return PartMass(lambda: area(m) * depth * density, copies)

    found = {"cam-2" if cam else "cam": part(partial(_cam, cam=cam), m.given.thickness) for cam in m.cams}
    found["slide" if m.slides else "lever"] = part(_follower, follower_depth(m))
    if not m.flat:
        found |= {name: PartMass(partial(_roller, m)) for _, name in zip(m.cams, ROLLERS, strict=False)}
    if m.railed:
        found["rail"] = part(_rail, follower_depth(m), 2)
    if m.given.spring is not None:
        found |= {name: PartMass(partial(by_row(mass), m)) for name, mass in SPRING_MASSES.items()}
    return found


def _cam(m: Mechanism, cam: int) -> Any:
    return _inside(m, cam) - opening_area(m) - m.given.screws * circle_area(m.given.screw_diameter)


def _inside(m: Mechanism, cam: int) -> Any:
    """Area of a cam without its bores."""
    spread, rates = _quadrature(m)
    if m.flat:
        return _column(m, np.abs(_facing(m, rates) @ spread) / 2)
    (x, y), first, *_ = roller_motion(m, rates, cam)
    u, v = velocity_of(m, (x, y), first)
    swept, length = (x * v - y * u) @ spread, np.sqrt(u * u + v * v) @ spread
    return _column(m, np.abs(swept) / 2) - m.roller * _column(m, length) + math.pi * m.roller**2


def _column(m: Mechanism, values: Array) -> Any:
    """Give values (n,) as a column, that of one design as a number."""
    return values.item() if m.single else np.reshape(values, (-1, 1))


def _quadrature(m: Mechanism) -> tuple[Array, Rates]:
    """Give the weights (k,) of Gauss' quadrature over a turn, rad, and the rates at its nodes."""
    nodes, weights = _GAUSS
    spreads, rates = [], []
    for segment in m.cycle.segments:
        for low, high in pairwise(segment.cuts):
            half = (high - low) / 2
            still = segment.law is None
            rates.append(segment.at(np.zeros(1) if still else low + half * (1 + nodes)))
            spreads.append((np.ones(1) if still else half * weights) * segment.width)
    joined = (np.concatenate([getattr(one, name) for one in rates]) for name in "svaj")
    return np.concatenate(spreads), Rates(*joined)


def _facing(m: Mechanism, rates: Rates) -> Array:
    """What a flat face's support, radius of curvature and turning give (n, k)."""
    radius = contact_of(m, rates).radius
    if m.slides:
        return np.asarray((m.given.base_radius + rates.s) * radius)
    support = m.axis * np.cos(m.start - rates.s) - m.face
    return np.asarray(support * radius * np.abs(rates.v + m.sense))


def _follower(m: Mechanism) -> Any:
    """Slide or lever."""
    area = _slide(m) if m.slides else _lever(m) - circle_area(m.given.pivot_bore)
    if not m.flat:
        area = area - len(m.cams) * circle_area(m.given.pin_diameter)
    if m.given.spring is not None:
        area = area - by_row(spring_hole_area)(m)
    area = area - sum(circle_area(size) for _, size in carriage_holes(m).values())
    if m.given.conjugate:
        area = area - strip_area(m.stroke * (1.0 if m.slides else m.axis), shaft_room(m))
    return area


def _slide(m: Mechanism) -> Any:
    if m.flat:
        low, high = slide_sides(m)
        margin = m.value("face_margin")
        corner = np.minimum(np.minimum(CORNER, margin), (high - low) / 3)
        return rectangle_area(high - low, slide_height(m), corner)
    apart = m.apart if m.given.conjugate else 0.0
    return strip_area(apart + slide_height(m), bar_width(m) / 2)


def _lever(m: Mechanism) -> Any:
    half = m.given.follower_width / 2
    tail = 0.0 if m.given.spring is None else by_row(spring_tail)(m)
    if m.flat:
        (low, high), margin = face_ends(m), m.value("face_margin")
        corner = np.minimum(CORNER, margin)
        ends = [low - margin + corner, high + margin - corner]
        sides = [m.face - corner, m.face - m.given.follower_width + corner]
        corners = [end + 1j * side for side in sides for end in ends]
        return _hull(m, [-tail + 0j, 0j, *corners], [half, half, *[corner] * 4])
    if not m.given.conjugate:
        return two_discs_area(m.arm + tail, half, half)
    turns = np.linspace(0.0, m.stroke, BOSSES)
    places = [m.axis * np.exp(1j * (m.start + turn)) for turn in turns]
    studs = [0j, m.arm, m.arm * np.exp(1j * m.apart)]
    return _hull(m, [*studs, *places], [half] * 3 + [shaft_room(m) + m.given.least_wall] * BOSSES)


def _hull(m: Mechanism, centres: list[Any], radii: list[Any]) -> Any:
    places, sizes = ([np.ravel(one) for one in some] for some in (centres, radii))
    return _column(m, hull_area(places, sizes, m.size))


def _roller(m: Mechanism) -> Any:
    """With its stud, kg."""
    stud = circle_area(m.given.pin_diameter) * (m.given.axial_gap + m.given.follower_thickness)
    density = KILOGRAMS * material(m.given.roller_material).density
    return density * (circle_area(2 * m.roller) * m.given.thickness + stud)


def _rail(m: Mechanism) -> Any:
    width = 2 * (m.given.guide_screw + m.given.least_wall)
    area = rectangle_area(width, m.given.guide_length, CORNER)
    return area - 2 * circle_area(m.given.guide_screw)
