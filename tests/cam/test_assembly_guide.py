"""The page of the assembly and its drawing: what is seen, what is said, and that it is the same every time."""

import io
import re
from dataclasses import replace
from pathlib import Path

import ezdxf
import numpy as np
import pytest
import shapely
from by_night import by_night
from hypothesis import given
from hypothesis import strategies as st

from mechwright import Instance, Part
from mechwright.contracts.fits import hole_fit, shaft_fit
from mechwright.contracts.joint import GROUND, Joint
from mechwright.contracts.motion import Channel, Motion, Poses
from mechwright.contracts.part import Bore
from mechwright.contracts.turned import EndThread, Turned, tube
from mechwright.contracts.turned import Step as Length
from mechwright.geometry import Loop, Outline, circle
from mechwright.mechanics.mating.rounds import matches, rounds_of
from mechwright.pipeline import Build, Wanted
from mechwright.plugins.host import host
from mechwright.standards.bearings import bearings
from mechwright.standards.bushes import bush_for
from mechwright.standards.circlips import shaft_circlip
from mechwright.standards.couplings import coupling_for
from mechwright.standards.screws import screw
from mechwright_cad.assembly_guide.balloons import APART, balloons
from mechwright_cad.assembly_guide.exploded import Boxes, exploded, lifted
from mechwright_cad.assembly_guide.page import AssemblyGuide
from mechwright_cad.assembly_guide.pictures import Pictures
from mechwright_cad.assembly_guide.tools import fitted, screwed
from mechwright_cad.assembly_guide.view import View
from mechwright_cad.assembly_guide.words import Words
from mechwright_cad.assembly_order.layers import frame_of, mesh_points
from mechwright_cad.assembly_order.order import Order
from mechwright_cad.assembly_order.plan import Plan, plan_of
from mechwright_cad.bill.page import order_of
from mechwright_cad.bodies import bodies_of
from mechwright_cad.contacts.screw_joints import joints_of

EXAMPLES = Path(__file__).parents[2] / "examples"


def turned(name, form, z=0.0, body="a"):
    return Part(name, None, 0.0, "steel", (Instance(body, z),), turned=form)


def standing(*parts):
    names = {instance.body for part in parts for instance in part.instances}
    still = Poses.planar(0.0, 0.0, np.zeros(2))
    motion = Motion("t", {"t": Channel(np.zeros(2), "rad")}, dict.fromkeys(sorted(names), still))
    return bodies_of(parts, motion)


@pytest.fixture(scope="module")
def crank_rocker():
    with Build(EXAMPLES / "crank-rocker-finished.toml", host(), Wanted("model")) as build:
        return AssemblyGuide().files(build), plan_of(build), order_of(build)


def test_a_pin_hides_what_is_behind_it_and_a_ring_shows_its_hole():
    bodies = standing(turned("near", tube(4.0, 20.0, 10.0)), turned("far", tube(6.0, 16.0, 7.0), 1.5, "b"))
    view = View(bodies, 0)
    alone = view.lines({0: np.zeros(3)})[0]
    behind = view.lines({0: np.zeros(3), 1: -40.0 * view.frame[2]})
    assert behind[0].length == pytest.approx(alone.length, rel=0.01)
    assert behind[1].length == 0, "it is narrower all round"
    before = view.lines({0: np.zeros(3), 1: 40.0 * view.frame[2]})
    beside = view.lines({0: np.zeros(3), 1: 40.0 * view.frame[0]})
    assert before[1].length == pytest.approx(beside[1].length, rel=0.02) != 0
    assert before[0].length < 0.8 * alone.length
    _, up, towards = view.frame
    x0, y0, x1, y1 = alone.bounds
    assert x1 - x0 == pytest.approx(20.0, abs=0.3), "a circle keeps its width"
    assert y1 - y0 == pytest.approx(20 * towards[2] + 10 * up[2], abs=0.4), "and loses height by the slant"


def test_what_is_smaller_than_the_shortest_line_is_left_out():
    view = View(standing(turned("speck", Turned((Length(0.2, 0.2),)))), 0)
    assert view.lines({0: np.zeros(3)})[0].is_empty


def test_boxes_of_the_exploded_view_do_not_overlap_along_any_axis(crank_rocker):
    _, plan, _ = crank_rocker
    boxes = Boxes(plan.bodies, plan.sample)
    shifts = exploded(plan.steps, boxes, len(plan.bodies))
    for step in plan.steps:
        way = np.array(step.way)
        for one in step.moved:
            for two in step.onto:
                a, b = boxes.across(one, way, shifts[one]), boxes.across(two, way, shifts[two])
                beside = (a[1, :2] <= b[0, :2]).any() or (b[1, :2] <= a[0, :2]).any()
                assert beside or a[1, 2] < b[0, 2], (plan.bodies[one].name, plan.bodies[two].name)
        small = lifted(step, boxes)
        assert all(np.allclose(small[k], 0.0) for k in step.onto)
        assert frame_of(way) @ small[step.moved[0]] == pytest.approx(
            (0.0, 0.0, -np.linalg.norm(small[step.moved[0]])), abs=1e-9
        )


@given(st.lists(st.floats(-200, 200), min_size=2, max_size=12))
def test_a_column_of_balloons_stands_as_high_as_what_it_points_at(heights):
    lines = {k: shapely.LineString([(10.0 * k, y), (10.0 * k + 4, y)]) for k, y in enumerate(heights)}
    found = balloons(lines, {k: k + 1 for k in lines}, 2.0)
    for x in {one.at[0] for one in found}:
        column = [one for one in found if one.at[0] == x]
        off = [one.at[1] - one.tip[1] for one in column]
        assert sum(off) == pytest.approx(0, abs=1e-6)


def test_balloons_of_a_column_stand_apart_and_each_item_has_one():
    lines = {k: shapely.MultiLineString([[(3.0 * k, 0.1 * k), (3.0 * k + 2, 0.1 * k)]]) for k in range(9)}
    found = balloons(lines, {k: 1 + k // 2 for k in range(9)}, 2.0)
    assert sorted(one.number for one in found) == [1, 2, 3, 4, 5]
    x0, _, x1, _ = shapely.union_all(list(lines.values())).bounds
    for side in (-1, 1):
        column = sorted(one.at[1] for one in found if (one.at[0] > x1 if side > 0 else one.at[0] < x0))
        assert column
        assert all(np.diff(column) >= APART * 2.0 - 1e-9)


def test_fits_say_whether_a_pin_is_pressed_pushed_or_runs():
    def play(shaft, bore):
        pin = turned("pin", Turned((Length(6.0, 10.0, shaft),)))
        hole = turned("bush", tube(6.0, 12.0, 5.0, bore), 2.0, "b")
        (match,) = matches(standing(pin, hole), 0, (0,), (1,))
        return match

    press = play(shaft_fit(6, "m6"), hole_fit(6, "P7"))
    assert press.play[1] < 0
    push = play(shaft_fit(6, "m6"), hole_fit(6, "H7"))
    assert push.play == pytest.approx((-0.012, 0.008))
    runs = play(shaft_fit(6, "f7"), hole_fit(6, "H7"))
    assert runs.play == pytest.approx((0.010, 0.034))
    assert runs.text == "⌀6 H7 / 6 f7"
    assert (play(None, None).missing_fits, play(None, hole_fit(6, "H7")).missing_fits, runs.missing_fits) == (
        2,
        1,
        0,
    )
    apart = standing(turned("pin", Turned((Length(6.0, 2.0),))), turned("bush", tube(6, 12, 5), 2.0, "b"))
    assert matches(apart, 0, (0,), (1,)) == [], "it ends where the bush begins"
    room = standing(turned("pin", Turned((Length(5.0, 9.0),))), turned("bush", tube(6, 12, 5), 2.0, "b"))
    assert matches(room, 0, (0,), (1,)) == []


def test_screws_have_their_key_and_torque_and_circlips_their_pliers():
    bolt = Part("bolt", None, 0.0, "steel", (Instance("a", 10.0),), bought=screw(4, 12).bought)
    assert screwed(bolt) == "Tool: hexagon key 3 mm.", "no torque without the thread that it is in"
    pillar = turned("pillar", Turned((Length(12.0, 10.0),), threads=(EndThread("upper", 4.0, 0.7, 6.0),)))
    (joint,) = joints_of(standing(replace(bolt, instances=(Instance("a", 16.0),)), pillar), 0)
    assert screwed(bolt, joint) == "Tool: hexagon key 3 mm; tighten to 2.7 N m (8.8, oiled)."
    grub = Part("grub", None, 0.0, "steel", bought=screw(4, 6, "set").bought)
    assert "hexagon key 2 mm" in screwed(grub)
    assert "N m" not in screwed(grub)
    clip = Part("clip", None, 0.0, "steel", bought=shaft_circlip(10).bought)
    assert screwed(clip) == ""
    assert "outer circlips" in fitted(clip)


def test_the_page_has_every_step_and_item_and_asks_nobody(crank_rocker):
    files, plan, order = crank_rocker
    page = files["assembly.html"]
    assert page.count('<li id="step-') == len(plan.steps)
    assert page.count('type="checkbox"') == len(plan.steps)
    assert "http" not in page.replace("http://www.w3.org/2000/svg", "").replace("http-equiv", "")
    listed = {int(n) for n in re.findall(r'<td class="n">(\d+)</td><td class="n">', page)}
    assert {int(n) for n in re.findall(r'text-anchor="middle">(\d+)<', page)} == listed
    assert len(listed) == len(order) - 1, "two pins are alike"
    assert "push fit, ⌀6 N7 / 6 h6" in page
    assert page.index("bushing-ground") < page.index("The group of coupler")


def test_colours_are_told_apart_by_everybody():
    text = (Path(__file__).parents[2] / "cam/mechwright_cad/assembly_guide/page.html").read_text()
    for block in re.findall(r":root \{([^}]*)\}", text):
        colours = dict(re.findall(r"--(\w+): (#\w+)", block))
        for ink in ("ink", "soft", "new"):
            for ground in ("paper", "card"):
                assert contrast(colours[ink], colours[ground]) >= 4.5, (ink, ground)


def contrast(one, two):
    """Of two colours (WCAG 2.2)."""

    def light(text):
        digits = text[1:] if len(text) == 7 else "".join(2 * c for c in text[1:])
        parts = [int(digits[k : k + 2], 16) / 255 for k in (0, 2, 4)]
        r, g, b = (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts)
        return 0.2126 * r + 0.7152 * g + 0.0722 * b

    low, high = sorted((light(one), light(two)))
    return (high + 0.05) / (low + 0.05)


def test_the_drawing_has_the_items_and_is_sound(crank_rocker):
    files, plan, _ = crank_rocker
    document = ezdxf.read(io.StringIO(files["assembly-drawing.dxf"].decode()))
    assert not document.audit().errors
    words = [text.dxf.text for text in document.modelspace().query("TEXT")]
    assert {"Item", "ground", "coupler", "pin-b, pin-a"} <= set(words)
    assert any(word.endswith(f", {len(plan.bodies)}") for word in words), "the sum of the bodies"
    for solid in document.modelspace().query("SOLID"):
        a, b, d, c = (
            corner.vec2 for corner in (solid.dxf.vtx0, solid.dxf.vtx1, solid.dxf.vtx2, solid.dxf.vtx3)
        )
        assert shapely.Polygon([a, b, c, d]).is_valid, "a dot, no bow tie"
    assert files["assembly-drawing.pdf"].startswith(b"%PDF-1.4")


def test_the_same_design_gives_the_same_bytes(crank_rocker):
    with Build(EXAMPLES / "crank-rocker-finished.toml", host(), Wanted("model")) as build:
        assert AssemblyGuide().files(build) == crank_rocker[0]


def test_a_single_body_needs_no_order():
    with Build(EXAMPLES / "elliptic-pair.toml", host(), Wanted("cam")) as build:
        assert not AssemblyGuide().shown(build)
    with Build(EXAMPLES / "elliptic-pair.toml", host(), Wanted("model")) as build:
        assert AssemblyGuide().shown(build)
        assert "between the two dots" in AssemblyGuide().files(build)["assembly.html"]


@pytest.mark.parametrize("name", [pytest.param("figure-eight-variable", marks=by_night)])
def test_every_item_of_a_train_is_seen_in_the_exploded_view(name):
    with Build(EXAMPLES / f"{name}.toml", host(), Wanted("model")) as build:
        page = AssemblyGuide().files(build)["assembly.html"]
    listed = {int(n) for n in re.findall(r'<td class="n">(\d+)</td><td class="n">', page)}
    assert {int(n) for n in re.findall(r'text-anchor="middle">(\d+)<', page)} == listed


def told(parts, **fixed_to):
    """What each step says of parts that all stand at the origin, in one piece, and the pictures."""
    names = sorted({instance.body for part in parts for instance in part.instances})
    still = Poses.planar(0.0, 0.0, np.zeros(2))
    joints = {name: Joint("fixed", GROUND, name) for name in fixed_to.get("still", ())}
    motion = Motion("t", {"t": Channel(np.zeros(2), "rad")}, dict.fromkeys(names, still), joints=joints)
    bodies = tuple(bodies_of(parts, motion))
    order = Order(bodies, motion, 0)
    plan = Plan(bodies, order.steps, motion, 0, order)
    numbers = {part.name: k for k, part in enumerate(parts, start=1)}
    words, pictures = Words(plan, numbers), Pictures(plan, numbers)
    return [(" ".join(words.sentences(s)), pictures.step(s, words.title(s))) for s in plan.steps]


def test_a_shaft_is_fast_in_its_bearing_and_in_its_coupling():
    bearing = next(one for one in bearings() if one.name == "6000")
    journal = shaft_fit(10.0, "j6")
    shaft = turned("shaft", Turned((Length(10.0, 20.0), Length(10.0, 8.0, journal), Length(14.0, 9.0))))
    on = Part("bearing", None, 0.0, "steel", (Instance("axis", 20.0),), bought=bearing.bought)
    ((words, _),) = told((shaft, on), still=("axis",))
    assert "is a push fit" in words
    assert "turn freely" not in words
    clamped = Part(
        "coupling", None, 0.0, "steel", (Instance("a", -15.0),), bought=coupling_for(6, 10, 0.1).bought
    )
    motor = turned("motor", Turned((Length(37.0, 50.0), Length(6.0, 13.0))), -65.0, "still")
    found = [words for words, _ in told((shaft, clamped, motor), still=("still",))]
    assert any(
        "motor (3) goes 13.0 mm into coupling (2): tighten its screw there." in words for words in found
    )
    assert any("Its other screw stays loose until both shafts stand." in words for words in found)
    assert not any("turn freely" in words for words in found)


def test_a_pillar_with_threads_in_its_ends_needs_no_compound_and_screws_go_into_them():
    fit = shaft_fit(8.0, "h6")
    thread = EndThread("lower", 5.0, 0.8, 12.0)
    seat = Bore("seat", (0.0, 0.0), 8.0, 0.0, 6.0, hole_fit(8.0, "H7"))
    rim = Loop.polygon([(-20.0, -20.0), (20.0, -20.0), (20.0, 20.0), (-20.0, 20.0)])
    pierced = Outline(rim, (Loop((circle((0.0, 0.0), 4.0, clockwise=True),)),))
    plate = Part("plate", pierced, 6.0, "steel", (Instance("a", 0.0),), machined=(seat,))
    for threads, held in (((), False), ((thread,), True)):
        steps = (Length(8.0, 4.0, fit), Length(12.0, 30.0))
        pillar = turned("pillar", Turned(steps, threads=threads), 2.0)
        ((words, _),) = told((plate, pillar))
        assert "slides in" in words
        assert ("Nothing else keeps it there" in words) is not held
    stud = Part("stud", None, 0.0, "steel", (Instance("a", 10.0),), bought=screw(5, 16, "set").bought)
    steps = told((turned("pillar", Turned((Length(12.0, 30.0),), threads=(thread,))), stud))
    assert "stud (2) screws into pillar (1)." in steps[0][0]


def test_what_comes_from_below_is_seen_from_below_where_it_would_be_hidden():
    rim = Loop.polygon([(-40.0, -40.0), (40.0, -40.0), (40.0, 40.0), (-40.0, 40.0)])
    plate = Part("plate", Outline(rim), 5.0, "steel", (Instance("a", 0.0),))
    pin = turned("pin", Turned((Length(8.0, 10.0),)), -10.0)
    ((words, picture),) = told((plate, pin))
    assert "from below" in words
    assert "seen from below" in picture
    wide = turned("disc", Turned((Length(110.0, 10.0),)), -10.0)
    ((_, picture),) = told((plate, wide))
    assert "seen from below" not in picture


def test_screws_of_a_column_wait_until_it_stands():
    """Plate, pillar and foot: the upper screw is put in first and drawn tight with the lower one."""
    rim = Loop.polygon([(-20.0, -20.0), (20.0, -20.0), (20.0, 20.0), (-20.0, 20.0)])
    pierced = Outline(rim, (Loop((circle((0.0, 0.0), 2.75, clockwise=True),)),))
    threads = (EndThread("lower", 5.0, 0.8, 12.0), EndThread("upper", 5.0, 0.8, 12.0))
    pillar = turned("pillar", Turned((Length(12.0, 40.0),), threads=threads), body="still")
    top = Part("top", pierced, 6.0, "steel", (Instance("still", 40.0),))
    above = Part("above", None, 0.0, "steel", (Instance("still", 46.0),), bought=screw(5, 16).bought)
    foot = Part("foot", pierced, 8.0, "steel", (Instance("still", -8.0),))
    below = Part("below", None, 0.0, "steel", (Instance("over", 8.0),), bought=screw(5, 20).bought)
    names = ("still", "over")
    over = Poses(np.zeros((2, 3)), np.tile(np.diag([1.0, -1.0, -1.0]), (2, 1, 1)))
    still = Poses.planar(0.0, 0.0, np.zeros(2))
    joints = {name: Joint("fixed", GROUND, name) for name in names}
    motion = Motion("t", {"t": Channel(np.zeros(2), "rad")}, {"still": still, "over": over}, joints=joints)
    bodies = tuple(bodies_of((pillar, top, above, foot, below), motion))
    order = Order(bodies, motion, 0)
    plan = Plan(bodies, order.steps, motion, 0, order)
    words = Words(plan, {part.name: k for k, part in enumerate((pillar, top, above, foot, below), start=1)})
    said = {plan.bodies[step.moved[0]].part.name: " ".join(words.sentences(step)) for step in plan.steps}
    first, last = sorted(("above", "below"), key=list(said).index)
    number = list(said).index(last) + 1
    assert f"only until its head rests: step {number} draws it tight" in said[first]
    assert "tighten to" not in said[first]
    assert re.search(
        rf"draw {first} \(\d\) of step \d tight now, crosswise: .* tighten to 5.4 N m", said[last]
    )
    assert "only until" not in said[last]


def test_both_bores_of_a_coupling_are_seen_and_a_bush_is_pressed_in():
    clamped = Part("coupling", None, 0.0, "steel", (Instance("a"),), bought=coupling_for(6, 10, 0.1).bought)
    bores = [one for one in rounds_of(bodies_of_one(clamped), 0) if one.inside]
    assert sorted((one.diameter, one.low, one.high) for one in bores) == [(6, 0, 15), (10, 15, 30)]
    bush = Part("bush", None, 0.0, "brass", (Instance("a"),), bought=bush_for(12, 8).bought)
    (outside, inside) = sorted(rounds_of(bodies_of_one(bush), 0), key=lambda one: one.inside)
    assert (outside.fit.text, inside.fit.name) == ("16 r6 (+0.023/+0.034)", "H7")


def bodies_of_one(part):
    (body,) = standing(part)
    return body


def test_the_bore_of_a_small_plate_is_drawn_round():
    """Its corners stand so close that a chord is a hundredth of the plate at most; a large one needs no more."""
    counts = []
    for half in (4.0, 60.0):
        rim = Loop.polygon([(-half, -half), (half, -half), (half, half), (-half, half)])
        outline = Outline(rim, (Loop((circle((0, 0), half / 8, clockwise=True),)),))
        body = bodies_of_one(Part("small", outline, 2.0, "aluminium", (Instance("a", 0.0),)))
        points, _ = mesh_points(body, 0)
        counts.append(int((np.hypot(*points[:, :2].T) < half / 4).sum()) // 2)
    assert min(counts) >= 12
    assert max(counts) <= 48
