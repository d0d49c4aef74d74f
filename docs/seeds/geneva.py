"""Compares the published design of curved Geneva slots with the code.

``python docs/seeds/geneva.py`` writes the page anew.
"""

import math
from collections.abc import Iterator, Sequence
from pathlib import Path

import geneva_driver as driver
import geneva_machine
import geneva_printed as printed
import geneva_undercut as undercut
import numpy as np

from mechwright.mechanics.laws import LAWS, Law
from mechwright_geneva.defaults.dimensions import mechanism_of
from mechwright_geneva.kinematics.figures import straight_peaks
from mechwright_geneva.kinematics.geometry import LEFT, RIGHT, Frame, stroke
from mechwright_geneva.kinematics.mechanism import Mechanism
from mechwright_geneva.parameters import GenevaParams
from mechwright_geneva.rules.slots import REGIMES

PAGE = Path(__file__).parent / "geneva.md"

FIGURE_6 = Frame.of(math.pi / 4, math.radians(60), 0.0, 100.0)
"""θw0 = 45, θd0 = 60, θoff = 0 degrees, l = 100 mm."""

FIGURE_6_ROLLER = 4.0
"""mm."""

REFERENCE = GenevaParams(crank_half_angle=50, offset_angle=5, groove_clearance=0)
"""The worked design: n = 4, l = 100 mm, r = 5 mm."""

PROTOTYPES = ((4, 40.0), (4, 45.0), (5, 54.0), (6, 60.0), (8, 67.5))
"""Slots and crank half angle (degrees) that can be made with l = 70 mm, θoff = 12 degrees, r = 5 mm."""


def table(head: Sequence[str], rows: Iterator[Sequence[str]] | Sequence[Sequence[str]]) -> str:
    """A Markdown table."""
    lines = [f"| {' | '.join(row)} |" for row in (head, ["---"] * len(head), *rows)]
    return "\n".join(lines)


def loops() -> Iterator[list[str]]:
    angle, point = printed.loop(FIGURE_6, LAWS["3-4-5"](), FIGURE_6_ROLLER, printed=True)
    yield ["as printed", "11.7177", "108.2823", "57.9668", "", ""]
    yield _loop("3-4-5, dθw/du in place of θw'", angle, point, "")
    for name, law in LAWS.items():
        limit = _critical(FIGURE_6, law())
        angle, point = printed.loop(FIGURE_6, law(), FIGURE_6_ROLLER, printed=False)
        yield _loop(
            f"**{name}**" if name == "cycloidal" else name,
            angle,
            point,
            f"{limit / float(FIGURE_6.crank):.10f}",
            f"{limit:.4f}",
        )


def _loop(name: str, angle: float, point: complex, *more: str) -> list[str]:
    degrees = math.degrees(angle)
    figures = [f"{degrees:.9f}", f"{120 - degrees:.9f}", f"{point.real:.9f}"]
    return [name, *figures, *more, *[""] * (2 - len(more))]


def _critical(frame: Frame, law: Law) -> float:
    run = stroke(frame, law, np.linspace(0, 1, 4001))
    return float(1 / np.abs(run.curvature).max())


def walls() -> Iterator[list[str]]:
    m = mechanism_of(REFERENCE)
    u = np.linspace(0, 1, 9)
    run = m.stroke(u)
    left, right = run.wall(m.roller, LEFT), run.wall(m.roller, RIGHT)
    for k in range(u.size):
        yield [
            f"{100 * u[k]:g}",
            f"{math.degrees(run.theta[k]):.9f}",
            *(f"{z.real:.9f}, {z.imag:.9f}" for z in (run.track[k], left[k], right[k])),
        ]


def singularities() -> Iterator[list[str]]:
    m = mechanism_of(REFERENCE)
    u = np.array([0.0, 0.25, 0.4, 0.45, 0.5])
    run = m.stroke(u)
    right = undercut.singularity(run, m.roller, RIGHT)
    wrong = printed.singularity(run, m.roller, RIGHT)
    square = (run.speed / m.crank) ** 4 * run.regularity(m.roller, RIGHT) ** 2
    for k in range(u.size):
        yield [f"{100 * u[k]:g}", f"{wrong[k]:.8f}", f"{right[k]:.8f}", f"{square[k]:.8f}"]


def prototype(slots: int, half: float, sign: int) -> Mechanism:
    return mechanism_of(
        GenevaParams(
            slots=slots,
            crank_half_angle=half,
            offset_angle=12.0 * sign,
            entry_radius=70,
            roller_radius=5,
            groove_clearance=0,
        )
    )


def regime(sign: int) -> str:
    """The regime, which all of them share."""
    (found,) = {REGIMES[prototype(*one, sign).side] for one in PROTOTYPES}
    return found


def prototypes(sign: int) -> Iterator[list[str]]:
    for slots, half in PROTOTYPES:
        m = prototype(slots, half, sign)
        limit, web = m.measures.island_limit.item(), m.measures.web.item()
        verdict = ", undercut" if limit <= m.roller else ("" if m.measures.width.item() > 0 else ", loop")
        lengths = f"{m.axes:.4f}", f"{m.crank:.4f}", f"{m.bottom:.3f}"
        yield [f"{slots}", f"{half:g}", *lengths, f"{limit:.3f}{verdict}", f"{web:.2f}"]


def against_straight() -> Iterator[list[str]]:
    for slots in range(3, 13):
        straight = straight_peaks(slots)
        half = math.pi / 2 - math.pi / slots
        way, time = 2 * math.pi / slots, 2 * half
        row = [str(slots), f"{straight.v:.4f}", f"{straight.a:.4f}", f"{straight.j:.3f}"]
        for name in ("cycloidal", "modified-sine", "modified-trapezoid"):
            peak = LAWS[name]().peaks.a * way / time**2
            row.append(f"**{peak:.4f}**" if peak > straight.a else f"{peak:.4f}")
        yield row


def figures() -> str:
    """Every figure of the source, and what of ours stands beside it."""

    def picture(name: str, shows: str) -> str:
        return f"![{shows}](../images/{name}.svg)"

    loop, *undercut_ones = driver.SLOTS
    rows = [
        [
            "1",
            "a family of curves and its envelope",
            "the walls are the envelope of the roller: picture of figure 6",
        ],
        ["2, 4, 5", "lost with pages 4 and 6", "angles and offset angle: [the family's page](../geneva.md)"],
        [
            "3",
            "inversion, the wheel fixed: equation (2)",
            "the roller's path: thin line of figure 6",
        ],
        [
            "(a), after (30)",
            "slots without undercut; lost with page 12",
            picture(undercut_ones[1][0], undercut_ones[1][1]),
        ],
        [
            "(b), after (30)",
            "undercut; lost with page 12",
            " ".join(picture(name, shows) for name, shows, _ in (undercut_ones[0], undercut_ones[2])),
        ],
        [
            "6",
            "walls that cross in a loop, θd1 = 11.7177° and θd2 = 108.2823°, (57.9668, −57.9668)",
            picture(loop[0], loop[1]),
        ],
        [
            "7",
            "named before figure 6; lost with page 14, *2.8 Simulation*, if it was another",
            "its numbers: the first two rows of *Figure 6* above; moving: "
            "[geneva-cycloidal](../../examples/geneva-cycloidal.toml)",
        ],
        [
            "8, 9",
            "assembly, two views, without dimensions",
            "`assembly.html`, `assembly-drawing.pdf` of [geneva-machine](../../examples/geneva-machine.toml)",
        ],
        ["10", "stop wheel", "`locking-disc`, pale red in the pictures of 16 to 18; the wheel is blue"],
        ["11", "camshaft", "`shaft-driver` in ball bearings: `shaft-driver.pdf`"],
        ["12 to 15", "parts; lost with page 16", "base, bearing plates, wheel and its shaft"],
        *(
            [
                number,
                f"front view, {name} of the stroke",
                picture(f"geneva-machine-{name}", f"{number}: {name}"),
            ]
            for number, name in zip(("16", "17", "18"), geneva_machine.SHARE, strict=True)
        ),
        ["19", "view from above", picture("geneva-machine-side", "19: from the side")],
        ["20", "view from the side", picture("geneva-machine-end-on", "20: end on")],
        [
            "text after 20",
            "reversible motor; no interference at any speed",
            '`direction = "both"`; no two of the 64 bodies meet over the turn, in either direction',
        ],
    ]
    return table(["figure", "shows", "ours"], rows)


def page() -> str:
    """The whole page."""
    m = mechanism_of(REFERENCE)
    u = np.linspace(0, 1 / 3, 4001)
    law = LAWS["3-4-5"]()
    wrong = printed.wall(FIGURE_6, law, u, FIGURE_6_ROLLER, RIGHT)
    error = float(np.abs(wrong - stroke(FIGURE_6, law, u).wall(FIGURE_6_ROLLER, RIGHT)).max())
    _, point = printed.loop(FIGURE_6, law, FIGURE_6_ROLLER, printed=True)
    away = float(np.abs(stroke(FIGURE_6, law, np.linspace(0, 1, 40_001)).track - point).min())
    least = math.degrees(math.asin(FIGURE_6_ROLLER / 100 * math.sin(math.radians(105))))
    return f"""\
# The published curved-slot Geneva wheel, and the code

<!-- written by geneva.py in this folder; do not edit -->

The source is a study of a Geneva mechanism whose curved slots are the envelope of the roller under a chosen \
motion law. Only its odd pages survive: the definition of the offset angle, the dimensions of the prototype \
and figures are missing. [The page of the family](../geneva.md) has the model; this page compares.

## Model

The wheel's axis is the origin, the crank's axis lies at a on +x, and the crank turns clockwise. θw0 and θd0 \
are *half* angles. With W = θw0 + θoff and φ = θd0 - θd:

* b = l sin W / sin θd0, a = l cos W + b cos θd0, a - b = l cos(W + θd0/2) / cos(θd0/2);
* the roller's centre on the wheel is (a - b exp(iφ)) exp(-iθw), equation (2) with r = 0;
* the walls lie at ± r along the normal of that path: α = atan2(a θw' sin φ, (1 + θw') b - a θw' cos φ), \
equation (3), and α + π.

θoff is read as half the angle between the two mouths, with a sign; no surviving page defines it. With \
θoff = 0 both paths of a slot end in one mouth, and its walls cross: the loop that the source describes.

## Errata of the source

1. **Figure 6.** The loop point is printed at θd = 11.7177 and 108.2823 degrees, (57.9668, -57.9668). All \
digits follow from the 3-4-5 law, though the text chooses the cycloid, with dθw/du in place of \
θw' = dθw/dθd. The factor 1/(2 θd0) of the chain rule is missing. That wall is no envelope: its error is \
up to {error:.4f} mm. The printed point lies {away:.4f} mm from the roller's path, less than r = 4.
2. **Equation (3)** needs atan2: where θw' (a cos φ - b) > b, the plain arc tangent exchanges both walls.
3. **Equations (28) to (30)**: the terms with θw'' of ∂f/∂θd are missing, and sin φ and cos φ are exchanged \
in the brackets of the relative velocity. The printed F never comes near 0 where the wall is undercut.
4. **F = 0** finds undercut only by touching 0. F is also 0 at a cusp of the roller's path, which is no \
undercut. The sign of 1 ∓ κr decides both.
5. **Equation (33)** as printed is not the cycloid of a stroke: θw = 2 θw0 (u - sin(2πu)/2π), u = θd/(2 θd0).
6. **Equation (2)**: the signs of the lower row, as far as legible, do not give the inverted position.
7. F ≠ 0 excludes undercut only. Loop, mouths, island and web are conditions of their own.

## Figure 6: where the walls of one slot meet

θw0 = 45, θd0 = 60, θoff = 0 degrees, l = 100, r = 4 mm; the point is (x, -x). M_crit = r_crit/b.

{table(["law", "θd1, deg", "θd2, deg", "x, mm", "M_crit", "r_crit, mm"], loops())}

An offset angle of at least {least:.4f} degrees parts the mouths and removes the loop: sin θoff ≥ (r/l) \
sin(θw0 + θd0).

## F of equation (30)

n = 4, l = 100, θd0 = 50, θoff = 5 degrees, r = 5 mm, cycloidal; wall α + π.

{table(["θd, deg", "as printed", "corrected", "(D/b)⁴ (1 + κr)²"], singularities())}

At mid stroke M_crit = ((1 + p) - N p)² / ((1 + p)² - N p²) = \
{float(undercut.critical_at_middle(m.frame, 1.8)):.10f}, a critical roller of \
{m.measures.island_limit.item():.6f} mm.

## Points of the walls

The design of the last section, in the wheel's frame at θw = 0, mm.

{table(["θd, deg", "θw, deg", "centre", "wall α", "wall α + π"], walls())}

## The prototype

The source gives l = 70, θoff = 12 degrees, r = 5, thickness 10 mm and the cycloid, but neither the number \
of slots nor the crank's angle. These can be made, without undercut or loop (lengths in mm):

{table(["n", "θd0", "a", "b", "a - b", "r_crit", "web"], prototypes(1))}

All are in regime {regime(1)}. With θoff = -12 degrees, in regime {regime(-1)}, the slots are shorter and \
the webs wider:

{table(["n", "θd0", "a", "b", "a - b", "r_crit", "web"], prototypes(-1))}

`examples/geneva-prototype.toml` takes n = 4 and θd0 = 45 degrees. This is an inference, no fact of the \
source: the pair has θd0 = 90 - 180/n. The pair of Figure 6, 45 and 60 degrees, is impossible with 12 \
degrees: a - b would be \
{mechanism_of(GenevaParams(crank_half_angle=60, offset_angle=12, entry_radius=70)).bottom:.4f} mm, less \
than r.

## Curved against straight

Peaks of θw', θw'', θw''' of the straight slot, whose jerk is infinite at its ends, and of θw'' of curved \
slots with the same crank angle. Bold: higher than straight. From six slots on, the cycloid accelerates more \
than the straight slot.

{table(["n", "θw'", "θw''", "θw'''", "cycloidal", "modified sine", "modified trapezoid"], against_straight())}

## A driver whose speed varies

Equations (6) and (7) with (8), ωd constant, and (9) are one case. In general ωw = θw' w, αw = θw'' \
w² + θw' α, jw = θw''' w³ + 3 θw'' w α + θw' j, with w, α and j signed; w < 0 backwards. The design of the \
walls above:

{table(["θd, deg", "w", "α", "j", "ωw", "αw", "jw"], driver.instants())}

Peaks over a stroke, rad/s, rad/s², rad/s³; harmonic is w = 2π (1 + v cos(θd - θd0)):

{table(["driver", "time, s", "ωw", "αw", "jw"], driver.peaks())}

The wall that carries follows from the torque J (θw'' w² + θw' α) with the load and from the lever, which \
changes its sign at mid stroke. J = 0.01 kg m², 60 rev/min, clearance 0.08 mm. Each cell gives the crank \
angles in degrees at which the wall changes, the wall from there on, and in brackets the roller's impact \
speed in mm/s:

{table(["case", "forwards", "backwards"], driver.carried())}

![Torque over the stroke, by the wall that carries](../images/geneva-walls.svg)

With inertia alone, torque and lever change their signs together: the right wall carries everything, \
forwards and backwards. A machine that runs both ways needs both walls as soon as it carries a load.

## Figures

{figures()}

The source's loop is that of its printed numbers; our picture has equation (33). The source prints its \
machine without dimensions. Our machine has upright shafts, so the source's front view is our view from \
above. Designs of lost figures are ours.
"""


if __name__ == "__main__":
    driver.draw()
    PAGE.write_text(page(), encoding="utf-8")
