"""Random loops: polygons with round and sharp corners, slots, and grooves along circles."""

import math

import numpy as np
from planning_parts import rounded_box
from random_pockets import rounded

from mechwright.geometry import Arc, Line, Loop

Rng = np.random.Generator


def polygon(rng: Rng, size: float, x: float = 0.0, y: float = 0.0) -> Loop:
    """A star-shaped polygon about a place, some of its corners round, others sharp."""
    count = int(rng.integers(3, 9))
    angles = np.linspace(0, math.tau, count, endpoint=False) + rng.uniform(-0.25, 0.25, count)
    far = size * rng.uniform(0.65, 1.0, count)
    points = np.array((x, y)) + np.column_stack((far * np.cos(angles), far * np.sin(angles)))
    return rounded(points, rng.uniform(0.3, 0.3 * size, count))


def slot(rng: Rng, length: float, width: float, x: float, y: float, angle: float) -> Loop:
    """A slot with round, or nearly square, ends."""
    return rounded_box(length, width, width * rng.choice([0.5, 0.3, 0.1])).moved(x, y, angle)


def ring(rng: Rng, inner: float, outer: float) -> Loop:
    """A groove along a circle."""
    first, sweep = rng.uniform(0, 6), rng.uniform(0.5, 3)
    one, two = Arc((0, 0), outer, first, sweep), Arc((0, 0), inner, first + sweep, -sweep)
    return Loop((one, Line(one.end, two.start), two, Line(two.end, one.start)))
