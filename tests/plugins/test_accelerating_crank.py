"""A crank that accelerates, against an independent check's numbers, finite differences and energy."""

import json
import math
from pathlib import Path

import numpy as np
import pytest

from mechwright.contracts.finding import Severity, Stage, errors
from mechwright.errors import KinematicsError
from mechwright.mechanics.planar import BodyMotion, Turning, acceleration_pole
from mechwright.mechanics.planar.poles import circles, ratio_of_pole
from mechwright.testing.compare import assert_derivative
from mechwright_four_bar.family import FourBars
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.kinematics.loop import close
from mechwright_slider_crank.family import SliderCrankFamily
from mechwright_slider_crank.kinematics.slider_crank import SliderCrank

DATA = Path(__file__).parents[1] / "data" / "acceleration-poles.json"
FACTS = {fact["name"]: fact for fact in json.loads(DATA.read_text(encoding="utf-8"))["facts"]}
PLACES = {name: fact for name, fact in FACTS.items() if name.startswith("pole.") and ".k" in name}

Inputs = dict[str, float | str]


def coupler(inputs: Inputs, phi: float, ratio: float) -> BodyMotion:
    """The coupler at crank angles, rad, with the crank at 1 rad/s."""
    crank = Turning.of(np.atleast_1d(phi), 1.0, ratio)
    size = [float(inputs[name]) for name in ("a", "c", "b" if "b" in inputs else "e")]
    if "b" in inputs:
        bar = FourBar(*size, float(inputs["f"]))
        return close(bar, crank.theta).bodies(bar, crank)["coupler"]
    return SliderCrank(*size).bodies(crank.theta, crank).rod


def at(inputs: Inputs, ratio: float | None = None) -> BodyMotion:
    return coupler(
        inputs, math.radians(float(inputs["phi_deg"])), float(inputs.get("k", 0)) if ratio is None else ratio
    )


def value(fact: dict[str, object]) -> complex:
    given = fact["expected"]
    return complex(*given) if isinstance(given, list) else complex(given)


@pytest.mark.parametrize("name", [name for name in PLACES if "inflection" not in name])
def test_poles_are_those_of_the_reference(name):
    fact = FACTS[name]
    body = at(fact["inputs"])
    pole = acceleration_pole(body)
    found = {"fixed": pole.fixed, "coupler": pole.moving, "alpha_c": body.turning.alpha}
    assert complex(found[name.split(".")[-1]][0]) == pytest.approx(value(fact), abs=fact["tolerance"])


@pytest.mark.parametrize("name", [name for name in FACTS if name.startswith("bresse.")])
def test_circles_are_those_of_the_reference(name):
    fact = FACTS[name]
    found = circles(at(fact["inputs"]))
    vector = found.inflection if name.endswith("J") else found.tangential
    assert complex(vector[0]) == pytest.approx(value(fact), abs=fact["tolerance"])


@pytest.mark.parametrize("name", [name for name in FACTS if name.endswith("k_inflection_pole")])
def test_the_ratio_of_the_inflection_pole(name):
    fact = FACTS[name]
    body = at(fact["inputs"], 0.0)
    ratio, miss = ratio_of_pole(body, circles(body).inflection_pole)
    assert ratio[0] == pytest.approx(value(fact).real, abs=fact["tolerance"])
    assert miss[0] < 1e-6
    with_it = at(fact["inputs"], float(ratio[0]))
    assert abs(with_it.turning.alpha[0]) < 1e-9


@pytest.mark.parametrize("name", [name for name in FACTS if "at_infinity" in name])
def test_poles_where_the_instant_centre_is_at_infinity(name):
    fact = FACTS[name]
    body = at(fact["inputs"])
    assert complex(acceleration_pole(body).fixed[0]) == pytest.approx(value(fact), abs=1e-9)
    inputs = fact["inputs"]
    sign = math.copysign(1.0, inputs["phi_deg"])
    w = math.sqrt(inputs["c"] ** 2 - (inputs["e"] - sign * inputs["a"]) ** 2)
    assert value(fact) == pytest.approx(complex(w, sign * inputs["a"] - inputs["k"] * w), abs=1e-9)


REST = {
    10: (187.650627, 110.311020),
    60: (143.851166, -193.474845),
    180: (304.003339, 144.794168),
    360: (-383.889939, 79.458772),
}


@pytest.mark.parametrize(("degrees", "place"), REST.items())
def test_a_crank_from_rest_with_a_constant_acceleration(degrees, place):
    phi = math.radians(degrees)
    body = coupler({"a": 50, "c": 150, "e": 20}, phi, 1 / (2 * phi))
    assert complex(acceleration_pole(body).fixed[0]) == pytest.approx(complex(*place), abs=1e-6)


@pytest.mark.parametrize("links", [{"a": 50, "c": 150, "e": 20}, {"a": 40, "c": 120, "b": 80, "f": 100}])
@pytest.mark.parametrize("ratio", [-2.0, -0.3, 0.0, 0.7, 2.0])
def test_the_pole_rests_in_finite_differences(links, ratio):
    # The crank at φ + t + k t²/2: the body point that is the pole at t = 0 has no second difference there.
    weights = np.array([2, -27, 270, -490, 270, -27, 2]) / 180
    step = 4e-3
    for degrees in (20, 75, 160, 230, 310):
        phi = math.radians(degrees)
        times = step * np.arange(-3, 4)
        place = acceleration_pole(coupler(links, phi, ratio)).moving[0]
        moved = coupler(links, phi + times + ratio * times**2 / 2, 0.0).point(place).position
        assert abs(weights @ moved) / step**2 < 1e-6 * (abs(place) + 100)


@pytest.mark.parametrize("links", [{"a": 50, "c": 150, "e": 20}, {"a": 40, "c": 120, "b": 80, "f": 100}])
def test_poles_of_all_ratios_are_the_inflection_circle(links):
    rng = np.random.default_rng(3)
    for phi in rng.uniform(0, math.tau, 20):
        steady = coupler(links, phi, 0.0)
        found = circles(steady)
        centre, radius = (found.instant_centre + found.inflection / 2)[0], abs(found.inflection[0]) / 2
        for ratio in rng.uniform(-3, 3, 5):
            pole = acceleration_pole(coupler(links, phi, ratio)).fixed
            assert abs(pole[0] - centre) == pytest.approx(radius, rel=1e-9)
            assert circles(coupler(links, phi, ratio)).inflection[0] == pytest.approx(found.inflection[0])
            back, miss = ratio_of_pole(steady, pole)
            assert (back[0], miss[0]) == (pytest.approx(ratio, abs=1e-7), pytest.approx(0, abs=1e-6))
    off, miss = ratio_of_pole(steady, centre)
    assert np.isfinite(off[0])
    assert miss[0] > 1e-3


DESIGNS = (
    (SliderCrankFamily(), {"offset": 12}, "clockwise", True),
    (FourBars(), {}, "direction", "cw"),
)


@pytest.mark.parametrize(("family", "table", "key", "back"), DESIGNS, ids=("slider-crank", "four-bar"))
@pytest.mark.parametrize("backwards", [False, True])
def test_the_crank_keeps_its_ratio_all_along(family, table, key, back, backwards):
    ratio = -0.25 if backwards else 0.25
    params = family.Params(**table, acceleration_ratio=ratio, **({key: back} if backwards else {}))
    channels = {name: one.values for name, one in family.solve(params, 721).channels.items()}
    phi, omega, time = channels["phi"], channels["omega_a"], channels["time"]
    np.testing.assert_allclose(channels["alpha_a"] / omega**2, ratio, rtol=1e-12)
    np.testing.assert_allclose(omega, omega[0] * np.exp(ratio * (phi - phi[0])), rtol=1e-12)
    assert abs(omega[0]) == pytest.approx(math.tau)
    assert (np.diff(time) > 0).all()
    for name, rate in (("time", None), ("omega_a", "alpha_a"), ("alpha_a", "jerk_a")):
        rates = np.ones_like(omega) if rate is None else channels[rate]
        assert_derivative(rates, channels[name], phi, omega, what=name)


@pytest.mark.parametrize(("family", "table", "key", "back"), DESIGNS, ids=("slider-crank", "four-bar"))
def test_poles_do_not_depend_on_the_speed_and_torque_is_the_change_of_energy(family, table, key, back):
    def solved(**more):
        motion = family.solve(family.Params(**table, **more), 1441)
        return {name: one.values for name, one in motion.channels.items()}

    plain, one, two, fast = (
        solved(),
        solved(acceleration_ratio=0.2),
        solved(acceleration_ratio=-0.3),
        solved(acceleration_ratio=0.2, speed=97),
    )
    for name in ("xG", "yG", "xG_coupler", "yG_coupler"):
        np.testing.assert_allclose(fast[name], one[name], rtol=1e-9, atol=1e-7)
    assert np.abs(one["xG"] - plain["xG"]).max() > 10
    # With the kinetic energy I(φ) ω²/2 the torque is (I'/2 + k I) ω².
    per_square = [found["drive_torque"] / found["omega_a"] ** 2 for found in (plain, one, two)]
    inertia = (per_square[1] - per_square[0]) / 0.2
    np.testing.assert_allclose((per_square[2] - per_square[0]) / -0.3, inertia, rtol=1e-7)
    assert (inertia > 0).all()
    assert_derivative(2 * per_square[0], inertia, plain["phi"], 1.0, what="torque")


def test_peaks_of_an_accelerating_crank_are_those_of_its_period():
    for family in (SliderCrankFamily(), FourBars()):
        for ratio in (0.3, -0.3):
            motion = family.solve(family.Params(acceleration_ratio=ratio), 2881)
            most = float(np.abs(motion.channels["drive_torque"].values).max())
            assert motion.scalars["drive_torque_max"].value == pytest.approx(most, rel=1e-4)
            assert motion.scalars["drive_torque_max"].value >= most * (1 - 1e-4)


@pytest.mark.parametrize(
    ("family", "table"),
    [
        (SliderCrankFamily(), {"rod": 35}),
        (FourBars(), {"crank": 70, "coupler": 60, "ground": 110, "follower": 75}),
    ],
)
def test_a_lever_has_no_ratio(family, table):
    assert not errors(family.check(family.Params(**table)), Stage.MOTION)
    params = family.Params(**table, acceleration_ratio=0.1)
    (fault,) = errors(family.check(params), Stage.MOTION)
    assert (fault.parameter, fault.value, fault.limit) == ("acceleration_ratio", 0.1, 0.0)
    assert "lever" in fault.message
    with pytest.raises(KinematicsError, match="acceleration_ratio"):
        family.solve(params, 10)


@pytest.mark.parametrize("family", [SliderCrankFamily(), FourBars()])
def test_a_crank_that_comes_to_run_too_fast_is_told_with_the_ratio_that_works(family):
    def told(**table):
        found = family.check(family.Params(**table))
        return [one for one in found if one.code.endswith(".acceleration")]

    (warning,) = told(acceleration_ratio=1.5)
    assert warning.severity is Severity.WARNING
    assert warning.value == pytest.approx(60 * math.exp(1.5 * math.tau))
    allowed = float(warning.remedy.split(" at ")[1].split()[0])
    assert told(acceleration_ratio=allowed) == []
    assert told(acceleration_ratio=allowed + 0.001)
    assert told(acceleration_ratio=-1.5) == []
    slower = float(warning.remedy.split("at most ")[1].split()[0])
    assert told(acceleration_ratio=1.5, speed=slower * 0.999) == []


@pytest.mark.parametrize("ratio", [0.4, 1.7])
def test_loci_of_opposite_ratios_are_mirror_images(ratio):
    phi = np.linspace(0.1, 6.2, 40)

    def pole(linkage, angle, k):
        crank = Turning.of(angle, 1.0, k)
        if isinstance(linkage, FourBar):
            return acceleration_pole(close(linkage, angle).bodies(linkage, crank)["coupler"]).fixed
        return acceleration_pole(linkage.bodies(angle, crank).rod).fixed

    ahead, behind = SliderCrank(50.0, 150.0, 20.0, branch=1), SliderCrank(50.0, 150.0, 20.0, branch=-1)
    mirrored = pole(behind, math.pi - phi, -ratio)
    np.testing.assert_allclose(-np.conj(mirrored), pole(ahead, phi, ratio), rtol=1e-9)
    left, right = FourBar(40, 120, 80, 100, branch=1), FourBar(40, 120, 80, 100, branch=-1)
    np.testing.assert_allclose(np.conj(pole(right, -phi, -ratio)), pole(left, phi, ratio), rtol=1e-7)


def test_in_a_toggle_the_pole_is_the_crank_pin_whatever_the_ratio():
    linkage = SliderCrank(50.0, 60.0, 20.0)
    toggle = math.asin((20 - 60) / 50)
    for ratio in (-2.0, 0.0, 2.0):
        away = []
        for step in (1e-4, 1e-8):
            crank = Turning.of([toggle + step], 1.0, ratio)
            rod = linkage.bodies(crank.theta, crank).rod
            away.append(abs(acceleration_pole(rod).fixed - rod.origin.position)[0])
        assert away[1] < 1e-4
        assert away[1] < 0.01 * away[0]


def test_how_far_loci_reach():
    phi = np.radians(np.linspace(0, 360, 36001))
    for ratio, low, high in ((0.0, -390.857, 390.693), (0.5, -594.975, 591.654)):
        pole = acceleration_pole(coupler({"a": 50, "c": 150, "e": 20}, phi, ratio)).fixed
        assert (pole.real.min(), pole.real.max()) == pytest.approx((low, high), abs=2e-3)
