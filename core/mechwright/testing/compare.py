"""Comparisons that say by how much, where, and against which limit."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from mechwright.arrays import Array
from mechwright.geometry import Outline
from mechwright.tolerances import TOLERANCES

if TYPE_CHECKING:
    import shapely

DERIVATIVE = 1e-7
"""Part of its largest value by which a rate may miss the difference quotient: the rounding of a quotient
over a thousand samples stays a hundred times below."""

_SIXTH = np.array([-1, 9, -45, 0, 45, -9, 1]) / 60
_FOURTH = np.array([0, 1, -8, 0, 8, -1, 0]) / 12
STENCIL = _SIXTH.size
"""Samples that a difference quotient takes together."""


def assert_points_close(
    actual: ArrayLike, expected: ArrayLike, tolerance: float = TOLERANCES.closure, what: str = "points"
) -> None:
    """Check that points (n, d) lie within ``tolerance``, mm, of where they should.

    >>> assert_points_close([(0, 0), (1, 0)], [(0, 0), (1, 0.5)], 0.1)
    Traceback (most recent call last):
    ...
    AssertionError: points: number 1 is at [1.0, 0.0], 0.5 mm from [1.0, 0.5]; the limit is 0.1 mm
    """
    a, b = np.atleast_2d(np.asarray(actual, dtype=float)), np.atleast_2d(np.asarray(expected, dtype=float))
    if a.shape != b.shape:
        raise AssertionError(f"{what}: shape {a.shape}, expected {b.shape}")
    if a.size == 0:
        return
    distance = np.linalg.norm(a - b, axis=1)
    worst = int(np.argmax(distance))
    if not distance[worst] <= tolerance:  # also where a coordinate is not a number
        raise AssertionError(
            f"{what}: number {worst} is at {a[worst].tolist()}, {distance[worst]:g} mm from "
            f"{b[worst].tolist()}; the limit is {tolerance:g} mm"
        )


def assert_same_outline(
    actual: "Outline | shapely.Polygon",
    expected: "Outline | shapely.Polygon",
    tolerance: float = TOLERANCES.outline,
) -> None:
    """Check that two outlines have the same openings and boundaries within ``tolerance``, mm, of each other.

    It does not matter where a loop starts or of which segments it is made.
    """
    import shapely

    # Chords of a tenth of the tolerance: what they add to the distance does not decide.
    a, b = (
        shape.polygon(tolerance / 10) if isinstance(shape, Outline) else shape for shape in (actual, expected)
    )
    if len(a.interiors) != len(b.interiors):
        raise AssertionError(f"{len(a.interiors)} openings, expected {len(b.interiors)}")
    for one, other, name in ((a, b, "the first"), (b, a, "the second")):
        corners = shapely.points(shapely.get_coordinates(one))
        distance = shapely.distance(corners, other.boundary)
        worst = int(np.argmax(distance))
        if not distance[worst] <= tolerance:
            at = corners[worst]
            raise AssertionError(
                f"outlines differ: ({at.x:.6g}, {at.y:.6g}) of {name} is {distance[worst]:.3g} mm "
                f"from the other; the limit is {tolerance:g} mm"
            )


def assert_monotone(values: ArrayLike, what: str = "values") -> None:
    """Check that values (n,) always rise or always fall.

    >>> assert_monotone([1, 2, 2])
    Traceback (most recent call last):
    ...
    AssertionError: values: neither rising nor falling from sample 1 (2.0) to 2 (2.0)
    """
    array = np.asarray(values, dtype=float)
    step = np.diff(array)
    sign = np.sign(array[-1] - array[0]) if array.size else 0.0
    bad = np.flatnonzero(~(step * sign > 0))
    if bad.size:
        i = int(bad[0])
        raise AssertionError(
            f"{what}: neither rising nor falling from sample {i} ({array[i]}) to {i + 1} ({array[i + 1]})"
        )


def assert_rotations(rotation: Array, what: str = "rotations") -> None:
    """Check that matrices (n, 3, 3) are proper rotations: orthogonal, without a reflection."""
    gram = rotation @ np.swapaxes(rotation, 1, 2) - np.eye(3)
    fault = np.abs(gram).max(axis=(1, 2), initial=0.0)
    bad = np.flatnonzero(~((fault <= TOLERANCES.angle_rad) & (np.linalg.det(rotation) > 0)))
    if bad.size:
        i = int(bad[0])
        raise AssertionError(f"{what}: sample {i} is no rotation: {rotation[i].tolist()}")


def assert_derivative(
    rate: Array,
    quantity: Array,
    variable: Array,
    factor: Array | float = 1.0,
    tolerance: float = DERIVATIVE,
    what: str = "rate",
    largest: float = 0.0,
) -> None:
    """Check that ``rate`` is ``factor`` times the derivative of ``quantity`` with respect to ``variable``.

    Parameters
    ----------
    rate, quantity, variable
        (n,) float with n of 9 or more, sampled smoothly; ``variable`` need not be evenly spaced.
    factor
        (n,) float or a number: the rate of the variable itself, where ``rate`` is a rate over time.
    tolerance
        Allowed deviation as a part of the largest rate.
    what
        Name for the message.
    largest
        The largest rate, where these are some samples of more.

    Notes
    -----
    The difference quotient is the central one of sixth order over the samples. Its own truncation error is
    judged by how far the one of fourth order is away, so a coarse sampling never makes a right rate fail.

    Examples
    --------
    >>> t = np.linspace(0, 1, 101)
    >>> assert_derivative(np.cos(t), np.sin(t), t)
    >>> assert_derivative(-np.cos(t), np.sin(t), t, what="speed")
    Traceback (most recent call last):
    ...
    AssertionError: speed: -0.99955 at sample 3, the difference quotient says 0.99955
    """
    if rate.size < _SIXTH.size + 2:
        raise AssertionError(f"{what}: {rate.size} samples are too few for a difference quotient")

    def differ(values: Array, stencil: Array) -> Array:
        steps: Array = np.convolve(values, stencil[::-1], mode="valid")
        return steps

    inside = slice(3, -3)
    scale = np.broadcast_to(np.asarray(factor, dtype=float), rate.shape)[inside]
    fine = scale * differ(quantity, _SIXTH) / differ(variable, _SIXTH)
    rough = scale * differ(quantity, _FOURTH) / differ(variable, _FOURTH)
    # What a quotient loses by rounding of the quantity itself, which may be large and vary little.
    step = np.abs(differ(variable, _SIXTH)).min()
    rounding = 4 * np.finfo(float).eps * np.abs(quantity).max() * np.abs(scale).max() / step
    limit = np.abs(fine - rough) + tolerance * max(largest, np.abs(rate).max()) + rounding
    bad = np.flatnonzero(~(np.abs(rate[inside] - fine) <= limit))
    if bad.size:
        i = int(bad[0])
        raise AssertionError(
            f"{what}: {rate[i + 3]:.6g} at sample {i + 3}, the difference quotient says {fine[i]:.6g}"
        )
