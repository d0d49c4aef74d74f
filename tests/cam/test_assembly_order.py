"""The order of assembly: small cases whose order is known, and every family's, done again with meshes."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import shapely
from by_night import by_night
from cam.replay import met

from mechwright import Instance, Part
from mechwright.contracts.joint import GROUND, Joint
from mechwright.contracts.motion import Channel, Motion, Poses
from mechwright.contracts.shape import Shape, box
from mechwright.contracts.turned import EndThread, Turned, tube
from mechwright.contracts.turned import Step as Length
from mechwright.geometry import Loop, Outline, circle
from mechwright.pipeline import Build, Wanted
from mechwright.plugins.host import host
from mechwright.standards.bearings import bearings
from mechwright.standards.circlips import shaft_circlip
from mechwright.standards.screws import screw
from mechwright_cad.assembly_order.groups import connected
from mechwright_cad.assembly_order.heights import CELL, Heights
from mechwright_cad.assembly_order.layers import frame_of, own_layers
from mechwright_cad.assembly_order.order import Order
from mechwright_cad.assembly_order.plan import alike, plan_of, sequence
from mechwright_cad.bodies import bodies_of

EXAMPLES = Path(__file__).parents[2] / "examples"


def square(half, *holes):
    rim = Loop.polygon([(-half, -half), (half, -half), (half, half), (-half, half)])
    return Outline(rim, tuple(Loop((circle(at, d / 2, clockwise=True),)) for at, d in holes))


def plate(name, body, z, *holes, half=20.0, thick=5.0):
    return Part(name, square(half, *holes), thick, "aluminium", (Instance(body, z),))


def turned(name, body, z, form):
    return Part(name, None, 0.0, "steel", (Instance(body, z),), turned=form)


def ordered(parts, **fixed_to):
    """Steps as names, of bodies that all stand at the origin; ``fixed_to`` has joints by body."""
    names = sorted({instance.body for part in parts for instance in part.instances})
    still = Poses.planar(0.0, 0.0, np.zeros(2))
    joints = {name: Joint("fixed", GROUND if on == "ground" else on, name) for name, on in fixed_to.items()}
    motion = Motion(
        "theta", {"theta": Channel(np.zeros(2), "rad")}, dict.fromkeys(names, still), joints=joints
    )
    bodies = bodies_of(parts, motion)
    order = Order(bodies, motion, 0)
    return [
        ([bodies[k].part.name for k in step.moved], [bodies[k].part.name for k in step.onto], step.way)
        for step in order.steps
    ]


DOWN, UP = (0.0, 0.0, -1.0), (0.0, 0.0, 1.0)


def test_what_lies_on_another_is_put_on_after_it():
    parts = (plate("top", "c", 10.0), plate("base", "a", 0.0, half=25.0), plate("middle", "b", 5.0))
    assert ordered(parts, a="ground") == [
        (["middle"], ["base"], DOWN),
        (["top"], ["base", "middle"], DOWN),
    ]


def test_a_headed_pin_goes_in_after_what_it_holds_and_is_no_part_of_the_link_before():
    pin = Turned((Length(6.0, 15.0), Length(12.0, 3.0)))
    parts = (
        plate("base", "base", 0.0, ((0, 0), 6.0), half=30.0),
        turned("pin", "base", 0.0, pin),
        plate("link", "link", 8.0, ((0, 0), 6.0)),
    )
    assert ordered(parts, base="ground") == [
        (["link"], ["base"], DOWN),
        (["pin"], ["base", "link"], DOWN),
    ]


def test_a_shaft_with_a_wheel_and_a_ring_is_put_together_first():
    shaft = Turned((Length(8.0, 10.0), Length(14.0, 2.0), Length(8.0, 20.0)))
    parts = (
        plate("base", "base", -10.0, ((0, 0), 8.0), half=40.0, thick=10.0),
        turned("shaft", "wheel", -10.0, shaft),
        plate("wheel", "wheel", 2.0, ((0, 0), 8.0)),
        turned("ring", "ring", 7.0, tube(8.0, 14.0, 3.0)),
    )
    assert ordered(parts, base="ground") == [
        (["shaft"], ["wheel"], UP),
        (["shaft", "wheel"], ["base"], DOWN),
        (["ring"], ["base", "shaft", "wheel"], DOWN),
    ]


def test_a_circlip_is_spread_over_its_shaft_and_goes_on_last():
    clip = shaft_circlip(10)
    shaft = Turned(
        (Length(16.0, 3.0), Length(10.0, 12.0), Length(clip.groove, clip.thickness), Length(10.0, 4.0))
    )
    ring = Part("clip", None, 0.0, "steel", (Instance("a", 15.0),), bought=clip.bought)
    parts = (turned("shaft", "a", 0.0, shaft), plate("wheel", "b", 3.0, ((0, 0), 10.0), thick=12.0), ring)
    assert ordered(parts)[-1][0] == ["clip"]
    stiff = replace(clip.bought, standard="", designation="a ring that does not give")
    assert ordered((*parts[:2], replace(ring, bought=stiff)))[-1][2] is None, "no way leads over the shaft"


def test_a_screw_follows_what_it_holds_even_from_below():
    bolt = screw(6, 20)
    parts = (
        plate("base", "base", 0.0, ((0, 0), 6.6), half=40.0, thick=8.0),
        turned("post", "base", 8.0, Turned((Length(14.0, 30.0),), bore=6.0)),
        plate("lid", "lid", 38.0, half=40.0),
    )
    turned_over = replace(
        bolt.bought, shape=Shape((*Turned((Length(10.0, 6.0), Length(6.0, 18.0))).shape.pieces,))
    )
    held = Part("screw", None, 0.0, "steel", (Instance("base", -6.0),), bought=turned_over)
    assert [(moved, way) for moved, _, way in ordered((*parts, held), base="ground")] == [
        (["post"], DOWN),
        (["screw"], UP),
        (["lid"], DOWN),
    ]


def test_a_screw_goes_into_the_thread_in_the_end_of_a_pillar_and_not_into_a_hole_of_the_core():
    held = Part("screw", None, 0.0, "steel", (Instance("base", 30.0),), bought=screw(6, 20).bought)
    lid = plate("lid", "base", 24.0, ((0, 0), 6.6), half=30.0, thick=6.0)

    def put(pillar):
        return ordered((turned("pillar", "base", 0.0, pillar), lid, held), base="ground")

    threaded = Turned((Length(16.0, 24.0),), threads=(EndThread("upper", 6.0, 1.0, 16.0),))
    assert put(threaded) == [(["pillar"], ["lid"], UP), (["screw"], ["pillar", "lid"], DOWN)]
    assert put(Turned((Length(16.0, 24.0),), bore=5.0))[-1][2] is None, "a screw does not pass a plain core"


def test_a_key_in_a_closed_seat_comes_from_the_side_before_its_wheel():
    slot = box((2.0, 9.0), (-2.0, 2.0), (5.0, 15.0))
    shaft = Shape((Turned((Length(12.0, 20.0),)).shape.pieces[0],), (slot,))
    key = Shape((box((2.0, 8.0), (-2.0, 2.0), (5.0, 15.0)),))
    parts = (
        Part("shaft", None, 0.0, "steel", (Instance("a"),), build=shaft.solid),
        Part("key", None, 0.0, "steel", (Instance("a"),), build=key.solid),
    )
    ((moved, onto, way),) = ordered(parts)
    assert (moved, onto) == (["key"], ["shaft"])
    assert way == (-1.0, 0.0, 0.0)


def test_a_machine_begins_with_the_plate_of_its_shafts_and_stands_on_its_base_last():
    shaft = Turned((Length(10.0, 8.0), Length(14.0, 4.0), Length(10.0, 16.0)))
    bearing = next(one for one in bearings() if one.name == "6000")
    parts = (
        plate("base", "still", 0.0, half=60.0, thick=10.0),
        turned("leg", "still", 10.0, tube(40.0, 50.0, 30.0)),
        plate("lower", "still", 40.0, ((0, 0), 26.0), half=40.0, thick=10.0),
        Part("bearing", None, 0.0, "steel", (Instance("axis", 42.0),), bought=bearing.bought),
        turned("shaft", "wheel", 42.0, shaft),
        plate("wheel", "wheel", 54.0, ((0, 0), 10.0), half=15.0),
        turned("pillar", "still", 50.0, tube(60.0, 70.0, 30.0)),
        plate("upper", "still", 80.0, half=40.0, thick=10.0),
    )
    assert [(moved, way) for moved, _, way in ordered(parts, still="ground", axis="ground")] == [
        (["pillar"], DOWN),
        (["bearing"], UP),
        (["wheel"], DOWN),
        (["bearing", "shaft", "wheel"], DOWN),
        (["upper"], DOWN),
        (["leg"], UP),
        (["base"], UP),
    ]


def test_what_a_screw_with_a_head_holds_goes_to_its_place_with_it():
    held = Part("screw", None, 0.0, "steel", (Instance("still", 18.0),), bought=screw(6, 16).bought)
    parts = (
        turned("motor", "still", 0.0, tube(6.0, 20.0, 15.0)),
        plate("mount", "still", 15.0, ((0, 0), 6.6), half=10.0, thick=3.0),
        held,
        plate("lid", "still", 30.0, half=40.0),
    )
    assert ordered(parts, still="ground") == [
        (["mount"], ["motor"], DOWN),
        (["screw"], ["motor", "mount"], DOWN),
        (["motor", "mount", "screw"], ["lid"], UP),
    ]


def test_copies_come_one_after_the_other_where_nothing_between_them_minds():
    places = {"a": (-20.0, 0.0), "b": (20.0, 0.0), "base": (0.0, 0.0)}
    still = {name: Poses.planar(x, y, np.zeros(2)) for name, (x, y) in places.items()}
    joints = {name: Joint("fixed", GROUND, name) for name in places}
    motion = Motion("theta", {"theta": Channel(np.zeros(2), "rad")}, still, joints=joints)
    pillar = Turned((Length(12.0, 30.0),), threads=(EndThread("lower", 6.0, 1.0, 10.0),))
    head = Shape((*Turned((Length(10.0, 6.0), Length(6.0, 16.0))).shape.pieces,))
    screw_below = replace(screw(6, 16).bought, shape=head)

    def both(z):
        return Instance("a", z), Instance("b", z)

    parts = (
        plate("base", "base", 0.0, ((-20, 0), 6.6), ((20, 0), 6.6), half=40.0, thick=8.0),
        Part("pillar", None, 0.0, "steel", both(8.0), turned=pillar),
        Part("screw", None, 0.0, "steel", both(-6.0), bought=screw_below),
    )
    order = Order(bodies_of(parts, motion), motion, 0)

    def names(steps):
        return [[order.bodies[k].part.name for k in step.moved] for step in steps]

    assert names(order.steps) == [["pillar"], ["pillar"], ["screw"], ["screw"]]
    steps = alike(order.steps, order)
    assert names(steps) == [["pillar", "pillar"], ["screw", "screw"]]
    assert met(steps, order.bodies, 0) == []


def test_links_of_a_chain_that_hold_each_other_are_said_to_have_no_way():
    ring = Shape((tube(20.0, 30.0, 6.0).shape.pieces[0],))
    bar = Shape(
        (
            box((10.5, 14.5), (-3.0, 3.0), (-8.0, 14.0)),
            box((8.0, 17.0), (-3.0, 3.0), (14.0, 18.0)),
            box((8.0, 17.0), (-3.0, 3.0), (-12.0, -8.0)),
            box((8.0, 9.9), (-3.0, 3.0), (-12.0, 18.0)),
            box((15.1, 17.0), (-3.0, 3.0), (-12.0, 18.0)),
        )
    )
    parts = (
        Part("eye", None, 0.0, "steel", (Instance("a"),), build=ring.solid),
        Part("bar", None, 0.0, "steel", (Instance("b"),), build=bar.solid),
    )
    ((moved, onto, way),) = ordered(parts)
    assert (sorted(moved), onto, way) == (["bar", "eye"], [], None)


def test_heights_bar_what_is_wider_than_a_hole_and_let_pass_what_is_as_wide():
    def heights(form, lift=0.0):
        solid = form.shape.solid()
        from mechwright_cad.solids.tessellate import mesh_of

        mesh = mesh_of(solid, ruled=False, tolerance=0.02)
        return Heights.of(mesh.points + np.array((0.0, 0.0, lift)), mesh.triangles)

    hole, pin = tube(10.0, 30.0, 8.0), Turned((Length(10.0, 20.0),))
    assert not heights(hole).bars(heights(pin, -5.0).slim())
    assert not heights(pin).bars(heights(hole, 3.0).slim())
    wide = Turned((Length(10.0 + 8 * CELL, 20.0),))
    assert heights(hole).bars(heights(wide, -25.0).slim()), "it has all of its way before it"
    assert not heights(hole).bars(heights(wide, 9.0).slim()), "it stands above already"


def test_frames_of_ways_are_right_handed_and_orthonormal():
    for way in np.vstack((np.eye(3), -np.eye(3), np.array([[1, 2, 3], [-3, 0.1, 0.2]]))):
        way = way / np.linalg.norm(way)
        frame = frame_of(way)
        assert np.allclose(frame @ frame.T, np.eye(3))
        assert np.linalg.det(frame) == pytest.approx(1.0)
        assert np.allclose(frame[2], way)


def test_sets_that_bonds_hold_together():
    assert connected((0, 1, 2, 3, 4), [(0, 4), (1, 3), (4, 2)]) == [(0, 2, 4), (1, 3)]
    assert connected((1, 2), [(0, 1)]) == [(1,), (2,)]


CASES = [
    "elliptic-pair",
    "geneva-prototype",
    "crank-rocker-finished",
    pytest.param("elliptic-pair-machine", marks=by_night),
    pytest.param("geneva-machine", marks=by_night),
    pytest.param("geneva-motor", marks=by_night),
    pytest.param("spherical-machine", marks=by_night),
    pytest.param("spherical-double-crank-machine", marks=by_night),
    pytest.param("spherical-five-bar-machine", marks=by_night),
    pytest.param("five-bar-published", marks=by_night),
    pytest.param("five-bar-slots", marks=by_night),
    pytest.param("five-bar-three-phases", marks=by_night),
    pytest.param("slider-crank-quick-return", marks=by_night),
    pytest.param("figure-eight-train", marks=by_night),
    pytest.param("figure-eight-variable", marks=by_night),
    pytest.param("four-bar-double-rocker", marks=by_night),
    pytest.param("double-crank", marks=by_night),
    pytest.param("spherical-crank-rocker", marks=by_night),
    pytest.param("spherical-five-bar-projected", marks=by_night),
]


@pytest.mark.parametrize("name", CASES)
def test_every_step_of_an_example_passes_what_is_there(name):
    with Build(EXAMPLES / f"{name}.toml", host(), Wanted("model")) as build:
        plan = plan_of(build)
    assert met(plan.steps, plan.bodies, plan.sample) == []
    assert sorted(plan.sequence) == list(range(len(plan.bodies)))
    once = [k for step in plan.steps if len(step.moved) == 1 or not step.onto for k in step.moved]
    assert len(once) == len(set(once)), "no body is put anywhere twice but with its group"
    if len(plan.bodies) == 2:
        return  # two plates beside each other come from either side
    backwards = tuple(replace(step, way=tuple(-x for x in step.way)) for step in plan.steps)
    assert met(backwards, plan.bodies, plan.sample), "the replay sees an order that cannot be followed"


@by_night
@pytest.mark.parametrize("name", ["elliptic-pair-machine", "geneva-machine"])
def test_a_machine_of_the_examples_goes_together_in_an_order_that_a_mechanic_follows(name):
    with Build(EXAMPLES / f"{name}.toml", host(), Wanted("model")) as build:
        plan = plan_of(build)
    moved = [[plan.bodies[k].part.name for k in step.moved] for step in plan.steps]

    def last(part):
        return max(place for place, those in enumerate(moved) if part in those)

    assert plan.bodies[plan.order.root].part.name == "lower-plate"
    shafts = [k for k, those in enumerate(moved) if any(one.startswith("shaft-") for one in those)]
    assert len(shafts) == 2, "each shaft goes to its plate once, and with all that it carries"
    for place in shafts:
        assert sum(one.startswith("bearing-") for one in moved[place]) == 2
        assert any(one.startswith("circlip-") for one in moved[place])
    following = (
        last("pillar"),
        last("leg"),
        *shafts,
        *map(last, ("upper-plate", "coupling", "motor", "base-plate")),
    )
    assert sorted(following) == list(following)
    assert moved.count(["motor-pillar"] * 4) == 1
    assert {"foot", "base-plate"} <= set(moved[last("base-plate")])
    assert len(moved) <= 31


@by_night
@pytest.mark.parametrize(("name", "root"), [("slider-crank-machine", "base"), ("four-bar-machine", "ground")])
def test_a_machine_on_its_own_ground_plate_goes_together_from_that_plate(name, root):
    with Build(EXAMPLES / f"{name}.toml", host(), Wanted("model")) as build:
        plan = plan_of(build)
    assert plan.bodies[plan.order.root].part.name == root
    moved = [[plan.bodies[k].part.name for k in step.moved] for step in plan.steps]

    def last(part):
        return max(place for place, those in enumerate(moved) if part in those)

    following = [last(part) for part in ("pillar", "shaft", "coupling", "motor-plate", "leg", "base-plate")]
    assert sorted(following) == following
    assert met(plan.steps, plan.bodies, plan.sample) == []


def test_copies_of_a_part_are_one_step_and_come_to_hand_in_order():
    with Build(EXAMPLES / "crank-rocker-finished.toml", host(), Wanted("model")) as build:
        plan = plan_of(build)
    assert alike(plan.steps, plan.order) == list(plan.steps)
    assert len(plan.steps) < len(plan.order.steps)
    assert sequence(plan.steps, len(plan.bodies))[0] == next(
        k for k, body in enumerate(plan.bodies) if body.part.name == "ground"
    )


def test_a_body_of_several_pieces_has_the_layers_of_each():
    foot, head = box((0, 10), (0, 8), (0, 3)), box((2, 5), (2, 6), (3, 7))
    part = Part("block", None, 0.0, "aluminium", build=Shape((foot, head)).solid)
    layers = own_layers(part)
    assert [(one.low, one.high) for one in layers] == [(0, 3), (3, 7)]
    assert [one.shape.bounds for one in layers] == [(0, 0, 10, 8), (2, 2, 5, 6)]


@pytest.mark.parametrize("angle", [0.0, 0.785, 1.045, 2.0, 3.9, 5.5])
def test_every_place_that_a_triangle_covers_has_its_height(angle):
    corners = np.array([(0.0, 0.0), (30.0, 0.0), (8.0, 14.0)]) * CELL
    turned = corners @ np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
    points = np.column_stack((turned, turned @ (0.3, -0.2)))
    found = Heights.of(points, np.array([[0, 1, 2]]))
    triangle = shapely.Polygon(turned)
    for i, j in np.ndindex(found.low.shape):
        x, y = np.add(found.corner, (i, j)) * CELL
        place = shapely.box(x, y, x + CELL, y + CELL)
        if triangle.covers(place):
            heights = shapely.get_coordinates(place) @ (0.3, -0.2)
            assert heights.min() - 1e-9 <= found.low[i, j] <= found.high[i, j] <= heights.max() + 1e-9
        elif not triangle.intersects(place.buffer(1e-9)):
            assert found.low[i, j] == np.inf
            assert found.high[i, j] == -np.inf
