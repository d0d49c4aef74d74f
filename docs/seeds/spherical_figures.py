"""The figures of the published adjustable linkages, drawn from the code: pictures as SVG, by file name."""

import json
import math
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
from planar_machine import plan
from spherical_machine import figure

from mechwright.arrays import Array
from mechwright.mechanics.adjustable import Pins, PlaneSpace, follow, settings_of
from mechwright.output.svg import path as polyline
from mechwright_spherical.defaults import published_example
from mechwright_spherical.synthesis.planar import points
from mechwright_spherical.synthesis.structural import PlanarDesign, errors

ROOT = Path(__file__).parents[2]
PLANE = PlaneSpace(0j)
MOVING = (2, 3, 4, 6, 7)
"""Positions with an error; 1 and 5 are met by construction."""

COLOURS = ("#2456a6", "#b3261e", "#1b6e3c", "#8a5a00", "#7a8794")
"""Of phases, and of positions."""

CHOSEN = 5.0
"""Projection length of the source's tables."""

WIDTH, HEIGHT, LONGEST = 150.0, 70.0, 22.0
"""Size of a chart's axes, mm, and the greatest d of the source's axis."""


def four_bar() -> tuple[Pins, float, list[Array], list[Array]]:
    """A four-bar of figure 2 (a) with our own numbers: pins, ratio, crank angles and points of two phases."""
    facts = json.loads((ROOT / "tests" / "data" / "adjustable.json").read_text(encoding="utf-8"))["facts"]
    fact = next(one for one in facts if one["name"] == "adjust.planar4.two.points")
    design, angles = np.array(fact["inputs"]["design"]), fact["inputs"]["crank_deg"]
    a0, b0 = design[:, 0] + 1j * design[:, 1], design[:, 2] + 1j * design[:, 3]
    r1, r3, length, px, py = design[:, 4:].T
    a = a0 + r1 * np.exp(1j * np.radians([row[0] for row in angles]))
    c, _ = PLANE.third(a, b0, length, r3, np.ones(2))
    pins = Pins(a0, a, b0, b0, c, a + (px + 1j * py) * (c - a) / length)
    theta = [np.radians(np.array(row)[:4] - row[0]) for row in angles]
    return pins, 0.0, theta, [np.array([complex(*p) for p in row[:4]]) for row in fact["expected"]]


def five_bar() -> tuple[Pins, float, list[Array], list[Array]]:
    """The published five-bar of figures 2 (b) and 10, from the printed pins."""
    pin = {name: complex(points(at)) for name, at in published_example.PINS.items()}
    both = [(pin["a0"], pin["a0"]), (pin["a1"], pin["a1n"]), (pin["b0"], pin["b0"]), (pin["b1"], pin["b1"])]
    first = complex(points(published_example.TABLE_2[0]))
    pins = Pins(*(np.array(pair) for pair in (*both, (pin["c1"], pin["c1n"]), (first, first))))
    wanted = points(np.array(published_example.TABLE_2))
    theta = [np.radians(published_example.ANGLES), np.radians(published_example.ANGLES_N)]
    return pins, published_example.RATIO, theta, [wanted[:4], wanted[4:]]


def overlay(pins: Pins, ratio: float, theta: Sequence[Array], wanted: Sequence[Array], turn: bool) -> str:
    """Both phases in the pose of setting, their paths, their points with numbers, and the arcs of setting."""
    marks = np.concatenate([*wanted, *(getattr(pins, name) for name in Pins.__slots__)])
    size = float(max(np.ptp(marks.real), np.ptp(marks.imag)))
    scale = WIDTH / size / 1.5
    drawn, labels, number = [], [], 0

    def line(z: Array, style: str) -> None:
        drawn.append(f'<path d="{polyline(zip(z.real * scale, z.imag * scale, strict=True))}" {style}/>')

    for k, (angles, through) in enumerate(zip(theta, wanted, strict=True)):
        one, colour = pins.of(k), COLOURS[k]
        sweep = np.linspace(0, math.tau, 721) if turn else np.linspace(angles[0], angles[-1], 121)
        curve, cosine = follow(PLANE, pins.of(np.full(sweep.size, k)), ratio, sweep)
        line(np.where(np.abs(cosine) <= 1, curve, np.nan), f'class="path" stroke="{colour}"')
        line(np.array([one.a0, one.a, one.p, one.c, one.a]), f'class="link" stroke="{colour}"')
        line(np.array([one.c, one.b1, one.b0]), f'class="link" stroke="{colour}"')
        for z in through:
            number += 1
            x, y = z.real * scale, z.imag * scale
            drawn.append(f'<circle cx="{x:.2f}" cy="{-y:.2f}" r="1" fill="{colour}"/>')
            away = -5.0 if k else 1.8
            labels.append(f'<text x="{x + away:.2f}" y="{-y - 1.2:.2f}" fill="{colour}">p{number}</text>')
    settings = settings_of(PLANE, pins)
    for centre, start, angle in (
        (pins.a0[0], pins.a[0], settings.crank[1]),
        (pins.b1[0], pins.c[0], settings.follower[1]),
    ):
        line(PLANE.turn(centre, np.linspace(0, angle, 41), start), 'class="slot"')
    names = {"a0": pins.a0[0], "b0": pins.b0[0], "a1": pins.a[0], "a1n": pins.a[1]}
    end = "c" if ratio else "b"
    names |= {f"{end}1": pins.c[0], f"{end}1n": pins.c[1]} | ({"b1": pins.b1[0]} if ratio else {})
    for name, z in names.items():
        x, y = z.real * scale, z.imag * scale
        drawn.append(f'<circle cx="{x:.2f}" cy="{-y:.2f}" r="1.2" class="pin"/>')
        labels.append(f'<text x="{x + 2:.2f}" y="{-y + 4:.2f}">{name}</text>')
    low, high = marks.real.min() * scale - 16, marks.imag.max() * scale + 10
    box = f"{low:.1f} {-high:.1f} {size * scale + 40:.1f} {np.ptp(marks.imag) * scale + 22:.1f}"
    return _svg(box, "Both phases in the pose of setting", [*drawn, *labels])


def section() -> str:
    """The section of the projection in the plane y = 0: points of two planes, rays, and the sphere."""
    places, radius = np.linspace(0.0, 2.0, 5), 1.0
    drawn = []
    circle = radius * np.exp(1j * np.linspace(0, math.pi / 2, 61))
    scale = 30.0

    def line(z: Array, style: str) -> None:
        drawn.append(f'<path d="{polyline(zip(z.real * scale, z.imag * scale, strict=True))}" {style}/>')

    line(circle, 'class="link" stroke="#22303c"')
    for length, colour in ((1.5, COLOURS[0]), (3.0, COLOURS[1])):
        line(np.array([1j * length, places[-1] + 1j * length]), f'class="link" stroke="{colour}"')
        for x in places:
            seen = x + 1j * length
            line(np.array([0j, seen]), f'class="ray" stroke="{colour}"')
            hit = radius * seen / abs(seen) * scale
            drawn.append(f'<circle cx="{hit.real:.2f}" cy="{-hit.imag:.2f}" r=".9" fill="{colour}"/>')
        text = f'<text x="{places[-1] * scale + 3:.1f}" y="{-length * scale + 1:.1f}" fill="{colour}">'
        drawn.append(f"{text}d = {length:g}</text>")
    return _svg(f"-8 {-3.2 * scale:g} {2.8 * scale:g} {3.4 * scale:g}", "Projection, section y = 0", drawn)


def chart(design: PlanarDesign, positions: Sequence[int], top: float) -> str:
    """Error times d over d for some positions, with a mark at the chosen length."""
    lengths = np.linspace(0.05, LONGEST, 440)
    values = errors(design, lengths) * lengths[:, None]
    chosen = errors(design, CHOSEN) * CHOSEN
    sx, sy, drawn = WIDTH / LONGEST, HEIGHT / top, []
    for x in range(0, 23, 2):
        drawn.append(f'<path d="{polyline([(x * sx, 0), (x * sx, HEIGHT)])}" class="grid"/>')
        drawn.append(f'<text x="{x * sx:.2f}" y="5" text-anchor="middle">{x}</text>')
    for step in range(7):
        y = top * step / 6
        drawn.append(f'<path d="{polyline([(0, y * sy), (WIDTH, y * sy)])}" class="grid"/>')
        drawn.append(f'<text x="-2" y="{1.2 - y * sy:.2f}" text-anchor="end">{y:.3f}</text>')
    for n, colour in zip(positions, COLOURS, strict=False):
        line = polyline(zip(lengths * sx, values[:, n - 1] * sy, strict=True))
        drawn.append(f'<path d="{line}" fill="none" stroke="{colour}" stroke-width=".7"/>')
        drawn.append(
            f'<circle cx="{CHOSEN * sx:.2f}" cy="{-chosen[n - 1] * sy:.2f}" r="1.2" fill="{colour}"/>'
        )
        y = HEIGHT - 8 - 6 * list(positions).index(n)
        text = f'<text x="{0.7 * WIDTH:g}" y="{-y:g}" fill="{colour}">'
        drawn.append(f"{text}position {n}: {chosen[n - 1]:.5f} at d = {CHOSEN:g}</text>")
    drawn.append(f'<text x="{WIDTH / 2:g}" y="11" text-anchor="middle">projection length d</text>')
    drawn.append(
        f'<text transform="translate(-14,{-HEIGHT / 2:g}) rotate(-90)" text-anchor="middle">error × d</text>'
    )
    box = f"-18 {-HEIGHT - 4:g} {WIDTH + 24:g} {HEIGHT + 18:g}"
    return _svg(box, "Structural error times the projection length", drawn)


def _svg(box: str, title: str, drawn: Sequence[str]) -> str:
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}" '
            'width="760" font-family="sans-serif" font-size="3.6">',
            f"<title>{title}</title>",
            "<style>.grid{stroke:#c8d0d8;stroke-width:.2;fill:none}.link{stroke-width:.8;fill:none}"
            ".path{stroke-width:.4;stroke-dasharray:2 1;fill:none}.ray{stroke-width:.25;fill:none}"
            ".slot{stroke:#22303c;stroke-width:1.6;fill:none;opacity:.35}"
            ".pin{fill:#fff;stroke:#22303c;stroke-width:.5}</style>",
            *drawn,
            "</svg>\n",
        ]
    )


def pictures(design: PlanarDesign) -> dict[str, Callable[[], str]]:
    """Pictures by their file names."""
    return {
        "spherical-figure-2a.svg": lambda: overlay(*four_bar(), turn=True),
        "spherical-figure-2b.svg": lambda: overlay(*five_bar(), turn=False),
        "spherical-figure-10.svg": plan,
        "spherical-figure-7.svg": section,
        "spherical-figure-11.svg": lambda: chart(design, (2, 3, 4), 0.12),
        "spherical-figure-12.svg": lambda: chart(design, (6, 7), 0.042),
        "spherical-figure-13.svg": figure,
        "spherical-structural-error.svg": lambda: chart(design, MOVING, 0.12),
    }


FIGURES = """
1 | five-bar as a tooling mechanism, tool on the coupler | figure 10 below; on the sphere
`examples/spherical-five-bar-refined.toml`

2 (a) | four-bar, a1, a1n, b1, b1n, points p1 to p8, p5 = p1; no numbers | below, with points of ours;
`examples/four-bar-slots.toml`, on the sphere `examples/spherical-four-bar-slots.toml`

2 (b) | five-bar, a1, a1n, c1, c1n, b1 kept | below, from the printed pins; three phases:
`examples/five-bar-three-phases.toml`

3, 5 | spherical 4R linkage; Infinity Fan, a 4R that carries a body, without numbers | `kind = "four-bar"`

4 | Agile Eye | none: it has three degrees of freedom

6, 7 | the projection in space, and its section | below, with two lengths

8 | lost: displacement of a dyad | Planar synthesis

9 | driving angles, unknowns, first guesses, results | Planar synthesis

Table 1 | lost: prescribed points and coupler angles | angles of Table 2

10, Table 2 | planar five-bar, seven points, 2:1 gears | below:
`examples/five-bar-published.toml`, with its gears

11 | lost: structural error of another position | below: all positions of phase 1

12 | structural error times d of position 7, axis to 0.040 | below: all positions of phase 2

13, Tables 3, 4 | spherical mechanism, pins and points | below; `examples/spherical-five-bar-refined.toml`,
one machine for both phases; the gap of R3 is 0.1403°
"""
"""Figure, what the source has, and what answers it here; blocks that a blank line parts."""

CAPTIONS = {
    "spherical-figure-2a.svg": "Figure 2 (a): two phases in the pose of setting p1 = p5, the arcs of setting "
    "about a0 and b0 in grey.",
    "spherical-figure-2b.svg": "Figures 2 (b) and 10: the published five-bar, with the arcs about a0 and b1.",
    "spherical-figure-10.svg": "Figure 10: the published five-bar as a machine, in the pose of setting; its "
    "gears have an idler, for crank and arm turn the same way.",
    "spherical-figure-7.svg": "Figure 7: the section y = 0 for two projection lengths.",
    "spherical-figure-11.svg": "Figure 11, as phase 1: error times d; d = 5 is marked. There is no minimum.",
    "spherical-figure-12.svg": "Figure 12, as phase 2: error times d; d = 5 is marked. There is no minimum.",
    "spherical-figure-13.svg": "Figure 13: the machine on the sphere in the pose of setting, both phases, "
    "the slots of its coupler in grey.",
}


def figure_lines() -> list[str]:
    """The section of the page that goes through the figures."""
    lines = ["## Figure by figure", "", "| figure | the source | here |", "| --- | --- | --- |"]
    lines += [f"| {' '.join(block.split())} |" for block in FIGURES.strip().split("\n\n")]
    for name, said in CAPTIONS.items():
        figure = said.partition(":")[0]
        lines += ["", f"![{figure}](../images/{name})", "", said]
    return [*lines, ""]
