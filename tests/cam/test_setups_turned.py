"""How the operator turns a plate over, and where its second side is found."""

import re
from dataclasses import replace

import pytest
import shapely
from by_control import setup_html, steps
from by_night import by_night
from planning_parts import LIBRARY, bore, rounded_box
from test_setups import CORNER, THICKNESS, both, cam, counterbored, part

from mechwright.contracts.finding import errors
from mechwright.contracts.part import Bore, Instance
from mechwright.geometry import Outline
from mechwright_cam.planning import plan
from mechwright_cam.planning.setups import lay_out_setups, turned_shape


def test_the_setup_sheet_says_how_to_turn_the_plate_over() -> None:
    for locate, words in (
        ("bore", "Its axis is X +12.00, Y −4.00 in G55"),
        ("edges", "on the rear edge Y +"),
        ("dowels", "The dowels are at X −"),
    ):
        hole = Bore("larger", (12.0, 4.0), 14.0, 0.0, THICKNESS)
        outline = Outline(rounded_box(60, 40, 6), (bore(10.0), bore(14.0, (12.0, 4.0))))
        two = replace(part(hole, CORNER), outline=outline)
        jobs, found = lay_out_setups(two, cam(second_side={"locate": locate, "flip": "x"}), LIBRARY)
        assert not errors(found)
        made = steps(jobs[1], [3], file_names=["bracket-underside.nc"], deepest=-3.0)
        said = " ".join([step.title for step in made] + [line for step in made for line in step.lines])
        assert "Turn the plate over about the X axis: its front edge goes to the rear" in said
        assert words in said, said
        assert "G10 L2 P2 Z" in said
        assert ("Indicate what was the rear edge, now in front" in said) == (locate != "dowels")


@pytest.mark.parametrize("flip", ["x", "y"])
@pytest.mark.parametrize("origin", ["axis", "corner", "centre"])
def test_both_sides_are_found_from_the_same_two_edges_of_a_plate_of_any_size(flip, origin) -> None:
    wanted = cam(origin=origin, second_side={"locate": "edges", "flip": flip})
    jobs, found = lay_out_setups(part(CORNER), wanted, LIBRARY)
    assert not errors(found)
    corner = turned_shape(shapely.Point(jobs[0].datum), *jobs)
    assert (corner.x, corner.y) == pytest.approx(jobs[1].datum)
    page = setup_html(jobs[1], plan(jobs[1]), None)
    assert ("Left edge of stock", "Right edge of stock")[flip == "y"] in page
    assert "part 60" not in page, "the part is not what the plate has turned into"


@pytest.mark.parametrize(
    "control", ["linuxcnc", *(pytest.param(one, marks=by_night) for one in ("fanuc", "haas")), "mach3"]
)
def test_the_place_of_the_first_side_is_not_written_into_the_offset_of_the_second(control) -> None:
    tools = ("spot-6", "drill-8", "mill-6", "mill-4")
    places = {"x": -300.0, "y": -200.0, "z": -380.0, "lengths": dict.fromkeys(tools, 77.0)}
    given = {"x": -310.0, "y": -210.0, "z": -381.0}
    for side, setting in (({}, None), (given, "G10 L2 P2 X-310 Y-210 Z-381")):
        wanted = {"locate": "edges", **side}
        first, second = both(
            part(CORNER), control=control, post={"offsets": True}, measured=places, second_side=wanted
        )
        assert re.search(r"G10 L2 P1 X-300\.? Y-200\.? Z-380", first.text)
        found = re.findall(r"G10 L2 .*", second.text)
        assert [line.replace(".", "") for line in found] == ([setting] if setting else [])


def test_every_turned_plate_is_picked_up_but_on_dowels() -> None:
    three = replace(part(CORNER), instances=(Instance("a"), Instance("b"), Instance("c")))
    for locate, words in (
        ("bore", "Make 3. Pick up G55 X and Y on every further plate"),
        ("dowels", "Make 3. A further plate on the same dowels keeps G55 X and Y"),
    ):
        jobs, _ = lay_out_setups(three, cam(second_side={"locate": locate}), LIBRARY)
        said = steps(jobs[1], [3], file_names=["bracket-underside.nc"], deepest=-3.0)[-1].lines
        assert any(words in line for line in said), said


def test_the_picture_of_the_underside_shows_what_is_gone() -> None:
    _, second = counterbored()
    page = setup_html(second.job, second.program, second.proof.as_dict())
    assert "its frame, turned over" in page
    without = setup_html(replace(second.job, gone=()), second.program, None)
    assert page.count('fill="#ffffff" fill-rule="evenodd"') == 1
    assert 'fill="#ffffff" fill-rule="evenodd"' not in without
