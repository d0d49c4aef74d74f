"""Solutions that are proven, in ball arithmetic.

Every number is a ball, a midpoint with a radius that holds the true value (Arb). A box about a solution is
certified by Krawczyk's operator: where

    K = z - Y F(z) + (1 - Y J(X)) (X - z)

lies inside of the box X and the second term contracts, X holds one solution, one alone, and K holds it too.
"""

import math
from collections.abc import Callable, Iterable, Sequence

import numpy as np
from flint import acb, acb_mat, arb

from mechwright.mechanics.continuation.system import Balls
from mechwright.mechanics.planar import Plane

BITS = 160
"""Working precision: some 48 digits. A solution 1e5 sizes away takes half of them."""

BOX = 1e-22
"""Half the side of a box, as a share of an unknown or of 1."""

SETTLED = 1e-32
"""Last step of Newton before a certificate, in the same measure."""

STEPS = 12
"""Most steps of Newton before one."""

At = Callable[[Balls], tuple[Balls, acb_mat]]
"""Unknowns (m,) to the equations' values (m,) and slopes."""


def balls(numbers: Plane | Balls) -> Balls:
    """Doubles of any shape as exact balls; balls as they are."""
    flat = [one if isinstance(one, acb) else acb(one.real, one.imag) for one in numbers.ravel().tolist()]
    return np.array(flat, dtype=object).reshape(numbers.shape)


def middle(values: Iterable[acb]) -> Balls:
    """Balls without their radii."""
    return np.array([one.mid() for one in values], dtype=object)


def turned(degrees: float) -> acb:
    """exp(i φ) of an angle that stands for the decimal number that it is written as."""
    half_turns = arb(repr(float(degrees))) / 180
    return acb(half_turns.cos_pi(), half_turns.sin_pi())


def place(point: tuple[float, float]) -> acb:
    """X + i y of decimal numbers."""
    x, y = point
    return acb(arb(repr(float(x))), arb(repr(float(y))))


def first_pair_conjugate(unknowns: Balls) -> Balls:
    """The conjugate of unknowns whose first two are isotropic coordinates and whose others are numbers."""
    first, second, *others = (one.conjugate() for one in unknowns)
    return np.array([second, first, *others], dtype=object)


def column(values: Balls) -> acb_mat:
    """Balls (m,) as a matrix of one column."""
    return acb_mat(len(values), 1, values.tolist())


def newton_in_balls(z: Balls, at: At) -> tuple[Balls, float]:
    """The next approximation and the size of the step, infinite where there is none."""
    values, slopes = at(z)
    try:
        step = np.array(slopes.solve(column(values)).entries(), dtype=object)
    except ZeroDivisionError:
        return z, math.inf
    return middle(z - step), _size(step, z)


def _size(step: Balls, z: Balls) -> float:
    shares = [float(abs(complex(a)) / max(1.0, abs(complex(b)))) for a, b in zip(step, z, strict=True)]
    return max(shares) if all(math.isfinite(share) for share in shares) else math.inf


def refined(z: Balls, at: At) -> Balls | None:
    """The solution near ``z`` (m,) to :data:`SETTLED`; None where Newton's steps do not lead to one."""
    for _ in range(STEPS):
        z, step = newton_in_balls(z, at)
        if step < SETTLED:
            return z
        if not step < 1:
            return None
    return None


def krawczyk(z: Balls, at: At) -> tuple[Balls, Balls] | None:
    """The box (m,) about ``z`` (m,) and its image, which holds the one solution in it; None without proof."""
    count = len(z)
    radii = [BOX * max(1.0, abs(complex(one))) for one in z]
    about = np.array([acb(arb(0, radius), arb(0, radius)) for radius in radii], dtype=object)
    values, slopes = at(z)
    box = z + about
    over = at(box)[1]
    try:
        inverse = slopes.mid().inv().mid()
    except ZeroDivisionError:
        return None
    one = acb_mat(count, count, [acb(i == k) for i in range(count) for k in range(count)])
    rest = one - inverse * over
    if not _contracts(rest, radii):
        return None
    moved = column(z) - inverse * column(values) + rest * column(about)
    image = np.array(moved.entries(), dtype=object)
    for ball, centre, radius in zip(image, z, radii, strict=True):
        off = ball - centre
        if not (abs(off.real) < radius and abs(off.imag) < radius):
            return None
    return box, image


def _contracts(rest: acb_mat, radii: Sequence[float]) -> bool:
    """Whether √2 ‖1 - Y J(X)‖ is below 1, each unknown measured by the side of its box: then one solution."""
    rows = rest.table()
    return all(
        sum((abs(entry) * side for entry, side in zip(row, radii, strict=True)), arb(0)) * arb(2).sqrt()
        < radius
        for row, radius in zip(rows, radii, strict=True)
    )


def is_own(box: Balls, image: Balls, turned: Balls) -> bool | None:
    """Whether a solution is its own conjugate, None where that is not decided.

    Parameters
    ----------
    box, image
        Its certificate.
    turned
        (m,) the conjugate of ``image``, which holds a solution too.
    """
    if all(outer.contains(inner) for outer, inner in zip(box, turned, strict=True)):
        return True
    if not all(one.overlaps(other) for one, other in zip(image, turned, strict=True)):
        return False
    return None
