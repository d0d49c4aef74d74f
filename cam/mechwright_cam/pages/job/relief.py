"""The stock of a job as a page cuts it: its cells, what is there at first, and the finished part."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright_cad.viewer.packed import packed
from mechwright_cam.proof.scene import Scene
from mechwright_cam.proof.simulation import blank, target_heights
from mechwright_cam.shop.cutter import cutter
from mechwright_cam.shop.tool import Tool

SIDE, MOST_SIDE = 480, 900
"""Cells along the longer side of the stock: as a picture has pixels, and more where cutters are fine."""

FINEST = 0.02
"""Smallest cell, mm."""

SHARE = 0.5
"""Of the finest cutter's radius: with wider cells it has no shape."""

NOTHING = -(2**31)
"""Stands for a place of which nothing is said."""

RADII = 129
"""Places between the axis of a cutter and its rim at which the page knows how high its end is."""


def cell_of(scene: Scene) -> float:
    """Width of a cell of the page, mm."""
    x0, y0, x1, y1 = scene.job.stock
    longest = max(x1 - x0, y1 - y0)
    radius = float(scene.paths.radius[scene.paths.cuts].min(initial=math.inf))
    return max(FINEST, longest / MOST_SIDE, min(longest / SIDE, SHARE * radius))


def relief_of(scene: Scene) -> dict[str, Any]:
    """The grid of a job before any cut, rows from the lower edge, and the heights of the finished part."""
    job = scene.job
    cell = cell_of(scene)
    heights, floors = blank(job, cell)
    return {
        "corner": [round(job.stock[0], 6), round(job.stock[1], 6)],
        "cell": cell,
        "rows": heights.shape[0],
        "columns": heights.shape[1],
        "thickness": job.thickness,
        "heights": in_runs(heights),
        "floors": in_runs(floors),
        "target": in_runs(target_heights(job, heights.shape, cell)),
    }


def in_runs(values: Array | NDArray[np.float32]) -> dict[str, str]:
    """Values (ny, nx), mm, as lengths of runs of equal ones and these in micrometres; NaN is ``NOTHING``."""
    flat = np.asarray(values, dtype=np.float64).ravel()
    whole = np.where(np.isfinite(flat), np.rint(np.nan_to_num(flat) * 1000), NOTHING).astype(np.int64)
    first = (
        np.flatnonzero(np.diff(whole, prepend=whole[0] - 1)) if whole.size else np.empty(0, dtype=np.int64)
    )
    return {
        "lengths": packed(np.diff(first, append=whole.size), "u4"),
        "values": packed(whole[first], "i4"),
    }


def end_of(tool: Tool) -> list[float]:
    """Height of a tool's end above its tip at ``RADII`` distances from the axis to the rim, mm."""
    radii = np.linspace(0.0, tool.radius, RADII)
    heights = cutter(tool).height_at(radii)
    return [0.0] if not heights.any() else np.round(heights, 5).tolist()
