"""Lines over an axis, as scalable pictures."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.output import svg
from mechwright.output.ticks import ticks

WIDTH, HEIGHT = 480.0, 284.0
LEFT, RIGHT, TOP, BOTTOM = 62.0, 20.0, 26.0, 36.0
INK, SOFT, LINE = "#22303c", "#4b5965", "#d3d9de"
COLOURS = ("#1f5fa8", "#b3261e", "#2e7d32", "#8a5a00")
LETTERS, LIFT = 13.0, 8.0
"""Size of letters, and by how much the words of a mark stand above it; ``TOP`` has room for both."""
MOST = 361
"""Points of a line that is drawn."""


@dataclass(frozen=True, eq=False)
class Line:
    """A line through points, with its name; ``dashed`` for limits."""

    name: str
    x: Array
    y: Array
    dashed: bool = False


def plot(lines: Sequence[Line], across: str, up: str, marks: Sequence[tuple[float, float, str]] = ()) -> str:
    """The picture; ``across`` and ``up`` name the axes, ``marks`` are points (x, y) with words."""
    xs = np.concatenate([line.x for line in lines])
    ys = np.concatenate([*(line.y for line in lines), [0.0], [mark[1] for mark in marks]])
    rows = ticks(float(ys.min()), float(ys.max()))
    low, high = rows[0], rows[-1]
    first, last = float(xs.min()), float(xs.max())

    def at(x: Array | float, y: Array | float) -> Array:
        over = LEFT + (WIDTH - LEFT - RIGHT) * (np.asarray(x) - first) / (last - first)
        above = TOP + (HEIGHT - TOP - BOTTOM) * (high - np.asarray(y)) / (high - low)
        return np.stack(np.broadcast_arrays(over, -above), axis=-1)

    drawn = [svg.element("rect", x=0, y=0, width=WIDTH, height=HEIGHT, fill="#fff")]
    drawn += [_grid(at(first, y), at(last, y), said(y), row=True) for y in rows]
    drawn += [_grid(at(x, low), at(x, high), said(x), row=False) for x in ticks(first, last, 7, inside=True)]
    drawn.append(_stroke(at(np.array([first, last]), 0.0), SOFT, 1.0))
    for number, line in enumerate(lines):
        step = max(1, (line.x.size - 1) // (MOST - 1))
        dash = {"stroke_dasharray": "6 4"} if line.dashed else {}
        colour = SOFT if line.dashed else COLOURS[number % len(COLOURS)]
        drawn.append(_stroke(at(line.x, line.y)[::step], colour, 1.8, **dash))
    for x, y, words in marks:
        place = at(x, y)
        drawn.append(svg.element("circle", cx=float(place[0]), cy=-float(place[1]), r=4.0, fill=INK))
        right = place[0] > WIDTH * 0.6
        look = {"text_anchor": "end"} if right else {}
        shift = -8.0 if right else 8.0
        drawn.append(
            svg.text(float(place[0]) + shift, float(place[1]) + LIFT, words, LETTERS, fill=INK, **look)
        )
    middle = (LEFT + WIDTH - RIGHT) / 2
    drawn.append(
        svg.text(middle, -HEIGHT + 5, f"{up} over {across}", LETTERS, fill=INK, text_anchor="middle")
    )
    return svg.picture("".join(drawn), (0, 0, WIDTH, HEIGHT), f"{up} over {across}")


def key(lines: Sequence[Line]) -> str:
    """What the colours mean, in words."""
    names = ("blue", "red", "green", "brown")
    return ", ".join(
        f"{'dashed' if line.dashed else names[number % len(names)]}: {line.name}"
        for number, line in enumerate(lines)
    )


def said(value: float) -> str:
    """A number with a true minus sign.

    >>> said(-0.70627)
    '−0.7063'
    """
    return f"{value:.4g}".replace("-", "−")


def _stroke(points: Array, colour: str, width: float, **look: object) -> str:
    return svg.element("path", d=svg.path(points), fill="none", stroke=colour, stroke_width=width, **look)


def _grid(one: Array, two: Array, words: str, *, row: bool) -> str:
    line = _stroke(np.array([one, two]), LINE, 0.7)
    if row:
        return line + svg.text(one[0] - 6, one[1] - 4, words, LETTERS, fill=SOFT, text_anchor="end")
    return line + svg.text(one[0], one[1] - 14, words, LETTERS, fill=SOFT, text_anchor="middle")
