"""Exact curves: elimination against known curves, circular points against their definition, evaluation."""

import json
from fractions import Fraction

import numpy as np
import pytest
from flint import Ordering, arb, ctx, fmpq, fmpq_mpoly_ctx
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright.errors import DesignError, GeometryError
from mechwright.mechanics.algebra import PlaneCurve, eliminate, exact

CONTEXT = fmpq_mpoly_ctx.get(("S", "rho", "l"), Ordering.lex)
S, RHO, L = CONTEXT.gens()

FRACTIONS = st.fractions(-5, 5, max_denominator=20)
CURVES = st.dictionaries(
    st.tuples(st.integers(0, 4), st.integers(0, 5)), FRACTIONS.filter(bool), min_size=1, max_size=8
).map(lambda terms: PlaneCurve.of(terms, "Y"))


def multiplicity_at_a_circular_point(curve):
    """From the definition: the lowest order of F(X, Y, W) at (1 : i : 0), in Gaussian rationals."""

    def times(one, two):
        product = {}
        for (p, q), (a, b) in one.items():
            for (r, s), (c, d) in two.items():
                x, y = product.get((p + r, q + s), (0, 0))
                product[p + r, q + s] = (x + a * c - b * d, y + a * d + b * c)
        return {key: value for key, value in product.items() if value != (0, 0)}

    def power(base, count):
        result = {(0, 0): (1, 0)}
        for _ in range(count):
            result = times(result, base)
        return result

    total = {}
    y = {(0, 0): (0, 1), (1, 0): (1, 0)}  # Y = i + eta
    rho = {(1, 0): (0, 2), (2, 0): (1, 0)}  # 1 + Y^2
    for (i, j), coefficient in curve.terms.items():
        term = times(power(rho, i), power(y, j))
        for (p, q), (a, b) in term.items():
            key = (p, q + curve.degree - 2 * i - j)
            x, z = total.get(key, (0, 0))
            total[key] = (x + a * coefficient, z + b * coefficient)
    return min(p + q for (p, q), value in total.items() if value != (0, 0))


@settings(max_examples=80, deadline=None)
@given(CURVES)
def test_circularity_is_the_multiplicity_of_the_circular_points(curve):
    assert curve.circularity == multiplicity_at_a_circular_point(curve)


@settings(max_examples=60, deadline=None)
@given(CURVES, FRACTIONS, FRACTIONS)
def test_evaluation_is_exact(curve, x, y):
    expected = sum(k * (x * x + y * y) ** i * y**j for (i, j), k in curve.terms.items())
    assert curve.at(x, y) == expected


@settings(max_examples=60, deadline=None)
@given(CURVES, st.floats(-3, 3), st.floats(-3, 3))
def test_floats_are_evaluated_exactly_and_rounded_once(curve, x, y):
    rx, ry = Fraction(x), Fraction(y)
    expected = sum(k * (rx * rx + ry * ry) ** i * ry**j for (i, j), k in curve.terms.items())
    assert curve.values([x, y]) == float(expected)


@settings(max_examples=40, deadline=None)
@given(CURVES)
def test_json_round_trips(curve):
    text = curve.to_json()
    assert PlaneCurve.from_json(text) == curve
    data = json.loads(text)
    assert (data["degree"], data["circularity"], len(data["terms"])) == (
        curve.degree,
        curve.circularity,
        len(curve.terms),
    )


def test_doubles_lose_what_exact_evaluation_keeps():
    """(rho - 1)^6 beside the unit circle: the plain sum of terms is all rounding."""
    binomial = [1, -6, 15, -20, 15, -6, 1]
    curve = PlaneCurve.of({(i, 0): k for i, k in enumerate(binomial)}, "x")
    point = (1.0 + 1e-4, 0.0)
    rho = point[0] ** 2
    plain = sum(k * rho**i for i, k in enumerate(binomial))
    true = float((Fraction(point[0]) ** 2 - 1) ** 6)
    assert curve.values(point) == true
    assert abs(plain - true) > 1e6 * true


def test_values_keep_the_shape():
    circle = PlaneCurve.of({(1, 0): 1, (0, 0): -1}, "X")
    assert circle.values(np.zeros((2, 3, 2))).tolist() == [[-1.0] * 3] * 2
    assert circle.values([0.0, 1.0]).shape == ()


def test_ratio_is_small_on_the_curve_and_only_there():
    lemniscate = PlaneCurve.of({(2, 0): 1, (1, 0): 1, (0, 2): -2}, "X")  # rho^2 = x^2 - y^2
    with ctx.workdps(60):
        t = arb("0.7")
        factor = t.cos() / (1 + t.sin() ** 2)
        x, y = factor, factor * t.sin()
        on = lemniscate.ratio(x, y)
        off = lemniscate.ratio(x + arb("1e-20"), y)
    assert on < 1e-57
    assert 1e-22 < off < 1e-18


def test_eliminate_finds_a_conic():
    """A point at l = S whose distance is given: rho = S^2 / 4 + 3."""
    curve, power = eliminate(L - S, 4 * RHO - S**2 - 12, "X")
    assert power == 1
    assert curve == PlaneCurve.of({(1, 0): 4, (0, 2): -1, (0, 0): -12}, "X")


def test_eliminate_finds_a_power():
    """S and -S lead to the same point."""
    curve, power = eliminate(L - S**2, RHO - S**2 - 3, "Y")
    assert power == 2
    assert curve == PlaneCurve.of({(1, 0): 1, (0, 1): -1, (0, 0): -3}, "Y")


def test_eliminate_divides_out_what_holds_the_position_alone():
    one, two = RHO - S * L - 1, L - S**2
    # The common factor S + 5 would make the resultant vanish.
    assert eliminate((S + 5) * one, (S + 5) ** 2 * two, "X") == eliminate(one, two, "X")


def test_eliminate_goes_round_places_where_a_leading_coefficient_vanishes():
    one, two = (RHO - L + 1) * (RHO - 3) * S**2 - L, (L - 4) * S - RHO
    direct = one.resultant(two, "S")
    curve, _ = eliminate(one, two, "Y")
    terms = {key[1:]: Fraction(int(value.p), int(value.q)) for key, value in direct.to_dict().items()}
    assert curve == PlaneCurve.of(terms, "Y")


def test_the_interpolated_resultant_is_the_resultant():
    first = (RHO - 1) * S**2 + (L + 2) * S - fmpq(7, 3)
    second = (L - 1) * S**3 + RHO * S - 5
    direct = first.resultant(second, "S")
    curve, power = eliminate(first, second, "Y")
    terms = {key[1:]: Fraction(int(value.p), int(value.q)) for key, value in direct.to_dict().items()}
    assert power == 1
    assert curve == PlaneCurve.of(terms, "Y")


def test_degenerate_eliminations_are_named():
    with pytest.raises(GeometryError, match="factor in common"):
        eliminate((S - L) * (S + RHO), (S - L) * (S - RHO + 2), "X")
    with pytest.raises(GeometryError, match="unequally often"):
        eliminate(L - S, (RHO - S) ** 2 * (RHO + 1), "X")


def test_numbers():
    assert exact(2.5) == Fraction(5, 2)
    assert exact(0.1) == Fraction(1, 10)
    for wrong in ("two", "1/0", float("nan"), float("inf")):
        with pytest.raises(DesignError, match="no finite number"):
            exact(wrong)


def test_wrong_curves_are_refused():
    with pytest.raises(GeometryError, match="not 0"):
        PlaneCurve.of({(0, 0): 0}, "X")
    with pytest.raises(GeometryError, match="axis 'z'"):
        PlaneCurve.of({(1, 0): 1}, "z")
    for text in ("", "[]", '{"terms": [[1, 2]], "axis": "X"}', '{"terms": [[1, 2, "a"]], "axis": "X"}'):
        with pytest.raises(GeometryError):
            PlaneCurve.from_json(text)
