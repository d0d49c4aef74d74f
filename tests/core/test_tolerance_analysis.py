"""The engine: zones, drawing, first order, worst case, yield; on a model whose errors are known."""

import math
import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright import Contributor, DesignError, Output, ToleranceModel, Tolerances, Zone
from mechwright.contracts.pairs import pair_of
from mechwright.contracts.tolerance_settings import OwnTolerance, ToleranceSettings
from mechwright.contracts.tolerances import DISTRIBUTIONS
from mechwright.mechanics.tolerance import analyse, check_keys, share_of
from mechwright.mechanics.tolerance.first_order import farthest, limits, variances
from mechwright.mechanics.tolerance.places import worst_place
from mechwright.mechanics.tolerance.trials import draw
from mechwright.pipeline.tolerances.report import remarks

HANDBOOK = {
    (3, 6): {"H7": (0, 12), "H8": (0, 18), "g6": (-12, -4), "f7": (-22, -10), "h6": (-8, 0), "e8": (-38, -20),
             "k6": (1, 9), "m6": (4, 12), "n6": (8, 16), "p6": (12, 20)},
    (6, 10): {"H7": (0, 15), "H8": (0, 22), "g6": (-14, -5), "f7": (-28, -13), "h6": (-9, 0), "e8": (-47, -25),
              "k6": (1, 10), "m6": (6, 15), "n6": (10, 19), "p6": (15, 24)},
    (10, 18): {"H7": (0, 18), "H8": (0, 27), "g6": (-17, -6), "f7": (-34, -16), "h6": (-11, 0), "e8": (-59, -32),
               "k6": (1, 12), "m6": (7, 18), "n6": (12, 23), "p6": (18, 29)},
    (18, 30): {"H7": (0, 21), "H8": (0, 33), "g6": (-20, -7), "f7": (-41, -20), "h6": (-13, 0), "e8": (-73, -40),
               "k6": (2, 15), "m6": (8, 21), "n6": (15, 28), "p6": (22, 35)},
    (30, 50): {"H7": (0, 25), "H8": (0, 39), "g6": (-25, -9), "f7": (-50, -25), "h6": (-16, 0), "e8": (-89, -50),
               "k6": (2, 18), "m6": (9, 25), "n6": (17, 33), "p6": (26, 42)},
}  # fmt: skip
"""Limits of ISO 286-2, µm, by range of diameters, over the one and up to the other."""


def test_limits_of_a_pair_are_those_of_its_hole_and_of_its_shaft():
    pair = pair_of(8, "F8/h6")
    assert (pair.hole, pair.shaft) == (pytest.approx((0.013, 0.035)), pytest.approx((-0.009, 0.0)))
    assert (pair.least, pair.greatest) == (pytest.approx(0.013), pytest.approx(0.044))


class Line(ToleranceModel):
    """An error that is linear by construction; at x the slope of the first contributor is 1 + sin x."""

    input_name = "x"
    positions = np.linspace(0, 2 * np.pi, 73)
    contributors = (
        Contributor("a", "length distribution", "mm", 10.0, (Zone(-0.1, 0.1),)),
        Contributor("b", "length distribution", "mm", 5.0, (Zone(0.0, 0.3, "uniform"),)),
        Contributor("pin", "fit distribution", "mm", 0.0, (Zone(0.0, 0.012), Zone(0.004, 0.012)), 2),
    )
    outputs = (
        Output("error", "mm"),
        Output("play", "mm", figure="least"),
        Output("ripple", "mm", figure="spread"),
    )

    def nominal(self, output, at):
        return (0.8 + 0.2 * np.cos(at))[None]

    def sensitivities(self, output, at):
        one = np.ones(at.shape)
        return [(1 + np.sin(at))[None, None], -2 * one[None, None], np.stack([3 * one, 0 * one])[None]]

    def errors(self, output, deviations, at):
        a, b, pin = deviations
        return ((1 + np.sin(at)) * a[0] - 2 * b[0] + 3 * pin[0])[None]


def analysed(**more):
    return analyse(Line(), Tolerances(ToleranceSettings(**more)))


@pytest.mark.parametrize("over", HANDBOOK)
def test_fits_are_those_of_the_handbook(over):
    for size in (over[0] + 0.01, over[1]):
        found = HANDBOOK[over]
        for shaft in ("g6", "f7", "h6", "e8", "k6", "m6", "n6", "p6"):
            for hole in ("H7", "H8"):
                pair = pair_of(size, f"{hole}/{shaft}")
                assert [round(1000 * x) for x in (*pair.hole, *pair.shaft)] == [*found[hole], *found[shaft]]


def test_fits_go_up_to_400_mm():
    assert pair_of(400, "H7/g6").greatest == pytest.approx(0.111)
    with pytest.raises(DesignError, match=r"diameter of 400.1 mm; the table goes up to 400 mm"):
        pair_of(400.1, "H7/g6")


@pytest.mark.parametrize("text", ["H7", "g6/H7", "H7/z6", "H77/g6", "H7/k8", "Z7/g6", "", "H4/h6"])
def test_what_is_no_fit_is_refused(text):
    with pytest.raises(DesignError, match="is no fit"):
        pair_of(8, text)


@pytest.mark.parametrize("kind", DISTRIBUTIONS)
@given(
    low=st.floats(-1, 1),
    width=st.floats(1e-3, 2),
    seed=st.integers(0, 2**32 - 1),
)
@settings(max_examples=5, deadline=None)
def test_what_is_drawn_has_the_mean_and_the_sigma_of_its_zone(kind, low, width, seed):
    zone = Zone(low, low + width, kind)
    (found,) = draw([Contributor("a", "", "mm", 0.0, (zone,))], np.random.default_rng(seed), 40_000)
    assert zone.lower <= found.min() <= found.max() <= zone.upper
    assert found.mean() == pytest.approx(zone.middle, abs=5 * zone.sigma / 200)
    assert found.std() == pytest.approx(zone.sigma, rel=0.03)


@pytest.mark.parametrize("directions", [1, 2])
def test_a_pin_lies_anywhere_in_its_hole(directions):
    pin = Contributor("pin", "", "mm", 0.02, (Zone(0.0, 0.015), Zone(0.005, 0.014)), directions)
    (found,) = draw([pin], np.random.default_rng(3), 200_000)
    radius = np.sqrt((found**2).sum(axis=0))
    assert found.shape == (directions, 200_000)
    assert 0.0125 <= radius.min() <= radius.max() <= 0.0245
    for row in found:
        assert row.mean() == pytest.approx(0, abs=1e-4)
        assert row.var() == pytest.approx(pin.variance, rel=0.01)


def test_a_clearance_below_zero_is_fitted():
    pin = Contributor("pin", "", "mm", 0.0, (Zone(-0.01, 0.01, "uniform"),), 1)
    (found,) = draw([pin], np.random.default_rng(1), 1000)
    assert (pin.lower, pin.reach) == (0.0, 0.005)
    assert (np.abs(found) == 0).sum() == pytest.approx(500, abs=80)


def test_worst_case_sigma_and_shares_of_a_linear_error():
    error = analysed().results[0]
    place = error.worst
    assert place.at[0] == pytest.approx(np.pi / 2, abs=1e-3)
    assert place.high == pytest.approx(2 * 0.1 + 0 + 3 * 0.012)
    assert place.low == pytest.approx(-2 * 0.1 - 2 * 0.3 - 3 * 0.012)
    assert place.mean == pytest.approx(-0.3)
    a, _, pin = Line.contributors
    parts = [4 * a.variance, 4 * 0.3**2 / 12, 9 * pin.variance]
    assert place.sigma == pytest.approx(math.sqrt(sum(parts)))
    assert place.shares == pytest.approx([part / sum(parts) for part in parts])
    (trial,) = error.trials
    assert trial.sigma == pytest.approx(place.sigma, rel=0.01)
    assert trial.mean == pytest.approx(place.mean, rel=0.01)
    assert place.low < trial.least < trial.greatest < place.high


def test_figures_of_the_whole_turn():
    _, play, ripple = analysed(limit_length=0.5).results
    assert play.worst.nominal == pytest.approx(0.60, abs=0.03)
    (trial,) = play.trials
    assert trial.at is None
    assert trial.least > play.worst.low
    assert 0.9 < trial.kept.lower < trial.kept.value < trial.kept.upper < 1
    assert trial.half_9973 < 0 < trial.half_95
    # Between 0 and half a turn cos gives 0.4, and sin nothing.
    assert ripple.worst.nominal == pytest.approx(0.4, abs=0.15)
    (trial,) = ripple.trials
    assert trial.mean == pytest.approx(0.4, abs=0.02)
    assert trial.greatest <= ripple.worst.high + 1e-12


def test_the_farthest_corner_of_a_point_is_that_of_a_search():
    rng = np.random.default_rng(5)
    sizes = [
        Contributor(f"s{i}", "", "mm", 0.0, (Zone(-x, 2 * x),)) for i, x in enumerate(rng.uniform(0.1, 1, 5))
    ]
    pins = [Contributor(f"p{i}", "", "mm", 0.4, (), 2) for i in range(2)]
    for components in (2, 3):
        row = [rng.normal(size=(components, one.components)) for one in (*sizes, *pins)]
        found = float(farthest((*sizes, *pins), row))
        best = 0.0
        turns = np.linspace(0, 2 * np.pi, 73)
        discs = np.stack(np.meshgrid(turns, turns)).reshape(2, -1)
        moved = sum(0.2 * row[5 + i] @ np.stack([np.cos(discs[i]), np.sin(discs[i])]) for i in range(2))
        for corner in np.ndindex(*(2,) * 5):
            ends = [(one.upper if high else one.lower) for one, high in zip(sizes, corner, strict=True)]
            fixed = sum(part[:, 0] * end for part, end in zip(row[:5], ends, strict=True))
            best = max(best, float(np.linalg.norm(fixed[:, None] + moved, axis=0).max()))
        assert best <= found * (1 + 1e-12)
        assert found == pytest.approx(best, rel=2e-3)


@given(st.integers(1, 10**6), st.data())
def test_the_interval_of_a_share_holds_it_and_lies_within_0_and_1(total, data):
    share = share_of(data.draw(st.integers(0, total)), total)
    assert -1e-12 <= share.lower <= share.value <= share.upper <= 1 + 1e-12


@given(st.integers(2, 500), st.data())
def test_a_limit_of_the_interval_is_a_share_that_is_just_not_refuted(total, data):
    """It solves (y - p)² = z² p (1 - p)/N, which is what Wilson's interval is."""
    share = share_of(data.draw(st.integers(1, total - 1)), total)
    for p in (share.lower, share.upper):
        assert (share.value - p) ** 2 == pytest.approx(1.959963984540054**2 * p * (1 - p) / total, rel=1e-6)


def test_intervals_are_wilsons_and_the_rule_of_three():
    share = share_of(868961, 10**6)
    assert (round(share.lower, 5), round(share.upper, 5)) == (0.86830, 0.86962)
    assert share_of(10**6, 10**6).lower == pytest.approx(1 - 3e-6)
    assert share_of(0, 1000).upper == pytest.approx(3e-3)


def test_the_interval_covers_19_of_20():
    rng = np.random.default_rng(2)
    found = [share_of(int(n), 2000) for n in rng.binomial(2000, 0.97, 2000)]
    held = sum(one.lower <= 0.97 <= one.upper for one in found) / len(found)
    assert held == pytest.approx(0.95, abs=0.02)


def test_the_same_seed_gives_the_same_mechanisms_and_another_seed_others():
    assert analysed().results[0].trials == analysed().results[0].trials
    assert analysed().results[0].trials != analysed(seed=2).results[0].trials


@pytest.mark.parametrize(
    ("changes", "own", "said"),
    [
        ({"centre": 0.1}, {}, "tolerances.centre: nothing depends on it"),
        ({"limit_angle": 1.0}, {}, "tolerances.limit_angle: nothing depends on it"),
        (
            {},
            {"c": OwnTolerance(lower=0, upper=1)},
            "tolerances.of.c: there is no such contributor; known: a, b, pin",
        ),
    ],
)
def test_what_nothing_depends_on_is_refused(changes, own, said):
    with pytest.raises(DesignError, match=said):
        check_keys(Line(), Tolerances(ToleranceSettings(**changes), own))


def test_a_position_outside_the_motion_is_refused():
    class Half(Line):
        positions = np.linspace(0, 1, 11)

    with pytest.raises(DesignError, match="x does not come to 90 deg; give 0 to 57"):
        analyse(Half(), Tolerances(ToleranceSettings(at=(90.0,))))


def test_where_there_is_no_first_order_there_is_no_worst_place():
    class Dead(Line):
        def sensitivities(self, output, at):
            return [np.full((1, one.components, *at.shape), np.nan) for one in self.contributors]

    with np.errstate(invalid="ignore"):
        assert worst_place(Dead(), Dead.outputs[0]) is None
        assert worst_place(Dead(), Dead.outputs[2]) is None


def test_it_is_told_where_the_first_order_misses_the_mechanisms():
    class Bent(Line):
        def errors(self, output, deviations, at):
            return super().errors(output, deviations, at) + 40 * deviations[0][:1] ** 2

    settings = Tolerances(ToleranceSettings(samples=2000))
    assert list(remarks(analyse(Line(), settings))) == []
    (told,) = remarks(analyse(Bent(), settings))
    assert re.match(
        r"error: at 90 deg the first order misses the sigma of the mechanisms by -?[\d.]+ %", told
    )


def test_limits_and_variances_of_many_positions_are_those_of_each():
    model = Line()
    row = model.sensitivities("error", model.positions)
    low, high = limits(model.contributors, row)
    parts = variances(model.contributors, row)
    for i in (0, 17, 40):
        one = [part[..., i] for part in row]
        assert (float(limits(model.contributors, one)[0]), float(limits(model.contributors, one)[1])) == (
            pytest.approx(low[i]),
            pytest.approx(high[i]),
        )
        assert variances(model.contributors, one) == pytest.approx(parts[:, i])


@pytest.mark.parametrize(
    ("nominal", "grade", "plus"),
    [(3, "fine", 0.05), (3.01, "medium", 0.1), (30, "fine", 0.1), (30.1, "fine", 0.15), (120, "medium", 0.3),
     (500, "coarse", 2.0), (2000, "fine", 0.5), (3000, "medium", 2.0), (4000, "coarse", 4.0)],
)  # fmt: skip
def test_lengths_without_a_tolerance_have_that_of_iso_2768(nominal, grade, plus):
    found = Tolerances(ToleranceSettings(general=grade)).length("a", nominal)
    assert (found.lower, found.upper) == (-plus, plus)


def test_angles_and_run_out_without_a_tolerance_have_that_of_iso_2768():
    found = Tolerances(ToleranceSettings(general="coarse"))
    assert math.degrees(found.angle("a", 1.0, 50.0).upper) == pytest.approx(1.0)
    assert math.degrees(found.angle("a", 1.0, 50.1).upper) == pytest.approx(0.5)
    assert found.eccentricity("a").reach == 0.25


def test_where_iso_2768_ends_a_tolerance_is_asked_for():
    with pytest.raises(
        DesignError, match=r"fine ends at 2000 mm, and a length is 2500 mm; give tolerances.length"
    ):
        Tolerances(ToleranceSettings(general="fine")).length("a", 2500)
