"""Pieces of a large plate, whose cells are wide: what holds them is found on narrow ones, and only what does."""

from dataclasses import replace

import numpy as np
import pytest
import shapely
from by_control import BY_NAME
from shop import plate_job

import mechwright_cam.proof.footprint as footprint
import mechwright_cam.proof.refinement as refinement
from mechwright_cam.proof import Check, Scene
from mechwright_cam.proof.holding import holding, remarks
from mechwright_cam.setup.job import Job

HEAD = "G17 G21 G40 G49 G80 G90\nG53 G0 Z0\nT3 M6\nG54 S8000 M3\nG43 H3 Z5\n"
WIDE = 1.0
"""Cells, mm: a bridge has to be 4.3 mm wide to be found on them, and 1.7 mm on the usual ones."""
STOCK = (-60.0, -50.0, 60.0, 50.0)
RADIUS, MIDDLE, TOWARDS = 3.0, (-52.5, -42.5), (0.5**0.5, -(0.5**0.5))
"""Of the mill, mm; and of the line that cuts a corner off: a place on it and its direction."""


@pytest.fixture
def wide(monkeypatch: pytest.MonkeyPatch) -> None:
    """The plate as if it were so large that its cells are wide, and windows as they are."""
    x0, y0, x1, y1 = STOCK
    monkeypatch.setattr(footprint, "MOST_CELLS", int((x1 - x0) * (y1 - y0) / WIDE**2))


def slit(start: float, end: float) -> str:
    """Cut through along the line between two distances from its middle, mm."""
    (x0, y0), (x1, y1) = ((MIDDLE[0] + at * TOWARDS[0], MIDDLE[1] + at * TOWARDS[1]) for at in (start, end))
    return f"G0 X{x0:.4f} Y{y0:.4f}\nZ1\nG1 Z-6.3 F100\nX{x1:.4f} Y{y1:.4f} F400\nG0 Z5\n"


def corner(bridge: float) -> str:
    """Both sides of a bridge from a corner of the plate to the rest, and along one of them again."""
    end = bridge / 2 + RADIUS
    return slit(-20, -end) + slit(20, end) + slit(-20, -end)


def job() -> Job:
    return replace(plate_job(), tabs=(), stock=STOCK)


def scene(moves: str) -> Scene:
    return Scene(f"{HEAD}{moves}M30\n", job(), BY_NAME["linuxcnc"])


def judged(moves: str) -> Check:
    return holding(scene(moves))


def test_cells_are_wide_here(wide: None) -> None:
    found = scene(corner(3.0))
    assert found.footprint.cell == pytest.approx(WIDE, rel=0.01)
    assert footprint.CELL < refinement.NARROWER * WIDE


@pytest.mark.parametrize("bridge", [2.0, 3.0, 6.0])
def test_a_bridge_that_usual_cells_show_holds_on_a_large_plate(wide: None, bridge: float) -> None:
    found = scene(corner(bridge))
    check = holding(found)
    assert check.passed, check.message
    assert not remarks(found)


def test_on_wide_cells_alone_it_were_missed(wide: None, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(refinement, "NARROWER", 0.0)
    assert not judged(corner(3.0)).passed
    assert judged(corner(6.0)).passed


@pytest.mark.parametrize("bridge", [-1.0, 0.0, 0.6, 1.0])
def test_what_is_no_bridge_holds_nothing(wide: None, bridge: float) -> None:
    found = judged(corner(bridge))
    assert not found.passed
    assert "passes a piece of" in found.message


def test_a_bridge_that_is_cut_later_holds_until_then(wide: None) -> None:
    through = slit(-6, 6)
    assert judged(corner(3.0) + through).passed  # the corner is free at last, and nothing follows
    found = judged(corner(3.0) + through + slit(-20, -5))
    assert not found.passed
    assert found.line is not None
    assert found.line > corner(3.0).count("\n")


def test_what_hangs_on_a_loose_piece_is_loose(wide: None) -> None:
    """The corner hangs by a bridge on a strip, and the strip is cut off where no window sees it."""
    strip = "G0 X-65 Y-18\nZ1\nG1 Z-6.3 F100\nX-36 Y-18 F400\nY-55\nG0 Z5\n"
    part_way = strip.replace("Y-55", "Y-40")
    assert judged(corner(3.0) + part_way + slit(-20, -5)).passed
    found = judged(corner(3.0) + strip + slit(-20, -5))
    assert not found.passed


@pytest.mark.parametrize("bridge", [0.5, 1.2, 1.8, 2.4])
def test_wide_cells_never_allow_what_usual_ones_refuse(
    monkeypatch: pytest.MonkeyPatch, bridge: float
) -> None:
    usual = judged(corner(bridge)).passed
    for width in (0.6, 0.9, 1.3):
        monkeypatch.setattr(footprint, "MOST_CELLS", int(120 * 100 / width**2))
        assert usual or not judged(corner(bridge)).passed


@pytest.mark.parametrize("distance", [0.0, 0.3, 0.8, 1.9, 4.0])
def test_what_is_near_a_small_piece_is_near_it_wherever_it_lies(distance: float) -> None:
    """Cells within a distance, against all distances between cells."""
    mask = np.zeros((23, 31), dtype=np.bool_)
    mask[20:22, 3:5] = mask[17, 9] = True
    none = np.zeros(mask.shape, dtype=np.int32)
    grid = footprint.Footprint(0.0, 0.0, 0.4, none, none, shapely.Polygon())
    found = grid.within(mask, distance)
    border = (found.shape[0] - mask.shape[0]) // 2
    rows, columns = np.nonzero(mask)
    y, x = np.mgrid[: found.shape[0], : found.shape[1]] - border
    away = np.hypot(y[..., None] - rows, x[..., None] - columns).min(axis=-1)
    assert (found == (away <= distance / 0.4)).all()
    assert not grid.within(np.zeros_like(mask), distance).any()


@pytest.mark.parametrize("middle", [True, False])
def test_a_piece_that_its_cut_mills_away_is_no_more(middle: bool) -> None:
    """A ring around a disc of 4 mm; the mill goes on over that, or not, and then round once more."""
    x, y = -48.0, -38.0
    ring = f"G3 X{x + 5} Y{y} I-5 J0 F400\n"
    over = f"G1 X{x} Y{y}\nX{x + 5}\n" if middle else ""
    check = judged(f"G0 X{x + 5} Y{y}\nZ1\nG1 Z-6.3 F100\n{ring}{over}{ring}{ring}G0 Z5\n")
    assert check.passed is middle
    assert middle or "passes a piece of" in check.message
