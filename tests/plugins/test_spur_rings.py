"""Rings of involute teeth: closed forms, and involutes and cutters drawn and rolled in another way."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from mechwright import Severity
from mechwright.mechanics.gearing.involute import InvolutePair, involute
from mechwright_spur_gears.family import SpurGears
from mechwright_spur_gears.gear_table import table_of
from mechwright_spur_gears.parameters import SpurGearParams
from mechwright_spur_gears.parts.teeth import loops_of, prove, teeth_of

GEARS = SpurGears()
CASES = [
    {"teeth": 20, "mate_teeth": 60},
    {"teeth": 12, "mate_teeth": 48},
    {"teeth": 30, "mate_teeth": 40},
    {"teeth": 18, "mate_teeth": 45, "centre_distance": 27.6},
    {"teeth": 25, "mate_teeth": 70, "module": 1.0, "pressure_angle": 25.0},
]


def ring(**given):
    return SpurGearParams(arrangement="internal", **given)


def codes(**given):
    return {one.code for one in GEARS.check(ring(**given)) if one.severity is Severity.ERROR}


def toothed(count, base, half, root, tip, samples=60):
    """A gear of involutes from a root to a tip circle: half the tooth's angle on the base circle is ``half``."""
    radii = np.linspace(max(base, root), tip, samples)
    flank = half - involute(np.arccos(np.minimum(base / radii, 1.0)))
    radii, flank = np.append(root, radii), np.append(flank[0], flank)
    one = np.concatenate([radii * np.exp(-1j * flank), (radii * np.exp(1j * flank))[::-1]])
    teeth = (one * np.exp(2j * np.pi / count * np.arange(count))[:, None]).ravel()
    return shapely.Polygon(np.column_stack((teeth.real, teeth.imag)))


def half_angle(pair, gear):
    """Half the angle of a tooth where its involutes begin, or of a ring of its space."""
    count = abs(pair.teeth[gear])
    thick = pair.thickness(gear) / (pair.module * count)
    return thick + involute(pair.angle) if gear == 0 else math.pi / count - thick + involute(pair.angle)


def spaces(pair):
    """The opening of a ring, drawn as a gear of its spaces from the tips of the ring to its roots."""
    return toothed(abs(pair.teeth[1]), -pair.base(1), half_angle(pair, 1), -pair.tip(1), -pair.root(1))


@pytest.mark.parametrize("given", CASES, ids=lambda given: f"{given['teeth']}-{given['mate_teeth']}")
def test_flanks_of_rings_are_the_involutes_of_the_closed_forms(given):
    m = table_of(ring(**given))
    assert codes(**given) == set()
    pair = m.pair
    (loop, _) = loops_of(m)[1]
    base, half = -float(pair.base(1)), half_angle(pair, 1)
    for segment in [one for one in loop.segments if one.tag == "flank"][:4]:
        points = segment.at(np.linspace(0, 1, 30)) @ (1, 1j)
        radii = np.abs(points)
        # Spaces stand half a pitch from tooth 0, which is on +x.
        angle = (
            np.abs((np.angle(points) / math.tau * pair.teeth[1]) % 1.0 - 0.5) * math.tau / abs(pair.teeth[1])
        )
        exact = half - involute(np.arccos(base / radii))
        assert np.abs(radii * (angle - exact)).max() < 1e-4


@pytest.mark.parametrize("given", CASES, ids=lambda given: f"{given['teeth']}-{given['mate_teeth']}")
def test_rings_are_what_a_shaper_cuts(given):
    """A cutter with rounded tips, drawn with its own involutes, rolls once round a tooth."""
    m = table_of(ring(**given))
    pair = m.pair
    z1, z2 = int(pair.teeth[0]), -int(pair.teeth[1])
    rolled, apart = float(pair.operating(0)), float(m.distance)
    tip = -float(pair.root(1)) - apart
    space = math.tau / z1 - float(pair.thickness_at(1, pair.operating(1))) / rolled
    half = space / 2 + float(involute(pair.operating_angle))
    arc = float(pair.cutter_radius * pair.module)
    cutter = toothed(z1, float(pair.base(0)), half, tip - 2.5 * float(pair.module), tip, 400)
    cutter = cutter.buffer(-arc, quad_segs=128).buffer(arc, quad_segs=128)
    pitch, places = math.tau / z2, []
    for turn in np.linspace(-2 * pitch, 2 * pitch, 301):
        own = shapely.affinity.rotate(cutter, turn * z2 / z1, origin=(0, 0), use_radians=True)
        own = shapely.affinity.translate(own, apart, 0)
        places.append(shapely.affinity.rotate(own, -turn, origin=(0, 0), use_radians=True))
    swept = shapely.union_all(places)
    opening = shapely.Polygon(loops_of(m)[1][0].flatten(1e-4))
    opening = shapely.affinity.rotate(opening, pitch / 2, origin=(0, 0), use_radians=True)
    far = 2 * float(-pair.root(1))
    sector = shapely.Polygon([(0, 0), (far, -far * math.tan(pitch / 2)), (far, far * math.tan(pitch / 2))])
    beyond = shapely.Point(0, 0).buffer(-float(pair.tip(1)), quad_segs=4000)
    cut = shapely.intersection(swept, sector).difference(beyond)
    drawn = shapely.intersection(opening, sector).difference(beyond)
    apart = cut.symmetric_difference(drawn)
    assert shapely.area(apart) < 2e-3 * float(pair.module) ** 2
    assert apart.buffer(-2e-3).is_empty


@given(z1=st.integers(10, 60), more=st.integers(4, 60), x1=st.floats(-0.3, 0.6), total=st.floats(-0.5, 0.5))
def test_a_ring_is_a_gear_with_teeth_below_0(z1, more, x1, total):
    pair = InvolutePair(2.0, math.radians(20), (z1, -z1 - more), (x1, total - x1), backlash=0.05)
    assume(np.isfinite(pair.operating_angle))
    pitch = math.tau * pair.operating(0) / z1
    filled = sum(pair.thickness_at(gear, pair.operating(gear)) for gear in (0, 1))
    assert filled == pytest.approx(pitch - pair.backlash, rel=1e-9)
    assert -pair.operating(1) - pair.operating(0) == pytest.approx(-pair.distance, rel=1e-12)
    assert -pair.base(1) / np.cos(pair.operating_angle) == pytest.approx(-pair.operating(1), rel=1e-9)


def test_the_sizes_of_a_published_ring():
    """KHK, Gear Technical Reference, internal gears: m 3, 16 and 24 teeth, shifts 0 and 0.5 outwards."""
    pair = InvolutePair(3.0, math.radians(20), (16, -24), (0.0, -0.5))
    assert -pair.distance == pytest.approx(13.1683, abs=5e-5)
    assert math.degrees(pair.operating_angle) == pytest.approx(31.0937, abs=1e-4)
    assert [2 * pair.tip(0), -2 * pair.tip(1)] == pytest.approx([54.0, 69.0])
    assert [2 * pair.root(0), -2 * pair.root(1)] == pytest.approx([40.5, 82.5])


def deepest(pair, places):
    """Greatest overlap, mm², of a pinion with the body of its ring at (turn, way along the line of centres)."""
    z1, z2 = int(pair.teeth[0]), -int(pair.teeth[1])
    pinion = toothed(
        z1, float(pair.base(0)), float(half_angle(pair, 0)), float(pair.root(0)), float(pair.tip(0))
    )
    body = shapely.Point(0, 0).buffer(-1.2 * float(pair.root(1))).difference(spaces(pair))
    shapely.prepare(body)
    found = 0.0
    for turn, way in places:
        own = shapely.affinity.rotate(pinion, turn * z2 / z1, origin=(0, 0), use_radians=True)
        own = shapely.affinity.translate(own, -float(pair.distance) - way, 0)
        own = shapely.affinity.rotate(own, -turn, origin=(0, 0), use_radians=True)
        found = max(found, shapely.area(shapely.intersection(own, body)))
    return found


RINGS = {
    "z1": st.integers(18, 40),
    "more": st.integers(5, 12),
    "height": st.floats(0.5, 1.0),
    "ring_height": st.floats(0.5, 0.8),
}


def high(z1, more, height, ring_height):
    return InvolutePair(
        2.0, math.radians(20), (z1, -z1 - more), (0.0, 0.0), (height, ring_height), backlash=1e-3
    )


@given(**RINGS)
@settings(max_examples=12, deadline=None)
def test_tips_pass_as_the_closed_form_says(**given):
    pair = high(**given)
    assume(pair.foot_curvature(0) > 0)
    assume(abs(float(pair.tip_passing)) > 0.02)
    turns = np.linspace(0, math.tau / -pair.teeth[1], 40)
    assert (deepest(pair, [(turn, 0.0) for turn in turns]) > 1e-4) == (float(pair.tip_passing) < 0)


@given(**RINGS)
@settings(max_examples=12, deadline=None)
def test_pinions_go_in_as_the_closed_form_says(**given):
    pair = high(**given)
    assume(pair.foot_curvature(0) > 0)
    assume(float(pair.tip_passing) > 0.02)
    assume(abs(float(pair.goes_in)) > 2e-3)
    ways = np.linspace(0.0, 6.0, 80)
    assert (deepest(pair, [(0.0, way) for way in ways]) > 1e-4) == (float(pair.goes_in) < 0)


@pytest.mark.parametrize(
    ("code", "given"),
    [
        ("gear.ring-teeth", {"teeth": 30, "mate_teeth": 32}),
        ("gear.distance", {"teeth": 20, "mate_teeth": 60, "centre_distance": 30.0}),
        ("gear.shift", {"teeth": 20, "mate_teeth": 60, "centre_distance": 44.0}),
        ("gear.shift", {"teeth": 20, "mate_teeth": 24, "shift": 0.0, "mate_shift": 0.9}),
        ("gear.ring-tip", {"teeth": 14, "mate_teeth": 24, "ring_addendum": 1.3}),
        ("gear.interference", {"teeth": 20, "mate_teeth": 60, "ring_addendum": 1.0}),
        ("gear.fouling", {"teeth": 30, "mate_teeth": 36}),
        ("ring.rim", {"ring_outside": 132.0}),
        ("ring.holes", {"ring_holes": 40, "ring_hole": 12.0, "ring_outside": 180.0}),
        ("gear.undercut", {"teeth": 12, "shift": 0.0}),
        ("bore.rim", {"teeth": 14, "bore": 20.0}),
    ],
)
def test_what_is_wrong_with_a_ring_is_named_and_mended(code, given):
    given = {"mate_teeth": 60, **given}
    first = next(one for one in GEARS.check(ring(**given)) if one.severity is Severity.ERROR)
    assert first.code == code
    assert first.remedy
    for change in first.proposed:
        changed = {**given, **{key.removeprefix("parameters."): value for key, value in change.items()}}
        assert code not in codes(**{key: value for key, value in changed.items() if value is not None})


def test_keys_of_another_arrangement_are_refused_by_name():
    with pytest.raises(ValueError, match='ring_holes is for arrangement = "internal"; leave it out'):
        SpurGearParams(ring_holes=4)
    with pytest.raises(ValueError, match="shift_rule is for"):
        ring(shift_rule="equal-sliding")


@given(
    z1=st.integers(12, 50),
    more=st.integers(6, 60),
    module=st.floats(0.6, 4),
    x1=st.floats(-0.2, 0.6),
)
@settings(max_examples=8, deadline=None)
def test_rings_that_pass_the_rules_mesh(z1, more, module, x1):
    params = ring(teeth=z1, mate_teeth=z1 + more, module=module, shift=x1)
    found = {one.code for one in GEARS.judge(params) if one.severity is Severity.ERROR}
    assume(not found)
    proof = prove(table_of(params))
    assert not proof.collides
    assert proof.error < 5e-6


def test_the_teeth_of_a_ring_leave_the_backlash():
    m = table_of(ring(teeth=20, mate_teeth=60, backlash=0.2))
    pinion, mate = teeth_of(m)
    assert pinion.thickness + mate.thickness == pytest.approx(m.pair.module * math.pi - 0.2)
