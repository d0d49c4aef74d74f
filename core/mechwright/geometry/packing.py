"""Boxes laid on a rectangle: bottom-left, each where its upper edge is lowest, then leftmost.

Each box may be turned by 90 degrees where it then lies lower.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

WIDTHS = 40
"""So many widths of an open plate are tried."""

SNAP = 1e-6
"""Boxes overlap if by more than this, mm."""


@dataclass(frozen=True)
class Layout:
    """Lower left corners (x, y) of the boxes and whether each is turned; the size of all together, mm."""

    spots: tuple[tuple[float, float, bool], ...]
    width: float
    height: float


def on_plate(
    sizes: Sequence[tuple[float, float]], width: float, height: float, gap: float, turn: bool
) -> Layout | None:
    """A layout on a plate of given size, filled from below, or else from the left; None if neither is one.

    Parameters
    ----------
    sizes
        Width and height of each box, mm, in the order in which they are laid: the largest first packs best.
    width, height
        Of the plate, mm.
    gap
        Least distance of any two boxes, mm.
    turn
        Whether boxes may be turned by 90 degrees.

    Examples
    --------
    >>> on_plate([(6, 4), (4, 4)], 12, 5, 2, True).spots
    ((0.0, 0.0, False), (8.0, 0.0, False))
    >>> on_plate([(6, 4), (4, 4)], 11, 5, 2, True) is None
    True
    """
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
    """Each box in turn where its upper edge is lowest, then leftmost; None if one finds no place.

    The arguments are those of :func:`on_plate`; the height may be infinite.
    """
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


def open_layout(
    sizes: Sequence[tuple[float, float]], gap: float, turn: bool, room: tuple[float, float]
) -> Layout:
    """The layout of least area, with the gap around it; the shorter circumference of two alike.

    One within the machine's travel, ``room``, goes before any other; mills stay within the gap around it.
    """
    least = max(min(size) if turn else size[0] for size in sizes)
    most = sum(max(size) if turn else size[0] for size in sizes) + gap * (len(sizes) - 1)
    widths = np.linspace(least, max(least, most), WIDTHS).tolist()
    found = (bottom_left(sizes, width, math.inf, gap, turn) for width in widths)
    return min(
        filter(None, found),
        key=lambda f: (
            max(0.0, f.width + gap - room[0]) + max(0.0, f.height + gap - room[1]),
            (f.width + gap) * (f.height + gap),
            f.width + f.height,
        ),
    )
