"""Heights at which a plate counts as cut through, windows around loose pieces, edges that hold: in closed form."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import shapely
from shop import TAB, plate_job

from mechwright_cam.proof import closer, footprint, grips
from mechwright_cam.proof.footprint import BEFORE, NEVER, SKIN, Footprint
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
    away = int(np.ceil(closer.AROUND))
    assert away == 6
    for (low, high), (left, right), bounds in (
        ((20, 24), (30, 33), (-10 + 24 * CELL, -20 + 14 * CELL, -10 + 40 * CELL, -20 + 31 * CELL)),
        ((2, 2), (5, 5), (-10, -20, -10 + 12 * CELL, -20 + 9 * CELL)),
        ((55, 59), (77, 79), (-10 + 71 * CELL, -20 + 49 * CELL, -10 + 80 * CELL, -20 + 60 * CELL)),
    ):
        wide = grid()
        cells = np.zeros(wide.cut.shape, dtype=np.bool_)
        cells[low, left] = cells[high, right] = True
        assert closer._window(wide, SimpleNamespace(cells=cells)) == pytest.approx(bounds)  # type: ignore[arg-type]


def test_the_edge_holds_what_has_its_share_of_it() -> None:
    edge = grips._edge(grid(20, 30))
    (rim,), (least,) = edge.places, edge.least
    assert np.count_nonzero(rim) == 2 * (20 + 30) - 4
    assert not rim[1:-1, 1:-1].any()
    assert least == int(grips.LEAST_RIM * 96) + 1
    rows, columns = np.nonzero(rim)
    piece = np.zeros_like(rim)
    piece[rows[: least - 1], columns[: least - 1]] = True
    piece[5:9, 5:9] = True
    assert not edge.holds(piece, 0)
    piece[rows[least - 1], columns[least - 1]] = True
    assert edge.holds(piece, 0)
