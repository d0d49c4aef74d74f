"""The motion of a four-bar whose links all line up, smoothly through its change points.

There W, which tells both assemblies apart, goes through 0, and the linkage that nothing disturbs goes on in
the other assembly: with a + f = b + c and x = φ - θ

    (b + c)² - D² = 4 a f cos²(x/2),   and with |f - a| = |b - c|   D² - (b - c)² = 4 a f sin²(x/2),

so that W has a root without a kink, in which the sign of the assembly is kept. Both hold for parallelogram
and kite. Where crank and ground as well as coupler and follower are alike, A meets B0; there

    e^{iσ} = -i e^{i(θ + x/2)} (D + i β √((b + c)² - D²)) / (2 c),   D = 2 a sin(x/2).

All of it is carried along with three derivatives over x, which no quotient of two vanishing numbers spoils.
"""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from mechwright import Array
from mechwright.mechanics.planar import Plane
from mechwright.mechanics.planar.dyad import Rates
from mechwright_four_bar.kinematics.dimensions import CHANGE_POINT, FourBar
from mechwright_four_bar.kinematics.loop import Loop

Jet = list[Plane]
"""A quantity (...) and its first three derivatives over the crank angle."""

_AFTER = 1e-3
"""rad. An angle past the start, at which the sign of the assembly is that of the start, or follows it."""

_SAME = 1e-6
"""By how much two directions may differ that are one and the same: far above rounding, far below a turn."""


def close_through(bar: FourBar, phi: ArrayLike, sense: float = 1.0) -> Loop:
    """Close the loop at crank angles φ (...), rad, of a crank that began at φ = 0 in the bar's branch.

    Where it begins in a change point, the branch is that of the first move in its ``sense``.
    """
    phi = np.asarray(phi, dtype=float)
    start = np.asarray(_AFTER * math.copysign(1.0, sense))
    kept = bar.branch * math.copysign(1.0, _side(bar, start, 1.0))
    ahead = np.exp(1j * bar.ground_angle)
    crank = bar.crank * np.exp(1j * (phi - bar.ground_angle))
    coupler = _coupler(bar, phi, kept)
    open_: Jet = [crank - bar.ground, 1j * crank, -crank, -1j * crank]
    follower: Jet = [
        np.asarray((one + bar.coupler * two) / bar.follower, dtype=np.complex128)
        for one, two in zip(open_, coupler, strict=True)
    ]
    joint_a = np.asarray(crank * ahead, dtype=np.complex128)
    rates = [_rates([ahead * value for value in jet]) for jet in (coupler, follower)]
    return Loop(phi, joint_a, joint_a + bar.coupler * rates[0].direction, *rates)


def turns_to_close(bar: FourBar) -> int:
    """Turns of the crank after which the linkage stands as at the start: 2 where each changes the branch.

    >>> turns_to_close(FourBar(40, 80, 70, 110)), turns_to_close(FourBar(50, 90, 50, 90))
    (2, 1)
    """
    one, two = (_coupler(bar, np.asarray(_AFTER + turn), 1.0)[0] for turn in (0.0, math.tau))
    return 1 if abs(one - two) < _SAME else 2


def _side(bar: FourBar, phi: Array, kept: float) -> float:
    """On which side of the line from A to B0 the joint B is: above 0, left."""
    to_ground = bar.ground - bar.crank * np.exp(1j * (phi - bar.ground_angle))
    return float((np.conj(to_ground) * _coupler(bar, phi, kept)[0]).imag)


def _coupler(bar: FourBar, phi: Array, kept: float) -> Jet:
    """The coupler's direction, seen from the ground line."""
    a, c, b, f = bar.lengths
    x = phi - bar.ground_angle
    cos, sin = _circle(np.cos(x), np.sin(x), 1.0)
    half_cos, half_sin = _circle(np.cos(x / 2), np.sin(x / 2), 0.5)
    slack = CHANGE_POINT * sum(bar.lengths)
    far, near = abs(a + f - b - c) <= slack, abs(abs(f - a) - abs(b - c)) <= slack
    square = _plus(_times(-2 * a * f, cos), a * a + f * f)
    reach = 2 * math.sqrt(a * f)
    outer = _times(reach, half_cos) if far else _root(_plus(_times(-1, square), (b + c) ** 2))
    if near and abs(a - f) <= slack:
        ahead: Jet = [-1j * (one + 1j * two) for one, two in zip(half_cos, half_sin, strict=True)]
        both: Jet = [2 * a * one + 1j * kept * two for one, two in zip(half_sin, outer, strict=True)]
        return _times(1 / (2 * c), _product(ahead, both))
    inner = _times(reach, half_sin) if near else _root(_plus(square, -((b - c) ** 2)))
    across = _product(outer, inner)
    d = [-a * (one + 1j * two) for one, two in zip(cos, sin, strict=True)]
    d[0] = d[0] + f
    along = _plus(square, (c - b) * (c + b))
    both = [one + 1j * kept * two for one, two in zip(along, across, strict=True)]
    return _times(1 / (2 * c), _product(_product(d, both), _inverse(square)))


def _circle(cos: Array, sin: Array, rate: float) -> tuple[Jet, Jet]:
    """Cosine and sine of an angle that goes at a constant rate."""
    one, two, three = rate, rate**2, rate**3
    cosine = [cos, -one * sin, -two * cos, three * sin]
    sine = [sin, one * cos, -two * sin, -three * cos]
    return [np.asarray(v, np.complex128) for v in cosine], [np.asarray(v, np.complex128) for v in sine]


def _plus(jet: Jet, number: float) -> Jet:
    return [jet[0] + number, *jet[1:]]


def _times(number: float, jet: Jet) -> Jet:
    return [number * value for value in jet]


def _product(one: Jet, two: Jet) -> Jet:
    """Leibniz' rule."""
    return [
        np.asarray(sum(math.comb(n, k) * one[k] * two[n - k] for k in range(n + 1)), dtype=np.complex128)
        for n in range(4)
    ]


def _inverse(jet: Jet) -> Jet:
    found = [1 / jet[0]]
    for n in range(1, 4):
        rest = sum(math.comb(n, k) * jet[k] * found[n - k] for k in range(1, n + 1))
        found.append(np.asarray(-found[0] * rest, dtype=np.complex128))
    return found


def _root(jet: Jet) -> Jet:
    y = np.sqrt(jet[0])
    first = jet[1] / (2 * y)
    second = (jet[2] - 2 * first**2) / (2 * y)
    return [y, first, second, (jet[3] - 6 * first * second) / (2 * y)]


def _rates(jet: Sequence[Plane]) -> Rates:
    """Direction and rates of the angle of a unit vector."""
    turned = [(value * np.conj(jet[0])).imag for value in jet]
    return Rates(jet[0] / np.abs(jet[0]), turned[1], turned[2], turned[3] + turned[1] ** 3)
