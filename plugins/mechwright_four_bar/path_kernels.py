"""Compiled least squares for the path of a coupler point.

With the ground line as unit the coupler point at the crank angle φ from it is

    P = X + s a e^{iφ} + q e^{iσ},   s = f e^{iθ},   q = s (coupler point in its own frame),

X being A0. X, s and q are complex and enter linearly; three shape unknowns and the crank angles do not.
The shape is ln a, x = ln((b + c)/(1 + a) - 1) and y = artanh((b - c)/abs(1 - a)): any values of them give
a linkage whose crank turns fully, so that all positions lie on one branch and in one circuit.

Angles are (n,) rad from the ground line. A solution is (9,) shape, X, s, q, each complex as two numbers.
"""

import math

import numpy as np

from mechwright import Array
from mechwright.mechanics.compiled import compiled
from mechwright.mechanics.planar import Plane

SHAPE, LINEAR = 3, 6
"""Real unknowns of the shape, and of X, s and q."""

CLOSED = 1e-300
"""Least squared room of the dyad, so that a toggle on the rim of what is possible divides by no zero."""

FIRST_DAMPING, MOST_DAMPING = 1e-2, 1e12
"""Marquardt's λ at the start, and where a start has given up."""

STILL, STILL_STEPS = 1e-6, 12
"""A start whose squares have fallen by less than this share over so many good steps has arrived."""


@compiled
def _square(z: complex) -> float:
    """The square of the absolute value, without a root."""
    return z.real * z.real + z.imag * z.imag


@compiled
def lengths(z: Array) -> tuple[float, float, float, Array]:
    """Crank, follower, coupler over the ground, and the derivatives of the last two by the shape (2, 3)."""
    a = math.exp(z[0])
    excess, stretch = math.exp(z[1]), math.tanh(z[2])
    total = (1 + a) * (1 + excess)
    difference = abs(1 - a) * stretch
    slope = np.empty((2, 3))
    sign = 1.0 if a > 1 else -1.0
    total_by = (a * (1 + excess), (1 + a) * excess, 0.0)
    difference_by = (sign * a * stretch, 0.0, abs(1 - a) * (1 - stretch * stretch))
    for i in range(3):
        slope[0, i] = (total_by[i] + difference_by[i]) / 2
        slope[1, i] = (total_by[i] - difference_by[i]) / 2
    return a, (total + difference) / 2, (total - difference) / 2, slope


@compiled
def directions(a: float, b: float, c: float, branch: int, phi: float) -> tuple[complex, complex, complex]:
    """exp(iφ), exp(iσ), exp(iψ) at one crank angle."""
    u = complex(math.cos(phi), math.sin(phi))
    d = 1 - a * u
    square = d.real * d.real + d.imag * d.imag
    distance = math.sqrt(square)
    k = (c - b) * (c + b) + square
    room = (c + distance + b) * (c + distance - b) * (b + c - distance) * (b - c + distance)
    s = d * complex(k, branch * math.sqrt(max(room, CLOSED))) * (0.5 / (c * square))
    return u, s, (c * s - d) * (1 / b)


@compiled
def screen(targets: Plane, shapes: Array, angles: Array, branch: int) -> Array:
    """Least sums of squares (m,) over X, s and q for shapes (m, 3) and crank angles (m, n)."""
    n = targets.size
    mean = targets.sum() * (1 / n)
    costs = np.empty(len(shapes))
    for m in range(len(shapes)):
        a, b, c, _ = lengths(shapes[m])
        su, ss = 0j, 0j
        uu, vv, uv, ut, vt, tt = 0.0, 0.0, 0j, 0j, 0j, 0.0
        for j in range(n):
            u, s, _ = directions(a, b, c, branch, angles[m, j])
            t = targets[j] - mean
            su += u
            ss += s
            uu += 1.0
            vv += _square(s)
            uv += u.conjugate() * s
            ut += u.conjugate() * t
            vt += s.conjugate() * t
            tt += _square(t)
        # The normal equations after X, with Gram's determinant of the two columns.
        uu -= _square(su) / n
        vv -= _square(ss) / n
        uv -= su.conjugate() * ss * (1 / n)
        det = uu * vv - _square(uv)
        if not det > 1e-12 * uu * vv:
            costs[m] = np.inf
            continue
        x = (vv * ut - uv * vt) * (1 / det)
        y = (uu * vt - uv.conjugate() * ut) * (1 / det)
        costs[m] = max(0.0, tt - (ut.conjugate() * x + vt.conjugate() * y).real)
    return costs


@compiled
def linear(targets: Plane, z: Array, phi: Array, branch: int) -> Array:
    """The solution (9,) of a shape (3,) and crank angles (n,): shape, X, s, q."""
    n = targets.size
    a, b, c, _ = lengths(z)
    columns = np.empty((n, 2), np.complex128)
    for j in range(n):
        u, s, _ = directions(a, b, c, branch, phi[j])
        columns[j, 0], columns[j, 1] = a * u, s
    share = 1 / n
    mean_t = targets.sum() * share
    mean_u, mean_s = columns[:, 0].sum() * share, columns[:, 1].sum() * share
    uu, vv, uv, ut, vt = 0.0, 0.0, 0j, 0j, 0j
    for j in range(n):
        u, s, t = columns[j, 0] - mean_u, columns[j, 1] - mean_s, targets[j] - mean_t
        uu += _square(u)
        vv += _square(s)
        uv += u.conjugate() * s
        ut += u.conjugate() * t
        vt += s.conjugate() * t
    det = uu * vv - _square(uv)
    x, y = 1 + 0j, 0j
    if det > 0:
        x, y = (vv * ut - uv * vt) * (1 / det), (uu * vt - uv.conjugate() * ut) * (1 / det)
    x0 = mean_t - x * mean_u - y * mean_s
    solution = np.empty(SHAPE + LINEAR)
    solution[:SHAPE] = z
    for i, value in enumerate((x0, x, y)):
        solution[SHAPE + 2 * i], solution[SHAPE + 2 * i + 1] = value.real, value.imag
    return solution


@compiled
def _row(
    solution: Array, a: float, b: float, c: float, slope: Array, branch: int, phi: float, out: Plane
) -> complex:
    """Coupler point at one crank angle; its derivatives by solution and, last, angle go into ``out``."""
    s = complex(solution[5], solution[6])
    q = complex(solution[7], solution[8])
    u, v, p = directions(a, b, c, branch, phi)
    lever = 1.0 / (v * p.conjugate()).imag
    by_a = lever * (u * p.conjugate()).real / c
    by_c = lever * (v * p.conjugate()).real / c
    by_b = -lever / c
    by_phi = lever * (1j * a * u * p.conjugate()).real / c
    turn = 1j * q * v
    for i in range(3):
        out[i] = turn * (by_b * slope[0, i] + by_c * slope[1, i])
    out[0] += a * (s * u + turn * by_a)
    out[3], out[4] = 1.0, 1j
    out[5], out[6] = a * u, 1j * a * u
    out[7], out[8] = v, 1j * v
    out[9] = 1j * s * a * u + turn * by_phi
    return complex(solution[3], solution[4]) + s * a * u + q * v


@compiled
def _cost(targets: Plane, solution: Array, phi: Array, branch: int) -> float:
    a, b, c, _ = lengths(solution)
    x, s = complex(solution[3], solution[4]), complex(solution[5], solution[6])
    q = complex(solution[7], solution[8])
    total = 0.0
    for j in range(targets.size):
        u, v, _ = directions(a, b, c, branch, phi[j])
        error = x + s * a * u + q * v - targets[j]
        total += _square(error)
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
    rows: Plane, errors: Plane, damping: float, size: int, normal: Array, right: Array
) -> None:
    """Damped normal equations of the unknowns that all points share, into ``normal`` and ``right``."""
    normal[:] = 0.0
    right[:] = 0.0
    for j in range(len(errors)):
        for i in range(size):
            r = rows[j, i]
            right[i] -= r.real * errors[j].real + r.imag * errors[j].imag
            for k in range(i + 1):
                w = rows[j, k]
                normal[i, k] += r.real * w.real + r.imag * w.imag
    for i in range(size):
        normal[i, i] += damping * normal[i, i] + 1e-300


@compiled
def _eliminate_angles(
    rows: Plane,
    errors: Plane,
    damping: float,
    size: int,
    own: Array,
    coupling: Array,
    pull: Array,
    normal: Array,
    right: Array,
) -> None:
    """Take each point's own crank angle out of the normal equations, by its Schur complement.

    ``own``, ``pull`` and ``coupling`` get the diagonal, the right side and the row of each angle.
    """
    for j in range(len(errors)):
        r = rows[j, 9]
        own[j] = (r.real * r.real + r.imag * r.imag) * (1 + damping) + 1e-300
        pull[j] = -(r.real * errors[j].real + r.imag * errors[j].imag)
        for i in range(size):
            w = rows[j, i]
            coupling[j, i] = r.real * w.real + r.imag * w.imag
        for i in range(size):
            share = coupling[j, i] / own[j]
            right[i] -= share * pull[j]
            for k in range(i + 1):
                normal[i, k] -= share * coupling[j, k]


@compiled
def _turn_back(
    change: Array, size: int, own: Array, coupling: Array, pull: Array, phi: Array, turned: Array
) -> None:
    """The crank angles that go with a change of the shared unknowns, into ``turned``."""
    for j in range(len(phi)):
        step = pull[j]
        for i in range(size):
            step -= coupling[j, i] * change[i]
        turned[j] = phi[j] + step / own[j]


@compiled
def polish(
    targets: Plane, solution: Array, phi: Array, branch: int, timed: bool, steps: int, arrived: float
) -> float:
    """Levenberg and Marquardt's steps on ``solution`` (9,) and ``phi`` (n,), both changed.

    Timed, all crank angles turn together. Else each turns by itself: it touches one point only, and leaves
    the normal equations by its Schur complement. The result is the sum of squares.
    """
    n = targets.size
    size = SHAPE + LINEAR + (1 if timed else 0)
    rows = np.empty((n, 10), np.complex128)
    errors = np.empty(n, np.complex128)
    normal, right = np.empty((size, size)), np.empty(size)
    own, coupling, pull = np.empty(n), np.empty((n, 9)), np.empty(n)
    trial, turned = solution.copy(), phi.copy()
    cost = _cost(targets, solution, phi, branch)
    damping, since, mark = FIRST_DAMPING, 0, cost
    for _ in range(steps):
        a, b, c, slope = lengths(solution)
        for j in range(n):
            errors[j] = _row(solution, a, b, c, slope, branch, phi[j], rows[j]) - targets[j]
        improved = False
        while damping < MOST_DAMPING:
            _normal_equations(rows, errors, damping, size, normal, right)
            if not timed:
                _eliminate_angles(rows, errors, damping, size, own, coupling, pull, normal, right)
            if _solve(normal, right):
                for i in range(9):
                    trial[i] = solution[i] + right[i]
                if timed:
                    turned[:] = phi + right[9]
                else:
                    _turn_back(right, size, own, coupling, pull, phi, turned)
                new = _cost(targets, trial, turned, branch)
                if new < cost:
                    solution[:], phi[:] = trial, turned
                    cost, damping, improved = new, max(damping / 5, 1e-14), True
                    break
            damping *= 4
        if not improved or cost <= arrived:
            break
        since += 1
        if since == STILL_STEPS:
            if cost > mark * (1 - STILL):
                break
            since, mark = 0, cost
    return cost
