"""The exact locus of the acceleration pole."""

from fractions import Fraction

import numpy as np
import pytest
from exact_poles import Quadratic, exact_poles
from flint import arb, ctx, fmpq
from four_bar_reference import FACTS, LOCI

from mechwright.errors import GeometryError
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.kinematics.locus import locus
from mechwright_four_bar.kinematics.loop import close
from mechwright_four_bar.synthesis.poles.certificate import pole_ball

PLANES = ("fixed", "coupler")
SPECIAL = [
    # crank, coupler, follower, ground; degree, multiplicity of the circular points
    ((2, 6, 5, 7), 30, 15),
    ((5, 7, 6, 2), 30, 15),  # a double crank: the polynomial does not see which link turns
    ((6, 3, 5, 9), 30, 15),  # a triple rocker
    ((2, 5, 5, 7), 28, 14),
    ((3, 6, 3, 7), 28, 13),
    ((3, 3, 3, 5), 26, 12),
    ((3, 6, 5, 8), 18, 9),
    ((3, 8, 5, 6), 18, 9),
    ((3, 6, 8, 5), 18, 9),
    ((3, 5, 5, 7), 16, 8),
    ((3, 2, 3, 4), 16, 7),
    ((4, 3, 3, 4), 12, 6),
    ((3, 3, 5, 5), 6, 3),
]


def fractions(lengths):
    return tuple(Fraction(length) for length in lengths)


def poles(lengths, plane, count, digits):
    """Points of both branches in many digits, from the formulas in ball arithmetic."""
    bar = FourBar(*(float(Fraction(length)) for length in lengths))
    found = []
    with ctx.workdps(digits):
        balls = [arb(Fraction(length).numerator) / Fraction(length).denominator for length in lengths]
        for k in range(4 * count):
            phi = arb(2 * k + 1) / 7
            if not np.isfinite(close(bar, float(phi)).joint_b):
                continue
            for branch in (1, -1):
                g = pole_ball(balls, arb(0), phi, branch)
                if plane == "coupler":
                    g = _in_coupler(balls, phi, branch, g)
                found.append((g.real, g.imag))
            if len(found) >= 2 * count:
                break
    return found


def _in_coupler(balls, phi, branch, g):
    from flint import acb

    a, c, b, f = balls
    joint = acb(a) * acb(0, phi).exp()
    d = acb(f) - joint
    square = d.real**2 + d.imag**2
    angle = ((c * c + square - b * b) / (2 * c * square.sqrt())).acos()
    direction = d / square.sqrt() * acb(0, branch * angle).exp()
    return (g - joint) / direction


@pytest.mark.parametrize("plane", PLANES)
def test_the_reference_polynomials_come_out_exactly(plane):
    table = LOCI[f"fourbar a=2,b=5,c=6,f=7 {plane}"]
    wanted = {
        tuple(map(int, key.split(","))): Fraction(int(value[0]), int(value[1]))
        for key, value in table.items()
    }
    curve = locus(*fractions((2, 6, 5, 7)), plane)
    assert set(curve.terms) == set(wanted)
    scale = wanted[max(wanted)]
    assert all(value == wanted[key] / scale for key, value in curve.terms.items())
    assert curve.degree == FACTS[f"locus fourbar {plane}: degree"]["expected"]
    assert curve.circularity == FACTS[f"locus fourbar {plane}: circular multiplicity"]["expected"]
    assert len(curve.terms) == FACTS[f"locus fourbar {plane}: terms in (rho,X)"]["expected"]


@pytest.mark.parametrize("plane", PLANES)
@pytest.mark.parametrize(("lengths", "degree", "circularity"), SPECIAL)
def test_degree_and_circular_points_of_all_cases(lengths, degree, circularity, plane):
    curve = locus(*fractions(lengths), plane)
    assert (curve.degree, curve.circularity) == (degree, circularity)


@pytest.mark.parametrize("plane", PLANES)
@pytest.mark.parametrize(
    "lengths", [(2, 6, 5, 7), ("41.37", "120.1", "80.25", "101.5"), (3, 6, 5, 8), (4, 3, 3, 4)]
)
def test_real_poles_of_both_branches_are_on_the_curve(lengths, plane):
    """|F| over the sum of its terms' sizes, certified, in 60 digits; the mirror image is no other curve."""
    curve = locus(*fractions(lengths), plane)
    points = poles(lengths, plane, 12, 70)
    assert len(points) >= 12
    with ctx.workdps(60):
        assert max(curve.ratio(x, y) for x, y in points) < 1e-50
        assert max(curve.ratio(x + arb(1) / 1000, y) for x, y in points) > 1e-20


@pytest.mark.parametrize("plane", PLANES)
@pytest.mark.parametrize("lengths", [(2, 6, 5, 7), (3, 6, 3, 7), (3, 6, 5, 8), (4, 3, 3, 4), (3, 3, 5, 5)])
def test_the_curve_is_exactly_zero_at_exact_positions(lengths, plane):
    terms = locus(*fractions(lengths), plane).terms
    for number in range(6):
        for rho, along in exact_poles(lengths, plane, fmpq(2 * number + 1, 7 + number)):
            one = Quadratic(fmpq(1), fmpq(0), rho.n)
            powers = [[one], [one]]
            for _ in range(max(map(max, terms))):
                powers[0].append(powers[0][-1] * rho)
                powers[1].append(powers[1][-1] * along)
            total = Quadratic(fmpq(0), fmpq(0), rho.n)
            for (i, j), value in terms.items():
                share = Quadratic(fmpq(value.numerator, value.denominator), fmpq(0), rho.n)
                total = total + share * powers[0][i] * powers[1][j]
            assert (total.u, total.v) == (0, 0)


def test_scaling_the_linkage_scales_the_curve():
    one = locus(*fractions((2, 6, 5, 7)), "fixed")
    two = locus(*fractions((3, 9, "7.5", "10.5")), "fixed")
    share = Fraction(3, 2)
    top = max(one.terms)
    weight = 2 * top[0] + top[1]
    assert two.terms == {(i, j): value * share ** (weight - 2 * i - j) for (i, j), value in one.terms.items()}


@pytest.mark.parametrize("lengths", [(3, 5, 3, 5), (4, 4, 4, 4)])
def test_a_parallelogram_is_refused(lengths):
    with pytest.raises(GeometryError, match="parallelogram"):
        locus(*fractions(lengths), "fixed")


def test_links_that_cannot_be_joined_are_refused():
    with pytest.raises(GeometryError, match="cannot be joined"):
        locus(*fractions((1, 10, 2, 3)), "fixed")


def test_the_command_prints_a_table_or_json(capsys):
    from mechwright.mechanics.algebra import PlaneCurve
    from mechwright_four_bar.__main__ import main

    assert main(["3", "3", "5", "5"]) == 0
    assert "degree 6, 3-fold circular points, 10 terms" in capsys.readouterr().out
    assert main(["3", "6", "5", "8", "coupler", "--json"]) == 0
    assert PlaneCurve.from_json(capsys.readouterr().out) == locus(*fractions((3, 6, 5, 8)), "coupler")
    assert main(["3", "5", "3", "5"]) == 2
    assert "parallelogram" in capsys.readouterr().err
    assert main(["x", "5", "3", "5"]) == 2
