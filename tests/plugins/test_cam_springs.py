"""The extension spring that holds a lever on its cam."""

import math

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from pydantic import ValidationError

from mechwright.contracts.finding import Severity, Stage, errors
from mechwright.contracts.mounting import MountingError
from mechwright.machine.drive import SAMPLES, drive_of
from mechwright.machine.settings import MachineSettings
from mechwright.standards.spring_strength import fatigue_safety
from mechwright.standards.springs import SCATTER, ExtensionSpring, extension_springs
from mechwright_cam_follower.family import CamFollower
from mechwright_cam_follower.kinematics.extremes import weakest
from mechwright_cam_follower.kinematics.forces import spring_at
from mechwright_cam_follower.kinematics.mechanism import Mechanism, mechanism_of
from mechwright_cam_follower.kinematics.motion import motion_of
from mechwright_cam_follower.parameters import CamParams
from mechwright_cam_follower.parts.moved_mass import own_inertia
from mechwright_cam_follower.parts.parts import parts_of
from mechwright_cam_follower.parts.spring_parts import spring_place
from mechwright_cam_follower.rules.spring_rules import BOUGHT_SPRING
from mechwright_cam_follower.rules.validity import with_values
from mechwright_cam_follower.spring.choice import RESERVE, SAFE, mounted_spring
from mechwright_cam_follower.spring.hooks import Hooks, MountedSpring

FAMILY = CamFollower()
MACHINE = {
    "follower": "oscillating",
    "roller_radius": 9,
    "speed": 90,
    "inertia": 0.0008,
    "load_torque": -0.5,
    "pivot_bore": 12,
    "bore": 12,
    "follower_width": 24,
    "spring": "auto",
}


def design(**changes: object) -> CamParams:
    return CamParams.model_validate({**MACHINE, **changes})


@given(st.floats(5, 60), st.floats(20, 120), st.floats(0.01, 1.0), st.floats(-0.5, 0.5))
def test_a_spring_presses_by_virtual_work(tail, apart, middle, away):
    """The lever of its pull is the rate of its length over the swing."""
    hooks, step = Hooks(tail, apart, middle), 1e-5
    assume(apart > 1.2 * tail)
    lift = np.array([middle + away - step, middle + away, middle + away + step])
    low, _, high = hooks.distance(lift)
    assert hooks.lever(lift)[1] == pytest.approx((high - low) / (2 * step), rel=1e-6, abs=1e-6 * tail)


def test_a_spring_square_to_its_tail_has_the_tail_as_lever():
    mounted = MountedSpring(ExtensionSpring(1.25, 12.5, 40), Hooks(20.0, 60.0, 0.2), 8.0, 0.4, 19.0)
    middle = np.array(0.2)
    length = 60 + 0.8 * 8
    assert mounted.length(middle) == pytest.approx(length)
    force = mounted.spring.initial + mounted.spring.rate * (length - 40)
    assert mounted.press(middle) == pytest.approx(0.02 * force)


def test_places_are_those_of_the_hooks():
    """Pin to pin in the plane, at every angle, is what the force is computed with."""
    params = design()
    m = mechanism_of(params)
    place, motion = spring_place(m), motion_of(params, 181)
    assert place is not None
    pin = motion.poses["spring-pin"].position
    apart = np.hypot(pin[:, 0] - place.stands.real, pin[:, 1] - place.stands.imag)
    assert_allclose(apart, place.mounted.hooks.distance(motion["lift"]), atol=1e-9)
    # The spring turns the lever counter-clockwise, towards the cam.
    axis, along = np.array([m.axis, 0.0]), pin[0, :2]
    pull = np.array([place.stands.real, place.stands.imag]) - along
    arm = along - axis
    assert arm[0] * pull[1] - arm[1] * pull[0] > 0


def test_contact_of_a_bought_spring_is_never_lost():
    m = mechanism_of(design())
    assert weakest(m).value > 0
    assert {one.severity for one in FAMILY.check(design())} == {Severity.NOTE}


@settings(max_examples=12, deadline=None, suppress_health_check=list(HealthCheck))
@given(
    st.sampled_from(["roller", "flat"]),
    st.floats(4, 25),
    st.floats(60, 150),
    st.floats(20, 300),
    st.floats(2e-4, 5e-3),
    st.floats(-1.5, 0.5),
    st.sampled_from(["ccw", "cw"]),
)
def test_random_cams_keep_their_follower(contact, swing, rise, speed, inertia, load, turning):
    """With a maker's scatter and a tenth of reserve, by another sampling; or they are refused."""
    params = CamParams(
        follower="oscillating",
        contact=contact,
        angles=(rise, 40, rise, 320 - 2 * rise) if rise < 140 else (rise, 20, rise, 340 - 2 * rise),
        swings=(swing, swing, 0, 0),
        laws=("modified-sine",),
        speed=speed,
        inertia=inertia,
        load_torque=load,
        turning=turning,
        spring="auto",
    )
    if errors(FAMILY.check(params), Stage.MOTION):
        return
    m, mounted = mechanism_of(params), mounted_spring(params)
    found = [*BOUGHT_SPRING.findings(m, quick=True)]
    assert (mounted is None) == bool(found)
    if mounted is None:
        return
    rates = m.cycle.at(np.linspace(0, math.tau, 2003))
    need = -(inertia * rates.a * m.omega**2 + load)
    press = (1 - SCATTER) * mounted.press(rates.s)
    assert (press > np.where(need > 0, (RESERVE - 0.002) * need, need)).all()
    low, high = mounted.pull(np.array([0.0, m.stroke]))
    assert fatigue_safety(low, high, mounted.spring.wire, mounted.spring.mean) >= SAFE
    assert mounted.length(np.array(m.stroke)) <= mounted.spring.longest
    assert mounted.length(np.array(0.0)) > mounted.spring.free
    assert mounted.pin < mounted.spring.inside


def test_the_force_of_the_spring_is_in_loads_and_drive():
    params = design()
    motion = motion_of(params, SAMPLES)
    m, mounted = mechanism_of(params), mounted_spring(params)
    assert mounted is not None
    assert_allclose(motion.loads["pressed"].share, mounted.press(motion["lift"]) - 0.5)
    drive = drive_of(motion, parts_of(params), MachineSettings(direction="forwards"))
    torque = motion["torque"]
    assert_allclose(drive.runs[0].torque, m.sense * torque, rtol=0, atol=2e-3 * np.abs(torque).max())
    ideal = design(spring=None)
    assert np.abs(torque).max() != pytest.approx(np.abs(motion_of(ideal, SAMPLES)["torque"]).max(), rel=0.01)


def test_a_table_of_designs_has_the_spring_of_each():
    params = design()
    speeds = np.array([60.0, 90.0, 140.0])
    table = with_values(params, speed=speeds)
    lift = np.linspace(0, 0.3, 5)
    every = spring_at(table, lift)
    for row, speed in zip(every, speeds, strict=True):
        assert_allclose(row, spring_at(mechanism_of(design(speed=float(speed))), lift))
    masses = FAMILY.masses(table)
    for number, speed in enumerate(speeds):
        one = design(speed=float(speed))
        single = {part.name: part for part in parts_of(one)}
        for name in ("spring", "spring-pin", "lever"):
            found = np.ravel(masses[name]())[number]
            assert found == pytest.approx(FAMILY.masses(Mechanism(one))[name](), rel=1e-6), name
            assert name in single


def test_a_spring_that_is_too_weak_is_refused_and_auto_helps():
    params = design(spring="0.5x5x25")
    finding = next(one for one in FAMILY.check(params) if one.code == "follower.spring")
    assert "0.5x5x25" in finding.message
    assert "lacks" in finding.message
    assert finding.proposed == ({"parameters.spring": "auto"},)
    assert mounted_spring(design()) is not None


def test_a_cam_too_fast_for_every_spring_is_refused_with_a_speed_that_works():
    params = design(speed=3000)
    finding = next(one for one in FAMILY.check(params) if one.code == "follower.spring")
    assert "the nearest" in finding.message
    speed = finding.proposed[0]["parameters.speed"]
    assert mounted_spring(design(speed=speed)) is not None
    assert mounted_spring(design(speed=1.05 * speed)) is None


def test_parts_heavier_than_the_stated_inertia_are_refused():
    params = design(inertia=1e-4)
    finding = next(one for one in FAMILY.check(params) if one.code == "follower.inertia")
    (change,) = finding.proposed
    again = design(inertia=change["parameters.inertia"])
    assert own_inertia(mechanism_of(again)) <= change["parameters.inertia"]
    assert not [one for one in FAMILY.check(again) if one.code == "follower.inertia"]


def test_own_inertia_of_a_lever_is_that_of_a_bar():
    """A slot-shaped bar with its holes, the roller and the pin, by parallel axes."""
    params = design()
    m, mounted = mechanism_of(params), mounted_spring(params)
    assert mounted is not None
    total, steel = own_inertia(m) * 1e6, 7.85e-6
    tail, arm, half, t = mounted.hooks.tail, m.arm, 12.0, 8.0
    long = arm + tail
    middle = (arm - tail) / 2
    box = long * 2 * half * t * steel
    inertia = box * ((long**2 + (2 * half) ** 2) / 12 + middle**2)
    cap = math.pi * half**2 / 2 * t * steel
    centroid = 4 * half / (3 * math.pi)
    own = cap * (half**2 / 2 - centroid**2)
    for end in (arm + centroid, tail + centroid):
        inertia += own + cap * end**2

    def disc(radius: float, height: float, at: float) -> float:
        mass = math.pi * radius**2 * height * steel
        return mass * (radius**2 / 2 + at**2)

    inertia -= disc(6, t, 0) + disc(4, t, arm) + disc(mounted.pin / 2, t, tail)
    inertia += disc(9, 10, arm) + disc(4, 9, arm) + disc(mounted.pin / 2, t, tail)
    inertia += sum(disc(step.diameter / 2, step.length, tail) for step in mounted.head)
    assert total == pytest.approx(inertia, rel=0.002)


@pytest.mark.parametrize(
    ("table", "word"),
    [
        ({"spring": "3x3x3"}, "no extension spring"),
        ({"spring_torque": 3.0}, "leave it out"),
        ({"follower": "translating", "inertia": None, "load_torque": None}, "linear-15"),
        ({"conjugate": True}, "conjugate"),
    ],
)
def test_keys_that_do_not_go_with_a_spring(table, word):
    with pytest.raises(ValidationError, match=word):
        design(**table)


def test_a_stage_of_a_chain_states_its_spring():
    with pytest.raises(MountingError, match="spring_torque"):
        FAMILY.transmission(design())


def test_the_mounting_has_the_post_of_the_spring():
    mounting = FAMILY.mounting(design())
    (post,) = mounting.posts
    place = spring_place(mechanism_of(design()))
    assert place is not None
    assert post.point == pytest.approx((place.stands.real, place.stands.imag))
    assert mounting.fastest == (90, "parameters.speed")
    assert len(extension_springs()) > 60
    assert FAMILY.mounting(design(spring=None, spring_torque=2.0)).posts == ()
