"""Mills for an outside: the ladder of least time."""

from itertools import combinations

import pytest
import shapely
from planning_parts import LIBRARY, job
from planning_parts import part as plate_of

from mechwright.contracts.part import Loop
from mechwright_cam.operations.ladder import change_time, channel_time, ladder, left_by, rest_time
from mechwright_cam.planning import choose_tools
from mechwright_cam.shop.settings import CamSettings

NAMES = (
    "mill-16",
    "mill-12",
    "mill-10",
    "mill-8",
    "mill-6",
    "mill-5",
    "mill-4",
    "mill-3",
    "mill-2.5",
    "mill-2",
)


def comb(gap: float, count: int = 12, deep: float = 9.0) -> list[tuple[float, float]]:
    """Corners of a plate with slots in its upper edge, so wide and so deep, mm."""
    pitch = 2.5 * gap
    width = count * pitch + 20
    top = [
        (width - 10 - pitch * n - across, y)
        for n in range(count)
        for across, y in ((0, 15.0), (0, 15 - deep), (gap, 15 - deep), (gap, 15.0))
    ]
    return [(0, -15), (width, -15), (width, 15), *top, (0, 15)]


def seconds(of, shape, mills):
    """Estimated time of a ladder, added up by hand."""
    deep, left = -of.floor, [left_by(shape, mill.radius + of.settings.stock_to_leave) for mill in mills]
    total = channel_time(of, shape, mills[0], deep)
    for before, after, mill in zip(left, left[1:], mills[1:], strict=False):
        total += change_time(of) + rest_time(of, mill, deep, before[0] - after[0], before[1])
    return total


@pytest.mark.parametrize("gap", [2.2, 4.5, 7.0])
def test_no_other_ladder_is_faster(gap: float) -> None:
    """All ladders that end with the finest are tried, which the choice finds by pairs."""
    shape = shapely.Polygon(comb(gap))
    mills = [LIBRARY.get(name) for name in NAMES if LIBRARY.get(name).diameter < 1.9 * gap + 3]
    finest = next(mill for mill in mills if mill.diameter <= 0.8 * gap or mill is mills[-1])
    of = job(plate_of(Loop.polygon(comb(gap))), *NAMES)
    wide = [mill for mill in mills if mill.diameter > finest.diameter]
    every = [[*some, finest] for n in range(len(wide) + 1) for some in combinations(wide, n)]
    best = min(every, key=lambda tools: seconds(of, shape, tools))
    found = ladder(of, shape, mills, finest)[1]
    assert seconds(of, shape, found) == pytest.approx(seconds(of, shape, best), rel=1e-6)
    assert found[-1] is finest


def test_a_change_that_takes_long_makes_ladders_shorter() -> None:
    """Fine slots: between the mill of the channel and that of the slots another takes what it can."""
    of = plate_of(Loop.polygon(comb(3.0)), thickness=10.0)
    mills = {
        change: [
            tool.name
            for tool in choose_tools(
                of, CamSettings.model_validate({"machine": {"tool_change": change}}), LIBRARY
            )
            if tool.name.startswith("mill")
        ]
        for change in (0, 600)
    }
    assert mills[0] == ["mill-6", "mill-2.5", "mill-2"]
    assert mills[600] == ["mill-2"]
