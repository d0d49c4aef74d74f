"""The mesh proof against known pairs, known defects and an independent measurement."""

import math

import numpy as np
import pytest
import shapely

from mechwright.mechanics.gearing import mesh
from mechwright.mechanics.gearing.mesh import EDGES_PER_PITCH
from mechwright_elliptic_gears.parameters import EllipticGearParams as Params
from mechwright_elliptic_gears.parts.gear import outline_of, pair_of, teeth_of
from mechwright_elliptic_gears.parts.mesh_proof import prove, prove_outlines

REFERENCE = Params(eccentricity=0.4, teeth=39, module=2.0, bore=0.0, backlash=0.0)


def closed(radius):
    """The reference outline as a round cutter leaves it."""
    target = outline_of(REFERENCE).polygon(1e-4)
    cut = target.buffer(radius, quad_segs=64).buffer(-radius, quad_segs=64)
    return shapely.get_coordinates(shapely.orient_polygons(cut).exterior)[:-1]


@pytest.mark.parametrize(
    "params",
    [
        REFERENCE,
        Params(backlash=0.0),
        Params(teeth=40, module=2.0, backlash=0.0),
        Params(teeth=41, tooth_offset=0.5, backlash=0.0),
        Params(teeth=40, tooth_offset=0.75, backlash=0.0),
        Params(eccentricity=0.6, teeth=25, backlash=0.0),
        Params(eccentricity=0.8, teeth=39, backlash=0.0),
        Params(eccentricity=0.0, teeth=18, backlash=0.0),
        Params(eccentricity=0.2, teeth=19, backlash=0.0),
    ],
    ids=lambda params: f"e{params.eccentricity}-z{params.teeth}",
)
def test_sound_pairs_run_without_overlap(params):
    proof = prove(params)
    assert not proof.collides
    assert proof.mesh.overlap == 0
    assert proof.error <= 25e-6
    assert proof.mesh.arc.size >= 4 * params.teeth
    assert proof.mesh.gap.max() < 2e-4
    assert np.abs(proof.mesh.free_play).max() < 4e-5


def test_transmission_error_falls_with_the_fit_of_the_polygon():
    pair, outer = pair_of(REFERENCE), outline_of(REFERENCE).outer
    errors = [
        mesh(points, points, pair, 39, allowance=1e-3).transmission_error
        for points in (outer.flatten(tolerance) for tolerance in (1e-2, 1e-3, 1e-4))
    ]
    assert errors[0] > 5 * errors[1] > 10 * errors[2]


@pytest.mark.parametrize("teeth", [39, 40])
def test_the_wrong_phase_collides(teeth):
    offset = 0.25 if teeth % 2 else 0.0
    proof = prove(Params(teeth=teeth, module=2.0, tooth_offset=offset, backlash=0.0))
    assert proof.collides
    assert proof.mesh.overlap == pytest.approx(25, abs=1.5)


def test_fillets_left_by_cutters():
    # A 2.0 mm end mill leaves 0.022 mm and the pair meshes; 2.5 mm leaves 0.55 mm and it collides.
    small = prove_outlines(REFERENCE, closed(1.0), 1e-3)
    assert not small.collides
    assert small.error < 25e-6
    large = prove_outlines(REFERENCE, closed(1.25), 1e-3)
    assert large.collides
    assert large.mesh.overlap == pytest.approx(0.34, abs=0.02)
    assert large.mesh.free_play.min() < 0


def test_backlash_is_the_play_of_the_pair():
    # Each of the four flanks gives a quarter: 0.05 mm here, 0.1 mm on each side of a tooth in its slot.
    proof = prove(REFERENCE.model_copy(update={"backlash": 0.2}))
    play = proof.mesh
    assert play.ahead.min() == pytest.approx(0.0017, abs=1e-4)
    assert play.ahead.max() == pytest.approx(0.0042, abs=1e-4)
    ahead, behind = pair_of(REFERENCE).levers(play.arc, math.radians(20))
    normal = 0.1 * math.cos(math.radians(20))
    np.testing.assert_allclose(play.ahead * ahead, normal, rtol=0, atol=3e-4)
    np.testing.assert_allclose(play.behind * behind, normal, rtol=0, atol=3e-4)
    np.testing.assert_allclose(play.gap, normal, rtol=0, atol=3e-4)
    assert proof.error < 25e-6 < play.transmission_error


def test_gap_and_depth_agree_with_an_independent_measurement():
    for params, widen in ((REFERENCE.model_copy(update={"backlash": 0.1}), 0.0), (REFERENCE, 0.02)):
        pair = pair_of(params)
        polygon = outline_of(params).polygon(1e-4).buffer(widen, quad_segs=16)
        points = shapely.get_coordinates(shapely.orient_polygons(polygon).exterior)[:-1]
        found = mesh(points, points, pair, 39, positions=8, allowance=1e-3)
        theta2, theta4 = found.angles
        for i in range(8):
            one = shapely.affinity.rotate(polygon, theta2[i], origin=(0, 0), use_radians=True)
            two = shapely.affinity.rotate(polygon, theta4[i], origin=(0, 0), use_radians=True)
            two = shapely.affinity.translate(two, pair.distance)
            if widen:
                # Both flanks grew by this much along their normals.
                assert found.depth[i] == pytest.approx(2 * widen, rel=0.03)
                assert found.gap[i] == 0
                assert one.intersection(two).area > 0
            else:
                assert found.gap[i] == pytest.approx(one.distance(two), abs=2e-4)
                assert found.depth[i] == 0
        assert (found.overlap > 0) == (widen > 0)


@pytest.mark.parametrize(
    "table",
    [
        {"eccentricity": 0.25},
        {"eccentricity": 0.24, "module": 1.25, "teeth": 54},
        {"eccentricity": 0.31, "module": 1.4, "teeth": 36, "backlash": 0.06},
        {"eccentricity": 0.18, "module": 1.0, "teeth": 56, "backlash": 0.1},
        {"teeth": 101, "module": 3.0},
    ],
    ids=str,
)
def test_a_tip_that_grazes_does_not_collide(table):
    proof = prove(Params(**{"backlash": 0.0} | table))
    assert proof.mesh.depth.max() < proof.allowance
    assert proof.mesh.overlap == 0
    assert proof.error < 25e-6


@pytest.mark.parametrize(
    ("table", "widen"),
    [
        ({"eccentricity": 0.25}, 0.0),
        ({"eccentricity": 0.25}, 0.004),
        ({"eccentricity": 0.56, "teeth": 53, "module": 1.17, "addendum": 1.23}, 0.0),
        ({"eccentricity": 0.08, "teeth": 39, "module": 2.7, "tooth_offset": 0.3}, 0.0),
        ({"eccentricity": 0.2, "teeth": 21, "backlash": 0.1}, 0.01),
    ],
    ids=str,
)
def test_depth_and_area_are_those_of_polygons(table, widen):
    params, count = Params(**{"backlash": 0.0} | table), 6
    pair, pitch = pair_of(params), teeth_of(params).rack.pitch
    polygon = shapely.Polygon(outline_of(params).outer.flatten(1e-4)).buffer(widen, quad_segs=16)
    points = shapely.get_coordinates(shapely.orient_polygons(polygon).exterior)[:-1]
    found = mesh(points, points, pair, params.teeth, positions=count, allowance=2e-4)
    theta2, theta4 = found.angles
    polygon, areas = shapely.Polygon(points).segmentize(pitch / EDGES_PER_PITCH), [0.0]
    for i in range(count):
        one = shapely.affinity.rotate(polygon, theta2[i], origin=(0, 0), use_radians=True)
        two = shapely.affinity.rotate(polygon, theta4[i], origin=(0, 0), use_radians=True)
        two = shapely.affinity.translate(two, pair.distance)
        deepest = 0.0
        for mine, its in ((one, two), (two, one)):
            corners = shapely.get_coordinates(mine)
            inside = shapely.points(corners[shapely.contains_xy(its, *corners.T)])
            near = its.exterior.intersection(shapely.box(*one.intersection(two).buffer(2 * pitch).bounds))
            deepest = max(deepest, float(np.max(shapely.distance(near, inside), initial=0.0)))
        if max(deepest, found.depth[i]) > 2e-4:
            assert found.depth[i] == pytest.approx(deepest, abs=1e-6)
            areas.append(one.intersection(two).area)
            assert areas[-1] > 0
    assert found.overlap == pytest.approx(max(areas), rel=1e-6)
