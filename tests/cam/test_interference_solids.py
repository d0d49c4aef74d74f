"""Solids that move past each other: closed forms, joints, spheres in shells, and what STEP files hold."""

import math
from functools import partial

import cadquery as cq
import manifold3d
import numpy as np
import pytest
from by_night import by_night
from hypothesis import given, settings
from hypothesis import strategies as st
from step_read import parts_from_step

from mechwright.contracts.motion import Channel, Motion, Poses
from mechwright.contracts.part import Instance, Part
from mechwright.geometry import Loop, Outline, circle
from mechwright.plugins.host import host
from mechwright_cad.exporters.step import part as step_of
from mechwright_cad.interference import interference, smooth_motion
from mechwright_cad.interference.meshes import meetings
from mechwright_cad.interference.nearest import Nearest, nearest_to_origin
from mechwright_cad.interference.path import Path, relative, rotations, space_path
from mechwright_cad.interference.prisms import prisms_of
from mechwright_cad.interference.surface import SKIN, SURE_IN_SPACE, Surface

N = 181
TURN = np.linspace(0, math.tau, N)
STILL = Poses.planar(0.0, 0.0, np.zeros(N))


def motion(**poses):
    return Motion("theta2", {"theta2": Channel(TURN, "rad")}, poses)


def solid(name, shape, z=0.0):
    return Part(
        name,
        None,
        0.0,
        "steel",
        (Instance(name, z),),
        build=lambda: (shape.val() if isinstance(shape, cq.Workplane) else shape).Solids()[0],
    )


def about(axis, angle):
    """Rotations (n, 3, 3) about an axis by angles (n,), by Rodrigues' formula."""
    x, y, z = np.asarray(axis, dtype=float) / np.linalg.norm(axis)
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    s, c = np.sin(angle)[:, None, None], np.cos(angle)[:, None, None]
    return np.eye(3) + s * k + (1 - c) * (k @ k)


def spun(axis, angle=TURN, place=(0.0, 0.0, 0.0)):
    return Poses(np.broadcast_to(np.asarray(place, dtype=float), (N, 3)).copy(), about(axis, angle))


def ball(radius):
    return cq.Workplane().sphere(radius).val()


@pytest.mark.parametrize("depth", [0.025, *(pytest.param(deep, marks=by_night) for deep in (0.1, 2.0))])
def test_two_balls_are_as_deep_in_each_other_as_their_radii_say(depth):
    away = 5 + 3 - depth + 30 * (1 - np.cos(TURN - 1.234))
    place = np.column_stack((away * 0.6, away * 0.8, 0 * away))
    report = interference(
        [solid("sun", ball(5)), solid("moon", ball(3))],
        motion(sun=spun((1, 2, 3)), moon=Poses(place, about((0, 1, 1), TURN))),
    )
    (hit,) = report.collisions
    assert hit.depth == pytest.approx(depth, abs=0.01)
    assert hit.instant.value == pytest.approx(1.234, abs=0.03)
    assert np.linalg.norm(hit.at) == pytest.approx(5, abs=depth + 0.05)
    assert np.dot(hit.at, (0.6, 0.8, 0)) > 4.5 - depth


@pytest.mark.parametrize("gap", [0.0, 0.02, 1.0])
def test_balls_that_touch_do_not_collide(gap):
    away = 8 + gap + 30 * (1 - np.cos(TURN - 1.234))
    place = np.column_stack((away * 0.6, away * 0.8, 0 * away))
    assert interference(
        [solid("sun", ball(5)), solid("moon", ball(3))],
        motion(sun=spun((1, 2, 3)), moon=Poses(place, about((0, 1, 1), TURN))),
    ).clear


def test_a_box_meets_a_box_where_their_faces_do():
    boxes = [
        solid("low", cq.Workplane().box(40, 30, 10).val()),
        solid("high", cq.Workplane().box(10, 10, 10).val()),
    ]
    for lowest, depth in ((10.0, 0.0), (9.95, 0.05), (9.0, 1.0)):
        height = lowest + 6 * (1 - np.cos(TURN))
        rise = Poses(np.column_stack((0 * TURN, 0 * TURN, height)), about((0, 0, 1), 0 * TURN))
        hits = interference(boxes, motion(low=STILL, high=rise)).collisions
        assert len(hits) == (depth > 0)
        if depth:
            assert hits[0].depth == pytest.approx(depth, abs=1e-6)


def test_a_corner_that_dips_in_for_a_degree_is_found():
    # A point on a circle of radius 20 that passes 0.04 mm behind a wall, within three degrees of a turn.
    cone = cq.Solid.makeCone(3, 0, 20, pnt=cq.Vector(0, 0, 0), dir=cq.Vector(1, 0, 0))
    for wall, clear in ((19.96, False), (20.01, True)):
        stop = cq.Workplane().box(10, 30, 30).val().moved(cq.Location(cq.Vector(wall + 5, 0, 0)))
        report = interference(
            [solid("hand", cone), solid("stop", stop)],
            motion(hand=spun((0, 0, 1), TURN + math.radians(0.9)), stop=STILL),
        )
        assert report.clear is clear
        if not clear:
            assert report.collisions[0].depth == pytest.approx(0.04, abs=0.004)


@by_night
def test_a_ball_in_its_shell_and_a_pin_in_its_bore_turn_without_clearance():
    shell = (
        cq.Workplane().sphere(9).cut(cq.Workplane().sphere(6)).intersect(cq.Workplane().box(24, 24, 6)).val()
    )
    core = cq.Workplane().sphere(6).intersect(cq.Workplane().box(24, 24, 9)).val()
    wobble = Poses(np.zeros((N, 3)), about((1, 0, 0), 0.3 * np.sin(TURN)) @ about((0, 0, 1), TURN))
    assert interference([solid("shell", shell), solid("core", core)], motion(shell=STILL, core=wobble)).clear
    lug = cq.Workplane("YZ").rect(30, 30).extrude(10).faces(">X").workplane().hole(8).val()
    pin = cq.Workplane("YZ").circle(4).extrude(40, both=True).val()
    assert interference([solid("lug", lug), solid("pin", pin)], motion(lug=STILL, pin=spun((1, 0, 0)))).clear
    thick = cq.Workplane("YZ").circle(4.03).extrude(40, both=True).val()
    (hit,) = interference(
        [solid("lug", lug), solid("pin", thick)], motion(lug=STILL, pin=spun((1, 0, 0)))
    ).collisions
    assert hit.depth == pytest.approx(0.03, abs=0.005)


def test_a_plate_and_a_solid_are_compared():
    plate = Part(
        "plate",
        Outline(
            Loop.polygon([(-30, -30), (30, -30), (30, 30), (-30, 30)]),
            (Loop((circle((10, 0), 5, clockwise=True),)),),
        ),
        6.0,
        "steel",
        (Instance("plate", -3.0),),
    )
    through = cq.Workplane().circle(5).extrude(30, both=True).val().moved(cq.Location(cq.Vector(10, 0, 0)))
    assert interference([plate, solid("rod", through)], motion(plate=STILL, rod=STILL)).clear
    slide = Poses.planar(0.5 * np.sin(TURN), 0.0, 0 * TURN)
    (hit,) = interference([plate, solid("rod", through)], motion(plate=STILL, rod=slide)).collisions
    assert hit.depth == pytest.approx(0.5, abs=0.01)
    report = interference([plate, solid("rod", through)], motion(plate=STILL, rod=slide), solids=False)
    assert (report.pairs, report.skipped, report.clear) == (0, ("rod",), True)
    (note,) = report.findings()
    assert note.code == "interference.solids"


def test_tilted_plates_are_compared_in_space():
    square = Outline(Loop.polygon([(-10, -10), (10, -10), (10, 10), (-10, 10)]))
    plates = [Part(name, square, 2.0, "pom", (Instance(name),)) for name in ("base", "flap")]
    # Hinged 0.1 mm over the far edge of the base, the flap swings by 80 degrees and never meets it.
    swing = about((0, 1, 0), -np.radians(40) * (1 - np.cos(TURN)))
    hinge = np.array((-10.0, 0.0, 2.1))
    flap = Poses(hinge - swing @ (-10.0, 0.0, 0.0), swing)
    assert interference(plates, motion(base=STILL, flap=flap)).clear
    down = about((0, 1, 0), np.radians(2) * (1 - np.cos(TURN)))
    report = interference(plates, motion(base=STILL, flap=Poses(hinge - down @ (-10.0, 0.0, 0.0), down)))
    # The flap's underside goes down to 1.2 mm below the base's top: through its middle, 1 mm from both faces.
    assert report.collisions[0].depth == pytest.approx(1.0, rel=0.06)


def test_solids_of_one_body_must_not_overlap():
    one, two = (
        cq.Workplane().box(10, 10, 10).val(),
        cq.Workplane().box(10, 10, 10).val().moved(cq.Location(cq.Vector(9.9, 0, 0))),
    )
    parts = [
        Part(name, None, 0.0, "steel", (Instance("link"),), build=lambda s=s: s.Solids()[0])
        for name, s in (("one", one), ("two", two))
    ]
    (hit,) = interference(parts, motion(link=spun((1, 1, 0)))).collisions
    assert hit.depth == pytest.approx(0.1, abs=1e-6)


def test_distances_of_points_from_triangles():
    triangle = np.array([[[0.0, 0, 0], [4, 0, 0], [0, 3, 0]]])
    points = np.array([[1.0, 1, 2], [-3, 0, 0], [4, 3, 0], [2, -2, 0], [0, 0, 0]])
    expected = [2, 3, 12 / 5, 2, 0]
    np.testing.assert_allclose(Nearest.of(triangle).distance(points), expected, atol=1e-12)
    line = np.array([[[1.0, 0, 0], [1, 1, 0], [1, 2, 0]]])  # as thin as a line
    assert nearest_to_origin(line)[0] == pytest.approx(1)


def surface(made):
    mesh = made.to_mesh64()
    return Surface(np.array(mesh.vert_properties)[:, :3], np.array(mesh.tri_verts, dtype=np.int64))


def test_a_core_is_the_solid_without_its_skin():
    block = surface(
        manifold3d.Manifold.cube((20, 10, 5)) - manifold3d.Manifold.cube((6, 6, 20)).translate((4, 2, -5))
    )
    gone = block.manifold.volume() - block.core.manifold.volume()
    assert gone == pytest.approx(SKIN * block.manifold.surface_area(), rel=0.01)
    low, high = block.core.points.min(axis=0), block.core.points.max(axis=0)
    np.testing.assert_allclose([*low, *high], [SKIN] * 3 + [20 - SKIN, 10 - SKIN, 5 - SKIN], atol=1e-9)


coordinate = st.floats(-1, 1)


@st.composite
def lumps(draw):
    """A box, or a box without a corner."""
    size = draw(st.tuples(*[st.floats(3, 14)] * 3))
    made = manifold3d.Manifold.cube(size, True)
    if draw(st.booleans()):
        made -= manifold3d.Manifold.cube(tuple(1.2 * side for side in size))
    return surface(made)


@st.composite
def flights(draw):
    axis = np.array(draw(st.tuples(coordinate, coordinate, st.floats(0.2, 1))))
    middle = np.array(draw(st.tuples(*[st.floats(-14, 14)] * 3)))
    swing = np.array(draw(st.tuples(*[st.floats(-8, 8)] * 3)))
    turns = draw(st.sampled_from([0, 1, 2]))

    def at(t):
        place = middle + np.sin(t)[:, None] * swing + np.cos(2 * t)[:, None] * swing[::-1] / 2
        return Poses(place, about(axis, turns * t + 0.7 * np.sin(t)))

    return at


def test_a_motion_that_a_cubic_follows_is_asked_for_once():
    asked = []

    def solve(samples):
        asked.append(samples)
        angle = np.linspace(0, math.tau, samples)
        return Motion("x", {"x": Channel(angle, "rad")}, {"a": Poses.planar(0.0, 0.0, angle)})

    assert smooth_motion(solve, [solid("a", ball(5))]).samples == asked[0]
    assert len(asked) == 1


@pytest.mark.parametrize("length", [1.0, 3.0])
def test_quaternions_of_any_length_and_angles_in_the_plane_are_rotations(length):
    axis, angle = np.array([2.0, -3.0, 6.0]) / 7, np.linspace(-3, 3, 13)
    quaternions = np.column_stack((np.cos(angle / 2), np.sin(angle / 2)[:, None] * axis))
    np.testing.assert_allclose(rotations(length * quaternions), about(axis, angle), atol=1e-12)
    np.testing.assert_allclose(rotations(angle[:, None]), about((0, 0, 1), angle)[:, :2, :2], atol=1e-12)


def test_where_bodies_always_overlap_every_look_finds_them():
    """A small block within a large one: 25 looks from the first sample to the last, or one where both rest."""
    large, small = (surface(manifold3d.Manifold.cube((size,) * 3, center=True)) for size in (20.0, 2.0))
    turning, resting = (
        meetings(large, small, space_path(*relative(STILL, other)))
        for other in (spun((1, 2, 3), place=(1.0, 2.0, 3.0)), STILL)
    )
    np.testing.assert_allclose(turning, np.linspace(0, N - 1, 25))
    np.testing.assert_array_equal(resting, [0.0])


@settings(max_examples=25)
@given(lumps(), lumps(), flights(), flights())
def test_random_solids_agree_with_booleans(one, two, first, second):
    hits = meetings(one, two, space_path(*relative(first(TURN), second(TURN))))
    rotation, position = relative(first(TURN), second(TURN))
    common = [
        (one.manifold ^ two.manifold.transform(np.column_stack((r, p))))
        for r, p in zip(rotation, position, strict=True)
    ]
    if hits.size:
        times = np.interp(hits[:3], np.arange(N), TURN)
        rotation, position = relative(first(times), second(times))
        for r, p in zip(rotation, position, strict=True):
            assert not (one.manifold ^ two.manifold.transform(np.column_stack((r, p)))).is_empty()
        return
    for overlap in common:
        if not overlap.is_empty():
            # Of a thicker overlap volume and surface would say so.
            assert 2 * overlap.volume() / overlap.surface_area() < SURE_IN_SPACE


def test_a_path_in_space_is_followed_between_samples():
    def at(t):
        return Poses(
            np.column_stack((np.cos(t), np.sin(2 * t), t)),
            about((1, 2, 2), 3 * t) @ about((0, 0, 1), np.sin(t)),
        )

    path = space_path(at(TURN).rotation, at(TURN).position)
    between = np.linspace(2, N - 3, 1000)
    rotation, position = path.at(between)
    exact = at(np.interp(between, np.arange(N), TURN))
    worst = max(np.abs(rotation - exact.rotation).max(), np.abs(position - exact.position).max())
    assert worst < 2e-5
    assert path.error(1.0) == pytest.approx(worst, rel=2)
    assert isinstance(path, Path)


@by_night
def test_the_elliptic_pair_read_back_from_step_is_clear(tmp_path):
    family = host().family("elliptic-gears")
    params = family.Params.model_validate({"teeth": 21, "backlash": 0.05})
    parts = family.parts(params)
    motion_ = smooth_motion(partial(family.solve, params), parts)
    file = tmp_path / "gear.step"
    file.write_bytes(step_of(parts[0]))
    (gear,) = parts_from_step(parts, {"gear": file})
    assert gear.outline is not parts[0].outline
    report = interference([gear], motion_)
    assert report.clear
    assert report.closest.distance == pytest.approx(0.025 * math.cos(math.radians(20)), abs=0.002)
    out_of_phase = dict(motion_.poses)
    wrong = out_of_phase["gear-4"]
    out_of_phase["gear-4"] = Poses(
        wrong.position, wrong.rotation @ about((0, 0, 1), np.array([math.radians(2.0)]))
    )
    (hit,) = interference([gear], Motion(motion_.input_name, motion_.channels, out_of_phase)).collisions
    assert hit.depth > 0.5


def test_a_stepped_shaft_and_a_key_are_prisms_and_a_cone_is_none():
    shaft = (
        cq.Workplane()
        .circle(6)
        .extrude(10)
        .faces(">Z")
        .workplane()
        .circle(4)
        .extrude(5)
        .cut(cq.Workplane().box(3, 20, 4).translate((5, 0, 2)))
    )
    layers = prisms_of(solid("shaft", shaft), 2.0)
    assert [(round(s.bottom, 9), round(s.top, 9)) for s in layers] == [(2, 6), (6, 12), (12, 17)]
    assert layers[0].disc is None
    assert sum(s.polygon.area * (s.top - s.bottom) for s in layers) == pytest.approx(
        shaft.val().Volume(), rel=1e-4
    )
    assert layers[2].disc.radius == pytest.approx(4, abs=1e-6)
    tube = cq.Workplane().circle(6).circle(4).extrude(10)
    (layer,) = prisms_of(solid("tube", tube), 0.0)
    assert len(layer.rings) == 2
    cone = cq.Workplane().add(cq.Solid.makeCone(3, 0, 20))
    assert prisms_of(solid("cone", cone), 0.0) is None
    lying = cq.Workplane("YZ").circle(4).extrude(10)
    assert prisms_of(solid("lying", lying), 0.0) is None
