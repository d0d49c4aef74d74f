"""What goes into a mechanism is what it holds and gives away, whichever way its input turns.

Kinetic energy, and the power of loads, are worked out here from the poses of the motion alone, as splines over
time; torque and speed of the input are the family's own channels, or those of the machine's drive.
"""

import math
from dataclasses import dataclass

import numpy as np
import pytest
from by_night import examples
from hypothesis import given, settings
from hypothesis import strategies as st
from plugins.many import Many
from scipy.interpolate import make_interp_spline

from mechwright import Stage, Turning, host
from mechwright.contracts.mass import body_moments
from mechwright.machine import MachineSettings, drive_of
from mechwright.machine.drive import SAMPLES
from mechwright.machine.outputs import fixed_to

MICRO, MILLI = 1e-6, 1e-3
SENSES = {
    "cam-follower": ("turning", "ccw", "cw"),
    "four-bar": ("direction", "ccw", "cw"),
    "five-bar": ("direction", "ccw", "cw"),
    "slider-crank": ("clockwise", False, True),
    "geneva": ("driver_direction", "forwards", "backwards"),
}
"""Family to the key of its sense, counter-clockwise or forwards first."""

TORQUE = {"cam-follower": ("torque", "omega1"), "geneva": ("crank_torque", "omega_d")}
DRIVEN = ("drive_torque", "omega_a")
"""Channels of the input: torque and speed."""

unit = st.floats(-1.0, 1.0)
speeds = st.floats(30.0, 400.0)


def table(name, **more):
    return st.tuples(st.just(name), st.fixed_dictionaries(more))


CAMS = {"laws": st.just(["4-5-6-7"]), "speed": speeds}
DESIGNS = st.one_of(
    table("cam-follower", **CAMS, load=unit.map(lambda x: 20 * x), offset=unit.map(lambda x: 5 * x)),
    table("cam-follower", **CAMS, contact=st.just("flat"), mass=st.floats(0.1, 2.0)),
    table("cam-follower", **CAMS, follower=st.just("oscillating"), load_torque=st.floats(0.0, 2.0)),
    table("cam-follower", **CAMS, conjugate=st.just(True), mass=st.floats(0.1, 2.0)),
    table("four-bar", speed=speeds, load_torque=unit),
    table("five-bar", speed=speeds, load_x=unit.map(lambda x: 30 * x), load_y=unit.map(lambda x: 30 * x)),
    table("slider-crank", speed=speeds, load=unit.map(lambda x: 50 * x)),
    table("geneva", speed=speeds, law=st.just("cycloidal")),
    table("geneva", speed=speeds, slots=st.sampled_from([4, 6]), load_torque=st.floats(0.0, 0.005)),
    table("elliptic-gears", speed=speeds, load_torque=st.floats(0.0, 2.0)),
    table("noncircular-gears", speed=speeds, load_torque=st.floats(0.0, 2.0)),
    table("spur-gears", speed=speeds, load_torque=st.floats(0.1, 2.0)),
    table(
        "spur-gears",
        arrangement=st.just("planetary"),
        teeth=st.just(24),
        mate_teeth=st.just(18),
        speed=speeds,
        load_torque=st.floats(0.1, 2.0),
    ),
    table("spur-gears", arrangement=st.just("rack"), speed=speeds, load_force=st.floats(1.0, 100.0)),
    table("spherical", speed=st.floats(10.0, 100.0)),
)


def solved(name, values, samples=SAMPLES):
    family = host().family(name)
    params = family.Params.model_validate(values)
    return family.solve(params, samples), family.parts(params)


@dataclass(frozen=True)
class Outside:
    """Over time: what the mechanism holds and what its loads put in; (n,), J and W."""

    gained: np.ndarray
    given: np.ndarray
    taken: np.ndarray


def outside(motion, parts):
    """The rate of the kinetic energy, the power of given loads, and what resistances take."""
    time = motion["time"]

    def rate(values):
        return make_interp_spline(time, values, k=5).derivative()(time)

    moments = {}
    for body in motion.poses:
        own = [(part, one.z) for part in parts for one in part.instances if one.body == body]
        if own:
            moments[body] = body_moments(own)
    for load in motion.loads.values():
        if load.mass is not None or load.inertia is not None:
            for body in fixed_to(load.body, motion.joints):
                moments.pop(body, None)
            half = (load.inertia or 0.0) / MICRO / 2
            moments[load.body] = np.diag([half, half, 0.0, load.mass or 0.0])
    energy = np.zeros_like(time)
    for body, own in moments.items():
        moving = rate(motion.poses[body].frames)
        energy += np.einsum("nij,jk,nik->n", moving, own, moving) * MICRO / 2
    given, taken = np.zeros_like(time), np.zeros_like(time)
    for load in motion.loads.values():
        frames = motion.poses[load.body].frames
        moving, share = rate(frames), 1.0 if load.share is None else load.share
        spin = moving[:, :, :3] @ np.swapaxes(frames[:, :, :3], 1, 2)
        omega = np.stack([spin[:, 2, 1], spin[:, 0, 2], spin[:, 1, 0]], axis=1)
        given += share * (moving @ np.array([*load.point, 1.0]) @ np.array(load.force)) * MILLI
        given += share * (omega @ np.array(load.torque))
        taken += load.resisting * np.linalg.norm(omega, axis=1)
    return Outside(rate(energy), given, taken)


def balanced(powers, gained, where):
    """What is put in, given and taken is what is gained, but for the few samples at jumps of a law.

    There a spline rings. What runs evenly gains nothing but the rounding of its powers.
    """
    put_in = sum(powers)
    rounding = 1e-9 * max(np.abs(power).max() for power in powers)
    most = np.abs(gained).max() + np.abs(put_in).max()
    off = np.abs(put_in - gained)[where]
    assert np.quantile(off, 0.97) <= 2e-4 * most + rounding
    assert np.median(off) <= 1e-6 * most + rounding


def free(motion):
    """Samples at which something outside of the roller's wall does not carry a Geneva wheel."""
    if "crank_torque" not in motion.channels:
        return np.ones(motion["time"].size, dtype=bool)
    return motion["pressure_angle"] < math.radians(79)


@pytest.mark.parametrize("backwards", [False, True])
@given(design=DESIGNS)
@settings(deadline=None, max_examples=examples(25, 200))
def test_the_input_gives_what_is_gained_and_taken(design, backwards):
    """Torque times speed of the input, and the power of the loads, are the rate of the kinetic energy."""
    name, values = design
    if name in SENSES:
        key, ahead, back = SENSES[name]
        values = values | {key: back if backwards else ahead}
    elif backwards:
        return  # the machine runs those backwards: below
    motion, parts = solved(name, values)
    seen = outside(motion, parts)
    put_in = drive_of(motion, parts, MachineSettings(direction="forwards")).runs[0].power
    balanced((put_in, seen.given, -seen.taken), seen.gained, free(motion))
    torque, rate = TORQUE.get(name, DRIVEN)
    if torque in motion.channels:
        own = motion[torque] * motion[rate]
        balanced((own, seen.given, -seen.taken), seen.gained, free(motion))
        where = free(motion)
        np.testing.assert_allclose(own[where], put_in[where], rtol=0, atol=1e-4 * np.abs(put_in).max())


@given(design=DESIGNS)
@settings(deadline=None, max_examples=examples(15, 100))
def test_a_machine_run_backwards_gives_back_all_but_what_is_taken(design):
    name, values = design
    motion, parts = solved(name, values)
    seen, drive = outside(motion, parts), drive_of(motion, parts, MachineSettings())
    ahead, back = drive.runs
    assert (ahead.name, back.name) == ("forwards", "backwards")
    balanced((-back.power, seen.given, seen.taken), seen.gained, free(motion))
    np.testing.assert_allclose(
        ahead.power + back.power, 2 * drive.resisting * np.abs(drive.course.speed), atol=1e-9
    )


LOADED = [
    ("elliptic-gears", {"load_torque": 1.5}, "omega4", 1.5),
    ("elliptic-gears", {"load_torque": 1.5, "stages": 2, "phase": 90}, "omega5", 1.5),
    ("noncircular-gears", {"load_torque": 0.7}, "omega2", 0.7),
    ("spur-gears", {"load_torque": 0.7}, "omega2", 0.7),
    (
        "spur-gears",
        {"load_torque": 0.7, "arrangement": "planetary", "teeth": 24, "mate_teeth": 18},
        "omega2",
        0.7,
    ),
    ("geneva", {"load_torque": 0.01, "driver_direction": "backwards"}, "omega_w", 0.01),
]


@pytest.mark.parametrize(("name", "values", "rate", "torque"), LOADED)
def test_a_machine_carries_the_load_of_the_parameters(name, values, rate, torque):
    """In both senses of the machine: a resistance takes its torque times the speed that it works at."""
    motion, parts = solved(name, values)
    for run in drive_of(motion, parts, MachineSettings()).runs:
        free_of_load = drive_of(
            *solved(name, values | {"load_torque": 0.0}), MachineSettings(direction=run.name)
        )
        np.testing.assert_allclose(
            run.power - free_of_load.runs[0].power, torque * np.abs(motion[rate]), rtol=1e-6, atol=1e-9
        )


def test_a_machine_carries_the_force_on_the_point_of_a_five_bar():
    values = {"load_x": 20.0, "load_y": -35.0}
    motion, parts = solved("five-bar", values)
    own, bare = (
        drive_of(*each, MachineSettings()).runs[0] for each in ((motion, parts), solved("five-bar", {}))
    )
    taken = -(20.0 * motion["vxP"] - 35.0 * motion["vyP"]) * MILLI
    np.testing.assert_allclose(own.power - bare.power, taken, atol=1e-7 * np.abs(taken).max())


STAGES = [
    ("cam-follower", {"laws": ["4-5-6-7"], "follower": "oscillating", "turning": "cw", "load_torque": 1.0}),
    ("cam-follower", {"laws": ["4-5-6-7"], "offset": 4.0}),
    ("geneva", {"law": "cycloidal"}),
    ("geneva", {"slots": 6, "load_torque": 0.004}),
    ("four-bar", {"load_torque": 0.5}),
    ("slider-crank", {"load": 10.0}),
]


@pytest.mark.parametrize("sense", [1.0, -1.0])
@pytest.mark.parametrize(("name", "values"), STAGES)
def test_a_stage_takes_what_it_gains_and_gives_whichever_way_another_one_turns_it(name, values, sense):
    family = host().family(name)
    params = family.Params.model_validate(values)
    stage, time = family.transmission(params), np.linspace(0.0, 0.5, SAMPLES)
    drive = Turning.of(stage.start + sense * math.tau * time / time[-1], sense * math.tau / time[-1])
    motion = stage.motion(drive, time)
    seen = outside(motion, family.parts(params))
    balanced((stage.power(drive, motion), seen.given, -seen.taken), seen.gained, free(motion))


MIRRORED = [
    ("cam-follower", {"offset": 6.0, "load": 5.0}, {"offset": -6.0, "turning": "cw"}),
    ("cam-follower", {"contact": "flat"}, {"turning": "cw"}),
    (
        "four-bar",
        {"load_torque": 1.5, "coupler_point_x": 10.0, "coupler_point_y": 20.0, "ground_angle": 15.0},
        {"load_torque": -1.5, "coupler_point_y": -20.0, "ground_angle": -15.0, "branch": "crossed"},
    ),
    (
        "slider-crank",
        {"load": 30.0, "offset": 8.0, "slide_direction": 25.0},
        {"offset": -8.0, "slide_direction": -25.0},
    ),
    (
        "five-bar",
        {"load_x": 20.0, "load_y": 9.0, "arm_angle": 60.0, "coupler_point_y": 30.0},
        {"load_y": -9.0, "arm_angle": -60.0, "coupler_point_y": -30.0, "branch": "crossed"},
    ),
]


@pytest.mark.parametrize(("name", "one", "other"), MIRRORED)
def test_a_mirror_image_turned_the_other_way_takes_the_same_power(name, one, other):
    """Speeds and torques of the input change their sign, and their products do not."""
    key, ahead, back = SENSES[name]
    torque, rate = TORQUE.get(name, DRIVEN)
    here, there = solved(name, one | {key: ahead}), solved(name, one | other | {key: back})
    ours, theirs = here[0][torque], there[0][torque]
    np.testing.assert_allclose(theirs, -ours, rtol=0, atol=1e-9 * np.abs(ours).max())
    np.testing.assert_allclose(there[0][rate], -here[0][rate])
    powers = [drive_of(*each, MachineSettings(direction="forwards")).runs[0].power for each in (here, there)]
    np.testing.assert_allclose(powers[1], powers[0], rtol=0, atol=1e-6 * np.abs(powers[0]).max())


PLACED = [
    ("cam-follower", {"offset": 6.0}, "pressure_angle_max.theta", "pressure_angle", "pressure_angle_max"),
    (
        "cam-follower",
        {"conjugate": True},
        "pressure_angle_max2.theta",
        "pressure_angle2",
        "pressure_angle_max2",
    ),
    ("slider-crank", {"offset": 8.0}, "phi_far", "s", "s_far"),
    ("slider-crank", {"offset": 8.0}, "phi_near", "s", "s_near"),
    ("slider-crank", {"offset": 8.0, "swing_from": -70.0, "swing_to": 40.0}, "phi_near", "s", "s_near"),
    ("four-bar", {"ground_angle": 40.0}, "limit_extended", "omega_b", None),
    ("four-bar", {"ground_angle": -40.0}, "limit_folded", "omega_b", None),
    ("elliptic-gears", {}, "Q.speed.max.theta2", "Q.speed", "Q.speed.max"),
    ("noncircular-gears", {}, "ratio_max.theta1", "ratio", "ratio_max"),
]
"""Family, table, figure that is an angle of the input, channel, and the figure that it has there; None for 0."""


@pytest.mark.parametrize("back", [False, True])
@pytest.mark.parametrize(("name", "values", "where", "channel", "figure"), PLACED)
def test_a_figure_that_is_an_angle_is_where_the_column_has_it(name, values, where, channel, figure, back):
    """With the sign of the input's column, and within it."""
    if name in SENSES and "swing_from" not in values:
        values = values | {SENSES[name][0]: SENSES[name][2 if back else 1]}
    elif back:
        return
    motion, _ = solved(name, values, 7201)
    angle, there = motion[motion.input_name], motion.scalars[where].value
    assert angle.min() - 1e-12 <= there <= angle.max() + 1e-12
    found = np.interp(
        there, *(np.array(one) for one in zip(*sorted(zip(angle, motion[channel], strict=True)), strict=True))
    )
    wanted = 0.0 if figure is None else motion.scalars[figure].value
    size = np.abs(motion[channel]).max()
    assert (abs(found) if figure and "pressure" in figure else found) == pytest.approx(
        wanted, abs=1e-4 * size
    )


def test_every_angle_of_a_figure_lies_in_the_column_of_a_cam_that_turns_clockwise():
    motion, _ = solved("cam-follower", {"turning": "cw", "offset": 3.0})
    angles = [one.value for name, one in motion.scalars.items() if name.endswith(".theta")]
    assert len(angles) == 4
    assert not any(
        math.copysign(1.0, one) < 0 for one in [*angles, *motion["theta"], *motion["torque"]] if one == 0
    )
    assert all(-math.tau <= one <= 0.0 for one in angles)


COLUMNS = {
    "slider-crank": ("phi_far", "phi_near", "drive_torque.least", "drive_torque.greatest", "phi.least"),
    "four-bar": (
        "limit_extended",
        "limit_folded",
        "drive_torque.least",
        "drive_torque.greatest",
        "phi.least",
    ),
    "five-bar": ("drive_torque.least", "drive_torque.greatest", "theta.least", "omega_a.greatest"),
    "cam-follower": ("torque.least", "torque.greatest", "torque_max", "omega1.greatest", "velocity.least"),
    "geneva": ("crank_torque.least", "crank_torque.greatest", "crank_torque_max", "omega_d.least"),
}


@pytest.mark.parametrize("name", sorted(SENSES))
def test_many_designs_that_turn_backwards_have_what_each_has(name):
    key, _, back = SENSES[name]
    many = Many(host().family(name))
    many.same(many.drawn(4, {key: back}, speed=(40.0, 200.0)), COLUMNS[name], Stage.PARTS)
