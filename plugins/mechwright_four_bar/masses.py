"""Masses of the links from their real parts, forces in the joints, and the balance of the shaking force."""

import cmath

import numpy as np

from mechwright import Array, kept
from mechwright.mechanics.linkage import (
    BUSHING_MATERIAL,
    PIN_MATERIAL,
    Mass,
    cylinder_mass,
    plate_mass,
    together,
)
from mechwright.mechanics.linkage.turned import HEAD, HEAD_HEIGHT
from mechwright.mechanics.planar import BodyMotion
from mechwright.mechanics.planar.dynamics import GROUND, Forces, Link, Load, Pin, forces
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.kinematics.loop import Loop
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.parts.phases import clamp_of_design
from mechwright_four_bar.parts.plates import bushed, joints_of, outlines_of, pin_length
from mechwright_four_bar.parts.sizes import turning_bore

MILLI = 1e-3
"""Forces are computed in mN, from kg, mm and s."""

MICRO = 1e-6
"""Moments are computed in mN mm."""


@kept
def masses_of(params: FourBarParams) -> dict[str, Mass]:
    """Mass of crank, coupler and follower with what is pressed into them, in their own frames.

    Studs are the coupler's; their screws and washers are left out.
    """
    outlines, clamp = outlines_of(params), clamp_of_design(params)
    found = {
        name: [plate_mass(outlines[name], params.thickness, params.material)]
        for name in ("crank", "coupler", "follower")
    }
    diameter = params.pin_diameter
    for name, joint in joints_of(params).items():
        if joint.body == "ground":
            continue
        body, place, bore = joint.body, joint.place, 0.0
        if joint.stud and clamp is not None:
            body, place, bore = "coupler", complex(params.coupler) if name == "pin-b" else 0j, clamp.size.size
        length = pin_length(params, name)
        pin = [cylinder_mass(diameter, length, PIN_MATERIAL, place, bore)]
        if joint.head or joint.stud:
            pin.append(cylinder_mass(HEAD * diameter, HEAD_HEIGHT * diameter, PIN_MATERIAL, place, bore))
        found[body] += pin
    if params.bushing_wall > 0:
        for body, place, _ in bushed(params).values():
            found[body].append(
                cylinder_mass(
                    turning_bore(params),
                    params.thickness,
                    BUSHING_MATERIAL,
                    place,
                    diameter + params.running_fit,
                )
            )
    return {name: together(parts) for name, parts in found.items()}


def joint_forces(
    bar: FourBar,
    loop: Loop,
    bodies: dict[str, BodyMotion],
    masses: dict[str, Mass],
    load_torque: Array | float,
) -> Forces:
    """Forces in the joints and torque of the drive, mN and mN mm.

    Parameters
    ----------
    bar, loop, bodies
        The linkage, its positions (n,), and their motion over time.
    masses
        Of the moving bodies, in their frames.
    load_torque
        Torque of the load on the follower, mN mm, counter-clockwise.

    ``joints`` holds A0 (ground on crank), A (crank on coupler), B (coupler on follower), B0 (ground on
    follower).
    """
    links = [
        Link(name, body, masses[name].mass, masses[name].centre, masses[name].inertia)
        for name, body in bodies.items()
    ]
    ones = np.ones(loop.phi.shape, dtype=complex)
    pivot = bar.ground * cmath.exp(1j * bar.ground_angle)
    joints = [
        Pin("A0", GROUND, "crank", 0 * ones),
        Pin("A", "crank", "coupler", loop.joint_a),
        Pin("B", "coupler", "follower", loop.joint_b),
        Pin("B0", GROUND, "follower", pivot * ones),
    ]
    load = Load("follower", 0 * ones, pivot * ones, load_torque)
    return forces(links, joints, "crank", [load])


def force_balance(bar: FourBar, masses: dict[str, Mass]) -> dict[str, complex]:
    """Counterweights on crank and follower for full force balance at any speed (Berkof and Lowen 1969).

    What is to be added to each is mass times place in its own frame, kg mm, x + i y.

    The common centre of mass rests where m2 r2 = -m3 a (1 - r3/c) and m4 r4 = -m3 r3 b/c, with r3 the centre
    of the coupler from A, along A-B and across.
    """
    crank, coupler, follower = masses["crank"], masses["coupler"], masses["follower"]
    share = coupler.centre / bar.coupler
    return {
        "crank": -coupler.mass * bar.crank * (1 - share) - crank.mass * crank.centre,
        "follower": -coupler.mass * bar.follower * share - follower.mass * follower.centre,
    }
