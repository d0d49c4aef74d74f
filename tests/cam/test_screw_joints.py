"""Screwed joints of an assembly: which thread, how deep, to what torque, and what is refused."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mechwright import Bore, Instance, Outline, Part
from mechwright.contracts.bought import BlindThread, Bought
from mechwright.contracts.holes import threaded
from mechwright.contracts.motion import Channel, Motion, Poses
from mechwright.contracts.part import Profile
from mechwright.contracts.shape import Shape, ring
from mechwright.geometry import Loop, circle
from mechwright.pipeline import Build, Wanted
from mechwright.plugins.host import host
from mechwright.standards.screws import screw, washer
from mechwright_cad.bodies import bodies_of
from mechwright_cad.contacts.inspections import ScrewLengths, screw_findings
from mechwright_cad.contacts.screw_joints import joints_of

EXAMPLES = Path(__file__).parents[2] / "examples"


def still(*parts):
    names = {instance.body for part in parts for instance in part.instances}
    rest = Poses.planar(0.0, 0.0, np.zeros(2))
    motion = Motion("t", {"t": Channel(np.zeros(2), "rad")}, dict.fromkeys(sorted(names), rest))
    return bodies_of(parts, motion)


def plate(name, thickness, hole, z, material="aluminium"):
    rim = Loop((circle((0, 0), 20.0),))
    inner = Loop((circle((0, 0), hole / 2, clockwise=True),))
    features = (
        Bore("bore", (0.0, 0.0), hole, 0, thickness),
        Profile("outside", rim, "outside", 0, thickness),
    )
    at = (Instance(name, z),)
    return Part(name, Outline(rim, (inner,)), thickness, material, at, machined=features)


def bolt(length, z, size=5.0):
    return Part("bolt", None, 0.0, "steel", (Instance("bolt", z),), bought=screw(size, length).bought)


def buffer(depth=6.0, torque=0.785):
    shape = Shape((ring(0.0, 20.0, 15.0),), (ring(0.0, 5.0, depth, 15.0 - depth),))
    what = Bought("buffer", shape=shape, threads=(BlindThread((0, 0), 15.0, 5.0, depth, 216.0, torque),))
    return Part("buffer", None, 0.0, "steel", (Instance("buffer", -15.0),), bought=what)


def codes(*parts):
    bodies = still(*parts)
    return [finding.code for finding in screw_findings(bodies, joints_of(bodies, 0))]


def test_rubber_bears_less_than_its_screw():
    (joint,) = joints_of(still(plate("base", 15.0, 5.5, 0.0), buffer(), bolt(20, 15.0)), 0)
    assert (joint.engaged, joint.spare) == (5.0, 1.0)
    assert joint.tightening.limit == "holder"
    assert joint.tightening.torque == 0.785


@pytest.mark.parametrize(
    ("material", "limit", "torque"),
    [("aluminium", "screw", 5.45), ("pom", "head", 1.13), ("steel", "screw", 5.45)],
)
def test_a_clamped_part_of_pom_bears_less_than_the_screw(material, limit, torque):
    """The page said: half of it in POM."""
    below = threaded(plate("below", 10.0, 4.2, -10.0), "bore", "M5")
    (joint,) = joints_of(still(plate("above", 12.0, 5.5, 0.0, material), below, bolt(20, 12.0)), 0)
    assert joint.tightening.limit == limit
    assert joint.tightening.torque == pytest.approx(torque, abs=0.01)


def test_a_washer_spreads_the_pressure_on_pom():
    below = threaded(plate("below", 10.0, 4.2, -10.0), "bore", "M5")
    above = plate("above", 12.0, 5.5, 0.0, "pom")
    ring_ = Part("washer", None, 0.0, "steel", (Instance("washer", 12.0),), bought=washer(5).bought)
    (joint,) = joints_of(still(above, below, ring_, bolt(20, 13.0)), 0)
    assert [k for k, _ in joint.clamped] == [2, 0]
    assert joint.tightening.torque == pytest.approx(1.88, abs=0.02)


def test_a_thread_in_pom_bears_less():
    below = threaded(plate("below", 10.0, 4.2, -10.0, "pom"), "bore", "M5")
    (joint,) = joints_of(still(plate("above", 12.0, 5.5, 0.0), below, bolt(20, 12.0)), 0)
    assert joint.tightening.limit == "thread"
    assert joint.tightening.torque == pytest.approx(2.26, abs=0.01)


@pytest.mark.parametrize(
    ("length", "code"),
    [(20, []), (25, ["screw.bottoms"]), (16, ["screw.engagement"]), (12, ["screw.thread"])],
)
def test_a_screw_that_is_too_long_or_too_short_is_an_error(length, code):
    assert codes(plate("base", 15.0, 5.5, 0.0), buffer(), bolt(length, 15.0)) == code


def test_a_screw_may_go_through_a_thread_that_is_open():
    below = threaded(plate("below", 10.0, 4.2, -10.0), "bore", "M5")
    assert codes(plate("above", 12.0, 5.5, 0.0), below, bolt(35, 12.0)) == []


@pytest.mark.parametrize("name", ["geneva-machine", "five-bar-machine", "spherical-machine"])
def test_no_screw_of_a_machine_bottoms_out(name):
    """Planted as well: every screw one size longer, in turn, is found where its thread is blind."""
    with Build(EXAMPLES / f"{name}.toml", host(), Wanted("check")) as build:
        assert ScrewLengths().findings(build) == []
        motion, parts = build.design.solve(2), list(build.parts)
    longer = {"screw-m3x8": screw(3, 10), "screw-m5x25": screw(5, 30), "screw-m5x30": screw(5, 35)}
    here = [part.name for part in parts if part.name in longer]
    assert "screw-m3x8" in here
    for part in here:
        planted = [replace(one, bought=longer[part].bought) if one.name == part else one for one in parts]
        bodies = bodies_of([replace(one, build=None) if one.name == part else one for one in planted], motion)
        found = [*screw_findings(bodies, joints_of(bodies, 0))]
        assert found, part
        assert {one.code for one in found} == {"screw.bottoms"}
