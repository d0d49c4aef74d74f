"""Numbers as the page holds them: rounded, so that the file stays small and the same everywhere."""

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
    return [_plain(item) for item in np.round(values, decimals).tolist()]


def hidden(values: Array, decimals: int) -> list[float | int | None]:
    """Numbers rounded to ``decimals``; what is not finite is None."""
    return [_plain(value) if np.isfinite(value) else None for value in np.round(values, decimals).tolist()]


def _plain(value: Any) -> Any:
    if isinstance(value, list):
        return [_plain(item) for item in value]
    return int(value) if float(value).is_integer() else value


ROUNDED = 1e-9
"""Part of a channel's greatest value below which a value of it is the rounding of sums."""


def significant(values: Array) -> list[float | int | None]:
    """Numbers to ``DIGITS`` significant digits; what is not finite is None, and a gap in the plot.

    >>> significant(np.array([1 / 3, 4.9e-15, np.inf]))
    [0.333333, 0, None]
    """
    finite = np.where(np.isfinite(values), values, 0.0)
    least = max(NOTHING, ROUNDED * float(np.abs(finite).max(initial=0.0)))
    shown = np.where(np.abs(values) < least, 0.0, values)
    return [_plain(float(f"{value:.{DIGITS}g}")) if np.isfinite(value) else None for value in shown.tolist()]


def poses_of(poses: Poses, *, plane: bool) -> dict[str, Any]:
    """A body's poses: columns of numbers, of one number where it does not change.

    In the plane these are x, y and the angle, rad, and whether the body lies face down; in space the position
    and a unit quaternion, scalar first, without jumps of sign.
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
    return found


def hexadecimal(colour: tuple[float, float, float]) -> str:
    """A colour as browsers write it.

    >>> hexadecimal((1.0, 0.5, 0.0))
    '#ff8000'
    """
    return "#" + "".join(f"{round(255 * min(max(part, 0.0), 1.0)):02x}" for part in colour)
