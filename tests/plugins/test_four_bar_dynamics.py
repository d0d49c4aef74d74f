"""Forces, torque and balance of the four-bar, with the masses of its real parts."""

import math

import numpy as np
import pytest
from four_bar_reference import expected

from mechwright.mechanics.linkage import Mass
from mechwright.mechanics.planar import Turning
from mechwright.mechanics.planar.efforts import PointLoad, efforts
from mechwright_four_bar.family import FourBars
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.kinematics.loop import close
from mechwright_four_bar.kinematics.motion import force_balance
from mechwright_four_bar.kinematics.motion import motion_of as motion_of_table
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.table import FourBarTable

LINKS = ("crank", "coupler", "follower", "ground")
BAR = FourBar(40, 120, 80, 100)
MASSES = {
    "crank": Mass(0.5, 20 + 0j, 100.0),
    "coupler": Mass(1.2, 60 + 30j, 2000.0),
    "follower": Mass(0.8, 40 + 0j, 600.0),
}


def forces_at(phi, masses=MASSES, load=-50000.0, omega=10.0, bar=BAR):
    """In mN and mN mm."""
    table = FourBarTable.of(FourBarParams(**dict(zip(LINKS, bar.lengths, strict=True))))
    found = table.solved(Turning.of(np.atleast_1d(phi), omega))
    loads = [PointLoad("follower", moment=load / 1000)]
    return efforts(table.machine, found, masses, loads).scaled(1000.0)


def motion_of(params, samples):
    return motion_of_table(FourBarTable.of(params), samples)


def test_forces_and_torque_are_the_reference():
    found = forces_at(math.radians(120))
    assert found.drive[0] == pytest.approx(expected("fourbar_input_torque"), rel=1e-9)
    for joint, name in (
        ("A0", "ground_on_crank_A0"),
        ("A", "crank_on_coupler_A"),
        ("B", "coupler_on_follower_B"),
        ("B0", "ground_on_follower_B0"),
    ):
        assert found.joints[joint][0] == pytest.approx(expected(f"fourbar_force_{name}"), rel=1e-9)
    assert found.shaking[0] == pytest.approx(expected("fourbar_shaking_force"), rel=1e-9)


def test_the_drive_s_power_is_the_rate_of_kinetic_energy_less_the_load_s():
    phi = np.linspace(0, math.tau, 721)
    loop = close(BAR, phi)
    bodies = loop.bodies(BAR, 10.0)
    power = forces_at(phi).drive * 10.0 - 50000.0 * bodies["follower"].turning.omega
    rate = np.zeros_like(phi)
    for name, body in bodies.items():
        mass, centre = MASSES[name], body.point(MASSES[name].centre)
        rate += mass.mass * (np.conj(centre.velocity) * centre.acceleration).real
        rate += mass.inertia * body.turning.omega * body.turning.alpha
    np.testing.assert_allclose(power, rate, atol=1e-9 * np.abs(rate).max())


def test_balance_is_the_reference_and_the_ground_stops_shaking():
    balance = force_balance(BAR, MASSES)
    crank, follower = (MASSES[name].mass * MASSES[name].centre for name in ("crank", "follower"))
    assert balance["crank"] + crank == pytest.approx(
        expected("fourbar_full_force_balance_m2r2_complex_in_crank_frame"), rel=1e-9
    )
    assert balance["follower"] + follower == pytest.approx(
        expected("fourbar_full_force_balance_m4r4_complex_in_follower_frame"), rel=1e-9
    )
    balanced = dict(MASSES)
    for name, more in (("crank", balance["crank"]), ("follower", balance["follower"])):
        one = MASSES[name]
        weight = 2.0
        centre = (one.mass * one.centre + more) / (one.mass + weight)
        balanced[name] = Mass(one.mass + weight, centre, one.inertia)
    phi = np.linspace(0, math.tau, 97)
    before, after = (np.abs(forces_at(phi, masses).shaking).max() for masses in (MASSES, balanced))
    assert before > 1000
    assert after < 1e-9 * before


def test_masses_are_those_of_the_solids():
    """The plate's solid and the pressed-in pins weigh what the dynamics take."""
    from mechwright.contracts.materials import material

    family = FourBars()
    params = FourBarParams(coupler_point_x=30, coupler_point_y=25)
    masses = FourBarTable.of(params).masses
    homes = {
        "crank": {"crank", "crank-a"},
        "coupler": {"coupler", "coupler-b"},
        "follower": {"follower", "follower-b"},
    }
    for body, frames in homes.items():
        total = 0.0
        for part in family.parts(params):
            for instance in part.instances:
                if instance.body not in frames:
                    continue
                if part.outline is not None:
                    volume = part.outline.area * part.thickness
                else:
                    volume = part.build().Volume()
                total += volume * material(part.material).density * 1e-6
        assert masses[body].mass == pytest.approx(total, rel=1e-6), body


def test_load_speed_and_sense_reach_the_motion():
    plain = motion_of(FourBarParams(), 9)
    loaded = motion_of(FourBarParams(load_torque=3.0), 9)
    # The drive has to hold what the load does per crank radian: dψ/dφ of it.
    ratio = plain.channels["omega_b"].values / plain.channels["omega_a"].values
    more = loaded.channels["drive_torque"].values - plain.channels["drive_torque"].values
    np.testing.assert_allclose(more, -3.0 * ratio, atol=1e-9)
    fast = motion_of(FourBarParams(speed=120), 9)
    np.testing.assert_allclose(
        fast.channels["shaking_force"].values, 4 * plain.channels["shaking_force"].values, rtol=1e-9
    )
    back = motion_of(FourBarParams(direction="cw"), 9)
    np.testing.assert_allclose(
        back.channels["psi"].values[::-1] % math.tau, plain.channels["psi"].values % math.tau, atol=1e-9
    )
    assert back.channels["omega_a"].values[0] == -plain.channels["omega_a"].values[0]
