"""The published planar five-bar as a machine of the family five-bar: its points, and its plan."""

import math
from pathlib import Path

import numpy as np

from mechwright.arrays import Array
from mechwright.designs.design import load
from mechwright.output.svg import path as polyline
from mechwright.plugins.host import host
from mechwright_five_bar.defaults.complete_parameters import CompleteParams
from mechwright_five_bar.kinematics.dimensions import bar_of
from mechwright_five_bar.kinematics.phases import in_phase
from mechwright_five_bar.kinematics.train import gear_outlines
from mechwright_five_bar.parts.frames import frames_of
from mechwright_five_bar.table import FiveBarTable
from mechwright_spherical.defaults import published_example

EXAMPLE = Path(__file__).parents[2] / "examples" / "five-bar-published.toml"
UNIT = 100.0
"""mm of the machine for one length of the source."""

COLOURS = {
    "ground": "#9aa3ab", "pinion": "#a8695c", "idler": "#8a8578", "wheel": "#a8894c", "crank": "#b3261e",
    "arm": "#8a5a00", "rocker": "#1b6e3c", "coupler": "#2456a6",
}  # fmt: skip


def machine(phase: int) -> CompleteParams:
    """The example, with a phase shown as its first."""
    params = load(EXAMPLE, host()).params
    assert isinstance(params, CompleteParams)  # noqa: S101 - the file says so
    return in_phase(params.model_copy(update={"phase": phase}))


def reached() -> Array:
    """The seven points (7, 2) of Table 2 as the machine has them, in lengths of the source."""
    found = []
    for phase, turns in ((1, published_example.ANGLES), (2, published_example.ANGLES_N)):
        shown = machine(phase)
        solution = bar_of(shown).at(np.radians((shown.setting_angle or 0.0) + np.array(turns)))
        place = solution.bodies["coupler"].point(shown.coupler_point).position
        found.append((place + complex(shown.pivot_x, shown.pivot_y)) / UNIT)
    whole = np.concatenate(found)
    return np.column_stack([whole.real, whole.imag])


def plan() -> str:
    """Figure 10 as a drawing: all plates and gears from above, in the pose of setting, phase 1."""
    params = machine(1)
    table = FiveBarTable.of(params)
    layout = table.layout
    poses = frames_of(table, table.bar.at(math.radians(params.setting_angle or 0.0)).bodies)
    drawn, corners = [], []
    gears = gear_outlines(params)
    for name, colour in COLOURS.items():
        if name not in layout.outlines:
            continue
        outline = layout.outlines[name]
        at = poses["crank" if name == "pinion" else name]
        for loop in (gears.get(name, outline.outer), *outline.inner):
            flat = np.asarray(loop.flatten(0.05))
            flat = np.column_stack([flat, np.zeros(len(flat))])
            placed = at.transform(np.vstack([flat, flat[:1]]))[0, :, :2]
            corners.append(placed)
            drawn.append(f'<path d="{polyline(placed.tolist())}" fill="none" stroke="{colour}"/>')
    whole = np.concatenate(corners)
    x, y, wide, high = *whole.min(axis=0), *np.ptp(whole, axis=0)
    box = f"{x - 5:.1f} {-y - high - 5:.1f} {wide + 10:.1f} {high + 10:.1f}"
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}" width="760" stroke-width="0.6">',
            "<title>The published five-bar as a machine, seen from above</title>",
            *drawn,
            "</svg>\n",
        ]
    )
