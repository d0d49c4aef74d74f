"""Compiled chains of dyads have the motion that the engine solves."""

import math

import numpy as np
import pytest
from reference_machines import LINKAGES, machine_of
from test_efforts import four_bar, press, quick_return, stephenson, watt, yoke

from mechwright.mechanics.planar import Turning
from mechwright.mechanics.planar.compiled_chain import CompiledChain
from mechwright.mechanics.planar.course import Course
from mechwright.mechanics.planar.machine import Drive, GearPair, Machine, Prismatic, Revolute
from mechwright.mechanics.planar.positions import solve

SAMPLES = 301
"""More than two chunks, and no whole number of them."""


def moving_lines():
    """Slides on moving links: a bar in a swinging guide, a pin on two moving lines, a block on a bar."""
    joints = [
        Revolute("A0", "ground", "crank", 0j, 0j),
        Revolute("A", "crank", "coupler", 30.0, 0j),
        Revolute("B", "coupler", "rocker", 80.0, 70.0),
        Revolute("B0", "ground", "rocker", 90.0, 0j),
        # RRP along a line of the coupler
        Revolute("C0", "ground", "bar", 60 - 45j, 2 + 1j),
        Prismatic("c", "coupler", "block", 10 + 5j, 3 + 2j, 0.3, 0.1),
        Revolute("C", "bar", "block", 130 + 4j, -2 + 1j),
        # PRP: one pin on a line of the rocker and on one of the ground
        Prismatic("d", "rocker", "runner", 20 + 3j, 1 - 1j, 0.2, 0.4),
        Prismatic("e", "ground", "yoke", -20 - 30j, 2j, 1.1, 0.2),
        Revolute("D", "runner", "yoke", 4 + 2j, 3 - 1j),
        # RPR between the crank's pin and the ground
        Revolute("F", "crank", "rod", 25 + 4j, 1j),
        Revolute("F0", "ground", "tube", -70 + 10j, 2 + 1j),
        Prismatic("f", "tube", "rod", 5 + 1j, 2 - 3j, 0.4, -0.2),
        # RPP: a block on a moving line of the coupler, and what slides on the block
        Revolute("G0", "ground", "arm", 130 + 60j, 3 + 2j),
        Prismatic("g", "coupler", "slide", 20 + 9j, 1 + 1j, 0.4, 0.1),
        Prismatic("h", "slide", "arm", 2 + 1j, 1 - 2j, 1.2, 0.3),
    ]
    return Machine(joints, [Drive("crank")])


def geared():
    return Machine(
        [
            Revolute("A0", "ground", "crank", 0j, 2 + 1j),
            Revolute("A", "crank", "coupler", 32.0, 3j),
            Revolute("C", "coupler", "rocker", 80.0, 85.0),
            Revolute("B1", "arm", "rocker", 18 + 2j, 1j),
            Revolute("B0", "ground", "arm", 60 + 5j, 1j),
            GearPair("gears", "crank", "arm", "ground", -2.0, 0.7),
        ],
        [Drive("crank")],
    )


def turning(crank):
    return Machine(four_bar(crank, 80.0, 70.0, 90.0), [Drive("crank")])


def cases():
    lengths = 30.0, 80.0, 70.0, 90.0
    yield "four-bar", turning(30.0)
    for build in (watt, stephenson, press, quick_return, yoke):
        yield build.__name__, Machine(build(*lengths, 45.0, 110.0), [Drive("crank")])
    for name, linkage in LINKAGES.items():
        machine = machine_of(linkage)
        if len(machine.drives) == 1:
            yield name, machine
    yield "moving lines", moving_lines()
    yield "geared", geared()


CASES = dict(cases())


def chain_of(name):
    try:
        return CompiledChain(CASES[name])
    except NotImplementedError:
        return None


def rows_of_link(chain, link):
    turning = chain.turning(link)
    point = chain.point(link, 7 - 4j)
    return [chain.angle(link), *range(turning, turning + 5), *range(point, point + 8)]


def motion_of_link(body):
    t, p = body.turning, body.point(7 - 4j)
    values = [t.theta, np.cos(t.theta), np.sin(t.theta), t.omega, t.alpha, t.jerk]
    for one in (p.position, p.velocity, p.acceleration, p.jerk):
        values += [one.real, one.imag]
    return np.stack([np.broadcast_to(one, (SAMPLES,)) for one in values])


def course_of(name, kind):
    if kind == "rocks":
        return Course.between(1.3, 0.4)
    ratio = 0.1 if kind == "accelerates" else 0.0
    return Course(0.3, -4 * math.pi if name == "geared" else math.tau, acceleration_ratio=ratio)


def drives_of(course, speed):
    return np.array([[course.start, course.travel, course.rocks, course.acceleration_ratio, speed]], float)


def near(found, expected):
    size = np.maximum(1.0, np.nanmax(np.abs(expected), axis=-1, keepdims=True, initial=0.0))
    assert np.array_equal(np.isnan(found), np.isnan(expected))
    return np.nanmax(np.abs(found - expected) / size, initial=0.0)


@pytest.mark.parametrize("kind", ["turns", "accelerates", "rocks"])
@pytest.mark.parametrize("name", [name for name in CASES if chain_of(name) is not None])
def test_a_chain_has_the_motion_that_the_engine_solves(name, kind):
    chain, machine, course = chain_of(name), CASES[name], course_of(name, kind)
    _, drive = course.period(SAMPLES, 2.5)
    found = solve(machine, [drive])
    for link in machine.links:
        expected = motion_of_link(found.bodies[link])
        if not np.isfinite(expected).all():
            continue  # angles run on over gaps in another way
        rows = rows_of_link(chain, link)
        assert near(chain.sampled(drives_of(course, 2.5), rows, SAMPLES)[0], expected) < 1e-9, link
        ends = chain.extremes(drives_of(course, 2.5), [(row, 1) for row in rows], SAMPLES)[0]
        assert near(ends, np.stack([expected.min(axis=-1), expected.max(axis=-1)], axis=-1)) < 1e-9
        third = chain.extremes(drives_of(course, 2.5), [(row, 3) for row in rows], SAMPLES)[0]
        few = expected[:, ::3]
        assert near(third, np.stack([few.min(axis=-1), few.max(axis=-1)], axis=-1)) < 1e-9
    for joint, sine in found.sines.items():
        row = chain.sine(joint)
        sines, cosines = np.abs(chain.sampled(drives_of(course, 2.5), [row, row + 1], SAMPLES)[0])
        assert near(sines, np.broadcast_to(sine, SAMPLES)) < 1e-9
        assert near(sines**2 + cosines**2, np.where(np.isnan(sine), np.nan, np.ones(SAMPLES))) < 1e-9
    if found.sines:
        least = chain.sampled(drives_of(course, 2.5), [chain.least_sine()], SAMPLES)[0, 0]
        expected = np.minimum.reduce([np.broadcast_to(one, SAMPLES) for one in found.sines.values()])
        assert near(np.where(np.isfinite(expected), least, np.nan), expected) < 1e-9


@pytest.mark.parametrize("name", [name for name in CASES if chain_of(name) is not None])
def test_values_at_inputs_have_rates_per_unit_of_the_input(name):
    chain, machine = chain_of(name), CASES[name]
    at = np.array([[0.2, 0.9, 1.35]])
    found = solve(machine, [Turning.of(at[0], 1.0)])
    for link in machine.links:
        body = found.bodies[link]
        point = body.point(7 - 4j)
        place = chain.point(link, 7 - 4j)
        rows = [chain.turning(link) + 2, chain.turning(link) + 4, place + 2, place + 7]
        expected = [body.turning.omega, body.turning.jerk, point.velocity.real, point.jerk.imag]
        expected = np.stack([np.broadcast_to(one, 3) for one in expected])
        assert near(chain.values(at, rows)[0], expected) < 1e-9


@pytest.mark.parametrize("name", ["moving lines", "quick_return", "press"])
def test_ways_along_moving_lines_are_those_that_their_guides_see(name):
    from mechwright.mechanics.planar.relative_motion import relative

    chain, machine, course = chain_of(name), CASES[name], course_of(name, "accelerates")
    _, drive = course.period(SAMPLES, 2.5)
    bodies = solve(machine, [drive]).bodies
    for slide in (joint for joint in machine.joints if isinstance(joint, Prismatic)):
        seen = relative(bodies[slide.block], bodies[slide.guide]).point(slide.point)
        turn = np.exp(-1j * np.asarray(slide.line_angle))
        values = (seen.position - slide.line, seen.velocity, seen.acceleration, seen.jerk)
        expected = np.stack([np.broadcast_to((one * turn).real, SAMPLES) for one in values])
        row = chain.way(slide)
        assert near(chain.sampled(drives_of(course, 2.5), range(row, row + 4), SAMPLES)[0], expected) < 1e-9


def test_designs_of_a_column_are_those_designs_alone():
    crank = np.array([[30.0], [20.0], [25.0]])
    chain = CompiledChain(turning(crank))
    drives = np.tile(drives_of(course_of("", "turns"), 2.5), (3, 1))
    drives[1, 1] *= -1  # the other way round
    row = chain.angle("rocker")
    found = chain.extremes(drives, [(row, 1), (chain.turning("rocker") + 3, 1)], SAMPLES)
    for place, length in enumerate(crank.ravel()):
        alone = CompiledChain(turning(length))
        rows = [(alone.angle("rocker"), 1), (alone.turning("rocker") + 3, 1)]
        own = alone.extremes(drives[place : place + 1], rows, SAMPLES)
        assert np.array_equal(own[0], found[place])


def test_a_design_that_does_not_close_has_no_extremes():
    chain = CompiledChain(turning(np.array([[30.0], [95.0]])))
    drives = np.tile(drives_of(course_of("", "turns"), 2.5), (2, 1))
    found = chain.extremes(drives, [(chain.turning("rocker") + 2, 1)], SAMPLES)
    assert np.isfinite(found[0]).all()
    assert np.isnan(found[1]).all()


@pytest.mark.parametrize("name", ["stephenson2"])
def test_links_that_are_found_together_are_refused(name):
    with pytest.raises(NotImplementedError):
        CompiledChain(CASES[name])
