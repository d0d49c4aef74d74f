"""The part of the page on acceleration poles about a crank that accelerates: equation (2) in general."""

import math

import numpy as np
from signed_distances import of_four_bar, of_slider_crank

from mechwright.mechanics.planar import BodyMotion, Turning, acceleration_pole
from mechwright.mechanics.planar.poles import circles, ratio_of_pole
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.kinematics.loop import close
from mechwright_slider_crank.kinematics.slider_crank import SliderCrank

SLIDER, FOUR = SliderCrank(50.0, 150.0, 20.0), FourBar(40, 120, 80, 100)
CASES = (("slider-crank", 60), ("slider-crank", 200), ("four-bar", 120), ("four-bar", 300))
RATIOS = (-2.0, -0.5, 0.0, 0.5, 2.0)


def body(linkage: str, degrees: float, ratio: float) -> BodyMotion:
    crank = Turning.of([math.radians(degrees)], 1.0, ratio)
    if linkage == "four-bar":
        return close(FOUR, crank.theta).bodies(FOUR, crank)["coupler"]
    return SLIDER.bodies(crank.theta, crank).rod


def _place(point: complex) -> str:
    return f"{point.real:.6f}, {point.imag:.6f}"


def equation_two() -> float:
    """The largest relative error of (2) over all cases and ratios."""
    worst = 0.0
    for linkage, degrees in CASES:
        phi = math.radians(degrees)
        found = of_four_bar(FOUR, phi) if linkage == "four-bar" else of_slider_crank(SLIDER, phi)
        for ratio in RATIOS:
            said = float((found.alpha + ratio * found.omega).flat[0])
            true = float(body(linkage, degrees, ratio).turning.alpha[0])
            worst = max(worst, abs(said - true) / (1 + abs(true)))
    return max(1e-12, 10.0 ** math.ceil(math.log10(max(worst, 1e-300))))


def position_table() -> list[str]:
    """What the positions have in common at all k."""
    rows = ["| linkage, φ | P | J | k of the inflection pole |", "| --- | --- | --- | --- |"]
    for linkage, degrees in CASES:
        steady = body(linkage, degrees, 0.0)
        found = circles(steady)
        turned, _ = ratio_of_pole(steady, found.inflection_pole)
        p, j = complex(found.instant_centre[0]), complex(found.inflection[0])
        rows.append(f"| {linkage}, {degrees}° | {_place(p)} | {_place(j)} | {turned[0]:.9f} |")
    return rows


def table() -> list[str]:
    """The pole at each position and each k."""
    rows = [
        "| linkage, φ | k | αc/ωa² | G on the ground | G in the coupler |",
        "| --- | --- | --- | --- | --- |",
    ]
    for linkage, degrees in CASES:
        for number, ratio in enumerate(RATIOS):
            moved = body(linkage, degrees, ratio)
            pole = acceleration_pole(moved)
            first = "" if number else f"{linkage}, {degrees}°"
            rows.append(
                f"| {first} | {ratio:g} | {moved.turning.alpha[0]:.9f} | "
                f"{_place(complex(pole.fixed[0]))} | {_place(complex(pole.moving[0]))} |"
            )
    return rows


def reach() -> list[str]:
    """How far the loci of one assembly go over a turn."""
    rows = ["| linkage | k | X | Y |", "| --- | --- | --- | --- |"]
    phi = np.linspace(0, math.tau, 3601)
    for linkage in ("slider-crank", "four-bar"):
        for ratio in (0.0, 0.5, 2.0):
            crank = Turning.of(phi, 1.0, ratio)
            moved = (
                SLIDER.bodies(phi, crank).rod
                if linkage == "slider-crank"
                else close(FOUR, phi).bodies(FOUR, crank)["coupler"]
            )
            g = acceleration_pole(moved).fixed
            rows.append(
                f"| {linkage} | {ratio:g} | {g.real.min():.1f} to {g.real.max():.1f} | "
                f"{g.imag.min():.1f} to {g.imag.max():.1f} |"
            )
    return rows


def accelerating_crank() -> list[str]:
    """The part of the page."""
    return [
        "## A crank that accelerates",
        "",
        "The source drops the crank's acceleration after equation (2). With k = αa/ωa², per radian, equation "
        "(2) is αc/ωa² = k ωc/ωa + (h/g − (h/g)²) cot δ. The pole is G = A + a (1 − i k) exp(i φ)/(i αc − "
        "ωc²), with rates over the crank's speed. Equation (2) with signed distances agrees with the rates "
        f"of both linkages within {equation_two():.0e}, at the positions and all k below.",
        "",
        "Slider-crank 50, 150, e = 20 mm; four-bar 40, 120, 80, 100 mm. P is measured from A0; J is the "
        "diameter of the inflection circle from P.",
        "",
        *position_table(),
        "",
        *table(),
        "",
        "At one crank angle the poles of all k form the inflection circle without P. P is the limit for k to "
        "either infinity. The k of the first table leads to the end of the diameter. A required pole "
        "therefore has a k only if it lies on that circle. `ratio_of_pole` of "
        "`mechwright.mechanics.planar.poles` gives that k and the distance of the place from the circle.",
        "",
        "![Circles of the slider-crank](../images/poles-circles-slider-crank.svg)",
        "",
        "![Circles of the four-bar](../images/poles-circles-four-bar.svg)",
        "",
        "A constant k over the turn is the speed ω = ω0 exp(k φ). Its poles depend on the angle alone, and "
        "their loci are algebraic. On the ground the slider-crank's locus has degree 26 and 13-fold circular "
        "points for k ≠ 0, and 24 and 12 for k = 0. Where c = |a ± e| the numbers are 14 and 7, and 12 and "
        "6. In the coupler, and for the four-bar, the degrees are those of k = 0. The symmetry about an axis "
        "is lost: the locus of −k is the mirror image. `tests/plugins/test_accelerating_loci.py` finds "
        "the degrees from exact points.",
        "",
        "![Slider-crank, on the ground](../images/poles-accelerating-slider-crank.svg)",
        "",
        "![Slider-crank, in the coupler](../images/poles-accelerating-slider-crank-coupler.svg)",
        "",
        "![Four-bar, on the ground](../images/poles-accelerating-four-bar.svg)",
        "",
        "![Four-bar, in the coupler](../images/poles-accelerating-four-bar-coupler.svg)",
        "",
        "Extent of the loci over a turn, mm; the pictures are clipped:",
        "",
        *reach(),
        "",
    ]
