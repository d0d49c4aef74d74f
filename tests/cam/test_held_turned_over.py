"""The pieces of a plate that has been turned over: it begins with what the first setup has left."""

import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import shapely
from by_control import BY_NAME
from by_night import by_night
from planning_parts import LIBRARY, bore, rounded_box

from mechwright.contracts.finding import errors
from mechwright.contracts.part import Bore, Feature, Part, Pocket, Profile
from mechwright.errors import ProofError
from mechwright.geometry import Loop, Outline, circle
from mechwright_cam.machining import Machined, machine, second_setup
from mechwright_cam.planning.setups import lay_out_setups
from mechwright_cam.proof import Check, Scene
from mechwright_cam.proof.finished import finished_bodies
from mechwright_cam.proof.footprint import BEFORE, NEVER
from mechwright_cam.proof.holding import holding, remarks
from mechwright_cam.setup.job import Air, Job
from mechwright_cam.setup.turned import TurnedOver
from mechwright_cam.setup.views import inside_of
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool

THICKNESS = 8.0
HOLE = Bore("bore", (-18.0, 0.0), 10.0, 0.0, THICKNESS)
OUTSIDE = Profile("outside", rounded_box(60, 40, 6), "outside", 0.0, THICKNESS)
WINDOW = Pocket("window", rounded_box(16, 16, 3).moved(8, 0), (), 0.0, 5.0)
BELOW = Pocket("below", rounded_box(20, 20, 3).moved(8, 0), (), 4.5, 3.5)


def both(*features: Feature, outline: Outline | None = None) -> tuple[Machined, Job]:
    """The first side of a plate, proven, and the job of the second with what it leaves."""
    outline = outline or Outline(rounded_box(60, 40, 6), (bore(10.0, (-18.0, 0.0)),))
    part = Part("plate", outline, THICKNESS, "aluminium", machined=(HOLE, *features, OUTSIDE))
    settings = CamSettings.model_validate({"tools": ("spot-6", "drill-8", "mill-6", "mill-4")})
    jobs, found = lay_out_setups(part, settings, LIBRARY)
    assert not errors(found), found
    first = machine(jobs[0], BY_NAME["linuxcnc"])
    return first, second_setup(first, jobs[1])


@cache
def meeting() -> Job:
    """A recess of 20 mm that breaks through into one of 16 mm above it."""
    return both(WINDOW, BELOW)[1]


def tool_of(of: Job) -> Tool:
    return next(tool for tool in of.tools if tool.name == "mill-4")


def middle(of: Job) -> tuple[float, float]:
    """Of the recess of the second side."""
    x, y = inside_of(of.features[0]).centroid.coords[0]
    return x, y


def scene(moves: str, of: Job) -> Scene:
    """A second program with the 4 mm mill; X0 Y0 of the moves is the middle of its recess."""
    x, y = middle(of)
    placed = re.sub(
        r"([XY])(\S+)", lambda word: f"{word[1]}{float(word[2]) + (x if word[1] == 'X' else y):.4f}", moves
    )
    head = f"G17 G21 G40 G49 G80 G90\nG53 G0 Z0\nT{tool_of(of).number} M6\nG55 S8000 M3\n"
    return Scene(f"{head}{placed}\nM30\n", of, BY_NAME["linuxcnc"])


def judged(moves: str, of: Job) -> Check:
    return holding(scene(moves, of))


def around(half: float, z: float) -> str:
    """Once around a square, down and up again: 9 lines, the last side in the eighth."""
    up, down = half, -half
    sides = f"X{up} F400\nY{up}\nX{down}\nY{down}"
    return f"G0 X{down} Y{down}\nG43 Z5\nZ1\nG1 Z{z} F100\n{sides}\nG0 Z5\n"


def test_a_slug_over_air_is_told_and_may_not_be_passed() -> None:
    """Its recess meets that from above: cut around, its middle falls out long before the plate's thickness."""
    once = around(6.0, -3.1)
    assert judged(once, meeting()).passed
    (note,) = remarks(scene(once, meeting()))
    found = re.match(r"a piece of (\d+) mm² comes loose in below, at .*; no cutter comes near", note)
    assert found is not None
    assert int(found[1]) == pytest.approx(64, rel=0.15)
    again = judged(once + around(6.0, -3.1), meeting())
    assert not again.passed
    assert again.line == 17  # down to where it lies
    assert f"T{tool_of(meeting()).number} passes a piece of" in again.message
    assert "in below" in again.message
    assert "that comes loose at line 12; leave it joined to the rest, or stop with M0" in again.message
    stop = "M5\n(take the slug out)\nM0\nS8000 M3\n"
    assert judged(once + stop + around(6.0, -3.1), meeting()).passed
    assert judged(around(6.0, -2.7) * 2, meeting()).passed  # 0.3 mm of it stay
    assert not judged(around(6.0, -2.9) * 2, meeting()).passed  # a skin holds nothing
    assert judged(once * 2, replace(meeting(), gone=())).passed  # into a full plate it is no way through


def test_what_lies_loose_from_the_first_side_is_no_more_there() -> None:
    """A piece that the first side has cut around, and nobody cuts away, falls out when the plate is lifted."""
    of = meeting()
    ring = shapely.Point(middle(of)).buffer(12.0).difference(shapely.Point(middle(of)).buffer(8.0))
    slug = replace(of, gone=(*(a for a in of.gone if a.top < 0), Air(ring, 0.0)))
    assert any("comes loose" in note and "when the plate is turned over" in note for note in told(slug))
    assert not told(of)


def told(of: Job) -> list[str]:
    return remarks(scene("G0 Z5", of))


def test_a_part_that_the_setup_before_has_freed_is_told_of() -> None:
    of = meeting()
    channel = of.body.buffer(4.0).difference(of.body)
    assert isinstance(of.part, TurnedOver)
    bare = replace(of.part, frame=replace(of.part.frame, holds=shapely.Polygon()))
    assert judged("G0 Z5", replace(of, gone=(Air(channel, 0.0),))).passed
    found = judged("G0 Z5", replace(of, part=bare, gone=(Air(channel, 0.0),)))
    assert not found.passed
    assert "the part comes loose" in found.message


RING = Pocket(
    "ring", Loop((circle((8.0, 0.0), 14.0),)), (Loop((circle((8.0, 0.0), 7.0, clockwise=True),)),), 0, 5
)
MEETS = Pocket("meets", Loop((circle((8.0, 0.0), 9.0),)), (), 3.0, 5.0)
BESIDE = Pocket(
    "beside",
    Loop((circle((8.0, 0.0), 19.0),)),
    (Loop((circle((8.0, 0.0), 14.0, clockwise=True),)),),
    3.0,
    5.0,
)


@pytest.mark.parametrize("below", [MEETS, pytest.param(BESIDE, marks=by_night)])
def test_a_core_that_both_sides_cut_free_is_refused_with_the_line(below: Pocket) -> None:
    """Where the recesses overlap, and where they only touch: there no place of the plate is cut through."""
    _, job = both(RING, below)
    with pytest.raises(ProofError, match=r"\[holding\]: line \d+: the part comes loose: nothing holds it"):
        machine(job, BY_NAME["linuxcnc"])
    assert len(finished_bodies(job)) == 2
    _, shallow = both(RING, replace(below, top=6.5, depth=1.5))
    assert len(finished_bodies(shallow)) == 1


def across(x: float, top: float) -> Pocket:
    return Pocket("above" if top == 0 else "below", rounded_box(8, 60, 2.5).moved(x, 0), (), top, 5.0)


def test_a_part_in_two_halves_is_refused_though_each_hangs_in_its_tabs() -> None:
    _, job = both(across(9.0, 0.0), across(17.0, 3.0))
    with pytest.raises(ProofError, match="the recesses of both sides cut the part into 2 pieces, one of"):
        machine(job, BY_NAME["linuxcnc"])


@by_night
def test_advice_about_a_part_in_two_halves_helps() -> None:
    _, apart = both(across(9.0, 0.0), across(18.0, 3.0))  # a wall of 1 mm joins the two floors
    assert machine(apart, BY_NAME["linuxcnc"]).proof.ok


def test_the_plate_begins_as_the_first_side_has_left_it() -> None:
    first, job = both(WINDOW, BELOW)
    found = scene("G0 Z5", job).footprint
    was = first.scene.footprint
    assert found.cut.shape == was.cut.shape
    # Turned over about X: rows run the other way. Cells at an edge differ by how it is rounded.
    over, before = found.cut[::-1] == BEFORE, was.cut < NEVER
    assert np.count_nonzero(over != before) < 0.05 * np.count_nonzero(before)
    assert set(np.unique(found.cut)) == {BEFORE, NEVER}
