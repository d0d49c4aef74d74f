"""Which moves straight down meet nothing, told at once, against what is told move by move."""

import numpy as np
import pytest
from by_control import posted, scene_of
from planning_parts import bore, job, plate


@pytest.mark.parametrize("shrunk", [0.05, 0.4, 1.5])
@pytest.mark.parametrize("lift", [0.0, 0.3])
def test_what_is_bored_meets_nothing(shrunk: float, lift: float) -> None:
    made = job(plate(bore(12.0)), "spot-6", "drill-8", "mill-6", "mill-3")
    scene = scene_of(posted(made), made)
    paths, stock = scene.paths, scene.stock
    steps = paths.cuts[paths.low[paths.cuts] < -0.5]
    some = 0
    for tool in scene.tools.values():
        mine, radius = steps[scene.run.tool[steps] == tool.number], max(tool.radius - shrunk, 0.1)
        bored = stock.bored(mine, lift=lift, radius=radius)
        some += int(bored.sum())
        assert not any(stock.meets(step, lift=lift, radius=radius) for step in mine[bored].tolist())
    assert some or shrunk < 1.5


def test_the_first_move_down_is_not_bored() -> None:
    made = job(plate(bore(12.0)), "spot-6", "drill-8", "mill-6")
    scene = scene_of(posted(made), made)
    paths = scene.paths
    deepest = np.array([paths.cuts[np.argmax(paths.low[paths.cuts] < -0.5)]])
    assert not scene.stock.bored(deepest, lift=0.0, radius=1.0).any()
