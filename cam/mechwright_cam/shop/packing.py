"""Rectangles on a plate, each turned by 90 degrees where it then lies lower."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

WEB = 3.0
"""Frame between two channels, mm: as wide as beside the outermost channel, stiff enough for tabs."""

SNAP = 1e-6
"""Boxes overlap if by more than this, mm."""


@dataclass(frozen=True)
class Layout:
    """Lower left corners (x, y) of the boxes and whether each is turned; the size of all together."""

    spots: tuple[tuple[float, float, bool], ...]
    width: float
    height: float


def on_plate(
    sizes: Sequence[tuple[float, float]], width: float, height: float, gap: float, turn: bool
) -> Layout | None:
    """A layout on a plate of given size: filled from below, or else from the left."""
    layout = bottom_left(sizes, width, height, gap, turn)
    if layout is not None:
        return layout
    across = bottom_left([(h, w) for w, h in sizes], height, width, gap, turn)
    if across is None:
        return None
    return Layout(tuple((y, x, turned) for x, y, turned in across.spots), across.height, across.width)


def bottom_left(
    sizes: Sequence[tuple[float, float]], width: float, height: float, gap: float, turn: bool
) -> Layout | None:
    """Each box in turn where its upper edge is lowest, then leftmost; None if one finds no place."""
    boxes = np.empty((0, 4))
    spots: list[tuple[float, float, bool]] = []
    for w, h in sizes:
        best: tuple[float, float, float, bool] | None = None
        for turned in (False, True) if turn else (False,):
            a, b = (h, w) if turned else (w, h)
            xs = np.unique(np.append(boxes[:, 2] + gap, 0.0))
            ys = np.unique(np.append(boxes[:, 3] + gap, 0.0))
            xs, ys = xs[xs + a <= width + SNAP], ys[ys + b <= height + SNAP]
            beside = (xs[:, None] < boxes[:, 2] + gap - SNAP) & (xs[:, None] + a > boxes[:, 0] - gap + SNAP)
            above = (ys[:, None] < boxes[:, 3] + gap - SNAP) & (ys[:, None] + b > boxes[:, 1] - gap + SNAP)
            # How many boxes a place would meet, as a product of matrices; both ways ascend. Kernels compute
            # with what lies beside the matrices as well, and may warn of that.
            with np.errstate(invalid="ignore"):
                met = above.astype(np.float32) @ beside.T.astype(np.float32)
            free = np.argwhere(met == 0)
            if free.size == 0:
                continue
            row, column = free[0]
            at = (float(ys[row]) + b, float(xs[column]), float(ys[row]), turned)
            best = at if best is None else min(best, at)
        if best is None:
            return None
        _, left, low, turned = best
        a, b = (h, w) if turned else (w, h)
        boxes = np.vstack((boxes, (left, low, left + a, low + b)))
        spots.append((left, low, turned))
    return Layout(tuple(spots), float(boxes[:, 2].max()), float(boxes[:, 3].max()))


def fits_blank(
    sizes: Sequence[tuple[float, float]],
    blank: tuple[float, float],
    gap: float,
    room: tuple[float, float],
    *,
    turn: bool,
) -> bool:
    """Whether rectangles ``gap`` mm apart fit on a blank, as long and wide, either way round.

    A channel and a frame stay on either side, and the mills stay within the travel ``room`` in X and Y, mm.

    >>> bars = [(180.0, 20.0), (90.0, 20.0)]
    >>> fits_blank(bars, (200.0, 63.0), 9.0, (300.0, 190.0), turn=True)
    True
    >>> fits_blank(bars, (200.0, 63.0), 9.0, (180.0, 150.0), turn=True)
    False
    """
    order, beside = sorted(sizes, key=lambda size: (-max(size), -min(size))), gap + WEB
    ways = ((blank[0] - beside, blank[1] - beside), (blank[1] - beside, blank[0] - beside))
    return any(
        on_plate(order, min(x, room[0] - gap), min(y, room[1] - gap), gap, turn) is not None for x, y in ways
    )
