"""Moves straight down in what one cut has bored: told as a search through all earlier cuts tells them."""

import numpy as np
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shop import MILL
from test_proof_parts import coordinate, cuts, height, paths_of

from mechwright_cam.proof.bored import bored, distance
from mechwright_cam.proof.paths import Paths
from mechwright_cam.shop.cutter import cutter
from mechwright_cam.shop.tool import Tool, ToolKind

BALL = MILL.model_copy(update={"kind": ToolKind.BALL})
BULL = MILL.model_copy(update={"kind": ToolKind.BULL_NOSE, "corner_radius": 1.0})
DRILL = MILL.model_copy(update={"kind": ToolKind.DRILL})
SLACK = 1e-3
"""Distances that differ by less may be told either way, mm: chords of arcs, and inexact arcs."""


def searched(paths: Paths, step: int, lift: float, radius: float, slack: float) -> bool:
    """Whether any cut before a step has taken a cylinder, with distances so much larger."""
    z = paths.low[step] + lift
    for cut in paths.cuts[paths.cuts < step].tolist():
        above = z - max(paths.start[cut, 2], paths.end[cut, 2])
        if above < -1e-6:
            continue
        line = paths.lines(paths.whole(np.array([cut])))[0]
        wide = cutter(paths.tools[int(paths.run.tool[cut])]).radius_at(above)
        if shapely.distance(line, shapely.Point(paths.end[step, :2])) + slack + radius <= wide:
            return True
    return False


@given(
    text=cuts(),
    more=st.lists(st.tuples(coordinate, coordinate, height, st.booleans()), min_size=1, max_size=6),
    tool=st.sampled_from([MILL, BALL, BULL, DRILL]),
    lift=st.sampled_from([0.0, 0.01, 1.5]),
    radius=st.sampled_from([0.3, 1.5, 2.9]),
    near=st.booleans(),
)
@settings(max_examples=80, deadline=None)
def test_it_is_what_a_search_finds(text, more, tool: Tool, lift: float, radius: float, near: bool) -> None:  # type: ignore[no-untyped-def]
    run = paths_of(text, tool)
    lines = [text]
    for x, y, z, again in more:
        if near:  # close to where a cut has ended
            end = run.end[run.cuts[int(abs(x) * 100) % run.cuts.size]]
            x, y, z = end[0] + y / 10, end[1] + x / 10, min(end[2] + abs(y) / 10, 0.0)
        lines += [f"G0 Z5\nG0 X{x:.4f} Y{y:.4f}\nG1 Z{z:.4f}"] * (2 if again else 1)
    paths = paths_of("\n".join(lines), tool)
    found = bored(paths, paths.cuts, paths.cuts, lift=lift, radius=radius)
    way = paths.end - paths.start
    for step, told in zip(paths.cuts.tolist(), found.tolist(), strict=True):
        straight = np.hypot(*way[step, :2]) < 1e-6 and np.isnan(paths.run.centre[step, 0])
        if not straight or not searched(paths, step, lift, radius, -SLACK):
            assert not told
        elif searched(paths, step, lift, radius, SLACK):
            assert told


@given(cuts(), coordinate, coordinate)
@settings(max_examples=60, deadline=None)
def test_distances_from_lines_and_arcs(text: str, x: float, y: float) -> None:
    paths = paths_of(text)
    places = np.tile((x, y), (paths.cuts.size, 1))
    lines = paths.lines(paths.whole(paths.cuts))
    true = shapely.distance(lines, shapely.Point(x, y))
    np.testing.assert_allclose(distance(paths, paths.cuts, places), true, atol=SLACK)


def test_a_place_is_known_however_many_cuts_there_are() -> None:
    """A place in a hole, and one on long cuts, among some ten thousand pairs of place and cut."""
    hole = "F100\nG0 X2 Y0\nG1 Z-3\nG3 I-2\nG0 Z5\n"
    beside = "".join(f"G0 X-50 Y{20 + k}\nG1 Z-3\nX50\nG0 Z5\n" for k in range(120))
    again = "".join(f"G0 X{k} Y25\nG1 Z-2\nG0 Z5\n" for k in range(-45, 46))
    paths = paths_of(hole + beside + "G0 X0 Y0\nG1 Z-2\nG0 Z5\n" + again)
    down = paths.cuts[-92:]
    assert bored(paths, paths.cuts, down, lift=0.0, radius=0.9).all()
    assert not bored(paths, paths.cuts, down, lift=-1.5, radius=0.9).any()


def test_a_cylinder_as_wide_as_the_cutter_goes_where_its_middle_has_been_and_a_wider_one_nowhere() -> None:
    paths = paths_of("G0 X-9\nG1 Z-3 F100\nX9\nG0 Z5\nG0 X5 Y0\nG1 Z-2\nG0 Z5\nG0 X5 Y1\nG1 Z-2")
    down = paths.cuts[2:]
    for radius, told in ((1.99, [True, True]), (2.01, [True, False]), (2.9, [True, False]), (3.0, [True, False]),
                         (3.01, [False, False])):  # fmt: skip
        assert bored(paths, paths.cuts, down, lift=0.0, radius=radius).tolist() == told, radius
    for lift, told in ((-1.0, True), (-1.01, False)):
        assert bored(paths, paths.cuts, down, lift=lift, radius=2.9).tolist() == [told, False]
