"""Draws the charts of Q's speed and acceleration over a turn as the source has them.

Each chart has one phase angle and four eccentricities, up to 3,500 mm/s and 350,000 mm/s², where the source's
charts end. ``python docs/seeds/elliptic_charts.py`` writes the picture anew.
"""

import math
from pathlib import Path

import numpy as np

from mechwright import Array
from mechwright_elliptic_gears.kinematics.equations import Turning
from mechwright_elliptic_gears.kinematics.figures import coupled_gears
from mechwright_elliptic_gears.kinematics.point import point_of_coupler
from mechwright_elliptic_gears.parameters import REPORTED_PHASES

PICTURE = Path(__file__).parents[1] / "images" / "figure-eight-charts.svg"
COLOURS = {0.2: "#2f6fb0", 0.4: "#1b6e3c", 0.6: "#b3261e", 0.8: "#6b4fa0"}
"""Eccentricity to colour."""
WIDE, TALL, LEFT, ROW, GAP = 330, 120, 46, 160, 60
"""Sizes of a chart, and from one to the next, px."""
SIZES = {"speed": (3500.0, "v, mm/s"), "acceleration": (350.0, "a, 1000 mm/s²")}
SEMI_MAJOR, SPEED = 50.0, 10.0
"""mm, rad/s."""


def over_a_turn(phase: float, eccentricity: float) -> dict[str, Array]:
    """Speed, mm/s, and acceleration, 1000 mm/s², at each degree of gear 2; the phase is in degrees."""
    theta2 = np.radians(np.arange(361.0))
    gears = coupled_gears(Turning.of(theta2, SPEED), eccentricity, math.radians(phase))
    q = point_of_coupler(*gears, SEMI_MAJOR, eccentricity)
    return {"speed": q.speed, "acceleration": np.abs(q.acceleration) / 1000}


def charts() -> str:
    """The picture: a row for each phase, speed on the left and acceleration on the right."""
    drawn = []
    for row, phase in enumerate(REPORTED_PHASES):
        for column, (name, (top, title)) in enumerate(SIZES.items()):
            x0, y0 = LEFT + column * (WIDE + GAP), 24 + row * ROW
            lines = {e: over_a_turn(phase, e)[name] for e in COLOURS}
            drawn += _chart(x0, y0, top, f"γ = {phase:g}°: {title}", lines)
    keys = "".join(
        f'<text x="{LEFT + 90 * k}" y="12" fill="{colour}">e = {e}</text>'
        for k, (e, colour) in enumerate(COLOURS.items())
    )
    size = f"{LEFT + 2 * WIDE + GAP + 10} {24 + ROW * len(REPORTED_PHASES)}"
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {size}" '
            'font-family="sans-serif" font-size="10">',
            "<title>Speed and acceleration of Q over a turn of gear 2, for five phases and four "
            "eccentricities</title>",
            keys,
            *drawn,
            "</svg>\n",
        ]
    )


def _chart(x0: float, y0: float, top: float, title: str, lines: dict[float, Array]) -> list[str]:
    found = [f'<text x="{x0}" y="{y0 + 8}">{title}</text>']
    y0 += 14
    for k in range(8):
        y = y0 + TALL * (1 - k / 7)
        found.append(f'<path d="M{x0} {y:.1f}h{WIDE}" stroke="#bbb" stroke-width=".5"/>')
        if k in {0, 7}:
            found.append(f'<text x="{x0 - 4}" y="{y + 4:.1f}" text-anchor="end">{top * k / 7:g}</text>')
    for k in range(7):
        x = x0 + WIDE * k / math.tau
        found.append(f'<path d="M{x:.1f} {y0}v{TALL}" stroke="#bbb" stroke-width=".5"/>')
        found.append(f'<text x="{x:.1f}" y="{y0 + TALL + 11}" text-anchor="middle">{k}</text>')
    for e, values in lines.items():
        x, y = x0 + WIDE * np.arange(361) / 360, y0 + TALL * (1 - np.minimum(values, top) / top)
        points = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(x.tolist(), y.tolist(), strict=True))
        found.append(f'<polyline points="{points}" fill="none" stroke="{COLOURS[e]}"/>')
    return found


if __name__ == "__main__":
    PICTURE.write_text(charts(), encoding="utf-8")
