"""Plates, pins and layers of the slider-crank, and the findings about them."""

import math

import numpy as np
import pytest
import shapely

from mechwright.contracts.design_table import with_columns
from mechwright.contracts.finding import Severity, errors
from mechwright.contracts.motion import Poses
from mechwright.errors import DesignError
from mechwright_cad.interference import interference
from mechwright_slider_crank.family import SliderCrankFamily
from mechwright_slider_crank.kinematics.course import course_of
from mechwright_slider_crank.kinematics.limits import limits
from mechwright_slider_crank.parameters import SliderCrankParams
from mechwright_slider_crank.parts.dimensions import clear_overhang, dimensions_of
from mechwright_slider_crank.parts.masses import bodies_of
from mechwright_slider_crank.parts.outlines import crank_outline
from mechwright_slider_crank.parts.parts import parts_of
from mechwright_slider_crank.parts.plates import body_poses, layout_of, standing_dimensions
from mechwright_slider_crank.table import SliderCrankTable

table_of, findings = SliderCrankTable.of, SliderCrankFamily().check
DESIGNS = (
    {"crank": 51.23710482942299, "rod": 113.28305527097052, "offset": 50},
    {"crank": 40, "rod": 150, "offset": -20, "assembly": "behind", "rod_width": 8, "slide_direction": 100},
    {"rod_bend": 12, "rod": 120},
)


@pytest.fixture(params=DESIGNS, ids=str)
def design(request):
    return SliderCrankParams(**request.param)


def codes(params, severity=Severity.ERROR):
    return [finding.code for finding in findings(params) if finding.severity is severity]


def test_nothing_collides_over_a_turn(design):
    """Plates only: the contract's designs are compared with pins and bushings."""
    family = SliderCrankFamily()
    report = interference(parts_of(table_of(design)), family.solve(design, 181), solids=False)
    assert report.collisions == ()
    assert report.pairs >= 10


@pytest.mark.parametrize("shape", ["arm", "disc"])
def test_a_crank_reaches_as_far_as_its_walls_about_shaft_and_pin(shape):
    params = SliderCrankParams(crank_shape=shape)
    sizes, outline = dimensions_of(params), crank_outline(table_of(params))
    far = params.crank + sizes.pin_boss
    behind = sizes.shaft / 2 + sizes.wall if shape == "arm" else far
    assert outline.bounds[::2] == pytest.approx((-behind, far))
    assert sizes.pin_boss == pytest.approx(sizes.pin / 2 + sizes.wall)


@pytest.mark.parametrize("ends", [(60.0, 160.0), (10.0, 70.0), (-30.0, 90.0)])
@pytest.mark.parametrize("crank", [20.0, 45.0])
def test_dowels_of_rails_stand_outside_of_what_crank_and_rod_sweep(crank, ends):
    sizes, clearance = dimensions_of(SliderCrankParams()), 1.5
    overhang = clear_overhang(sizes, crank, ends, clearance)
    half = (ends[1] - ends[0] + sizes.slider_length) / 2 + overhang
    # The nearer of both dowels from the crank's axis, half a rail's width from the end of the rail.
    dowel = half - sizes.rail / 2 - abs(ends[0] + ends[1]) / 2
    spare = dowel - (crank + max(sizes.pin_boss, sizes.rod_boss) + sizes.spacer + clearance)
    assert spare >= 0
    assert spare < 2 or overhang == sizes.rail


def test_a_bent_crank_pin_place_is_seen(design):
    """A slider that stands 3 mm beside its guide is found, so that a clear report means something."""
    motion = SliderCrankFamily().solve(design, 181)
    pose = motion.poses["slider"]
    side = 3 * pose.rotation[:, :, 1]
    poses = {**motion.poses, "slider": Poses(pose.position + side, pose.rotation)}
    moved = type(motion)(motion.input_name, motion.channels, poses, motion.scalars)
    report = interference(parts_of(table_of(design)), moved, solids=False)
    assert {"rail-1", "rail-2"} & {name for hit in report.collisions for name in (hit.first, hit.second)}


def test_joints_are_where_the_pins_are(design):
    """Each bore meets its pin or bushing, in every pose, with the same axis."""
    motion, layout, linkage = (
        SliderCrankFamily().solve(design, 37),
        layout_of(table_of(design)),
        design.linkage,
    )
    phi = motion.channels["phi"].values
    bodies = linkage.bodies(phi)

    def at(body, name, tag):
        (loop,) = (loop for loop in layout.outlines[name].inner if loop.segments[0].tag == tag)
        point = np.array([[*loop.segments[0].centre, 0.0]])
        return motion.poses[body].transform(point)[:, 0, :2]

    def plane(z):
        return np.column_stack((z.real, z.imag))

    crank_pin, wrist_pin = plane(bodies.rod.origin.position), plane(bodies.slider.origin.position)
    np.testing.assert_allclose(at("crank", "crank", "crank-pin"), crank_pin, atol=1e-9)
    np.testing.assert_allclose(at("rod", "rod", "crank-pin"), crank_pin, atol=1e-9)
    np.testing.assert_allclose(at("rod", "rod", "wrist-pin"), wrist_pin, atol=1e-9)
    np.testing.assert_allclose(at("slider", "slider", "wrist-pin"), wrist_pin, atol=1e-9)
    np.testing.assert_allclose(motion.poses["crank-pin"].position[:, :2], crank_pin, atol=1e-9)
    np.testing.assert_allclose(motion.poses["rod-end"].position[:, :2], wrist_pin, atol=1e-9)
    np.testing.assert_allclose(at("crank", "crank", "shaft"), 0, atol=1e-12)
    np.testing.assert_allclose(at("base", "base", "shaft"), 0, atol=1e-12)


def test_the_slider_stays_between_and_on_its_rails(design):
    motion, layout = SliderCrankFamily().solve(design, 73), layout_of(table_of(design))

    def placed(name, body, k):
        pose = motion.poses[body]
        angle = math.atan2(pose.rotation[k, 1, 0], pose.rotation[k, 0, 0])
        return layout.outlines[name].moved(*pose.position[k, :2], angle).polygon()

    for k in range(0, 73, 6):
        slider = placed("slider", "slider", k)
        for rail in ("rail-1", "rail-2"):
            gap = shapely.distance(slider, placed("rail", rail, k))
            assert gap == pytest.approx(design.play, abs=2e-3)
    ends, half = limits(design.linkage), dimensions_of(design).slider_length / 2
    rail_ends = [layout.rails[0].real + x for x in layout.outlines["rail"].bounds[0::2]]
    low, high = sorted((ends.near_position, ends.far_position))
    assert rail_ends[0] < low - half
    assert rail_ends[1] > high + half


def test_pins_reach_from_plate_to_plate(design):
    layout, parts = layout_of(table_of(design)), {part.name: part for part in parts_of(table_of(design))}
    for name, (low_plate, high_plate) in {
        "crank-pin": ("crank", "rod"),
        "wrist-pin": ("slider", "rod"),
    }.items():
        box = parts[name].build().BoundingBox()
        bottom = parts[name].instances[0].z
        heights = [layout.stack.bottom(plate) for plate in (low_plate, high_plate)]
        assert bottom == pytest.approx(min(heights))
        assert bottom + box.zmax >= max(heights) + design.thickness - 1e-9


def test_masses_are_those_of_the_solids(design):
    """Bodies weighed part by part with the CAD kernel, plates by their outlines' solids."""
    from mechwright.contracts.materials import material
    from mechwright_cad.solids.solid import part_solid

    found = bodies_of(table_of(design))
    weights = dict.fromkeys(("crank", "rod", "slider"), 0.0)
    owner = {"crank": "crank", "crank-pin": "crank", "rod": "rod", "rod-end": "rod", "slider": "slider"}
    for part in parts_of(table_of(design)):
        mass = part_solid(part).Volume() * material(part.material).density * 1e-6
        for instance in part.instances:
            if instance.body in owner:
                weights[owner[instance.body]] += mass
    for body, weight in weights.items():
        assert found[body].mass == pytest.approx(weight, rel=1e-6), body


@pytest.mark.parametrize(
    ("table", "code", "parameter"),
    [
        ({"crank": 50, "rod": 70.03, "offset": 20}, "slider-crank.crank-turn", "rod"),
        ({"crank": 50, "rod": 70, "offset": 20}, "slider-crank.crank-turn", "rod"),
        ({"crank": 6, "rod": 60, "pin": 8}, "slider-crank.crank-web", "crank"),
        ({"rod": 41, "offset": 0, "pin": 6, "bushing": 18}, "slider-crank.rod-web", "rod"),
        ({"coupler_bore": 6, "coupler_x": 3}, "slider-crank.coupler-web", "coupler_bore"),
        ({"slider_width": 4}, "slider-crank.slider-web", "slider_width"),
        ({"slider_length": 4}, "slider-crank.slider-web", "slider_length"),
        ({"rail": 2}, "slider-crank.rail-web", "rail"),
        ({"rod_bend": 60}, "slider-crank.rod-bend", "rod_bend"),
        ({"rod_width": 30}, "slider-crank.rod-shape", "rod_width"),
        ({"crank": 52, "rod": 113, "offset": 50, "rail_overhang": 20}, "slider-crank.layers", "crank_shape"),
    ],
)
def test_what_cannot_be_built_is_named(table, code, parameter):
    params = SliderCrankParams(**table)
    found = errors(findings(params))
    assert [finding.code for finding in found] == [code]
    assert found[0].parameter == parameter
    assert found[0].remedy
    with pytest.raises(DesignError, match=parameter):
        SliderCrankFamily().parts(params)


def test_a_crank_that_cannot_turn_is_told_the_nearest_lengths():
    lever = findings(SliderCrankParams(crank=50, rod=60, offset=20))
    finding = next(one for one in lever if one.code == "slider-crank.crank-turn")
    assert finding.severity is Severity.WARNING
    assert (finding.value, finding.limit) == (60, pytest.approx(70.035))
    assert "rod at least 70.035" in finding.remedy
    assert "crank at most 39.97" in finding.remedy
    assert codes(SliderCrankParams(crank=50, rod=finding.limit, offset=20, crank_shape="arm")) != [
        finding.code
    ]
    assert codes(SliderCrankParams(crank=39.97, rod=60, offset=20, crank_shape="arm")) != [finding.code]


def test_warnings():
    assert codes(
        SliderCrankParams(crank=30, rod=45, offset=12, pin=2, crank_shape="arm"), Severity.WARNING
    ) == ["slider-crank.transmission"]
    heavy = SliderCrankParams(load=20000)
    assert set(codes(heavy, Severity.WARNING)) == {
        "slider-crank.pin-pressure",
        "slider-crank.pin",
        "slider-crank.eye",
        "slider-crank.bushing",
    }


def test_the_torque_does_the_work_of_the_load():
    """Over a turn the drive's work is what a friction-free load takes: nothing, for a constant force."""
    motion = SliderCrankFamily().solve(SliderCrankParams(load=-100, speed=0.001), 3601)
    phi, torque = motion.channels["phi"].values, motion.channels["drive_torque"].values * 1000
    half = np.searchsorted(phi, motion.scalars["phi_far"].value)
    work = np.concatenate(([0], np.cumsum((torque[1:] + torque[:-1]) / 2 * np.diff(phi))))
    assert abs(work[-1]) < 1e-6 * np.abs(work).max()
    # From the near end to the far one the drive pushes 100 N over the stroke.
    near = np.searchsorted(phi, motion.scalars["phi_near"].value)
    assert abs(work[near] - work[half]) == pytest.approx(100 * motion.scalars["stroke"].value, rel=1e-4)


def test_turning_clockwise_runs_the_film_backwards():
    one, two = (SliderCrankFamily().solve(SliderCrankParams(clockwise=flag), 73) for flag in (False, True))
    np.testing.assert_allclose(two.channels["s"].values, one.channels["s"].values[::-1], atol=1e-9)
    np.testing.assert_allclose(two.channels["v"].values, -one.channels["v"].values[::-1], atol=1e-7)
    assert two.channels["phi"].values[-1] == pytest.approx(-math.tau)


@pytest.mark.parametrize(
    "table",
    [
        {"crank": 30, "rod": 50, "offset": 0},
        {"crank": 30, "rod": 41, "offset": 10},
        {"crank": 5, "rod": 15, "offset": 0},
        {"crank": 30, "rod": 60, "assembly": "behind", "slide_direction": 70},
        {"crank": 30, "rod": 50, "offset": 0, "pin": 6, "coupler_bore": 5, "coupler_y": 12},
    ],
)
def test_rails_are_longer_where_only_that_leaves_layers(table):
    """Their dowels stand outside of crank and rod over the whole turn; with usual rails there are no layers."""
    params = SliderCrankParams(**table)
    layout = layout_of(table_of(params))
    assert errors(findings(params)) == []
    assert layout.sizes == standing_dimensions(table_of(params))
    assert layout.sizes.overhang > layout.sizes.rail
    short = params.model_copy(update={"rail_overhang": layout.sizes.rail})
    assert [one.code for one in errors(findings(short))] == ["slider-crank.layers"]
    said = params.model_copy(update={"rail_overhang": layout.sizes.overhang})
    assert layout_of(table_of(said)).outlines["rail"].bounds == layout.outlines["rail"].bounds
    poses = body_poses(table_of(params), course_of(table_of(params)).way(181))
    assert poses["dowel-1"].position[0] == pytest.approx(
        body_poses(table_of(said), course_of(table_of(said)).way(181))["dowel-1"].position[0]
    )


def test_usual_rails_stay_as_they_are():
    layout = layout_of(table_of(SliderCrankParams()))
    assert layout.sizes.overhang == layout.sizes.rail
    assert layout.sizes == dimensions_of(SliderCrankParams())


@pytest.mark.parametrize(("crank", "pin"), [(3, 1.5), (2.5, 1.0), (3.5, 2.0), (2.9, 1.5), (40, 5)])
def test_short_cranks_have_fine_pins(crank, pin):
    params = SliderCrankParams(crank=crank, rod=4 * crank, offset=0)
    assert dimensions_of(params).pin == pin
    assert errors(findings(params)) == []
    both = SliderCrankTable(with_columns(params, {"crank": np.array([[crank], [40.0]])}), 2)
    assert both.dimensions.pin.ravel().tolist() == [pin, 5.0]


def test_a_shaft_that_is_said_leaves_room_for_the_pin():
    assert dimensions_of(SliderCrankParams(crank=4, rod=20, shaft=4.2)).pin == 1.5
