"""Round-ended mills where their noses do not fit in whole, or where sharper mills go as well."""

import math
from dataclasses import replace

import numpy as np
import pytest
import shapely
from by_control import asked, prove
from by_night import NIGHT, by_night, thinned
from height_map import read
from round_parts import LIBRARY, OUTSIDE, WIDE, box, cut, failed, laid, made, operations, stadium

from mechwright.contracts.part import OpenProfile, Pocket
from mechwright.errors import ToolError
from mechwright.geometry import Arc, Line, Loop, circle
from mechwright_cam.controls.linuxcnc import LinuxCnc
from mechwright_cam.planning import plan
from mechwright_cam.program.moves import Move
from mechwright_cam.shop.cutter import cutter
from mechwright_cam.shop.tool import Tool

DEPTHS = (0.3, 0.6, 0.68, 0.9, 0.99, 1.05, 1.5, 2.0)
SQUARE = Loop.polygon([(-15, -12), (15, -12), (15, 12), (-15, 12)])


def like(other: str, **changes: object) -> Tool:
    """A cutter of the library, changed."""
    return Tool.model_validate({**LIBRARY.get(other).model_dump(exclude_unset=True), **changes})


FINE = like("bull-6-r1", name="bull-4-r1.5", number=150, diameter=4, corner_radius=1.5)
BALL = like("ball-6", name="ball-4", number=154, diameter=4, flute_length=16)
MORE = LIBRARY.extended((FINE,))


@pytest.mark.parametrize(
    ("depth", "tools"),
    thinned(2, DEPTHS if NIGHT else DEPTHS[::3], [("bull-6-r1",), ("ball-6",), ("mill-16", "bull-6-r1")]),
)
def test_the_mouth_of_a_shallow_recess_is_to_size(depth: float, tools: tuple[str, ...]) -> None:
    """At the top of the wall the mill is √(c² - (c - t)²) wide beyond its flat, and so near it goes."""
    job = laid(Pocket("recess", SQUARE, (), 0.0, depth), OUTSIDE, tools=tools)
    text, proof = made(job)
    assert failed(proof) == []
    shape = cutter(LIBRARY.get(tools[-1]))
    wide = float(shape.radius_at(depth))
    foot = float(shape.radius_at(0.01))
    # In a corner the mill stands so far off both walls.
    assert proof.unreachable_max_mm == pytest.approx(wide - foot / math.sqrt(2), abs=0.005)
    mouth = shapely.Polygon(SQUARE.flatten())
    simulation = cut(text, job)
    reached = mouth.buffer(-wide).buffer(wide).buffer(-0.02)
    assert len(simulation.left(reached, -0.002)) == 0
    assert len(simulation.left(mouth.buffer(-wide).buffer(foot - 0.05), 0.012 - depth)) == 0


def test_a_mill_that_keeps_its_full_radius_off_a_shallow_wall_leaves_stock() -> None:
    shallow = Pocket("recess", SQUARE, (), 0.0, 0.3)
    job = laid(shallow, tools=("bull-6-r1",))
    lack = 3 - float(cutter(LIBRARY.get("bull-6-r1")).radius_at(0.3))
    assert lack == pytest.approx(0.2859, abs=1e-4)
    small = Loop.polygon(
        [(-15 + lack, -12 + lack), (15 - lack, -12 + lack), (15 - lack, 12 - lack), (-15 + lack, 12 - lack)]
    )
    text, _ = made(laid(Pocket("recess", small, (), 0.0, 0.3), tools=("bull-6-r1",)))
    found = asked("leftover", text, job)
    assert not found.passed
    assert found.value == pytest.approx(math.sqrt(2) * lack, abs=0.01)  # in the corners


def test_a_higher_wall_beside_a_shallow_recess_holds_the_mill_off() -> None:
    """The lower recess shares a wall with the upper one: there the mill is wider, at the plate's top."""
    upper = Pocket("upper", SQUARE, (), 0.0, 2.0)
    lower = Pocket("lower", Loop.polygon([(-15, -12), (0, -12), (0, 12), (-15, 12)]), (), 2.0, 0.3)
    for tools in (("bull-6-r1",), ("ball-6",)):
        job = laid(upper, lower, tools=tools)
        text, proof = made(job)
        assert failed(proof) == []
        wide = float(cutter(LIBRARY.get(tools[0])).radius_at(2.3))
        low = np.concatenate([move.points for move in read(text)])
        low = low[low[:, 2] < -2.29]
        assert low[:, 0].min() == pytest.approx(wide - 15, abs=0.003)


def test_a_shallow_groove_lowers_the_wall_of_a_deeper_recess() -> None:
    """Below the groove the wall is lower than the nose, beside it higher: the mill goes as near as each lets it."""
    recess = Pocket("recess", box(6, 6, 2.2), (), 0.0, 2.1)
    groove = Pocket(
        "groove", Loop.polygon([(-40, -3.3), (0, -3.3), (0, 3.3), (-40, 3.3)]).moved(-1, 0, 0.1), (), 0.0, 0.9
    )
    ball = like("ball-6", name="ball-4", number=153, diameter=4)
    job = laid(recess, groove, tools=("ball-4",), library=MORE.extended((ball,)))
    _, proof = made(job)
    assert failed(proof) == []


@pytest.mark.parametrize("wide", [8, 10])
def test_a_mill_without_room_for_chips_levels_what_a_bull_nose_leaves(wide: int) -> None:
    tight = Pocket("recess", Loop((circle((0, 0), 5.17),)), (), 0.0, 2.0)
    job = laid(tight, OUTSIDE, tools=(f"mill-{wide}", "bull-6-r1"))
    text, proof = made(job)
    assert failed(proof) == []
    assert proof.unreachable == ()
    own = [s.tool.name for s in plan(job).sections for o in s.operations if o.name.startswith("recess")]
    assert own[0] == "bull-6-r1"
    assert own[-1] == f"mill-{wide}"
    assert operations(text)[0] == "recess: rough"


def test_the_sharpest_noses_finish_before_the_finest_mills() -> None:
    recess = Pocket("recess", box(12, 8, 2.1), (), 0.0, 4.0)
    job = laid(recess, tools=("mill-12", "bull-6-r1", "bull-4-r1.5"), library=MORE)
    text, proof = made(job)
    assert failed(proof) == []
    last = [s.tool.name for s in plan(job).sections for o in s.operations if o.name.endswith("finish")]
    assert last == ["mill-12", "bull-6-r1", "bull-4-r1.5"]
    assert operations(text).count("recess: level the floor") >= 1


def test_a_flat_mill_levels_the_mouths_of_a_groove_that_it_does_not_enter() -> None:
    groove = Pocket("groove", Loop.polygon([(-30, -3), (30, -3), (30, 3), (-30, 3)]), (), 0.0, 3.0)
    job = laid(groove, tools=("mill-12", "bull-4-r1.5"), library=MORE)
    text, proof = made(job)
    assert failed(proof) == []
    used = {s.tool.name for s in plan(job).sections for o in s.operations if o.name.startswith("groove")}
    assert used == {"mill-12", "bull-4-r1.5"}
    # Where a disc of 12 mm comes in from the end of a groove of 6 mm, h = 6 - √(36 - 9) deep.
    deep = 6 - math.sqrt(27)
    corner = shapely.box(25 - 0.5 * deep, -0.3, 25, 0.3)
    assert len(cut(text, job).left(corner, -2.995)) == 0


@pytest.mark.parametrize("leave", [0.0, 0.2, 0.5] if NIGHT else [0.2])
def test_a_ball_leaves_no_ridge_between_wall_and_floor(leave: float) -> None:
    """In places too narrow for the allowance, and beside walls with more of it than the ball is wide there."""
    recess = Pocket("recess", stadium(9, 3.4), (), 0.0, 2.5)
    job = laid(recess, OUTSIDE, tools=("ball-6",), stock_to_leave=leave)
    text, proof = made(job)
    assert failed(proof) == []
    foot = float(cutter(LIBRARY.get("ball-6")).radius_at(0.01))
    floor = shapely.Polygon(recess.boundary.flatten()).buffer(foot - 3.0 - 0.02)
    assert len(cut(text, job, 0.05).left(floor, -2.489)) == 0


@by_night
def test_cusps_of_bounded_engagement_are_levelled_all_over_the_floor() -> None:
    """In the middle of the helix and between its passes, too, far from what stays at the walls."""
    recess = Pocket("recess", box(11, 9, 3), (), 0.0, 4.0)
    fine = like("mill-2", name="mill-1.5", number=152, diameter=1.5, flute_length=8)
    library = MORE.extended((fine,))
    for last in ("mill-1.5", "bull-4-r1.5"):
        tools = tuple(dict.fromkeys(("bull-4-r1.5", last)))
        job = laid(
            recess, tools=tools, library=library, clearing="adaptive", floor_to_leave=0, engagement=110
        )
        text, proof = made(job)
        assert failed(proof) == []
        assert operations(text)[0] == "recess: clear"
        inside = shapely.Polygon(recess.boundary.flatten()).buffer(-1.6)
        assert len(cut(text, job, 0.1).left(inside, -3.99)) == 0


def test_a_finer_mill_of_another_feature_need_not_go_into_the_corners_above_a_fillet() -> None:
    """It would leave terraces there; the mill with the fillet's radius makes wall and floor in one."""
    fillet = Pocket("recess", box(14, 9, 1.0), (), 0.0, 4.0, 3.0)
    job = laid(fillet, OUTSIDE, tools=("ball-6", "mill-3"))
    _, proof = made(job)
    assert failed(proof) == []
    last = [s.tool.name for s in plan(job).sections for o in s.operations if o.name == "recess: finish"]
    assert last == ["ball-6"]
    # Of one that none has cut the proof is not content.
    empty = Pocket("recess", box(14, 9, 1.0), (), 0.0, 0.02)
    shallow, _ = made(laid(empty, OUTSIDE, tools=("ball-6", "mill-3")))
    assert "leftover" in failed(prove(shallow, job))


def test_a_nose_higher_than_its_fillet_may_touch_the_wall() -> None:
    """Above a recess shallower than its nose a bull nose is wider than it cuts, which is no cut into the wall."""
    recess = Pocket("recess", box(14, 9, 6), (), 0.0, 1.8, 1.5)
    blunt = like("bull-6-r1", name="bull-10-r2", number=151, diameter=10, corner_radius=2)
    job = laid(recess, tools=("bull-10-r2", "bull-4-r1.5"), library=MORE.extended((blunt,)), stock_to_leave=0)
    _, proof = made(job)
    assert failed(proof) == []
    assert proof.checks["gouge"].value < 0.005


class TestGrooves:
    """Open grooves made by a round mill in one."""

    @staticmethod
    def groove(depth: float, width: float, far: float = 30.0) -> OpenProfile:
        bend = Arc((0.0, 20.0), 20.0, -math.pi / 2, 0.5)
        ahead = (bend.end[0] + far * math.cos(0.5), bend.end[1] + far * math.sin(0.5))
        path = (Line((-far, 0.0), (0.0, 0.0)), bend, Line(bend.end, ahead))
        return OpenProfile("groove", 0.0, depth, path=path, side="on", width=width)

    @pytest.mark.parametrize("far", [8.0, 40.0], ids=["closed", "open"])
    @pytest.mark.parametrize(("depth", "width"), [(4.0, 6.0), (0.5, 6.0), (0.5, 2 * math.sqrt(9 - 2.5**2))])
    def test_a_ball_makes_it_as_wide_as_it_is_drawn(self, depth: float, width: float, far: float) -> None:
        """Only in one where its diameter, or its width at the top of a shallow groove, is that of the groove."""
        job = laid(self.groove(depth, width, far), tools=("ball-6",))
        text, proof = made(job)
        assert failed(proof) == []
        in_one = operations(text) == ["groove: slot"]
        assert in_one == (width == pytest.approx(2 * float(cutter(LIBRARY.get("ball-6")).radius_at(depth))))
        left = cut(text, job).left(
            shapely.Polygon(self.groove(depth, width, far).boundary.flatten()).buffer(-0.05), -0.01
        )
        assert len(left) == 0

    def test_a_sharper_mill_that_gets_in_makes_its_floor(self) -> None:
        job = laid(self.groove(4.0, 6.0), tools=("ball-6", "mill-4"))
        _, proof = made(job)
        assert failed(proof) == []
        assert proof.unreachable_max_mm < 0.05
        used = {s.tool.name for s in plan(job).sections for o in s.operations if o.name.startswith("groove")}
        assert "mill-4" in used
        # The ball alone would leave its round floor where the other goes.
        alone = plan(laid(self.groove(4.0, 6.0), tools=("ball-6",)))
        mark = Pocket("mark", box(4, 4, 3).moved(-16, 11, 0), (), 0.0, 1.0)
        marked = plan(laid(mark, tools=("mill-4",)))
        both = replace(marked, sections=(*alone.sections, *marked.sections))
        job = laid(self.groove(4.0, 6.0), mark, tools=("ball-6", "mill-4"))
        assert "leftover" in failed(prove(LinuxCnc().write(both), job))


class TestSnugRecesses:
    """Recesses with a fillet that are just as wide as their mill."""

    @staticmethod
    def strip(kind: str, slant: float, far: float = 40.0) -> Pocket:
        """6 mm wide, over the right edge of the plate, ``slant`` rad off the shortest way out."""
        at = (WIDE / 2, 4.0, slant)
        if kind == "pocket":
            loop = Loop.polygon([(-20, -3), (far, -3), (far, 3), (-20, 3)])
            return Pocket("strip", loop.moved(*at), (), 0.0, 4.0, 3.0)
        path = (Line((-20.0, 0.0), (far, 0.0)).moved(*at),)
        return OpenProfile("strip", 0.0, 4.0, path=path, side=kind, width=6.0, floor_radius=3.0)

    @pytest.mark.parametrize(
        ("kind", "slant"), [("pocket", 0.0), ("pocket", 0.9), ("on", 0.9), ("left", 0.5), ("right", 0.5)]
    )
    def test_the_mill_runs_out_over_a_slanted_edge(self, kind: str, slant: float) -> None:
        strip = self.strip(kind, slant)
        job = laid(strip, tools=("ball-6", "mill-4"))
        text, proof = made(job)
        assert failed(proof) == []
        assert operations(text) == ["strip: groove"]
        # Above the fillet it is cut as wide as it is drawn, out to the edge.
        middle = {"left": 3.0, "right": -3.0}.get(kind, 0.0)
        drawn = Loop.polygon([(-16, middle - 3), (40, middle - 3), (40, middle + 3), (-16, middle + 3)])
        shape = shapely.Polygon(drawn.moved(WIDE / 2, 4.0, slant).flatten()).buffer(-0.05)
        assert len(cut(text, job).left(shape, -0.99)) == 0

    def test_a_mill_that_only_just_fits_between_the_fillets_takes_nothing(self) -> None:
        """Two fillets of 2 mm leave 6 mm of a strip of 10: whether there is a way for 6 mm, rounding decides."""
        bend = Arc((0.0, -22.0), 22.0, math.pi / 2, -0.9)
        path = (bend, Line(bend.end, (bend.end[0] + 3.0, bend.end[1] - 3.0 * math.tan(0.9))))
        strip = OpenProfile("strip", 0.0, 2.7, path=path, side="right", width=10.0, floor_radius=2.0)
        job = laid(strip, tools=("mill-6", "ball-4"), library=MORE.extended((BALL,)))
        assert failed(made(job)[1]) == []

    @pytest.mark.parametrize("kind", ["pocket", "on", "left"])
    def test_a_program_that_stops_half_way_is_not_proven(self, kind: str) -> None:
        job = laid(self.strip(kind, 0.5), tools=("ball-6", "mill-4"))
        program = plan(job)
        (section,) = program.sections
        (groove,) = section.operations
        short = replace(section, operations=(replace(groove, moves=tuple(map(_nearer, groove.moves))),))
        text = LinuxCnc().write(replace(program, sections=(short,)))
        assert "leftover" in failed(prove(text, job))

    def test_where_it_opens_along_its_side_it_is_refused(self) -> None:
        """There the mill is not guided, and elsewhere it has no room beside the wall."""
        loop = Loop.polygon([(-20, -3), (20, -3), (20, 3), (-20, 3)]).moved(0.0, 15.5, -0.2)
        along = replace(self.strip("pocket", 0.0), boundary=loop)
        with pytest.raises(ToolError, match="parts of it are narrower"):
            plan(laid(along, tools=("ball-6", "mill-4")))


def _nearer(move: Move) -> Move:
    """The move, but not beyond a line across the groove."""
    if getattr(move, "x", None) is None or move.x < WIDE / 2 - 5:
        return move
    return replace(move, x=WIDE / 2 - 5, y=4.0 - 5 * math.tan(0.5))
