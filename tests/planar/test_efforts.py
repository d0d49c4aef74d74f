"""Forces of planar machines: the reference, virtual power, and equilibrium."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from reference_machines import LINKAGES, inputs_of, machine_of, points_of

from mechwright.errors import KinematicsError
from mechwright.mechanics.linkage import Mass
from mechwright.mechanics.planar import Turning
from mechwright.mechanics.planar.efforts import PointLoad, efforts
from mechwright.mechanics.planar.machine import Drive, GearPair, Machine, Pose, Prismatic, Revolute
from mechwright.mechanics.planar.positions import solve
from mechwright.mechanics.planar.springs import Spring, TorsionSpring

TOLERANCE = 1e-9


def loaded(name):
    linkage = LINKAGES[name]
    machine, points = machine_of(linkage), points_of(linkage)
    solution = solve(machine, inputs_of(linkage))
    load = linkage["load"]
    loads = [PointLoad(load["link"], points[load["link"]][load["at"]], complex(*load["force"]))]
    masses = {
        link: Mass(one["mass"], complex(*one["at"]), one["inertia"])
        for link, one in linkage["masses"].items()
    }
    return machine, solution, loads, masses


@pytest.mark.parametrize("name", LINKAGES)
def test_the_reference_has_these_drives_and_joint_forces(name):
    machine, solution, loads, masses = loaded(name)
    for key, suffix, given_masses in (("static", "", {}), ("with_masses", "_with_masses", masses)):
        found = efforts(machine, solution, given_masses, loads)
        for number, position in enumerate(LINKAGES[name]["positions"]):
            for drive, expected in zip(machine.drives, position["drive"], strict=True):
                value = found.drives[drive.link][number]
                assert abs(value - expected[key]) <= TOLERANCE * max(1, abs(expected[key]))
            for joint, expected in position["forces" + suffix].items():
                value = in_the_file_s_terms(machine, solution, found, joint, number)
                off = np.abs(np.asarray(value) - expected)
                assert np.all(off <= TOLERANCE * np.maximum(1, np.abs(expected))), (joint, value, expected)


def in_the_file_s_terms(machine, solution, found, name, number):
    """A pin's force on its first link; a slide's along i times its direction, and its moment."""
    joint = next(one for one in machine.joints if one.name == name)
    if isinstance(joint, GearPair):
        return found.gears[name][number]
    force = found.joints[name][number]
    if isinstance(joint, Revolute):
        return [-force.real, -force.imag]
    guide = solution.bodies[joint.guide].turning.theta[number] + joint.line_angle
    along = force / (1j * np.exp(1j * guide))
    assert abs(along.imag) < 1e-9
    return [along.real, found.moments[name][number]]


# Machines with numbers of their own: pins and slides between points of links.


def four_bar(a, b, c, f):
    return [
        Revolute("A0", "ground", "crank", 0j, 0j),
        Revolute("A", "crank", "coupler", a, 0j),
        Revolute("B", "coupler", "rocker", b, c),
        Revolute("B0", "ground", "rocker", f, 0j),
    ]


def watt(a, b, c, f, d, e):
    """Two bars more, between a coupler point and a point of the rocker."""
    return [
        *four_bar(a, b, c, f),
        Revolute("C", "coupler", "five", d, 0j),
        Revolute("D", "five", "six", b, abs(e)),
        Revolute("E", "rocker", "six", c * 0.3 + e, 0j),
    ]


def stephenson(a, b, c, f, d, e):
    return [
        *four_bar(a, b, c, f),
        Revolute("C", "coupler", "five", d, 0j),
        Revolute("D", "five", "six", b, abs(e) + 40),
        Revolute("E0", "ground", "six", f + e, 0j),
    ]


def press(a, b, c, f, d, e):
    """A ram on the coupler, whose line is askew."""
    return [
        *four_bar(a, b, c, f),
        Revolute("C", "coupler", "rod", d, 0j),
        Revolute("R", "rod", "ram", b + c, 5j),
        Prismatic("guide", "ground", "ram", e, 3 + 2j, 0.3, 0.1),
    ]


def quick_return(a, b, c, f, d, e):
    """A block that slides in a lever, and a ram."""
    return [
        Revolute("A0", "ground", "crank", 0j, 0j),
        Revolute("A", "crank", "block", a, 0j),
        Revolute("B0", "ground", "lever", f, 0j),
        Prismatic("slot", "lever", "block", 2j, 0j),
        Revolute("D", "lever", "rod", b + d, 0j),
        Revolute("R", "rod", "ram", b + c + f, 0j),
        Prismatic("guide", "ground", "ram", e, 3 + 2j, 0.3, 0.1),
    ]


def yoke(a, b, c, f, d, e):
    return [
        Revolute("A0", "ground", "crank", 0j, 0j),
        Revolute("A", "crank", "block", a, 0j),
        Prismatic("slot", "yoke", "block", e, 0j, 1.4, 0.2),
        Prismatic("guide", "ground", "yoke", d, 1 + 2j, 0.1, 0.0),
    ]


def boom(reach=80.0, apart=100.0, drawn_at=60.0):
    """A boom that a cylinder between two moving links lifts; the cylinder is 8 mm longer than its slide."""
    joints = [
        Revolute("O", "ground", "boom", 0j, 0j),
        Revolute("C", "ground", "tube", apart, 0j),
        Revolute("D", "boom", "bar", reach, 0j),
        Prismatic("slide", "tube", "bar", 5 + 0j, -3 + 0j),
    ]
    angle = np.arccos((reach**2 + apart**2 - (drawn_at + 8) ** 2) / (2 * reach * apart))
    end = reach * np.exp(1j * angle)
    along = np.angle(end - apart)
    drawn = {"boom": Pose(0j, angle), "tube": Pose(apart + 0j, along), "bar": Pose(end, along)}
    return Machine(joints, [Drive("bar", "tube")], {}, drawn, [drawn_at])


SIX = [watt, stephenson, press, quick_return, yoke]
length = st.floats(20, 90)
place = st.builds(complex, st.floats(-60, 60), st.floats(-60, 60))


def everything(draw, links, columns):
    """Masses, loads, springs and weight for all links."""
    real = st.floats(-1, 1)

    def number(low, high):
        value = st.floats(low, high)
        return np.array([[draw(value)] for _ in range(columns)]) if columns else draw(value)

    def point():
        return number(-50, 50) + 1j * number(-50, 50)

    masses = {link: Mass(number(0.1, 2), point(), number(0, 900)) for link in links}
    loads = [
        PointLoad(link, point(), 30 * complex(draw(real), draw(real)), 500 * draw(real)) for link in links
    ]
    pairs = list(zip(("ground", *links), links, strict=False))
    springs = [Spring(a, b, point(), point() + 300, number(0.1, 3), number(0, 90)) for a, b in pairs]
    springs += [TorsionSpring(a, b, number(0, 200), number(-2, 2)) for a, b in pairs]
    return masses, loads, springs, complex(4000 * draw(real), -9806.65)


def power(solution, masses, loads, springs, gravity):
    """What the drives have to give (..., n), by virtual work with the true velocities: N mm/s."""
    bodies, total = solution.bodies, 0.0
    for link, mass in masses.items():
        centre, turning = bodies[link].point(mass.centre), bodies[link].turning
        inertia = mass.mass * (np.conj(centre.velocity) * (centre.acceleration - gravity)).real
        total = total + (inertia + mass.inertia * turning.omega * turning.alpha) / 1000
    for load in loads:
        total = total - (np.conj(load.force) * bodies[load.link].point(load.place).velocity).real
        total = total - load.moment * bodies[load.link].turning.omega
    for spring in springs:
        one, two = bodies[spring.one], bodies[spring.two]
        if isinstance(spring, TorsionSpring):
            twist = two.turning.theta - one.turning.theta - spring.free_angle
            total = total + spring.rate * twist * (two.turning.omega - one.turning.omega)
        else:
            start, end = one.point(spring.place_one), two.point(spring.place_two)
            span, rate = end.position - start.position, end.velocity - start.velocity
            longer = (np.conj(span) * rate).real / np.abs(span)
            total = total + spring.rate * (np.abs(span) - spring.free_length) * longer
    return total


def worst_share(solution, found, rates, expected, least=0.05):
    """The largest difference of two powers over the sum of what they are the sum of, near no dead point."""
    given_power = sum(effort * rate for effort, rate in zip(found.drives.values(), rates, strict=True))
    sines = np.minimum.reduce(np.broadcast_arrays(*solution.sines.values(), *solution.pivots.values()))
    good = np.nan_to_num(sines) > least
    assume(good.any())
    forces = sum(np.abs(force) for force in found.joints.values()) * 100 * sum(np.abs(rate) for rate in rates)
    return np.max(np.where(good, np.abs(given_power - expected) / (np.abs(expected) + forces + 1), 0.0))


@given(
    data=st.data(),
    build=st.sampled_from(SIX),
    sides=st.lists(length, min_size=4, max_size=4),
    d=place,
    e=place,
    columns=st.sampled_from([0, 2]),
)
def test_power_of_the_drive_is_virtual_power(data, build, sides, d, e, columns):
    machine = Machine(build(*sides, d, e), [Drive("crank")], {"B": data.draw(st.sampled_from([1, -1]))})
    drive = Turning.of(np.linspace(0.1, 6.0, 25), 7.0, -3.0, 2.0)
    solution = solve(machine, [drive])
    acting = everything(data.draw, machine.links, columns)
    shape = (columns, 25) if columns else (25,)
    try:
        found = efforts(machine, solution, *acting)
    except KinematicsError:
        assume(False)
    assert found.drive.shape == shape
    expected = power(solution, *acting)
    assert worst_share(solution, found, [drive.omega], expected) < 1e-10


@settings(max_examples=6)
@given(data=st.data(), reach=st.floats(70, 90))
def test_power_of_a_cylinder_between_moving_links(data, reach):
    machine = boom(reach)
    t = np.linspace(0, 1, 12)
    drive = Turning.of(40 + 50 * t + 10 * t**2, 50.0 + 20 * t, 20.0)
    solution = solve(machine, [drive])
    acting = everything(data.draw, machine.links, 0)
    found = efforts(machine, solution, *acting)
    assert list(found.drives) == ["bar"]
    assert worst_share(solution, found, [drive.omega], power(solution, *acting), 1e-3) < 1e-10


def test_a_gear_pair_on_a_moving_carrier_does_no_work():
    machine, solution, loads, masses = loaded("geared_moving_carrier")
    springs = [
        Spring("ground", "coupler", 30 + 90j, 10 + 5j, 0.7, 20.0),
        TorsionSpring("ground", "crank", 40.0, 1.0),
    ]
    found = efforts(machine, solution, masses, loads, springs, -9806.65j)
    expected = power(solution, masses, loads, springs, -9806.65j)
    omega = inputs_of(LINKAGES["geared_moving_carrier"])[0].omega
    assert found.drive * omega == pytest.approx(expected, rel=1e-11)


def test_every_design_of_a_column_is_that_design_alone():
    a, b = np.array([[30.0], [35.0], [200.0]]), np.array([[80.0], [95.0], [60.0]])
    drive = Turning.of(np.linspace(0, 6, 40), 5.0, 1.0)
    load = [PointLoad("rocker", 20 + 0j, 5 - 3j)]

    def found_for(a, b):
        machine = Machine(four_bar(a, b, 70.0, 90.0), [Drive("crank")])
        return efforts(machine, solve(machine, [drive]), {"coupler": Mass(b / 100, b / 2, b)}, load)

    together = found_for(a, b)
    for row in range(3):
        alone = found_for(a[row, 0], b[row, 0])
        assert np.array_equal(together.drive[row], alone.drive, equal_nan=True)
        assert np.array_equal(together.joints["B"][row], alone.joints["B"], equal_nan=True)
        assert np.array_equal(np.broadcast_to(together.shaking[row], 40), alone.shaking, equal_nan=True)
    assert np.isnan(together.drive[2]).any()
    assert np.isfinite(together.drive[:2]).all()


def test_forces_at_a_dead_point_are_no_numbers_and_leave_other_designs_alone():
    """The block drives a crank that is in line with its rod."""

    def found_for(offset):
        joints = [
            Revolute("A0", "ground", "crank", 0j, 0j),
            Revolute("A", "crank", "rod", 1.0, 0j),
            Revolute("B", "rod", "block", 1.0, 0j),
            Prismatic("guide", "ground", "block", offset * 1j, 0j),
        ]
        machine = Machine(joints, [Drive("block")])
        solution = solve(machine, [Turning.of([1.6, 2.0])])
        return efforts(machine, solution, loads=[PointLoad("crank", 1.0, 1j)]).drive

    drive = found_for(np.array([[0.0], [0.5]]))
    assert np.isnan(drive).tolist() == [[False, True], [False, True]]
    assert drive[1, 0] == found_for(0.5)[0]


def test_a_link_that_is_not_there_is_named():
    machine = Machine(four_bar(30.0, 80.0, 70.0, 90.0), [Drive("crank")])
    solution = solve(machine, [Turning.of([1.0], 1.0)])
    with pytest.raises(KinematicsError, match="no moving link is called handle"):
        efforts(machine, solution, loads=[PointLoad("handle", 0j, 1.0)])
