"""What a mill takes at once is measured on fine cells where wide ones say that it is too much."""

from dataclasses import replace

import pytest
from by_control import BY_NAME
from shop import DRILL, MILL, SPOT, plate_job

import mechwright_cam.proof.depth_of_cut as depth_of_cut
import mechwright_cam.proof.simulation as simulation
from mechwright_cam.proof import Scene
from mechwright_cam.shop.tool import CuttingData

CUTTING = CuttingData(cutting_speed=200.0, chip_load=0.03, step_down=0.1, step_over=0.4)
LIMIT = depth_of_cut.SECTIONS * CUTTING.step_down * MILL.diameter**2
"""mm²: 1.2 mm of the thickness of 6 mm."""
EDGE = 28.0
"""The plate's lower edge, mm below the middle."""


def scene(width: float) -> Scene:
    """Along the plate's lower edge at full depth, so many mm wide."""
    mill = MILL.model_copy(update={"cutting": {"aluminium": CUTTING}})
    job = replace(plate_job(tools=(SPOT, DRILL, mill)), stock=(-60.0, -EDGE, 60.0, EDGE))
    y = -EDGE - MILL.diameter / 2 + width
    text = (
        "G17 G21 G40 G49 G80 G90\nG53 G0 Z0\nT3 M6\nG54 S8000 M3\nG43 H3 Z5\n"
        f"G0 X-70 Y{y:.4f}\nZ1\nG1 Z-6 F100\nX70 F400\nG0 Z5\nM30\n"
    )
    return Scene(text, job, BY_NAME["linuxcnc"])


def refused(width: float) -> bool:
    return depth_of_cut._sections(scene(width)) is not None


@pytest.fixture
def wide(monkeypatch: pytest.MonkeyPatch) -> None:
    """Cells of 1 mm, as a plate of a metre has them."""
    monkeypatch.setattr(simulation, "FINEST", 1.0)


def test_the_limit_is_where_it_should_be() -> None:
    assert pytest.approx(7.2) == LIMIT
    assert LIMIT / plate_job().thickness == pytest.approx(1.2)


@pytest.mark.parametrize("width", [0.3, 0.6, 0.9, 1.0, 1.1])
def test_what_is_below_the_limit_passes_on_wide_cells(wide: None, width: float) -> None:
    assert not refused(width)


@pytest.mark.parametrize("width", [1.35, 1.5, 1.8, 2.1, 2.5, 4.0])
def test_what_is_above_it_is_refused(wide: None, width: float) -> None:
    assert refused(width)


def test_wide_cells_alone_refuse_less_than_the_limit(wide: None, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(depth_of_cut, "MOST_DOUBTS", 0)
    assert any(refused(width) for width in (1.0, 1.1))
