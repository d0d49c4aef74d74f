"""The equations of nine points, compiled: values, slopes by the unknowns, rates along a way of the points.

Plane vectors are pairs of isotropic coordinates, x + i y and x - i y, which for complex places are
independent (Wampler, Morgan and Sommese 1992). The first point is the origin, the others lie at δ from it. A
dyad has its joint at x and its pivot at a, the other one its joint at y and its pivot at b; the unknowns are

    z = (x, x̄, a, ā, y, ȳ, b, b̄)

With T the turn of the coupler from the first point to another, a dyad of constant length is

    A T + B / T + C = 0,  A = x (δ̄ - ā),  B = x̄ (δ - a),  C = δ δ̄ - δ ā - δ̄ a + x ā + a x̄

and of both dyads T is eliminated: with N₁ = B₁ C₂ - B₂ C₁ = T D, N₂ = C₁ A₂ - C₂ A₁ = D / T and
D = A₁ B₂ - A₂ B₁, each of the eight points asks for N₁ N₂ = D².
"""

import numpy as np

from mechwright.mechanics.compiled import compiled
from mechwright.mechanics.planar import Plane

POINTS = 8
"""Points besides the first one, and as many unknowns."""


@compiled
def evaluate(z: Plane, points: Plane, way: Plane, values: Plane, slopes: Plane, along: Plane) -> None:
    """The equations at unknowns ``z``.

    Parameters
    ----------
    z
        (8,) unknowns.
    points
        (2, 8) δ and δ̄ of the points after the first.
    way
        (2, 8) their rates.
    values
        (8,) N₁ N₂ - D² of each point is written here.
    slopes
        (8, 8) its slopes by the unknowns.
    along
        (8,) its rate where the points move and the unknowns stand.
    """
    x, x_, a, a_, y, y_, b, b_ = z
    for j in range(8):
        d, d_ = points[0, j], points[1, j]
        to_a, to_a_, to_b, to_b_ = d - a, d_ - a_, d - b, d_ - b_
        a1, b1 = x * to_a_, x_ * to_a
        c1 = d * to_a_ - d_ * a + x * a_ + a * x_
        a2, b2 = y * to_b_, y_ * to_b
        c2 = d * to_b_ - d_ * b + y * b_ + b * y_
        n1, n2, det = b1 * c2 - b2 * c1, c1 * a2 - c2 * a1, a1 * b2 - a2 * b1
        values[j] = n1 * n2 - det * det
        two = 2 * det
        by_a1, by_b1, by_c1 = -n1 * c2 - two * b2, n2 * c2 + two * a2, a2 * n1 - b2 * n2
        by_a2, by_b2, by_c2 = n1 * c1 + two * b1, -n2 * c1 - two * a1, b1 * n2 - a1 * n1
        slopes[j, 0] = by_a1 * to_a_ + by_c1 * a_
        slopes[j, 1] = by_b1 * to_a + by_c1 * a
        slopes[j, 2] = -by_b1 * x_ + by_c1 * (x_ - d_)
        slopes[j, 3] = -by_a1 * x + by_c1 * (x - d)
        slopes[j, 4] = by_a2 * to_b_ + by_c2 * b_
        slopes[j, 5] = by_b2 * to_b + by_c2 * b
        slopes[j, 6] = -by_b2 * y_ + by_c2 * (y_ - d_)
        slopes[j, 7] = -by_a2 * y + by_c2 * (y - d)
        along[j] = (by_b1 * x_ + by_c1 * to_a_ + by_b2 * y_ + by_c2 * to_b_) * way[0, j] + (
            by_a1 * x + by_c1 * to_a + by_a2 * y + by_c2 * to_b
        ) * way[1, j]


@compiled
def solve(slopes: Plane, right: Plane) -> bool:
    """Solve slopes · s = right in place by elimination; ``right`` (8,) becomes s. False where it is singular.

    Rows are first scaled by their largest entry, which makes the choice of pivots fair; ``slopes`` (8, 8) is
    used up.
    """
    for i in range(8):
        largest = 0.0
        for k in range(8):
            size = abs(slopes[i, k].real) + abs(slopes[i, k].imag)
            largest = max(largest, size)
        if not (0.0 < largest < np.inf):
            return False
        scale = 1.0 / largest
        for k in range(8):
            slopes[i, k] *= scale
        right[i] *= scale
    for i in range(8):
        best, row = -1.0, i
        for k in range(i, 8):
            size = abs(slopes[k, i].real) + abs(slopes[k, i].imag)
            if size > best:
                best, row = size, k
        if not best > 0.0:
            return False
        if row != i:
            for k in range(i, 8):
                slopes[i, k], slopes[row, k] = slopes[row, k], slopes[i, k]
            right[i], right[row] = right[row], right[i]
        pivot = slopes[i, i]
        inverse = pivot.conjugate() / (pivot.real * pivot.real + pivot.imag * pivot.imag)
        slopes[i, i] = inverse
        for k in range(i + 1, 8):
            factor = slopes[k, i] * inverse
            for m in range(i + 1, 8):
                slopes[k, m] -= factor * slopes[i, m]
            right[k] -= factor * right[i]
    for i in range(7, -1, -1):
        total = right[i]
        for k in range(i + 1, 8):
            total -= slopes[i, k] * right[k]
        right[i] = total * slopes[i, i]
    return True
