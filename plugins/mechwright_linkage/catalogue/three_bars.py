"""A plate on three bars: all ways to put it together.

The bars go from pins p₁, p₂, p₃ that stand to pins c₁ = 0, c₂, c₃ of a plate whose place is X and whose angle
is φ; with e = e^{iφ}:

    |X + cₖ e - pₖ|² = lₖ².

With Y = X - p₁ and dₖ = pₖ - p₁ - cₖ e the differences of the first and the others are linear in Y:
Re(d̄ₖ Y) = mₖ = (l₁² + |dₖ|² - lₖ²)/2. So Y = -i (m₂ d₃ - m₃ d₂)/Δ with Δ = Im(d̄₂ d₃), and |Y| = l₁ is a
trigonometric polynomial of φ of the degree 3,

    |m₂ d₃ - m₃ d₂|² - l₁² Δ² = 0,

whose at most six roots are the eigenvalues of a companion matrix. Where two bars and the plate are a
parallelogram, d₂ = 0 or d₃ = 0: that pose is not found.
"""

from typing import Any

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.planar.rigid import Plane

DEGREE = 3
"""Of the trigonometric polynomial."""

ON_CIRCLE = 1e-2
"""A root e^{iφ} this near to the unit circle may be an angle: rounding moves double roots off it."""

CLOSED = 1e-9
"""Largest error of a bar's length, over the size of the linkage, of a plate that is put together."""

STEPS = 8
"""Newton steps on the three bars from an eigenvalue to the pose."""

SAME = 1e-7
"""rad. Two poses this near are one."""


def assemblies(pins: tuple[Any, Any, Any], plate: tuple[Any, Any], lengths: tuple[Any, Any, Any]) -> Array:
    """Angles of the plate, with which it can be put together.

    Parameters
    ----------
    pins
        Outer pins p₁, p₂, p₃ of the bars, x + i y, mm; numbers or columns (n, 1).
    plate
        Pins c₂ and c₃ in the plate, whose origin is the pin of the first bar.
    lengths
        Bars l₁, l₂, l₃, mm.

    Returns
    -------
    (n, 6) float, rad, in (-π, π]; NaN where there are fewer. Every bar has its length to 1e-9 of the size.

    Examples
    --------
    A plate that has been drawn at 0° is found again:

    >>> found = assemblies((0, 50, 70 + 60j), (40, 25 + 30j), (30, abs(10 - 30j), 45))
    >>> bool(np.nanmin(abs(found)) < 1e-9)
    True
    """
    given = np.broadcast_arrays(*(np.ravel(np.asarray(one, complex)) for one in (*pins, *plate, *lengths)))
    size = np.max([np.abs(one) for one in given], axis=0)
    count = 2 * DEGREE + 2
    angles = 2 * np.pi * np.arange(count) / count
    columns = [(one / size)[:, None] for one in given]
    values = _closing(angles, columns)
    coefficients = np.fft.fft(values, axis=-1)[:, [3, 2, 1, 0, -1, -2, -3]] / count
    roots = _roots(coefficients)
    start = np.where(np.abs(np.abs(roots) - 1) < ON_CIRCLE, np.angle(roots), np.nan)
    found, error = _closed(start, columns)
    found = np.sort(np.where(error < CLOSED, found, np.nan), axis=-1)
    again = np.diff(found, axis=-1, prepend=-np.inf) < SAME
    return np.sort(np.where(again, np.nan, found), axis=-1)


def place(
    angle: Any, pins: tuple[Any, Any, Any], plate: tuple[Any, Any], lengths: tuple[Any, Any, Any]
) -> Any:
    """Where the plate's origin is with one of these angles, x + i y, mm."""
    along, sine = _over_sine(angle, [*pins, *plate, *lengths])
    with np.errstate(invalid="ignore", divide="ignore"):
        return pins[0] + along / sine


def _over_sine(angle: Any, columns: Any) -> tuple[Any, Any]:
    """Y Δ and Δ."""
    p1, p2, p3, c2, c3, l1, l2, l3 = columns
    e = np.exp(1j * np.asarray(angle))
    d2, d3 = p2 - p1 - c2 * e, p3 - p1 - c3 * e
    m2 = (l1**2 + np.abs(d2) ** 2 - l2**2) / 2
    m3 = (l1**2 + np.abs(d3) ** 2 - l3**2) / 2
    return -1j * (m2 * d3 - m3 * d2), (np.conj(d2) * d3).imag


def _closing(angle: Any, columns: Any) -> Array:
    along, sine = _over_sine(angle, columns)
    return np.asarray(np.abs(along) ** 2 - np.abs(columns[5]) ** 2 * sine**2)


def _roots(coefficients: Plane) -> Plane:
    """Roots (n, 6) of polynomials with coefficients (n, 7), the highest first."""
    found = np.full((len(coefficients), 2 * DEGREE), np.nan, complex)
    with np.errstate(invalid="ignore", divide="ignore"):
        first = -coefficients[:, 1:] / coefficients[:, :1]
    good = np.isfinite(first).all(axis=1)
    companion = np.zeros((good.sum(), 2 * DEGREE, 2 * DEGREE), complex)
    companion[:, 0] = first[good]
    companion[:, range(1, 2 * DEGREE), range(2 * DEGREE - 1)] = 1
    found[good] = np.linalg.eigvals(companion)
    return found


def _closed(angle: Array, columns: Any) -> tuple[Array, Array]:
    """Angles (n, 6) after Newton's method on place and angle, and the largest error of a bar."""
    p1, p2, p3, c2, c3, l1, l2, l3 = columns
    pins, lengths = np.stack([p1, p2, p3]), np.stack([l1, l2, l3]).real
    levers = np.stack([0 * c2, c2, c3])
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        along, sine = _over_sine(angle, columns)
        x = p1 + l1 * np.sign(sine) * along / np.abs(along)
        for _ in range(STEPS):
            turned = levers * np.exp(1j * angle)
            bars = x + turned - pins
            gap = (np.abs(bars) ** 2 - lengths**2) / 2
            rows = np.stack([bars.real, bars.imag, (np.conj(bars) * 1j * turned).real], axis=-1)
            step = _cramer(np.moveaxis(rows, 0, -2), np.moveaxis(gap, 0, -1))
            x, angle = x - step[..., 0] - 1j * step[..., 1], angle - step[..., 2]
        error = np.max(np.abs(np.abs(x + levers * np.exp(1j * angle) - pins) - lengths), axis=0)
    return np.angle(np.exp(1j * angle)), np.where(np.isfinite(error), error, np.inf)


def _cramer(matrix: Array, right: Array) -> Array:
    """Solutions (..., 3) of systems (..., 3, 3) by cross products; infinite or NaN where one is singular."""
    a, b, c = matrix[..., 0], matrix[..., 1], matrix[..., 2]
    crossed = np.stack([np.cross(b, c), np.cross(c, a), np.cross(a, b)], axis=-2)
    determinant = (a * crossed[..., 0, :]).sum(axis=-1)
    return np.asarray((crossed * right[..., None, :]).sum(axis=-1) / determinant[..., None])
