"""Draws the pictures of the documentation: ``python docs/pictures.py`` writes them anew."""

import math
from pathlib import Path

import numpy as np

from mechwright_cam.svg import path, place
from mechwright_elliptic_gears.family import EllipticGears

IMAGES = Path(__file__).parent / "images"
SAMPLE = 40
"""Of 361: gear 2 at 40 degrees, where the speed ratio is near 1 and the ellipses stand askew."""


def elliptic_pair() -> str:
    """Both gears of the example in mesh, with their pitch ellipses, foci and coupler."""
    family = EllipticGears()
    params = family.Params(bore=12)
    (part,) = family.parts(params)
    motion = family.solve(params, 361)
    a, e = params.semi_major, params.eccentricity
    t = np.linspace(0, math.tau, 121)
    ellipse = np.column_stack((a * np.cos(t) + a * e, a * math.sqrt(1 - e * e) * np.sin(t)))
    drawn, foci = [], []
    for instance, fill in zip(part.instances, ("#c9d6e3", "#e8d9bd"), strict=True):
        poses = motion.poses[instance.body]
        angle = math.atan2(poses.rotation[SAMPLE, 1, 0], poses.rotation[SAMPLE, 0, 0])
        x, y = poses.position[SAMPLE, :2]
        loops = part.outline.moved(x, y, angle).loops
        outline = "".join(path(loop.flatten(0.01), close=True) for loop in loops)
        drawn.append(f'<path d="{outline}" fill="{fill}" stroke="#22303c" stroke-width=".5"/>')
        turn = np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
        pitch = path(ellipse @ turn + (x, y), close=True)
        drawn.append(
            f'<path d="{pitch}" fill="none" stroke="#b3261e" stroke-width=".5" stroke-dasharray="3 1.5"/>'
        )
        foci += [np.array([x, y]), np.array([2 * a * e, 0]) @ turn + (x, y)]
    drawn.append(f'<path d="{path([foci[1], foci[3]])}" fill="none" stroke="#1b6e3c" stroke-width="1.2"/>')
    for at in foci:
        cx, cy = place(*at).split(",")
        drawn.append(f'<circle cx="{cx}" cy="{cy}" r="1.4" fill="#1b6e3c"/>')
    return "\n".join(
        [
            '<svg xmlns="http://www.w3.org/2000/svg" viewBox="-42 -68 198 146" width="720">',
            "<title>Two elliptic gears in mesh, their pitch ellipses, and the equivalent coupler</title>",
            *drawn,
            "</svg>\n",
        ]
    )


if __name__ == "__main__":
    IMAGES.mkdir(exist_ok=True)
    (IMAGES / "elliptic-pair.svg").write_text(elliptic_pair(), encoding="utf-8")
