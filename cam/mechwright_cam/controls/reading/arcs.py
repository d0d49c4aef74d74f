"""Arcs as controls define them."""

import math

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array

FULL = math.tau


def sweep_of(
    start: tuple[float, float], end: tuple[float, float], centre: tuple[float, float], ccw: bool
) -> float:
    """Signed angle from start to end about the centre, rad; an end equal to the start is a full turn.

    >>> round(sweep_of((1, 0), (0, 1), (0, 0), ccw=True), 6)
    1.570796
    >>> round(sweep_of((1, 0), (0, 1), (0, 0), ccw=False), 6)
    -4.712389
    """
    first = math.atan2(start[1] - centre[1], start[0] - centre[0])
    last = math.atan2(end[1] - centre[1], end[0] - centre[0])
    if start == end:
        return FULL if ccw else -FULL
    sweep = last - first
    if ccw:
        return sweep if sweep > 0 else sweep + FULL
    return sweep if sweep < 0 else sweep - FULL


def centre_of(
    start: tuple[float, float], end: tuple[float, float], radius: float, ccw: bool, slack: float
) -> tuple[float, float]:
    """Centre of the arc in radius form; a negative radius means the longer way round.

    Raises
    ------
    ValueError
        The ends coincide, or half their distance is more than the radius and ``slack``, mm; the text says
        which. A control whose rounding may find R too small has a ``slack`` below 0.

    Examples
    --------
    >>> centre_of((1, 0), (-1, 0), 1.0, True, 0.0)
    (0.0, 0.0)
    """
    dx, dy = end[0] - start[0], end[1] - start[1]
    chord = math.hypot(dx, dy)
    if chord == 0:
        raise ValueError("an arc with R ends where it starts; write I and J for a full circle")
    if chord / 2 > abs(radius) + max(slack, 0.0):
        raise ValueError(f"R{radius:g} is less than half the distance of {chord:.4f} mm between the ends")
    if chord / 2 > abs(radius) + slack:
        raise ValueError(
            f"R{radius:g} is just half the distance between the ends, and the control may round it to less "
            "and refuse the arc; write I and J"
        )
    height = math.sqrt(max(radius * radius - chord * chord / 4, 0.0))
    left = ccw == (radius > 0)
    side = height / chord if left else -height / chord
    return (start[0] + end[0]) / 2 - dy * side, (start[1] + end[1]) / 2 + dx * side


def centres_of(start: Array, end: Array, radius: Array, ccw: NDArray[np.bool_], slack: float) -> Array:
    """Centres (n, 2) as :func:`centre_of` gives them, of arcs between places (n, 2); NaN where it gives none.

    >>> centres_of(np.array([[1, 0.0]]), np.array([[-1, 0.0]]), np.ones(1), np.array([True]), 0.0).tolist()
    [[0.0, 0.0]]
    """
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):  # what is not finite is none
        way = end - start
        chord = np.hypot(*way.T)
        side = np.sqrt(np.maximum(radius * radius - chord * chord / 4, 0.0)) / chord
        side[ccw != (radius > 0)] *= -1
        found = (start + end) / 2 + side[:, None] * np.column_stack((-way[:, 1], way[:, 0]))
        found[(chord == 0) | (chord / 2 > np.abs(radius) + slack)] = np.nan
    centres: Array = found
    return centres


def rotated(place: tuple[float, float], centre: tuple[float, float], degrees: float) -> tuple[float, float]:
    """A place turned about a centre, counterclockwise.

    >>> [round(value, 9) for value in rotated((2, 1), (1, 1), 90)]
    [1.0, 2.0]
    """
    dx, dy, angle = place[0] - centre[0], place[1] - centre[1], math.radians(degrees)
    return (
        centre[0] + dx * math.cos(angle) - dy * math.sin(angle),
        centre[1] + dx * math.sin(angle) + dy * math.cos(angle),
    )
