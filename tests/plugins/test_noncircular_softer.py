"""Laws that come near to standing still, and strokes of sliders: each has a softer one that works."""

import math

import numpy as np
import pytest
from scipy.special import ellipe

from mechwright.arrays import Array
from mechwright.contracts.finding import Stage, errors
from mechwright.errors import GeometryError
from mechwright.mechanics.gearing import Primitive
from mechwright_noncircular_gears.family import NoncircularGears
from mechwright_noncircular_gears.kinematics.law import extremes_of, fastest_of, law_of, slowest_of
from mechwright_noncircular_gears.sized import SizedParams

FAMILY = NoncircularGears()


def test_integral_of_what_nearly_vanishes() -> None:
    """Terms of 1 that cancel to a thousandth leave rounding of 1: it is not sought to be smooth below that."""
    least = 1e-3

    def function(x: Array) -> Array:
        value: Array = np.hypot(1 + np.cos(x) + least, np.sin(x))
        return value

    # The square is (1 + c)² (1 - k sin²(x/2)), c = 1 + least: an elliptic integral of the second kind.
    c = 1 + least
    exact = 4 * (1 + c) * ellipe(4 * c / (1 + c) ** 2)
    assert Primitive.of(function, math.tau).total == pytest.approx(exact, rel=1e-14)


def test_jumps_are_still_found() -> None:
    with pytest.raises(GeometryError, match="jumps"):
        Primitive.of(lambda x: np.where(x > 1, 1 + 1e-9, 1.0), math.tau)


@pytest.mark.parametrize(
    "table",
    [
        {"law": "fourier", "teeth": 64, "mate_lobes": 2, "sines": [-2.3, -6.94, 7.53]},
        {"law": "fourier", "teeth": 28, "sines": [-8.0, 17.63, -17.44]},
        {"law": "slider", "teeth": 71, "rod_ratio": 2.92, "stroke_start": 40.0, "stroke_end": 140.0},
        {"law": "slider", "teeth": 26, "rod_ratio": 4.56, "stroke_start": 64.0, "stroke_end": 110.0},
        {"law": "slider", "teeth": 51, "rod_ratio": 3.03, "stroke_start": 46.0, "stroke_end": 139.0},
    ],
)
def test_refused_with_a_change_that_gets_past_it(table: dict[str, object]) -> None:
    params = SizedParams.model_validate({**table, "bore": 4, "cutter": "rack"})
    wrong = errors(FAMILY.check(params), Stage.PARTS)[0]
    assert wrong.code in {"law.turns-back", "gear.convexity"}
    passed = []
    for change in wrong.proposed:
        own = {key.removeprefix("parameters."): value for key, value in change.items()}
        softer = SizedParams.model_validate({**params.model_dump(), **own})
        passed.append(wrong.code not in [one.code for one in errors(FAMILY.judge(softer), Stage.PARTS)])
    assert any(passed)


RING = {"law": "window", "teeth": 37, "mate_lobes": 2, "internal": True, "window_ratio": 0.409, "window": 62}


@pytest.mark.parametrize(
    "table",
    [
        {"law": "window", "teeth": 48, "module": 2, "window_ratio": 1.45, "window": 90, "blend": 90},
        {**RING, "blend": 81},
    ],
)
def test_tips_of_both_gears_are_made_lower_at_once(table: dict[str, object]) -> None:
    """Where both would run into fillets, the change of the first finding leaves none of the other gear."""
    params = SizedParams.model_validate({**table, "bore": 4})
    wrong = errors(FAMILY.check(params), Stage.PARTS)[0]
    assert wrong.code == "gear.tip-fillet"
    own = {key.removeprefix("parameters."): value for key, value in wrong.proposed[0].items()}
    assert not errors(FAMILY.judge(params.model_copy(update=own)), Stage.PARTS)


@pytest.mark.parametrize(
    ("table", "code"),
    [
        ({"law": "fourier", "sines": [70]}, "law.turns-back"),
        ({"law": "ratio", "ratio": "1 + 1.3*cos(phi)"}, "law.turns-back"),
        (
            {"law": "slider", "teeth": 48, "rod_ratio": 1.5, "stroke_start": 20, "stroke_end": 160},
            "law.turns-back",
        ),
        ({"law": "window", "window_ratio": 3.5, "window": 120, "blend": 60}, "law.turns-back"),
        ({"law": "ratio", "ratio": "1 + 0.3*sqrt(sin(phi)^2)"}, "law.formula"),
        ({"law": "ratio", "ratio": "1 + 0.1*phi"}, "law.corner"),
        ({"law": "angle", "angle": "phi + 0.1*phi*(2*pi - phi)/pi"}, "law.corner"),
        ({"law": "fourier", "teeth": 46, "mate_lobes": 2, "internal": True, "sines": [-26.5]}, "law.ring"),
    ],
)
def test_a_law_that_cannot_run_is_told_with_the_nearest_that_can_be_built(
    table: dict[str, object], code: str
) -> None:
    """The last of what is proposed leaves no error at all, and keeps a change of ratio."""
    params = SizedParams.model_validate({**table, "bore": 4})
    wrong = errors(FAMILY.check(params), Stage.PARTS)[0]
    assert wrong.code == code
    own = {key.removeprefix("parameters."): value for key, value in wrong.proposed[-1].items()}
    near = SizedParams.model_validate({**params.model_dump(), **own})
    assert not errors(FAMILY.judge(near), Stage.PARTS)
    found = extremes_of(near)
    assert found.fastest.value > 1.05 * found.slowest.value


def test_the_fit_of_a_formula_with_a_corner_is_near_it() -> None:
    """Away from the corner the harmonics are within a hundredth of the ratio that was asked for."""
    asked = SizedParams.model_validate({"law": "ratio", "ratio": "1 + 0.3*sqrt(sin(phi)^2)", "bore": 4})
    own = errors(FAMILY.check(asked))[0].proposed[-1]
    fields = {key.removeprefix("parameters."): value for key, value in own.items()}
    near = SizedParams.model_validate({**asked.model_dump(), **fields})
    phi = np.linspace(0.5, math.pi - 0.5, 41)
    wanted = (1 + 0.3 * np.sin(phi)) / (1 + 0.6 / math.pi)
    assert np.abs(law_of(near).rates(phi)[0] - wanted).max() < 0.012


@pytest.mark.parametrize("nodes", [[[0, 0], [1, 0.9], [2, 1.8], [4, 4.2], [6, 6]]])
def test_a_table_in_rad_is_told(nodes: list[list[float]]) -> None:
    with pytest.raises(ValueError, match="as angles in rad would; write them in degrees"):
        SizedParams.model_validate({"law": "table", "nodes": nodes})


def test_a_steep_formula_keeps_its_ratios_and_not_its_steepness() -> None:
    """Softened until gears could be made it would be next to constant: its harmonics keep half of the change."""
    table = {"law": "ratio", "ratio": "1 + 0.3*tanh(80*sin(phi))", "bore": 4}
    params = SizedParams.model_validate(table)
    wrong = errors(FAMILY.check(params), Stage.PARTS)[0]
    assert wrong.code == "gear.convexity"
    own = {key.removeprefix("parameters."): value for key, value in wrong.proposed[0].items()}
    mended = SizedParams.model_validate({**params.model_dump(), **own})
    assert not errors(FAMILY.judge(mended), Stage.PARTS)
    law = law_of(mended)
    assert fastest_of(law).value - slowest_of(law).value > 0.3
