"""The way of the holder: it goes the knife's offset before the tip, and swings about the tip in corners."""

import math
from collections.abc import Iterator, Sequence

import numpy as np

from mechwright import Array, Outline, Part

UP, DOWN, SWING = 2.0, -0.2, math.radians(10)
"""Height of rapids and depth of cuts, mm; the step of a swing, rad."""


def laid_out(parts: Sequence[Part], gap: float) -> tuple[list[Outline], float]:
    """The copies of plates side by side, and the length that they take, mm."""
    pieces, x = [], gap
    for part in parts:
        assert part.outline is not None  # noqa: S101 - plates alone are cut
        for _ in part.instances or (None,):
            left, low, right, _ = part.outline.bounds
            pieces.append(part.outline.moved(x - left, gap - low, 0.0))
            x += right - left + gap
    return pieces, x


def program(pieces: Sequence[Outline], offset: float, feed: float) -> str:
    """Grbl: all openings first, then all outsides; the blade is lined up along X at the edge before."""
    lines, heading = ["G21 G90 G94 G17", f"G0 Z{UP:g}", "G0 X0 Y0", f"G1 Z{DOWN:g} F{feed:g}"], 0.0
    lines += [f"G1 X{10 * offset:.4f} Y0 F{feed:g}", f"G0 Z{UP:g}"]
    for loop in [*(one for piece in pieces for one in piece.inner), *(piece.outer for piece in pieces)]:
        way = np.array(list(holder_way(np.asarray(loop.flatten()), offset, heading)))
        lines += [f"G0 X{way[0][0]:.4f} Y{way[0][1]:.4f}", f"G1 Z{DOWN:g} F{feed:g}"]
        lines += [f"G1 X{x:.4f} Y{y:.4f}" for x, y in way[1:]] + [f"G0 Z{UP:g}"]
        last = loop.flatten()[0] - loop.flatten()[-1]
        heading = math.atan2(last[1], last[0])
    return "\n".join([*lines, "G0 X0 Y0", "M2"]) + "\n"


def holder_way(points: Array, offset: float, heading: float) -> Iterator[tuple[float, float]]:
    """Places of the holder (x, y), mm, for a closed contour (n, 2) of the tip that begins with a heading."""
    for number in range(len(points) + 1):
        (x, y), (nx, ny) = points[number % len(points)], points[(number + 1) % len(points)]
        onward = math.atan2(ny - y, nx - x) if number < len(points) else heading
        turn = (onward - heading + math.pi) % math.tau - math.pi
        for angle in heading + np.linspace(0.0, turn, max(1, math.ceil(abs(turn) / SWING)) + 1):
            yield x + offset * math.cos(angle), y + offset * math.sin(angle)
        heading = onward
