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
from mechwright_noncircular_gears.params import NoncircularParams

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
    params = NoncircularParams.model_validate({**table, "bore": 4, "cutter": "rack"})
    wrong = errors(FAMILY.check(params), Stage.PARTS)[0]
    assert wrong.code in {"law.turns-back", "gear.convexity"}
    passed = []
    for change in wrong.proposed:
        own = {key.removeprefix("parameters."): value for key, value in change.items()}
        softer = NoncircularParams.model_validate({**params.model_dump(), **own})
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
    params = NoncircularParams.model_validate({**table, "bore": 4})
    wrong = errors(FAMILY.judge(params), Stage.PARTS)[0]
    assert wrong.code == "gear.tip-fillet"
    own = {key.removeprefix("parameters."): value for key, value in wrong.proposed[0].items()}
    assert not errors(FAMILY.judge(params.model_copy(update=own)), Stage.PARTS)
