"""MJCF, with MuJoCo as a witness: it moves like the motion, and its drive needs the torque that we compute."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from by_night import by_night
from mujoco_witness import Witness, follow, mujoco, torques

from mechwright import GROUND, Arc, Instance, Joint, Line, Loop, Motion, Outline, Part, Poses, host
from mechwright.designs.design import load
from mechwright_cad.exporters.simulation import mjcf
from mechwright_cad.solids.inertia import body_moments
from mechwright_four_bar.family import FourBars
from mechwright_slider_crank.family import SliderCrankFamily

ROOT = Path(__file__).parents[2]
FACTS = {
    fact["name"]: fact
    for fact in json.loads((ROOT / "tests/data/simulation.json").read_text())["facts"]
    if fact["name"].startswith("mujoco.")
}
ANGLE, PLACE = 1e-9, 1e-9
"""rad and mm: by how much MuJoCo's poses may differ."""
TORQUE = 1e-8
"""Part of the greatest torque by which torques may differ; 1e-3 is what is promised."""


def design(name):
    found = load(ROOT / "examples" / f"{name}.toml", host())
    return found.family, found.params


def with_params(name, **changes):
    family, params = design(name)
    return family, type(params).model_validate(params.model_dump(exclude_none=True) | changes)


def witness_of(family, params, samples=73, sample=0):
    motion = family.solve(params, samples)
    return Witness(mjcf.assembly(family.name, family.parts(params), motion, sample)), motion


@pytest.mark.parametrize(
    ("family", "params"),
    [
        pytest.param(*design("crank-rocker-three-poles"), marks=by_night),
        with_params(
            "crank-rocker-three-poles", branch="crossed", direction="cw", ground_angle=33.0, pivot_x=7.0
        ),
        design("double-crank"),
        pytest.param(*design("slider-crank-quick-return"), marks=by_night),
        with_params("slider-crank-quick-return", clockwise=True, slide_direction=-20.0),
        pytest.param(*design("spherical-crank-rocker"), marks=by_night),
        design("spherical-double-crank"),
        design("spherical-five-bar-refined"),
        design("rack-and-pinion"),
        design("spur-gears"),
        design("spur-ring"),
        design("planetary-gears"),
        with_params("planetary-gears", fixed_member="carrier"),
        with_params("planetary-gears", fixed_member="sun", driving_member="ring"),
    ],
    ids=[
        "four-bar",
        "four-bar-crossed",
        "double-crank",
        "slider-crank",
        "slider-crank-turned",
        "spherical",
        "spherical-double-crank",
        "five-bar",
        "rack-and-pinion",
        "spur-gears",
        "spur-ring",
        "planetary-gears",
        "carrier-at-rest",
        "sun-at-rest",
    ],
)
def test_poses_are_those_of_the_motion(family, params):
    witness, motion = witness_of(family, params)
    turned, moved = follow(witness, motion)
    assert turned < ANGLE
    assert moved < PLACE


def test_the_second_phase_of_a_five_bar_moves_too():
    family, params = design("spherical-five-bar-refined")
    params = params.model_copy(update={"five_bar": params.five_bar.model_copy(update={"phase": 2})})
    witness, motion = witness_of(family, params, 37)
    turned, moved = follow(witness, motion)
    assert turned < ANGLE
    assert moved < PLACE


def test_any_pose_can_be_the_one_that_is_written():
    family, params = design("crank-rocker-three-poles")
    motion = family.solve(params, 25)
    witness = Witness(mjcf.assembly("late", family.parts(params), motion, 7))
    drive = motion.channels["phi"].values
    for value in drive[7:17] - drive[7]:
        witness.close(value)
    for name, poses in motion.poses.items():
        at = witness.data.xmat[witness.body(name)].reshape(3, 3)
        np.testing.assert_allclose(at, poses.rotation[16], rtol=0, atol=ANGLE)


@pytest.mark.parametrize("load", [0.0, 3.5])
def test_the_four_bar_needs_the_torque_of_its_channel(load):
    """Masses of the channel come from closed forms of pins and plates, MuJoCo's from the parts of the file."""
    family, params = with_params("crank-rocker-three-poles", speed=400.0, load_torque=load)
    witness, motion = witness_of(family, params)
    forces = np.zeros(witness.model.nv)
    forces[witness.dof("B0")] = load
    channels = motion.channels
    found = torques(witness, motion, channels["omega_a"].values[0], forces)
    wanted = channels["drive_torque"].values
    np.testing.assert_allclose(found, wanted, rtol=0, atol=TORQUE * np.abs(wanted).max())


@pytest.mark.parametrize("load", [0.0, -40.0])
def test_the_slider_crank_needs_the_torque_of_its_channel(load):
    family, params = with_params("slider-crank-quick-return", speed=300.0, load=load)
    witness, motion = witness_of(family, params)
    forces = np.zeros(witness.model.nv)
    forces[witness.dof("guide")] = load
    channels = motion.channels
    found = torques(witness, motion, channels["omega_a"].values[0], forces)
    wanted = channels["drive_torque"].values
    np.testing.assert_allclose(found, wanted, rtol=0, atol=TORQUE * np.abs(wanted).max())


@pytest.mark.parametrize(
    ("name", "limit"), [("crank-rocker-three-poles", 1e-6), ("spherical-five-bar-refined", 1e-4)]
)
def test_a_running_simulation_keeps_its_loops(name, limit):
    """MuJoCo's own time steps and springs: a motor holds the speed for half a second; m, and rad of gears."""
    family, params = design(name)
    witness, _ = witness_of(family, params, 13)
    model, data, drive = witness.model, witness.data, witness.drive
    worst = 0.0
    for _ in range(2500):
        inertia, unit = np.zeros(model.nv), np.zeros(model.nv)
        unit[drive] = 1.0
        mujoco.mj_mulM(model, data, inertia, unit)
        data.ctrl[0] = 200 * inertia[drive] * (math.tau - data.qvel[drive])
        mujoco.mj_step(model, data)
        worst = max(worst, float(np.abs(witness.constraints()[0]).max()))
    assert data.qpos[drive] == pytest.approx(math.pi, abs=0.1)
    assert worst < limit


def kinetic_energy(parts, motion):
    """Kinetic energy (n,), J, at 1 rad/s of the drive, from poses of 2 k + 1 samples over a whole period.

    Half the trace of F' M F'ᵀ, with M the moments of the mass and F the frame of each body; the rates F' by
    trigonometric interpolation.
    """
    total = np.zeros(motion.samples - 1)
    for body, poses in motion.poses.items():
        here = [(part, at.z) for part in parts for at in part.instances if at.body == body]
        frames = np.concatenate([poses.rotation, poses.position[:, :, None]], axis=2)[:-1]
        rates = derivative(frames)
        total += np.einsum("nij,jk,nik->n", rates, body_moments(here), rates) / 2
    return total * 1e-6


def derivative(values):
    """Derivative over the angle of samples over a whole turn, to rounding if they are smooth."""
    count = len(values)
    order = np.fft.fftfreq(count, 1 / count).reshape(-1, *[1] * (values.ndim - 1))
    return np.fft.ifft(1j * order * np.fft.fft(values, axis=0), axis=0).real


@pytest.mark.parametrize("name", ["spherical-crank-rocker", "crank-rocker-three-poles"])
def test_torque_is_the_rate_of_the_kinetic_energy(name):
    """At constant speed the drive's power goes into kinetic energy alone: T = dE/dθ for 1 rad/s."""
    family, params = design(name)
    parts, motion = family.parts(params), family.solve(params, 722)
    wanted = derivative(kinetic_energy(parts, motion))[::19]
    few = Motion(
        motion.input_name,
        {key: type(one)(one.values[:-1:19], one.unit) for key, one in motion.channels.items()},
        {key: Poses(one.position[:-1:19], one.rotation[:-1:19]) for key, one in motion.poses.items()},
        joints=motion.joints,
    )
    found = torques(Witness(mjcf.assembly(name, parts, few)), few, 1.0)
    np.testing.assert_allclose(found, wanted, rtol=0, atol=TORQUE * np.abs(wanted).max())


def test_the_five_bar_needs_the_rate_of_its_kinetic_energy():
    """It does not turn fully: the rates are differences of order 6."""
    family, params = design("spherical-five-bar-refined")
    parts, motion = family.parts(params), family.solve(params, 2401)
    step = float(np.diff(motion.channels["theta"].values[:2])[0])
    energy = np.zeros(motion.samples)
    for body, poses in motion.poses.items():
        here = [(part, at.z) for part in parts for at in part.instances if at.body == body]
        rates = central(np.concatenate([poses.rotation, poses.position[:, :, None]], axis=2), step)
        energy += np.einsum("nij,jk,nik->n", rates, body_moments(here), rates) / 2 * 1e-6
    wanted = central(energy, step)
    places = np.arange(100, 2300, 100)
    witness = Witness(mjcf.assembly("five-bar", parts, motion, 0))
    drive = motion.channels["theta"].values
    found = []
    for place in places:
        witness.close(drive[place] - drive[0])
        found.append(witness.torque(1.0))
    np.testing.assert_allclose(found, wanted[places], rtol=0, atol=1e-3 * np.abs(wanted[places]).max())


def central(values, step):
    """Derivative by central differences of order 6; meaningless at the ends."""
    weights = {1: 3 / 4, 2: -3 / 20, 3: 1 / 60}
    return (
        sum(w * (np.roll(values, -k, axis=0) - np.roll(values, k, axis=0)) for k, w in weights.items()) / step
    )


def bar(name, length, material="aluminium", thickness=6.0, body=None):
    """A plate 20 mm wide with round ends and no bores."""
    half = math.pi / 2
    loop = Loop(
        (
            Line((0.0, -10.0), (length, -10.0)),
            Arc((length, 0.0), 10.0, -half, math.pi),
            Line((length, 10.0), (0.0, 10.0)),
            Arc((0.0, 0.0), 10.0, half, math.pi),
        )
    )
    return Part(name, Outline(loop), thickness, material, (Instance(body or name),))


def lean(motion, names):
    """The motion of some of its bodies alone, the ground left out."""
    joints = {}
    for key, joint in motion.joints.items():
        one = GROUND if joint.one in {"ground", "base"} else joint.one
        if joint.two in names and (one in names or one == GROUND) and joint.kind != "fixed":
            joints[key] = Joint(joint.kind, one, joint.two, joint.point, joint.axis, drives=joint.drives)
    return Motion("phi", motion.channels, {key: motion.poses[key] for key in names}, joints=joints)


def test_the_published_four_bar():
    lengths = (29.9864888895368, 79.98996674541814, 69.99688382152353, 89.99472798474908)
    names = ("crank", "coupler", "follower")
    params = FourBars.Params(**dict(zip((*names, "ground"), lengths, strict=True)))
    motion = lean(FourBars().solve(params, 361), names)
    parts = [bar(name, length) for name, length in zip(names, lengths, strict=False)]
    witness = Witness(mjcf.assembly("F1", parts, motion))
    for name in names:
        body = witness.body(name)
        mass, izz = FACTS[f"mujoco.mass.F1.{name}"], FACTS[f"mujoco.izz.F1.{name}"]
        assert witness.model.body_mass[body] == pytest.approx(mass["expected"], abs=mass["tolerance"])
        assert witness.model.body_inertia[body].max() == pytest.approx(izz["expected"], abs=izz["tolerance"])
    found = torques(witness, motion, 10.0)
    check("mujoco.four_bar_peak_torque", np.abs(found).max())
    for value in np.linspace(math.tau, 1.0, 73):
        witness.close(value)
    check("mujoco.four_bar_torque_1rad", witness.torque(10.0))


def test_the_published_slider_crank():
    crank, rod = 51.23710482942299, 113.28305527097053
    params = SliderCrankFamily.Params(crank=crank, rod=rod, offset=50.0)
    motion = lean(SliderCrankFamily().solve(params, 361), ("crank", "rod", "slider"))
    weight = Loop.polygon([(-10, -10), (10, -10), (10, 10), (-10, 10)])
    slider = Part("slider", Outline(weight), 0.1 / (400 * 2.7e-6), "aluminium", (Instance("slider"),))
    parts = [bar("crank", crank), bar("rod", rod), slider]
    witness = Witness(mjcf.assembly("S1", parts, motion))
    assert witness.model.body_mass[witness.body("slider")] == pytest.approx(0.1, rel=1e-12)
    check("mujoco.slider_crank_peak_torque", np.abs(torques(witness, motion, 10.0)).max())
    witness.close(1.0)
    check("mujoco.slider_crank_torque_1rad", witness.torque(10.0))


def check(name, value):
    """A published figure; its sign is that of the drive's sense."""
    fact = FACTS[name]
    assert abs(value) == pytest.approx(fact["expected"], abs=fact["tolerance"])
