"""Fits of pairs: which pin is in which hole, what each gets, and that nobody is left without."""

import math
import tomllib
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

import mechwright as mw
from mechwright.contracts.bodies import placed
from mechwright.contracts.fit_settings import Fits
from mechwright.contracts.fits import between, hole_fit, running_hole, shaft_fit
from mechwright.contracts.holes import exchanged, hole
from mechwright.contracts.joint import GROUND, Joint
from mechwright.contracts.limits import limits
from mechwright.contracts.motion import Channel, Motion, Poses
from mechwright.contracts.named import Named
from mechwright.contracts.part import Bore, Instance, Part, Profile
from mechwright.contracts.turned import Step, Turned
from mechwright.errors import DesignError
from mechwright.geometry import Arc, Loop, Outline, circle
from mechwright.geometry.keyway import Opening
from mechwright.mechanics.mating.choice import Assembled
from mechwright.mechanics.mating.fitted import with_fits
from mechwright.pipeline import Build, Wanted
from mechwright.pipeline.fits import DeclaredFits, fit_findings
from mechwright.plugins.host import host
from mechwright.standards.bearings import bearings
from mechwright.standards.bushes import bush_for

ROOT = Path(__file__).parents[2]
PRINTED = tomllib.loads((ROOT / "tests/data/fits.toml").read_text())
SIZES = (2, 5, 8, 14, 24, 40)


@pytest.mark.parametrize("row", PRINTED["fits"], ids=lambda row: f"{row[0]} {row[1]}/{row[2]}")
def test_fits_are_those_of_handbooks(row):
    size, bore, shaft, hole_limits, shaft_limits, least, greatest = row
    wide, thin = limits(size, bore), limits(size, shaft)
    assert (list(wide), list(thin)) == (hole_limits, shaft_limits)
    assert (wide[0] - thin[1], wide[1] - thin[0]) == (least, greatest)


@pytest.mark.parametrize(("name", "rows"), PRINTED["classes"].items())
def test_classes_are_those_of_handbooks(name, rows):
    assert [list(limits(size, name)) for size in SIZES] == rows


@pytest.mark.parametrize("row", PRINTED["rings"], ids=lambda row: f"{row[0]} {row[1]}/{row[2]}")
def test_rings_are_no_h6_and_no_h7(row):
    name, shaft, housing, inner, outer = row
    bearing = next((one for one in bearings() if one.name == name), None)
    if bearing is None:
        pytest.skip(f"no bearing {name} in the table")
    bore, outside = bearing.bought.fits
    thin, wide = shaft_fit(bearing.bore, shaft), hole_fit(bearing.outside, housing)
    assert [1000 * (bore.lower - thin.upper), 1000 * (bore.upper - thin.lower)] == pytest.approx(inner)
    assert [1000 * (wide.lower - outside.upper), 1000 * (wide.upper - outside.lower)] == pytest.approx(outer)


@given(
    size=st.floats(1, 100), clearance=st.floats(0.003, 0.5), shaft=st.sampled_from(("h6", "g6", "f7", "js6"))
)
def test_a_running_hole_keeps_the_clearance_that_is_drawn(size, clearance, shaft):
    pin = shaft_fit(size, shaft)
    found = running_hole(size, clearance, pin)
    assert sum(found.limits) / 2 - sum(pin.limits) / 2 == pytest.approx(clearance, abs=1e-6)
    assert found.upper - found.lower == pytest.approx(limits(size, "H7")[1] / 1000, abs=2e-6)


def test_limits_of_no_class_have_no_name():
    assert between(26, -0.009, 0).text == "26 (-0.009/0)"
    assert running_hole(6, 0.03, shaft_fit(6, "h6")).short == "6 E7"


EXAMPLES = [
    "four-bar-machine.toml", "slider-crank-machine.toml", "five-bar-machine.toml", "elliptic-pair-machine.toml",
    "figure-eight-machine.toml", "spherical-machine.toml", "geneva-machine.toml", "cam-lever.toml",
    "planetary-gears.toml", "linkages/whitworth.toml", "chains/slider-behind-gears.toml",
]  # fmt: skip


@pytest.mark.parametrize("name", EXAMPLES)
def test_every_pair_of_an_example_has_limits_that_fit_what_it_does(name):
    design = mw.load(ROOT / "examples" / name)
    motion = design.design.solve(2)
    whole = Assembled(placed(design.parts, motion), motion)
    for match in whole.matches:
        pair = f"{whole.bodies[match.pin].part.name} in {whole.bodies[match.hole].part.name}: {match.text}"
        assert not match.missing_fits, pair
        bought = any(whole.bodies[k].part.bought is not None for k in (match.pin, match.hole))
        if not whole.same_group(match) and not bought:
            assert match.play[0] > 0, f"{pair} turns, and may jam"


def joined(**given):
    """Pairs of a four-bar machine with a table of fits to the classes of hole and pin."""
    design = mw.load(ROOT / "examples/four-bar-machine.toml").with_(**given)
    motion = design.design.solve(2)
    whole = Assembled(placed(design.parts, motion), motion)
    return {
        f"{whole.bodies[m.pin].part.name} in {whole.bodies[m.hole].part.name}": (
            m.inside.fit.short,
            m.outside.fit.short,
        )
        for m in whole.matches
    }


def test_the_table_chooses_the_classes():
    found = joined()
    assert found["shaft in crank"] == ("6 H7", "6 h6")
    assert found["pin-a in crank"] == ("6 P7", "6 h6")
    assert found["bushing in coupler"] == ("8 H7", "8 r6")
    assert found["pin-a in bushing"] == ("6 E7", "6 h6"), "the design's running fit of 0.03 mm"
    table = {"shaft": "g6", "running": "H7", "pressed": "N7", "hub": "K7", "bush": "s6", "housing": "H6"}
    found = joined(fits={**table, "of": {"pin-b in follower": "M7"}})
    assert found["shaft in crank"] == ("6 K7", "6 g6")
    assert found["pin-a in crank"] == ("6 N7", "6 g6")
    assert found["bushing in coupler"] == ("8 H6", "8 s6")
    assert found["pin-a in bushing"] == ("6 H7", "6 g6")
    assert found["pin-b in follower"] == ("6 M7", "6 g6")


@settings(max_examples=40)
@given(
    wider=st.floats(-0.02, 0.06),
    width=st.sampled_from((4.0, 5.0)),
    relief=st.sampled_from((0.0, 2.5)),
    turn=st.floats(-3.1, 3.1),
)
def test_a_keyed_bore_is_widened_with_its_keyway(wider, width, relief, turn):
    loop = Opening(12.0, width, relief).loop().moved(0.0, 0.0, turn)
    bore = Bore("bore", (0.0, 0.0), 12.0, 0, 10)
    whole = Outline(Loop((circle((0.0, 0.0), 20.0),)), (loop,))
    part = Part("gear", whole, 10.0, "steel", machined=(bore, Profile("keyway", loop, "inside", 0, 10)))
    made = exchanged(part, bore, replace(bore, diameter=12.0 + wider))
    for new in (made.outline.inner[0], hole(made, "bore") and made.features[1].loop):
        ends = [(one.end, two.start) for one, two in pairwise((*new.segments, new.segments[0]))]
        assert all(math.dist(*pair) < 1e-9 for pair in ends), "it stays closed"
        walls = [one for one in new.segments if isinstance(one, Arc) and math.dist(one.centre, (0, 0)) < 1e-9]
        assert [2 * one.radius for one in walls] == pytest.approx([12.0 + wider] * len(walls))
        deep = max(math.hypot(*point) for one in new.segments for point in one.at([0.0, 0.5, 1.0]))
        assert deep == pytest.approx(
            max(math.hypot(*point) for one in loop.segments for point in one.at([0.0, 0.5, 1.0]))
        ), "the keyway's floor stays"
    (x, y), r = (math.cos(turn + math.pi), math.sin(turn + math.pi)), 6.0 + wider / 2
    there = made.outline.polygon(1e-5)
    assert there.covers(shapely.Point(x * (r + 1e-4), y * (r + 1e-4)))
    assert not there.covers(shapely.Point(x * (r - 1e-4), y * (r - 1e-4)))


@pytest.mark.parametrize(
    ("table", "said"),
    [
        ({"running": "f7"}, "is a class of shafts; holes have capitals: F7"),
        ({"shaft": "H7"}, "is a class of holes; shafts have small letters: h7"),
        ({"pressed": "P77"}, "no tolerance class that is known"),
        ({"of": {"shaft": "N7"}}, "names no pair"),
        ({"of": {"shaft in crank": "n6"}}, "is a class of shafts"),
        ({"of": {"shaft in crank": 7}}, "is no text"),
        ({"of": 3}, r"write a table \[fits.of\]"),
        ({"of": {"shaft in drum": "N7"}}, "no part shaft goes into a part drum"),
    ],
)
def test_a_wrong_table_is_told_in_one_line(table, said):
    with pytest.raises(DesignError, match=said) as caught:
        _ = mw.load(ROOT / "examples/four-bar-machine.toml").with_(fits=table).parts
    assert "\n" not in str(caught.value)


def test_a_bought_part_without_limits_is_an_error_of_its_author():
    with Build(ROOT / "examples/four-bar-machine.toml", host(), Wanted("check")) as build:
        assert list(DeclaredFits().findings(build)) == []
        known = build.parts
        coupling = replace(known["coupling"].bought, fits=())
        silent = replace(known["coupling"], bought=coupling)
        build._kept["parts"] = Named(silent if part.name == "coupling" else part for part in known)
        found = DeclaredFits().findings(build)
    assert {one.code for one in found} == {"fit.missing"}
    assert found[0].message == (
        "shaft goes into coupling, ⌀6 / 6 h6, and coupling says no limits of its size"
    )


def elliptic(**fits):
    return mw.load(ROOT / "examples/elliptic-pair-machine.toml").with_(fits=fits)


def test_a_pair_that_is_named_gets_its_class_whatever_its_part_says():
    plate = elliptic().parts["lower-plate"]
    assert hole(plate, "bearing-2").fit.short == "26 H7"
    named = elliptic(of={"bearing-6000 in lower-plate": "J7"}).parts["lower-plate"]
    assert hole(named, "bearing-2").fit.short == "26 J7"
    assert hole(named, "bearing-2").diameter == pytest.approx(26 + (-0.009 + 0.012) / 2)
    assert hole(named, "column-1").fit.short == "8 H7", "the others stay"


def test_the_hole_of_a_bought_part_is_its_makers():
    with pytest.raises(DesignError, match=r"the hole of bearing-6000 is its maker's; leave the pair out"):
        _ = elliptic(of={"shaft-2 in bearing-6000": "J7"}).parts


@pytest.mark.parametrize(("running", "severity"), [("N7", "error"), ("J7", "warning"), ("H7", None)])
def test_a_pin_that_turns_and_may_jam_is_told(running, severity):
    design = mw.load(ROOT / "examples/four-bar-machine.toml").with_(fits={"running": running})
    motion = design.design.solve(2)
    found = list(fit_findings(Assembled(placed(design.parts, motion), motion)))
    assert {(one.code, one.severity) for one in found} == ({("fit.jams", severity)} if severity else set())
    for one in found:
        (change,) = one.proposed
        assert mw.load(ROOT / "examples/four-bar-machine.toml").design.changed(change).parts()


def test_a_pin_that_runs_in_a_bought_bush_is_not_called_pressed_in_its_plate():
    bush = Part("bush", None, 0.0, "steel", (Instance("b"),), bought=bush_for(6, 6).bought)
    pin = Part("pin", None, 0.0, "steel", (Instance("a"),), turned=Turned((Step(6.0, 14.0),)))
    disc = Outline(Loop((circle((0.0, 0.0), 20.0),)), (Loop((circle((0.0, 0.0), 3.0, clockwise=True),)),))
    plate = Part("plate", disc, 6.0, "steel", (Instance("a", 8.0),))
    still = Poses(np.zeros((2, 3)), np.tile(np.eye(3), (2, 1, 1)))
    turning = Channel(np.linspace(0.0, 1.0, 2), "rad")
    joints = {"a": Joint("revolute", GROUND, "a", (5.0, 0.0, 0.0))}
    motion = Motion("t", {"t": turning}, {"a": still, "b": still}, joints=joints)
    made = {part.name: part for part in with_fits([bush, pin, plate], motion, Fits())}
    assert made["pin"].turned.steps[0].fit.short == "6 f7"
    assert hole(made["plate"], "bore-1").fit.short == "6 H7", "P7 on f7 would hold nothing"
    alone = {part.name: part for part in with_fits([pin, plate], motion, Fits())}
    assert alone["pin"].turned.steps[0].fit.short == "6 h6"
    assert hole(alone["plate"], "bore-1").fit.short == "6 P7"
