"""Exact loci of the acceleration pole: the reference polynomials, their degrees, and sampled poles on them."""

import json
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from flint import arb, ctx
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright.errors import GeometryError
from mechwright.mechanics.planar import acceleration_pole
from mechwright_slider_crank.kinematics.locus import locus
from mechwright_slider_crank.kinematics.slider_crank import SliderCrank

DATA = json.loads((Path(__file__).parents[1] / "data" / "planar-linkages.json").read_text())
POLYNOMIALS = {
    name: {tuple(map(int, key.split(","))): Fraction(int(p), int(q)) for key, (p, q) in terms.items()}
    for name, terms in DATA["locus_polynomials"].items()
    if name.startswith("slider")
}
DIGITS = 60


def poles(a, c, e, plane, count=24):
    """Poles of both assemblies at ``count`` angles each, where there are any, in 60 digits."""
    found = []
    for k in range(count):
        phi = arb(2 * k + 1) * arb.pi() / count + arb(1) / 7
        cos, sin = phi.cos(), phi.sin()
        x, y = a * cos, a * sin
        t = e - y
        square = c * c - t * t
        if not square > 0:
            continue
        for w in (square.sqrt(), -square.sqrt()):
            omega = -x / w
            alpha = (y + t * omega * omega) / w
            below = omega**4 + alpha**2
            # a exp(iφ)/(iα - ω²), relative to A
            gx, gy = (-x * omega**2 + y * alpha) / below, (-y * omega**2 - x * alpha) / below
            if plane == "fixed":
                found.append((x + gx, y + gy))
            else:
                found.append(((gx * w + gy * t) / c, (gy * w - gx * t) / c))
    return found


def worst(a, c, e, plane):
    curve, _ = locus(Fraction(a), Fraction(c), Fraction(e), plane)
    with ctx.workdps(DIGITS + 10):
        exact = (arb(Fraction(v).numerator) / Fraction(v).denominator for v in (a, c, e))
        points = poles(*exact, plane)
        assert len(points) >= 8
        return max(curve.ratio(x, y) for x, y in points)


@pytest.mark.parametrize("name", sorted(POLYNOMIALS))
def test_reference_polynomials_term_by_term(name):
    lengths = dict(item.split("=") for item in name.split()[1].split(","))
    plane = "fixed" if "fixed" in name else "coupler"
    curve, power = locus(*(Fraction(lengths[key]) for key in "ace"), plane)
    assert dict(curve.terms) == POLYNOMIALS[name]
    assert power == 1


@pytest.mark.parametrize(
    ("a", "c", "e", "fixed", "coupler"),
    [
        ("1", "3", "1/2", (24, 12, 91, 1), (28, 14, 75, 1)),
        ("2", "2", "1", (24, 12, 91, 1), (28, 14, 75, 1)),
        ("2", "1", "1/3", (24, 12, 91, 1), (28, 14, 75, 1)),  # the crank cannot turn
        ("1", "3/2", "1/2", (12, 6, 28, 1), (16, 8, 30, 1)),  # c = a + e
        ("3", "5", "2", (12, 6, 28, 1), (16, 8, 30, 1)),
        ("3", "1", "2", (12, 6, 28, 1), (16, 8, 30, 1)),  # c = a - e
        ("3", "1", "-2", (12, 6, 28, 1), (16, 8, 30, 1)),
        ("1", "5/2", "0", (24, 12, 37, 1), (14, 7, 23, 2)),  # central: run through twice in the coupler
    ],
)
def test_degree_circular_points_and_terms(a, c, e, fixed, coupler):
    for plane, expected in (("fixed", fixed), ("coupler", coupler)):
        curve, power = locus(Fraction(a), Fraction(c), Fraction(e), plane)
        assert (curve.degree, curve.circularity, len(curve.terms), power) == expected, plane
    assert worst(a, c, e, "fixed") < 1e-50
    assert worst(a, c, e, "coupler") < 1e-50


def test_a_central_slider_crank_has_a_locus_that_is_symmetric_twice():
    def only_even(curve):
        return all(power % 2 == 0 for _, power in curve.terms)

    assert only_even(locus(Fraction(1), Fraction(5, 2), Fraction(0), "fixed")[0])
    assert not only_even(locus(Fraction(1), Fraction(3), Fraction(1, 2), "fixed")[0])


@settings(max_examples=12, deadline=None)
@given(
    st.fractions("1/5", 4, max_denominator=9),
    st.fractions("1/5", 6, max_denominator=9),
    st.fractions(-3, 3, max_denominator=9),
)
def test_any_slider_crank_has_the_degrees_of_its_class(a, c, e):
    reached = a + abs(e) > c - Fraction(1, 50) and abs(abs(e) - a) > c - Fraction(1, 50)
    if reached or (a == c and e == 0):
        return  # it can hardly be assembled, or is degenerate
    special = c in {abs(a + e), abs(a - e)}
    curve, _ = locus(a, c, e, "fixed")
    assert (curve.degree, curve.circularity) == ((12, 6) if special else (24, 12))
    curve, power = locus(a, c, e, "coupler")
    expected = (16, 8) if special else (28, 14)
    assert (curve.degree * power, curve.circularity * power) == expected
    assert worst(a, c, e, "fixed") < 1e-50


def test_lengths_of_many_digits():
    curve, _ = locus(Fraction("51.23710482942299"), Fraction("113.28305527097052"), Fraction(50), "fixed")
    assert (curve.degree, curve.circularity) == (24, 12)
    assert worst("51.23710482942299", "113.28305527097052", "50", "coupler") < 1e-50


def test_the_degenerate_one_is_named():
    with pytest.raises(GeometryError, match="c = a and e = 0"):
        locus(Fraction(2), Fraction(2), Fraction(0), "fixed")


def test_points_off_the_curve_are_seen():
    """A ten-thousandth of a degree off, the bound is far from rounding; in doubles it would drown near A."""
    curve, _ = locus(Fraction(1), Fraction(3), Fraction(1, 2), "coupler")
    with ctx.workdps(DIGITS):
        (x, y), *_ = poles(arb(1), arb(3), arb("0.5"), "coupler")
        assert curve.ratio(x, y) < 1e-50
        assert curve.ratio(x * (1 + arb("1e-6")), y) > 1e-12


def test_doubles_are_useless_near_the_twelve_fold_point():
    """Near A the value of the exact polynomial at the rounded pole is already another order of magnitude."""
    curve, _ = locus(Fraction(1), Fraction(3), Fraction(1, 2), "coupler")
    coefficients = np.array([float(k) for k in curve.terms.values()])
    powers = np.array(list(curve.terms))
    x, y = 1e-2, 5e-3  # a point beside A, not on the curve
    exact = curve.values([x, y])
    plain = float((coefficients * (x * x + y * y) ** powers[:, 0] * x ** powers[:, 1]).sum())
    size = float(np.abs(coefficients).max())
    assert abs(exact) < 1e-16 * size  # below the rounding of any larger term
    assert plain == pytest.approx(float(exact), rel=1e-6)


def test_kinematics_and_locus_know_the_same_poles():
    curve, _ = locus(Fraction(1), Fraction(3), Fraction(1, 2), "fixed")
    phi = np.linspace(0, 6, 7)
    for branch in (1, -1):
        pole = acceleration_pole(SliderCrank(1.0, 3.0, 0.5, 0.0, branch).bodies(phi).rod).fixed
        values = curve.values(np.column_stack((pole.real, pole.imag)))
        moved = curve.values(np.column_stack((pole.real + 1e-3, pole.imag)))
        assert (np.abs(values) < 1e-9 * np.abs(moved)).all()
