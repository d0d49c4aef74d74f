"""Heights at which a plate counts as cut through, windows around loose pieces, edges that hold: in closed form."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import shapely
from shop import TAB, plate_job
from test_proof_parts import paths_of

from mechwright_cam.proof import footprint, refinement, workholding
from mechwright_cam.proof.footprint import BEFORE, NEVER, SKIN, Footprint, Grid
from mechwright_cam.setup.job import Air

CELL = 0.5


def grid(rows: int = 60, columns: int = 80) -> Footprint:
    cut = np.full((rows, columns), NEVER, dtype=np.int32)
    return Footprint(-10.0, -20.0, CELL, cut, np.zeros_like(cut), shapely.Polygon())


@pytest.mark.parametrize(("high", "skin"), [(1.0, SKIN), (0.4, SKIN), (0.3, 0.15), (0.1, 0.05)])
def test_through_is_below_a_skin_and_below_the_lower_half_of_a_tab(high: float, skin: float) -> None:
    job = plate_job(hold=TAB.model_copy(update={"tab_height": high}))
    assert job.tabs
    ((level, there),) = footprint._openings(grid(), job)
    assert level == pytest.approx(-job.thickness + skin)
    assert there.all()
    ((level, _),) = footprint._openings(grid(), replace(job, tabs=()))
    assert level == pytest.approx(-job.thickness + SKIN)


def test_over_air_a_cut_is_through_where_it_meets_that() -> None:
    shape = shapely.box(0.0, 0.0, 10.0, 5.0)
    for top, before in ((-0.1, True), (-SKIN, True), (-0.21, False), (-3.0, False)):
        found = grid()
        job = replace(plate_job(), tabs=(), gone=(Air(shape, top),))
        levels = dict(footprint._openings(found, job))
        assert (found.cut == BEFORE).any() == before
        if before:
            assert list(levels) == [pytest.approx(-job.thickness + SKIN)]
            opened = found.cut == BEFORE
        else:
            assert sorted(levels) == [pytest.approx(-job.thickness + SKIN), pytest.approx(top + SKIN)]
            opened = levels[max(levels)]
        # The air, and what is near it: never less, and no more than some cells around.
        assert 50.0 < np.count_nonzero(opened) * CELL**2 < (10 + 4 * CELL) * (5 + 4 * CELL)


@pytest.mark.parametrize("shift", [0.0, 0.17, 0.3, 0.39])
def test_air_counts_in_the_cells_whose_middle_is_so_near_to_it_and_in_no_others(shift: float) -> None:
    """Around a corner of it as well, where what is near is round; one cell is half a millimetre."""
    found, shape = grid(), shapely.box(0.13 + shift, -7.29 + 0.72 * shift, 10.37, 5.11)
    list(footprint._openings(found, replace(plate_job(), tabs=(), gone=(Air(shape, -0.1),))))
    rows, columns = np.indices(found.cut.shape)
    middles = shapely.points(found.x + (columns + 0.5) * CELL, found.y + (rows + 0.5) * CELL)
    away, near = shapely.distance(shape, middles), footprint.UNSURE * CELL
    assert near == pytest.approx(CELL * (0.75 + math.sqrt(0.5)))
    opened = found.cut == BEFORE
    assert opened[away < near - 0.01 * CELL].all()
    assert not opened[away > near + 0.01 * CELL].any()


def test_a_window_reaches_so_many_cells_beyond_its_piece_and_ends_with_the_plate() -> None:
    away = int(np.ceil(refinement.AROUND))
    assert away == 6
    for (low, high), (left, right), bounds in (
        ((20, 24), (30, 33), (-10 + 24 * CELL, -20 + 14 * CELL, -10 + 40 * CELL, -20 + 31 * CELL)),
        ((2, 2), (5, 5), (-10, -20, -10 + 12 * CELL, -20 + 9 * CELL)),
        ((55, 59), (77, 79), (-10 + 71 * CELL, -20 + 49 * CELL, -10 + 80 * CELL, -20 + 60 * CELL)),
    ):
        wide = grid()
        cells = np.zeros(wide.cut.shape, dtype=np.bool_)
        cells[low, left] = cells[high, right] = True
        assert refinement._window(wide, SimpleNamespace(cells=cells)) == pytest.approx(bounds)  # type: ignore[arg-type]


def test_the_edge_holds_what_has_its_share_of_it() -> None:
    edge = workholding._edge(grid(20, 30))
    (rim,), (least,) = edge.places, edge.least
    assert np.count_nonzero(rim) == 2 * (20 + 30) - 4
    assert not rim[1:-1, 1:-1].any()
    assert least == int(workholding.LEAST_RIM * 96) + 1
    rows, columns = np.nonzero(rim)
    piece = np.zeros_like(rim)
    piece[rows[: least - 1], columns[: least - 1]] = True
    piece[5:9, 5:9] = True
    assert not edge.secures(piece, 0)
    piece[rows[least - 1], columns[least - 1]] = True
    assert edge.secures(piece, 0)


def test_places_are_in_cells_counted_from_the_lower_left_corner_of_a_grid_or_of_its_border() -> None:
    """Four rows and six columns of 0.5 mm from (1, 2) on; two more all around as a border."""
    grid = Grid(1.0, 2.0, 0.5, np.zeros((4, 6), dtype=np.int32))
    at = [
        (1.0, 2.0),
        (1.2, 2.6),
        (3.99, 3.99),
        (0.99, 2.1),
        (4.0, 2.1),
        (1.1, 1.99),
        (1.1, 4.0),
        (-0.01, 2.1),
        (5.0, 2.1),
        (1.1, 5.0),
    ]
    row, column, inside = grid.cells(np.array(at))
    assert list(zip(row.tolist(), column.tolist(), inside.tolist(), strict=True))[:3] == [
        (0, 0, True), (1, 0, True), (3, 5, True),
    ]  # fmt: skip
    assert not inside[3:].any()
    row, column, inside = grid.cells(np.array(at), border=2)
    assert (row[0], column[0]) == (2, 2)
    assert inside.tolist() == [True] * 7 + [False] * 3
    assert (row[5], column[3], row[6], column[4]) == (1, 1, 6, 8)


def test_the_place_of_some_cells_is_the_middle_of_that_in_their_middle() -> None:
    cells = np.zeros((9, 12), dtype=np.int32)
    found = Footprint(1.0, 2.0, 0.5, cells, cells, shapely.Polygon())
    for rows, columns in (
        (slice(2, 7), slice(3, 10)),
        (slice(4, 5), slice(0, 9)),
        (slice(1, 8), slice(11, 12)),
    ):
        mask = np.zeros(cells.shape, dtype=bool)
        mask[rows, columns] = True
        row, column = (rows.start + rows.stop - 1) / 2, (columns.start + columns.stop - 1) / 2
        assert found.place(mask) == pytest.approx((1.0 + (column + 0.5) * 0.5, 2.0 + (row + 0.5) * 0.5))


@pytest.mark.parametrize("turn", ["G2", "G3"])
@pytest.mark.parametrize("first", [0.3, 2.0, 4.0, 5.5])
@pytest.mark.parametrize("angle", [0.4, 2.5, 4.4, 6.0])
def test_an_arc_reaches_as_far_as_its_points(turn: str, first: float, angle: float) -> None:
    angles = first + np.linspace(0.0, angle if turn == "G3" else -angle, 4001)
    way = np.column_stack((np.cos(angles), np.sin(angles))) * 5.0 + (20.0, 10.0)
    (x, y), (u, v), (i, j) = way[0], way[-1], np.array([20.0, 10.0]) - way[0]
    arc = f"{turn} X{u:.6f} Y{v:.6f} I{i:.6f} J{j:.6f}"
    paths = paths_of(f"G0 X{x:.6f} Y{y:.6f} Z5\nG1 Z-1 F100\n{arc}")
    least, most = paths.extent(paths.cuts[-1:])
    np.testing.assert_allclose(least[0], way.min(axis=0), atol=1e-4)
    np.testing.assert_allclose(most[0], way.max(axis=0), atol=1e-4)
