"""What joints carry: closed forms, and the torque of the drive by virtual power."""

import math
from pathlib import Path

import numpy as np
import pytest

from mechwright import GROUND, Channel, Instance, Joint, Loop, Motion, Outline, Part, Poses, host
from mechwright.contracts.mass import mass_moments
from mechwright.designs.design import load
from mechwright.errors import KinematicsError
from mechwright.machine import MachineSettings, drive_of
from mechwright.machine.drive import GRAVITY
from mechwright.machine.reactions import carried_of

ROOT = Path(__file__).parents[2]
SAMPLES = 361
RPM = 60.0


def example(name):
    design = load(ROOT / "examples" / f"{name}.toml", host())
    return design.solve(SAMPLES), design.parts()


def rotor(reach):
    """A square weight of steel on a shaft in the ground, ``reach`` mm from it, over one turn."""
    angle = np.linspace(0, math.tau, SAMPLES)
    motion = Motion(
        "theta",
        {"theta": Channel(angle, "rad")},
        {"rotor": Poses.planar(0.0, 0.0, angle)},
        joints={"shaft": Joint("revolute", GROUND, "rotor", drives=True)},
    )
    square = Loop.polygon([(reach + x, y) for x, y in ((-5, -5), (5, -5), (5, 5), (-5, 5))])
    return motion, [Part("rotor", Outline(square), 10.0, "steel", (Instance("rotor"),))]


def test_a_rotor_pulls_on_its_shaft_by_its_centrifugal_force():
    motion, parts = rotor(40.0)
    mass = mass_moments(parts[0])[3, 3]
    found = carried_of(motion, parts, MachineSettings(speed=600.0))
    assert found.forces["shaft"] == pytest.approx(mass * 0.04 * (math.tau * 10) ** 2, rel=1e-6)
    assert found.drive == pytest.approx(0.0, abs=1e-8)


def test_a_weight_is_lifted_and_carried():
    motion, parts = rotor(40.0)
    mass = mass_moments(parts[0])[3, 3]
    found = carried_of(motion, parts, MachineSettings(speed=0.1, up="y"))
    assert found.forces["shaft"] == pytest.approx(mass * GRAVITY, rel=1e-3)
    angle = motion["theta"]
    assert found.drive == pytest.approx(mass * GRAVITY * 0.04 * np.cos(angle), abs=1e-6)


def test_pins_of_planets_share_the_torque_of_their_carrier():
    motion, parts = example("planetary-gears")
    torque, distance = motion.loads["load_torque"].resisting, 0.042
    forces = carried_of(motion, parts, MachineSettings(speed=0.01)).forces
    for planet in (1, 2, 3):
        assert forces[f"planet-{planet}-axis"] == pytest.approx(torque / distance / 3, rel=1e-6)


def test_the_shafts_of_gears_carry_the_force_at_their_pitch_point():
    motion, parts = example("spur-gears")
    (load,) = motion.loads.values()
    ratio = motion.joints["mesh"].ratio
    distance = motion.joints["o2"].point[0] - motion.joints["o1"].point[0]
    radius = distance / (1 + abs(1 / ratio)) * (1 if load.body == "gear-2" else abs(ratio)) / abs(ratio)
    force = load.resisting / (abs(ratio * radius) if load.body == "gear-1" else radius) * 1000
    forces = carried_of(motion, parts, MachineSettings(speed=0.01)).forces
    assert forces["o1"] == pytest.approx(forces["o2"], rel=1e-6)
    assert forces["o2"] == pytest.approx(force, rel=1e-6)


@pytest.mark.parametrize(
    "name",
    [
        "crank-rocker-three-poles",
        "slider-crank-quick-return",
        "spherical-double-crank",
        "five-bar-published",
        "rack-and-pinion",
        "planetary-gears",
        "elliptic-pair",
        "geneva-straight",
        "cam-lever",
        "chains/slider-behind-gears",
    ],
)
@pytest.mark.parametrize("up", ["none", "y"])
def test_the_drive_is_that_of_virtual_power(name, up):
    motion, parts = example(name)
    settings = MachineSettings(up=up, speed=RPM)
    drive = drive_of(motion, parts, settings)
    course = drive.course
    sense = 1.0 if course.rocks else np.sign(course.angle[-1] - course.angle[0])
    wanted = drive.inertia + drive.weight + drive.given + sense * drive.resisting
    found = carried_of(motion, parts, settings)
    joint = next(one for one in motion.joints.values() if one.drives)
    axis = motion.poses[joint.one].rotation[0] @ joint.axis if joint.one else np.array(joint.axis)
    turning = course.turning(joint.two) @ axis  # a joint may count against the input
    np.testing.assert_allclose(
        found.drive * np.sign(turning.mean()), wanted, atol=1e-6 * np.abs(wanted).max()
    )


def test_the_camshaft_carries_the_force_of_the_roller():
    """The family's own contact force is by Norton's equations; differences see jumps of the jerk blurred."""
    motion, parts = example("cam-slide")
    found = carried_of(motion, [part for part in parts if part.name != "cam"], MachineSettings())
    assert found.forces["camshaft"] == pytest.approx(motion["contact_force"], rel=2e-3)


def test_a_flat_face_is_refused():
    motion, parts = example("cam-flat")
    with pytest.raises(KinematicsError, match=r"moves follower, .* set simulation\.friction = 0"):
        carried_of(motion, parts, MachineSettings(speed=RPM))
