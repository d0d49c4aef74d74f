"""Masses of the links from their real parts, the forces in the joints, and the torques of the gears."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from mechwright import Array, Part, kept
from mechwright.mechanics.linkage import Mass, cylinder_mass, plate_mass, together
from mechwright.mechanics.planar import BodyMotion, Plane
from mechwright.mechanics.planar.dynamics import GROUND, Forces, Link, Load, Pin, forces
from mechwright_five_bar.frames import fixed_frames
from mechwright_five_bar.hub import wheel_angles
from mechwright_five_bar.loop import FiveBar, Loop
from mechwright_five_bar.params import FiveBarParams
from mechwright_five_bar.plates import parts_of
from mechwright_five_bar.train import train_of

MILLI, MICRO = 1e-3, 1e-6
"""Forces are computed in mN and moments in mN mm, from kg, mm and s."""

MOVING = ("crank", "coupler", "rocker", "arm", "idler")


def masses_of(params: FiveBarParams) -> Mapping[str, Mass]:
    """Mass of each moving body with what is fixed to it, in its own frame, wheel and clamp on the arm.

    Screws and washers are left out.
    """
    return _masses(params.unloaded)


@kept
def _masses(params: FiveBarParams) -> Mapping[str, Mass]:
    found: dict[str, list[Mass | None]] = {name: [] for name in MOVING}
    places = fixed_frames(params)
    turn = _wheel_turn(params)
    for part in parts_of(params):
        for instance in part.instances:
            body, place = places.get(instance.body, (instance.body, 0j))
            if body == "wheel":
                body, place = "arm", place * turn
            if body in found:
                found[body].append(_of(part, place))
    return {name: together(one for one in each if one is not None) for name, each in found.items() if each}


def _wheel_turn(params: FiveBarParams) -> complex:
    """The wheel's x axis in the arm's frame."""
    return complex(np.exp(1j * wheel_angles(params)[0]))


def _of(part: Part, place: complex) -> Mass | None:
    if part.outline is not None:
        return plate_mass(part.outline, part.thickness, part.material)
    if part.turned is None:
        return None
    bore, steps = part.turned.bore, part.turned.steps
    return together(cylinder_mass(one.diameter, one.length, part.material, place, bore) for one in steps)


@dataclass(frozen=True)
class Carried:
    """What joints, gears and drive carry over the samples (n,): N and N m.

    Parameters
    ----------
    forces
        Of the joints, mN, and of crank and arm as if each had a drive of its own.
    arm_torque
        That the gears put on the arm.
    drive
        That the crank's shaft takes, gears included.
    """

    forces: Forces
    arm_torque: Array
    drive: Array

    def joint(self, name: str) -> Array:
        """Size of a joint's force (n,), N."""
        return np.asarray(np.abs(self.forces.joints[name]) * MILLI)


def carried_of(
    params: FiveBarParams, bar: FiveBar, loop: Loop, bodies: dict[str, BodyMotion], masses: Mapping[str, Mass]
) -> Carried:
    """Forces and torques of a motion.

    ``joints`` holds A0 (ground on crank), A (crank on coupler), C (rocker on coupler), B1 (arm on rocker) and
    B0 (ground on arm); forces of the teeth on the shafts are not in it.
    """
    links = [
        Link(name, body, masses[name].mass, masses[name].centre, masses[name].inertia)
        for name, body in bodies.items()
    ]
    ones: Plane = np.ones(loop.theta.shape, dtype=complex)
    joints = [
        Pin("A0", GROUND, "crank", 0 * ones),
        Pin("A", "crank", "coupler", loop.joint_a),
        Pin("C", "rocker", "coupler", loop.joint_c),
        Pin("B1", "arm", "rocker", loop.joint_b),
        Pin("B0", GROUND, "arm", bar.pivot * ones),
    ]
    point = bodies["coupler"].point(params.coupler_point).position
    load = Load("coupler", complex(params.load_x, params.load_y) / MILLI, point)
    found = forces(links, joints, ("crank", "arm"), [load])
    arm = found.drives["arm"] * MICRO
    drive = found.drives["crank"] * MICRO + bar.ratio * arm
    if "idler" in masses:
        ratio = train_of(params).ratio("idler")
        drive = drive + ratio**2 * masses["idler"].inertia * bodies["crank"].turning.alpha * MICRO
    return Carried(found, arm, drive)


def wheel_force(params: FiveBarParams, arm_torque: Array) -> Array:
    """Tangential force (n,) between the teeth of the wheel, N."""
    force: Array = np.abs(arm_torque) / (train_of(params).radius("wheel") * MILLI)
    return force
