"""A plot of figures over the motion."""

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.as_made import MadeCurve
from mechwright.output import svg

WIDTH, HEIGHT = 170.0, 62.0
"""Of the field of the plot, in units of the picture."""
LEFT, BELOW, ABOVE = 20.0, 12.0, 5.0
"""Room for the scales around it."""
LETTERS = 3.4
COLOURS = ("#6b7680", "#b4491f", "#1f5fb4", "#1c6e3d", "#8a4fae")
DASHES = ("2 1.2", None, None, "4 1.5", "1 1")
"""By line: the first is what the drawing does."""
TICKS = 5
QUARTER = 90.0
"""Of a turn, degrees: its scale is not in fives."""


def plot(curve: MadeCurve) -> str:
    """The lines over x as an ``<svg>`` element, zero always in sight."""
    values = np.concatenate([line[np.isfinite(line)] for line in curve.lines.values()])
    low, high = min(0.0, float(values.min())), max(0.0, float(values.max()))
    step = _step((high - low) or 1.0)
    low, high = step * np.floor(low / step), step * max(np.ceil(high / step), np.floor(low / step) + 1)
    x0, x1 = float(curve.x.min()), float(curve.x.max())  # an input may turn backwards

    def at(x: Array, y: Array) -> list[list[float]]:
        flat: list[list[float]] = np.column_stack(
            (WIDTH * (x - x0) / (x1 - x0), HEIGHT * (y - low) / (high - low))
        ).tolist()
        return flat

    layers = []
    for value in np.arange(low, high + step / 2, step).tolist():
        y = HEIGHT * (value - low) / (high - low)
        colour = "#14202b" if abs(value) < step / 2 else "#d5dbe0"
        across = f"M{svg.place(0, y)}H{svg.number(WIDTH)}"
        layers.append(svg.element("path", d=across, stroke=colour, stroke_width=0.25))
        words = f"{value:.6g}".replace("-", "−")
        layers.append(svg.text(-1.5, y - LETTERS / 3, words, LETTERS, text_anchor="end"))
    apart = QUARTER if 3 * QUARTER < x1 - x0 <= 4 * QUARTER else _step(x1 - x0)
    for value in np.arange(np.ceil(x0 / apart) * apart, x1 + apart / 100, apart).tolist():
        x = WIDTH * (value - x0) / (x1 - x0)
        up = f"M{svg.place(x, 0)}V{svg.number(-HEIGHT)}"
        layers.append(svg.element("path", d=up, stroke="#e8ecef", stroke_width=0.25))
        layers.append(svg.text(x, -1.5 * LETTERS, f"{value:.6g}", LETTERS, text_anchor="middle"))
    layers.append(svg.text(WIDTH / 2, -3 * LETTERS, curve.x_title, LETTERS, text_anchor="middle"))
    for number, (name, line) in enumerate(curve.lines.items()):
        seen = np.isfinite(line)
        look = {"stroke": COLOURS[number % len(COLOURS)], "stroke_dasharray": DASHES[number % len(DASHES)]}
        drawn = svg.path(at(curve.x[seen], line[seen]))
        layers.append(svg.element("path", d=drawn, fill="none", stroke_width=0.5, **look))
        x, y = 2 + number * WIDTH / len(curve.lines), HEIGHT + 2
        layers.append(svg.element("path", d=f"M{svg.place(x, y)}h8", stroke_width=0.8, **look))
        layers.append(svg.text(x + 10, y - LETTERS / 3, f"{name}, {curve.unit}", LETTERS))
    box = (-LEFT, -HEIGHT - ABOVE - 2, WIDTH + LEFT + 6, HEIGHT + ABOVE + BELOW + 2)
    return svg.picture("".join(layers), box, curve.title)


def _step(span: float) -> float:
    """A round step that divides a span into some."""
    power = 10.0 ** np.floor(np.log10(span / TICKS))
    return float(next(power * k for k in (1, 2, 5, 10) if span / (power * k) <= TICKS + 1))
