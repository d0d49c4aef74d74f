"""Programs with their tabs elsewhere than planned: the tabs that they leave are found, and judged by their size."""

import pytest
import shapely
from by_control import BY_NAME, prove
from shop import plate_job, plate_program

from mechwright_cam.controls.linuxcnc import LinuxCnc
from mechwright_cam.proof import Scene
from mechwright_cam.proof import found_tabs as module
from mechwright_cam.proof.found_tabs import found_tabs
from mechwright_cam.setup.job import Job

CLEAN = LinuxCnc().write(plate_program())
"""Four tabs of 3 by 1.1 mm, one in the middle of each side."""
OVER = "Z-4.9\nY4.51\nZ-6.3 F150\n"


def asked(**hold: object) -> Job:
    """Two tabs are planned, in the middle of the long sides."""
    return plate_job(hold={"tabs": 2, "tab_width": 3.0, "tab_height": 1.0, **hold})


def test_tabs_are_found_where_they_are() -> None:
    found = found_tabs(Scene(CLEAN, asked(), BY_NAME["linuxcnc"]))
    places = sorted((round(tab.at[0]), round(tab.at[1])) for tab in found)
    assert places == [(-30, 0), (0, -20), (0, 20), (30, 0)]
    for tab in found:
        assert tab.top == pytest.approx(-4.9)
        # The cutters stand 9.02 mm apart on both sides of it: 9.02 - 6, less the accuracy.
        assert tab.width == pytest.approx(3.02, abs=0.05)


def test_tabs_elsewhere_are_stock_left_unless_they_are_asked_for_where_they_are() -> None:
    assert {c.name for c in prove(CLEAN, asked()).failures} == {"leftover"}
    proof = prove(CLEAN, asked(tab_places="found"))
    assert proof.ok
    assert proof.checks["tabs"].message == "4 tabs are found, and strong enough"


@pytest.mark.parametrize(
    ("width", "height", "passed"), [(3.0, 1.0, True), (6.0, 2.0, True), (7.0, 2.0, False), (9.0, 3.0, False)]
)
def test_their_cross_sections_are_half_of_the_planned_ones(width: float, height: float, passed: bool) -> None:
    """Four of 3 by 1.1 mm are 13 mm²; two of 6 by 2 would be 24, two of 7 by 2 mm 28."""
    of = asked(tab_places="found", tab_width=width, tab_height=height)
    found = prove(CLEAN, of).checks["tabs"]
    assert found.passed == passed
    assert passed or "4 tab(s) of 13.2 mm² in all hold outside, two and" in found.message


def test_without_tabs_the_part_is_loose() -> None:
    lines = CLEAN.splitlines()
    low = [k for k, line in enumerate(lines) if line.startswith("Z-4.9")]
    text = "\n".join(line for k, line in enumerate(lines) if k not in low) + "\n"
    names = {c.name for c in prove(text, asked(tab_places="found")).failures}
    assert {"tabs", "holding"} <= names
    assert OVER in CLEAN
    three = prove(CLEAN.replace(OVER, ""), asked(tab_places="found"))
    assert three.checks["tabs"].message == "3 tabs are found, and strong enough"
    assert three.ok


@pytest.mark.parametrize(("x", "y"), [(30.05, 0.0), (-30.05, 0.0), (0.0, 20.05), (0.0, -20.05)])
@pytest.mark.parametrize("way", [1, -1])
def test_a_tab_goes_outwards_whichever_way_its_line_runs(x: float, y: float, way: int) -> None:
    scene = Scene(CLEAN, asked(), BY_NAME["linuxcnc"])
    ox, oy = (x > 0) - (x < 0), (y > 0) - (y < 0)
    wall = shapely.LineString([(x, y), (x - 9 * ox, y - 9 * oy)]).buffer(20.0, cap_style="flat")
    ends = [(x - way * side * oy, y + way * side * ox) for side in (-3.0, 3.0)]
    frame = shapely.LineString([(x, y), (x + 9 * ox, y + 9 * oy)]).buffer(1.5, cap_style="flat")
    tab = module._tab(scene, wall, shapely.LineString(ends), frame)
    assert tab is not None
    assert tab.at == pytest.approx((x, y))
    assert (tab.along[1], -tab.along[0]) == pytest.approx((ox, oy))
    assert tab.width == pytest.approx(3.0 - 2 * module.BRIDGE)
    assert tab.top == pytest.approx(-4.9)
    outside = shapely.difference(tab.shape, wall)
    assert outside.area == pytest.approx(tab.width * 6.0, rel=0.01)  # across the channel of the mill
