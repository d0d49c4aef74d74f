"""Numbers as the page holds them: rounded, so that the file stays small and the same everywhere."""

import math
from typing import Any

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.motion import NOTHING, Poses
from mechwright_cad.interference.path import STILL, space_path

MICRON = 3
"""Decimals of lengths, mm."""

DRAWN = 2
"""Decimals of what is only drawn, mm."""

ANGLE = 5
"""Decimals of angles, rad, and of quaternions: a micrometre at 100 mm."""

DIGITS = 6
"""Significant digits of channels: more than a plot or a readout shows."""


def rounded(values: Array, decimals: int) -> list[Any]:
    """Nested lists of numbers, whole ones as integers, without a negative zero."""
    near = np.round(values, decimals)
    flat: list[Any] = [int(value) if value.is_integer() else value for value in near.ravel().tolist()]
    for width in near.shape[:0:-1]:
        flat = [flat[i : i + width] for i in range(0, len(flat), width)]
    return flat


def hidden(values: Array, decimals: int) -> list[float | int | None]:
    """Numbers rounded to ``decimals``; what is not finite is None."""
    return [_plain(value) for value in np.round(values, decimals).tolist()]


def _plain(value: float) -> float | int | None:
    if value.is_integer():
        return int(value)
    return value if math.isfinite(value) else None


ROUNDED = 1e-9
"""Part of a channel's greatest value below which a value of it is the rounding of sums."""


EXACT = 22
"""Greatest power of ten that a float holds without an error."""

MIDDLE = 1e-6
"""Share of the last digit near the middle of two, where the error of a product could decide."""


def significant(values: Array) -> list[float | int | None]:
    """Numbers to ``DIGITS`` significant digits; what is not finite is None, and a gap in the plot.

    >>> significant(np.array([1 / 3, 4.9e-15, np.inf]))
    [0.333333, 0, None]
    """
    finite = np.where(np.isfinite(values), values, 0.0)
    least = max(NOTHING, ROUNDED * float(np.abs(finite).max(initial=0.0)))
    shown = np.where(np.abs(values) < least, 0.0, values)
    return [_plain(value) for value in _to_digits(shown).tolist()]


def _to_digits(values: Array) -> Array:
    """Values (n,) to ``DIGITS`` significant digits: the number next to that decimal one.

    A whole number over a power of ten is it, if both are held without an error. Where it is near the middle
    of two, or so large or small that they are not, it is read from text.
    """
    size = np.abs(values)
    usual = (size > 10.0 ** (DIGITS - 1 - EXACT)) & (size < 10.0 ** (DIGITS - 1))
    power = 10.0 ** (DIGITS - 1 - np.floor(np.log10(np.where(usual, size, 1.0))))
    scaled = np.where(usual, values, 0.0) * power
    whole = np.rint(scaled)
    usual &= (np.abs(whole) >= 10 ** (DIGITS - 1)) & (np.abs(whole) < 10**DIGITS)
    usual &= np.abs(np.abs(scaled - whole) - 0.5) > MIDDLE
    found: Array = np.where(usual, whole / power, values)
    for i in np.flatnonzero(~usual & (values != 0) & np.isfinite(values)):
        found[i] = float(f"{values[i]:.{DIGITS}g}")
    return found


def poses_of(poses: Poses, *, plane: bool) -> dict[str, Any]:
    """A body's poses: columns of numbers, of one number where it does not change.

    In the plane these are x, y and the angle, rad, whether the body lies face down, and its height; in space
    the position and a unit quaternion, scalar first, without jumps of sign.
    """
    if plane:
        angle = np.unwrap(np.arctan2(poses.rotation[:, 1, 0], poses.rotation[:, 0, 0]))
        columns = [*poses.position[:, :2].T, angle]
        decimals = [MICRON, MICRON, ANGLE]
    else:
        path = space_path(poses.rotation, poses.position)
        columns = [*path.position.T, *path.attitude.T]
        decimals = [MICRON] * 3 + [ANGLE] * 4
    still = all(np.ptp(column) < STILL for column in columns)
    found: dict[str, Any] = {
        "columns": [
            rounded(column[:1] if still else column, places)
            for column, places in zip(columns, decimals, strict=True)
        ]
    }
    if plane and poses.rotation[0, 2, 2] < 0:
        found["down"] = True
    if plane and abs(height := round(float(poses.position[0, 2]), MICRON)) > 0:
        found["z"] = height
    return found


def hexadecimal(colour: tuple[float, float, float]) -> str:
    """A colour as browsers write it.

    >>> hexadecimal((1.0, 0.5, 0.0))
    '#ff8000'
    """
    return "#" + "".join(f"{round(255 * min(max(part, 0.0), 1.0)):02x}" for part in colour)
