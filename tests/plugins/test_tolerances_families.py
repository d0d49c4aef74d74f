"""Sensitivities of every family are the derivatives of its positions, solved anew by other means."""

import math

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from tolerance_models import assert_exact, deviations

from mechwright import Tolerances
from mechwright.contracts.tolerance_settings import OwnTolerance, ToleranceSettings
from mechwright.mechanics.tolerance import analyse
from mechwright.pipeline.tolerances.report import remarks
from mechwright_elliptic_gears.family import EllipticGears
from mechwright_elliptic_gears.kinematics.equations import Turning, driven, train
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_four_bar.family import FourBars
from mechwright_four_bar.parameters import FourBarParams
from mechwright_geneva.as_made.play import Play, drawn_room
from mechwright_geneva.family import Geneva
from mechwright_geneva.parameters import GenevaParams
from mechwright_slider_crank.family import SliderCrankFamily
from mechwright_slider_crank.parameters import SliderCrankParams
from mechwright_spherical.family import Spherical
from mechwright_spherical.kinematics.four_bar import FourBar
from mechwright_spherical.parameters import SphericalParams

TURN = np.linspace(0.1, 6.2, 23)
slow = settings(max_examples=15, deadline=None, suppress_health_check=[HealthCheck.too_slow])
WITH_INPUT = Tolerances(ToleranceSettings(input=0.1))
LOADED = Tolerances(ToleranceSettings(contact="loaded"))


def freudenstein(crank, coupler, follower, ground, theta, branch):
    """Follower angle by the half-angle form of Freudenstein's equation."""
    k1, k2 = ground / crank, ground / follower
    k3 = (crank**2 - coupler**2 + follower**2 + ground**2) / (2 * crank * follower)
    a = math.cos(theta) - k1 - k2 * math.cos(theta) + k3
    b, c = -2 * math.sin(theta), k1 - (k2 + 1) * math.cos(theta) + k3
    return 2 * math.atan2(-b - branch * math.sqrt(b * b - 4 * a * c), 2 * a)


@given(
    st.floats(1, 10),
    st.floats(1.3, 4),
    st.floats(1.3, 4),
    st.floats(1.3, 4),
    st.sampled_from(["open", "crossed"]),
    st.floats(0, 6.28),
)
@slow
def test_the_follower_follows_freudenstein(crank, coupler, follower, ground, branch, theta):
    sizes = {
        "crank": crank,
        "coupler": crank * coupler,
        "follower": crank * follower,
        "ground": crank * ground,
    }
    room = min(follower + coupler - 1 - ground, abs(ground - 1) - abs(follower - coupler))
    assume(room > 0.15)
    point = {"coupler_point_x": 0.4 * crank, "coupler_point_y": -0.7 * crank}
    model = FourBars().tolerances(FourBarParams(**sizes, **point, branch=branch, pin_diameter=2), WITH_INPUT)
    assert_exact(model, TURN, 1e-5, 1e-6 * crank)
    rows = model.sensitivities("follower angle", np.array(theta))
    psi = float(model.nominal("follower angle", np.array(theta))[0])
    both = {root: freudenstein(**sizes, theta=theta, branch=root) for root in (1, -1)}
    root = min(both, key=lambda one: abs(math.sin((both[one] - psi) / 2)))
    assert math.sin((both[root] - psi) / 2) == pytest.approx(0, abs=1e-9)
    for number, name in enumerate(sizes):
        ends = [
            freudenstein(**{**sizes, name: sizes[name] + step}, theta=theta, branch=root)
            for step in (1e-6, -1e-6)
        ]
        slope = ((ends[0] - ends[1] + math.pi) % math.tau - math.pi) / 2e-6
        assert float(rows[number][0, 0]) == pytest.approx(slope, abs=1e-6, rel=1e-5)


@given(st.floats(2, 50), st.floats(1.3, 6), st.floats(-0.2, 0.2), st.booleans(), st.floats(-90, 90))
@slow
def test_the_slider_follows_the_law_of_the_right_triangle(crank, rod, offset, ahead, direction):
    assume(rod > 1.1 + abs(offset))
    params = SliderCrankParams(
        crank=crank,
        rod=crank * rod,
        offset=crank * offset,
        assembly="ahead" if ahead else "behind",
        slide_direction=direction,
        coupler_y=0.3 * crank,
    )
    model = SliderCrankFamily().tolerances(params, WITH_INPUT)
    assert_exact(model, TURN, 1e-5, 1e-6 * crank)
    beta = np.arcsin((crank * offset - crank * np.sin(TURN - math.radians(direction))) / (crank * rod))
    by_rod, by_offset = (model.sensitivities("slider position", TURN)[i][0, 0] for i in (1, 2))
    sign = 1 if ahead else -1
    assert by_rod == pytest.approx(sign / np.cos(beta))
    assert by_offset == pytest.approx(-sign * np.tan(beta))


@given(
    st.floats(60, 100), st.floats(15, 35), st.floats(60, 100), st.floats(60, 100), st.sampled_from([1, -1])
)
@slow
def test_the_output_follows_the_spherical_closure(ground, crank, coupler, output, branch):
    degrees = {"ground": ground, "input": crank, "coupler": coupler, "output": output}
    arcs = np.radians(list(degrees.values()))
    angle = FourBar(*arcs, side=float(branch)).output_angle(TURN)
    assume(np.isfinite(angle).all())
    margin = FourBar(*arcs, side=1.0).output_angle(TURN) - FourBar(*arcs, side=-1.0).output_angle(TURN)
    assume(np.abs(np.sin(margin / 2)).min() > 0.3)
    params = SphericalParams(kind="four-bar", four_bar={**degrees, "branch": branch})
    model = Spherical().tolerances(params, WITH_INPUT)
    assert_exact(model, TURN, 1e-5, 1e-6)
    rows = model.sensitivities("output angle", TURN)
    for number in range(4):
        ends = []
        for step in (1e-6, -1e-6):
            moved = arcs.copy()
            moved[number] += step
            ends.append(FourBar(*moved, side=float(branch)).output_angle(TURN))
        assert rows[number][0, 0] == pytest.approx((ends[0] - ends[1]) / 2e-6, abs=1e-6, rel=1e-6)


@pytest.mark.parametrize("phase", [1, 2])
def test_both_phases_of_a_five_bar(phase):
    model = Spherical().tolerances(SphericalParams(five_bar={"phase": phase}), WITH_INPUT)
    assert [one.name for one in model.outputs] == ["path point"]
    assert {"arm", "arm-pin", "arm-shaft"} <= {one.name for one in model.contributors}
    assert_exact(model, model.positions[::20], 1e-5)


@pytest.mark.parametrize("stages", [1, 2])
@pytest.mark.parametrize("eccentricity", [0.0, 0.4, 0.6])
def test_gears_are_linear_in_what_is_off(stages, eccentricity):
    params = EllipticGearParams(stages=stages, eccentricity=eccentricity)
    assert_exact(EllipticGears().tolerances(params, Tolerances()), TURN, 1e-9)


@pytest.mark.parametrize("stages", [1, 2])
def test_the_backlash_left_open_leaves_play_in_the_worst_case(stages):
    for eccentricity in (0.0, 0.2, 0.4, 0.6):
        params = EllipticGearParams(stages=stages, eccentricity=eccentricity)
        model = EllipticGears().tolerances(params, Tolerances(ToleranceSettings(samples=1000)))
        for result in analyse(model, Tolerances(ToleranceSettings(samples=1000))).results:
            if result.output.stays_above:
                assert result.worst.low > 0
                assert result.trials[0].least > result.worst.low


def test_a_train_carries_the_lag_of_gear_3_on_to_gear_5():
    sizes = {"eccentricity": 0.4, "backlash": 0.1}
    train_model = EllipticGears().tolerances(EllipticGearParams(stages=2, phase=60, **sizes), Tolerances())
    pair = EllipticGears().tolerances(EllipticGearParams(**sizes), Tolerances())
    lag = pair.nominal("transmission error", TURN)[0]
    _, four, _ = train(Turning.of(TURN), 0.4, math.radians(60))
    turned = [driven(Turning.of(four.theta + part * lag), 0.4).theta for part in (-0.5, 0.5)]
    carried = np.abs(turned[1] - turned[0])
    own = train_model.nominal("play of gear 5 ahead", TURN)[0]
    assert train_model.nominal("transmission error", TURN)[0] == pytest.approx(own + carried, rel=1e-5)


@pytest.mark.parametrize(
    "table",
    [
        {},
        {"slots": 6, "law": "straight", "entry_radius": 80, "roller_radius": 4},
        {"slots": 3, "law": "straight"},
        {"slots": 5, "law": "modified-sine", "rollers": 2},
    ],
)
def test_the_wheel_of_a_geneva(table):
    model = Geneva().tolerances(GenevaParams(**table), WITH_INPUT)
    row = model.sensitivities("wheel angle", model.positions)[0][0, 0]
    good = model.positions[np.isfinite(row)]
    assert np.isfinite(row).all() == model.m.straight == (model.told == ())
    assert_exact(model, good[::15], 2e-5)


def test_the_wheel_turns_in_its_slot_as_far_as_the_tube_lets_it():
    model = Geneva().tolerances(GenevaParams(groove_clearance=0.05), Tolerances())
    at = np.radians([1.0, 20, 40, 45, 60, 90])
    half = 0.025
    there, back = Play.of(model.m.way(at), drawn_room(model.m, half)).turns()
    ends = [
        model.errors("wheel angle", deviations(model, (1,), roller_in_slot=sign * half), at)[0]
        for sign in (1, -1)
    ]
    assert np.maximum(*ends) == pytest.approx(there, rel=1e-6)
    assert -np.minimum(*ends) == pytest.approx(back, rel=1e-6)
    assert model.nominal("play in the slot", at)[0, :2] == pytest.approx((there + back)[:2], rel=1e-4)


def test_a_singular_position_is_told_and_not_divided_by():
    model = Geneva().tolerances(GenevaParams(groove_clearance=0.05), Tolerances())
    (told,) = model.told
    assert "no first order" in told
    assert "can turn 35.9 mrad" in told
    middle = np.array(model.m.crank_half)
    assert all(np.isnan(part).all() for part in model.sensitivities("wheel angle", middle)[:4])
    assert np.isfinite(model.nominal("play in the slot", middle)).all()
    result = analyse(model, Tolerances(ToleranceSettings(samples=1000))).results[0]
    assert abs(result.worst.at[0] - model.m.crank_half) > math.radians(2)


@pytest.mark.parametrize(
    "table",
    [
        {"law": "straight", "slots": 3, "lock_radius": 5.0},
        {"lock_radius": 15.0},
        {"lock_radius": 28.5},
        {"lock_radius": 500.0},
        {"rollers": 3, "slots": 3},
    ],
)
def test_a_disc_that_does_not_lock_is_told(table):
    asked = Tolerances(ToleranceSettings(samples=200))
    model = Geneva().tolerances(GenevaParams(**table), asked)
    assert [one.name for one in model.outputs] == ["wheel angle", "play in the slot"]
    assert "does not cover both horns" in model.told[-1]
    assert len(analyse(model, asked).results) == 2


def test_nothing_is_tried_in_a_singular_position():
    asked = Tolerances(ToleranceSettings(samples=500, at=(50.0, 20.0)))
    analysis = analyse(Geneva().tolerances(GenevaParams(), asked), asked)
    wheel = analysis.results[0]
    assert [math.isfinite(place.sigma) for place in wheel.places] == [False, True]
    assert [(round(math.degrees(one.at)), one.apart) for one in wheel.trials] == [(20, 0)]
    assert "wheel angle: no first order at 50 deg, so no mechanisms are tried there" in remarks(analysis)


def test_pins_pressed_along_a_link_count_twice_as_much():
    """Of a pin anywhere half the variance is across the link, which the follower does not feel."""
    anywhere, along = (
        FourBars().tolerances(FourBarParams(), Tolerances(ToleranceSettings(contact=kind, clearance=0.02)))
        for kind in ("any", "loaded")
    )
    quick = ToleranceSettings(samples=20_000, clearance=0.02)
    loose = analyse(anywhere, Tolerances(quick)).results[0]
    tight = analyse(along, Tolerances(quick)).results[0]
    variance = {
        name: [share * result.worst.sigma**2 for share in result.worst.shares]
        for name, result in (("any", loose), ("loaded", tight))
    }
    names = [one.name for one in anywhere.contributors]
    for name, more in (("shaft", 1), ("pin-a", 2), ("pin-b", 2), ("pin-b0", 1)):
        i = names.index(name)
        assert variance["loaded"][i] == pytest.approx(more * variance["any"][i], rel=1e-6)
    assert tight.trials[0].sigma == pytest.approx(tight.worst.sigma, rel=0.02)
    assert tight.worst.high == pytest.approx(loose.worst.high)


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("general", "medium"),
        ("length", 0.1),
        ("gouge", 0.02),
        ("leftover", 0.03),
        ("input", 0.5),
        ("fit", "H8/e8"),
        ("clearance", 0.1),
        ("contact", "loaded"),
        ("distribution", "uniform"),
        ("at", (30.0,)),
        ("limit_angle", 0.05),
        ("limit_length", 0.05),
        ("samples", 300),
        ("seed", 9),
    ],
)
def test_every_key_changes_the_result(key, value):
    params = FourBarParams(coupler_point_x=40, coupler_point_y=20)

    def found(**more):
        asked = Tolerances(ToleranceSettings(**{"samples": 200, **more}))
        result = analyse(FourBars().tolerances(params, asked), asked)
        return [(one.worst, one.places, one.trials) for one in result.results]

    assert found(**{key: value}) != found()


@pytest.mark.parametrize(
    ("family", "params", "key", "value"),
    [
        (Spherical, SphericalParams(), "angle", 0.1),
        (Geneva, GenevaParams(), "centre", 0.1),
        (Geneva, GenevaParams(), "eccentricity", 0.1),
        (EllipticGears, EllipticGearParams(), "centre", 0.1),
    ],
)
def test_keys_of_other_families_change_theirs(family, params, key, value):
    def found(**more):
        asked = Tolerances(ToleranceSettings(samples=200, **more))
        return [one.worst for one in analyse(family().tolerances(params, asked), asked).results]

    assert found(**{key: value}) != found()


def test_a_contributor_of_its_own_takes_the_place_of_the_general_one():
    own = {
        "crank": OwnTolerance(lower=-0.001, upper="0.3 mm", distribution="uniform"),
        "pin-a": OwnTolerance(fit="H7/f7"),
        "pin-b": OwnTolerance(lower=0.0, upper=0.5),
    }
    model = FourBars().tolerances(FourBarParams(pin_diameter=8), Tolerances(own=own))
    named = {one.name: one for one in model.contributors}
    assert (named["crank"].lower, named["crank"].upper) == (-0.001, 0.3)
    assert (named["pin-a"].lower, named["pin-a"].upper) == pytest.approx((0.013, 0.043))
    assert (named["pin-b"].lower, named["pin-b"].upper) == (0.0, 0.5)


@pytest.mark.parametrize(
    ("tolerances", "said"),
    [
        (Tolerances(ToleranceSettings(fit="H7/k6")), r"tolerances.fit: .* may jam; use f7, g6 or h6"),
        (Tolerances(own={"pin-a": OwnTolerance(fit="H7/p6")}), r"tolerances.of.pin-a.fit: .* may jam"),
        (Tolerances(own={"crank": OwnTolerance(fit="H7/g6")}), r"of.crank.fit: it is no pin in a hole"),
        (Tolerances(own={"crank": OwnTolerance(lower=1, upper=-1)}), r"of.crank: lower is above upper"),
        (Tolerances(own={"crank": OwnTolerance(lower=1)}), r"of.crank: give both lower and upper"),
        (Tolerances(own={"pin-a": OwnTolerance(lower=-1, upper=1)}), r"of.pin-a.lower: -1.0 is below 0"),
        (
            Tolerances(own={"crank": OwnTolerance(lower="1 kg", upper=1)}),
            r"of.crank.lower: '1 kg' cannot be read",
        ),
    ],
)
def test_what_cannot_be_is_refused_in_a_line(tolerances, said):
    from mechwright import DesignError

    with pytest.raises(DesignError, match=said):
        FourBars().tolerances(FourBarParams(), tolerances)
