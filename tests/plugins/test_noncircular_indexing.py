"""The law that drives a straight Geneva wheel with the least acceleration, against the reference."""

import math
from itertools import pairwise

import numpy as np
import pytest
from by_night import examples
from hypothesis import given, settings
from hypothesis import strategies as st
from plugins.noncircular import design

from mechwright.contracts.finding import errors
from mechwright.mechanics.gearing import FIT
from mechwright.mechanics.laws import Law
from mechwright_geneva.kinematics.straight_slot import StraightSlot
from mechwright_noncircular_gears.family import NoncircularGears
from mechwright_noncircular_gears.kinematics.law import law_of
from mechwright_noncircular_gears.kinematics.laws.indexing import IndexLaw
from mechwright_noncircular_gears.sized import SizedParams
from mechwright_noncircular_gears.table import table_of


@settings(max_examples=examples(6, 60), deadline=None)
@given(
    slots=st.integers(3, 12),
    ramp=st.floats(0.05, 0.45),
    window=st.floats(90, 220),
    share=st.floats(0.3, 0.95),
)
def test_wheel_behind_the_law_is_the_wanted_one(slots: int, ramp: float, window: float, share: float) -> None:
    """Through the wheel's own closed form: its acceleration is Ca Δ/β² times the clipped ramp everywhere."""
    law = IndexLaw((1, 1), slots, ramp, math.radians(window), math.radians(share * (178 - window / 2)))
    wheel: Law = StraightSlot(slots)
    v = np.linspace(-0.4999, 0.4999, 41)
    phi = v * law.width
    i, first, _ = law.rates(phi)
    crank = math.pi - math.tau / slots  # of a stroke
    rates = wheel.at(
        0.5
        + law.angle(np.where(phi < 0, phi + math.tau, phi)) / crank
        - np.where(phi < 0, math.tau, 0.0) / crank
    )
    way = math.tau / slots
    found = way * (rates.a * (i / crank) ** 2 + rates.v * first / crank)
    wanted = -law.constant * way / law.width**2 * np.clip(v / ramp, -1, 1)
    np.testing.assert_allclose(found, wanted, atol=1e-7 * law.constant * way / law.width**2)
    assert law.angle(np.asarray(math.tau)) == pytest.approx(math.tau, abs=1e-12)


@pytest.mark.parametrize("name", ["GP4", "GP6"])
def test_ratio_has_no_jump_up_to_its_second_derivative_but_in_the_ramp(name: str) -> None:
    """At ends of index and blends, and where the series takes over; derivatives are slopes between."""
    law = law_of(design(name))
    assert isinstance(law, IndexLaw)
    half = law.width / 2
    for place in (half, half - 0.05, half + law.blend, math.pi):
        before, after = (law.rates(np.asarray(place + way)) for way in (-1e-9, 1e-9))
        for one, two in zip(before, after, strict=True):
            assert float(one) == pytest.approx(float(two), abs=1e-7)
    phi, way = np.linspace(-3.0, 3.0, 50) + 0.0123, 1e-5
    low, here, high = (law.rates(phi + step) for step in (-way, 0.0, way))
    for order in (0, 1):
        np.testing.assert_allclose((high[order] - low[order]) / (2 * way), here[order + 1], atol=1e-7)


@pytest.mark.parametrize(
    ("fields", "said"),
    [
        ({"window": 200, "blend": 90}, "make blend 78"),
        ({"mate_lobes": 2}, "set mate_lobes = 1"),
        ({"law": "fourier", "slots": 6}, 'slots is for law = "geneva"'),
    ],
)
def test_fields_that_do_not_go_together_are_refused(fields: dict[str, object], said: str) -> None:
    """With what to do."""
    with pytest.raises(ValueError, match=said):
        SizedParams.model_validate({"law": "geneva", **fields})


@pytest.mark.parametrize(
    ("slots", "window", "teeth", "ramp"), [(8, 160, 40, 0.145), (6, 165, 37, 0.3), (5, 150, 52, 0.2)]
)
def test_where_the_curvature_jumps_an_outline_is_cut(
    slots: int, window: float, teeth: int, ramp: float
) -> None:
    """A fit across the ends of the ramp rippled: 2,000 segments for 40 teeth, of which no solid was made.

    Each of six curves of a tooth is a segment or two, finer ones where the lever is short, and one more for each
    jump that it crosses.
    """
    params = SizedParams(law="geneva", slots=slots, window=window, teeth=teeth, ramp=ramp)
    for teeth_of_one, outline in zip(table_of(params).teeth, table_of(params).outlines, strict=True):
        curve = teeth_of_one.curve
        assert curve.breaks.size == 2
        beside = 1 / curve.frame(curve.breaks[:, None] + np.array([-1e-5, 1e-5])).radius
        assert np.abs(np.diff(beside)).min() > 1e-4
        assert len(outline.outer.segments) < 10 * teeth
        assert outline.deviation < FIT
        for one, two in pairwise(outline.outer.segments):
            if one.tag == two.tag:
                assert one.end == two.start
                assert one.derivative(1.0) / np.linalg.norm(one.derivative(1.0)) == pytest.approx(
                    two.derivative(0.0) / np.linalg.norm(two.derivative(0.0)), abs=0.02
                )


def test_the_nearest_index_that_works_is_named() -> None:
    """A longer move and a longer ramp, as little as the shaper needs, with the blends that fit beside it."""
    params = SizedParams.model_validate(
        {"law": "geneva", "slots": 3, "ramp": 0.337, "window": 164, "teeth": 37}
    )
    (wrong,) = errors(NoncircularGears().check(params))
    assert wrong.code == "gear.convexity"
    change = {key.removeprefix("parameters."): value for key, value in wrong.proposed[0].items()}
    assert 164 < change["window"] < 190
    assert 0.337 < change["ramp"] < 0.42
    nearest = SizedParams.model_validate({**params.model_dump(), **change})
    assert wrong.code not in [one.code for one in errors(NoncircularGears().judge(nearest))]
