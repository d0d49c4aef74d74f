"""A running simulation by MuJoCo: its input turns at a constant speed, and the torque for that is recorded.

Each step the torque is that with which MuJoCo's own constraints and friction give the input the acceleration
that is wanted, found by the secant rule. Nothing of it is ours but the file and the speed.
"""

import math
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from mujoco_witness import Witness, mujoco

from mechwright import Channel, Motion, Part, Poses
from mechwright.contracts.motion import TIME
from mechwright.designs.design import Design
from mechwright.machine import Drive, MachineSettings, drive_of
from mechwright.machine.drive import SAMPLES
from mechwright_cad.exporters.simulation import mjcf
from mechwright_cad.exporters.simulation.settings import Options, SimulationSettings

STIFFNESS = 200.0
"""1/s: how fast a difference of the input's speed is taken away."""
TRIES = 8
"""Of the secant rule: without friction the second is right."""
POINTS = 181
"""Torques of a run."""
SPEED = 60.0
"""rev/min of a design that has none."""
EXAMPLES = (
    ("crank-rocker-three-poles", "y"),
    ("double-crank", "y"),
    ("slider-crank-quick-return", "y"),
    ("spherical-crank-rocker", "y"),
    ("spherical-five-bar-refined", "y"),
    ("five-bar-published", "y"),
    ("linkages/jansen", "y"),
    ("linkages/klann", "y"),
    ("linkages/scotch-yoke", "y"),
    ("rack-and-pinion", "x"),
)
"""Ten designs of six families, with the direction that points up."""


@dataclass(frozen=True, eq=False)
class Case:
    """A design whose input turns one way at a constant speed, with weights where ``up`` is set.

    Torques are those at ``places`` (POINTS,), rad from the start.
    """

    name: str
    motion: Motion
    parts: tuple[Part, ...]
    machine: MachineSettings
    drive: Drive

    @classmethod
    def of(cls, design: Design, up: str) -> "Case":
        motion, parts = design.solve(SAMPLES), tuple(design.parts())
        travel = np.abs(motion[motion.input_name] - motion[motion.input_name][0])
        speed = SPEED
        if TIME in motion.channels:
            time = motion.channels[TIME].values
            speed = np.abs(np.diff(travel)).sum() / np.ptp(time) / math.tau * 60
        if motion.rocks:  # one way of both, without its ends, where samples crowd
            share = travel / travel.max()
            motion = _between(motion, int(np.argmax(share > 0.02)), int(np.argmax(share > 0.98)))
        machine = MachineSettings(up=up, speed=speed)
        motion = replace(motion, loads={})
        return cls(design.name, motion, parts, machine, drive_of(motion, parts, machine))

    @property
    def range(self) -> float:
        """Turns of the input."""
        return float(np.ptp(self.drive.course.angle)) / math.tau

    @property
    def full(self) -> bool:
        """Whether the input turns round."""
        return self.range > 1 - 1e-6

    @property
    def places(self) -> np.ndarray:
        """Where torques are compared: from a tenth of the range on."""
        first, turns = 0.1 * self.range, self.range * (1.0 if self.full else 0.8)
        return math.tau * np.linspace(first, first + turns, POINTS)

    def at_places(self, values: np.ndarray) -> np.ndarray:
        """Values over the course at the places."""
        angle = np.abs(self.drive.course.angle - self.drive.course.angle[0])
        return np.interp(self.places % angle[-1] if self.full else self.places, angle, values)

    @property
    def ours(self) -> np.ndarray:
        """Torque about the angle, N m, without friction."""
        return self.at_places(self.drive.inertia + self.drive.weight)

    def options(self, **wanted: object) -> Options:
        """Of a file, with gravity where something points up."""
        settings = SimulationSettings(gravity=self.machine.up != "none", **wanted)
        return Options(settings, self.machine)

    def file(self, **wanted: object) -> bytes:
        """The file with these settings."""
        return mjcf.assembly(self.name, self.parts, self.motion, 0, self.options(**wanted))

    def run(self, **wanted: object) -> np.ndarray:
        """The torque (POINTS,) of a running simulation at the places, N m."""
        return run(self.file(**wanted), self.file(), float(self.drive.course.speed[0]), self.places)


def _between(motion: Motion, start: int, end: int) -> Motion:
    channels = {
        name: Channel(one.values[start:end], one.unit)
        for name, one in motion.channels.items()
        if name != TIME
    }
    poses = {
        name: Poses(one.position[start:end], one.rotation[start:end]) for name, one in motion.poses.items()
    }
    return replace(motion, channels=channels, poses=poses, loads={})


def run(file: bytes, plain: bytes, speed: float, places: np.ndarray) -> np.ndarray:
    """Torques at places, rad of the input from its start; it starts with the speeds of the ``plain`` file.

    Each torque is the mean over the way to its neighbours' middles, as the softness of constraints rings.
    """
    witness, start = Witness(file), Witness(plain)
    model, data, drive = witness.model, witness.data, witness.drive
    start.data.qvel[start.drive] = speed
    if start.model.neq:
        start.torque(speed)  # puts all speeds where the loops want them
    for joint in range(start.model.njnt):
        data.qvel[witness.dof(start.model.joint(joint).name)] = start.data.qvel[joint]
    way = places[1] - places[0]
    total, count = np.zeros(len(places)), np.zeros(len(places))
    while True:
        place = round((abs(data.qpos[drive]) - places[0]) / way)
        if place >= len(places):
            return total / count
        torque = _held(model, data, drive, speed)
        if place >= 0:
            total[place] += torque
            count[place] += 1
        mujoco.mj_step(model, data)


def _held(model, data, drive: int, speed: float) -> float:
    """The torque that holds the speed for the next step, which is set; N m."""
    lost = data.qpos[drive] - speed * data.time
    wanted = STIFFNESS * (speed - data.qvel[drive]) - STIFFNESS**2 / 4 * lost

    def acceleration(torque: float) -> float:
        data.ctrl[0] = torque
        mujoco.mj_forward(model, data)
        return float(data.qacc[drive])

    one = float(data.ctrl[0])
    two = one + 1e-3
    first, second = acceleration(one), acceleration(two)
    for _ in range(TRIES):
        if first == second:
            break
        one, two = two, two + (wanted - second) * (two - one) / (second - first)
        first, second = second, acceleration(two)
        if abs(second - wanted) <= 1e-6 * max(1.0, abs(wanted)):
            break
    return two


def rubbed(case: Case, coefficient: float) -> np.ndarray:
    """The torque that friction takes by the principle of virtual power, N m: of each joint its torque times
    its own turning for one turn of the input, or its force times its way.
    """
    from mechwright_cad.exporters.simulation.bearings import bearings_of

    found = bearings_of(case.parts, case.motion, case.options(friction=coefficient))
    course, total = case.drive.course, 0.0
    for name, friction in found.friction.items():
        joint = case.motion.joints[name]
        if joint.kind == "revolute":
            rates = course.turning(joint.two) - (course.turning(joint.one) if joint.one else 0.0)
            total = total + friction * np.linalg.norm(rates, axis=1)
            continue
        ways = course.along(joint.two)[:, :, 3] - (course.along(joint.one)[:, :, 3] if joint.one else 0.0)
        total = total + friction * np.linalg.norm(ways, axis=1) / 1000
    sense = np.sign(course.angle[-1] - course.angle[0])
    return sense * case.at_places(total + np.zeros(course.angle.size))


def example(name: str) -> Path:
    return Path(__file__).parents[2] / "examples" / f"{name}.toml"
