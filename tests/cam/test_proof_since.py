"""What counts as cut is never more than was cut: widths of round cutters on ramps, and cylinders above the tip."""

import numpy as np
import pytest
from shop import MILL
from test_cleared import fresh, pocket, scene
from test_proof_parts import paths_of

from mechwright_cam.proof import swept_area
from mechwright_cam.proof.removal_time import Cells, Tracks, taking
from mechwright_cam.shop.tool import ToolKind

BALL = MILL.model_copy(update={"kind": ToolKind.BALL})
BULL = MILL.model_copy(update={"kind": ToolKind.BULL_NOSE, "corner_radius": 1.0})


def taken(lines: str, level: float, tool=BALL) -> list[tuple[float, float, float]]:  # type: ignore[no-untyped-def]
    """The pieces that go down to a level: from where to where on their move, and the radius that they take."""
    paths = paths_of(lines, tool)
    pieces, radius = taking(paths, paths.cuts, level)
    return [
        (round(a, 4), round(b, 4), round(r, 4))
        for a, b, r in zip(pieces.first.tolist(), pieces.last.tolist(), radius.tolist(), strict=True)
    ]


@pytest.mark.parametrize(
    ("lines", "level", "expected"),
    [
        ("G1 Z-2 F100", -1.0, [(0.6667, 1.0, 5**0.5)]),  # straight down it is as wide as at its lowest
        ("G1 X10 Z-2 F100", -1.0, []),  # at the upper end of what is deep enough a ball has no width
        ("G1 Z-2 F100\nX10", -1.0, [(0.6667, 1.0, 5**0.5), (0.0, 1.0, 5**0.5)]),
        ("G1 Z-2 F100\nX10 Z-1.5", -1.0, [(0.6667, 1.0, 5**0.5), (0.0, 1.0, (9 - 2.5**2) ** 0.5)]),
        ("G0 X2\nG3 I-2 Z-2 F100", -1.0, []),  # an arc that ends where it begins is not straight down
        ("G1 Z-1 F100", -1.5, []),
        ("G0 X4 Y-3\nG1 Z-2 F100", -1.0, [(0.6667, 1.0, 5**0.5)]),
        ("G0 X-5 Y2\nG0 Z0\nG1 X5 Y-2 Z-2.5 F100", -1.0, []),  # through the middle it is no plunge
    ],
)
def test_a_ball_takes_what_it_takes_all_along(
    lines: str, level: float, expected: list[tuple[float, float, float]]
) -> None:
    lines = lines.replace("G1 Z-2", "G0 Z1\nG1 Z-2")
    for found, wanted in zip(taken(lines, level), expected, strict=True):
        assert found == pytest.approx(wanted, abs=1e-4)


def test_a_bull_nose_on_a_ramp_takes_its_flat_and_a_flat_mill_all() -> None:
    ramp = "G1 X10 Z-2 F100"  # from Z5: below -1 from 6/7 on
    assert taken(ramp, -1.0, BULL) == [(0.8571, 1.0, 2.0)]
    assert taken(ramp, -1.0, MILL) == [(0.8571, 1.0, 3.0)]


def test_cells_are_cut_where_all_of_them_is_and_by_the_first_step() -> None:
    """A slot of 6 mm from X0 to X20, gone twice, and half of it a third time."""
    paths = paths_of("G1 Z-2 F100\nX20\nX0\nX10", MILL)
    window = np.array([[-10.0, -10.0], [30.0, 10.0]])
    cells = Cells(paths, taking(paths, paths.cuts, -1.0), -1.0, window, 250_000)
    cell = cells.grid.cell
    first = int(paths.cuts[1])

    def latest(x0: float, y0: float, x1: float, y1: float) -> int:
        return int(cells.latest(np.array([[x0, y0]]), np.array([[x1, y1]]))[0])

    inside = 3.0 - 2 * cell
    assert latest(1.0, -inside / 2, 19.0, inside / 2) <= first
    assert latest(0.0, inside - cell, 20.0, inside - cell) == first
    for y in (3.0, -3.0, 3.0 + cell, -3.0 - cell):
        assert latest(1.0, y, 19.0, y) > paths.steps[-1]
    assert latest(-4.0, 0.0, 19.0, 0.0) > paths.steps[-1]
    assert latest(-30.0, -30.0, -20.0, -20.0) == -1  # beside the grid nothing is known to stand
    ys, xs = np.nonzero(cells.grid.cut <= paths.steps[-1])
    x, y = cells.grid.x + xs * cell, cells.grid.y + ys * cell
    for dx, dy in ((0, 0), (cell, 0), (0, cell), (cell, cell)):
        out = np.hypot(np.maximum(np.maximum(-(x + dx), x + dx - 20), 0), y + dy)
        assert out.max() <= 3.0
    area = xs.size * cell**2
    assert 0.95 * (120 + 9 * np.pi) < area < 120 + 9 * np.pi


def test_a_line_across_a_gap_of_tracks_is_not_known() -> None:
    first, last = np.array([[0.0, 1.0], [4.0, 1.0]]), np.array([[3.0, 1.0], [9.0, 1.0]])
    tracks = Tracks(first, last, np.array([3, 5]), 0)

    def latest(x0: float, x1: float, y: float = 1.0) -> int:
        return int(tracks.latest(np.array([[x0, y]]), np.array([[x1, y]]))[0])

    assert latest(0.0, 3.0) == latest(0.0, 0.0) == latest(1.0, 2.0) == 3
    assert latest(4.0, 9.0) == latest(9.0, 9.0) == 5
    for x0, x1, y in ((2.0, 5.0, 1.0), (3.0, 4.0, 1.0), (-0.1, 1.0, 1.0), (8.0, 9.1, 1.0), (1.0, 2.0, 1.1)):
        assert latest(x0, x1, y) > 5


@pytest.mark.parametrize(("lift", "clear"), [(0.5, True), (0.6, True), (0.4, False), (0.0, False)])
def test_a_cylinder_above_the_tip_is_asked_about_where_it_begins(lift: float, clear: bool) -> None:
    """The pocket is 1 mm deep; in it the tip goes down to 1.5 mm, with a shank that is no wider than itself."""
    many = [f"G0 X{x}" for k in range(swept_area.FEW) for x in (5 + k % 5 / 10, -5)]
    of = scene([*pocket(-1), "G0 Z5", "G0 X-5 Y0", "G0 Z-1.5", *many])
    steps = of.paths.rapids[of.paths.low[of.paths.rapids] == -1.5]
    assert steps.size > swept_area.FEW
    stock = fresh(of)
    assert (stock.suspects(steps, lift=lift, radius=2.9).size == 0) is clear
    assert stock.meets(int(steps[-1]), lift=lift, radius=2.9) is not clear
