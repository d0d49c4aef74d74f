"""Levenberg and Marquardt's method for a linkage on a path, with its limits; compiled.

The limits are kept by an augmented Lagrangian that is a least squares itself: a limit g ≤ 0 of weight w and
multiplier m adds the residual max(0, w g + m), and m becomes that residual when the descent has come to rest
(Powell, Hestenes and Rockafellar). Unlike a penalty alone it ends on the limit, not a little beyond it.

Crank angles that are free are eliminated point by point: each touches one point, and leaves the normal
equations by its Schur complement. What is minimised is then the distance from the path along its normal, in
the order of the points: after every step the angles become the nearest ones that go one way (pool adjacent
violators). Points that have to share an angle to keep their order are turned together.
"""

import math

import numpy as np

from mechwright import Array
from mechwright.mechanics.compiled import compiled
from mechwright.mechanics.planar import Plane
from mechwright.mechanics.tracing.order import TURN
from mechwright_four_bar.synthesis.paths.kernels import (
    LINEAR,
    SHAPE,
    directions,
    lengths,
    linear,
    row,
    square,
)
from mechwright_four_bar.synthesis.paths.limits import COUNT, broken

FIRST_DAMPING, MOST_DAMPING = 1e-2, 1e12
"""Marquardt's λ at the start, and where a start has given up."""

STILL, STILL_STEPS = 1e-7, 12
"""A start whose squares have fallen by less than this share over so many good steps has arrived."""

OUTER, KEPT = 40, 1e-11
"""Most changes of the multipliers, and by how much a limit may be broken at the end."""


MOST_WEIGHT = 1e4
"""Most by which the weight grows where changes of the multipliers alone do not bring a limit down."""


@compiled
def screen(targets: Plane, shapes: Array, angles: Array, branch: int, limits: Array) -> Array:
    """Least sums of squares (m,) over X, s and q for shapes (m, 3) and crank angles (m, n).

    To each the squares of the limits are added that the linkage breaks.
    """
    costs = np.empty(len(shapes))
    slopes, values = np.empty((COUNT, SHAPE + LINEAR)), np.empty(COUNT)
    for m in range(len(shapes)):
        solution, cost = linear(targets, shapes[m], angles[m], branch)
        broken(solution, limits, values, slopes, False)
        for value in values:
            if value > 0:
                cost += value * value
        costs[m] = cost
    return costs


@compiled
def squares(targets: Plane, solution: Array, phi: Array, branch: int) -> float:
    """Sum of the squared distances of the points (n,)."""
    a, b, c, _ = lengths(solution)
    x, s = complex(solution[3], solution[4]), complex(solution[5], solution[6])
    q = complex(solution[7], solution[8])
    total = 0.0
    for j in range(targets.size):
        u, v, _ = directions(a, b, c, branch, phi[j])
        total += square(x + s * a * u + q * v - targets[j])
    return total


@compiled
def _penalty(values: Array, weight: float, multipliers: Array) -> float:
    total = 0.0
    for k in range(COUNT):
        r = weight * values[k] + multipliers[k]
        if r > 0:
            total += r * r
    return total


@compiled
def _solve(matrix: Array, right: Array) -> bool:
    """Solve a symmetric positive definite system in place by Cholesky; False where it is not."""
    n = len(right)
    for i in range(n):
        for j in range(i + 1):
            value = matrix[i, j]
            for k in range(j):
                value -= matrix[i, k] * matrix[j, k]
            if i == j:
                if not value > 0:
                    return False
                matrix[i, i] = math.sqrt(value)
            else:
                matrix[i, j] = value / matrix[j, j]
    for i in range(n):
        for k in range(i):
            right[i] -= matrix[i, k] * right[k]
        right[i] /= matrix[i, i]
    for i in range(n - 1, -1, -1):
        for k in range(i + 1, n):
            right[i] -= matrix[k, i] * right[k]
        right[i] /= matrix[i, i]
    return True


@compiled
def _normal_equations(
    rows: Plane, errors: Plane, values: Array, slopes: Array, weight: float, multipliers: Array, size: int,
    normal: Array, right: Array,
) -> None:  # fmt: skip
    """Normal equations of what all points share, and of the limits, into ``normal`` and ``right``."""
    normal[:] = 0.0
    right[:] = 0.0
    for j in range(len(errors)):
        for i in range(size):
            r = rows[j, i]
            right[i] -= r.real * errors[j].real + r.imag * errors[j].imag
            for k in range(i + 1):
                w = rows[j, k]
                normal[i, k] += r.real * w.real + r.imag * w.imag
    for n in range(COUNT):
        value = weight * values[n] + multipliers[n]
        if value > 0:
            for i in range(SHAPE + LINEAR):
                slope = weight * slopes[n, i]
                right[i] -= slope * value
                for k in range(i + 1):
                    normal[i, k] += slope * weight * slopes[n, k]


@compiled
def _eliminate(
    rows: Plane, errors: Plane, damping: float, group: Array, own: Array, coupling: Array, pull: Array,
    normal: Array, right: Array,
) -> None:  # fmt: skip
    """Take the crank angles out of the normal equations, those of one group together.

    ``group`` (n,) names the first point of each one's group; ``own``, ``pull`` and ``coupling`` of that
    point get the diagonal, the right side and the row of its angle.
    """
    size = SHAPE + LINEAR
    own[:], pull[:], coupling[:] = 0.0, 0.0, 0.0
    for j in range(len(errors)):
        r, g = rows[j, 9], int(group[j])
        own[g] += square(r) * (1 + damping) + 1e-300
        pull[g] -= r.real * errors[j].real + r.imag * errors[j].imag
        for i in range(size):
            w = rows[j, i]
            coupling[g, i] += r.real * w.real + r.imag * w.imag
    for j in range(len(errors)):
        if int(group[j]) == j:
            for i in range(size):
                share = coupling[j, i] / own[j]
                right[i] -= share * pull[j]
                for k in range(i + 1):
                    normal[i, k] -= share * coupling[j, k]


@compiled
def _turn_back(
    change: Array, group: Array, own: Array, coupling: Array, pull: Array, phi: Array, turned: Array
) -> None:
    """The crank angles that go with a change of the shared unknowns, into ``turned``."""
    for j in range(len(phi)):
        g = int(group[j])
        step = pull[g]
        for i in range(SHAPE + LINEAR):
            step -= coupling[g, i] * change[i]
        turned[j] = phi[j] + step / own[g]


@compiled
def in_order(phi: Array, way: int, slack: float, group: Array) -> bool:
    """Make crank angles (n,) the nearest that go one way, within a turn; whether some are held together.

    ``slack`` is the angle by which a point may lie before the one before it. ``group`` gets the first point
    of those that moved as one.
    """
    n = phi.size
    mean, count, first = np.empty(n), np.empty(n), np.empty(n, np.int64)
    last = -1
    for j in range(n):
        last += 1
        mean[last], count[last], first[last] = way * phi[j] + slack * j, 1.0, j
        while last > 0 and mean[last] < mean[last - 1]:
            total = count[last] + count[last - 1]
            mean[last - 1] = (mean[last] * count[last] + mean[last - 1] * count[last - 1]) / total
            count[last - 1] = total
            last -= 1
    held = False
    for k in range(last + 1):
        for j in range(first[k], first[k] + int(count[k])):
            group[j] = first[k]
            held = held or group[j] != j
            phi[j] = way * min(mean[k] - slack * j, way * phi[0] + TURN)
    return held


@compiled
def polish(
    targets: Plane, solution: Array, phi: Array, branch: int, way: int, slack: float, limits: Array,
    weight: float, multipliers: Array, steps: int, arrived: float, still: float,
) -> float:  # fmt: skip
    """Take steps on ``solution`` (9,) and ``phi`` (n,), both changed; gives the augmented squares.

    ``way`` is the sense of a crank whose angles are free, +1 or -1; 0 for angles that are given but for their
    start, and turn together. It ends when the squares fall by less than the share ``still`` in some good
    steps.
    """
    n, timed = targets.size, way == 0
    size = SHAPE + LINEAR + (1 if timed else 0)
    rows, errors = np.empty((n, 10), np.complex128), np.empty(n, np.complex128)
    normal, right = np.empty((size, size)), np.empty(size)
    damped, change = np.empty((size, size)), np.empty(size)
    own, coupling, pull = np.empty(n), np.empty((n, 9)), np.empty(n)
    values, slopes = np.empty(COUNT), np.zeros((COUNT, SHAPE + LINEAR))
    each, group, grouped = np.arange(n).astype(np.float64), np.empty(n), np.empty(n)
    trial, turned = solution.copy(), phi.copy()
    held = False
    if not timed:
        held = in_order(phi, way, slack, group)
    broken(solution, limits, values, slopes, True)
    cost = squares(targets, solution, phi, branch) + _penalty(values, weight, multipliers)
    damping, since, mark = FIRST_DAMPING, 0, cost
    for _ in range(steps):
        a, b, c, slope = lengths(solution)
        for j in range(n):
            errors[j] = row(solution, a, b, c, slope, branch, phi[j], rows[j]) - targets[j]
        broken(solution, limits, values, slopes, True)
        _normal_equations(rows, errors, values, slopes, weight, multipliers, size, normal, right)
        improved = False
        while damping < MOST_DAMPING:
            for attempt in range(2 if held else 1):
                damped[:], change[:] = normal, right
                for i in range(size):
                    damped[i, i] += damping * normal[i, i] + 1e-300
                if not timed:
                    _eliminate(
                        rows, errors, damping, group if attempt else each, own, coupling, pull, damped, change
                    )
                if not _solve(damped, change):
                    continue
                for i in range(9):
                    trial[i] = solution[i] + change[i]
                still_held = False
                if timed:
                    turned[:] = phi + change[9]
                else:
                    _turn_back(change, group if attempt else each, own, coupling, pull, phi, turned)
                    still_held = in_order(turned, way, slack, grouped)
                broken(trial, limits, values, slopes, False)
                new = squares(targets, trial, turned, branch) + _penalty(values, weight, multipliers)
                if new < cost:
                    solution[:], phi[:], group[:] = trial, turned, grouped
                    cost, improved, held = new, True, still_held
                    break
            if improved:
                damping = max(damping / 5, 1e-14)
                break
            damping *= 4
        if not improved or cost <= arrived:
            break
        since += 1
        if since == STILL_STEPS:
            if cost > mark * (1 - still):
                break
            since, mark = 0, cost
    return cost


@compiled
def settle(
    targets: Plane, solution: Array, phi: Array, branch: int, way: int, slack: float, limits: Array,
    weight: float, multipliers: Array, steps: int, arrived: float,
) -> float:  # fmt: skip
    """Descend until the limits are kept; ``multipliers`` (24,) begin at 0.

    The result is by how much a limit is still broken at the worst, in its own unit.
    """
    values, slopes = np.empty(COUNT), np.empty((COUNT, SHAPE + LINEAR))
    before, worst, first = math.inf, math.inf, weight
    for _ in range(OUTER):
        polish(targets, solution, phi, branch, way, slack, limits, weight, multipliers, steps, arrived, STILL)
        broken(solution, limits, values, slopes, False)
        worst, moved = 0.0, 0.0
        for k in range(COUNT):
            worst = max(worst, values[k])
            new = max(0.0, weight * values[k] + multipliers[k])
            moved = max(moved, abs(new - multipliers[k]))
            multipliers[k] = new
        if worst <= KEPT and moved <= KEPT * weight:
            break
        if worst > before / 4 and worst > KEPT and weight < MOST_WEIGHT * first:
            weight *= 3
            multipliers /= 3
        before = worst
    return worst
