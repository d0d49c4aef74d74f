"""Closed forms of dyads against Newton's method on all joint equations, which shares no formula with them."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from reference_linkages import LINKAGES, case

from mechwright.mechanics.planar.assembly_order import Cluster, Driven, Dyad, Group, assembly_order
from mechwright.mechanics.planar.machine import Drive, GearPair, Machine, Pose, Prismatic, Revolute
from mechwright.mechanics.planar.positions import Solution, solve
from mechwright.mechanics.planar.relative_motion import instant_centre, relative_pole
from mechwright.mechanics.planar.rigid import BodyMotion, PointMotion, Turning

EXACT = 1e-7
"""Of the largest rate of its order: Newton stops at 1e-12 of the positions, and dead points may be near."""


def in_one_cluster(machine: Machine, found: Solution) -> tuple[Machine, list[Group]]:
    """A machine with all its links but the driven ones in one group, and the poses of a first sample."""
    poses = {
        link: Pose(body.origin.position[0] + 1e-4, body.turning.theta[0] + 1e-6)
        for link, body in found.bodies.items()
    }
    order = assembly_order(machine)
    driven = [group for group in order if isinstance(group, Driven)]
    own = tuple(link for link in machine.links if link not in {group.link for group in driven})
    joints = tuple(joint for joint in machine.joints if set(joint.links) & set(own))
    return replace(machine, drawn=poses, drawn_at=[0.0]), [*driven, Cluster(own, joints, ())]


def agree(one: Solution, other: Solution) -> None:
    for link, body in one.bodies.items():
        there = other.bodies[link]
        for part in ("position", "velocity", "acceleration", "jerk"):
            a, b = getattr(body.origin, part), getattr(there.origin, part)
            assert np.abs(a - b).max() <= EXACT * max(1.0, np.abs(a).max()), (link, part)
        turn = np.exp(1j * body.turning.theta) - np.exp(1j * there.turning.theta)
        assert np.abs(turn).max() <= EXACT, link
        for part in ("omega", "alpha", "jerk"):
            a, b = getattr(body.turning, part), getattr(there.turning, part)
            assert np.abs(a - b).max() <= EXACT * max(1.0, np.abs(a).max()), (link, part)


@pytest.mark.parametrize("name", [name for name in LINKAGES if name != "stephenson2"])
def test_all_links_in_one_group_move_as_group_after_group(name):
    one = case(name)
    found = solve(one.machine, one.inputs)
    machine, order = in_one_cluster(one.machine, found)
    machine = replace(machine, drawn_at=[one.inputs[0].theta[0]])
    agree(found, solve(machine, one.inputs, order))


def dyad_on_two_cranks(kind: str, seed: int) -> Machine:
    """A dyad whose outer joints are on two driven links, with all places off the axes, drawn closed."""
    rng = np.random.default_rng(seed)

    def place(size: float = 40.0) -> complex:
        return complex(*rng.uniform(-size, size, 2))

    angles = dict(zip(("one", "two", "a", "b"), rng.uniform(-3, 3, 4), strict=True))
    origins = {"one": 0j, "two": 120 + 10j, "a": place() + 20 + 60j, "b": place() + 100 + 60j}

    def inside(link: str, point: complex) -> complex:
        return (point - origins[link]) * np.exp(-1j * angles[link])

    def pin(name: str, one: str, two: str) -> Revolute:
        point = place() + 60 + 40j
        return Revolute(name, one, two, inside(one, point), inside(two, point))

    def slide(name: str, one: str, two: str) -> Prismatic:
        point, direction = place() + 60 + 40j, rng.uniform(-3, 3)
        line = point + rng.uniform(-30, 30) * np.exp(1j * direction)
        own = direction - angles[one], direction - angles[two]
        return Prismatic(name, one, two, inside(one, line), inside(two, point), *own)

    kinds = {"R": pin, "P": slide}
    ends = [("one", "a"), ("a", "b"), ("two", "b")]
    ends = [pair if rng.random() < 0.5 else pair[::-1] for pair in ends]
    joints = [kinds[one](name, *pair) for one, name, pair in zip(kind, ("F", "I", "L"), ends, strict=True)]
    cranks = [Revolute("O", "ground", "one", 0j, 0j), Revolute("Q", "two", "ground", 0j, origins["two"])]
    drawn = {link: Pose(origins[link], angles[link]) for link in origins}
    at = [angles["one"], angles["two"]]
    return Machine([*cranks, *joints], [Drive("one"), Drive("two")], {}, drawn, at)


@given(st.sampled_from(["RRR", "RRP", "PRR", "RPR", "RPP", "PPR", "PRP"]), st.integers(0, 10**6))
def test_dyads_on_links_that_move(kind, seed):
    """One of the branches is the drawn assembly, and closed forms move it as Newton's method does."""
    machine = dyad_on_two_cranks(kind, seed)
    time = np.linspace(0.0, 0.02, 5)
    first, second = (float(angle) for angle in machine.drawn_at)
    inputs = [
        Turning.of(first + 3 * time + 2 * time**2, 3 + 4 * time, 4.0),
        Turning.of(second - 2 * time + time**3, -2 + 3 * time**2, 6 * time, 6.0),
    ]
    order = assembly_order(machine)
    dyad = next(group for group in order if isinstance(group, Dyad))
    assert sorted((dyad.kind, dyad.kind[::-1])) == sorted((kind, kind[::-1]))
    signed = [replace(machine, branches={"I": sign}) for sign in (1, -1)]
    ways = [solve(one, inputs) for one in signed]
    off = [abs(way.bodies["a"].origin.position[0] - machine.drawn["a"].origin) for way in ways]
    found = ways[int(np.nanargmin(off))]
    assert np.nanmin(off) < 1e-6
    assume(found.closes.all() and min(sine.min() for sine in found.sines.values()) > 0.1)
    agree(found, solve(machine, inputs, in_one_cluster(machine, found)[1]))


def test_gears_may_be_stated_from_either_side():
    one = case("geared_fivebar")
    gears = next(joint for joint in one.machine.joints if isinstance(joint, GearPair))
    ratio, phase = 1 / gears.ratio, -gears.phase / gears.ratio
    turned = replace(gears, one=gears.two, two=gears.one, ratio=ratio, phase=phase)
    joints = [turned if joint is gears else joint for joint in one.machine.joints]
    agree(solve(one.machine, one.inputs), solve(replace(one.machine, joints=joints), one.inputs))


def cylinder() -> Machine:
    """A lever about 0 that a rod moves, which is driven out of a body pinned at 50 - 10i; lines are off-centre."""
    joints = [
        Revolute("O", "ground", "lever", 0j, 0j),
        Revolute("C", "ground", "body", 50 - 10j, 2 + 3j),
        Prismatic("S", "body", "rod", 4 + 3j, 1 - 2j, 0.0, 0.0),
        Revolute("L", "lever", "rod", 30 + 5j, 7 - 2j),
    ]
    drawn = {"lever": Pose(0j, 1.9), "body": Pose(50 - 10j, 2.5), "rod": Pose(0j, 2.5)}
    return Machine(joints, [Drive("rod", "body")], {}, drawn, [40.0])


def test_a_cylinder_between_links_that_move_has_the_length_that_is_driven():
    """The pins are s + 2 + 6 = s + 8 apart, with s counted from the line's point; so are three rates."""
    time = np.linspace(0, 1, 9)
    law = Turning.of(40 + 5 * time + 2 * time**2 + time**3, 5 + 4 * time + 3 * time**2, 4 + 6 * time, 6.0)
    found = solve(cylinder(), [law])
    assert found.closes.all()
    point = found.bodies["lever"].point(30 + 5j)
    z, v, a, j = point.position - (50 - 10j), point.velocity, point.acceleration, point.jerk

    def dot(one, two):
        return (np.conj(one) * two).real

    distance = abs(z)
    first = dot(z, v) / distance
    second = (dot(v, v) + dot(z, a) - first**2) / distance
    third = (3 * dot(v, a) + dot(z, j) - 3 * first * second) / distance
    assert np.abs(distance - law.theta - 8).max() < 1e-9
    assert np.abs(first - law.omega).max() < 1e-9
    assert np.abs(second - law.alpha).max() < 1e-8
    assert np.abs(third - law.jerk).max() < 1e-7


def test_coarse_samples_do_not_jump_to_another_assembly():
    """Eight samples of a turn are those of several hundred."""
    one = case("stephenson2")
    start = one.inputs[0].theta[0]
    turn = np.linspace(start, start + 2 * np.pi, 421)
    fine, coarse = (solve(one.machine, [Turning.of(at, 1.0)]) for at in (turn, turn[::60]))
    for link in one.machine.links:
        off = coarse.bodies[link].origin.position - fine.bodies[link].origin.position[::60]
        assert np.abs(off).max() < 1e-9, link


def test_a_drive_between_two_links_that_move():
    """A four-bar driven at the angle of coupler and crank moves as the one that its crank drives."""
    one = case("fourbar")
    found = solve(one.machine, one.inputs)
    crank, coupler = (found.bodies[link].turning for link in ("crank", "coupler"))
    law = Turning(
        *(getattr(coupler, part) - getattr(crank, part) for part in ("theta", "omega", "alpha", "jerk"))
    )
    drawn = in_one_cluster(one.machine, found)[0].drawn
    agree(
        found,
        solve(
            replace(one.machine, drives=[Drive("coupler", "crank")], drawn=drawn, drawn_at=[law.theta[0]]),
            [law],
        ),
    )


def test_links_that_turn_alike_but_for_rounding_have_no_pole():
    """Opposite sides of a rhombus translate to each other, however small it is."""
    centre = np.array([1e-6 + 0j])
    for alpha in (0.0, 0.7):
        side = BodyMotion(PointMotion.of(centre, 1e-6, 1e-6), Turning.of([0.1], 0.1 + 0.2, alpha))
        other = BodyMotion(PointMotion.of(0 * centre), Turning.of([2.0], 0.3, alpha))
        assert side.turning.omega != other.turning.omega
        pole, ground = relative_pole(side, other)
        assert np.isnan([pole.fixed, pole.moving, ground, instant_centre(side, other)]).all()
