"""Parts of a train: which there are, what fixes the phase, where they stand, and that they fit."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from mechwright.mechanics.linkage import Boss
from mechwright_elliptic_gears.family import EllipticGears
from mechwright_elliptic_gears.kinematics.equations import phase_offset
from mechwright_elliptic_gears.parts.gear_parts import gears_of
from mechwright_elliptic_gears.parts.layout import DOWELS, layout_of
from mechwright_elliptic_gears.parts.plates import corners_of, rounded_hull

FAMILY = EllipticGears()
KEYED = EllipticGears.Params(stages=2, bore=12, keyway_width=4, keyway_relief=2)
DOWELLED = EllipticGears.Params(stages=2, bore=12, phase=85.93, eccentricity=0.3358, teeth=19)
PLATES = {"coupler", "base"}


def parts_of(params):
    return {part.name: part for part in FAMILY.parts(params)}


@pytest.mark.parametrize(
    ("params", "gears", "turned"),
    [
        (KEYED, {"gear", "gear-4", "gear-5"}, {"key"}),
        (DOWELLED, {"gear-2", "gear-3", "gear-4", "gear-5"}, {"dowel"}),
    ],
)
def test_plates_are_milled_and_round_parts_are_not(params, gears, turned):
    parts = parts_of(params)
    assert {name for name, part in parts.items() if part.outline is not None} == gears | PLATES
    round_ = {"shaft-2", "shaft-4", "shaft-5", "hub-spacer", "hub-spacer-5", "joint-spacer", "joint-pin"}
    assert {name for name, part in parts.items() if part.build is not None} == round_ | turned
    bodies = [instance.body for name in gears for instance in parts[name].instances]
    assert sorted(bodies) == ["gear-2", "gear-3", "gear-4", "gear-5"]
    assert all(part.colour != (0.7, 0.7, 0.72) or name in gears for name, part in parts.items())


@pytest.mark.parametrize("phase", [0.0, 33.0, 90.0, 180.0, 300.0])
@pytest.mark.parametrize("keyed", [True, False])
def test_what_joins_gears_3_and_4_is_in_line_at_all_times(phase, keyed):
    base = KEYED if keyed else DOWELLED
    params = base.model_copy(update={"phase": phase})
    gears = {body: gear for gear in gears_of(params) for body, _ in gear.bodies}
    motion = FAMILY.solve(params, 13)

    def marks(body):
        gear = gears[body]
        if keyed:
            local = np.array([[math.cos(gear.key), math.sin(gear.key), 0.0]])
        else:
            local = np.array([(*hole.centre, 0.0) for hole in gear.holes if hole.name in DOWELS])
        return motion.poses[body].transform(local)

    np.testing.assert_allclose(marks("gear-3"), marks("gear-4"), atol=1e-9)
    if not keyed:
        dowels = np.stack([motion.poses[name].position for name in DOWELS], axis=1)
        np.testing.assert_allclose(marks("gear-3"), dowels, atol=1e-9)


def test_dowels_go_in_one_way_only():
    angles = np.array(list(DOWELS.values()))
    points = np.exp(1j * angles)

    def fits(pattern):
        return all(np.abs(points - p).min() < 1e-9 for p in pattern)

    # Turned by any step between two dowels, and turned over about any axis that brings one onto another.
    turns = {round((b - a) % math.tau, 9) for a in angles for b in angles} - {0.0}
    assert not any(fits(points * np.exp(1j * turn)) for turn in turns)
    assert not any(fits(np.conj(points) * np.exp(1j * (a + b))) for a in angles for b in angles)


def test_the_keyway_of_gear_4_stands_back_by_the_phase_offset():
    gear4 = next(gear for gear in gears_of(KEYED) if gear.name == "gear-4")
    assert (gear4.key + phase_offset(math.pi / 2, 0.4)) % math.tau == pytest.approx(0, abs=1e-12)
    opening = parts_of(KEYED)["gear-4"].outline.inner[0]
    corners = opening.flatten()
    farthest = corners[np.hypot(*corners.T) > 6 + 1.7]
    towards = math.atan2(*farthest.mean(axis=0)[::-1])
    assert towards % math.tau == pytest.approx(gear4.key, abs=0.02)


def test_the_coupler_has_its_holes_at_the_foci_and_at_q():
    params = KEYED.model_copy(update={"point_along": 0.3, "point_across": 8.0, "tracer_diameter": 3.0})
    coupler = parts_of(params)["coupler"]
    holes = {feature.name: (feature.centre, feature.diameter) for feature in coupler.features[:-1]}
    assert holes == {"joint-j": ((0, 0), 6), "joint-k": ((100, 0), 6), "tracer": ((30, 8), 3)}
    polygon = coupler.outline.polygon()
    assert polygon.is_valid
    assert shapely.Polygon(polygon.exterior).contains(shapely.Point(30, 8).buffer(5.9))
    assert polygon.area == pytest.approx(coupler.outline.area, rel=1e-4)
    none = parts_of(KEYED.model_copy(update={"tracer_diameter": 0.0}))["coupler"]
    assert [feature.name for feature in none.features] == ["joint-j", "joint-k", "outside"]
    # Straight where Q is on the line: two half circles and two sides.
    assert len(none.outline.outer.segments) == 4


def test_gears_4_and_5_carry_the_joints():
    for name in ("gear-4", "gear-5"):
        (joint,) = (feature for feature in parts_of(KEYED)[name].features if feature.name == "joint")
        assert (joint.centre, joint.diameter) == ((40.0, 0.0), 6.0)


@pytest.mark.parametrize("params", [KEYED, DOWELLED])
def test_levels_do_not_share_heights(params):
    layout = layout_of(params)
    parts = parts_of(params)
    levels = {}
    for part in parts.values():
        for instance in part.instances:
            if part.outline is not None:
                levels[instance.body] = (instance.z, instance.z + part.thickness)
    assert levels["base"][1] == 0
    assert levels["gear-2"] == levels["gear-3"] == (2, 12)
    assert levels["gear-4"] == levels["gear-5"] == (14, 24)
    assert levels["coupler"] == (26, 32)
    # Round parts end where the next plate sweeps: only the pins stand above the gears, only shaft 2 below the base.
    for name, part in parts.items():
        if part.build is None:
            continue
        box = part.build().BoundingBox()
        for instance in part.instances:
            top, bottom = instance.z + box.zmax, instance.z + box.zmin
            limit = {"joint-pin": 40.0, "joint-spacer": layout.link}.get(
                name, layout.upper + layout.thickness
            )
            assert top <= limit + 1e-6, name
            assert bottom >= -layout.base - (2 * layout.bore if name == "shaft-2" else 0) - 1e-6, name
    shaft2 = parts["shaft-2"].build().BoundingBox()
    assert parts["shaft-2"].instances[0].z + shaft2.zmax == pytest.approx(12)


def test_round_parts_are_sound_solids_of_the_right_size():
    for params in (KEYED, DOWELLED):
        for part in FAMILY.parts(params):
            if part.build is not None:
                solid = part.build()
                assert solid.isValid(), part.name
    parts = parts_of(KEYED)
    ring = parts["hub-spacer"].build()
    assert ring.Volume() == pytest.approx(math.pi * (9**2 - 6**2) * 2, rel=1e-9)
    plain, keyed = parts_of(DOWELLED)["shaft-4"].build().Volume(), parts["shaft-4"].build().Volume()
    # The seat: 2.5 mm below the crest, 4 mm wide, over both gears and the spacer between them.
    assert plain - keyed == pytest.approx(4 * 2.5 * 22, rel=0.06)
    assert parts["key"].build().Volume() == pytest.approx((16 - 2 * 0.16**2) * 10, rel=1e-9)


def test_a_key_of_no_standard_width_has_a_seat_as_deep_as_its_keyway():
    params = KEYED.model_copy(update={"keyway_width": 3.5, "keyway_depth": 2.0})
    box = parts_of(params)["key"].build().BoundingBox()
    assert (box.xmin, box.xmax) == pytest.approx((6 - 2.0, 6 + 2.0 - 0.2))


@given(st.floats(0, 1), st.floats(-1, 1), st.floats(0.5, 20), st.sampled_from([1.0, 0.0, 1e-8]))
def test_the_rounded_hull_is_that_of_the_discs(along, across, radius, flat):
    places = [(0.0, 0.0), (100.0, 0.0), (100 * along, 50 * across * flat)]
    loop = rounded_hull(corners_of([Boss(complex(*place), radius, 1.0, "eye") for place in places]), radius)
    hull = shapely.MultiPoint(places).convex_hull
    # Steiner: the area of a parallel body.
    edge = hull.length if hull.geom_type == "Polygon" else 2 * hull.length
    assert loop.area == pytest.approx(hull.area + edge * radius + math.pi * radius**2, rel=1e-6, abs=1e-6)
