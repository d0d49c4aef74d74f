"""The Bézier segments of a loop, all of one degree together, in a few array steps."""

from collections.abc import Sequence

import numpy as np

from mechwright.arrays import Array
from mechwright.geometry.segments import BSpline, Segment, bernstein


def by_degree(segments: Sequence[Segment]) -> list[tuple[list[int], Array]]:
    """Places of the single-span splines among segments, and their nets (n, degree + 1, 2), mm.

    >>> from mechwright.geometry.segments import Line
    >>> curve = BSpline.bezier([(2, 0), (1, 1), (0, 0)])
    >>> [(places, nets.shape) for places, nets in by_degree([Line((0, 0), (2, 0)), curve])]
    [([1], (1, 3, 2))]
    """
    found: dict[int, tuple[list[int], list[Array]]] = {}
    for place, segment in enumerate(segments):
        if isinstance(segment, BSpline) and segment.is_bezier:
            places, nets = found.setdefault(segment.degree, ([], []))
            places.append(place)
            nets.append(np.asarray(segment.points, dtype=float))
    return [(places, np.stack(nets)) for places, nets in found.values()]


def sampled(nets: Array, t: Array) -> tuple[Array, Array]:
    """Points and first derivatives with respect to t (n, m, 2) of nets at parameters t (m,) in [0, 1]."""
    degree = nets.shape[1] - 1
    points: Array = bernstein(degree, t) @ nets
    rates: Array = bernstein(degree - 1, t) @ (degree * np.diff(nets, axis=1))
    return points, rates


def flattened(nets: Array, tolerance: float) -> list[Array]:
    """Points on each curve whose chords stay within a tolerance, mm, as of :meth:`BSpline.flatten`."""
    degree = nets.shape[1] - 1
    bend = np.zeros(len(nets))
    if degree > 1:
        second = (degree - 1) * np.diff(degree * np.diff(nets, axis=1), axis=1)
        bend = np.hypot(second[..., 0], second[..., 1]).max(axis=1)
    counts = np.maximum(1, np.ceil(np.sqrt(bend / (8 * tolerance)))).astype(np.int64)
    found: list[Array] = [np.empty(0)] * len(nets)
    for count in np.unique(counts).tolist():
        some = np.flatnonzero(counts == count)
        points = bernstein(degree, np.linspace(0.0, 1.0, count + 1)) @ nets[some]
        points[:, 0], points[:, -1] = nets[some, 0], nets[some, -1]
        for i, curve in zip(some.tolist(), points, strict=True):
            found[i] = curve
    return found
