"""Draws the pictures of the documentation: ``python docs/pictures.py`` writes them anew."""

import math
from pathlib import Path

import numpy as np
from shapely import Polygon

from mechwright.contracts.part import Pocket
from mechwright.geometry import Loop
from mechwright.output.svg import path, place
from mechwright_elliptic_gears.family import EllipticGears
from mechwright_geneva.family import Geneva

IMAGES = Path(__file__).parent / "images"
SAMPLE = 40
"""Of 361: gear 2 at 40 degrees, where viewers without animation stop: the speed ratio is near 1."""

FRAME = 3
"""Of the samples every third is a frame, 3 degrees apart."""

LOOP = 'dur="8s" repeatCount="indefinite"'
"""A turn of gear 2."""

GENEVA_SAMPLE = 33
"""Of 361: the roller well inside a groove."""


def elliptic_pair() -> str:
    """Both gears of the example in mesh, turning, with their pitch ellipses, foci and coupler."""
    family = EllipticGears()
    params = family.Params(bore=12)
    (part,) = family.parts(params)
    motion = family.solve(params, 361)
    a, e = params.semi_major, params.eccentricity
    t = np.linspace(0, math.tau, 121)
    ellipse = np.column_stack((a * np.cos(t) + a * e, a * math.sqrt(1 - e * e) * np.sin(t)))
    outline = "".join(path(loop.flatten(0.01), close=True) for loop in part.outline.loops)
    dots = "".join(f'<circle cx="{x:g}" cy="0" r="1.4" fill="#1b6e3c"/>' for x in (0, 2 * a * e))
    drawn, ends = [], {}
    for number, (instance, fill) in enumerate(zip(part.instances, ("#c9d6e3", "#e8d9bd"), strict=True), 1):
        poses = motion.poses[instance.body]
        angles = np.unwrap(np.arctan2(poses.rotation[:, 1, 0], poses.rotation[:, 0, 0]))
        x, y = poses.position[SAMPLE, :2]
        foci = np.exp(1j * angles) * 2 * a * e + complex(x, y)
        ends |= {f"x{number}": foci.real, f"y{number}": -foci.imag}
        turns = ";".join(f"{value:.2f}" for value in -np.degrees(angles[::FRAME]))
        drawn.append(
            f'<g transform="translate({place(x, y)})">'
            f'<g transform="rotate({-math.degrees(angles[SAMPLE]):.2f})">'
            f'<animateTransform attributeName="transform" type="rotate" values="{turns}" {LOOP}/>'
            f'<use href="#gear" fill="{fill}"/><use href="#pitch"/>{dots}</g></g>'
        )
    line = " ".join(f'{name}="{values[SAMPLE]:.2f}"' for name, values in ends.items())
    moves = "".join(
        f'<animate attributeName="{name}" values="{";".join(f"{at:.2f}" for at in values[::FRAME])}" {LOOP}/>'
        for name, values in ends.items()
    )
    drawn.append(f'<line {line} stroke="#1b6e3c" stroke-width="1.2">{moves}</line>')
    return "\n".join(
        [
            '<svg xmlns="http://www.w3.org/2000/svg" viewBox="-78 -78 256 156" width="720">',
            "<title>Two elliptic gears in mesh, their pitch ellipses, and the equivalent coupler</title>",
            f'<defs><path id="gear" d="{outline}" fill-rule="evenodd" stroke="#22303c" stroke-width=".5"/>',
            f'<path id="pitch" d="{path(ellipse, close=True)}" fill="none" stroke="#b3261e" '
            'stroke-width=".5" stroke-dasharray="3 1.5"/></defs>',
            *drawn,
            "</svg>\n",
        ]
    )


def figure_eight() -> str:
    """The train of the example from above, at one position, with the path of Q and its constant part."""
    family = EllipticGears()
    params = family.Params(stages=2, bore=12, phase=90, speed=600 / math.tau, band=10)
    motion = family.solve(params, 361)
    window = {name: motion.scalars[f"Q.constant_speed_window.{name}"].value for name in ("start", "end")}
    drawn = []
    fills = {"gear-2": "#c9d6e3", "gear-3": "#d3e0cf", "gear-4": "#e8d9bd", "gear-5": "#d9cfe2"}
    plates = [part for part in family.parts(params) if part.outline is not None]
    outlines = {instance.body: part.outline for part in plates for instance in part.instances}
    for body, fill in {**fills, "coupler": "none"}.items():
        poses = motion.poses[body]
        angle = math.atan2(poses.rotation[SAMPLE, 1, 0], poses.rotation[SAMPLE, 0, 0])
        loops = outlines[body].moved(*poses.position[SAMPLE, :2], angle).loops
        data = "".join(path(loop.flatten(0.01), close=True) for loop in loops)
        colour, width = ("#b3261e", 1.0) if body == "coupler" else ("#22303c", 0.5)
        drawn.append(
            f'<path d="{data}" fill="{fill}" fill-rule="evenodd" stroke="{colour}" stroke-width="{width}"/>'
        )
    theta = motion.channels["theta2"].values
    trace = np.column_stack([motion.channels[name].values for name in ("Q.x", "Q.y")])
    steady = (theta >= window["start"]) & (theta <= window["end"])
    drawn += [
        f'<path d="{path(trace, close=True)}" fill="none" stroke="#1b6e3c" stroke-width=".7"/>',
        f'<path d="{path(trace[steady])}" fill="none" stroke="#1b6e3c" stroke-width="2.2"/>',
    ]
    cx, cy = place(*trace[SAMPLE]).split(",")
    drawn.append(f'<circle cx="{cx}" cy="{cy}" r="1.6" fill="#b3261e"/>')
    return "\n".join(
        [
            '<svg xmlns="http://www.w3.org/2000/svg" viewBox="-180 -90 360 170" width="900">',
            "<title>Four elliptic gears, their coupler, and the figure of eight of its middle; the thick "
            "part is run at a near-constant speed</title>",
            *drawn,
            "</svg>\n",
        ]
    )


def geneva() -> str:
    """The reference design at 33 degrees of the crank: grooves, roller, locking disc, crank."""
    family = Geneva()
    params = family.Params(lock_radius=70)
    motion = family.solve(params, 361)
    parts = {part.name: part for part in family.parts(params)}
    fills = {"wheel": "#e8d9bd", "locking-disc": "#c9d6e3", "crank": "#9fb6cf"}
    drawn = []
    for name, fill in fills.items():
        part = parts[name]
        poses = motion.poses[part.instances[0].body]
        angle = math.atan2(poses.rotation[GENEVA_SAMPLE, 1, 0], poses.rotation[GENEVA_SAMPLE, 0, 0])
        x, y = poses.position[GENEVA_SAMPLE, :2]
        loops = part.outline.moved(x, y, angle).loops
        data = "".join(path(loop.flatten(0.02), close=True) for loop in loops)
        opacity = ' fill-opacity=".75"' if name == "crank" else ""
        drawn.append(
            f'<path d="{data}" fill="{fill}" fill-rule="evenodd"{opacity} stroke="#234" stroke-width=".6"/>'
        )
        if name == "wheel":
            disc = Polygon(part.outline.outer.flatten())
            for pocket in (feature for feature in part.features if isinstance(feature, Pocket)):
                groove = Polygon(pocket.boundary.flatten(0.02)).intersection(disc)
                ring = Loop.polygon(list(groove.exterior.coords)[:-1]).moved(x, y, angle).flatten()
                drawn.append(
                    f'<path d="{path(ring, close=True)}" fill="#bfa878" stroke="#22303c" stroke-width=".4"/>'
                )
    cx, cy = place(*motion.poses["roller-1"].position[GENEVA_SAMPLE, :2]).split(",")
    drawn.append(f'<circle cx="{cx}" cy="{cy}" r="5" fill="none" stroke="#b3261e" stroke-width="1.2"/>')
    return "\n".join(
        [
            '<svg xmlns="http://www.w3.org/2000/svg" viewBox="-108 -108 314 216" width="720">',
            "<title>A Geneva wheel with curved grooves, its locking disc and its crank</title>",
            *drawn,
            "</svg>\n",
        ]
    )


PICTURES = {"elliptic-pair.svg": elliptic_pair, "figure-eight.svg": figure_eight, "geneva.svg": geneva}
"""File to what draws it."""


if __name__ == "__main__":
    IMAGES.mkdir(exist_ok=True)
    for name, draw in PICTURES.items():
        (IMAGES / name).write_text(draw(), encoding="utf-8")
