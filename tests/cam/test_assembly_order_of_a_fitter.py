"""What a fitter is told of compound, dowels, flats and phases, in machines as they are built."""

from pathlib import Path

import pytest

from mechwright.contracts.holes import hole
from mechwright.pipeline import Build, Wanted
from mechwright.plugins.host import host
from mechwright_cad.assembly_guide.words import Words
from mechwright_cad.assembly_order.plan import plan_of
from mechwright_cad.bill.items import numbers_of
from mechwright_cad.bill.page import order_of

EXAMPLES = Path(__file__).parents[2] / "examples"


def guide(name):
    """The plan of an example, the sentences of each step in one text, and its parts by name."""
    with Build(EXAMPLES / f"{name}.toml", host(), Wanted("model")) as build:
        plan = build.made(plan_of)
        words = Words(plan, numbers_of(build.parts, order_of(build)), build.design.stacks)
        return (
            plan,
            [" ".join(words.sentences(step)) for step in plan.steps],
            {p.name: p for p in build.parts},
        )


def step_of(plan, name):
    """The number, from 0, of the first step that brings a part."""
    return next(k for k, s in enumerate(plan.steps) if any(plan.bodies[m].part.name == name for m in s.moved))


@pytest.fixture(scope="module")
def geneva():
    return guide("geneva-machine")


@pytest.fixture(scope="module")
def slider():
    return guide("slider-crank-machine")


@pytest.fixture(scope="module")
def five_bar():
    return guide("five-bar-machine")


def test_dowels_that_no_body_shows_have_fits_and_a_step_before_the_bond(geneva):
    plan, said, parts = geneva
    assert hole(parts["locking-disc"], "dowel-1").fit.name == "H7"
    assert hole(parts["crank"], "dowel-1").fit.name == "F7"
    at = step_of(plan, "crank")
    assert "Drive 2 x dowel (301), ⌀4 x 20, in: locking-disc" in said[at]
    assert "0.012 mm tight to 0.008 mm loose" in said[at]
    bonded = next(k for k, one in enumerate(said) if "Now bond crank" in one)
    assert at < bonded
    assert sum("Drive 2 x dowel" in one for one in said) == 1


def test_float_is_measured_with_the_screws_tight_and_the_motor_comes_after(geneva):
    plan, said, _ = geneva
    measured = next(k for k, one in enumerate(said) if "measure the float of shaft-driver" in one)
    assert "Draw these screws tight while you measure, and loosen them again" in said[measured]
    assert measured < step_of(plan, "coupling")


def test_pillars_have_one_thread_and_flats_and_nobody_tells_ends_apart(geneva):
    _, said, parts = geneva
    for name in ("pillar", "plain-pillar", "leg", "motor-pillar"):
        form = parts[name].turned
        assert len({one.depth for one in form.threads}) == 1, name
        assert form.flats, name
    assert not any("goes up, that of" in one for one in said)
    (leg,) = {one for one in said if "two open spanners 10 mm" in one and "plain-pillar" not in one} or {""}
    assert "tighten to 5.4 N m" in leg or "tighten to 5.4 N m" in " ".join(said)


def test_nothing_turns_before_the_compound_cures_and_later_seats_stay_free_of_grease(slider, five_bar):
    plan, said, _ = slider
    on = next(
        k for k, one in enumerate(said) if "shaft (" in one and "Wait until the compound of step" in one
    )
    assert "Grease. Try:" in said[on]
    assert on > step_of(plan, "shaft")
    _, said, _ = five_bar
    assert any("leave free of it the seat that is bonded later: that of pinion" in one for one in said)


def test_rails_are_dowelled_upright_before_their_screws_and_nothing_stands_over_them(slider):
    plan, said, parts = slider
    assert step_of(plan, "dowel") < step_of(plan, "rail-screw") < step_of(plan, "pillar")
    assert plan.steps[step_of(plan, "dowel")].down == (0.0, 0.0, -1.0)
    face = parts["rail"].instances[0].z + parts["rail"].thickness
    for name in ("dowel", "rail-screw"):
        part = parts[name]
        length = float(part.bought.designation.split(" x ")[1].split()[0])
        assert part.instances[0].z + length <= face - 0.5 + 1e-9, name
    assert [one.what for one in parts["slider"].measures] == ["width across the guiding faces"]
    (width,) = parts["slider"].measures
    assert 0 < width.greatest - width.least < 0.1
    assert any("feeler gauge of 0.1 mm beside it" in one for one in said)


def test_links_lie_on_bushings(slider):
    _, _, parts = slider
    crank, base = parts["crank"].instances[0].z, parts["shaft-bushing"]
    assert base.instances[0].z + base.turned.length == pytest.approx(crank)
    tops = {
        "crank": crank + parts["crank"].thickness,
        "slider": parts["slider"].instances[0].z + parts["slider"].thickness,
    }
    low = sorted(one.z for name in ("bushing", "bushing-2") for one in parts[name].instances)
    assert low == pytest.approx(sorted(tops.values()))
    assert parts["slider"].instances[0].z == pytest.approx(parts["rail"].instances[0].z), (
        "both lie on the base"
    )


def test_the_wheel_of_a_five_bar_turns_until_its_clamp_is_set_by_angles(five_bar):
    plan, said, _ = five_bar
    assert "bond" not in said[step_of(plan, "wheel")]
    assert "bond it with retaining compound" in said[step_of(plan, "clamp")]
    assert "The crank stands at 83.0° and the arm at" in said[step_of(plan, "hub-screw")]


def test_a_spring_is_hooked_once_its_lever_stands_in_both_bearings():
    plan, said, _ = guide("cam-lever-machine")
    hooked = next(k for k, one in enumerate(said) if "Hook the spring over both pins" in one)
    assert step_of(plan, "upper-plate") < hooked < step_of(plan, "coupling")
    assert f"step {hooked + 1} hooks its other end" in said[step_of(plan, "spring")]
    assert not any(step.hand for step in plan.steps)
    (at,) = [
        k for k, s in enumerate(plan.steps) if any(plan.bodies[m].part.name == "screw-m5x20" for m in s.moved)
    ]
    assert len(plan.steps[at].moved) == 4, "one flange, one step"


def test_dots_are_punched_on_the_bench():
    plan, said, _ = guide("elliptic-pair-machine")
    for k, text in enumerate(said):
        puts = any(plan.bodies[n].part.name == "gear" for n in plan.steps[k].moved[:1])
        brought = puts and "Put gear (" in text
        assert ("centre-punch the top face of gear, at x " in text) is brought, text
    assert sum("On the bench first" in one for one in said) == 2
