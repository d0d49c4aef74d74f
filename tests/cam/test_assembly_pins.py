"""What the guide of assembly says of pins, of rings that are chosen, and of the motor's coupling."""

import re

import pytest
from by_night import by_night
from test_assembly_guide import EXAMPLES, told

from mechwright import Instance, Part
from mechwright.contracts.fits import hole_fit, shaft_fit
from mechwright.contracts.part import Bore
from mechwright.contracts.turned import Step, Turned
from mechwright.geometry import Loop, Outline, circle
from mechwright.pipeline import Build, Wanted
from mechwright.plugins.host import host
from mechwright_cad.assembly_guide.page import AssemblyGuide


def disc(name, body, z, thickness, *bores):
    """A round plate of 60 mm with holes of (name, x, size, class); None for no class."""
    rim = Loop((circle((0.0, 0.0), 30.0),))
    found = []
    for hole, x, size, kind in bores:
        fit = hole_fit(size, kind)
        found.append(Bore(hole, (x, 0.0), fit.middle, 0.0, thickness, fit))
    loops = tuple(Loop((circle(one.centre, one.diameter / 2, clockwise=True),)) for one in found)
    cut = (*found,)
    return Part(name, Outline(rim, loops), thickness, "aluminium", (Instance(body, z),), machined=cut)


def peg(low, high, head=0.0, body="still"):
    """A pin of 8 h6 from low to high, with a head above it."""
    steps = [Step(8.0, high - low, shaft_fit(8.0, "h6"))] + ([Step(14.0, head)] if head else [])
    return Part("peg", None, 0.0, "steel", (Instance(body, low),), turned=Turned(tuple(steps)))


@pytest.mark.parametrize(
    ("low", "high", "head", "said"),
    [
        (0.0, 25.0, 0.0, "Press it until peg (2) stands 15.0 mm out of plate (1)."),
        (0.0, 10.0, 0.0, "Press it until the end of peg (2) is flush with plate (1)."),
        (0.0, 9.0, 0.0, "Press it until the end of peg (2) lies 1.0 mm below the face of plate (1)."),
        (0.0, 10.0, 4.0, "Its shoulder rests on plate (1)."),
    ],
)
def test_a_step_says_how_deep_a_pin_is_pressed(low, high, head, said):
    plate = disc("plate", "still", 0.0, 10.0, ("bore-1", 0.0, 8.0, "P7"))
    ((words, _),) = told((plate, peg(low, high, head)), still=("still",))
    assert said in words
    assert words.count("until") == (0 if head else 1)


def test_a_pin_that_slides_is_told_no_depth():
    plate = disc("plate", "still", 0.0, 10.0, ("bore-1", 0.0, 8.0, "F7"))
    ((words, _),) = told((plate, peg(0.0, 25.0, body="other")), still=())
    assert "until" not in words


@pytest.mark.parametrize(
    ("others", "empty"), [((), None), ((12.0,), "bore-2 stays"), ((12.0, -12.0), "bore-2 and bore-3 stay")]
)
def test_a_step_names_the_hole_where_others_alike_stay_empty(others, empty):
    bores = [
        ("bore-1", 0.0, 8.0, "P7"),
        *((f"bore-{k}", x, 8.0, "P7") for k, x in enumerate(others, start=2)),
    ]
    plate = disc("plate", "still", 0.0, 10.0, *bores, ("wide", 22.0, 9.0, "P7"))
    ((words, _),) = told((plate, peg(0.0, 25.0)), still=("still",))
    if empty is None:
        assert "stay" not in words
    else:
        assert (
            f"peg (2) goes into the hole bore-1 of plate (1), at x 0.0, y 0.0 mm in its drawing; {empty} empty in this "
            "setting."
        ) in words


@by_night
def test_an_adjustable_five_bar_says_holes_and_heads_that_leave_play():
    with Build(EXAMPLES / "five-bar-three-phases.toml", host(), Wanted("model")) as build:
        page = AssemblyGuide().files(build)["assembly.html"]
    assert "goes into the hole bore-2 of coupler" in page
    assert "bore-3, bore-4, bore-6 and bore-7 stay empty in this setting" in page
    assert "a feeler gauge of 0.1 mm just passes between its shoulder and bushing" in page
    assert "until the end of shaft-a0 (8) is flush with crank" in page


def test_rings_are_left_out_until_their_play_is_measured_and_hubs_are_bonded_after():
    """The order of a fitter: hub dry, no ring, circlip, measure; and a float with the plate's screws in."""
    with Build(EXAMPLES / "geneva-machine.toml", host(), Wanted("model")) as build:
        page = AssemblyGuide().files(build)["assembly.html"]
    text = re.sub(r"<svg.*?</svg>", "", page, flags=re.DOTALL)
    steps = [re.sub(r"<[^>]+>|\\s+", " ", one) for one in re.split(r"<h3", text)[1:]]
    said = dict(enumerate(steps, start=1))
    hub = next(n for n, one in said.items() if "play of the hub on shaft-wheel with a dial gauge" in one)
    bonded = next(
        n
        for n, one in said.items()
        if f"bond it with retaining compound, once step {hub} has chosen the rings" in one
    )
    left = [n for n, one in said.items() if f"back: step {hub} measures" in one]
    assert bonded < left[0] < hub
    assert "circlip-10" in said[hub]
    floats = next(n for n, one in said.items() if "measure the float of shaft-driver" in one)
    assert "only until its head rests" in said[floats], "the plate is held while its shafts are pushed"
    assert sum(f"back: step {floats} measures" in one for one in steps) == 2
    crank = next(one for one in steps if "Turn the crank on the locking disc" in one)
    assert "retaining compound" in crank
    fastens = next(one for one in steps if "shift the motor" in one)
    assert fastens.index("shift the motor") < fastens.index("tighten to 5.4")
    assert "Check the gap of the shafts" not in page
    assert "goes 13.5 mm into coupling" in " ".join(steps)
    assert "Lay the whole on its side for it" in steps[-1]
