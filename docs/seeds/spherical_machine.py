"""The published five-bar as a machine on the sphere: its points in both settings, and figure 13."""

import math
from pathlib import Path

import numpy as np

from mechwright.arrays import Array
from mechwright.designs.design import load
from mechwright.output.svg import path as polyline
from mechwright.plugins.host import host
from mechwright_spherical.defaults import published_example
from mechwright_spherical.kinematics.linkage import Linkage, linkage_of
from mechwright_spherical.kinematics.vectors import cross, vector
from mechwright_spherical.parameters import SphericalParams
from mechwright_spherical.parts.seats import clamp_of, seats_of, slotted_of

EXAMPLE = Path(__file__).parents[2] / "examples" / "spherical-five-bar-refined.toml"
COLOURS = ("#2456a6", "#b3261e")
"""Of the phases."""

SCALE = 300.0
"""mm of the picture per radius."""


def design() -> SphericalParams:
    """The example."""
    params = load(EXAMPLE, host()).params
    assert isinstance(params, SphericalParams)  # noqa: S101 - the file says so
    return params


def machine() -> Linkage:
    """Its linkage, with both phases."""
    return linkage_of(design())


def reached() -> Array:
    """Points (7, 3) of the unit sphere that the machine passes at the printed crank angles."""
    both = zip(machine().phases, (published_example.ANGLES, published_example.ANGLES_N), strict=True)
    return np.concatenate([phase.loop.position(np.radians(angles)).T for phase, angles in both])


def setting() -> str:
    """How it is set, in words."""
    params, seats = design(), seats_of(machine())
    turns = [math.degrees(seat.angles[1]) for seat in seats]
    clamp = clamp_of(params)
    held = "" if clamp is None else f", both clamped in slots by screws M{clamp.size.size:g}"
    assert slotted_of(params) == ("a", "c")  # noqa: S101 - what the words say
    return f"its crank is turned by {turns[0]:.4f}° and its rocker by {turns[1]:.4f}°{held}"


def figure() -> str:
    """Figure 13: both phases in the pose of setting, seen from outside along the middle of the pins."""
    linkage = machine()
    loop = linkage.phases[0].loop
    seats = seats_of(linkage)
    pins = [loop.a0, loop.b0, *(place for seat in seats for place in seat.places)]
    middle = vector(np.sum(pins, axis=0))
    across = vector(loop.b0 - middle * float(middle @ loop.b0) - (loop.a0 - middle * float(middle @ loop.a0)))
    axes = np.stack([across, cross(middle, across)])
    drawn, labels = [], []

    def flat(points: Array) -> Array:
        return np.asarray(SCALE * (axes @ points))

    def line(points: Array, style: str) -> None:
        drawn.append(f'<path d="{polyline(zip(*flat(points), strict=True))}" {style}/>')

    number = 0
    for phase, colour, angles in zip(
        linkage.phases, COLOURS, (published_example.ANGLES, published_example.ANGLES_N), strict=True
    ):
        state = phase.at_reference
        a, b, c, p = (getattr(state, name)[0][:, 0] for name in "abcp")
        for one, two in ((loop.a0, a), (a, c), (a, p), (c, p), (c, b), (b, loop.b0)):
            line(_great(one, two), f'class="link" stroke="{colour}"')
        line(phase.state(121).p[0], f'class="path" stroke="{colour}"')
        for x, y in flat(phase.loop.position(np.radians(angles))).T:
            number += 1
            drawn.append(f'<circle cx="{x:.2f}" cy="{-y:.2f}" r="1" fill="{colour}"/>')
            away = -5.5 if phase.number == 2 else 1.8
            labels.append(f'<text x="{x + away:.2f}" y="{-y - 1.4:.2f}" fill="{colour}">p{number}</text>')
    for seat in seats:
        line(seat.points(), 'class="slot"')
    names = {"a0": loop.a0, "b0": loop.b0, "b1": loop.b1}
    for seat in seats:
        names |= {f"{seat.name}1": seat.places[0], f"{seat.name}1n": seat.places[1]}
    for name, pin in names.items():
        x, y = flat(pin)
        drawn.append(f'<circle cx="{x:.2f}" cy="{-y:.2f}" r="1.2" class="pin"/>')
        labels.append(f'<text x="{x + 2:.2f}" y="{-y + 4:.2f}">{name}</text>')
    whole = flat(np.stack([*pins, loop.b1, *reached()], axis=1))
    low, high = whole.min(axis=1) - 12, whole.max(axis=1) + 12
    box = f"{low[0]:.1f} {-high[1]:.1f} {high[0] - low[0]:.1f} {high[1] - low[1]:.1f}"
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}" '
            'width="760" font-family="sans-serif" font-size="3.6">',
            "<title>Both phases on the sphere in the pose of setting</title>",
            "<style>.link{stroke-width:.8;fill:none}.path{stroke-width:.5;stroke-dasharray:2 1;fill:none}"
            ".slot{stroke:#22303c;stroke-width:1.6;fill:none;opacity:.35}"
            ".pin{fill:#fff;stroke:#22303c;stroke-width:.5}</style>",
            *drawn,
            *labels,
            "</svg>\n",
        ]
    )


def _great(one: Array, two: Array) -> Array:
    """Points (3, n) of a great circle's arc."""
    shares = np.linspace(0, 1, 31)
    found = np.outer(one, 1 - shares) + np.outer(two, shares)
    return np.asarray(found / np.linalg.norm(found, axis=0))
