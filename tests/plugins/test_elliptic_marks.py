"""Dots on elliptic gears: the driver's stands between those of its mate once a turn, at the far vertex."""

from dataclasses import replace

import numpy as np
import pytest
import shapely

from mechwright import Engraving, GeometryError
from mechwright.contracts.marking import engraved_dots
from mechwright_elliptic_gears.family import EllipticGears
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.gear import ellipse_of, outline_of
from mechwright_elliptic_gears.parts.gear_parts import meeting_teeth

DESIGNS = [
    {},
    {"teeth": 39},
    {"eccentricity": 0.2, "teeth": 31},
    {"eccentricity": 0.6, "teeth": 44},
    {"stages": 2, "phase": 45},
]


@pytest.mark.parametrize("values", DESIGNS)
def test_the_dots_meet_once_a_turn_where_the_far_vertex_drives(values):
    params = EllipticGearParams.model_validate(values)
    tooth, space = meeting_teeth(params)
    solid = shapely.Polygon(outline_of(params).outer.flatten(0.01))
    for dot in (tooth, *space):
        assert solid.contains(shapely.Point(dot).buffer(1.0)), "it stands in the gear, not in a space"
    motion = EllipticGears().solve(params, 721)
    mate = "gear-4" if params.stages == 1 else "gear-3"

    def world(body, dot):
        return motion.poses[body].transform(np.array([(*dot, 0.0)]))[:, 0, :2]

    one, first, second = world("gear-2", tooth), world(mate, space[0]), world(mate, space[1])
    between = np.linalg.norm(one - (first + second) / 2, axis=1)
    assert between[0] == pytest.approx(between.min(), rel=0.12), "nearest at theta2 = 0, to half a tooth"
    near = between < 1.5 * between.min()
    starts = np.flatnonzero(near & ~np.roll(near, 1))
    assert len(starts) == 1 or (len(starts) == 2 and near[0] and near[-1]), "once a turn"
    centres = motion.poses[mate].position[0, :2] - motion.poses["gear-2"].position[0, :2]
    across = np.array((-centres[1], centres[0])) / np.linalg.norm(centres)
    sides = [float((dot[0] - one[0]) @ across) for dot in (first, second)]
    assert sides[0] * sides[1] < 0, "the one dot points between the two"


def test_the_two_dots_are_of_neighbouring_teeth():
    params = EllipticGearParams()
    tooth, (one, two) = meeting_teeth(params)
    pitch = ellipse_of(params).perimeter / params.teeth
    assert 0.6 * pitch < np.hypot(*np.subtract(one, two)) < 1.1 * pitch
    assert tooth[0] > 0 > one[0]


def test_parts_of_the_pair_and_the_train_carry_their_marks():
    for values in ({}, {"stages": 2, "phase": 45}):
        parts = EllipticGears().parts(EllipticGearParams.model_validate(values))
        gears = [part for part in parts if part.name.startswith("gear")]
        assert gears
        dots = {part.name: [len(mark.dots) for mark in part.marks if mark.dots] for part in gears}
        wanted = (
            {"gear": [1, 2]} if not values else {"gear-2": [1], "gear-3": [2], "gear-4": [1], "gear-5": [2]}
        )
        assert dots == wanted


def test_dots_are_engraved_on_request_and_not_through_the_part():
    (gear,) = EllipticGears().parts(EllipticGearParams())
    (detail,) = engraved_dots(gear).details
    assert isinstance(detail, Engraving)
    assert len(detail.strokes) == 3
    middles = [np.mean(stroke[:-1], axis=0) for stroke in detail.strokes]
    wanted = [dot for mark in gear.marks for dot in mark.dots]
    assert np.allclose(middles, wanted, atol=1e-4)
    with pytest.raises(GeometryError, match="10 mm deep go through part gear, 10 mm thick"):
        engraved_dots(gear, 10.0)
    assert engraved_dots(replace(gear, marks=())) == replace(gear, marks=())
