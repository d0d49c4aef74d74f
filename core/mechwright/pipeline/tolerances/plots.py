"""The plots of the page, as coordinates: error bands over the input."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.mechanics.tolerance import Analysis, Result
from mechwright.output.ticks import ticks
from mechwright.pipeline.tolerances.units import input_position, shown_unit

WIDTH, HEIGHT = 640, 250
LEFT, RIGHT, TOP, BOTTOM = 74, 22, 12, 40
_SIGMAS = 3.0
_STEEP = 4.0
"""How much higher than the median of the band a plot goes: near a singular position it grows without end."""


@dataclass(frozen=True)
class Plot:
    """One band.

    Parameters
    ----------
    worst, sigma
        Points of the closed outlines, as SVG writes them: one for each stretch with a first order.
    nominal
        Points of the nominal line.
    rows, columns
        Ticks: place and text.
    mark
        Place of the worst position, None where it is outside.
    """

    worst: tuple[str, ...]
    sigma: tuple[str, ...]
    nominal: tuple[str, ...]
    rows: tuple[tuple[float, str], ...]
    columns: tuple[tuple[float, str], ...]
    mark: float | None
    label: str
    input_label: str


def plot(analysis: Analysis, result: Result) -> Plot | None:
    """The band of an output; None where it has none, or is the same everywhere."""
    band, unit = result.band, analysis.model.input_unit
    at = np.degrees(analysis.model.positions) if unit == "rad" else analysis.model.positions
    good = np.isfinite(band.low) & np.isfinite(band.high)
    if result.output.figure == "steady" or good.sum() < 2:
        return None
    scale = 1e3
    low, high = scale * band.low, scale * band.high
    middle = scale * band.nominal
    mean, spread = scale * band.mean, scale * _SIGMAS * band.sigma
    sigma_low, sigma_high = np.maximum(low, mean - spread), np.minimum(high, mean + spread)
    if result.output.components > 1:
        sigma_low = np.zeros_like(low)
    top, bottom = float(high[good].max()), float(min(low[good].min(), 0.0))
    steep = _STEEP * float(np.median(np.abs(np.concatenate([low[good], high[good]]))))
    top, bottom = min(top, steep), max(bottom, -steep)
    rows = ticks(bottom, top)
    bottom, top = min(bottom, rows[0]), max(top, rows[-1])

    def x(value: Array | float) -> Array:
        return np.asarray(LEFT + (WIDTH - LEFT - RIGHT) * (value - at[0]) / (at[-1] - at[0]))

    def y(value: Array | float) -> Array:
        held = np.clip(value, bottom, top)
        return np.asarray(TOP + (HEIGHT - TOP - BOTTOM) * (top - held) / (top - bottom))

    stretches = [part for part in np.split(np.arange(at.size), _breaks(good)) if good[part].all()]
    worst_at = result.worst.at[0] if result.worst is not None else None
    worst = "" if worst_at is None else f"; worst at {input_position(worst_at, unit).split()[0]}"
    return Plot(
        tuple(_outline(x(at[part]), y(low[part]), y(high[part])) for part in stretches),
        tuple(_outline(x(at[part]), y(sigma_low[part]), y(sigma_high[part])) for part in stretches),
        tuple(_points(x(at[part]), y(middle[part])) for part in stretches),
        tuple((float(y(value)), f"{value:g}") for value in rows),
        tuple(
            (float(x(value)), f"{value:g}") for value in ticks(float(at[0]), float(at[-1]), 7, inside=True)
        ),
        None if worst_at is None else float(x(math.degrees(worst_at) if unit == "rad" else worst_at)),
        f"{result.output.name}, {shown_unit(result.output.unit)}",
        f"{analysis.model.input_name}, {'deg' if unit == 'rad' else unit}" + worst,
    )


def _breaks(good: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Where stretches of one kind begin."""
    return np.asarray(np.flatnonzero(np.diff(good.astype(int))) + 1)


def _outline(x: Array, low: Array, high: Array) -> str:
    return _points(np.concatenate([x, x[::-1]]), np.concatenate([high, low[::-1]]))


def _points(x: Array, y: Array) -> str:
    return " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(x, y, strict=True))
