"""Compares the published theory of acceleration poles with the code.

``python docs/seeds/acceleration_poles.py`` writes the page anew. Each mechanism adds its own part to
``PARTS``; all of them print the same kinds of tables.
"""

import math
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import numpy as np
from accelerating_crank import accelerating_crank
from pole_figures import draw, figures
from signed_distances import of_four_bar, of_slider_crank
from six_bar_poles import six_bars

from mechwright.mechanics.algebra.curve import PlaneCurve
from mechwright.mechanics.planar import acceleration_pole
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.kinematics.locus import locus as four_bar_locus
from mechwright_four_bar.kinematics.loop import close
from mechwright_four_bar.synthesis.poles.equations import PoleProblem
from mechwright_four_bar.synthesis.poles.search import search
from mechwright_slider_crank.kinematics.locus import Plane, locus
from mechwright_slider_crank.kinematics.slider_crank import SliderCrank
from mechwright_slider_crank.synthesis.poles.synthesis import through_poles

PAGE = Path(__file__).parent / "acceleration-poles.md"
FURTHER = PAGE.with_name("acceleration-poles-further.md")
"""The page on mechanisms that the source does not treat."""

SAMPLES = 8000
"""Random slider-cranks on which the equations are tried."""

LOCI = (
    ("1", "3", "1/2", "any"),
    ("2", "1", "1/3", "the crank cannot turn"),
    ("1", "5/2", "0", "central, e = 0"),
    ("1", "3/2", "1/2", "c = a + e"),
    ("3", "1", "2", "c = a - e"),
)

PLANES: tuple[Plane, ...] = ("fixed", "coupler")

TWO_POLES = np.array([3.0 - 0.63j, 2.06 + 2.08j])
"""Poles of the example, with 47° of crank rotation between them."""

FOUR_BAR_LOCI = (
    (2, 6, 5, 7, "any crank-rocker"),
    (5, 7, 6, 2, "any double crank"),
    (6, 3, 5, 9, "the crank cannot turn"),
    (2, 5, 5, 7, "coupler and follower alike"),
    (3, 6, 3, 7, "crank and follower alike"),
    (3, 3, 3, 5, "crank, coupler and follower alike"),
    (3, 6, 5, 8, "change point"),
    (3, 5, 5, 7, "change point, coupler and follower alike"),
    (3, 2, 3, 4, "change point, crank and follower alike"),
    (4, 3, 3, 4, "kite, crank and ground alike"),
    (3, 3, 5, 5, "kite, crank and coupler alike"),
)

THREE_POLES = np.array([2.34 + 4.09j, -0.53 + 5.86j, 2.98 + 5.83j])
"""Poles of the four-bar's example, at 0°, 50° and 150° of crank rotation."""


def equations() -> list[str]:
    """How far the seed's equations are from the direct pole, with either sign of δ."""
    rng = np.random.default_rng(0)
    a, e = rng.uniform(0.2, 2, SAMPLES), rng.normal(0, 1, SAMPLES)
    c = (a + np.abs(e)) * (1.02 + rng.exponential(0.7, SAMPLES))
    linkage = SliderCrank(a, c, e, rng.uniform(-4, 4, SAMPLES), rng.choice([-1, 1], SAMPLES))
    phi = rng.uniform(-4, 4, SAMPLES)
    rod, found = linkage.bodies(phi).rod, of_slider_crank(linkage, phi)
    pole = acceleration_pole(rod)
    # Where the forms come near 0/0 they lose digits, and say nothing about their truth.
    sound = np.abs(found.cot_delta) + 1 / np.abs(np.cos(phi - linkage.direction)) < 100

    def worst(miss: "np.ndarray[tuple[int], np.dtype[np.float64]]") -> str:
        # Whatever the last digits of this machine's sine are.
        return f"{max(1e-12, 10.0 ** math.ceil(math.log10(float(miss[sound].max())))):.0e}"

    alpha, size = 1 + np.abs(rod.turning.alpha), 1 + np.abs(pole.fixed)
    rows = [
        ("(1) ωc = (1 - h/g) ωa", worst(np.abs(found.omega - rod.turning.omega))),
        ("(3) αc = ωa² (h/g - (h/g)²) cot δ", worst(np.abs(found.alpha - rod.turning.alpha) / alpha)),
        ("(10), (11) pole in the coupler", worst(np.abs(found.coupler - pole.moving) / size)),
        ("(12), (13) pole on the ground", worst(np.abs(found.fixed - pole.fixed) / size)),
    ]
    wrong = np.median((np.abs(-found.alpha - rod.turning.alpha) / alpha)[sound])
    return [
        f"The table compares {SAMPLES} random slider-cranks of both assemblies, away from 0/0.",
        "",
        "| equation | relative error, at most |",
        "| --- | --- |",
        *(f"| {name} | {error} |" for name, error in rows),
        "",
        f"With the opposite sign of δ, equation (3) has a median error of {wrong:.1f}.",
    ]


def loci() -> list[str]:
    """A row for each slider-crank: degree, circular points and terms, on the ground and in the coupler."""
    rows = [
        "| a, c, e | case | on the ground | in the coupler |",
        "| --- | --- | --- | --- |",
    ]
    for a, c, e, case in LOCI:
        cells = []
        for plane in PLANES:
            curve, power = locus(Fraction(a), Fraction(c), Fraction(e), plane)
            even = all(power % 2 == 0 for _, power in curve.terms)
            notes = ", both axes" if even and plane == "fixed" else ", twice" if power == 2 else ""
            cells.append(f"{_figures(curve)}{notes}")
        rows.append(f"| {a}, {c}, {e} | {case} | {' | '.join(cells)} |")
    return rows


def _figures(curve: PlaneCurve) -> str:
    return f"{curve.degree}, {curve.circularity}-fold, {len(curve.terms)}"


def _matrix(curve: PlaneCurve) -> list[str]:
    """The coefficients of a locus: a line for each power of ρ, in it those of rising powers of the axis."""
    powers = sorted({i for i, _ in curve.terms})
    lines = []
    for i in powers:
        row = {j: value for (one, j), value in curve.terms.items() if one == i}
        lines.append(f"rho^{i}: " + "  ".join(str(row.get(j, 0)) for j in range(max(row) + 1)))
    return ["```text", *lines, "```"]


def example_polynomial() -> list[str]:
    """The coefficients of the smallest locus of a slider-crank."""
    return _matrix(locus(Fraction(1), Fraction(3, 2), Fraction(1, 2), "fixed")[0])


def _silent(done: float, what: str) -> None:
    pass


def _quiet(done: float) -> None:
    pass


def solutions() -> list[str]:
    found, _ = through_poles(TWO_POLES, np.radians([47.0]), 1500, 1, _silent)
    rows = ["| a | c | e | φ1 | least μ |", "| --- | --- | --- | --- | --- |"]
    for one in found:
        rows.append(
            f"| {one.crank:.9f} | {one.rod:.9f} | {one.offset:.9f} | {math.degrees(one.angles[0]):.4f}° | "
            f"{math.degrees(one.transmission):.3f}° |"
        )
    return rows


def slider_crank() -> list[str]:
    """The part of the slider-crank."""
    return [
        "## Slider-crank",
        "",
        *equations(),
        "",
        "Signs that make the equations true: P is the coupler's instant centre, Q the relative centre of "
        "crank and slider. g and h are the signed distances of P from crank pin and pivot along the crank, "
        "with g - h = a. δ is the counter-clockwise angle from line PB to line QP.",
        "",
        "### Loci of the pole over a turn, both assemblies",
        "",
        "Each cell gives the degree, the multiplicity of the circular points and the number of terms in ρ "
        "and the axis. The loci are symmetric about Y on the ground and about x in the coupler, unless "
        'noted. "Twice" marks a locus that is run through twice in a turn.',
        "",
        *loci(),
        "",
        "Degrees and multiplicities come from exact polynomials with rational coefficients. The smallest "
        "polynomial is that of a = 1, c = 3/2, e = 1/2 on the ground, with ρ = X² + Y². Each line has the "
        "coefficients of Y⁰, Y¹, Y² ...:",
        "",
        *example_polynomial(),
        "",
        "### Two prescribed poles",
        "",
        "Poles (3, -0.63) and (2.06, 2.08), 47° of crank rotation apart, pivot in the origin, slide along X. "
        "The table has every slider-crank found whose crank turns, each with a certified residual below "
        "1e-10.",
        "",
        *solutions(),
        "",
        "### Claims",
        "",
        "| claim | verdict |",
        "| --- | --- |",
        "| the pole does not depend on the crank's speed | true at constant speed, where ω cancels; an "
        "accelerating crank adds k |",
        "| on the ground: degree 24, 12-fold, symmetric about Y | true, also where the crank cannot turn; "
        "degree 12, 6-fold only where c = a + e or c is the difference of a and e |",
        "| in the coupler: degree 28, 14-fold, symmetric about x | true for e ≠ 0; **false for e = 0**, "
        "where the polynomial is a square: degree 14, 7-fold |",
        "| for c = a + e: degree 12, 6-fold | true on the ground; 16, 8-fold in the coupler, which the "
        "source does not give |",
        "| a slider-crank goes through at most two prescribed poles | true with given crank rotations; with "
        "free crank angles three poles have solutions |",
        "",
    ]


def four_bar_equations() -> list[str]:
    """How far the seed's equations (1), (3) and (6) to (9) are from the direct pole."""
    rng = np.random.default_rng(1)
    lengths = np.exp(rng.uniform(-1.5, 0, (60 * SAMPLES, 4)))
    a, c, b, f = lengths.T
    turning = np.minimum(b + c - a - f, np.abs(f - a) - np.abs(b - c)) > 0.02
    a, c, b, f = lengths[turning][:SAMPLES].T
    bar = FourBar(a, c, b, f, rng.uniform(-4, 4, SAMPLES), rng.choice([-1, 1], SAMPLES))
    phi = rng.uniform(-4, 4, SAMPLES)
    loop, found = close(bar, phi), of_four_bar(bar, phi)
    lever = loop.joint_a / (1j * loop.coupler.second - loop.coupler.first**2)
    parallel = np.abs((np.exp(1j * phi) * np.conj(loop.follower.direction)).imag)
    sound = np.abs(found.cot_delta) + 1 / parallel + np.abs(a / found.g) < 100

    def worst(miss: "np.ndarray[tuple[int], np.dtype[np.float64]]") -> str:
        # Whatever the last digits of this machine's sine are.
        return f"{max(1e-9, 10.0 ** math.ceil(math.log10(float(miss[sound].max())))):.0e}"

    alpha, size = 1 + np.abs(loop.coupler.second), 1 + np.abs(lever)
    rows = [
        ("(1) ωc = (1 - h/g) ωa", worst(np.abs(found.omega - loop.coupler.first))),
        ("(3) αc = ωa² (h/g - (h/g)²) cot δ", worst(np.abs(found.alpha - loop.coupler.second) / alpha)),
        (
            "(6), (7) pole in the coupler",
            worst(np.abs(found.coupler - lever / loop.coupler.direction) / size),
        ),
        ("(8), (9) pole on the ground", worst(np.abs(found.fixed - loop.joint_a - lever) / size)),
    ]
    wrong = np.median((np.abs(-found.alpha - loop.coupler.second) / alpha)[sound])
    return [
        f"The table compares {SAMPLES} random four-bars whose crank turns, on both branches, away from 0/0.",
        "",
        "| equation | relative error, at most |",
        "| --- | --- |",
        *(f"| {name} | {error} |" for name, error in rows),
        "",
        f"With the opposite sign of δ, equation (3) has a median error of {wrong:.1f}.",
    ]


def four_bar_loci() -> list[str]:
    """A row for each four-bar, with the cells of :func:`loci`."""
    rows = ["| a, c, b, f | case | on the ground | in the coupler |", "| --- | --- | --- | --- |"]
    for a, c, b, f, case in FOUR_BAR_LOCI:
        lengths = Fraction(a), Fraction(c), Fraction(b), Fraction(f)
        cells = (_figures(four_bar_locus(*lengths, plane)) for plane in PLANES)
        rows.append(f"| {a}, {c}, {b}, {f} | {case} | {' | '.join(cells)} |")
    return rows


def four_bar_polynomial() -> list[str]:
    """The coefficients of the smallest locus of a four-bar."""
    return _matrix(four_bar_locus(Fraction(3), Fraction(3), Fraction(5), Fraction(5), "fixed"))


def four_bar_solutions() -> list[str]:
    problem = PoleProblem(THREE_POLES, np.radians([0.0, 50.0, 150.0]), None, None, 1, full_turn=True)
    found = sorted(search(problem, 2000, 1, _quiet).solutions, key=lambda one: one.bar.crank)
    rows = [
        "| a | c | b | f | θ | φ1 | branch | least μ |",
        "| --- | --- | --- | --- | --- | --- | --- | --- |",
    ]
    for one in found:
        bar = one.bar
        least = math.degrees(bar.least_transmission_angle())
        if least < 1:
            continue  # nearer to a toggle, the last digits differ between machines
        rows.append(
            f"| {bar.crank:.6f} | {bar.coupler:.6f} | {bar.follower:.6f} | {bar.ground:.6f} | "
            f"{math.degrees(bar.ground_angle):.3f}° | {math.degrees(one.phi[0]):.3f}° | {bar.branch:+d} | "
            f"{least:.2f}° |"
        )
    return rows


def four_bar() -> list[str]:
    """The part of the four-bar."""
    return [
        "## Four-bar",
        "",
        *four_bar_equations(),
        "",
        "P is the coupler's instant centre, where crank and follower meet. Q is the relative centre of crank "
        "and follower, where coupler and ground line meet. g, h and δ are as for the slider-crank.",
        "",
        "### Loci of the pole over a turn, both branches",
        "",
        "The source leaves the four-bar's locus to later work. Cells are those of the slider-crank's table. "
        "All loci are symmetric about the ground line, in the coupler about AB. A parallelogram has none: "
        "its coupler does not turn.",
        "",
        *four_bar_loci(),
        "",
        "The smallest polynomial is that of the kite a = c = 3, b = f = 5 on the ground, in powers of X:",
        "",
        *four_bar_polynomial(),
        "",
        "### Three prescribed poles",
        "",
        "Poles (2.34, 4.09), (-0.53, 5.86) and (2.98, 5.83) at 0°, 50° and 150° of crank rotation, pivot in "
        "the origin. The table has four-bars found whose crank turns and whose transmission angle stays "
        "above 1°, each with a certified residual below 1e-10.",
        "",
        *four_bar_solutions(),
        "",
        "### Claims",
        "",
        "| claim | verdict |",
        "| --- | --- |",
        "| parametric forms of crank-rockers and double cranks, (6) to (9) | true for every four-bar, with "
        "signed g and h and one sense of δ |",
        "| a four-bar goes through at most three prescribed poles, two with a prescribed ground angle | true "
        "with given crank rotations; with free crank angles four places have solutions at a given ground "
        "angle |",
        "",
    ]


def errata() -> list[str]:
    return [
        "## Errata of the source",
        "",
        "1. Pages 1, 3 and 5 are missing, with equations (1), (2), (14) and all tables. Superscripts are "
        "detached: a g², a², h², cot².",
        "2. cos σ and sin σ under equation (4) stand in the four-bar's part and belong to the slider-crank.",
        "3. g and h have to be signed. With plain distances (1) and (3) fail where P lies between the pivots "
        "or behind them.",
        "4. Forms (6) to (13) are 0/0 where the pole is finite: with P at infinity, in a dead centre, and "
        "with PB and QP parallel. The code uses G = A + a exp(i φ) / (i αc - ωc²), and the forms to compare.",
        "5. The coefficients of (14), (17), (18) and (20) are far fewer than printed: all are polynomials in "
        "X² + Y² and one coordinate.",
        "",
    ]


PARTS: list[Callable[[], list[str]]] = [figures, slider_crank, four_bar]
"""In the order of the page."""


def page() -> str:
    head = [
        "# Acceleration poles and their loci, and the code",
        "",
        "<!-- written by acceleration_poles.py in this folder; do not edit -->",
        "",
        "The source derives the acceleration pole of the coupler of four-bars and slider-cranks at "
        "constant crank speed. The report has parametric forms, the locus as a polynomial, and mechanisms "
        "through prescribed poles. This page compares its equations with the direct formula, and its claims "
        "with exact polynomials. A [second page](acceleration-poles-further.md) has accelerating cranks and "
        "six-bars.",
        "",
    ]
    return "\n".join((*head, *(line for part in PARTS for line in part()), *errata()))


def further() -> str:
    """The page beyond the source."""
    head = [
        "# Acceleration poles beyond the source",
        "",
        "<!-- written by acceleration_poles.py in this folder; do not edit -->",
        "",
        "The [source](acceleration-poles.md) treats four-bars and slider-cranks at constant crank speed. The "
        "direct formula also gives the poles of cranks that accelerate and of six-bars.",
        "",
    ]
    return "\n".join((*head, *accelerating_crank(), *six_bars()))


if __name__ == "__main__":
    draw()
    PAGE.write_text(page(), encoding="utf-8")
    FURTHER.write_text(further(), encoding="utf-8")
