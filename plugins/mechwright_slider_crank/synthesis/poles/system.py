"""Poles of a rod as equations of complex numbers: two poles with the crank's rotation between them.

Plane vectors are pairs of isotropic coordinates, x + i y and x - i y, which for complex places are
independent. The crank pin p and the pole G say how the rod moves, in the notation of
:mod:`mechwright_slider_crank.synthesis.poles.equations`:

    z = iα - ω² = (1 - i k)/(G/p - 1),   so   ω² = (p/(p - G) + p̄/(p̄ - Ḡ))/2   with k = 0,

and ω and α say how far the slide line is, w = -Re p/ω and t = (α w - Im p)/ω². That e = t + Im p and
c² = w² + t² are the same at both poles are two equations, the two of ω² the others, for the unknowns

    p₁, p̄₁, ω₁, ω₂

at the parameters G₁, G₂, Ḡ₁, Ḡ₂, T, T being the turn of the crank.

Solutions belong to (p₁, p̄₁, c², e, T) and the signs of two roots w₁, w₂ of different radicands, a variety
that does not fall apart; so loops of the parameters lead from any solution to all others.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from mechwright.mechanics.continuation import System
from mechwright.mechanics.planar import Plane

_HALF = 0.5


def rates(pin: Any, pin_: Any, pole: Any, pole_: Any) -> tuple[Any, Any]:
    """ω² and α of the rod."""
    z, z_ = pin / (pin - pole), pin_ / (pin_ - pole_)
    return (z + z_) * _HALF, (z_ - z) * (-_HALF * 1j)


def lengths(pin: Any, pin_: Any, omega: Any, square: Any, alpha: Any) -> tuple[Any, Any, Any]:
    """w, t and e of the slider-crank; ``square`` is ω²."""
    y = (pin - pin_) * (-_HALF * 1j)
    w = (pin + pin_) * (-_HALF) / omega
    t = (alpha * w - y) / square
    return w, t, t + y


def equations(unknowns: Sequence[Any], parameters: Sequence[Any]) -> list[Any]:
    """The four values that are to be 0."""
    pin, pin_, *omegas = unknowns
    places, places_, turn = parameters[:2], parameters[2:4], parameters[4]
    values, found = [], []
    for number, omega in enumerate(omegas):
        p, p_ = (pin * turn, pin_ / turn) if number else (pin, pin_)
        square, alpha = rates(p, p_, places[number], places_[number])
        w, t, e = lengths(p, p_, omega, square, alpha)
        values.append(omega * omega - square)
        found.append((e, w * w + t * t))
    (e1, c1), (e2, c2) = found
    return [*values, e2 - e1, c2 - c1]


TWO_POLES = System(equations)
"""Two poles, the rotation between them, constant speed."""

MOVING = 4
"""Parameters that move where solutions are counted: the places. Solutions with the others as they are are as
irreducible as all."""


def any_parameters(rng: np.random.Generator) -> Plane:
    """Complex parameters (5,) in general position, of the order of 1."""
    places = np.exp(2j * np.pi * rng.random(4)) * rng.uniform(0.6, 1.4, 4)
    return np.append(places, np.exp(2j * np.pi * rng.random()) * rng.uniform(0.7, 1.4))


def any_solution(rng: np.random.Generator) -> tuple[Plane, Plane]:
    """A solution (1, 4) and its parameters (5,): a linkage is drawn by lot, and moved."""
    pin, pin_, c2, e = rng.normal(size=4) + 1j * rng.normal(size=4)
    turn = np.exp(2j * np.pi * rng.random()) * rng.uniform(0.7, 1.4)
    omegas, places, places_ = [], [], []
    for p, p_ in ((pin, pin_), (pin * turn, pin_ / turn)):
        x, y = (p + p_) / 2, (p - p_) / 2j
        t = e - y
        w = np.sqrt(c2 - t * t)
        omega = -x / w
        alpha = (y + t * omega**2) / w
        omegas.append(omega)
        places.append(p + p / (1j * alpha - omega**2))
        places_.append(p_ + p_ / (-1j * alpha - omega**2))
    return np.array([[pin, pin_, *omegas]]), np.array([*places, *places_, turn])
