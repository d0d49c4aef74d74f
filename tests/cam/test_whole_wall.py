"""A wall with tabs is finished from top to underside at once, lifted over the tabs."""

import numpy as np
import pytest
import shapely
from by_control import posted, prove
from planning_parts import LIBRARY, bore, job, lobes, part, plate

from mechwright_cam.planning import plan
from mechwright_cam.program.moves import Feed, FeedArc, Rapid

TOOTHED = part(lobes(9, 15.0, 4.0, 900, 1.5), bore(8))
PARTS = {"teeth": (TOOTHED, ("mill-8", "mill-3")), "plate": (plate(), ("mill-6",))}
SAMPLE = 0.05


def finishing(of):
    """Moves of finishing, operation by operation."""
    every = (o for s in plan(of).sections for o in s.operations)
    return {o.name: o.moves for o in every if o.name.startswith("outside") and o.name.endswith("finish")}


def walked(moves):
    """Each feed with its points (n, 2), its height before and after it, z in mm."""
    here, z = np.zeros(2), 5.0
    for move in moves:
        x = here[0] if getattr(move, "x", None) is None else move.x
        y = here[1] if getattr(move, "y", None) is None else move.y
        lower = z if getattr(move, "z", None) is None else move.z
        end = np.array((x, y))
        points = np.array((here, end))
        if isinstance(move, FeedArc):
            centre = here + np.array((move.i, move.j))
            a, b = (np.arctan2(*(p - centre)[::-1]) for p in (here, end))
            turn = (b - a) % (2 * np.pi) if move.ccw else -((a - b) % (2 * np.pi))
            angle = a + turn * np.linspace(0, 1, 2 + int(abs(turn) * np.hypot(move.i, move.j) / SAMPLE))
            points = centre + np.hypot(move.i, move.j) * np.column_stack((np.cos(angle), np.sin(angle)))
        if not isinstance(move, Rapid):
            yield move, points, z, lower
        here, z = end, lower


@pytest.mark.parametrize("name", PARTS)
def test_a_wall_is_finished_at_once_and_its_tabs_stay(name):
    of = job(PARTS[name][0], *PARTS[name][1])
    (moves,) = finishing(of).values()
    mill = LIBRARY.get(PARTS[name][1][-1])
    tabs = shapely.union_all([tab.shape for tab in of.tabs])
    top = max(tab.top for tab in of.tabs)
    over = 0
    for _, points, before, after in walked(moves):
        way = shapely.LineString(points) if np.ptp(points, axis=0).any() else shapely.Point(points[0])
        if min(before, after) < top - 1e-6:
            assert way.distance(tabs) >= mill.radius - 1e-6
        elif after == pytest.approx(top):
            over += way.distance(tabs) < mill.radius / 2
    assert over >= len(of.tabs) * (1 + of.settings.spring_passes)
    prove(posted(of), of).require()


def test_behind_a_tab_the_mill_goes_down_slowly_once_and_faster_in_the_same_way_again():
    of = job(plate(), "mill-6")
    (moves,) = finishing(of).values()
    down = [
        m.feed
        for m, _, before, after in walked(moves)
        if isinstance(m, Feed) and m.x is None and after < before
    ]
    up = [
        m.feed
        for m, _, before, after in walked(moves)
        if isinstance(m, Feed) and m.x is None and after > before
    ]
    data = LIBRARY.get("mill-6").cutting["aluminium"]
    deep = [feed for feed in down if feed == pytest.approx(min(down))]
    assert len(deep) == len(of.tabs)
    assert len(up) == 2 * len(of.tabs)
    assert min(down) < data.plunge * 1.01 * max(down)


def test_a_compensated_wall_is_finished_layer_by_layer():
    assert len(finishing(job(plate(), "mill-6", compensation="wear"))) == 2
