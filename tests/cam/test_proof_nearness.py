"""What the proof looks at first only saves time: the answer is that of looking at everything."""

import math
from dataclasses import replace

import numpy as np
import pytest
import shapely
from by_control import asked, interpret, posted, prove
from hypothesis import given, settings
from hypothesis import strategies as st
from shop import MILL, plate_job, plate_program
from test_proof_parts import coordinate, cuts, height, paths_of

from mechwright import arrays
from mechwright.contracts.part import Part, Pocket
from mechwright.geometry import Loop, Outline
from mechwright_cam.controls.linuxcnc import LinuxCnc
from mechwright_cam.planning import choose_tools
from mechwright_cam.proof import gouge, leftover, point_segment_distance, stock
from mechwright_cam.proof.gouge import deepest_cut, distinct
from mechwright_cam.proof.paths import Paths
from mechwright_cam.proof.point_segment_distance import Chords
from mechwright_cam.proof.stock import Stock
from mechwright_cam.proof.sweep import Sweeps
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.shop.library import load_library
from mechwright_cam.shop.settings import CamSettings

places = st.lists(st.tuples(coordinate, coordinate), min_size=1, max_size=30).map(np.array)


@settings(max_examples=100)
@given(places, places, places, st.floats(0.01, 9), st.sampled_from([0.3, 5.0]))
def test_distances_beside_a_hint(
    first: np.ndarray, last: np.ndarray, asked: np.ndarray, reach: float, cell: float
) -> None:
    """Never less than the true distance, and the true one wherever the nearest line passes the hint."""
    count = min(len(first), len(last))
    chords = Chords(first[:count], last[:count])
    before, point_segment_distance.CELL = point_segment_distance.CELL, cell
    try:
        found = chords.hinted_distance(asked, asked, reach)
    finally:
        point_segment_distance.CELL = before
    lines = shapely.linestrings(np.stack((first[:count], last[:count]), axis=1))
    away = shapely.distance(shapely.points(asked)[:, None], lines)
    away = np.minimum(away, shapely.distance(shapely.points(asked)[:, None], shapely.points(first[:count])))
    true = away.min(axis=1)
    assert (found >= true - 1e-9).all()
    within = true < reach - 1e-9
    np.testing.assert_allclose(found[within], true[within], atol=1e-9)
    np.testing.assert_allclose(chords.distance(asked), true, atol=1e-9)


@pytest.mark.parametrize("most", [point_segment_distance.MOST_PAIRS, 100])
def test_the_nearest_of_many_lines_that_cross(monkeypatch: pytest.MonkeyPatch, most: int) -> None:
    """Near and far from a crowd of long lines, of which few are asked first, and not all together."""
    rng = np.random.default_rng(7)
    first, last = rng.uniform(-20, 20, (2, 900, 2))
    asked = np.concatenate((rng.uniform(-25, 25, (150, 2)), rng.uniform(-900, 900, (10, 2)), first[:1]))
    for name, value in (("FEW", 30), ("MOST_PAIRS", most), ("TOGETHER", 128), ("CROWD", 10.0)):
        monkeypatch.setattr(point_segment_distance, name, value)
    chords = Chords(first, last)
    assert chords._crowded
    lines = shapely.linestrings(np.stack((first, last), axis=1))
    true = shapely.distance(shapely.points(asked)[:, None], lines).min(axis=1)
    np.testing.assert_allclose(chords.distance(asked), true, atol=1e-9)


def test_lines_far_from_every_hint_are_left_out() -> None:
    chords = Chords(np.array([[0.0, 0.0], [50.0, 0.0]]), np.array([[9.0, 0.0], [50.0, 80.0]]))
    asked = np.array([[3.0, 1.0], [30.0, 30.0]])
    assert chords.hinted_distance(asked, asked, 2.0).tolist() == [1.0, math.inf]
    none = Chords(np.empty((0, 2)), np.empty((0, 2)))
    assert none.hinted_distance(asked, asked, 2.0).tolist() == [math.inf, math.inf]
    assert none.distance(asked).tolist() == [math.inf, math.inf]


@settings(max_examples=60)
@given(text=cuts(), centre=st.tuples(coordinate, coordinate), size=st.floats(0.5, 8), top=height)
def test_a_gouge_is_found_whichever_way_nearness_is_asked(
    text: str, centre: tuple[float, float], size: float, top: float
) -> None:
    keep = shapely.Point(centre).buffer(size, quad_segs=3)
    before, found = gouge.DEAR, []
    try:
        for dear in (1e9, 1e-9):  # always by a grown shape, and never
            gouge.DEAR = dear
            found.append(deepest_cut(paths_of(text), keep, top))
    finally:
        gouge.DEAR = before
    assert found[0] == found[1]


@given(cuts())
@settings(max_examples=20)
def test_a_repeated_piece_counts_once_at_its_lowest(text: str) -> None:
    paths = paths_of(f"{text}\nG1 X0 Y0 Z-1\n{text}\nG1 X0 Y0 Z0\n{text}\n")
    pieces = paths.below(math.inf)
    kept = distinct(paths, pieces)
    plan = np.round(
        np.column_stack((paths.start[:, :2], paths.end[:, :2], np.nan_to_num(paths.run.sweep))), 6
    )
    rows = plan[pieces.step]
    assert {tuple(row) for row in plan[kept.step].tolist()} == {tuple(row) for row in rows.tolist()}
    for step, low in zip(kept.step.tolist(), kept.low.tolist(), strict=True):
        alike = (rows == plan[step]).all(axis=1)
        centre = np.nan_to_num(paths.run.centre)
        alike &= np.abs(centre[pieces.step] - centre[step]).max(axis=1) < 1e-6
        assert low == pieces.low[alike].min()


def test_rows_with_one_key_are_still_told_apart(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(arrays, "_FACTORS", ())  # then the key of a row is the sum of its numbers
    monkeypatch.setattr(arrays, "_SHIFTS", ())
    rows = np.array([[1, 2], [2, 1], [1, 2], [3, 0]])
    index, kind = arrays.first_of_each(rows)
    assert sorted(index.tolist()) == [0, 1, 3]
    assert rows[index][kind].tolist() == rows.tolist()


def test_rows_on_a_lattice_have_keys_of_their_own(monkeypatch: pytest.MonkeyPatch) -> None:
    rows = 1000 * np.stack(np.meshgrid(*[np.arange(8)] * 4), axis=-1).reshape(-1, 4)
    calls = []
    unique = np.unique
    monkeypatch.setattr(np, "unique", lambda *args, **named: calls.append(named) or unique(*args, **named))
    index, _ = arrays.first_of_each(rows)
    assert index.size == len(rows)
    assert not any("axis" in named for named in calls)  # rows are compared whole only if two have one key


@settings(max_examples=40)
@given(cuts(), st.tuples(coordinate, coordinate), st.floats(0.1, 9), st.integers(0, 7), st.integers(1, 3))
def test_cuts_near_a_shape(
    text: str, centre: tuple[float, float], reach: float, before: int, together: int
) -> None:
    paths = paths_of(text)
    body = shapely.Point(centre).buffer(2.0)
    kept, stock.TOGETHER = stock.TOGETHER, together
    try:
        plate = Stock(paths, plate_job())
        if plate.cuts.size == 0:
            return
        found = plate._cuts_near(body, reach, before)
    finally:
        stock.TOGETHER = kept
    lines = paths.lines(paths.below(math.inf, steps=plate.cuts))
    near_ = shapely.distance(lines, body) <= reach
    assert found.tolist() == plate.cuts[near_ & (plate.cuts < before)].tolist()


@pytest.fixture(scope="module")
def program() -> str:
    return LinuxCnc().write(plate_program())


@pytest.mark.parametrize("lines", [[], ["G1 Z-6.2\n"], ["Z-6.2\n", "X-3\n"], ["G3 X-27 Y-24"]])
def test_the_wall_is_seen_at_every_height_though_each_place_is_measured_once(
    program: str, lines: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Above the tabs only what stands beside them is asked again; a program that leaves it out still fails."""
    job = plate_job()
    whole = prove(program, job)
    assert whole.checks["leftover"].passed
    text = program
    for start in lines:
        text = "".join(line for line in text.splitlines(keepends=True) if not line.startswith(start))
    measured = []
    real = leftover.on_walls

    def everywhere(reached, within, *rest):  # type: ignore[no-untyped-def]
        measured.append(within is None)
        return real(reached, None, *rest)

    at_once = prove(text, job)
    monkeypatch.setattr(leftover, "on_walls", everywhere)
    again = prove(text, job)
    assert measured == [True, False]
    assert at_once.leftover_reachable_max_mm == pytest.approx(again.leftover_reachable_max_mm, abs=2e-4)
    assert at_once.checks["leftover"].passed == again.checks["leftover"].passed


def test_stock_above_a_tab_is_found(program: str) -> None:
    """Higher up than the tabs the wall behind them is looked at, where the band of the tabs does not."""
    job = plate_job()
    tall = [replace(tab, top=tab.top + 2.0) for tab in job.tabs]
    high = replace(job, tabs=tuple(tall))
    assert asked("leftover", program, high).passed
    # Where the cutter goes over tabs of 1 mm as if they were more than 2 mm high, stock stays above them.
    lifted = program.replace("Z-4.8", "Z-3.5").replace("\nZ-4.9\n", "\nZ-3.7\n")
    assert lifted != program
    assert asked("leftover", lifted, high).passed
    found = asked("leftover", lifted, job)
    assert not found.passed
    assert found.at is not None
    assert found.at[2] == pytest.approx(-4.5)


def test_a_sweep_knows_what_is_beside_a_shape(program: str) -> None:
    job = plate_job()
    sweeps = Sweeps(Paths(interpret(program), job.tools))
    cut = sweeps.through(job.thickness)
    assert sweeps.through(job.thickness) is cut
    for sweep in cut:
        for shape in (shapely.box(-1, -1, 1, 1), shapely.box(30, 0, 32, 2), shapely.Point(90, 90)):
            near_ = sweep.chains[shapely.dwithin(sweep.chains, shape, sweep.radius)]
            some = sweep.paths_within_radius(shape)
            assert bool(len(near_)) == bool(shapely.dwithin(some, shape, sweep.radius).any())
        reach = shapely.union_all(shapely.buffer(sweep.chains, sweep.radius, quad_segs=64)).bounds
        wide = shapely.box(*np.add(reach, (-0.1, -0.1, 0.1, 0.1)))
        assert sweep.stays_inside(wide)
        assert not sweep.stays_inside(shapely.box(*np.add(reach, (0.1, -0.1, 0.1, 0.1))))
    assert MILL.radius in {sweep.radius for sweep in cut}


@pytest.mark.parametrize(("width", "reached"), [(4.0, False), (4.002, False), (4.004, True)])
def test_a_slot_is_within_reach_of_a_cutter_that_has_air_on_either_side(width: float, reached: bool) -> None:
    """A slot of the cutter's own width is listed as out of its reach; one that it fits into has to be cut."""
    half, long = width / 2, 24.0
    corners = [(-long, -half), (0, -half), (0, -8), (14, -8), (14, 8), (0, 8), (0, half), (-long, half)]
    recess = Pocket("pocket", Loop.polygon(corners), (), 0.0, 2.0)
    plate = Outline(Loop.polygon([(-35, -25), (35, -25), (35, 25), (-35, 25)]))
    part = Part("plate", plate, 8.0, "aluminium", machined=(recess,))
    cam = CamSettings.model_validate({"stock": {"margin": 0}, "tools": ["mill-4"]})
    job = make_job(part, cam, choose_tools(part, cam, load_library()))
    text = posted(job)
    proof = prove(text, job)
    assert proof.ok
    # The corners of the wide end keep r (1 - 1/√2) beside their walls, the slot half its width.
    corner = 2.0 * (1 - math.sqrt(0.5))
    assert proof.unreachable_max_mm == pytest.approx(corner if reached else half, abs=0.005)
    run = interpret(text)
    assert bool((run.end[run.cutting, 0] < -long + 2.1).any()) == reached


def test_moves_are_looked_at_in_lots_a_few_first(monkeypatch: pytest.MonkeyPatch) -> None:
    """Ten moves of two corners each: four first, and then as many as have ten corners together."""
    paths = paths_of("G1 Z-1 F100\n" + "\n".join(f"X{k}" for k in range(1, 10)))
    pieces = paths.below(-0.5, steps=paths.cuts)
    assert paths.corners(pieces).tolist() == [2] * 10
    monkeypatch.setattr(gouge, "MOST_CORNERS", 10)
    for first, sizes in ((4, [4, 5, 1]), (2, [2, 2, 5, 1]), (100, [4, 5, 1])):
        monkeypatch.setattr(gouge, "FIRST_ASKED", first)
        lots = list(gouge.lots(paths, pieces))
        assert [lot.size for lot in lots] == sizes
        assert np.concatenate(lots).tolist() == list(range(10))
