"""Parts, frames, joints, masses and mounting of planar linkages."""

import math
import re
import time
from dataclasses import replace

import numpy as np
import pytest
from built import fine, laid_out
from drawn import Drawn
from drawn_linkages import LINKAGES

from mechwright import GeometryError, MountingError
from mechwright.contracts.joint import check_bodies
from mechwright.contracts.mass import mass_moments
from mechwright.mechanics.linkage.linkage import Linkage
from mechwright.mechanics.linkage.parts.frames import frames_of, joints_of, placed_frames
from mechwright.mechanics.linkage.parts.layout import layout_of
from mechwright.mechanics.linkage.parts.masses import masses_of
from mechwright.mechanics.linkage.parts.mounting import mounting_of
from mechwright.mechanics.linkage.parts.parts import parts_of
from mechwright.mechanics.linkage.parts.sizes import Sizes
from mechwright.mechanics.planar.machine import Drive, GearPair, Machine, Prismatic, Revolute
from mechwright.mechanics.planar.positions import solve
from mechwright.mechanics.planar.rigid import Turning
from mechwright_cad.solids.solid import part_solid

every = pytest.mark.parametrize("name", list(LINKAGES))


@every
def test_masses_are_those_of_the_parts_that_move_with_a_link(name):
    layout = laid_out(name)
    frames, found = placed_frames(layout), {}
    for part in parts_of(layout):
        moments = mass_moments(part)
        for instance in part.instances:
            link, place = frames[instance.body]
            shift = np.eye(4)
            shift[:2, 3] = place.real, place.imag
            found[link] = found.get(link, 0) + shift @ moments @ shift.T
    for link, mass in masses_of(layout).items():
        own = found[link]
        assert mass.mass == pytest.approx(own[3, 3], rel=1e-9)
        assert [mass.centre.real, mass.centre.imag] == pytest.approx(own[:2, 3] / own[3, 3], abs=1e-7)
        about = own[0, 0] + own[1, 1] - mass.mass * abs(mass.centre) ** 2
        assert mass.inertia == pytest.approx(about, rel=1e-7)


def test_a_plate_with_a_slot_weighs_what_its_solid_does():
    layout = laid_out("scotch-yoke")
    part = next(part for part in parts_of(layout) if part.name == "yoke")
    assert part_solid(part).Volume() == pytest.approx(layout.outlines["yoke"].area * part.thickness, rel=1e-6)


@every
def test_joints_hold_what_the_motion_shows(name):
    """The place of each joint is one in both bodies, or keeps to the line that the joint says."""
    layout = laid_out(name)
    bodies = fine(name)
    frames, joints = frames_of(layout, bodies), joints_of(layout)
    check_bodies(joints, frames)
    reached = {""}
    for joint in joints.values():
        assert joint.one in reached, "each is held by something that is"
        reached.add(joint.two)
        if joint.one == "":
            continue
        one, two = frames[joint.one], frames[joint.two]
        at = one.transform(np.array([joint.point]))[:, 0]
        seen = np.einsum("nji,nj->ni", two.rotation, at - two.position)
        if joint.kind == "prismatic":
            axis = one.rotation @ np.array(joint.axis)
            way = np.einsum("nji,nj->ni", one.rotation, two.position - one.position)
            across = np.cross(way - way[0], joint.axis)[:, 2]
            assert np.abs(across).max() < 1e-9 * 1000
            assert np.ptp(np.einsum("nji,nj->ni", two.rotation, axis), axis=0).max() < 1e-9
        elif joint.kind == "revolute":
            assert np.ptp(seen, axis=0).max() < 1e-9
    assert reached == {"", *frames}
    assert sum(joint.drives for joint in joints.values()) == 1


@every
def test_every_part_stands_on_a_body_and_has_a_name_for_its_file(name):
    layout = laid_out(name)
    parts = parts_of(layout)
    frames = frames_of(layout, fine(name))
    assert {i.body for part in parts for i in part.instances} <= set(frames)
    names = [part.name for part in parts]
    assert len(set(names)) == len(names)
    assert names[0] == "ground"
    assert "shaft" in names
    assert all(re.fullmatch(r"[a-z0-9_-]+", one) for one in names)


@every
def test_a_motor_finds_the_shaft_below_the_ground_plate(name):
    layout = laid_out(name, screw_hole=6.0)
    plate = mounting_of(layout)
    assert (plate.low, plate.high) == (0.0, 8.0)
    assert plate.end == pytest.approx(-18.0)
    assert plate.shaft == layout.linkage.machine.drives[0].link
    shaft = next(part for part in parts_of(layout) if part.name == "shaft")
    assert shaft.instances[0].z == pytest.approx(plate.end)
    ground = layout.outlines["ground"]
    holes = {loop.segments[0].centre for loop in ground.inner if loop.is_circle}
    assert set(plate.holes) <= holes
    wider = laid_out(name, screw_hole=6.0, screw_offset=plate.out + 5.0)
    assert np.allclose(mounting_of(wider).holes, plate.moved(plate.out + 5.0))


def test_bolts_without_a_thread_are_no_mounting():
    with pytest.raises(MountingError, match="set screw_hole = 6"):
        mounting_of(laid_out("whitworth"))


def test_without_bushings_pins_turn_in_reamed_bores():
    layout = laid_out("crank-shaper", bushing_wall=0.0)
    assert not any(part.name.startswith("bushing") for part in parts_of(layout))
    bores = {2 * loop.segments[0].radius for loop in layout.outlines["lever"].inner if loop.is_circle}
    assert bores == {6.03, 6.0}
    assert masses_of(layout)["block"].mass == 0
    assert {slot.width for slot in layout.slots} == {6.03}


def made(drawn, linkage, **sizes):
    return layout_of(linkage, Sizes(**sizes), drawn.moved(linkage))


def test_a_slider_that_is_not_the_output_is_a_roller_in_a_slot():
    drawn = LINKAGES["slider-crank"]
    layout = made(drawn, drawn.linkage(output="rod"))
    assert "slider" not in layout.outlines
    pin = next(pin for pin in layout.pins if pin.name == "pin-b")
    assert (pin.body, pin.rolling, pin.foot) == ("rod", (("ground", "slider"),), True)
    (slot,) = layout.slots
    # The pin goes from the near to the far dead point on the line 20 mm over the crank's axis.
    far, near = math.sqrt(200**2 - 20**2), math.sqrt(100**2 - 20**2)
    assert [slot.first.imag, slot.last.imag] == pytest.approx([20, 20])
    assert [slot.first.real, slot.last.real] == pytest.approx([near - 1, far + 1], abs=0.02)
    foot = next(part for part in parts_of(layout) if part.name == "pin-b")
    assert [step.diameter for step in foot.turned.steps] == pytest.approx([9.6, 6.0])
    assert foot.instances[0].z == pytest.approx(-1.8)


def test_the_ground_may_be_the_block():
    """The slider has the line and the ground the pins: the slot is in what moves."""
    drawn = LINKAGES["slider-crank"]
    linkage = drawn.linkage()
    joints = [
        Prismatic("s", "slider", "ground", 0j, 20j) if joint.name == "S" else joint
        for joint in linkage.machine.joints
    ]
    turned = replace(linkage, machine=Machine(joints, linkage.machine.drives, {"B": 1}))
    layout = made(drawn, turned)
    assert [slot.link for slot in layout.slots] == ["slider"]
    assert {pin.body for pin in layout.pins if pin.number} == {"ground"}
    assert [pin.place for pin in layout.pins if pin.number] == pytest.approx([-15 + 20j, 15 + 20j])
    assert layout.scheme.plates("ground", "s") == ("ground",)


def test_of_two_links_that_slide_on_each_other_one_has_the_slot():
    """A cylinder between two pins, neither of which is the output."""
    drawn = Drawn(
        {
            "ground": {"A0": (0, 0), "B0": (90, 0)},
            "crank": {"A0": (0, 0), "A": (25, 0)},
            "barrel": {"B0": (0, 0)},
            "rod": {"A": (0, 0)},
        },
        (
            ("R", "A0", "A0", "ground", "crank"),
            ("R", "A", "A", "crank", "rod"),
            ("R", "B0", "B0", "ground", "barrel"),
            ("P", "s", "barrel", "B0", 0, "rod", "A", 0),
        ),
        "crank",
        "crank",
    )
    layout = made(drawn, drawn.linkage())
    assert set(layout.outlines) == {"ground", "crank", "barrel"}
    assert [slot.link for slot in layout.slots] == ["barrel"]


def scissor(stages):
    """A lift of crossed bars, the second foot a slider: each bar goes on in the other one of the next stage."""
    bar = {"L": 0j, "M": 50 + 0j, "E": 100 + 0j}
    points = {"ground": {"A0": 0j}, "foot": {"F": 0j}}
    points |= {f"{side}{k}": bar for k in range(stages) for side in "ab"}
    joints = [Revolute("A0", "ground", "a0", 0j, 0j), Revolute("F", "b0", "foot", 0j, 0j)]
    joints += [Revolute(f"M{k}", f"a{k}", f"b{k}", bar["M"], bar["M"]) for k in range(stages)]
    for k in range(1, stages):
        joints.append(Revolute(f"L{k}", f"b{k - 1}", f"a{k}", bar["E"], 0j))
        joints.append(Revolute(f"R{k}", f"a{k - 1}", f"b{k}", bar["E"], 0j))
    joints.append(Prismatic("floor", "ground", "foot", 0j, 0j))
    branches = {"F": 1, **{f"M{k}": 1 for k in range(1, stages)}}
    return Linkage(Machine(joints, (Drive("a0"),), branches), points, f"a{stages - 1}")


def test_a_scissor_lift_of_ten_bars_takes_no_time():
    linkage = scissor(5)
    theta = 0.65 - 0.25 * np.cos(np.linspace(0, math.tau, 361))
    bodies = solve(linkage.machine, [Turning.of(theta, 1.0)]).bodies
    top = bodies["a4"].point(100.0).position
    assert top.imag == pytest.approx(5 * 100 * np.sin(theta))
    start = time.perf_counter()
    layout = layout_of(linkage, Sizes(), bodies)
    assert time.perf_counter() - start < 5.0
    assert len(layout.outlines) == 11


def test_gears_are_no_plates():
    linkage = LINKAGES["fourbar"].linkage()
    mesh = GearPair("mesh", "crank", "rocker", "ground", -2.0)
    geared = replace(linkage, machine=Machine([*linkage.machine.joints, mesh], linkage.machine.drives))
    with pytest.raises(GeometryError, match="gear pair mesh: plates of a linkage have no teeth"):
        layout_of(geared, Sizes(), LINKAGES["fourbar"].moved(linkage))


def test_names_that_meet_in_lower_case_are_refused():
    drawn = LINKAGES["fourbar"]
    links = {("Coupler" if link == "rocker" else link): own for link, own in drawn.links.items()}
    joints = tuple(tuple("Coupler" if word == "rocker" else word for word in one) for one in drawn.joints)
    other = replace(drawn, links=links, joints=joints, output="Coupler", traces={})
    with pytest.raises(GeometryError, match="two parts are named coupler"):
        parts_of(made(other, other.linkage()))
