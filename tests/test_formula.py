"""Formulas and their derivatives against an independent differentiation in 40 digits, and what is no formula."""

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright.mechanics.formula import FUNCTIONS, LONGEST, Formula, FormulaError

KNOWN = {name: getattr(mpmath, name) for name in FUNCTIONS} | {"pi": mpmath.pi}

INNER = {"asin": "0.4*sin(x)", "acos": "x/9", "log": "2 + cos(x)", "sqrt": "x^2 + 1", "tan": "x/7"}
"""Function to an argument at which it is defined; others take ``x*x/3 - x``."""

TEXTS = [
    *(f"{name}({INNER.get(name, 'x*x/3 - x')})" for name in FUNCTIONS),
    "1/(2 + x) - x/3*-2",
    "x**3 - 2*x^2 + +x - 7",
    "(1 + x^2)^(x/2)",
    "2^x * x^-1.5 * exp(-x)",
    "sin(cos(x)^3*pi)/log(3 + x)",
]


@settings(max_examples=6, deadline=None)
@given(st.floats(0.05, 2.0))
@pytest.mark.parametrize("text", TEXTS)
def test_derivatives_are_those_of_forty_digits(text: str, at: float) -> None:
    def exact(x: object) -> object:
        return eval(text.replace("^", "**"), dict(KNOWN), {"x": x})

    with mpmath.workdps(40):
        expected = [float(mpmath.diff(exact, mpmath.mpf(at), order)) for order in range(4)]
    found = [float(one) for one in Formula(text, "x")(np.array(at))]
    assert found == pytest.approx(expected, rel=1e-11, abs=1e-11)


def test_a_power_of_a_negative_number_has_its_derivatives() -> None:
    value, first, second, third = Formula("x^2", "x")(np.array([-1.5, 0.0]))
    assert value.tolist() == [2.25, 0.0]
    assert (first.tolist(), second.tolist(), third.tolist()) == ([-3.0, 0.0], [2.0, 2.0], [0.0, 0.0])


def test_where_it_is_not_defined_it_is_not_finite() -> None:
    value, first, *_ = Formula("sqrt(x)", "x")(np.array([-1.0, 0.0]))
    assert np.isnan(value[0])
    assert not np.isfinite(first[1])


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("1 +", "cannot be read"),
        ("sin(x", "cannot be read"),
        ("y + 1", "'y' is no part"),
        ("__import__('os').system('ls')", "is no part"),
        ("x.real", "'x.real' is no part"),
        ("[x]", "is no part"),
        ("(lambda: 1)()", "is no part"),
        ("x and 1", "is no part"),
        ("1 if x else 2", "is no part"),
        ("x // 2", "is no part"),
        ("True", "'True' is no part"),
        ("2j", "'2j' is no part"),
        ("'a'", "is no part"),
        ("abs(x)", r"'abs\(x\)' is no part"),
        ("cos(x, 2)", "takes one value"),
        ("cos(x=2)", "takes one value"),
        ("cos", "'cos' is no part"),
        ("9" * 400, "beyond 1e308"),
        ("x" + "+x" * LONGEST, "characters"),
        ("(" * 240 + "x" + ")" * 240, "no formula"),
        ("x\0", "no formula"),
        ("", "no formula"),
    ],
)
def test_what_is_no_formula_says_so_in_one_line(text: str, words: str) -> None:
    with pytest.raises(FormulaError, match=words) as raised:
        Formula(text, "x")
    assert "\n" not in str(raised.value)
    assert len(str(raised.value)) < 300
