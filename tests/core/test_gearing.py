"""Teeth and mesh on pitch curves of no family: circles in closed form, lobed pairs against kept numbers."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from pitch_curves import Lobed, lobed_pair

from mechwright.mechanics.gearing import FIT, SIDES, Rack, Teeth, gear_loop, mesh, prove_mesh, swing
from mechwright.mechanics.gearing.zone import Envelope, Rim, turned

ALPHA = math.radians(20)


def rack(module, backlash=0.0):
    return Rack(module, ALPHA, module, 1.25 * module, 0.38 * module, backlash)


def polygon(teeth, tolerance=1e-4):
    return gear_loop(teeth)[0].flatten(tolerance)


def sized(p, e, n1, n2, z1, module):
    """A pair with so many teeth of a module, and the teeth of both: a tooth of one finds a space of the other."""
    pair = lobed_pair(p, e, n1, n2)
    pair = lobed_pair(p * math.pi * module * z1 / pair.driver.perimeter, e, n1, n2)
    offset = 0.2
    # Arcs of the mate run the other way: s of the driver meets s0 - s, so that δ1 + δ2 = s0/p - 1/2.
    meets = float(pair.driven.arc(np.array(math.pi))) / (math.pi * module)
    return pair, (
        Teeth(pair.driver, rack(module), z1, offset),
        Teeth(pair.driven, rack(module), z1 * n2 // n1, (meets - 0.5 - offset) % 1),
    )


# Centre distance, ψ(0.5), extremes of 1/ρ of both gears, greatest tilt in degrees, least regularity of both, and the
# greatest turn per normal play, 1/mm: computed to 30 digits on another way, tooth by tooth where they are of teeth.
PAIRS = {
    "1:2": ((1, 0.3, 1, 2, 30, 2.0), {"a": 90.000147, "kappa": (0.03107, 0.03579, 0.00923, 0.02533), "tilt": 17.458, "least": (0.388, 0.567)}),
    "2:3": ((1, 0.12, 2, 3, 32, 2.0), {"a": 79.24312484452169, "kappa": (0.02043675964, 0.04342811425, 0.00757846071, 0.03482747357), "tilt": 13.590333784663, "least": (0.25882369, 0.4061795)}),
}  # fmt: skip


@pytest.fixture(scope="module", params=PAIRS)
def kept(request):
    size, expected = PAIRS[request.param]
    return *sized(*size), expected


@given(st.integers(12, 60), st.floats(0.3, 5), st.floats(0, 1), st.sampled_from(SIDES))
def test_a_circle_has_involute_teeth(count, module, offset, side):
    radius = module * count / 2
    teeth = Teeth(Lobed(radius), rack(module), count, offset)
    start = teeth.flank_arcs[count // 2, int(side > 0)]
    u = np.linspace(-1, 1, 50) * 0.6 * radius * math.sin(2 * ALPHA) / 2
    points = teeth.rack.flank(teeth.curve.frame_at(start + side * u), np.full(50, start), np.full(50, side))
    at = np.arccos(radius * math.cos(ALPHA) / np.hypot(*points.T))
    expected = start / radius + side * (np.tan(at) - at - math.tan(ALPHA) + ALPHA)
    polar = np.arctan2(points[:, 1], points[:, 0])
    assert np.abs(np.exp(1j * (polar - expected)) - 1).max() < 1e-12


def test_the_tip_of_a_circle_is_as_wide_as_an_involute_tooth():
    module, count = 2.0, 25
    teeth, radius = Teeth(Lobed(25.0), rack(module), count, 0.3), 25.0
    tip = math.acos(radius * math.cos(ALPHA) / (radius + module))
    half = math.pi / (2 * count) + math.tan(ALPHA) - ALPHA - math.tan(tip) + tip
    np.testing.assert_allclose(teeth.tip_widths, 2 * half * (radius + module), rtol=1e-11)
    for segment in gear_loop(teeth)[0].segments:
        if segment.tag in ("tip", "root"):
            wanted = radius + (module if segment.tag == "tip" else -1.25 * module)
            np.testing.assert_allclose(np.hypot(*segment.at(np.linspace(0, 1, 9)).T), wanted, atol=2 * FIT)


def test_spur_gears_of_different_sizes_mesh_over_all_their_teeth():
    pair, teeth = sized(1, 0.0, 2, 3, 20, 2.0)
    assert pair.distance == pytest.approx(50)
    proof = prove_mesh(pair, rack(2.0), 20, (polygon(teeth[0]), polygon(teeth[1])), 4e-4)
    assert pair.turns(20) == 3
    assert proof.mesh.arc.size == 3 * 20 * 4 + 1
    assert np.ptp(proof.mesh.angles[0]) == pytest.approx(3 * math.tau, rel=0.01)
    assert not proof.collides
    assert proof.mesh.overlap == 0
    assert proof.error < 25e-6


@settings(max_examples=25, deadline=None)
@given(st.sampled_from([(1, 1), (1, 2), (2, 3), (3, 1), (2, 2)]), st.floats(0, 0.1), st.floats(-4, 4))
def test_lobed_ellipses_roll_on_each_other(lobes, e, phi):
    n1, n2 = lobes
    pair, phi = lobed_pair(30.0, e, n1, n2), np.array(phi)
    assert pair.driven.perimeter / pair.driver.perimeter == pytest.approx(n2 / n1, rel=1e-12)
    theta2, ratio = pair.law(-phi)
    mate = math.pi - theta2
    one, two = pair.driver.frame(phi), pair.driven.frame(mate)
    assert one.polar_radius + two.polar_radius == pytest.approx(pair.distance, rel=1e-12)
    assert one.polar_radius == pytest.approx(-ratio * two.polar_radius, rel=1e-12)
    # As much arc has passed on one as on the other, and both tangents lie on one line.
    passed = pair.driven.arc(np.array(math.pi)) - two.arc
    assert one.arc == pytest.approx(passed, abs=1e-10)
    assert one.tilt == pytest.approx(two.tilt, abs=1e-12)
    assert float(pair.driver.parameter(one.arc)) == pytest.approx(float(phi), abs=1e-12)


def test_pitch_curves_and_teeth_are_those_kept(kept):
    pair, teeth, expected = kept
    # The kept ones have a tooth at arc 0 of the driver.
    teeth = [Teeth(one.curve, one.rack, one.count, offset) for one, offset in zip(teeth, (0.0, teeth[1].offset + 0.2), strict=True)]  # fmt: skip
    assert pair.distance == pytest.approx(expected["a"], rel=1e-7)
    t = np.linspace(0, math.tau, 20001)
    frames = pair.driver.frame(t), pair.driven.frame(t)
    found = [value for frame in frames for value in ((1 / frame.radius).min(), (1 / frame.radius).max())]
    assert found == pytest.approx(expected["kappa"], abs=6e-6)
    for frame, one, least in zip(frames, teeth, expected["least"], strict=True):
        assert math.degrees(np.abs(frame.tilt).max()) == pytest.approx(expected["tilt"], abs=6e-4)
        assert one.least_regularity.min() == pytest.approx(least, abs=6e-4)


def test_flanks_of_a_lobed_pair_are_those_kept():
    # The second gear's arcs run as the first one's there: s rises as the driver turns, so both signs turn here.
    pair, _ = sized(1, 0.12, 2, 3, 32, 2.0)
    assert float(pair.law(np.array(0.5))[0]) == pytest.approx(-0.3926047411475882, abs=1e-12)
    assert float(1 / pair.levers(np.linspace(0, 201, 20001), ALPHA)[0].min()) == pytest.approx(0.025830888935, abs=1e-9)  # fmt: skip
    kept = {
        (1, 1): (35.41122418384614, -4.876402715379698),
        (1, -1): (35.87883532738701, -1.4614542839457085),
        (2, 1): (-43.73050689391774, -7.989549343249958),
        (2, -1): (-43.89992350223497, -4.603750421592355),
    }
    for (gear, side), expected in kept.items():
        curve = pair.driver if gear == 1 else pair.driven
        crossing = gear * math.pi + side * math.pi / 2
        meets = float(pair.driven.arc(np.array(math.pi)))
        place, way = (lambda s: -s, -1) if gear == 1 else (lambda s, m=meets: m + s, 1)
        frame = curve.frame_at(np.array(place(crossing + side)))
        found = rack(2.0).flank(frame, np.array(place(crossing)), np.array(way * side))
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-9)


def test_lobed_pairs_mesh_and_the_wrong_phase_collides(kept):
    pair, (one, two), _ = kept
    module = one.rack.module
    outlines = polygon(one), polygon(two)
    proof = prove_mesh(pair, one.rack, one.count, outlines, 4e-4)
    assert not proof.collides
    assert proof.mesh.overlap == 0
    assert proof.mesh.gap.max() < 4e-4
    assert proof.error < 25e-6
    wrong = polygon(Teeth(pair.driven, two.rack, two.count, two.offset + 0.5))
    found = mesh(outlines[0], wrong, pair, one.count, positions=9, allowance=4e-4)
    assert found.depth.min() > 0.2 * module
    assert found.overlap > 1


def test_gap_of_a_lobed_pair_agrees_with_polygons(kept):
    pair, teeth, _ = kept
    slack = [Teeth(t.curve, rack(t.rack.module, 0.1), t.count, t.offset) for t in teeth]
    points = [polygon(t) for t in slack]
    found = mesh(*points, pair, slack[0].count, positions=7, allowance=1e-3)
    for theta1, theta2, gap in zip(*found.angles, found.gap, strict=True):
        one = shapely.affinity.rotate(shapely.Polygon(points[0]), theta1, origin=(0, 0), use_radians=True)
        two = shapely.affinity.rotate(shapely.Polygon(points[1]), theta2, origin=(0, 0), use_radians=True)
        assert gap == pytest.approx(one.distance(shapely.affinity.translate(two, pair.distance)), abs=2e-4)
    normal = 0.05 * math.cos(ALPHA)
    for play, lever in zip((found.ahead, found.behind), pair.levers(found.arc, ALPHA), strict=True):
        np.testing.assert_allclose(play * lever, normal, rtol=0, atol=3e-4)


@pytest.mark.parametrize(("e", "lobes"), [(0.0, 1), (0.6, 1), (0.2, 3)])
def test_no_corner_in_an_envelope_is_missed(e, lobes):
    curve, rng, count = Lobed(30.0, e, lobes), np.random.default_rng(5), 4000
    mate = Envelope.of(curve.frame(np.linspace(0, 6, 99)).offset(2.0), curve, 0.3)
    # A small round thing, somewhere about the rim of the envelope.
    around, turn = np.linspace(0, math.tau, 32, endpoint=False), rng.uniform(0, 6, count)
    points = 3 * np.column_stack((np.cos(around), np.sin(around)))
    t = rng.uniform(0, math.tau, count)
    axis = curve.frame(t).point * rng.uniform(1, 1.5, count)[:, None]
    near = Rim.of(points).near(mate, turn, axis, placed=True)
    placed = turned(points, turn[:, None]) + axis[:, None]
    inside = mate.height(placed) < 0
    assert 0.05 < inside.any(axis=1).mean() < 0.95
    np.testing.assert_array_equal(np.bincount(near.position, minlength=count), inside.sum(axis=1))


def test_gears_that_do_not_touch_have_no_play_to_measure():
    pair = lobed_pair(20.0, 0.0, 1, 1)
    circle = 10 * np.column_stack((np.cos(np.linspace(0, 6.2, 60)), np.sin(np.linspace(0, 6.2, 60))))
    found = mesh(circle, circle, pair, 20, allowance=1e-3)
    assert found.transmission_error == math.inf
    assert found.overlap == 0
    assert swing(np.array([1.0, 3.0])) == 2.0
