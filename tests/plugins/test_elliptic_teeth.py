"""Tooth curves against closed forms of the circle, against the rack itself, and against each other."""

import math

import numpy as np
import pytest
import scipy.special
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright.mechanics.gearing import FIT, SIDES, gear_loop
from mechwright_elliptic_gears.kinematics.ellipse import Ellipse
from mechwright_elliptic_gears.parameters import EllipticGearParams as Params
from mechwright_elliptic_gears.parts.gear import outline_of, teeth_of
from mechwright_elliptic_gears.parts.tooth_offset import OFFSET_SLACK, offset_miss, offsets_that_mesh


@given(st.floats(0, 0.9), st.floats(-30, 30))
def test_arc_length_is_the_elliptic_integral(e, u):
    ellipse = Ellipse(7.0, e)
    exact = scipy.special.ellipeinc(u + math.pi / 2, e * e) - scipy.special.ellipe(e * e)
    assert float(ellipse.arc(np.array(u))) == pytest.approx(7.0 * exact, abs=1e-12)
    assert ellipse.perimeter == pytest.approx(4 * 7.0 * scipy.special.ellipe(e * e), rel=1e-14)
    assert float(ellipse.parameter(ellipse.arc(np.array(u)))) == pytest.approx(u, abs=1e-12)


@given(st.floats(0, 0.9), st.floats(-7, 7))
def test_the_frame_is_that_of_the_curve(e, u):
    ellipse, h = Ellipse(7.0, e), 1e-4
    before, here, after = (ellipse.frame(np.array(u + step)) for step in (-h, 0, h))
    rate = 2 * h * ellipse.arc_rate(np.array(u))
    np.testing.assert_allclose((after.point - before.point) / rate, here.tangent, atol=1e-7)
    np.testing.assert_allclose((after.normal - before.normal) / rate * here.radius, here.tangent, atol=1e-5)
    assert here.tangent @ here.normal == pytest.approx(0, abs=1e-15)
    assert here.normal @ (here.point - [ellipse.focal_distance, 0]) > 0


@given(st.floats(0, 1), st.integers(8, 200))
def test_an_offset_misses_by_what_it_is_from_one_of_a_row_of_halves(offset, teeth):
    first, second = offsets_that_mesh(teeth)
    # Twice the offset is half of one less than the number of teeth, but for whole pitches.
    assert (2 * first - (teeth - 1) / 2) % 1 == (2 * second - (teeth - 1) / 2) % 1 == 0
    away = 2 * (offset - first)
    exact = abs(away - round(away)) / 2
    assert offset_miss(offset, teeth) == pytest.approx(exact if exact > OFFSET_SLACK else 0.0, abs=1e-12)


def test_a_circle_has_involute_teeth():
    teeth = teeth_of(Params(eccentricity=0.0, teeth=25, module=2.0, backlash=0.0))
    pitch_radius, alpha = 25.0, math.radians(20)
    base = pitch_radius * math.cos(alpha)

    def involute(angle):
        return math.tan(angle) - angle

    u = np.linspace(0, 1, 50)
    for side in (-1.0, 1.0):
        start = np.full(50, 3.0)
        reach = np.linspace(-2.0, 2.5, 50) / (math.sin(alpha) * math.cos(alpha))
        points = teeth.rack.flank(teeth.curve.frame_at(start + side * reach), start, np.full(50, side))
        radius, polar = np.hypot(*points.T), np.arctan2(points[:, 1], points[:, 0])
        at = np.arccos(base / radius)
        expected = 3.0 / pitch_radius + side * (np.tan(at) - at - involute(alpha))
        np.testing.assert_allclose(polar, expected, rtol=0, atol=1e-13)
    loop = outline_of(Params(eccentricity=0.0, teeth=25, module=2.0, backlash=0.0)).outer
    for segment in loop.segments:
        radius = np.hypot(*segment.at(u).T)
        if segment.tag == "tip":
            np.testing.assert_allclose(radius, 27.0, rtol=0, atol=2 * FIT)
        if segment.tag == "root":
            np.testing.assert_allclose(radius, 22.5, rtol=0, atol=2 * FIT)


def test_a_hardly_elliptic_gear_is_hardly_another():
    circle, near = (
        outline_of(Params(eccentricity=e, teeth=25, module=2.0, backlash=0.0)) for e in (0.0, 1e-7)
    )
    for one, other in zip(circle.outer.segments, near.outer.segments, strict=True):
        # The axis lies a e beside the centre.
        np.testing.assert_allclose(one.at([0, 0.5, 1]), other.at([0, 0.5, 1]), rtol=0, atol=4e-6)


CASES = [
    Params(eccentricity=0.4, teeth=39, module=2.0, backlash=0.0),
    Params(eccentricity=0.0, teeth=25, module=2.0, backlash=0.0),
    Params(eccentricity=0.6, teeth=26, module=3.0, backlash=0.15),
    Params(eccentricity=0.8, teeth=41, module=1.5, addendum=0.9, tip_radius=0.2),
    Params(eccentricity=0.3, teeth=24, module=2.0, pressure_angle=25.0, tip_radius=0.0),
]


@pytest.mark.parametrize("params", CASES, ids=str)
def test_flanks_fillets_roots_and_tips_meet(params):
    teeth = teeth_of(params)
    ellipse, rack = teeth.curve, teeth.rack
    join = ellipse.frame_at(teeth.join_arcs)
    gap = teeth.rack.flank(join, teeth.flank_arcs, SIDES) - teeth.rack.fillet(join, teeth.arc_centres)
    assert np.abs(gap).max() < 1e-12
    root = ellipse.frame_at(teeth.arc_centres)
    gap = teeth.rack.fillet(root, teeth.arc_centres) - root.offset(-rack.dedendum)
    assert np.abs(gap).max() < 1e-12
    v, w = teeth.tip_trim
    on_flank = teeth.rack.flank(ellipse.frame(v), teeth.flank_arcs, SIDES)
    assert np.abs(on_flank - ellipse.frame(w).offset(rack.addendum)).max() < 1e-11


@pytest.mark.parametrize("params", CASES, ids=str)
def test_the_outline_is_what_the_rack_leaves(params):
    """The rack tooth, swept through a space, never enters the outline, and touches all of it."""
    teeth = teeth_of(params)
    rack, ellipse = teeth.rack, teeth.curve
    space = teeth.count // 3
    middle = teeth.space_arcs[space]
    segments = gear_loop(teeth)[0].segments[6 * space + 1 : 6 * space + 6]
    assert [s.tag for s in segments] == ["flank", "fillet", "root", "fillet", "flank"]
    points = np.concatenate([segment.at(np.linspace(0, 1, 60)) for segment in segments])
    frame = ellipse.frame_at(middle + np.linspace(-6, 6, 6001) * rack.module)
    to = points[:, None] - frame.point
    along = np.abs(np.einsum("nki,ki->nk", to, frame.tangent) + frame.arc - middle)
    height = np.einsum("nki,ki->nk", to, frame.normal)
    # Signed distance from the rounded rack tooth, positive outside: straight sides, arcs, flat end.
    sin, cos = math.sin(rack.pressure_angle), math.cos(rack.pressure_angle)
    side = (along - rack.half_space) * cos - height * sin
    across, up = along - rack.half_land, height + rack.arc_depth
    corner = np.hypot(across, up) - rack.tip_radius
    foot = -rack.dedendum - height
    in_corner = (across > 0) & (up < 0) & (across * sin < -up * cos)
    distance = np.where(in_corner, corner, np.maximum(side, foot))
    nearest = distance.min(axis=1)
    assert nearest.min() > -2 * FIT
    # The grid of rolling positions is 0.002 modules wide; the distance has a flat minimum between.
    assert nearest.max() < 2 * FIT + 1e-5 * rack.module


@pytest.mark.parametrize("params", CASES, ids=str)
def test_regularity_is_the_speed_of_the_flank(params):
    teeth, h = teeth_of(params), 1e-5
    for share in (0.0, 0.5, 1.0):
        arc = teeth.flank_arcs + share * (teeth.join_arcs - teeth.flank_arcs)
        before, here, after = (teeth.curve.frame_at(arc + step) for step in (-h, 0, h))
        rate = (
            teeth.rack.flank(after, teeth.flank_arcs, SIDES)
            - teeth.rack.flank(before, teeth.flank_arcs, SIDES)
        ) / (2 * h)
        factor = teeth.rack.regularity(here, teeth.flank_arcs, SIDES)
        speed = np.hypot(rate[..., 0], rate[..., 1]) * math.sin(teeth.rack.pressure_angle)
        np.testing.assert_allclose(speed, np.abs(factor), rtol=0, atol=1e-8)


@settings(max_examples=20, deadline=None)
@given(
    st.floats(0, 0.7),
    st.integers(31, 60),
    st.sampled_from([0.0, 0.05, 0.2]),
    st.floats(0.5, 5),
)
def test_outlines_close_smoothly(e, teeth, backlash, module):
    loop, deviation = gear_loop(
        teeth_of(Params(eccentricity=e, teeth=teeth, module=module, backlash=backlash))
    )
    assert deviation <= FIT
    for one, two in zip(loop.segments, loop.segments[1:] + loop.segments[:1], strict=True):
        assert one.end == two.start
        if "tip" not in (one.tag, two.tag):
            out, into = one.derivative(1.0)[0], two.derivative(0.0)[0]
            turn = math.atan2(out[0] * into[1] - out[1] * into[0], out @ into)
            assert abs(turn) < 0.02


def test_backlash_thins_each_tooth_by_half_of_it():
    plain, slack = (teeth_of(Params(teeth=39, module=2.0, backlash=b)) for b in (0.0, 0.2))

    def thickness(teeth):
        # Tooth 1 stands between side +1 of space 0 and side -1 of space 1.
        return teeth.flank_arcs[1, 0] - teeth.flank_arcs[0, 1]

    assert thickness(plain) == pytest.approx(math.pi)
    assert thickness(plain) - thickness(slack) == pytest.approx(0.1)


def test_a_rack_of_full_radius_leaves_no_root():
    full = Params(teeth=39, module=2.0)
    rack = teeth_of(full).rack
    sin, cos = math.sin(rack.pressure_angle), math.cos(rack.pressure_angle)
    most = (rack.half_space - rack.dedendum * sin / cos) * cos / (1 - sin) / rack.module
    loop, _ = gear_loop(teeth_of(full.model_copy(update={"tip_radius": most})))
    assert {segment.tag for segment in loop.segments} == {"tip", "flank", "fillet"}
