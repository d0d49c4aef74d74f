"""Fitting of smooth parametric curves by Bézier segments, many curves at once.

Glossary
--------
curve
    A function of a parameter t in [0, 1] that gives points in the plane.
net
    The control points of a Bézier segment.
piece
    The part of every curve of a batch that one segment each fits.
Lobatto nodes
    (1 - cos(π j / n)) / 2, j = 0 … n: both ends, and dense towards them, so that interpolation of degree n
    comes within a small factor of the best polynomial.
"""

from collections.abc import Callable
from functools import cache

import numpy as np

from mechwright.arrays import Array
from mechwright.errors import GeometryError
from mechwright.geometry.segments import BSpline, bernstein

Curves = Callable[[Array], Array]
"""Points (count, m, 2), mm, of ``count`` curves at parameters (m,) in [0, 1]."""

LOWEST_DEGREE = 3
"""Drawings and CAM programs expect cubics at least."""

HIGHEST_DEGREE = 9
"""Every CAD kernel and DXF reader takes this degree; beyond it, cutting in halves costs fewer numbers."""

_MOST_HALVINGS = 8
"""A curve that 256 pieces do not fit is not smooth."""

_SAMPLES = 121
"""Points where the deviation is measured: twelve per ripple of the highest degree's error, which shows at
least 98 % of the largest one."""


def fit_curves(
    curves: Curves, count: int, tolerance: float, tag: str = ""
) -> tuple[list[list[BSpline]], float]:
    """Fit each curve by a chain of Bézier segments of one tag; see :func:`fit_nets`.

    Returns
    -------
    chains
        One list of segments per curve, in order; consecutive ones share their end points to the last bit.
    deviation
        The largest distance found, mm.

    Examples
    --------
    >>> def quarters(t):
    ...     angle = np.pi / 2 * t
    ...     arc = np.stack((np.cos(angle), np.sin(angle)), axis=-1)
    ...     return np.array([1.0, 2.0])[:, None, None] * arc
    >>> chains, deviation = fit_curves(quarters, 2, 1e-4)
    >>> [len(chain) for chain in chains], chains[0][0].degree, deviation < 1e-4
    ([1, 1], 5, True)
    """
    nets, deviation = fit_nets(curves, count, tolerance)
    chains = [[BSpline.bezier(piece[i], tag) for piece in nets] for i in range(count)]
    return chains, deviation


def fit_nets(curves: Curves, count: int, tolerance: float) -> tuple[list[Array], float]:
    """Fit each of ``count`` exact curves, smooth on [0, 1], by a chain of Bézier nets within a tolerance, mm.

    Interpolation at Lobatto nodes; the degree rises from 3 until every curve is within the tolerance, and
    where degree 9 is not enough all curves are cut in halves. The deviation is measured at points between
    the nodes, along the normal of the fit.

    Returns
    -------
    nets
        Per piece an array (count, degree + 1, 2), mm.
    deviation
        The largest distance found, mm.

    Raises
    ------
    GeometryError
        The curves are not finite, or not smooth enough for the tolerance.
    """
    return _fit(curves, count, tolerance, 0.0, 1.0, _MOST_HALVINGS)


def _fit(
    curves: Curves, count: int, tolerance: float, start: float, end: float, halvings: int
) -> tuple[list[Array], float]:
    def part(t: Array) -> Array:
        # Not start + (end - start) t: the pieces must meet in the same bits.
        return curves((1 - t) * start + t * end)

    t = np.linspace(0, 1, _SAMPLES)
    exact = part(t)
    if exact.shape != (count, _SAMPLES, 2) or not np.isfinite(exact).all():
        raise GeometryError(
            f"cannot fit {count} curves: they give points of shape {exact.shape} or no numbers"
        )
    for degree in range(LOWEST_DEGREE, HIGHEST_DEGREE + 1):
        nodes, inverse = interpolation(degree)
        points = part(nodes)
        net = inverse @ points
        net[:, 0], net[:, -1] = points[:, 0], points[:, -1]
        deviation = _distance(net, degree, t, exact)
        if deviation <= tolerance:
            return [net], deviation
    if halvings == 0:
        raise GeometryError(
            f"a curve is not smooth enough to be fitted: {deviation:.3g} mm remain after "
            f"{_MOST_HALVINGS} halvings, the limit is {tolerance:g} mm"
        )
    middle = (start + end) / 2
    first, one = _fit(curves, count, tolerance, start, middle, halvings - 1)
    second, two = _fit(curves, count, tolerance, middle, end, halvings - 1)
    second[0][:, 0] = first[-1][:, -1]
    return first + second, max(one, two)


def _distance(net: Array, degree: int, t: Array, exact: Array) -> float:
    """Largest distance of exact points (count, m, 2) from the fits, after one step to the foot point."""
    slopes = degree * np.diff(net, axis=1)
    rate = bernstein(degree - 1, t) @ slopes
    error = exact - bernstein(degree, t) @ net
    speed = np.einsum("cmi,cmi->cm", rate, rate)
    step = np.einsum("cmi,cmi->cm", error, rate) / np.where(speed > 0, speed, np.inf)
    foot = np.clip(t + step, 0, 1)
    nearest = np.einsum("cmk,cki->cmi", bernstein(degree, foot), net)
    return float(np.linalg.norm(exact - nearest, axis=-1).max())


@cache
def interpolation(degree: int) -> tuple[Array, Array]:
    """Lobatto nodes (degree + 1,) and the matrix that turns values there into control points."""
    nodes = (1 - np.cos(np.pi * np.arange(degree + 1) / degree)) / 2
    inverse: Array = np.linalg.inv(bernstein(degree, nodes)).astype(np.float64)
    return nodes, inverse
