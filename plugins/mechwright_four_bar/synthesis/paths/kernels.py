"""Compiled kinematics of a coupler point, and its linear least squares.

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


@compiled
def square(z: complex) -> float:
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
def linear(targets: Plane, z: Array, phi: Array, branch: int) -> tuple[Array, float]:
    """The solution (9,) of a shape (3,) and crank angles (n,), shape, X, s, q; and its sum of squares."""
    n = targets.size
    a, b, c, _ = lengths(z)
    columns = np.empty((n, 2), np.complex128)
    for j in range(n):
        u, s, _ = directions(a, b, c, branch, phi[j])
        columns[j, 0], columns[j, 1] = a * u, s
    share = 1 / n
    mean_t = targets.sum() * share
    mean_u, mean_s = columns[:, 0].sum() * share, columns[:, 1].sum() * share
    uu, vv, uv, ut, vt, tt = 0.0, 0.0, 0j, 0j, 0j, 0.0
    for j in range(n):
        u, s, t = columns[j, 0] - mean_u, columns[j, 1] - mean_s, targets[j] - mean_t
        uu += square(u)
        vv += square(s)
        uv += u.conjugate() * s
        ut += u.conjugate() * t
        vt += s.conjugate() * t
        tt += square(t)
    det = uu * vv - square(uv)
    x, y = 1 + 0j, 0j
    if det > 1e-12 * uu * vv:
        x, y = (vv * ut - uv * vt) * (1 / det), (uu * vt - uv.conjugate() * ut) * (1 / det)
    x0 = mean_t - x * mean_u - y * mean_s
    solution = np.empty(SHAPE + LINEAR)
    solution[:SHAPE] = z
    for i, value in enumerate((x0, x, y)):
        solution[SHAPE + 2 * i], solution[SHAPE + 2 * i + 1] = value.real, value.imag
    # Where the two columns are one, no scale fits, and the start is of no use.
    cost = tt - (ut.conjugate() * x + vt.conjugate() * y).real if det > 1e-12 * uu * vv else math.inf
    return solution, max(0.0, cost)


@compiled
def row(
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
