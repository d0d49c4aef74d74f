"""Fillets beside deeper recesses, tapped blind holes, walls with little to measure, witness lines: closed forms."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import shapely
from round_parts import laid
from shop import MILL, plate_job
from test_proof_parts import paths_of

from mechwright.contracts.details import Chamfer, Thread
from mechwright.contracts.made_part import MadeRing, MadeSection
from mechwright.contracts.part import Bore, Part, Pocket
from mechwright.errors import ProgramError
from mechwright.geometry import Loop, Outline
from mechwright_cam.proof import carried, sweep
from mechwright_cam.proof.carried import SHARES
from mechwright_cam.proof.fillets import fillets
from mechwright_cam.proof.sweep import Sweeps
from mechwright_cam.proof.target_shape import TAB_SLACK, TargetShape
from mechwright_cam.proof.wall import Wall, on_walls
from mechwright_cam.proof.witness import witnesses
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool, ToolKind

BALL = MILL.model_copy(update={"kind": ToolKind.BALL})


def square(half: float, x: float = 0.0) -> Loop:
    return Loop.polygon([(x - half, -half), (x + half, -half), (x + half, half), (x - half, half)])


def test_a_fillet_ends_where_a_deeper_recess_begins() -> None:
    upper = Pocket("upper", square(9.0), (), 0.0, 3.0, 1.0)
    deeper = Pocket("deeper", square(4.0), (), 3.0, 2.0)
    same = Pocket("same", square(2.0, 18.0), (), 0.0, 3.0)
    (fillet,) = fillets(laid(upper, deeper, same, tools=("mill-6", "bull-6-r1")))
    assert fillet.floor == -3.0
    assert fillet.inside.area == pytest.approx(18.0**2 - 8.0**2, rel=1e-6)
    assert fillet.walls.length == pytest.approx(4 * 18.0, rel=1e-3)
    foot = fillet.foot
    assert foot.area == pytest.approx(18.0**2 - 16.0**2, rel=1e-2)
    # At a height the fillet is as wide as the recess is narrower there, and above it there is none.
    for up in (0.1, 0.5, 0.9):
        narrow = 18.0 - 2 * (1 - math.sqrt(1 - (1 - up) ** 2))
        assert fillet.solid(-3.0 + up).area == pytest.approx(18.0**2 - narrow**2, rel=1e-2)
    assert fillet.solid(-3.0).area == pytest.approx(18.0**2 - 16.0**2, rel=1e-2)
    assert fillet.solid(-2.0).is_empty
    assert fillet.solid(-3.01).is_empty
    np.testing.assert_allclose(
        fillet.rise(np.array([0.0, 0.5, 1.0, 2.0])), [1.0, 1 - math.sqrt(0.75), 0.0, 0.0]
    )


def test_what_a_ball_cuts_into_a_fillet_is_its_nose_less_the_room() -> None:
    """A ball of 3 mm along the foot of a fillet of 4 mm: its middle is to be 4 mm off the wall, and as high."""
    (fillet,) = fillets(laid(Pocket("one", square(9.0), (), 0.0, 4.0, 4.0), tools=("ball-6",)))
    np.testing.assert_allclose(
        fillet.rise(np.array([0.0, 2.0, 4.0, 5.0])), [4.0, 4 - math.sqrt(12), 0.0, 0.0]
    )
    assert fillet.deepest(paths_of("G0 X5.5\nG1 Z0.5 F100", BALL)) is None
    assert (
        replace(fillet, walls=shapely.MultiLineString()).deepest(paths_of("G0 X5.5\nG1 Z-3 F100", BALL))
        is None
    )
    for away, up in (
        (4.0, 1.0),
        (4.5, 0.9),
        (4.0, 0.99),
        (3.5, 1.0),
        (3.9, 0.9),
        (3.2, 0.5),
        (3.2, 0.2),
        (3.1, 0.3),
        (3.5, 0.1),
    ):
        x = 9.0 - away
        cut = math.hypot(4.0 - away, 4.0 - up - 3.0) - 1.0 if min(4.0 - away, 1.0 - up) > 0 else 0.0
        for more in ("", "\nY1\nG0 Z5"):
            found = fillet.deepest(paths_of(f"G0 X{x}\nG1 Z{-4 + up} F100{more}", BALL))
            assert (found.depth if found else 0.0) == pytest.approx(max(cut, 0.0), abs=1e-3), (away, up)


def test_only_below_its_thread_a_tapped_hole_may_keep_the_point_of_its_drill() -> None:
    """A hole of 17.3 mm and 7 mm deep, tapped down to 4 mm, beside one that is not, and a mill that enters both."""
    thread = Thread("m20", (0.0, 0.0), 20.0, 2.5, 4.0)
    holes = (Bore("core", (0.0, 0.0), thread.core, 0.0, 7.0), Bore("plain", (30.0, 0.0), 10.0, 0.0, 7.0))
    tap = Tool(
        name="tap-m20", number=9, kind="tap", diameter=20, pitch=2.5, chamfer_length=1, flute_length=40
    )
    part = Part("plate", Outline(square(40.0)), 10.0, "aluminium", machined=holes, details=(thread,))
    of = make_job(part, CamSettings.model_validate({"stock": {"margin": 0}}), (MILL, tap))
    asked, without = (TargetShape(one, [MILL]) for one in (of, replace(of, tools=(MILL,))))
    for wanted, bottoms in ((asked, [-4, -7, -10]), (without, [-7, -10])):
        assert [band.bottom for band in wanted.bands] == bottoms
        for place, bottom in enumerate(bottoms):
            rest = wanted.rest(place, bottom)
            left = [bool(shapely.contains_xy(rest, x, y)) for x, y in ((0, 0), (8, 0), (30, 0), (16, 0))]
            kept = bottom == -10 or (wanted is asked and bottom == -7)
            assert left == [kept, kept, bottom == -10, True]


def test_what_is_handed_on_is_at_floors_tabs_corners_and_points() -> None:
    """Heights of a drill of 8 mm with 118 degrees, whose point is 2.4034 mm high, and of a ball of 3 mm."""
    job = plate_job()
    floors = {-6.0, job.tabs[0].top + TAB_SLACK}
    assert carried._heights(paths_of("G1 Z-2 F100"), job) == floors
    noses = {-6.0 + share * 3.0 for share in SHARES}
    assert carried._heights(paths_of("G1 Z-2 F100", BALL), job) == floors | noses
    bull = MILL.model_copy(update={"kind": ToolKind.BULL_NOSE, "corner_radius": 0.8})
    noses = {round(-6.0 + share * 0.8, 3) for share in SHARES}
    assert carried._heights(paths_of("G1 Z-2 F100", bull), job) == floors | noses
    drill = MILL.model_copy(update={"kind": ToolKind.DRILL, "diameter": 8.0})
    point = 4.0 / math.tan(math.radians(59.0))
    for z in (-2.0, -5.0, -7.5):
        down = {round(z + share * point, 3) for share in SHARES}
        assert carried._heights(paths_of(f"G1 Z{z} F100", drill), job) == floors | {
            max(h, -6.0) for h in down if h < 0
        }
    for aside in ("G0 Z-2\nG1 Z-1 F100", "G0 Z-2\nG1 X1 F100"):  # down at a rapid; up, or along
        assert carried._heights(paths_of(aside, drill), job) == floors


def test_floors_chamfers_and_threads_are_handed_on() -> None:
    details = (Chamfer("rim", square(9.0), "outside", 0.4), Thread("m6", (0.0, 0.0), 6.0, 1.0, 5.0))
    features = (Pocket("lower", square(4.0), (), 1.0, 3.0),)
    of = SimpleNamespace(thickness=8.0, features=features, tabs=(), details=details)
    heights = carried._heights(paths_of("G1 Z-2 F100"), of)  # type: ignore[arg-type]
    assert heights == {-8.0, -5.0, -4.0, -0.4, -0.3, -0.2, -0.1}


@pytest.mark.parametrize("turned", [False, True])
def test_a_wall_has_its_material_on_the_left_all_round_in_steps_of_one_length(turned: bool) -> None:
    """A plate of 10 x 6 mm with a window of 2 x 3 mm, whose corner stands twice, and a block beside it."""
    outer = [(0, 0), (10, 0), (10, 6), (10, 6), (0, 6)]
    window = [(2, 2), (2, 5), (4, 5), (4, 2)]
    if turned:
        outer, window = outer[::-1], window[::-1]
    shape = shapely.MultiPolygon([shapely.Polygon(outer, [window]), shapely.box(20, 0, 22, 2)])
    wall = Wall(shape)
    assert wall.length == pytest.approx(32 + 10 + 8)
    for spacing, count in ((1.0, 50), (0.99, 51), (80.0, 1)):
        stations = wall.stations(spacing)
        np.testing.assert_allclose(stations, (np.arange(count) + 0.5) * 50 / count)
        points, outward = wall.at(stations)
        assert shapely.distance(shapely.boundary(shape), shapely.points(points)).max() < 1e-12
        np.testing.assert_allclose(np.hypot(*outward.T), 1.0)
        assert shapely.contains_xy(shape, points - 1e-3 * outward).all()
        assert not shapely.contains_xy(shape, points + 1e-3 * outward).any()
        assert len(np.unique(points.round(9), axis=0)) == count
    end, _ = wall.at(np.array([50.0]))
    assert shapely.distance(shapely.boundary(shape), shapely.points(end)).max() < 1e-12
    nothing = Wall(shapely.Polygon())
    assert (nothing.length, len(nothing.stations(1.0))) == (0.0, 1)
    assert on_walls(shapely.Polygon(), None, None, plate_job(), [], 3.0) == (0.0, None)


def test_nothing_is_asked_of_a_wall_at_the_edge_of_the_stock() -> None:
    job = plate_job()
    assert on_walls(shapely.box(*job.stock), None, None, job, [], 3.0) == (0.0, None)
    for side, inwards in enumerate((5.0, 5.0, -5.0, -5.0)):
        bounds = list(job.stock)
        bounds[side] += inwards
        thick, place = on_walls(shapely.box(*bounds), None, None, job, [], 3.0)
        assert thick == math.inf
        assert place is not None
        assert place[side % 2] == pytest.approx(bounds[side])


@pytest.mark.parametrize("left", [0.0, 0.02, 0.15])
def test_a_short_wall_is_measured_as_a_long_one_is(left: float) -> None:
    """A pass along the right side of a square, so far off it; what is asked for is 3 mm, and then all of it."""
    shape = shapely.box(-8.0, -8.0, 8.0, 8.0)
    paths = paths_of(f"G0 X{11 + left} Y-20\nG1 Z-6 F100\nY20\nG0 Z5")
    cut = Sweeps(paths).at(-5.0, -5.0)
    short = shapely.box(7.0, -1.5, 9.0, 1.5)
    thick, place = on_walls(shape, short, None, plate_job(), cut, 3.0)
    assert thick == pytest.approx(left, abs=1e-6)
    if left:
        assert place is not None
        assert place[0] == pytest.approx(8.0)
        assert abs(place[1]) <= 1.5
    # At its ends the left side is farthest away: 16 mm and what is left.
    thick, place = on_walls(shape, shapely.box(-9.0, -7.0, -7.0, 7.0), None, plate_job(), cut, 3.0)
    assert thick == pytest.approx(16.0 + left, abs=1e-6)
    assert on_walls(shape, short, short.buffer(1.0), plate_job(), cut, 3.0) == (0.0, None)
    thick, _ = on_walls(shape, short, None, plate_job(), [], 3.0)
    assert thick == math.inf


def test_more_chords_than_there_is_memory_for_are_refused_at_the_first_too_many(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    paths = paths_of("G1 Z-1 F100\nX10\nX20 Y1\nX30 Y2\nX40 Y7")
    corners = int(paths.corners(paths.below(-0.5, steps=paths.cuts)).sum())
    monkeypatch.setattr(sweep, "MOST_CHORDS", corners)
    assert Sweeps(paths).at(-0.5, -0.5)
    for most, back in ((corners - 1, 1), (corners - 3, 2)):
        monkeypatch.setattr(sweep, "MOST_CHORDS", most)
        line = int(paths.run.line[paths.cuts[-back]])
        with pytest.raises(ProgramError, match=rf"^line {line}: the cuts down to Z-0\.5 have over"):
            Sweeps(paths).at(-0.5, -0.5)


def section(top: float, bottom: float) -> MadeSection:
    """A wall along X from 0 to 10 with material above Y0."""
    points = np.column_stack((np.arange(0.05, 10.0, 0.1), np.zeros(100)))
    outward, none = np.tile((0.0, -1.0), (100, 1)), np.zeros(100)
    return MadeSection(top, bottom, (MadeRing(points, outward, none, none > 0),))


def test_a_pass_on_a_line_of_its_own_leaves_a_step_where_it_ends() -> None:
    foot = "G0 X-5 Y-3\nG1 Z-6 F100\nX15\nG0 Z5\n"
    deeper = "G0 X-5 Y-2.99\nG1 Z-4 F100\nX15\nG0 Z5\n"
    (one,) = witnesses(Sweeps(paths_of(foot + deeper)), section(0.0, 6.0))
    assert (one.depth, one.step) == (pytest.approx(4.0), pytest.approx(0.01))
    assert witnesses(Sweeps(paths_of(foot + deeper.replace("2.99", "3.01"))), section(0.0, 6.0)) == []
    # A pass whose depth is that of the section's top or bottom ends with it.
    assert witnesses(Sweeps(paths_of(foot + deeper)), section(4.0, 6.0)) == []
    assert witnesses(Sweeps(paths_of(foot + deeper)), section(0.0, 4.0)) == []
    two = deeper + deeper.replace("2.99", "2.98").replace("Z-4", "Z-2")
    upper, lower = witnesses(Sweeps(paths_of(foot + two)), section(0.0, 6.0))
    assert (upper.depth, lower.depth) == (pytest.approx(2.0), pytest.approx(4.0))


def test_of_a_ramp_only_what_is_below_the_top_of_a_section_steps_its_wall() -> None:
    foot = "G0 X-5 Y-3\nG1 Z-6 F100\nX15\nG0 Z5\n"
    ramp = "G0 X0 Y-2.99\nG1 Z1 F100\nX10 Z-3\nG0 Z5\n"
    (one,) = witnesses(Sweeps(paths_of(foot + ramp)), section(2.0, 6.0))
    assert one.depth == pytest.approx(3.0)
    assert one.at[0] >= 7.5 - 0.3


def test_a_round_pass_is_as_wide_as_at_the_top_of_the_section() -> None:
    """2 mm above its tip a ball of 3 mm has a radius of √8 mm."""
    flat, ball = "G0 X-5 Y-3\nG1 Z-6 F100\nX15\nG0 Z5\n", BALL.model_copy(update={"number": 4})
    along = f"T4 M6\nG0 X-5 Y{0.01 - 8**0.5:.6f} Z5\nG1 Z-4 F100\nX15\nG0 Z5\n"
    (one,) = witnesses(Sweeps(paths_of(flat + along, MILL, ball)), section(2.0, 6.0))
    assert (one.depth, one.step) == (pytest.approx(4.0), pytest.approx(0.01, abs=1e-5))
