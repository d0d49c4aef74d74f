"""A part as made seen from above, its deviation drawn many times larger."""

import math

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright.contracts.made_part import MadePart, MadeRing
from mechwright.output import svg
from mechwright.tolerances import TOLERANCES

HIGH = 0.025
"""The largest deviation, corridor included, as a share of the part's larger side."""
DETAIL = 1 / 3000
"""Chord error of what is drawn, as a share of it."""
PART, BAND, MADE = "#e8ecef", "#f2c14e", "#b4491f"
"""Part, corridor of the path, wall as made."""


def exaggeration(part: MadePart, size: float) -> float:
    """How many times larger than they are deviations are drawn: 1, 2 or 5 times a power of ten."""
    largest = max(float(np.abs(part.off).max(initial=0.0)) + part.corridor, TOLERANCES.arc_fit / 2)
    wanted = HIGH * size / largest
    power = 10.0 ** math.floor(math.log10(wanted))
    return power * max(step for step in (1, 2, 5) if step * power <= wanted * (1 + 1e-9))


def as_made_picture(part: MadePart) -> str:
    """The part as an ``<svg>`` element, with a bar that tells the scale of the deviations."""
    rings = [ring for section in (*part.sections, *part.underside) for ring in section.rings]
    every = np.concatenate([ring.points for ring in rings])
    (x0, y0), (x1, y1) = every.min(axis=0).tolist(), every.max(axis=0).tolist()
    size = max(x1 - x0, y1 - y0)
    factor, line = exaggeration(part, size), size / 500
    detail = DETAIL * size
    target = "".join(_path(ring.planned, detail) for ring in part.outline.rings)
    layers = [svg.element("path", d=target, fill=PART, fill_rule="evenodd", stroke="none")]
    for ring in rings:
        most, least = (_drawn(ring, factor, sign * part.corridor) for sign in (1, -1))
        band = _path(most, detail) + _path(least, detail)
        layers.append(svg.element("path", d=band, fill=BAND, fill_rule="evenodd", stroke="none"))
        look = {"fill": "none", "stroke_width": line}
        layers.append(svg.element("path", d=_path(ring.planned, detail), stroke="#14202b", **look))
        made = _path(_drawn(ring, factor, 0.0), detail)
        layers.append(svg.element("path", d=made, stroke=MADE, **look))
    for one in part.witnesses:
        x, y = one.at
        layers.append(
            svg.element(
                "circle", cx=x, cy=-y, r=4 * line, fill="none", stroke="#1f5fb4", stroke_width=1.5 * line
            )
        )
    letters = 0.03 * size
    layers.append(_bar(x0, y0 - 2.2 * letters, factor, letters, size))
    margin = 2 * HIGH * size
    box = (x0 - margin, -y1 - margin, x1 - x0 + 2 * margin, y1 - y0 + 2 * margin + 2 * letters)
    return svg.picture("".join(layers), box, f"{part.label} as made")


def _drawn(ring: MadeRing, factor: float, more: float) -> Array:
    points: Array = ring.planned + factor * (ring.off + more)[:, None] * ring.outward
    return points


def _path(points: Array, detail: float) -> str:
    line = shapely.simplify(shapely.LineString(np.concatenate((points, points[:1]))), detail)
    return svg.path(shapely.get_coordinates(line)[:-1].tolist(), close=True)


def _bar(x: float, y: float, factor: float, letters: float, size: float) -> str:
    """A bar as long as a round number of micrometres is drawn."""
    length = next(um for um in (50, 20, 10, 5, 2, 1, 0.5, 0.2, 0.1) if um * 1e-3 * factor <= 0.12 * size)
    end = x + length * 1e-3 * factor
    tick = svg.number(letters / 2)
    bar = f"M{svg.place(x, y)}v-{tick}v{tick}H{svg.number(end)}v-{tick}"
    line = svg.element("path", d=bar, fill="none", stroke="#14202b", stroke_width=letters / 9)
    words = f"{length:g} µm; deviations drawn {factor:,.0f} : 1".replace(",", " ")
    return line + svg.text(end + letters / 2, y, words, letters)
