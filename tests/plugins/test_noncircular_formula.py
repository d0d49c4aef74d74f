"""Laws as formulas: the same laws as by other keys, and what is no law."""

import math

import numpy as np
import pytest
from noncircular import design
from pydantic import ValidationError

from mechwright_noncircular_gears.kinematics.law import law_of
from mechwright_noncircular_gears.kinematics.laws.formula import RatioFormula
from mechwright_noncircular_gears.rules.law_rules import LAW, TURNS_BACK
from mechwright_noncircular_gears.rules.remedies import advised
from mechwright_noncircular_gears.sized import SizedParams
from mechwright_noncircular_gears.table import table_of


def found(law: str, text: str, **more: object) -> dict[str, object]:
    made = SizedParams.model_validate({"law": law, law: text, **more})
    return {one.code: advised(made, one) for one in LAW.findings(table_of(made))}


@pytest.mark.parametrize(
    ("name", "table"),
    [
        ("D1", {"law": "angle", "angle": "phi + 0.3*sin(phi)"}),
        ("D1", {"law": "ratio", "ratio": "20 + 6*cos(phi)"}),
        ("D3", {"law": "ratio", "ratio": "1/(AMINUS - cos(phi))", "mate_lobes": 2}),
        (
            "D8",
            {
                "law": "ratio",
                "ratio": "(1+0.25*cos(2*phi))/(DIST - 0.25*cos(2*phi))",
                "lobes": 2,
                "mate_lobes": 2,
            },
        ),
    ],
)
def test_a_formula_is_the_law_of_the_other_keys(name: str, table: dict[str, object]) -> None:
    """Also of pitch curves, whose ratio is r1/(a - r1)."""
    other = law_of(design(name))
    if name == "D3":  # r1 = p/(1 - e cos φ): a (1 - e cos φ) - p is what it is divided by
        p, a = 1.0, (1 + math.sqrt(1 + 3 * (1 - 0.09))) / (1 - 0.09)
        table["ratio"] = f"{p}/({a!r}*(1 - 0.3*cos(phi)) - {p})"
    if name == "D8":
        a = float(1 + 1 / other.rates(np.array(math.pi / 4))[0])  # r1 = 1 at 45 degrees
        table["ratio"] = f"(1+0.25*cos(2*phi))/({a!r} - 1 - 0.25*cos(2*phi))"
    law = law_of(SizedParams.model_validate({"teeth": 40, **table}))
    phi = np.linspace(-7, 9, 301)
    assert np.abs(law.angle(phi) - other.angle(phi)).max() < 1e-12
    for one, two in zip(law.rates(phi), other.rates(phi), strict=True):
        assert np.abs(one - two).max() < 1e-11


@pytest.mark.parametrize(("lobes", "mate"), [(1, 1), (2, 3), (3, 1)])
def test_a_ratio_is_scaled_to_close(lobes: int, mate: int) -> None:
    law = RatioFormula((lobes, mate), f"exp(0.4*sin({lobes}*phi))")
    assert float(law.angle(np.array(law.period))) == pytest.approx(math.tau / mate, rel=1e-13)
    first, second = (RatioFormula((lobes, mate), f"{k}*exp(0.4*sin({lobes}*phi))") for k in (2, 7))
    phi = np.linspace(0, 6, 41)
    assert first.rates(phi)[1] == pytest.approx(second.rates(phi)[1], rel=1e-12)


@pytest.mark.parametrize(
    ("law", "text", "code"),
    [
        ("angle", "0.9*phi", "law.closure"),
        ("angle", "phi + 0.1*sin(phi/2)", "law.corner"),
        ("ratio", "1 + phi", "law.corner"),
        ("ratio", "2 + sin(phi/2)", "law.corner"),
        ("ratio", "2 + sqrt((phi - 1)^2*(phi - 5)^2)", "law.corner"),
        ("ratio", "3 + atan(1/(phi - 2)) + 0.1*phi", "law.corner"),
        ("ratio", "1/cos(phi)^2", "law.corner"),
        ("ratio", "1/(phi - 2)", "law.corner"),
        ("ratio", "sqrt(cos(phi))", "law.formula"),
        ("ratio", "1 + 1.2*cos(phi)", "law.turns-back"),
        ("ratio", "-2 + 0.1*cos(phi)", "law.turns-back"),
        ("ratio", "0*phi", "law.turns-back"),
        ("angle", "phi + 1.2*sin(phi)", "law.turns-back"),
    ],
)
def test_what_is_no_law_is_told_with_its_place(law: str, text: str, code: str) -> None:
    finding = found(law, text)[code]
    assert finding.remedy
    for change in finding.proposed:
        ((key, value),) = change.items()
        cured = found(law, str(value))
        assert key == f"parameters.{law}"
        assert code not in cured
    assert bool(finding.proposed) == (code in {"law.turns-back", "law.closure"})


def test_the_nearest_law_that_turns_on_is_near() -> None:
    """The proposed constant leaves a ratio just above 0, so that no smaller one would do."""
    (change,) = found("ratio", "1 + 1.2*cos(phi)")["law.turns-back"].proposed
    better = SizedParams(law="ratio", ratio=change["parameters.ratio"])
    assert TURNS_BACK.allows(table_of(better))
    assert law_of(better).rates(np.array(math.pi))[0] < 2.5e-3


def test_a_formula_is_for_its_law_alone() -> None:
    for table, words in (
        ({"law": "ratio"}, "needs ratio"),
        ({"law": "ratio", "ratio": "1+", "angle": None}, "cannot be read"),
        ({"law": "angle", "ratio": "1"}, 'ratio is for law = "ratio"'),
        ({"law": "angle", "angle": "theta"}, "'theta' is no part"),
    ):
        with pytest.raises(ValidationError, match=words):
            SizedParams.model_validate(table)
