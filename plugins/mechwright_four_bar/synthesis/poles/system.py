"""Poles of a coupler as equations of complex numbers: two poles with the crank's turn and the ground given.

Plane vectors are pairs of isotropic coordinates, x + i y and x - i y, which for complex places are
independent. With the crank A and the pole G at constant speed the coupler's ω² - iα is ζ = A/(A - G), and
ζ̄ = Ā/(Ā - Ḡ). With v the follower's speed over the crank's, B moves about B0 as the coupler says: from
D = A + C - B0 and A + ω C = v D follow coupler C and follower D,

    C = (A (1 - v) + v B0)/(v - ω),   D = A + C - B0,

and the acceleration of B along D is v² of D. Each pole asks for

    2 ω² = ζ + ζ̄,   (A + ζ C) D̄ + (Ā + ζ̄ C̄) D = 2 v² D D̄,

and both for equal lengths, C₁ C̄₁ = C₂ C̄₂ and D₁ D̄₁ = D₂ D̄₂. The unknowns are

    A₁, Ā₁, ω₁, ω₂, v₁, v₂

at the parameters G₁, G₂, Ḡ₁, Ḡ₂, T, B0, B̄0, T being the turn of the crank.

Solutions belong to A₁, Ā₁, T, B0, B̄0, the squares of both lengths, and the signs of two roots of different
radicands, which say on which branch the dyad is joined: a variety that does not fall apart. So loops of the
parameters lead from any solution to all others.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from mechwright.mechanics.continuation import System
from mechwright.mechanics.planar import Plane


def links(pin: Any, pin_: Any, pivot: Any, pivot_: Any, omega: Any, v: Any) -> tuple[Any, Any, Any, Any]:
    """C, C̄, D and D̄ of the dyad."""
    inverse = 1 / (v - omega)
    c, c_ = (pin - pin * v + pivot * v) * inverse, (pin_ - pin_ * v + pivot_ * v) * inverse
    return c, c_, pin + c - pivot, pin_ + c_ - pivot_


def equations(unknowns: Sequence[Any], parameters: Sequence[Any]) -> list[Any]:
    """The six values that are to be 0."""
    pin, pin_, *speeds = unknowns
    places, places_ = parameters[:2], parameters[2:4]
    turn, pivot, pivot_ = parameters[4:]
    values, coupler, follower = [], [], []
    for number in range(2):
        p, p_ = (pin * turn, pin_ / turn) if number else (pin, pin_)
        omega, v = speeds[number], speeds[2 + number]
        zeta, zeta_ = p / (p - places[number]), p_ / (p_ - places_[number])
        c, c_, d, d_ = links(p, p_, pivot, pivot_, omega, v)
        values.append(omega * omega * 2 - zeta - zeta_)
        values.append((p + zeta * c) * d_ + (p_ + zeta_ * c_) * d - v * v * d * d_ * 2)
        coupler.append(c * c_)
        follower.append(d * d_)
    return [*values, coupler[1] - coupler[0], follower[1] - follower[0]]


TWO_POLES = System(equations)
"""Two poles, the turn between them and the ground given, constant speed."""


MOVING = 4
"""Parameters that move where solutions are counted: the places. Solutions with the others as they are are as
irreducible as all: what is left are both coordinates of A₁, both lengths, and the roots."""


def any_parameters(rng: np.random.Generator) -> Plane:
    """Complex parameters (7,) in general position, of the order of 1."""
    places = np.exp(2j * np.pi * rng.random(6)) * rng.uniform(0.6, 1.4, 6)
    turn = np.exp(2j * np.pi * rng.random()) * rng.uniform(0.7, 1.4)
    return np.concatenate((places[:4], [turn], places[4:]))


def any_solution(rng: np.random.Generator) -> tuple[Plane, Plane]:
    """A solution (1, 6) and its parameters (7,): a linkage is drawn by lot, and moved."""
    pin, pin_, pivot, pivot_, c2, b2 = rng.normal(size=6) + 1j * rng.normal(size=6)
    turn = np.exp(2j * np.pi * rng.random()) * rng.uniform(0.7, 1.4)
    omegas, speeds, places, places_ = [], [], [], []
    for p, p_ in ((pin, pin_), (pin * turn, pin_ / turn)):
        e, e_ = pivot - p, pivot_ - p_
        middle = c2 + e * e_ - b2
        c = (middle + np.sqrt(middle**2 - 4 * c2 * e * e_)) / (2 * e_)
        c_ = c2 / c
        d, d_ = c - e, c_ - e_
        omega, v = np.linalg.solve(np.array([[c, -d], [c_, -d_]]), [-p, -p_])
        right = [p + omega**2 * c - v**2 * d, p_ + omega**2 * c_ - v**2 * d_]
        alpha, _ = np.linalg.solve(np.array([[1j * c, -1j * d], [-1j * c_, 1j * d_]]), right)
        omegas.append(omega)
        speeds.append(v)
        places.append(p - p / (omega**2 - 1j * alpha))
        places_.append(p_ - p_ / (omega**2 + 1j * alpha))
    return np.array([[pin, pin_, *omegas, *speeds]]), np.array([*places, *places_, turn, pivot, pivot_])
