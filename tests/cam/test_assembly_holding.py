"""What holds a body at a step, which tool gets to it, and what bears a press: small cases, then machines."""

from pathlib import Path

import numpy as np
import pytest
from cam.assembly_check import badly_pressed, faults
from hypothesis import given
from hypothesis import strategies as st

from mechwright import Instance, Part
from mechwright.contracts.fits import hole_fit, shaft_fit
from mechwright.contracts.joint import GROUND, Joint
from mechwright.contracts.motion import Channel, Motion, Poses
from mechwright.contracts.part import Bore
from mechwright.contracts.turned import EndThread, Turned, tube
from mechwright.contracts.turned import Step as Length
from mechwright.errors import DesignError
from mechwright.geometry import Loop, Outline, circle
from mechwright.pipeline import Build, Wanted
from mechwright.plugins.host import host
from mechwright.standards.bushes import bush_for
from mechwright.standards.circlips import shaft_circlip
from mechwright.standards.hexagon_keys import bit_diameter, hexagon_key
from mechwright.standards.screws import screw
from mechwright_cad.assembly_guide.adjusting import Adjusting
from mechwright_cad.assembly_guide.handling import whence
from mechwright_cad.assembly_order.levels import Step
from mechwright_cad.assembly_order.order import Order
from mechwright_cad.assembly_order.plan import Plan, alike, plan_of
from mechwright_cad.assembly_order.press import presses, support
from mechwright_cad.assembly_order.reach import Reach
from mechwright_cad.assembly_order.schedule import precedence
from mechwright_cad.assembly_order.undo import locked
from mechwright_cad.bodies import bodies_of

EXAMPLES = Path(__file__).parents[2] / "examples"
DOWN, UP = (0.0, 0.0, -1.0), (0.0, 0.0, 1.0)


def plate(name, z, *holes, half=20.0, thick=6.0, at=(0.0, 0.0), body=None, bores=()):
    (x, y), h = at, half
    rim = Loop.polygon([(x - h, y - h), (x + h, y - h), (x + h, y + h), (x - h, y + h)])
    outline = Outline(rim, tuple(Loop((circle(p, d / 2, clockwise=True),)) for p, d in holes))
    return Part(name, outline, thick, "aluminium", (Instance(body or name, z),), machined=tuple(bores))


def turned(name, z, form, body=None):
    return Part(name, None, 0.0, "steel", (Instance(body or name, z),), turned=form)


def order_of(*parts, ground=("base",), together=()):
    """An order of parts at the origin; those named stand still, those together move as one."""
    names = sorted({instance.body for part in parts for instance in part.instances})
    joints = {name: Joint("fixed", GROUND, name) for name in ground if name in names}
    joints |= {f"{one}-{two}": Joint("fixed", one, two) for one, two in together}
    still = Poses.planar(0.0, 0.0, np.zeros(2))
    motion = Motion("t", {"t": Channel(np.zeros(2), "rad")}, dict.fromkeys(names, still), joints=joints)
    return Order(bodies_of(parts, motion), motion, 0)


def numbers(order):
    return {body.part.name: k for k, body in enumerate(order.bodies)}


def plan(order):
    return Plan(order.bodies, tuple(alike(order.steps, order)), order.motion, 0, order)


def falls(order, *names, down=DOWN):
    of = numbers(order)
    found = order.holding.falling(frozenset(of[name] for name in ("base", *names)), of["base"], down)
    return [order.bodies[min(unit)].part.name for unit in found]


def loosely(order, *names):
    of = numbers(order)
    found = order.holding.unretained(frozenset(of[name] for name in ("base", *names)), of["base"])
    return [order.bodies[min(unit)].part.name for unit in found]


def test_a_plate_rests_where_its_middle_stands_over_what_it_touches_and_tips_where_not():
    post = turned("post", 6.0, Turned((Length(12.0, 20.0),)))
    over, beside = plate("lid", 26.0), plate("lid", 26.0, at=(12.0, 0.0))
    assert falls(order_of(plate("base", 0.0), post, over), "post", "lid") == []
    assert falls(order_of(plate("base", 0.0), post, beside), "post", "lid") == ["lid"]
    assert falls(order_of(plate("base", 0.0), post), "post", down=UP) == ["post"]
    turned_over = order_of(plate("base", 0.0), post, over)
    assert falls(turned_over, "post", "lid", down=UP) == [], "the lid lies on the bench and bears the others"


def test_what_rests_on_a_part_that_is_held_by_hand_needs_no_hand():
    post = turned("post", 6.0, Turned((Length(12.0, 20.0),)))
    lid = plate("lid", 26.0, at=(12.0, 0.0))
    weight = plate("weight", 32.0, half=5.0, at=(12.0, 0.0))
    overhang = plate("weight", 32.0, half=5.0, at=(34.0, 0.0))
    assert falls(order_of(plate("base", 0.0), post, lid, weight), "post", "lid", "weight") == ["lid"]
    both = order_of(plate("base", 0.0), post, lid, overhang)
    assert falls(both, "post", "lid", "weight") == ["lid", "weight"], "its middle is beyond the lid's edge"
    hanging = order_of(plate("base", 0.0), post, lid, plate("weight", 20.0, half=4.0, at=(20.0, 0.0)))
    assert falls(hanging, "post", "lid", "weight") == ["weight"], "held under the lid, it props that"


def test_an_assembly_is_laid_on_its_side_where_two_parts_fall_else():
    base = plate("base", 0.0, ((-10.0, 0.0), 8.0), ((10.0, 0.0), 8.0))
    frames = {"left": (-10.0, 0.0), "right": (10.0, 0.0)}
    still = {name: Poses.planar(x, y, np.zeros(2)) for name, (x, y) in frames.items()}
    pins = [turned(name, -4.0, Turned((Length(8.0, 14.0),))) for name in frames]
    joints = {"base": Joint("fixed", GROUND, "base")}
    poses = {"base": Poses.planar(0.0, 0.0, np.zeros(2)), **still}
    motion = Motion("t", {"t": Channel(np.zeros(2), "rad")}, poses, joints=joints)
    order = Order(bodies_of((base, *pins), motion), motion, 0)
    assert falls(order, "left", "right") == ["left", "right"]
    assert falls(order, "left", "right", down=UP) == ["left", "right"]
    assert falls(order, "left", "right", down=(1.0, 0.0, 0.0)) == []
    first, last = order.steps
    assert len(first.hand) == 1
    assert last.hand == ()
    assert abs(last.down[2]) < 0.1


def test_a_screw_makes_what_it_clamps_one_with_its_thread():
    thread = EndThread("lower", 6.0, 1.0, 16.0)
    pillar = turned("pillar", 6.0, Turned((Length(12.0, 30.0),), threads=(thread,)), body="base")
    turned_over = Poses(np.zeros((2, 3)), np.tile(np.diag([1.0, -1.0, -1.0]), (2, 1, 1)))
    bolt = Part("bolt", None, 0.0, "steel", (Instance("over", 0.0),), bought=screw(6, 16).bought)
    base = plate("base", 0.0, ((0.0, 0.0), 6.6))
    still = Poses.planar(0.0, 0.0, np.zeros(2))
    joints = {name: Joint("fixed", GROUND, name) for name in ("base", "over")}
    poses = {"base": still, "over": turned_over}
    motion = Motion("t", {"t": Channel(np.zeros(2), "rad")}, poses, joints=joints)
    order = Order(bodies_of((base, pillar, bolt), motion), motion, 0)
    assert loosely(order, "pillar") == ["pillar"]
    assert falls(order, "pillar", down=UP) == ["pillar"]
    assert loosely(order, "pillar", "bolt") == []
    moved = [order.bodies[step.moved[0]].part.name for step in order.steps]
    assert moved == ["pillar", "bolt"]
    assert unheld(order) == []


def unheld(order):
    return faults(plan(order))


def test_a_pin_between_two_plates_is_captive_and_a_ring_on_a_plain_pin_is_not():
    pin = turned("pin", 2.0, Turned((Length(8.0, 20.0),)))
    holes = [((0.0, 0.0), 8.0)]
    low, high = plate("base", 0.0, *holes), plate("lid", 18.0, *holes, body="lid")
    order = order_of(low, pin, high, ground=("base", "lid"))
    assert "pin" in loosely(order, "pin")
    ring = turned("ring", 6.0, tube(8.0, 14.0, 4.0))
    order = order_of(plate("base", 0.0), turned("pin", 6.0, Turned((Length(8.0, 20.0),))), ring)
    assert "ring" in loosely(order, "pin", "ring"), "it slides off upwards"


def test_a_pressed_pin_is_held_and_a_sliding_one_is_not():
    def held(shaft, hole):
        bore = Bore("seat", (0.0, 0.0), 8.0, 0.0, 6.0, hole_fit(8.0, hole))
        base = plate("base", 0.0, ((0.0, 0.0), 8.0), bores=(bore,))
        thread = EndThread("upper", 4.0, 0.7, 8.0)  # a pillar: nothing says that it is bonded
        form = Turned((Length(8.0, 6.0, shaft_fit(8.0, shaft)), Length(12.0, 20.0)), threads=(thread,))
        order = order_of(base, turned("pin", 0.0, form, body="base"))
        return loosely(order, "pin") == []

    assert held("m6", "P7")
    assert held("m6", "H7"), "a transition fit is driven in with light blows"
    assert not held("h6", "H7")
    assert not held("g6", "H7")


def test_a_fitter_holds_by_hand_only_what_the_next_step_fastens():
    """A link that tips on its ring, and the headed pin that goes through both."""
    base = plate("base", 0.0, ((0.0, 0.0), 6.0), half=40.0)
    ring = turned("ring", 6.0, tube(6.2, 10.0, 2.0), body="link")
    link = plate("link", 8.0, ((0.0, 0.0), 6.0), at=(15.0, 0.0), half=18.0)
    pin = turned("pin", 0.0, Turned((Length(6.0, 14.0), Length(12.0, 3.0))), body="base")
    order = order_of(base, ring, link, pin)
    by_hand = [[order.bodies[k].part.name for k in step.hand] for step in order.steps]
    assert any("link" in names for names in by_hand)
    assert by_hand[-1] == []
    assert unheld(order) == []


@given(st.integers(2, 9).flatmap(lambda n: st.tuples(st.just(n), st.lists(st.integers(0, n * n - 1)))))
def test_wishes_never_contradict_what_bars(case):
    count, some = case
    barred = np.zeros((count, count), dtype=bool)
    for pair in some[::2]:
        i, j = sorted(divmod(pair, count))
        barred[i, j] = i != j
    wishes = [divmod(pair, count) for pair in some[1::2]]
    before = precedence(count, barred, wishes)
    assert not np.diag(before).any(), "no unit comes before itself"
    assert not (before & before.T).any()
    assert before[barred].all()
    assert (((before.astype(int) @ before) > 0) <= before).all(), "closed"
    for i, j in wishes:
        assert i == j or before[i, j] or before[j, i]


def test_keys_and_bits_have_the_sizes_of_their_table():
    assert [(hexagon_key(w).long, hexagon_key(w).short) for w in (1.5, 2, 2.5, 3, 4, 5, 6)] == [
        (45, 14),
        (50, 16),
        (56, 18),
        (63, 20),
        (70, 25),
        (80, 28),
        (90, 32),
    ]
    assert [bit_diameter(m) for m in (3, 5, 6, 8)] == [8, 8, 12, 12]
    with pytest.raises(DesignError, match=r"no hexagon key of 7 mm; widths: 1\.5, 2"):
        hexagon_key(7.0)


def reached(*others):
    """The tool for a screw M5 whose head stands at 0 to 5 mm, among other bodies."""
    bolt = Part("bolt", None, 0.0, "steel", (Instance("base", 0.0),), bought=screw(5, 16).bought)
    order = order_of(plate("base", -6.0, ((0.0, 0.0), 5.5)), bolt, *others)
    of = numbers(order)
    return Reach(order.bodies, 0, order.standing).tool(of["bolt"], np.array(DOWN), frozenset(of.values()))


def wall(name, x, y, width, depth, low=0.0, high=150.0):
    rim = Loop.polygon([(x, y), (x + width, y), (x + width, y + depth), (x, y + depth)])
    return Part(name, Outline(rim), high - low, "steel", (Instance(name, low),))


def around(gap, **heights):
    """Four walls with a free square of half width ``gap`` about the screw."""
    long = 2 * gap + 20.0
    return (
        wall("w", -gap - 10, -gap - 10, 10, long, **heights),
        wall("e", gap, -gap - 10, 10, long, **heights),
        wall("s", -gap, -gap - 10, 2 * gap, 10, **heights),
        wall("n", -gap, gap, 2 * gap, 10, **heights),
    )


def test_the_tool_for_a_screw_follows_from_the_room_over_its_head():
    assert reached() == "key"
    assert reached(wall("side", 6.0, -100.0, 10, 200)) == "key", "half of a turn is free"
    assert reached(*around(30.0)) == "long key", "its short arm swings between the walls"
    assert reached(*around(10.0)) == "bit"
    assert reached(*around(3.5, low=6.0)) is None
    assert reached(wall("lid", -50.0, -50.0, 100, 100, low=8.0, high=12.0)) is None
    low = wall("lid", -50.0, -50.0, 100, 100, low=40.0, high=44.0)
    assert reached(low) == "key", "the short arm stands in the socket"


def test_a_circlip_is_reached_beside_its_shaft_only_where_pliers_fit():
    clip = shaft_circlip(10)
    shaft = turned(
        "shaft",
        0.0,
        Turned(
            (Length(16.0, 3.0), Length(10.0, 12.0), Length(clip.groove, clip.thickness), Length(10.0, 4.0))
        ),
    )
    ring = Part("clip", None, 0.0, "steel", (Instance("shaft", 15.0),), bought=clip.bought)

    def tool(*others):
        order = order_of(shaft, ring, *others, ground=("shaft",))
        of = numbers(order)
        return Reach(order.bodies, 0, order.standing).tool(of["clip"], np.array(DOWN), frozenset(of.values()))

    assert tool() == "pliers"
    assert tool(*around(10.0, low=10.0)) is None, "12 mm of arm beside a shaft of 10 mm"
    assert tool(*around(18.0, low=10.0)) == "pliers"


def test_a_screw_comes_before_what_would_stand_over_its_head():
    """Base and post, its screw from above, and a lid that would hide the screw; the lid could come first."""
    thread = EndThread("upper", 5.0, 0.8, 14.0)
    post = turned("post", -26.0, Turned((Length(12.0, 26.0),), threads=(thread,)), body="base")
    bolt = Part("bolt", None, 0.0, "steel", (Instance("base", 6.0),), bought=screw(5, 16).bought)
    shade = wall("shade", 9.0, -40.0, 60, 80, low=13.0, high=20.0)
    order = order_of(plate("base", 0.0, ((0.0, 0.0), 5.5)), post, bolt, shade)
    of = numbers(order)
    assert not order.reach.always_in_the_way(of["bolt"], np.array(DOWN)), "half of a turn stays free"
    over = wall("shade", -40.0, -40.0, 80, 80, low=13.0, high=20.0)
    order = order_of(plate("base", 0.0, ((0.0, 0.0), 5.5)), post, bolt, over)
    of = numbers(order)
    assert order.reach.always_in_the_way(of["bolt"], np.array(DOWN)) == {of["shade"]}
    moved = [order.bodies[step.moved[0]].part.name for step in order.steps]
    assert moved.index("bolt") < moved.index("shade")


def test_a_bush_is_pressed_in_before_its_shaft_and_on_a_free_support():
    bush = Part("bush", None, 0.0, "brass", (Instance("base", 0.0),), bought=bush_for(12, 8).bought)
    bore = Bore("seat", (0.0, 0.0), 16.0, 0.0, 8.0, hole_fit(16.0, "H7"))
    base = plate("base", 0.0, ((0.0, 0.0), 16.0), thick=8.0, bores=(bore,))
    shaft = turned("shaft", -12.0, Turned((Length(12.0, 30.0, shaft_fit(12.0, "f7")),)))
    order = order_of(base, bush, shaft)
    first, second = order.steps
    assert [order.bodies[step.moved[0]].part.name for step in (first, second)] == ["bush", "shaft"]
    (match,) = presses(order, first)
    assert support(order, first, match).bears == "tube"
    assert list(badly_pressed(plan(order))) == []
    assert list(presses(order, second)) == [], "the shaft runs"


def test_a_pin_that_is_pressed_over_a_gap_asks_for_packings_up_to_what_is_held():
    def at(gap):
        low = plate("base", 0.0, half=30.0)
        post = turned("post", 6.0, Turned((Length(10.0, gap),)), body="base")
        bore = Bore("seat", (12.0, 0.0), 4.0, 0.0, 6.0, hole_fit(4.0, "P7"))
        link = plate("link", 6.0 + gap, ((12.0, 0.0), 4.0), bores=(bore,))
        pin = Part(
            "pin",
            None,
            0.0,
            "steel",
            (Instance("link-pin", 6.0 + gap),),
            turned=Turned((Length(4.0, 12.0, shaft_fit(4.0, "m6")),)),
        )
        poses = {name: Poses.planar(0.0, 0.0, np.zeros(2)) for name in ("base", "link")}
        poses["link-pin"] = Poses.planar(12.0, 0.0, np.zeros(2))
        joints = {"base": Joint("fixed", GROUND, "base"), "pin": Joint("fixed", "link", "link-pin")}
        motion = Motion("t", {"t": Channel(np.zeros(2), "rad")}, poses, joints=joints)
        order = Order(bodies_of((low, post, link, pin), motion), motion, 0)
        of = numbers(order)
        (match,) = [one for one in order.seats.matches if one.pin == of["pin"]]
        onto = tuple(k for name, k in sorted(of.items()) if name != "pin")
        found = support(order, Step((of["pin"],), onto, DOWN, root=of["base"]), match)
        return found.bears, [(order.bodies[k].part.name, thick) for k, thick in found.packings]

    assert at(3.0) == ("stack", [("base", pytest.approx(3.0, abs=0.02))])
    assert at(60.0) == ("tube", [])


def test_a_pin_in_a_blind_hole_is_told_as_locked():
    def is_locked(depth, length):
        bore = Bore("seat", (0.0, 0.0), 4.0, 0.0, depth, hole_fit(4.0, "P7"))
        base = plate("base", 0.0, thick=10.0, bores=(bore,))
        pin = turned("pin", 10.0 - depth, Turned((Length(4.0, length, shaft_fit(4.0, "m6")),)), body="base")
        return bool(list(locked(order_of(base, pin))))

    assert is_locked(6.0, 7.0)
    assert not is_locked(10.0, 10.0), "a drift reaches it from below"
    assert not is_locked(6.0, 12.0), "pliers grip it"


def test_ways_are_named_by_the_eight_sides_and_their_tilt():
    assert whence(UP) == "from below"
    assert whence((0.0, -1.0, 0.0)) == "from the back"
    assert whence((-np.sqrt(0.5), np.sqrt(0.5), 0.0)) == "from the front right"
    assert whence((0.0, np.sin(np.radians(20)), np.cos(np.radians(20)))) == (
        "from below, tilted 20 degrees to the front"
    )


def test_the_float_of_a_shaft_is_measured_once_its_parts_are_there():
    with Build(EXAMPLES / "elliptic-pair-machine.toml", host(), Wanted("check")) as build:
        plan, stacks = build.made(plan_of), build.design.stacks
    adjusting = Adjusting(plan, stacks)
    said = [sentence for step in plan.steps for sentence in adjusting.measured(step)]
    (one,) = [sentence for sentence in said if "float of shaft-2" in sentence]
    assert one.startswith(
        "Push and pull, and measure the float of shaft-2 with a dial gauge, without rings: it is "
    )
    (stack,) = [each for each in stacks if each.name == "float of shaft-2"]
    low, high = stack.worst
    assert f"{low:.2f} to {high:.2f} mm" in one
    rings = " + ".join(f"{ring:g}" for ring in stack.shimming.rings(stack.middle))
    assert f"At {stack.middle:.2f} mm, say, put in {rings} mm." in one
    assert Adjusting(plan, ()).stacks == ()
