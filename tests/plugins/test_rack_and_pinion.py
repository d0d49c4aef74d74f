"""Rack and pinion: closed forms, a rack drawn and rolled in another way, rules, tables, and how it runs."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from mechwright import Severity
from mechwright.machine import MachineSettings, drive_of
from mechwright.mechanics.gearing.involute import InvolutePair
from mechwright.mechanics.gearing.rack_pair import RackPair
from mechwright.mechanics.linkage.mass import plate_mass
from mechwright.mechanics.strength.allowed import REVERSING_ROOT, allowed
from mechwright.testing.joints import joint_faults
from mechwright_spur_gears.family import SpurGears
from mechwright_spur_gears.gear_table import table_of
from mechwright_spur_gears.parameters import SpurGearParams
from mechwright_spur_gears.parts.rack import rack_proof, run_of, way_over
from mechwright_spur_gears.parts.teeth import loops_of, prove
from mechwright_spur_gears.rules.strength import root_stresses

ROOT = Path(__file__).parents[2]
GEARS = SpurGears()
CASES = [
    {"teeth": 20},
    {"teeth": 12},
    {"teeth": 40, "shift": -0.3, "rack_teeth": 9},
    {"teeth": 25, "module": 1.0, "pressure_angle": 25.0, "shift": 0.6},
    {"teeth": 17, "centre_distance": 18.0, "rack_teeth": 30},
]
PINIONS = {
    "z": st.integers(8, 120),
    "module": st.floats(0.3, 10),
    "degrees": st.floats(14.5, 30),
    "x": st.floats(-0.3, 0.8),
    "backlash": st.floats(0, 0.05),
}


def rack(**given):
    return SpurGearParams(arrangement="rack", **given)


def errors(**given):
    return {one.code for one in GEARS.check(rack(**given)) if one.severity is Severity.ERROR}


def pinion(z, module, degrees, x, backlash):
    heights = {"addendum": (1.0, 0.95), "dedendum": 1.25, "tip_radius": 0.2}
    return RackPair.of(module, math.radians(degrees), z, x, backlash=backlash * module, **heights)


def teeth_of_rack(m):
    return shapely.Polygon(loops_of(m)[1][0].flatten(1e-5))


@given(**PINIONS)
def test_a_rack_is_a_gear_of_very_many_teeth(**given):
    """The closed forms are the limit of those of two gears: to the share of both numbers of teeth."""
    one = pinion(**given)
    many = 10**9
    other = InvolutePair(
        one.module, one.angle, (one.teeth[0], many), one.shifts, one.addendum, one.dedendum, one.tip_radius
    )
    assert float(other.operating(0)) == pytest.approx(float(one.operating(0)), rel=1e-7)
    assert float(other.foot_curvature(0)) == pytest.approx(
        float(one.foot_curvature(0)), abs=1e-4 * one.module
    )
    assert float(other.contact_ratio) == pytest.approx(float(one.contact_ratio), abs=1e-4)
    if one.foot_curvature(0) > 0.3 * one.module:
        assert float(other.sliding(0)) == pytest.approx(float(one.sliding(0)), rel=1e-2)
    assert float(other.sliding(1)) == pytest.approx(float(one.sliding(1)), rel=1e-2)


@given(**PINIONS)
def test_teeth_fill_the_pitch_line_but_for_the_backlash(**given):
    one = pinion(**given)
    filled = one.thickness_at(0, one.operating(0)) + one.thickness_at(1, 0.0)
    assert filled == pytest.approx(math.pi * one.module - one.backlash, rel=1e-12)
    assert one.distance - one.tip(0) == pytest.approx(
        (1.25 - 1.0) * one.module - one.dedendum * one.module, rel=1e-9
    )
    assert one.operating(0) - one.tip(1) - one.root(0) == pytest.approx(0.3 * one.module, rel=1e-9)
    assert one.distance - one.operating(0) == pytest.approx(given["x"] * one.module, abs=1e-9)


@pytest.mark.parametrize("z", [12, 20, 37])
@pytest.mark.parametrize("x", [0.0, 0.35])
def test_the_contact_ratio_is_the_one_of_a_published_formula(z, x):
    """MAAG, Niemann: ε = (√(da² - db²)/2 - d sin α/2 + m (ha - x)/sin α)/(π m cos α), m 1, 20 degrees."""
    alpha = math.radians(20)
    d, da = z, z + 2 + 2 * x
    way = (math.sqrt(da**2 - (d * math.cos(alpha)) ** 2) - d * math.sin(alpha)) / 2 + (1 - x) / math.sin(
        alpha
    )
    found = RackPair.of(1.0, alpha, z, x)
    assert float(found.contact_ratio) == pytest.approx(way / (math.pi * math.cos(alpha)), rel=1e-12)


@given(
    teeth=st.integers(10, 60), shift=st.floats(-0.2, 0.6), travel=st.floats(5, 400), speed=st.floats(1, 300)
)
@settings(max_examples=20, deadline=None)
def test_the_rack_goes_by_the_reference_circle_at_any_shift(teeth, shift, travel, speed):
    params = rack(teeth=teeth, shift=max(shift, 0.35 if teeth < 18 else shift), travel=travel, speed=speed)
    assume(not errors_of_judge(params))
    motion = GEARS.solve(params, 73)
    r = params.module * teeth / 2
    assert motion["velocity"] == pytest.approx(r * motion["omega1"], rel=1e-12, abs=1e-9)
    assert np.ptp(motion["travel"]) == pytest.approx(travel, rel=1e-12)
    assert motion["travel"][[0, -1]] == pytest.approx(0.0, abs=1e-9 * travel)
    assert motion["time"][-1] == pytest.approx(60 / speed)
    rates = np.gradient(motion["travel"], motion["time"])
    assert rates[1:-1] == pytest.approx(motion["velocity"][1:-1], abs=4e-3 * np.abs(rates).max())
    assert joint_faults(motion) == []
    place = motion.poses["rack"].position
    assert place[:, 0] == pytest.approx(motion["travel"] - travel / 2, abs=1e-9)
    assert place[:, 1] == pytest.approx(-float(table_of(params).distance))


def errors_of_judge(params):
    return [one for one in GEARS.judge(params) if one.severity is Severity.ERROR]


@pytest.mark.parametrize("given", CASES, ids=lambda given: f"{given['teeth']}")
def test_the_flank_of_the_pinion_touches_the_straight_flank_of_the_rack(given):
    """The rack's flank, a line, touches the pinion's outline within 0.1 µm wherever it stands on its path."""
    m = table_of(rack(**given, backlash=0.0))
    pair, run = m.rack_pair, run_of(m)
    alpha, r, half = float(pair.angle), float(pair.operating(0)), float(pair.thickness(1)) / 2
    flanks = [one.at(np.linspace(0, 1, 2000)) for one in loops_of(m)[0][0].segments if one.tag == "flank"]
    recess, approach = (float(path) for path in pair.paths)
    crossings = (np.array(m.rack_plate.tooth_places)[:, None] + half * np.array([-1, 1])).ravel()
    sides = np.tile([-1, 1], int(m.rack_plate.count))
    seen = 0
    for way in np.linspace(-0.5, 0.5, 7) * float(run.pitch):
        turn = float(run.turn(np.asarray(way)))
        turned = [points @ (1, 1j) * np.exp(1j * turn) for points in flanks]
        along = sides * (crossings + way) * math.cos(alpha)
        for k in np.flatnonzero((along > -0.98 * recess) & (along < 0.98 * approach)):
            normal = sides[k] * math.cos(alpha) + 1j * math.sin(alpha)
            on_line = crossings[k] + way - 1j * r
            away = [((points - on_line) * normal.conjugate()).real for points in turned]
            # The flank that the rack's touches is the one that comes nearest to its line about that point.
            touch = -1j * r + along[k] * normal
            nearest = min(range(len(turned)), key=lambda one: np.abs(turned[one] - touch).min())
            assert abs(away[nearest].min()) < 1e-4
            assert abs(turned[nearest][away[nearest].argmin()] - touch) < 0.05 * float(pair.module)
            seen += 1
    assert seen >= 14


@pytest.mark.parametrize("given", CASES, ids=lambda given: f"{given['teeth']}")
def test_racks_have_the_profile_of_the_standard(given):
    m = table_of(rack(**given, backlash=0.04))
    pair, plate, shape = m.rack_pair, m.rack_plate, teeth_of_rack(m)
    size, count = float(pair.module), int(plate.count)
    assert shape.is_valid
    assert shape.bounds == pytest.approx(
        (-count * math.pi * size / 2, -float(plate.back), count * math.pi * size / 2, float(plate.tip))
    )
    for height in (-0.6 * size, 0.0, 0.5 * size):
        line = shapely.LineString([(-1e4, height), (1e4, height)])
        cut = shapely.intersection(shape, line)
        lengths = [piece.length for piece in cut.geoms]
        thick = math.pi * size / 2 - 0.02 - 2 * height * math.tan(pair.angle)
        assert len(lengths) == count
        assert lengths == pytest.approx([thick] * count, abs=1e-4)
    arcs = [one for one in loops_of(m)[1][0].segments if one.tag == "fillet"]
    assert len(arcs) == 2 * count
    assert {round(arc.radius / size, 9) for arc in arcs} == {round(float(pair.tip_radius), 9)}
    loop = loops_of(m)[1][0]
    for one, two in zip(loop.segments, loop.segments[1:], strict=False):
        assert math.dist(one.end, two.start) < 1e-7
        if {one.tag, two.tag} == {"flank", "fillet"}:
            before, after = one.derivative(1.0)[0], two.derivative(0.0)[0]
            turn = before[0] * after[1] - before[1] * after[0]
            assert abs(turn) < 1e-9 * np.hypot(*before) * np.hypot(*after)


@pytest.mark.parametrize("given", CASES, ids=lambda given: f"{given['teeth']}")
def test_a_pinion_is_what_a_rack_cuts(given):
    """The rack of the part, with teeth of full depth, rolls along a blank: what it leaves is the pinion."""
    m = table_of(rack(**given, backlash=0.0))
    run, pair, size = run_of(m), m.rack_pair, float(m.pair.module)
    whole = replace(
        m.rack_plate, tip=pair.dedendum * size, root=(pair.dedendum + 0.2) * size, count=9, fillet=0.0
    )
    cutter = shapely.Polygon(whole.outside().flatten(1e-4))
    arc = float(pair.tip_radius) * size
    cutter = cutter.buffer(-arc, quad_segs=64).buffer(arc, quad_segs=64)
    odd = 0.0 if int(m.rack_plate.count) % 2 else run.pitch / 2
    blank = shapely.Point(0, 0).buffer(float(pair.tip(0)), quad_segs=2000)
    ways = np.linspace(-2.2 * run.pitch, 2.2 * run.pitch, 400)
    places = [
        shapely.affinity.rotate(
            shapely.affinity.translate(cutter, way + odd, -run.distance),
            -float(run.turn(np.asarray(way))),
            origin=(0, 0),
            use_radians=True,
        )
        for way in ways
    ]
    left = blank.difference(shapely.union_all(places))
    drawn = shapely.Polygon(loops_of(m)[0][0].flatten(1e-4))
    facing = -math.pi / 2 - run.start
    wide = 0.9 * run.pitch / run.radius
    far = 2 * float(pair.tip(0))
    sector = shapely.Polygon(
        [(0, 0), *((far * math.cos(facing + side), far * math.sin(facing + side)) for side in (-wide, wide))]
    )
    apart = shapely.intersection(left, sector).symmetric_difference(shapely.intersection(drawn, sector))
    assert shapely.intersection(drawn, sector).area > 0.1 * size**2
    assert apart.buffer(-2e-3 * size).is_empty


@pytest.mark.parametrize("given", CASES, ids=lambda given: f"{given['teeth']}")
def test_racks_mesh_all_over_their_travel(given):
    m = table_of(rack(**given))
    assert errors(**given) == set()
    proof = prove(m)
    assert not proof.collides
    assert proof.error < 5e-6
    assert proof.mesh.arc.min() == pytest.approx(-m.given.travel / 2)
    assert proof.mesh.arc.max() == pytest.approx(m.given.travel / 2)
    tolerance = 1e-4
    polygons = [loop.flatten(tolerance) for loop, _ in loops_of(m)]
    whole = rack_proof(m, way_over(m, 16), *polygons, 4 * tolerance)
    assert not whole.collides
    # The pinion has half of the backlash on either side.
    room = float(m.pair.backlash) / 2 / float(m.pair.operating(0))
    assert (
        np.abs(np.stack((whole.mesh.ahead, whole.mesh.behind)) - room).max() < 4 * tolerance / run_of(m).lever
    )


@given(
    teeth=st.integers(10, 60), shift=st.floats(-0.4, 0.7), module=st.floats(0.5, 4), count=st.integers(3, 20)
)
@settings(max_examples=12, deadline=None)
def test_racks_that_pass_the_rules_mesh(teeth, shift, module, count):
    params = rack(teeth=teeth, shift=shift, module=module, rack_teeth=count, bore=0)
    assume(not errors_of_judge(params))
    proof = prove(table_of(params))
    assert not proof.collides
    assert proof.error < 5e-6


def test_a_rack_that_stands_wrong_collides():
    """The proof bites: half a module nearer, and a quarter of a pitch beside its place."""
    m = table_of(rack(teeth=20))
    polygons = [loop.flatten(1e-4) for loop, _ in loops_of(m)]
    run, way = run_of(m), way_over(m, 8)
    for wrong in (
        replace(run, distance=run.distance - 1.0),
        replace(run, start=run.start + 0.25 * math.tau / 20),
    ):
        assert wrong.prove(polygons[1], polygons[0], way, 0.065, 1e-3).collides
    turned_slower = replace(run, radius=0.98 * run.radius)
    assert turned_slower.prove(polygons[1], polygons[0], way, 0.065, 1e-3).collides


@given(
    teeth=st.integers(12, 90),
    shift=st.floats(-0.2, 0.6),
    addendum=st.floats(0.9, 1.25),
    radius=st.floats(0.2, 0.42),
    degrees=st.floats(15, 25),
)
@settings(max_examples=25, deadline=None)
def test_tips_run_into_fillets_as_the_closed_form_says(teeth, shift, addendum, radius, degrees):
    """Half a pitch and more of travel passes each fillet; outlines without backlash touch there or do not."""
    given = {"addendum": addendum, "tip_radius": radius, "pressure_angle": degrees}
    m = table_of(rack(teeth=teeth, shift=shift, rack_addendum=0.6, travel=8.0, backlash=0.0, **given))
    pair, alpha = m.rack_pair, math.radians(degrees)
    assume(pair.form_curvature(0) > 0.1)
    assume(math.pi / 4 - 1.25 * math.tan(alpha) - radius * (1 - math.sin(alpha)) / math.cos(alpha) > 0.01)
    assume(1.25 - shift - radius > 0.05)
    assume(pair.foot_curvature(1) > pair.form_curvature(1))
    assume(pair.thickness_at(0, pair.tip(0)) > 0.2 * pair.module)
    room = float(pair.fillet_room)
    assume(abs(room) > 1e-3)
    mesh = prove(m).mesh
    sooner = float(np.minimum(mesh.ahead, mesh.behind).min()) * run_of(m).lever
    assert (sooner < -5e-4) == (room < 0)


def touching(m, travel):
    """Flanks of the rack that touch at the end of a travel, and those that an endless rack would have touch."""
    pair, plate = m.rack_pair, m.rack_plate
    half, pitch = float(pair.thickness(1)) / 2, float(pair.pitch)
    recess, approach = (float(path) for path in pair.paths)
    first = plate.tooth_places[0]
    endless = [first + k * pitch for k in range(-30, int(plate.count) + 30)]

    def number(places):
        found = 0
        for place in places:
            for side in (-1, 1):
                along = (place + side * half + travel / 2) * side * math.cos(pair.angle)
                found += -recess <= along <= approach
        return found

    return number(plate.tooth_places), number(endless)


@given(teeth=st.integers(12, 60), shift=st.floats(0.0, 0.8), count=st.integers(4, 30))
@settings(max_examples=40, deadline=None)
def test_the_greatest_travel_is_that_with_all_flanks_that_touch(teeth, shift, count):
    m = table_of(rack(teeth=teeth, shift=max(shift, 0.3), rack_teeth=count, travel=10.0))
    most = float(m.rack_pair.travel(count))
    assume(most > 1)
    for travel in np.linspace(0.05, 1.0, 20) * (most - 1e-6):
        own, endless = touching(m, travel)
        assert own == endless > 0
    own, endless = touching(m, most + 1e-6)
    assert own < endless
    assert int(m.rack_pair.rack_teeth(most - 1e-6)) == count
    assert int(m.rack_pair.rack_teeth(most + 1e-3)) == count + 1


@pytest.mark.parametrize("given", CASES, ids=lambda given: f"{given['teeth']}")
def test_the_size_over_a_pin_is_that_of_a_pin_that_touches_both_flanks(given):
    m = table_of(rack(**given))
    (_, part) = GEARS.parts(rack(**given))
    (measure,) = part.measures
    size = float(measure.what.rpartition("⌀")[2])
    count = int(m.rack_plate.count)
    middle = m.rack_plate.tooth_places[count // 2] + float(m.rack_plate.pitch) / 2
    if count == 1 or middle > float(m.rack_plate.length) / 2 - 1:
        middle -= float(m.rack_plate.pitch)
    centre = measure.nominal - float(m.rack_plate.back) - size / 2
    shape = teeth_of_rack(m)
    assert shape.exterior.distance(shapely.Point(middle, centre)) == pytest.approx(size / 2, abs=2e-5)
    assert not shape.contains(shapely.Point(middle, centre))
    assert measure.least < measure.nominal < measure.greatest


def test_the_load_bends_teeth_both_ways_and_turns_the_pinion():
    m = table_of(rack(teeth=20, load_force=500.0))
    assert float(m.normal_force * np.cos(m.pair.angle)) == pytest.approx(500.0)
    bears = allowed(m.given.material).root
    assert [one.limit for one in root_stresses(m)] == [REVERSING_ROOT * bears] * 2
    loaded, free = (rack(teeth=20, load_force=force) for force in (50.0, 0.0))
    motion = GEARS.solve(loaded, 73)
    assert motion.scalars["pinion_torque"].value == pytest.approx(50.0 * 20 / 1000)
    for direction in ("forwards", "backwards"):
        settings = MachineSettings(direction=direction)
        with_load, without = (
            drive_of(GEARS.solve(one, 73), GEARS.parts(one), settings).runs[0].power for one in (loaded, free)
        )
        assert with_load - without == pytest.approx(50.0 * np.abs(motion["velocity"]) / 1000, abs=1e-4)


def test_the_inertia_of_the_rack_is_driven():
    """Without a load the drive gives what rack and pinion gain: (M + J/r²) v a."""
    params = rack(teeth=20, speed=200.0)
    motion, parts = GEARS.solve(params, 721), GEARS.parts(params)
    power = drive_of(motion, parts, MachineSettings()).runs[0].power
    pinion, moving = (plate_mass(part.outline, part.thickness, part.material) for part in parts)
    mass = moving.mass + pinion.about(0j) / 20.0**2
    exact = mass * motion["velocity"] * motion["acceleration"] * 1e-6
    assert power == pytest.approx(exact, abs=2e-4 * np.abs(exact).max())
