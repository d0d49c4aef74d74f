"""Laws fitted to wishes, judged by what the wish means, computed in another way than the search does."""

import math

import numpy as np
import pytest

from mechwright import Candidate, Scalar
from mechwright_noncircular_gears.family import NoncircularGears
from mechwright_noncircular_gears.kinematics.law import extremes_of, law_of
from mechwright_noncircular_gears.parts.cutter import profile_of
from mechwright_noncircular_gears.requirements import (
    REQUIREMENTS,
    ApproachRequirement,
    FitRequirement,
    GenevaRequirement,
    QuickReturnRequirement,
    SliderRequirement,
)
from mechwright_noncircular_gears.sized import SizedParams
from mechwright_noncircular_gears.synthesis.goals import goal_of
from mechwright_noncircular_gears.synthesis.search import fitted
from mechwright_noncircular_gears.synthesis.waves import Asked, Waves

STEP = 1e-4


def best(kind: str, **wanted: object) -> tuple[SizedParams, dict[str, float]]:
    requirement = REQUIREMENTS[kind].model_validate(wanted)
    found = NoncircularGears().synthesise(kind, requirement, lambda *_: None)
    assert not found.findings
    first = found.candidates[0]
    assert not [one for one in NoncircularGears().check(first.params) if one.severity == "error"]
    return first.params, {"residual": first.residual.value, **{k: v.value for k, v in first.figures.items()}}


def wheel(slots: int, crank: np.ndarray) -> np.ndarray:
    """Angle of a wheel with straight slots, by the place of the roller, axes 1 apart."""
    at = 1 - math.sin(math.pi / slots) * np.exp(1j * crank)
    return -np.angle(at)


@pytest.mark.parametrize(("slots", "harmonics"), [(4, 12), (6, 8)])
def test_a_geneva_wheel_accelerates_hardly_more_than_any_wheel_has_to(slots: int, harmonics: int) -> None:
    """8.49 and 5.65 at constant speed of the crank; 4 is the least between rest and rest."""
    beta = math.pi
    params, told = best("geneva", slots=slots, index_angle=180, harmonics=harmonics, hollow=False)
    law, half = law_of(params), math.pi / 2 - math.pi / slots
    assert law.angle(np.array([-beta / 2, beta / 2])) == pytest.approx([-half, half], abs=2e-6)
    phi = np.linspace(-beta / 2 + STEP, beta / 2 - STEP, 2001)
    w = [wheel(slots, law.angle(phi + shift)) for shift in (-STEP, 0.0, STEP)]
    peak = np.abs(w[0] - 2 * w[1] + w[2]).max() / STEP**2 * beta**2 / (math.tau / slots)
    assert peak == pytest.approx(told["residual"], rel=2e-3)
    assert 4 < peak < 4.2
    # Convex as rounded, too: a rack's teeth, without being told.
    assert not profile_of(params).round


def test_the_better_law_has_hollow_curves_and_teeth_low_enough_for_them() -> None:
    """Teeth of 0.8 modules, as a shaper's usually are, would run into the fillets of their mates."""
    params, told = best("geneva", slots=4, index_angle=180, teeth=60, harmonics=10)
    assert told["curvature_min"] < 0
    assert 4 < told["residual"] < 4.04
    assert profile_of(params).addendum < 0.8
    usual = params.model_copy(update={"addendum": None})
    assert [one.code for one in NoncircularGears().check(usual) if one.severity == "error"] == [
        "gear.tip-fillet"
    ]


def test_a_slider_keeps_its_speed() -> None:
    params, told = best("slider", rod_ratio=4.0, pressure_limit=40, harmonics=8, hollow=False)
    law, window = law_of(params), math.radians(150)
    phi = np.linspace(-window / 2 + STEP, window / 2 - STEP, 1501)

    def place(turned: np.ndarray) -> np.ndarray:
        t = law.angle(turned) + told["crank_at_zero"]
        return np.cos(t) + np.sqrt(16 - np.sin(t) ** 2)

    speed = (place(phi + STEP) - place(phi - STEP)) / (2 * STEP)
    ends = place(np.array([-window / 2, window / 2]))
    crank = law.angle(np.array([-window / 2, window / 2])) + told["crank_at_zero"]
    assert np.degrees(crank) == pytest.approx([50, 130], abs=1e-3)
    deviation = np.abs(speed / ((ends[1] - ends[0]) / window) - 1).max()
    assert 100 * deviation == pytest.approx(told["residual"], rel=1e-2)
    assert deviation < 0.02
    assert math.degrees(told["pressure_angle_max"]) <= 40 + 1e-3
    # At constant speed of the crank it varies by more than a fifth of its mean.
    t = np.radians(np.linspace(50, 130, 81))
    plain = np.sin(t) + np.sin(t) * np.cos(t) / np.sqrt(16 - np.sin(t) ** 2)
    assert np.ptp(plain) / plain.mean() > 0.2


def test_a_quick_return_is_as_quick_as_it_is_asked_and_flatter_than_a_window() -> None:
    params, told = best("quick-return", time_ratio=1.6, harmonics=6)
    law = law_of(params)
    slow = math.tau * 1.6 / 2.6
    turned = law.angle(np.array([-slow / 2, slow / 2]))
    assert turned[1] - turned[0] == pytest.approx(math.pi, abs=1e-5)
    assert extremes_of(params).steepest.value == pytest.approx(told["residual"], rel=1e-3)
    # A window of constant ratio over the same part of the turn, however soft its blends, is steeper.
    for blend in (40, 60, 75):
        width = math.degrees(slow) - blend
        window = SizedParams.model_validate(
            {"law": "window", "window": width, "blend": blend, "window_ratio": math.pi / slow}
        )
        assert extremes_of(window).steepest.value > told["residual"]


def test_an_approach_is_as_slow_as_the_limits_allow() -> None:
    """A wider window, or a lower pressure limit, leaves it faster."""
    ratios = []
    for table in ({"window": 60}, {"window": 100}, {"window": 60, "pressure_limit": 40}):
        params, told = best("approach", harmonics=4, hollow=False, **table)
        half = math.radians(table["window"]) / 2
        ratio = law_of(params).rates(np.linspace(-half, half, 401))[0]
        assert ratio.max() == pytest.approx(told["residual"], abs=1e-5)
        assert told["ratio_min"] >= 0.15 - 1e-6
        assert math.degrees(told["pressure_angle_max"]) <= table.get("pressure_limit", 50) + 1e-3
        ratios.append(told["residual"])
    assert ratios[0] < ratios[1] < 1
    assert ratios[0] < ratios[2] < 1


def test_more_harmonics_follow_a_wish_more_closely() -> None:
    wanted = [GenevaRequirement(harmonics=count) for count in (3, 6, 12)]
    found = [fitted(goal_of(one), one, True) for one in wanted]
    assert all(one.holds for one in found)
    peaks = [one.unknowns[0] for one in found]
    assert peaks[0] > peaks[1] > peaks[2] > 4


def test_what_no_law_reaches_is_told_with_the_nearest() -> None:
    wanted = QuickReturnRequirement(time_ratio=9.0, pressure_limit=30, harmonics=3)
    found = NoncircularGears().synthesise("quick-return", wanted, lambda *_: None)
    assert not found.candidates
    (finding,) = found.findings
    assert "was found from" in finding.message
    nearest = finding.limit
    assert 1.01 < nearest < 9
    best("quick-return", time_ratio=nearest, pressure_limit=30, harmonics=3)
    farther = QuickReturnRequirement(time_ratio=1.1 * nearest, pressure_limit=30, harmonics=3)
    assert not fitted(goal_of(farther), farther, True).holds


@pytest.mark.parametrize(
    "wanted",
    [GenevaRequirement(), SliderRequirement(), QuickReturnRequirement(), ApproachRequirement()],
    ids=lambda one: type(one).__name__,
)
def test_slopes_of_what_is_asked_are_those_of_differences(wanted: FitRequirement) -> None:
    goal = goal_of(wanted)
    waves = Waves(np.linspace(-0.9, 1.1, 7), np.arange(1.0, 4.0), goal.even)
    z = np.concatenate((np.linspace(0.1, 0.02, waves.count), goal.start))
    for function in (*goal.bounded(), *(one for _, one in goal.places()), lambda at: at.curvatures[1]):
        asked = Asked(waves, function)
        for k, column in enumerate(np.eye(z.size)):
            slope = (asked.values(z + 1e-6 * column) - asked.values(z - 1e-6 * column)) / 2e-6
            assert asked.slopes(z)[:, k] == pytest.approx(slope, abs=2e-7)


def test_what_was_made_least_is_no_miss_of_what_was_asked() -> None:
    """A quick return that is met exactly was told with a "residual 12.86 deg": the slope of its gears."""
    goals = [goal_of(kind()) for kind in REQUIREMENTS.values()]
    assert [one.measure for one in goals] == ["greatest_ca", "deviation", "greatest_slope", "greatest_ratio"]
    one = Candidate(SizedParams(), Scalar(0.2, "rad"), {}, goals[2].measure)
    assert list(one.shown) == ["greatest_slope"]
    assert one.as_dict()["residual"]["value"] == pytest.approx(math.degrees(0.2))
