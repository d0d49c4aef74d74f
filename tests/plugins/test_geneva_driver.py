"""A driver with any motion: the wheel's rates, both directions, and the walls that carry."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from pydantic import ValidationError

from mechwright.mechanics.planar import Turning
from mechwright.testing.compare import assert_derivative
from mechwright_geneva.defaults.dimensions import mechanism_of
from mechwright_geneva.family import Geneva
from mechwright_geneva.kinematics.contact_forces import contact, loads
from mechwright_geneva.kinematics.drive import driver_of
from mechwright_geneva.kinematics.figures import rate_peaks
from mechwright_geneva.kinematics.geometry import LEFT, RIGHT
from mechwright_geneva.kinematics.mechanism import Mechanism
from mechwright_geneva.kinematics.wall_change import switches, torque
from mechwright_geneva.parameters import GenevaParams

DATA = Path(__file__).parents[1] / "data" / "geneva-driver.json"
FACTS = {fact["name"]: fact for fact in json.loads(DATA.read_text(encoding="utf-8"))["facts"]}
WORKED = {"crank_half_angle": 50, "offset_angle": 5, "entry_radius": 100, "roller_radius": 5}
LAWS = (
    {},
    {"driver_law": "accelerating", "driver_acceleration": 20},
    {"driver_law": "accelerating", "driver_acceleration": -2.5},
    {"driver_law": "from-rest", "driver_acceleration": 10},
    {"driver_law": "from-rest", "driver_acceleration": 60},
    {"driver_law": "harmonic", "driver_variation": 0.3},
)
BOTH = ("forwards", "backwards")


def worked(**table):
    return mechanism_of(GenevaParams(**{**WORKED, **table}))


@pytest.mark.parametrize("name", [name for name in FACTS if name.startswith("rates.")])
def test_the_wheels_rates_are_those_of_the_reference(name):
    fact = FACTS[name]
    given = fact["inputs"]
    theta = np.array([math.radians(given["theta_d_deg"])])
    m = worked()
    run = m.stroke(theta / (2 * m.crank_half))
    driver = Turning.of(theta, given["omega"], given["alpha"], given["jerk"])
    rates = [float(rate[0]) for rate in driver.carried(run.first, run.second, run.third)]
    assert rates == pytest.approx(fact["expected"], abs=fact["tolerance"])


@pytest.mark.parametrize("direction", BOTH)
@pytest.mark.parametrize(
    ("table", "time", "velocity", "acceleration", "jerk"),
    [
        ({}, 0.277778, 11.3097, 127.910, 2893.26),
        ({"driver_law": "harmonic", "driver_variation": 0.05}, None, 11.8752, 140.563, 3373.92),
        ({"driver_law": "harmonic", "driver_variation": 0.1}, None, 12.4407, 153.834, 3904.95),
        ({"driver_law": "from-rest", "driver_acceleration": 10}, 0.590818, 7.69522, 79.8568, 2405.52),
    ],
)
def test_peaks_are_those_of_the_reference(table, time, velocity, acceleration, jerk, direction):
    m = worked(**table, driver_direction=direction)
    found = rate_peaks(m)
    assert (found.v, found.a, found.j) == pytest.approx((velocity, acceleration, jerk), rel=1e-5)
    if time:
        assert Geneva().solve(m.params, 3).scalars["index_time"].value == pytest.approx(time, rel=1e-6)


@pytest.mark.parametrize("direction", BOTH)
@pytest.mark.parametrize("table", LAWS, ids=lambda table: "-".join(map(str, table.values())) or "constant")
def test_speed_acceleration_and_jerk_are_derivatives_over_time(table, direction):
    params = GenevaParams(**WORKED, **table, driver_direction=direction)
    driver = driver_of(params, math.radians(50))
    begin = driver.start + driver.sense * np.linspace(0.3, 1.4, 301)
    later = driver.start + driver.sense * np.linspace(3.0, 6.2, 801)  # clear of the end of a ramp
    for theta in (begin, later) if table.get("driver_acceleration") != 60 else (later,):
        found = driver.at(theta)
        assert (found.omega * driver.sense > 0).all()
        for value, rate in (
            (found.theta, found.omega),
            (found.omega, found.alpha),
            (found.alpha, found.jerk),
        ):
            assert_derivative(rate, value, theta, found.omega, what=str(table))
        assert_derivative(np.ones_like(theta), driver.time(theta), theta, found.omega, what="time")
    assert driver.time(np.asarray(driver.start)) == pytest.approx(0)
    turn = driver.start + driver.sense * np.linspace(0, math.tau, 2001)
    assert (np.diff(driver.time(turn)) > 0).all()


def test_a_ramp_from_rest_ends_with_the_speed():
    params = GenevaParams(**WORKED, driver_law="from-rest", driver_acceleration=10)
    found = driver_of(params, math.radians(50)).at(np.array([0.0, 1.9, 2.1, 6.0]))
    assert found.omega.tolist() == pytest.approx([0, math.sqrt(38), math.tau, math.tau])
    assert found.alpha.tolist() == [10, 10, 0, 0]


@pytest.mark.parametrize("direction", BOTH)
@pytest.mark.parametrize("table", LAWS[:4] + LAWS[5:], ids=lambda table: "-".join(map(str, table.values())))
@pytest.mark.parametrize("rollers", [1, 2])
def test_channels_over_time(table, direction, rollers):
    load = {"load_torque": 0.02, "rollers": rollers}
    params = GenevaParams(**WORKED, **table, **load, driver_direction=direction)
    m = mechanism_of(params)
    motion = Geneva().solve(params, 7201)
    channels = {name: one.values for name, one in motion.channels.items()}
    theta, omega = channels["theta_d"], channels["omega_d"]
    assert (np.sign(omega[1:]) == m.driver.sense).all()
    turned = channels["theta_w"][-1] - channels["theta_w"][0]
    assert turned == pytest.approx(m.driver.sense * 2 * m.wheel_half * rollers)
    for stroke in m.strokes:
        inside = (theta > stroke * m.pitch + 0.02) & (theta < stroke * m.pitch + 2 * m.crank_half - 0.02)
        for value, rate in (("theta_w", "omega_w"), ("omega_w", "alpha_w"), ("alpha_w", "jerk_w")):
            assert_derivative(
                channels[rate][inside], channels[value][inside], theta[inside], omega[inside], what=rate
            )
        # What the driver puts in is what the wheel takes: kinetic energy and the load.
        free = inside & (channels["pressure_angle"] < 1.39) & (channels["pressure_angle"] > 0)
        power = (0.01 * channels["alpha_w"] + m.driver.sense * 0.02) * channels["omega_w"]
        np.testing.assert_allclose(
            (channels["crank_torque"] * omega)[free], power[free], atol=1e-9 * np.abs(power).max()
        )


class SteadyRatio:
    """A driver with α = k w² all along."""

    varies, sense, start = True, 1, 0.0

    def __init__(self, ratio: float) -> None:
        self.ratio = ratio

    def at(self, theta):
        omega = np.exp(self.ratio * theta)
        return Turning.of(theta, omega, self.ratio * omega**2, 2 * self.ratio**2 * omega**3)

    def time(self, theta):
        return -np.expm1(-self.ratio * theta) / self.ratio


@pytest.mark.parametrize("name", [name for name in FACTS if name.startswith("contact.switch")])
def test_walls_change_in_the_middle_and_where_the_torque_is_0(name):
    fact = FACTS[name]
    m = Mechanism(worked().params)
    m.__dict__["driver"] = SteadyRatio(fact["inputs"]["k"])
    found = [math.degrees(one.theta) for one in switches(m)]
    assert found == pytest.approx(sorted([50.0, fact["expected"]]), abs=1e-7)
    # cot(π u) = -k θd0/π
    u = fact["expected"] / 100
    assert 1 / math.tan(math.pi * u) == pytest.approx(-fact["inputs"]["k"] * m.crank_half / math.pi, abs=1e-8)


@pytest.mark.parametrize("name", [name for name in FACTS if name.startswith("contact.load")])
def test_a_load_changes_the_wall_besides(name):
    fact = FACTS[name]
    given = fact["inputs"]
    table = {"load_inertia": given["J"], "speed": given["rpm"], "load_torque": given["friction"]}
    found = switches(worked(**table))
    wanted = sorted([50.0, *fact["expected"]])
    assert [math.degrees(one.theta) for one in found] == pytest.approx(wanted, abs=1e-6)
    assert [one.wall for one in found] == ["left", "right", "left"]
    assert all(one.omega == pytest.approx(given["rpm"] * math.tau / 60) for one in found)
    back = switches(worked(**table, driver_direction="backwards"))
    mirrored = [100 - one for one in wanted]
    assert [math.degrees(one.theta) for one in back] == pytest.approx(mirrored, abs=1e-6)
    assert [one.wall for one in back] == ["left", "right", "left"]
    assert [one.impact for one in back] == [
        pytest.approx(one.impact, rel=1e-3) if one.impact else None for one in found
    ]


def test_a_load_above_the_inertia_changes_the_wall_in_the_middle_only():
    (one,) = switches(worked(load_torque=1.3))
    assert math.degrees(one.theta) == pytest.approx(50)
    assert one.wall == "left"
    (back,) = switches(worked(load_torque=1.3, driver_direction="backwards"))
    assert back.wall == "left", "the opposite at each angle: left below the middle, where it ends"


@pytest.mark.parametrize(
    ("table", "wall"), [({}, RIGHT), ({"offset_angle": -12.5, "crank_half_angle": 45}, RIGHT)]
)
def test_inertia_alone_is_carried_by_one_wall_both_ways(table, wall):
    for direction in BOTH:
        params = GenevaParams(**{**WORKED, **table}, driver_direction=direction)
        assert switches(mechanism_of(params)) == ()
        walls = Geneva().solve(params, 721).channels["contact_wall"].values
        assert set(walls.tolist()) == {0.0, float(wall)}


@pytest.mark.parametrize("table", [{"load_inertia": 3e-4}, {"load_inertia": 2.0, "speed": 20}])
def test_the_force_in_the_middle_is_that_of_the_places_beside_it(table):
    m = worked(**table)  # there the lever and the torque are 0, and their ratio is a limit
    found = contact(m, m.stroke(np.array([0.499, 0.5, 0.501])))
    assert found.force[1] == pytest.approx((found.force[0] + found.force[2]) / 2, rel=1e-3)
    assert found.pressure[1] == pytest.approx((found.pressure[0] + found.pressure[2]) / 2, rel=1e-3)
    assert len(set(found.wall.tolist())) == 1


@pytest.mark.parametrize(("load", "out"), [(0.0, RIGHT), (30.0, LEFT)])
def test_walls_of_a_straight_slot(load, out):
    """The pin pushes ahead on the way in; on the way out the wheel pushes it, unless the load holds it back."""
    m = mechanism_of(GenevaParams(law="straight", entry_radius=100, load_torque=load))
    u = np.linspace(0.02, 0.98, 97)
    found = contact(m, m.stroke(u))
    assert set(found.wall[u < 0.49].tolist()) == {RIGHT}
    assert set(found.wall[u > 0.51].tolist()) == {out}
    assert (found.pressure_angle == 0).all()


def test_the_wall_of_the_channel_is_the_one_of_torque_and_lever():
    params = GenevaParams(**WORKED, load_torque=0.5)
    motion = Geneva().solve(params, 3601)
    walls, theta = (motion.channels[name].values for name in ("contact_wall", "theta_d"))
    at = np.degrees(theta[np.flatnonzero(np.diff(walls)) + 1])
    found = [math.degrees(one.theta) for one in switches(mechanism_of(params))]
    assert at[:3].tolist() == pytest.approx(found, abs=0.11), "and then the exit"
    assert LEFT in walls


def test_a_straight_slot_is_pushed_then_braked():
    (one,) = switches(mechanism_of(GenevaParams(law="straight")))
    assert math.degrees(one.theta) == pytest.approx(45)
    assert one.wall == "behind"
    back = switches(mechanism_of(GenevaParams(law="straight", driver_direction="backwards")))
    assert [turn.impact for turn in back] == [pytest.approx(one.impact)]


def test_the_impact_is_what_free_flight_gives():
    # The torque's slope at the change: D = T' t³/(6 J), and the clearance is closed at lever D = c.
    m = worked(load_torque=0.5, groove_clearance=1e-6)
    second = switches(m)[1]
    u = second.theta / (2 * m.crank_half)
    step = 1e-6
    slope = float(np.diff(torque(m, np.array([u - step, u + step]), 0))[0]) / (2 * step * 2 * m.crank_half)
    run = m.stroke(np.array([u]))
    lever = abs(float((np.conj(run.centre) * run.normal).imag[0]))
    pull = abs(slope) * m.driver.speed / 0.01
    time = (6e-6 / (lever * pull)) ** (1 / 3)
    assert second.impact == pytest.approx(lever * pull * time**2 / 2, rel=0.03)
    # In the middle the lever grows as the time does: lever' t T t²/(2 J) = c.
    first = switches(m)[0]
    slopes = m.stroke(np.array([0.5 - step, 0.5 + step]))
    lever = abs(float(np.diff((np.conj(slopes.centre) * slopes.normal).imag)[0])) / (
        2 * step * 2 * m.crank_half
    )
    growth = lever * m.driver.speed * 0.5 / 0.02
    time = (1e-6 / growth) ** (1 / 3)
    assert first.impact == pytest.approx(3 * growth * time**2, rel=0.03)
    assert [one.impact for one in switches(worked(load_torque=0.5, groove_clearance=0))] == [0, 0, 0]


def test_findings_name_angle_and_speed():
    params = GenevaParams(**WORKED, driver_law="from-rest", driver_acceleration=10)
    said = {one.code: one for one in Geneva().check(params)}
    assert "50.0000 degrees at 39.89 rev/min to the left wall" in said["geneva.walls"].message
    assert said["geneva.walls"].value == 2
    assert said["geneva.ramp"].value == pytest.approx(0.01 * 1.8 * 10)
    figures = Geneva().solve(params, 3).scalars
    assert figures["wall_switch_1"].value == pytest.approx(50)
    assert figures["wall_switch_1_speed"].value == pytest.approx(39.89, abs=0.01)
    steady = {one.code: one for one in Geneva().check(GenevaParams(**WORKED))}
    assert "geneva.ramp" not in steady
    assert steady["geneva.walls"].value == 0


def test_loads_of_two_rollers_are_those_of_the_faster_stroke():
    table = {"driver_law": "accelerating", "driver_acceleration": 20, "rollers": 2}
    m = worked(**table)
    motion = Geneva().solve(m.params, 14401)
    assert loads(m).force == pytest.approx(
        motion.channels["contact_force"].values.max(), rel=2e-2
    )  # steep by the zone
    assert loads(m).force_at > math.pi
    for name, rate in (("omega_w_max", "omega_w"), ("alpha_w_max", "alpha_w"), ("jerk_w_max", "jerk_w")):
        most = np.abs(motion.channels[rate].values[:-1]).max()  # the last one begins the next turn
        assert motion.scalars[name].value == pytest.approx(most, rel=1e-3)


def test_a_driver_that_stands_still_is_refused_with_what_works():
    table = {"driver_law": "accelerating", "driver_acceleration": -4}
    (fault,) = [one for one in Geneva().check(GenevaParams(**WORKED, **table)) if "driver" in one.code]
    assert "282.7 degrees" in fault.message
    slower = float(fault.remedy.split("above ")[1].split(",")[0])
    faster = float(fault.remedy.split("more than ")[1].split()[0])
    for change in ({"driver_acceleration": slower + 0.01}, {"speed": faster + 0.1}):
        params = GenevaParams(**{**WORKED, **table, **change})
        assert not [one for one in Geneva().check(params) if one.code == "geneva.driver-stops"]
        assert (Geneva().solve(params, 361).channels["omega_d"].values > 0).all()


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ({"driver_acceleration": 3}, 'driver_law is "constant"'),
        ({"driver_law": "harmonic"}, "needs driver_variation"),
        ({"driver_law": "harmonic", "driver_variation": 0.1, "driver_acceleration": 1}, "leave"),
        ({"driver_law": "from-rest", "driver_acceleration": -3}, "above 0"),
        ({"driver_law": "accelerating"}, "needs driver_acceleration"),
    ],
)
def test_what_a_law_of_the_driver_needs(table, words):
    with pytest.raises(ValidationError, match=words):
        GenevaParams(**table)
