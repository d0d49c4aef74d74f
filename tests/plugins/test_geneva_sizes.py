"""What a design leaves out follows from what it gives: sound, standard sizes, and what is given is kept."""

import math
import re

import numpy as np
import pytest
from by_night import examples, thinned
from hypothesis import example, given, settings
from hypothesis import strategies as st

from mechwright import GeometryError, Severity, Stage
from mechwright.contracts.finding import errors
from mechwright.mechanics.laws import LAWS
from mechwright_geneva.defaults.dimensions import LEFT_OPEN, complete, mechanism_of
from mechwright_geneva.defaults.preferred_sizes import PINS, ROLLERS
from mechwright_geneva.defaults.proportions import ANGLES
from mechwright_geneva.family import Geneva
from mechwright_geneva.kinematics.horn_clearance import clear, greatest_discs
from mechwright_geneva.parameters import GenevaParams
from mechwright_geneva.parts.locking_disc import lock_loop

GENEVA = Geneva()
SLOTS = range(3, 13)
OWN = {
    "polynomial": {"law": "polynomial", "polynomial": (0, 0, 0, 10, -15, 6)},
    "table": {
        "law": "table",
        "table": tuple((k / 20, float(LAWS["modified-sine"]().at(k / 20).s)) for k in range(21)),
    },
}


def check(**table):
    return GENEVA.check(GenevaParams(**table))


@pytest.mark.parametrize(
    ("thickness", "floor"), [(2.0, 0.6), (3.0, 0.9), (5.0, 1.5), (9.9, 2.9), (10.0, 3.0), (40.0, 3.0)]
)
def test_a_thin_wheel_has_a_thin_floor(thickness, floor):
    table = GenevaParams(thickness=thickness)
    assert table.floor == complete(table).floor == pytest.approx(floor)
    assert table.roller_length >= 0.7 * thickness - 0.5 - 1e-9
    assert not errors(GENEVA.check(table), Stage.PARTS)
    assert GenevaParams(thickness=thickness, floor=1.0).floor == 1.0


@pytest.mark.parametrize(("slots", "law"), thinned(2, [*SLOTS], [*LAWS, "straight"]))
def test_slots_and_law_are_enough(slots, law):
    """Parts without an error, slots for a roller that is sold, a driver with a shaft."""
    params = GenevaParams(slots=slots, law=law)
    assert errors(GENEVA.check(params)) == []
    assert {"wheel", "locking-disc", "crank", "roller"} <= {part.name for part in GENEVA.parts(params)}
    sizes = complete(params)
    assert 2 * sizes.roller_radius in ROLLERS
    assert {sizes.pin_diameter, sizes.bore, sizes.driver_bore} <= set(PINS)
    assert sizes.fixing in (*PINS, 0.0)
    assert sizes.roller_radius >= 0.02 * sizes.entry_radius
    assert sizes.driver_bore >= 0.04 * sizes.entry_radius
    assert 2 * sizes.entry_radius <= 380  # fits a table of 400 mm with its mills


@pytest.mark.parametrize("law", OWN)
@pytest.mark.parametrize("slots", [3, 7, 12])
def test_a_law_of_ones_own_is_enough_too(slots, law):
    assert errors(check(slots=slots, **OWN[law])) == []


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("slots", SLOTS)
def test_the_usual_angles_suit_every_law(slots, law):
    """No law needs other angles than the table's; the roller follows the law."""
    sizes = complete(GenevaParams(slots=slots, law=law))
    assert (sizes.crank_half_angle, sizes.offset_angle, sizes.entry_radius) == (*ANGLES[slots], 100)


def test_four_slots_are_the_worked_reference():
    sizes = complete(GenevaParams())
    expected = {
        "crank_half_angle": 50,
        "offset_angle": 5,
        "entry_radius": 100,
        "roller_radius": 5,
        "least_wall": 2,
        "bore": 12,
        "driver_bore": 12,
        "pin_diameter": 6,
        "fixing": 4,
    }
    assert {key: getattr(sizes, key) for key in expected} == expected
    assert sizes.centre_distance == pytest.approx(128.557521937308, abs=1e-9)


def test_what_is_left_out_is_told():
    (note,) = [finding for finding in check(slots=6, bore=10) if finding.code == "geneva.left-out"]
    assert note.severity is Severity.NOTE
    assert "crank_half_angle 60, offset_angle 10, entry_radius 100" in note.message
    assert " bore " not in note.message
    whole = {key: getattr(complete(GenevaParams()), key) for key in LEFT_OPEN}
    assert "geneva.left-out" not in [finding.code for finding in check(**whole)]


laws = st.sampled_from([*LAWS, "straight"])


@given(st.integers(3, 12), laws, st.floats(30, 900))
@example(12, "4-5-6-7", 30.0)
@settings(deadline=None, max_examples=40)
def test_a_wheel_of_any_size_is_kept_inside_the_published_bounds(slots, law, radius):
    """Curved slots on every wheel; straight ones where the driver has room, else the least wheel is named."""
    params = GenevaParams(slots=slots, law=law, entry_radius=radius, load_inertia=0)
    sizes = complete(params)
    assert sizes.entry_radius == radius
    GenevaParams(**{key: getattr(sizes, key) for key in LEFT_OPEN if key != "centre_distance"})
    found = errors(GENEVA.check(params), Stage.PARTS)
    if law == "straight" and slots > 8 and found:
        assert (found[0].code, found[0].parameter) == ("geneva.driver", "entry_radius")
        least = float(re.fullmatch(r"use entry_radius = ([\d.]+)", found[0].remedy)[1])
        assert least > radius
        assert errors(check(slots=slots, law=law, entry_radius=least, load_inertia=0)) == []
    else:
        assert found == []


@given(st.integers(3, 12), st.sampled_from([*LAWS]), st.floats(45, 600))
@settings(deadline=None, max_examples=examples(8, 25))
def test_a_centre_distance_is_kept(slots, law, axes):
    params = GenevaParams(slots=slots, law=law, centre_distance=axes, load_inertia=0)
    assert errors(GENEVA.check(params), Stage.PARTS) == []
    assert mechanism_of(params).axes == pytest.approx(axes, abs=1e-9)


@given(
    st.integers(3, 12),
    st.sampled_from([*LAWS]),
    st.fixed_dictionaries(
        {},
        optional={
            "crank_half_angle": st.floats(10, 110).map(lambda x: round(x, 1)),
            "offset_angle": st.floats(-30, 30).map(lambda x: round(x, 1)),
            "roller_radius": st.floats(1, 30).map(lambda x: round(x, 1)),
            "entry_radius": st.floats(20, 300).map(lambda x: round(x, 1)),
            "driver_bore": st.floats(1, 40).map(lambda x: round(x, 1)),
        },
    ),
)
@settings(deadline=None, max_examples=examples(15, 40))
def test_what_is_given_is_kept_or_refused_by_its_name_with_what_works(slots, law, table):
    params = GenevaParams(slots=slots, law=law, **table)
    if not set(table) - {"crank_half_angle"} or "roller_radius" not in table:
        sizes = complete(params)
        assert {key: getattr(sizes, key) for key in table} == table
    for finding in errors(GENEVA.check(params), Stage.PARTS):
        assert finding.parameter in table, finding
        ways = [
            {
                key: float(value)
                for key, value in re.findall(r"(\w+)(?: at (?:most|least)| =) (-?[\d.]+)", way)
            }
            for way in finding.remedy.split(", or ")
        ]
        assert any(ways), finding
        after = [
            {f.code for f in errors(check(slots=slots, law=law, **{**table, **way}))} for way in ways if way
        ]
        assert any(finding.code not in codes for codes in after), finding


def test_both_sizes_tell_the_crank():
    params = GenevaParams(slots=5, entry_radius=85, centre_distance=100)
    assert errors(GENEVA.check(params)) == []
    assert mechanism_of(params).axes == pytest.approx(100, abs=1e-9)
    assert complete(params).crank_half_angle == pytest.approx(55.937160, abs=1e-5)


def test_a_large_roller_has_a_large_wheel():
    sizes = complete(GenevaParams(slots=8, roller_radius=9.5))
    assert (sizes.roller_radius, sizes.entry_radius) == (9.5, 190)
    assert errors(check(slots=8, roller_radius=9.5)) == []


def test_several_rollers_have_shorter_strokes():
    sizes = complete(GenevaParams(rollers=4))
    assert sizes.crank_half_angle <= 42.5
    assert errors(check(rollers=4)) == []


@pytest.mark.parametrize(
    ("slots", "law", "angles"),
    [
        (6, "cycloidal", (60, 13)),
        (6, "3-4-5", (62, 13)),
        (7, "cycloidal", (62.5, 13)),
        (8, "3-4-5", (65, 13)),
    ],
)
def test_the_horns_cut_a_large_locking_disc(slots, law, angles):
    """The closed condition says what drawing a disc's relief says, but for a hundredth of the radius to spare."""
    table = {"slots": slots, "law": law, "crank_half_angle": angles[0], "offset_angle": angles[1]}
    m = mechanism_of(GenevaParams(**table))
    most = m.nearest - m.groove - m.params.lock_clearance - m.params.least_wall
    discs = np.linspace(m.least_lock, most, 15).round(3)
    said = clear(m.frame, m.law, discs, m.params.lock_clearance)
    drawn = []
    for disc in discs:
        try:
            lock_loop(mechanism_of(GenevaParams(**table, lock_radius=disc)))
            drawn.append(True)
        except GeometryError:
            drawn.append(False)
    assert not (said & ~np.array(drawn)).any()
    assert np.count_nonzero(said != np.array(drawn)) <= 1 + math.ceil(0.01 * most / (discs[1] - discs[0]))
    assert errors(check(**table)) == [] or not said.any()


def horns_cut(m, disc, samples=4001):
    """Whether a horn passes the beginning of the locking arc inside the disc, from where its tip is."""
    wheel, half = float(m.frame.wheel_half), float(m.frame.crank_half)
    rim = float(m.frame.entry_radius) + m.params.lock_clearance
    u = np.linspace(0, 1, samples)
    horn = math.acos((m.axes**2 + rim**2 - disc**2) / (2 * m.axes * rim))
    beyond = 2 * wheel * m.law.at(u).s - horn
    tip = rim * np.exp(1j * beyond) - m.axes
    turned = np.angle(-np.conj(tip))
    return bool(((beyond > 0) & (abs(tip) < 1.01 * disc) & (turned > 2 * half * u)).any())


@pytest.mark.parametrize(
    ("slots", "angles", "radius", "clearance", "most", "bisected"),
    [
        (4, (61.87, -16.5), 810, 0.1, 346.72, 132.82),
        (4, (51.24, -32), 405, 0.16, 94.63, 70.61),
        (5, (54, -18.13), 515.1, 0.1, 131.47, 122.75),
        (4, (50, 27.79), 1000, 1.713, 255.18, 100.05),
    ],
)
def test_the_greatest_locking_disc_is_the_greatest(slots, angles, radius, clearance, most, bisected):
    """Discs that a horn cuts lie between others that it misses, so halving ends at any of the borders."""
    table = {"slots": slots, "crank_half_angle": angles[0], "offset_angle": angles[1]}
    m = mechanism_of(GenevaParams(**table, entry_radius=radius, lock_clearance=clearance))
    ends = np.array([m.least_lock]), np.array([most])
    found = greatest_discs(m.frame.columns(1), m.law, *ends, np.asarray(clearance)).item()
    assert abs(found - bisected) > 0.1
    assert not horns_cut(m, found, 320_001)
    above = np.concatenate([found * np.linspace(1.0005, 1.005, 30), np.linspace(1.005 * found, most, 60)])
    # Near a border the crank cuts only for a moment of its stroke.
    assert all(horns_cut(m, disc) or horns_cut(m, disc, 320_001) for disc in above[above <= most])


def test_a_disc_that_the_horns_cut_is_refused_with_one_that_they_miss():
    table = {"slots": 6, "crank_half_angle": 60, "offset_angle": 13}
    (finding,) = errors(check(**table, lock_radius=26))
    assert (finding.code, finding.parameter) == ("geneva.lock", "lock_radius")
    most = float(re.search(r"at most ([\d.]+)", finding.remedy)[1])
    assert most < 26
    assert errors(check(**table, lock_radius=most)) == []


@pytest.mark.parametrize(("radius", "inertia"), [(20.0, 1.6e-5), (100.0, 0.01), (400.0, 0.01)])
def test_a_load_that_is_left_out_is_in_proportion_to_a_small_wheel(radius: float, inertia: float) -> None:
    assert complete(GenevaParams(entry_radius=radius)).load_inertia == pytest.approx(inertia)
    assert complete(GenevaParams(entry_radius=radius, load_inertia=0.02)).load_inertia == 0.02


def test_a_small_mechanism_bears_its_load_by_default() -> None:
    assert errors(GENEVA.judge(GenevaParams(centre_distance=40))) == []
    heavy = GENEVA.judge(GenevaParams(centre_distance=40, load_inertia=0.01))
    assert [one.code for one in errors(heavy)] == ["geneva.stud"]


@pytest.mark.parametrize(("axes", "dowel", "crank"), [(40.0, 2.0, 5.0), (60.0, 2.5, 8.0), (200.0, 4.0, 8.0)])
def test_what_is_chosen_for_a_small_mechanism_can_be_cut(axes: float, dowel: float, crank: float) -> None:
    """Holes of dowels of 2 mm are drilled; those of pins of 1.5 mm are milled, in a plate that is not too thick."""
    table = complete(GenevaParams(centre_distance=axes))
    assert (table.fixing, table.crank_thickness) == (dowel, crank)
