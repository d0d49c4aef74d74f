"""Compares the published adjustable spherical five-bar with the code.

``python docs/seeds/spherical.py`` writes the page and its picture anew.
"""

import math
import textwrap
from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import spherical_machine
from planar_machine import EXAMPLE, reached
from spherical_figures import MOVING, figure_lines, pictures
from spherical_source import TABLE_3, TABLE_4, PlanarFiveBar, asymptote, peak

from mechwright.arrays import Array
from mechwright.designs.design import load
from mechwright.plugins.host import host
from mechwright_spherical.defaults import published_example
from mechwright_spherical.kinematics.drive import external, internal
from mechwright_spherical.kinematics.five_bar import AdjustableFiveBar, projected
from mechwright_spherical.kinematics.projection import project
from mechwright_spherical.kinematics.vectors import arc
from mechwright_spherical.synthesis.planar import CouplerPoses, Dyad, crank_dyad, points, rocker_dyad
from mechwright_spherical.synthesis.planar import arm_pins as pins_of_arm
from mechwright_spherical.synthesis.refine import Fit, Freedom, errors, refine
from mechwright_spherical.synthesis.refine import Path as Wanted
from mechwright_spherical.synthesis.structural import (
    PlanarDesign,
    best_centre,
    scaled_error,
    smallest_length,
)
from mechwright_spherical.synthesis.structural import errors as structural_errors

HERE = Path(__file__).parent
PAGE = HERE / "spherical.md"
IMAGES = HERE.parent / "images"

ANGLES, ANGLES_N = np.radians(published_example.ANGLES), np.radians(published_example.ANGLES_N)
TABLE_2 = np.array(published_example.TABLE_2)
DESIGN = PlanarDesign(published_example.PINS, published_example.RATIO, ANGLES, ANGLES_N, TABLE_2)

PICTURES = pictures(DESIGN)
"""By file name: figures of the source, and the structural error of all positions."""

LENGTHS = (0.5, 0.75, 1, 1.5, 2, 3, 4, 5, 6, 8, 10, 12, 15, 20, 22)
"""Projection lengths of the table: those of the source's axis."""

TOLERANCES = (0.02, 0.01, 0.005, 0.002, 0.001)
EXACT = 1e-12
"""Errors below this are rounding, and differ from machine to machine."""


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> list[str]:
    """A table of Markdown."""
    lines = [head, ["---"] * len(head), *rows]
    return ["| " + " | ".join(line) + " |" for line in lines] + [""]


def paragraph(text: str) -> list[str]:
    """A paragraph in lines of the usual length."""
    return [textwrap.fill(" ".join(text.split()), 118, break_long_words=False, break_on_hyphens=False), ""]


def numbers(values: Iterable[float], digits: int = 4) -> str:
    """Coordinates in brackets."""
    return "(" + ", ".join(f"{round(value, digits) + 0.0:.{digits}f}" for value in values) + ")"


@cache
def planar() -> tuple[Array, Array]:
    """Path points (7,), complex, and coupler angles (7,) of the printed planar mechanism."""
    pin = {name: complex(points(at)) for name, at in published_example.PINS.items()}
    p1 = complex(points(published_example.TABLE_2[0]))
    found = [
        PlanarFiveBar(pin["a0"], pin[a], pin["b0"], pin["b1"], pin[c], p1, published_example.RATIO).at(angles)
        for a, c, angles in (("a1", "c1", ANGLES), ("a1n", "c1n", ANGLES_N))
    ]
    return np.concatenate([one[0] for one in found]), np.concatenate([one[1] for one in found])


def matches(found: Array, wanted: Array) -> int:
    """How many printed numbers are the rounded computed ones."""
    return int((np.round(found, 4) == np.asarray(wanted)).sum())


def mechanism(length: float) -> AdjustableFiveBar:
    """The printed mechanism, projected."""
    return projected(published_example.PINS, published_example.TABLE_2[0], length, published_example.RATIO)


def wanted(length: float) -> Wanted:
    """The projected path."""
    return Wanted(ANGLES, ANGLES_N, project(TABLE_2, length).T)


@cache
def fit(length: float, freedom: Freedom) -> Fit:
    """The fit that starts from the projected mechanism."""
    return refine(mechanism(length), wanted(length), freedom)[0]


def poses(path: Array) -> CouplerPoses:
    """The coupler's poses, with the model's angles."""
    turns = planar()[1]
    return CouplerPoses(path[:4], turns[:4], path[4:], turns[4:])


def dyads(path: Array, equations: str) -> tuple[Dyad, Dyad]:
    """Both dyads, from the source's first guesses."""
    data = poses(path)
    b0, b1 = (complex(points(published_example.PINS[name])) for name in ("b0", "b1"))
    arms = [pins_of_arm(b0, b1, published_example.RATIO, angles) for angles in (ANGLES, ANGLES_N)]
    return (
        crank_dyad(data, 0.0, 1.0, published_example.CRANK_GUESS, equations),
        rocker_dyad(data, arms[0], arms[1], published_example.DRIVEN_GUESS, equations),
    )


def path_tables() -> list[str]:
    """Tables 2 to 4, value by value."""
    built, second = reached(), load(EXAMPLE, host()).params.phases[0]
    found, turns = planar()[0].view(float).reshape(-1, 2), np.degrees(planar()[1])
    count = matches(found, published_example.TABLE_2)
    lines = [
        "## Table 2: path points of the planar mechanism",
        "",
        *paragraph(
            f"""**{count} of 14** printed numbers are the rounded ones of the model, from the printed pins.
            The other two differ by one unit in the last place, which the rounding of the pins explains. The
            last column is the machine `examples/five-bar-published.toml`, whose links have one R1 and one R3
            in both phases. Its coordinates differ from the printed ones by at most
            {np.abs(built - TABLE_2).max():.4f}. Phase 2 is set by turning its crank by
            {second.crank_turn:.4f}° and its rocker by {second.rocker_turn:.4f}°."""
        ),
        *table(
            ["position", "δθ", "printed", "computed", "difference", "coupler angle", "machine"],
            [
                [
                    f"{n + 1}, phase {1 if n < 4 else 2}",
                    f"{(*published_example.ANGLES, *published_example.ANGLES_N)[n]:g}°",
                    numbers(published_example.TABLE_2[n]),
                    numbers(found[n], 6),
                    f"{np.abs(found[n] - published_example.TABLE_2[n]).max():.6f}",
                    f"{round(turns[n], 4) + 0.0:.4f}°",
                    numbers(built[n], 4),
                ]
                for n in range(7)
            ],
        ),
    ]
    path, machine = project(TABLE_2, published_example.LENGTH), spherical_machine.reached()
    pins = {name: project(at, published_example.LENGTH) for name, at in published_example.PINS.items()}
    on_path = matches(path, TABLE_3)
    on_pins = sum(matches(pins[name], TABLE_4[name]) for name in pins)
    lines += [
        "## Tables 3 and 4: projected path points and pins",
        "",
        *paragraph(
            f"""Length and radius are not in the extract; only d = 5 and r = 1 give these digits.
            **{on_path + on_pins} of 42** agree: {on_path} of 21 path coordinates and {on_pins} of 21 pin
            coordinates. The last column is the machine `examples/spherical-five-bar-refined.toml`, with one
            R1 and one R3, at the printed crank angles. Its coordinates differ from the projected ones by
            {np.abs(machine - path).max():.6f} at most. For phase 2 {spherical_machine.setting()}."""
        ),
        *table(
            ["point", "printed", "computed", "machine"],
            [
                [
                    f"p{n + 1}",
                    numbers(TABLE_3[n]),
                    numbers(path[n], 6) + verdict(path[n], TABLE_3[n]),
                    numbers(machine[n], 6),
                ]
                for n in range(7)
            ]
            + [
                [name, numbers(TABLE_4[name]), numbers(at, 6) + verdict(at, TABLE_4[name]), "-"]
                for name, at in pins.items()
            ],
        ),
    ]
    return lines


def verdict(found: Array, wanted: Sequence[float]) -> str:
    """Which coordinates differ from the printed ones; empty where none does."""
    bad = [
        f" ({axis}: **{f:.4f}** for {w:.4f})"
        for axis, f, w in zip("xyz", found, wanted, strict=True)
        if round(float(f), 4) != w
    ]
    return "".join(bad)


def dyad_table() -> list[str]:
    """The planar synthesis in both forms."""
    exact, rounded = planar()[0], np.asarray(points(TABLE_2))
    printed_values = ((0.0004, 0.1219, 0.9930, -0.1344, 0.9913), (0.8913, 1.4542, 1.2167, 1.7775, 1.3016))
    rows = [["printed", numbers(printed_values[0]), "", numbers(printed_values[1]), ""]]
    for said, path in (("exact poses", exact), ("poses of Table 2", rounded)):
        for equations in ("five", "seven"):
            crank, rocker = dyads(path, equations)
            rows.append(
                [
                    f"{said}, {equations} equations",
                    numbers(crank.unknowns),
                    f"{crank.condition:.0f}",
                    numbers(rocker.unknowns),
                    f"{rocker.condition:.0f}",
                ]
            )
    return [
        "## Planar synthesis",
        "",
        *paragraph(
            """The search starts from the source's first guesses. The source writes five equations per dyad
            and omits the two positions of adjustment. With them there are seven, solved by least squares and
            better conditioned. Points of four decimals carry no digit of a0y."""
        ),
        *table(["", "a0y, a1, a1n", "condition", "c1, c1n, R3", "condition"], rows),
    ]


def error_tables() -> list[str]:
    """The structural error over the projection length."""
    rows = []
    for d in LENGTHS:
        found = structural_errors(DESIGN, d) * d
        rows.append([f"{d:g}", *(f"{found[n - 1]:.5f}" for n in MOVING), f"{np.sqrt(np.mean(found**2)):.5f}"])
    top, worst = peak(DESIGN, 7), peak(DESIGN)
    limits = asymptote(replace(DESIGN, targets=planar()[0].view(float).reshape(-1, 2)))
    smallest = [
        [
            f"{tolerance:g}",
            f"{smallest_length(DESIGN, tolerance, 7):.3f}",
            f"{smallest_length(DESIGN, tolerance):.3f}",
            f"{smallest_length(DESIGN, tolerance, best=True):.3f}",
        ]
        for tolerance in TOLERANCES
    ]
    said = ", ".join(f"{limits[n - 1]:.5f} ({n})" for n in MOVING)
    centres = []
    for d in (1.0, 2.0, 3.0, 5.0, 10.0):
        at, value = best_centre(DESIGN, d)
        there = float(scaled_error(DESIGN, d))
        centres.append(
            [f"{d:g}", numbers(at, 3), f"{there:.5f}", f"{value * d:.5f}", f"{there / value / d:.2f}"]
        )
    return [
        "## Structural error over the projection length",
        "",
        "Error times d is the error at the scale of the plane. Each phase has its own arcs.",
        "",
        "![Structural error times d over d](../images/spherical-structural-error.svg)",
        "",
        *table(["d", *(f"position {n}" for n in MOVING), "rms of all"], rows),
        *paragraph(
            f"""Position 7, which figure 12 shows, rises to {top[1]:.5f} at d = {top[0]:.4f} and then falls
            without end. Position 4 is the worst at every length: {worst[1]:.4f} at d = {worst[0]:.2f}.
            **There is no optimum**: for long projections the error times d goes with K/d², K = {said}. Each
            tolerance is met from a certain length on:"""
        ),
        *table(["tolerance", "position 7", "all positions", "all, with the best centre"], smallest),
        *paragraph(
            "The source puts the projection's centre on a0, a corner of the mechanism. Better centres:"
        ),
        *table(["d", "best centre", "worst error × d at (0, 0)", "at the best", "gain"], centres),
    ]


def lost_arcs() -> list[str]:
    """What the projection does to the lengths."""
    at = mechanism(published_example.LENGTH)
    (r1, r1n), (r3, r3n) = (
        [math.degrees(float(x)) for x in pair] for pair in (at.crank_arcs, at.rocker_arcs)
    )
    shafts = float(arc(at.a0, at.b0))
    ratio = published_example.RATIO
    cones = [math.degrees(x) for x in (*internal(shafts, ratio), *external(shafts, ratio))]
    target, mean = wanted(published_example.LENGTH), at.equalised()
    own, equal = (Fit(one, errors(one, target)).rms for one in (at, mean))
    slots = [math.degrees(float(x)) for x in (at.crank_setting, at.rocker_setting)]
    return [
        "## Lengths after the projection",
        "",
        *paragraph(
            f"""R1 is {r1:.4f}° in phase 1 and {r1n:.4f}° in phase 2; R3 is {r3:.4f}° and {r3n:.4f}°. The
            projected Table 4 therefore has no constant R3, although the planar mechanism has one. With the
            mean arcs the rms error at d = 5 is {equal:.4e} in place of {own:.4e}. The coupler's slots run
            about a0 over {slots[0]:.4f}° and about b1 over {slots[1]:.4f}°."""
        ),
        *paragraph(
            f"""The axes a0 and b0 meet at {math.degrees(shafts):.4f}°, so the "2:1 gear ratio" is a bevel
            drive. Both links turn the same way: an internal pair with pitch cones of {cones[0]:.4f}° and
            {cones[1]:.4f}°, or an external one ({cones[2]:.4f}° and {cones[3]:.4f}° if they touched) with an
            idler."""
        ),
    ]


def fits() -> list[str]:
    """The direct synthesis on the sphere."""
    rows = []
    for d in (1.0, 2.0, 3.0, 5.0, 8.0, 12.0):
        before = float(errors(mechanism(d), wanted(d)).max())
        six = float(fit(d, Freedom.SIX).errors.max())
        twelve = float(fit(d, Freedom.TWELVE).errors.max()) if d >= 3 else math.nan
        said = "" if math.isnan(twelve) else "below 1e-12" if twelve < EXACT else f"{twelve:.2e}"
        rows.append([f"{d:g}", f"{before:.3e}", f"{six:.3e}", f"{before / six:.0f}", said])
    best = fit(published_example.LENGTH, Freedom.SIX)
    pins = [
        [
            name,
            numbers(getattr(mechanism(published_example.LENGTH), name), 6),
            numbers(getattr(best.mechanism, name), 6),
        ]
        for name in ("a1", "a1n", "c1", "c1n")
    ]
    return [
        "## Direct synthesis on the sphere",
        "",
        *paragraph(
            """Six unknowns are R1, R3 and the azimuths of a1, a1n, c1, c1n, with a0, b0 and b1 as they are.
            R1 and R3 are common to both phases by construction. Twelve unknowns add the axes a0, b0 and the
            pin b1: two more than there are equations. Greatest errors on the unit sphere:"""
        ),
        *table(["d", "projected", "six unknowns", "times better", "twelve unknowns"], rows),
        *paragraph(
            f"""At d = 5 the six unknowns bring the rms error to {best.rms:.3e}. Twelve unknowns avoid the
            error of the projection, and with it the reason for a large d."""
        ),
        *table(["pin, d = 5", "projected", "six unknowns"], pins),
    ]


ERRATA = """## Errata of the source

1. Equation 4: the "2x y d" is √(x² + y² + d²) with detached exponents; there is no factor 2.
2. Equation 2: the condition d ≤ r contradicts the example (d = 5, r = 1) and is not needed.
3. Length and radius of the example are missing: 5 and 1.
4. Table 3, position 6: z is printed 0.9322; the projection of Table 2 gives 0.9323.
5. Table 3 is headed "prescribed" and holds the projection of the *achieved* points of Table 2.
6. "Five of the five unknowns in b1, c1 and c1n": b1 follows from b0, R4 and φ1; the unknowns are c1, c1n, R3.
7. Five equations omit both positions of adjustment; with them each dyad is over-determined by two.
8. R3 is printed as 1.3016; the pins of phase 2 give 1.3015, by rounding.
9. The projection loses the constant R3: *Lengths after the projection*.
10. "Optimised" d: the plotted quantity has no minimum, and its position is not the worst.
11. A "2:1 gear ratio" for two links that turn alike needs an internal pair or an idler; here, of bevels.
12. The introduction has 3 + 3 points (p1 p2 p3, p1 p4 p5), the example 4 + 3 with p5 = p1. p4 and p5 have
    two meanings.
13. Figure 2(a) shows a four-bar with b1 and b1n; the extract has no numbers of it.
14. Names of authors in the references look misspelt.
"""

INTRODUCTION = [
    "# The published spherical five-bar, and the code",
    "",
    "<!-- written by spherical.py in this folder; do not edit -->",
    "",
    *paragraph(
        """The source is a report on adjustable spherical five-bar path generators by projection. Only its
        odd pages survive: equations, prescribed points and results are missing. The code, run on the printed
        pins, confirms this reading. Crank a0-a1, coupler a1-c1 with the path point p, rocker c1-b1, and arm
        b0-b1, which gears turn with the crank by δφ = 0.5 δθ in the same sense. The machine is adjusted in
        position 1 = 5."""
    ),
]


def page() -> str:
    """The page."""
    lines = [*INTRODUCTION, *figure_lines()]
    for part in (path_tables, dyad_table, error_tables, lost_arcs, fits):
        lines += part()
    return "\n".join([*lines, ERRATA])


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
    for name, draw in PICTURES.items():
        (IMAGES / name).write_text(draw(), encoding="utf-8")
