"""The smallest cam against a linear programme, and against its neighbours."""

import math

import numpy as np
import pytest
from by_night import by_night
from scipy.optimize import minimize

from mechwright.contracts.finding import errors
from mechwright_cam_follower.family import CamFollower
from mechwright_cam_follower.kinematics.cycle import cycle_of
from mechwright_cam_follower.kinematics.mechanism import mechanism_of
from mechwright_cam_follower.requirements import SizeRequirement
from mechwright_cam_follower.synthesis.smallest_cam import keeps, smallest

RISE = {"angles": (80, 40, 110, 130), "lifts": (20, 20, 0, 0), "laws": ("modified-sine", "3-4-5")}


def found(**table):
    wanted = SizeRequirement(**table)
    return wanted, smallest(wanted, lambda done, what: None)


def test_smallest_slide_is_that_of_a_quadratic_programme():
    """|s' - e| <= tan α (s0 + s) are half planes of (e, s0); the outermost radius is √(e² + (s0 + h)²) - R."""
    wanted, answer = found(**RISE, least_curvature_radius=1.0)
    best = answer.candidates[0]
    rates = cycle_of(wanted.design()).at(np.linspace(0, math.tau, 1441))
    slope = math.tan(math.radians(30))

    def room(x):
        return np.concatenate([slope * (x[1] + rates.s) + one * (rates.v - x[0]) for one in (-1, 1)])

    nearest = minimize(
        lambda x: x[0] ** 2 + (x[1] + 20) ** 2,
        [0.0, 60.0],
        constraints={"type": "ineq", "fun": room},
        method="SLSQP",
    )
    assert nearest.success
    assert best.figures["cam_radius"].value == pytest.approx(math.sqrt(nearest.fun) - 8, abs=0.03)
    assert best.params.offset == pytest.approx(nearest.x[0], abs=0.1)
    assert keeps(mechanism_of(best.params), wanted)[0]


@pytest.mark.parametrize(
    "table",
    [
        {"contact": "flat", "least_curvature_radius": 8.0},
        {**RISE, "offset": 3.0, "least_curvature_radius": 17.0},
        pytest.param({"follower": "oscillating", "greatest_pressure_angle": 35.0}, marks=by_night),
        pytest.param({**RISE, "conjugate": True}, marks=by_night),
    ],
)
def test_a_smaller_base_breaks_a_limit(table):
    wanted, answer = found(**table)
    best = answer.candidates[0].params
    assert keeps(mechanism_of(best), wanted)[0]
    assert errors(CamFollower().check(best)) == []
    less = best.model_copy(update={"base_radius": best.base_radius - 0.05})
    assert not keeps(mechanism_of(less), wanted)[0]


def test_flat_slide_in_closed_form():
    """ρ = R_b + s + s'' is least where s + s'' is."""
    wanted, answer = found(contact="flat", least_curvature_radius=8.0)
    rates = cycle_of(wanted.design()).at(np.linspace(0, math.tau, 200001))
    assert answer.candidates[0].params.base_radius == pytest.approx(8.0 - (rates.s + rates.a).min(), abs=0.02)


def test_in_line_beside_the_best_offset():
    _, answer = found(**RISE, least_curvature_radius=1.0)
    assert [one.params.offset == 0.0 for one in answer.candidates] == [False, True]
    one, two = (candidate.figures["cam_radius"].value for candidate in answer.candidates)
    assert one < two


def test_what_cannot_be_met_is_said():
    _, answer = found(
        lifts=(200, 200, 0, 0), angles=(10, 10, 10, 330), greatest_pressure_angle=5.0, offset=0.0
    )
    assert answer.candidates == ()
    (fault,) = answer.findings
    assert fault.code == "follower.no-size"
    assert fault.remedy


def test_bad_requirements_are_one_line():
    for table, word in (
        ({"laws": ("table",)}, "table"),
        ({"lifts": (5.0, 4.0, 3.0, 1.0)}, "lifts"),
        ({"swings": (5.0,)}, "swings"),
    ):
        with pytest.raises(ValueError, match=word):
            SizeRequirement(**table)
    assert CamFollower.requirements["size"] is SizeRequirement
