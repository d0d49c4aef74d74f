"""Joint forces against the reference, virtual power, and equilibrium."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from planar_circles import in_body

from mechwright.errors import KinematicsError
from mechwright.mechanics.planar import BodyMotion, PointMotion, Turning
from mechwright.mechanics.planar.dynamics import BLOCK, GROUND, Link, Load, Pin, Slide, forces

FACTS = json.loads((Path(__file__).parents[1] / "data" / "planar-linkages.json").read_text())["facts"]
EXPECTED = {fact["name"]: fact["expected"] for fact in FACTS}


def fourbar():
    phi, omega = np.radians([120.0]), 10.0
    get = EXPECTED.__getitem__
    crank = BodyMotion.about(0j, Turning.of(phi, omega))
    sigma, psi = (
        np.radians(get("fourbar_coupler_angle_sigma_deg")),
        np.radians(get("fourbar_follower_angle_psi_deg")),
    )
    coupler = BodyMotion(
        crank.point(40.0), Turning.of([sigma], get("fourbar_omega_coupler"), get("fourbar_alpha_coupler"))
    )
    follower = BodyMotion.about(
        100 + 0j, Turning.of([psi], get("fourbar_omega_follower"), get("fourbar_alpha_follower"))
    )
    links = [
        Link("crank", crank, 0.5, 20 + 0j, 100.0),
        Link("coupler", coupler, 1.2, 60 + 30j, 2000.0),
        Link("follower", follower, 0.8, 40 + 0j, 600.0),
    ]
    a, b = crank.point(40.0).position, follower.point(80.0).position
    joints = [
        Pin("A0", GROUND, "crank", np.zeros(1, complex)),
        Pin("A", "crank", "coupler", a),
        Pin("B", "coupler", "follower", b),
        Pin("B0", GROUND, "follower", np.full(1, 100 + 0j)),
    ]
    loads = [Load("follower", 0j, np.full(1, 100 + 0j), -50000.0)]
    return links, joints, loads


def test_reference_fourbar():
    links, joints, loads = fourbar()
    found = forces(links, joints, "crank", loads)
    assert found.drive[0] == pytest.approx(EXPECTED["fourbar_input_torque"], rel=1e-6)
    for joint, name in {
        "A0": "ground_on_crank_A0",
        "A": "crank_on_coupler_A",
        "B": "coupler_on_follower_B",
        "B0": "ground_on_follower_B0",
    }.items():
        assert found.joints[joint][0] == pytest.approx(complex(*EXPECTED[f"fourbar_force_{name}"]), rel=1e-7)
    assert found.shaking[0] == pytest.approx(complex(*EXPECTED["fourbar_shaking_force"]), rel=1e-7)


def slider(samples=1):
    get = EXPECTED.__getitem__
    crank = BodyMotion.about(0j, Turning.of(np.radians(np.full(samples, 60.0)), 10.0))
    rod = BodyMotion(
        crank.point(50.0),
        Turning.of(
            np.full(samples, np.radians(get("slider_sigma_deg"))),
            get("slider_omega_coupler"),
            get("slider_alpha_coupler"),
        ),
    )
    pin = rod.point(150.0)
    block = BodyMotion.sliding(pin)
    links = [Link("crank", crank, 0.0), Link("rod", rod, 1.2, 50 + 0j, 2500.0), Link("slider", block, 2.0)]
    joints = [
        Pin("A0", GROUND, "crank", np.zeros(samples, complex)),
        Pin("A", "crank", "rod", crank.point(50.0).position),
        Pin("B", "rod", "slider", pin.position),
        Slide("guide", GROUND, "slider", 1 + 0j, pin.position),
    ]
    return links, joints, [Load("slider", -300000.0 + 0j, pin.position)]


def test_reference_slider():
    links, joints, loads = slider()
    found = forces(links, joints, "crank", loads)
    assert found.drive[0] == pytest.approx(EXPECTED["slider_input_torque"], rel=1e-6)
    assert found.joints["B"][0] == pytest.approx(
        complex(*EXPECTED["slider_pin_force_coupler_on_slider"]), rel=1e-7
    )
    assert found.joints["A"][0] == pytest.approx(
        complex(*EXPECTED["slider_pin_force_crank_on_coupler"]), rel=1e-7
    )
    assert found.joints["guide"][0] == pytest.approx(
        1j * EXPECTED["slider_normal_force_of_guide_on_slider"], rel=1e-7
    )
    assert abs(found.moments["guide"][0]) < 1e-6 * abs(found.drive[0])


def test_the_guide_takes_the_moment_of_a_load_off_centre():
    links, joints, loads = slider()
    aside = [Load("slider", loads[0].force, loads[0].place + 7j)]
    one, two = forces(links, joints, "crank", loads), forces(links, joints, "crank", aside)
    assert two.drive[0] == pytest.approx(one.drive[0], rel=1e-12)
    # A pull of -300 N at 7 mm over the pin: the guide answers with the opposite moment.
    assert two.moments["guide"][0] - one.moments["guide"][0] == pytest.approx(-7 * 300000.0, rel=1e-9)


def test_power_is_virtual_power():
    for links, joints, loads in (fourbar(), slider()):
        found = forces(links, joints, "crank", loads)
        power = 0.0
        for link in links:
            centre = link.centre_motion
            power += link.mass * np.real(np.conj(centre.velocity) * centre.acceleration)
            power += link.inertia * link.motion.turning.omega * link.motion.turning.alpha
        bodies = {link.name: link.motion for link in links}
        for load in loads:
            body = bodies[load.body]
            velocity = body.point(in_body(body, load.place)).velocity
            power -= np.real(np.conj(load.force) * velocity) + load.moment * body.turning.omega
        assert found.drive * 10.0 == pytest.approx(power, rel=1e-10)


def test_ground_carries_what_is_left_over():
    """Forces of the ground and loads together accelerate all masses."""
    links, joints, loads = fourbar()
    found = forces(links, joints, "crank", loads)
    assert found.joints["A0"] + found.joints["B0"] == pytest.approx(-found.shaking, rel=1e-12)


def test_a_load_on_the_ground_changes_nothing():
    links, joints, loads = fourbar()
    more = [*loads, Load(GROUND, 5e5 + 0j, np.zeros(1, complex), 3e6)]
    assert forces(links, joints, "crank", more).drive == forces(links, joints, "crank", loads).drive


def test_wrong_linkages_are_named():
    links, joints, loads = fourbar()
    with pytest.raises(KinematicsError, match="9 equations, but 3 joints"):
        forces(links, joints[:-1], "crank", loads)
    with pytest.raises(KinematicsError, match="no moving link is called handle"):
        forces(links, joints, "handle", loads)
    with pytest.raises(KinematicsError, match="called ground"):
        forces(links, joints, GROUND, loads)
    with pytest.raises(KinematicsError, match="called rocker"):
        forces(links, joints, "crank", [Load("rocker", 0j, np.zeros(1, complex))])


def test_a_dead_centre_is_named():
    """Crank and rod in line: the slider drives the crank with no finite force there."""
    turning = Turning.of([0.0], 1.0)
    crank = BodyMotion.about(0j, turning)
    rod = BodyMotion(crank.point(1.0), Turning.of([0.0], -0.5))
    block = BodyMotion.sliding(rod.point(2.0))
    spin = BodyMotion(PointMotion.of([3 + 0j]), Turning.of([0.0], 1.0))
    links = [Link("crank", crank, 1.0), Link("rod", rod, 1.0), Link("slider", block, 1.0)]
    joints = [
        Pin("A0", GROUND, "crank", np.zeros(1, complex)),
        Pin("A", "crank", "rod", crank.point(1.0).position),
        Pin("B", "rod", "slider", spin.origin.position),
        Slide("guide", GROUND, "slider", 1 + 0j, spin.origin.position),
    ]
    forces(links, joints, "crank")
    with pytest.raises(KinematicsError, match="dead centre"):
        forces(links, joints, "slider")


def test_of_more_samples_than_are_solved_together_each_gets_its_own():
    """A mass on a crank whose speed grows from sample to sample: it pulls with m r ω², where it stands.
    A guide holds the same whichever of its two senses it is given, which is another one from sample to sample."""
    count = 2 * BLOCK + 37
    theta, omega = np.linspace(0.0, 40.0, count), np.linspace(1.0, 3.0, count)
    crank = BodyMotion.about(0j, Turning.of(theta, omega))
    found = forces([Link("crank", crank, 2.0, 10 + 0j)], [Pin("shaft", GROUND, "crank", 0j * theta)], "crank")
    assert np.allclose(found.joints["shaft"], -20 * omega**2 * np.exp(1j * theta), rtol=1e-12)
    links, (*pins, guide), loads = slider(count)
    turned = replace(guide, direction=np.where(theta < 20.0, 1.0, -1.0) + 0j)
    alone, many = (forces(*one[:2], "crank", one[2]) for one in (slider(), (links, [*pins, turned], loads)))
    assert np.allclose(many.joints["guide"], alone.joints["guide"], rtol=1e-9)
    assert np.allclose(many.drive, alone.drive, rtol=1e-9)
