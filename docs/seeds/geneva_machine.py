"""The published Geneva machine as ours: figures 16 to 20, from ``examples/geneva-machine.toml``.

The source shows its machine in pictures without sizes. Front views have the mechanism alone, without the
plate above it; top and side have every body by its extent, far ones first.
"""

import math
from functools import cache
from pathlib import Path

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.motion import Motion
from mechwright.contracts.part import Part, Pocket
from mechwright.designs.design import Design, load
from mechwright.machine.frame.sweep import layers_of
from mechwright.output.svg import path as polyline
from mechwright.plugins.host import host
from mechwright_geneva.parameters import GenevaParams

EXAMPLE = Path(__file__).parents[2] / "examples" / "geneva-machine.toml"
COLOURS = {
    "wheel": "#8fb0d6", "locking-disc": "#e2a79f", "crank": "#c9675c", "roller": "#e8c873",
    "motor": "#9aa3ab",
    "base-plate": "#c8cdd2", "lower-plate": "#c8cdd2", "upper-plate": "#c8cdd2", "motor-plate": "#c8cdd2",
}  # fmt: skip
FRONT = ("wheel", "locking-disc", "crank", "roller")
PLAIN = "#e4e7ea"
"""Of what is turned or bought, the motor apart."""

SHARE = {"start": 0.0, "middle": 0.5, "end": 1.0}
"""Of the stroke, in figures 16, 17 and 18."""


@cache
def machine() -> tuple[Design, tuple[Part, ...]]:
    """The example and its parts."""
    design = load(EXAMPLE, host())
    return design, tuple(design.parts())


@cache
def _motion(share: float) -> tuple[Motion, int]:
    """The motion, and the sample next to a share of the stroke."""
    motion = machine()[0].solve(721)
    theta = motion.channels["theta_d"].values
    params = machine()[0].params
    assert isinstance(params, GenevaParams)  # noqa: S101 - the file says so
    stroke = 2 * math.radians(params.crank_half_angle or 0.0)
    return motion, int(np.abs(theta - share * stroke).argmin())


def front(share: float) -> str:
    """Wheel, locking disc, crank and roller along their axes."""
    motion, sample = _motion(share)
    drawn, corners = [], []
    parts = {part.name: part for part in machine()[1]}
    for name in FRONT:
        part = parts[name]
        for at in part.instances:
            pose = motion.poses[at.body]
            loops = (
                [np.asarray(loop.flatten(0.1)) for loop in (part.outline.outer, *part.outline.inner)]
                if part.outline is not None
                else [max((points for points, _, _ in layers_of(part)), key=np.ptp)]
            )
            words = []
            for loop in loops:
                flat = np.column_stack([loop, np.zeros(len(loop))])
                placed = pose.transform(np.vstack([flat, flat[:1]]))[sample, :, :2]
                corners.append(placed)
                words.append(polyline(placed.tolist()))
            drawn.append(f'<path d="{" ".join(words)}" fill="{COLOURS[name]}" fill-rule="evenodd"/>')
            for groove in (one.boundary for one in part.features if isinstance(one, Pocket)):
                points = np.asarray(groove.flatten(0.02))
                flat = np.column_stack([points, np.zeros(len(points))])
                placed = pose.transform(np.vstack([flat, flat[:1]]))[sample, :, :2]
                drawn.append(f'<path d="{polyline(placed.tolist())}" fill="#6f93bd"/>')
    return _picture(np.concatenate(corners), drawn, "the Geneva machine along its axes")


def side(across: int) -> str:
    """Every body from the side: ``across`` 0 for x, as from in front of the base, 1 for y."""
    motion, sample = _motion(0.0)
    found = []
    for part in machine()[1]:
        for at in part.instances:
            pose = motion.poses[at.body]
            for points, low, high in layers_of(part):
                ends = np.array([(*point, at.z + z) for point in points for z in (low, high)])
                placed = pose.transform(ends)[sample]
                seen = placed[:, [across, 2]]
                (x0, z0), (x1, z1) = seen.min(axis=0).tolist(), seen.max(axis=0).tolist()
                depth = float(np.mean(placed[:, 1 - across]))
                found.append((depth if across else -depth, part.name, x0, x1, z0, z1))
    drawn = [
        f'<rect x="{x0:.2f}" y="{-z1:.2f}" width="{x1 - x0:.2f}" height="{z1 - z0:.2f}" '
        f'fill="{COLOURS.get(name, PLAIN)}"/>'
        for _, name, x0, x1, z0, z1 in sorted(found)
    ]
    whole = np.array([end for _, _, x0, x1, z0, z1 in found for end in ((x0, z0), (x1, z1))])
    return _picture(whole, drawn, "the Geneva machine from the side")


def _picture(points: Array, drawn: list[str], title: str) -> str:
    (x, y), (wide, high) = points.min(axis=0).tolist(), np.ptp(points, axis=0).tolist()
    box = f"{x - 5:.1f} {-y - high - 5:.1f} {wide + 10:.1f} {high + 10:.1f}"
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}" width="420" stroke="#22303c"'
    return "\n".join([f'{head} stroke-width="0.5">', f"<title>{title}</title>", *drawn, "</svg>\n"])


def drawn() -> dict[str, str]:
    """Picture to its content."""
    found = {f"geneva-machine-{name}.svg": front(share) for name, share in SHARE.items()}
    return {**found, "geneva-machine-side.svg": side(0), "geneva-machine-end-on.svg": side(1)}
