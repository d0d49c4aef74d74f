"""The setup sheet: offsets to type in, tools by hand, and where no clamp may be."""

import math
import re
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from by_control import setup_html
from hypothesis import given
from hypothesis import strategies as st
from planning_parts import bore, job, plate
from shop import MILL, plate_job, plate_program

from mechwright.plugins.host import host
from mechwright_cam.controls.contract import Control
from mechwright_cam.machining import machine
from mechwright_cam.pages.picture import isometric, paths
from mechwright_cam.pages.setup_sheet.facts import reach
from mechwright_cam.pages.trace import Stroke, trace
from mechwright_cam.program.moves import FeedArc, Operation, Program, Rapid, ToolSection
from mechwright_cam.shop.posting import Measured


def page(control: str, **settings: object) -> str:
    made = machine(
        job(plate(bore(12.0)), "drill-8", "mill-6", control=control, **settings), host().get(Control, control)
    )
    return setup_html(made.job, made.program, made.proof.as_dict(), files=list(made.files))


def test_offsets_that_are_known_stand_on_the_sheet() -> None:
    measured = {"x": -300.5, "y": -120.25, "z": -210.125, "lengths": {"mill-6": 77.5, "drill-8": 101.0}}
    known = page("haas", measured=measured, post={"offsets": True})
    for words in (
        "-300.500",
        "-120.250",
        "-210.125",
        "77.500, as measured",
        "101.000, as measured",
        "by itself (G10)",
    ):
        assert words in known
    plain = page("haas")
    assert "as measured" not in plain
    assert "N − h, once" in plain
    assert "by itself" not in plain


def test_tools_are_changed_and_touched_off_by_hand_on_grbl() -> None:
    found = page("grbl")
    assert "touched off one by one" in found
    assert "G43 H" not in found.partition("<footer>")[0]
    assert "Offsets to type in" not in found
    assert "run them in order" in page("grbl", post={"tool_change": "files"})
    lengths = {"lengths": {"mill-6": 77.5, "drill-8": 101.0}}
    assert "are in the program (G43.1)" in page("grbl", measured=lengths)


def test_every_file_of_a_program_is_named_and_timed() -> None:
    found = page("grbl", post={"tool_change": "files"})
    names = re.findall(r"plate-\d-t\d+\.nc", found.partition("Load ")[2].partition("one after the other")[0])
    assert len(names) >= 2
    assert [name[6] for name in names] == [str(number) for number in range(1, len(names) + 1)]
    assert f"{names[0]} to {names[-1]}" in found
    assert "plate.nc" not in found
    assert "Before each file load the tool" in found
    assert "At each stop" not in found
    assert "Do not touch it again" not in found
    # Each operation has its time: it is that of the tool that cuts, not of the next file's.
    table = found.partition("<h2>Operations</h2>")[2].partition("</table>")[0]
    assert "–" not in re.sub(r"<tr class=.stop.*", "", table)
    one = page("grbl", post={"tool_change": "pause"})
    assert "Load plate.nc" in one
    assert "At each stop load the tool" in one


def test_no_clamp_where_cutters_run() -> None:
    program = plate_program()
    x0, y0, x1, y1 = reach(trace(program))
    edge = 30 + 2 * MILL.radius + 0.001
    assert (x0, x1) == pytest.approx((-edge, edge))
    assert (y0, y1) == pytest.approx((-edge + 10, edge - 10))
    found = setup_html(plate_job(), program, None)
    assert "Cutters run from X −36.0 to +36.0 and Y −26.0 to +26.0" in found


@given(st.floats(-math.pi, math.pi), st.floats(0.1, 6.2), st.booleans(), st.tuples(*[st.floats(-50, 50)] * 2))
def test_any_arc_reaches_as_far_as_its_points_and_the_tool(first, turn, ccw, centre) -> None:
    angles = first + np.linspace(0, turn if ccw else -turn, 2001)
    way = np.column_stack((np.cos(angles), np.sin(angles))) * 10 + centre
    stroke = Stroke((*way[0].tolist(), -1.0), (*way[-1].tolist(), -1.0), -1.0, 300.0, centre, ccw)
    traced = SimpleNamespace(section=SimpleNamespace(tool=SimpleNamespace(radius=2.0)), strokes=(stroke,))
    wanted = (*(way.min(axis=0) - 2.0), *(way.max(axis=0) + 2.0))
    assert reach([traced]) == pytest.approx(wanted, abs=1e-4)
    assert reach([SimpleNamespace(section=traced.section, strokes=(replace(stroke, feed=0.0),))]) is None


@pytest.mark.parametrize("ccw", [True, False])
def test_an_arc_reaches_as_far_as_it_turns(ccw: bool) -> None:
    start, end = (10.0, 0.0), (10 * math.cos(2), 10 * math.sin(2))
    arc = FeedArc(*end, None, -10, 0, ccw, 100)
    section = ToolSection(MILL, 1, "off", (Operation("o", (Rapid(*start, -1), arc)),))
    x0, y0, x1, y1 = reach(trace(Program("p", "G54", 5.0, (section,))))
    r = MILL.radius
    assert (y1, y0) == pytest.approx((10 + r, -r) if ccw else (end[1] + r, -10 - r))
    assert (x1, x0) == pytest.approx((10 + r, end[0] - r) if ccw else (10 + r, -10 - r))
    assert Measured() == replace(Program("p", "G54", 5.0, (section,))).measured


def test_what_a_picture_draws_of_a_path_are_cuts_rapids_and_holes_each_once() -> None:
    def stroke(start, end, feed=300.0, **more):
        return Stroke((*start, -1.0), (*end, -1.0), -1.0, feed, **more)

    cut, rapid = stroke((0.0, 0.0), (10.0, 0.0)), stroke((10.0, 0.0), (20.0, 5.0), 0.0)
    turn = stroke((10.0, 0.0), (10.0, 10.0), centre=(10.0, 5.0), ccw=True)
    hole = stroke((30.0, 2.0), (30.0, 2.0), drilled=True)
    cuts, rapids, holes = paths._path_data(
        [SimpleNamespace(strokes=(cut, rapid, cut)), SimpleNamespace(strokes=(turn, hole, hole))]
    )
    assert cuts.startswith("M0,0L10,0A5 5 ")
    assert cuts.count("L") == cuts.count("A") == cuts.count("M") == 1
    assert rapids == "M10,0L20,-5"
    assert holes == [(30.0, 2.0)]


def test_axes_of_the_slanted_view_go_as_a_point_on_them_does() -> None:
    drawn = isometric._axes(100.0, 3.0)
    lines = re.findall(r"M([-\d.]+),([-\d.]+)L([-\d.]+),([-\d.]+)", drawn)
    assert len(lines) == 3
    seen = isometric._projected(np.eye(3)) - isometric._projected(np.zeros((1, 3)))
    for line, (u, v) in zip(lines, seen, strict=True):
        x0, y0, x1, y1 = map(float, line)
        dx, dy = x1 - x0, y1 - y0
        assert abs(dx * v - dy * u) < 0.02 * math.hypot(dx, dy) or abs(dx * v + dy * u) < 0.02 * math.hypot(
            dx, dy
        )
