"""The pieces of the proof against closed forms and against brute force."""

import math

import numpy as np
import pytest
import shapely
from by_control import interpret
from by_night import examples
from hypothesis import given, settings
from hypothesis import strategies as st
from shop import DRILL, MILL, TOOLS, plate_job

from mechwright.contracts.part import Bore, Part, Pocket, Profile
from mechwright.geometry import Loop, Outline, circle
from mechwright_cam.controls.reading import Kind, Run
from mechwright_cam.proof.bands import bands
from mechwright_cam.proof.gouge import COARSE, SLICE, deepest_cut
from mechwright_cam.proof.paths import Paths
from mechwright_cam.proof.plane import Boundary, grow, swept
from mechwright_cam.proof.stock import Stock
from mechwright_cam.proof.timing import step_times
from mechwright_cam.proof.wall import Wall
from mechwright_cam.setup.job import Job
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.shop.holding import Hold
from mechwright_cam.shop.machine import Machine
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool

START = "G17 G21 G90\nT3 M6\nG0 X0 Y0 Z5\n"


def run_of(text: str, start: str = START) -> Run:
    return interpret(start + text + "\nM2\n")


def paths_of(text: str, *tools: Tool) -> Paths:
    return Paths(run_of(text), tools or (MILL,))


# -- gouges ----------------------------------------------------------------------------------------------


def sampled_cut(paths: Paths, keep: shapely.Polygon, top: float) -> float:
    """The same question as ``deepest_cut`` asks, answered by many samples of every move."""
    run, deepest = paths.run, 0.0
    t = np.linspace(0.0, 1.0, 4001)
    for step in paths.steps.tolist():
        z = run.start[step, 2] + (run.end[step, 2] - run.start[step, 2]) * t
        if run.kind[step] == Kind.ARC:
            spoke = run.start[step, :2] - run.centre[step]
            angle = math.atan2(spoke[1], spoke[0]) + run.sweep[step] * t
            radius = math.hypot(*spoke)
            xy = run.centre[step] + radius * np.column_stack((np.cos(angle), np.sin(angle)))
        else:
            xy = run.start[step, :2] + (run.end[step, :2] - run.start[step, :2]) * t[:, None]
        low = z < top
        if not low.any():
            continue
        spots = shapely.points(xy[low])
        gap = shapely.distance(keep, spots)
        gap = np.where(gap > 0, gap, -shapely.distance(keep.exterior, spots))
        deepest = max(deepest, float(np.minimum(MILL.radius - gap, top - z[low]).max()))
    return deepest


coordinate = st.integers(-2000, 2000).map(lambda n: n / 100)
height = st.integers(-800, 200).map(lambda n: n / 100)


@st.composite
def cuts(draw: st.DrawFn) -> str:
    lines = ["F100"]
    x = y = 0.0
    for _ in range(draw(st.integers(1, 6))):
        z = draw(height)
        if draw(st.booleans()):
            x, y = draw(coordinate), draw(coordinate)
            lines.append(f"G1 X{x:.4f} Y{y:.4f} Z{z:.4f}")
        else:
            radius, first, turn = draw(st.floats(0.5, 9)), draw(st.floats(-3, 3)), draw(st.floats(0.3, 6))
            i, j = round(radius * math.cos(first), 4), round(radius * math.sin(first), 4)
            exact = math.hypot(i, j)
            across = math.atan2(-j, -i) + turn
            x, y = x + i + exact * math.cos(across), y + j + exact * math.sin(across)
            x, y = round(x, 4), round(y, 4)
            lines.append(f"G3 X{x:.4f} Y{y:.4f} Z{z:.4f} I{i:.4f} J{j:.4f}")
    return "\n".join(lines)


@given(text=cuts(), centre=st.tuples(coordinate, coordinate), size=st.floats(0.5, 8), top=height)
@settings(max_examples=examples(50, 150), deadline=None)
def test_gouges_agree_with_brute_force(
    text: str, centre: tuple[float, float], size: float, top: float
) -> None:
    keep = (
        shapely.Point(centre)
        .buffer(size, quad_segs=2)
        .difference(shapely.box(centre[0], centre[1], centre[0] + 20, centre[1] + 20))
    )
    paths = paths_of(text)
    found = deepest_cut(paths, keep, top)
    exact = sampled_cut(paths, keep, top)
    ours = found.depth if found else 0.0
    # 4,000 samples of a move of up to 60 mm are at most 8 µm from the deepest place. Of several moves whose
    # axes go inside of the shape another one than the deepest may be named, within half of COARSE. A sloping
    # move is as deep as the lowest place of its slice.
    less = 0.012 if exact <= MILL.radius else COARSE / 2 + 0.012
    assert max(exact, 0.0) - less <= ours <= max(exact, 0.0) + SLICE + 0.012


def test_a_drill_is_as_wide_as_its_point_at_the_top_of_the_band() -> None:
    keep = shapely.box(-20, -20, 20, 20).difference(shapely.Point(0, 0).buffer(2.0, quad_segs=200))
    paths = paths_of("T2 M6\nG0 X0 Y0\nG1 Z-1 F100", DRILL)
    grown = math.tan(math.radians(DRILL.point_angle / 2))
    found = deepest_cut(paths, keep, 0.0)
    assert found is None  # 1.66 mm of radius in a hole of 2 mm
    deeper = deepest_cut(paths_of("T2 M6\nG0 X0 Y0\nG1 Z-1.5 F100", DRILL), keep, 0.0)
    assert deeper is not None
    assert deeper.depth == pytest.approx(1.5 * grown - 2.0, abs=1e-3)


def test_a_cut_is_seen_in_each_piece_of_a_part() -> None:
    keep = shapely.MultiPolygon([shapely.box(-20, 10, 20, 20), shapely.box(-20, -20, 20, -10)])
    for y in (10 - MILL.radius + 0.05, -10 + MILL.radius - 0.05):
        found = deepest_cut(paths_of(f"G0 X-30 Y{y}\nG1 Z-1 F100\nX30"), keep, 0.0)
        assert found is not None
        assert found.depth == pytest.approx(0.05, abs=1e-6)


@pytest.mark.parametrize("far", [0.4, 3.0, 6.0, 9.0, 23.0])
def test_a_cut_is_as_deep_as_it_goes_into_the_wall(far: float) -> None:
    """Across a wall, a line whose ends lie outside of the part: it was told with the cutter's radius."""
    keep = shapely.box(-100, 0, 100, 100)
    text = f"G0 X-150 Y{far - MILL.radius}\nG1 Z-7 F100\nX150"
    through = deepest_cut(paths_of(text), keep, 0.0, -6.0)
    assert through is not None
    assert through.depth == pytest.approx(far, abs=1e-3)
    floor = deepest_cut(paths_of(text), keep, 0.0)
    assert floor is not None
    assert floor.depth == pytest.approx(min(far, 7.0), abs=1e-3)


def test_a_sloping_move_is_as_deep_as_it_goes_into_the_part() -> None:
    """It was told with its lowest place, which lies outside of the part."""
    keep = shapely.box(0, -50, 100, 50)
    text = "G0 X60 Y0\nG0 Z0\nG1 X-40 Z-10 F100"
    found = deepest_cut(paths_of(text), keep, 0.0)
    assert found is not None
    inside = (6.0 - MILL.radius) / 1.1  # where it goes as deep as it goes into the wall
    assert found.depth == pytest.approx(6.0 - inside / 10, abs=SLICE)
    through = deepest_cut(paths_of(text), keep, 0.0, -5.0)
    assert through is not None
    assert through.depth == pytest.approx(10.0 + MILL.radius, abs=0.01)


def test_a_level_pass_over_a_sloping_one_is_seen() -> None:
    """Both have one line in plan view, and the sloping one is the lower of them, beside the part."""
    keep = shapely.box(40, -50, 60, 50)
    found = deepest_cut(paths_of("G0 X60 Y0\nG0 Z0\nG1 X-40 Z-10 F100\nG0 Z5\nX60\nG1 Z-3\nX-40"), keep, 0.0)
    assert found is not None
    assert found.depth == pytest.approx(3.0, abs=1e-6)


def test_a_move_straight_down_is_seen() -> None:
    found = deepest_cut(paths_of("G0 X10 Y0\nG1 Z-3 F100"), shapely.box(12, -5, 20, 5), 0.0)
    assert found is not None
    assert found.depth == pytest.approx(1.0)
    assert found.at == pytest.approx((12.0, 0.0, -3.0))


@given(cuts())
@settings(max_examples=50, deadline=None)
def test_the_extent_of_each_move_is_that_of_its_points(text: str) -> None:
    paths = paths_of(text)
    least, most = paths.extent()
    points, owner = paths.points(paths.below(math.inf))
    for number in range(paths.steps.size):
        mine = points[owner == number]
        np.testing.assert_allclose(mine.min(axis=0), least[number], atol=4e-4)
        np.testing.assert_allclose(mine.max(axis=0), most[number], atol=4e-4)


# -- layers ----------------------------------------------------------------------------------------------


def stepped() -> Job:
    """A plate 40 x 30 x 10 with a blind bore, a pocket with an island below a step, and a step outside."""
    outer = Loop.polygon([(-20, -15), (20, -15), (20, 15), (-20, 15)])
    step = Loop.polygon([(-18, -13), (18, -13), (18, 13), (-18, 13)])
    rim = Loop.polygon([(2, -6), (14, -6), (14, 6), (2, 6)])
    island = Loop((circle((8, 0), 2.0),))
    features = (
        Bore("bore", (-8.0, 0.0), 6.0, 0.0, 4.0),
        Pocket("pocket", rim, (island,), 1.0, 5.0),
        Profile("step", step, "outside", 0.0, 2.0),
        Profile("outside", outer, "outside", 0.0, 10.0),
    )
    part = Part("stepped", Outline(outer), 10.0, "aluminium", machined=features)
    return make_job(part, CamSettings(hold=Hold(tabs=2, tab_height=1.0)), (MILL,))


def test_layers_have_the_areas_of_the_drawing() -> None:
    bore, pocket, whole, step = math.pi * 9, 144 - math.pi * 4, 1200.0, 36 * 26.0
    expected = {
        (0.0, -1.0): step - bore,
        (-1.0, -2.0): step - bore - pocket,
        (-2.0, -4.0): whole - bore - pocket,
        (-4.0, -6.0): whole - pocket,
        (-6.0, -10.0): whole,
    }
    layers = bands(stepped())
    assert [(band.top, band.bottom) for band in layers] == list(expected)
    for band in layers:
        assert band.keep.area == pytest.approx(expected[band.top, band.bottom], abs=0.02)


def test_layers_can_be_divided_at_more_heights() -> None:
    assert [band.bottom for band in bands(plate_job(), (-5.0, -99.0))] == [-5.0, -6.0]


# -- helpers ---------------------------------------------------------------------------------------------


@given(st.floats(0.3, 20.0))
def test_buffers_are_as_accurate_as_they_say(radius: float) -> None:
    disc = grow(shapely.Point(0, 0), radius, 1e-4)
    edges = np.asarray(disc.exterior.coords)
    middles = (edges[1:] + edges[:-1]) / 2
    assert radius - np.hypot(*middles.T).min() <= 1.01e-4


def test_a_sweep_in_chunks_is_the_sweep() -> None:
    t = np.linspace(0, 20, 700)
    spiral = shapely.LineString(np.column_stack((t * np.cos(t), t * np.sin(t))))
    chains = np.array([spiral, shapely.Point(40, 0)], dtype=object)
    whole = shapely.union_all([chain.buffer(1.5, quad_segs=64) for chain in chains])
    assert swept(chains, 1.5, 0.001).symmetric_difference(whole).area < 0.001 * whole.length


def test_a_wall_s_normals_point_out_of_the_material() -> None:
    shape = shapely.box(0, 0, 20, 10).difference(shapely.Point(6, 5).buffer(3.0))
    wall = Wall(shape)
    assert wall.length == pytest.approx(shape.length)
    points, outward = wall.at(wall.stations(0.5))
    outside = shapely.points(points + 0.01 * outward)
    assert not shapely.contains(shape, outside).any()
    assert shapely.contains(shape, shapely.points(points - 0.01 * outward)).all()
    assert shapely.distance(shape.boundary, shapely.points(points)).max() < 1e-9


def test_a_boundary_knows_holes() -> None:
    edge = Boundary(shapely.box(0, 0, 20, 10).difference(shapely.box(5, 3, 7, 5)))
    spots = shapely.points([(10.0, 4.0), (6.0, 4.0), (-2.0, 5.0)])
    assert edge.distance(spots).tolist() == pytest.approx([3.0, 1.0, 2.0])
    assert edge.inside(spots).tolist() == [0]
    assert edge.distance(spots, within=1.5).tolist() == [math.inf, 1.0, math.inf]


def test_material_is_known_at_any_moment() -> None:
    job = plate_job()
    run = run_of("G1 Z-2 F100\nG1 X20\nG0 Z5\nG0 X0\nG0 Z-2\nG0 Z5\nG0 Z-2.5\nG0 Z5\nG0 X10 Y3\nG0 Z-1\n")
    paths = Paths(run, TOOLS)
    stock = Stock(paths, job)
    met = {int(run.line[step]): stock.meets(int(step)) for step in paths.steps}
    # Down into the slot to its floor, below it, and beside it.
    assert (met[8], met[10], met[13]) == (False, True, True)


# -- time ------------------------------------------------------------------------------------------------

MACHINE = Machine(acceleration=1.0, rapid=6000.0, max_feed=6000.0, tool_change=7.0)


def seconds(text: str) -> float:
    """Time of everything after the start."""
    run = run_of(text, "G17 G21 G90\nG0 X0 Y0 Z0\nG4 P0\n")
    return float(step_times(run, MACHINE)[2:].sum())


def test_a_short_move_never_reaches_its_speed() -> None:
    assert seconds("G0 X1") == pytest.approx(2 * math.sqrt(1 / 1000), rel=0.02)


def test_a_long_move_takes_its_length_and_one_ramp() -> None:
    assert seconds("G1 X200 F3000") == pytest.approx(200 / 50 + 50 / 1000, rel=0.02)


def test_moves_in_line_are_one_move() -> None:
    parts = "".join(f"G1 X{x} F3000\n" for x in range(1, 101))
    assert seconds(parts) == pytest.approx(seconds("G1 X100 F3000"), rel=1e-6)


def test_a_corner_costs_time_and_a_tangent_none() -> None:
    straight = seconds("G1 X20 F3000\nX40")
    corner = seconds("G1 X20 F3000\nY20")
    assert corner > straight + 0.04
    quarter = 20 * math.pi / 2
    tangent = seconds("G1 X20 F3000\nG3 X40 Y20 I0 J20")
    assert tangent == pytest.approx(seconds(f"G1 X{20 + quarter:.4f} F3000"), rel=0.01)


def test_a_small_circle_is_limited_by_its_curvature() -> None:
    slow = math.sqrt(1000 * 0.1)
    assert seconds("G3 X0 Y0 I0.1 J0 F6000") > 2 * math.pi * 0.1 / slow


def test_dwells_and_tool_changes_count() -> None:
    assert seconds("G4 P1.5") == pytest.approx(1.5)
    assert seconds("T1 M6") == pytest.approx(7.0)
    assert seconds("M0") == 0.0


def test_nothing_faster_than_the_machine() -> None:
    assert seconds("G1 X100 F100000") == pytest.approx(seconds("G1 X100 F6000"))


def test_all_kinds_of_tool_have_a_point_or_none() -> None:
    there = "M6\nG0 X0 Y0\nG1"
    paths = paths_of(f"T1 {there} Z-1 F9\nT2 {there} Z-2\nT3 {there} Z-3", *TOOLS)
    pieces = paths.below(0.0)
    kinds = {paths.run.tool[s]: r for s, r in zip(pieces.step, paths.radius_at(pieces, -0.5), strict=True)}
    assert kinds[1] == pytest.approx(0.5)  # 90°
    assert kinds[2] == pytest.approx(1.5 * math.tan(math.radians(59)))
    assert kinds[3] == MILL.radius
