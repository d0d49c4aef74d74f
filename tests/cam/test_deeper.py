"""Stock that is the same above and below the tops of the tabs is roughed in one go, and air is fed through."""

import math

import pytest
from by_control import posted, prove
from planning_parts import LIBRARY, bore, job, lobes, part

from mechwright_cam.operations.thin_cuts import SHARES
from mechwright_cam.planning import plan
from mechwright_cam.program.moves import Feed, FeedArc, Rapid

GAPS = 9
TOOTHED = part(lobes(GAPS, 15.0, 4.0, 900, 1.5), bore(8))
MILLS = ("mill-8", "mill-3")


def rests(of):
    """Moves of roughing the rest, operation by operation."""
    every = (o for s in plan(of).sections for o in s.operations)
    return {o.name: o.moves for o in every if o.name.endswith("rough the rest")}


def comings(moves):
    """How often the cutter comes from above, and the lowest place after each."""
    found = []
    for move in moves:
        if isinstance(move, Rapid) and move.z is not None and move.z < 5:
            found.append(math.inf)
        elif found and getattr(move, "z", None) is not None:
            found[-1] = min(found[-1], move.z)
    return found


def test_a_gap_without_a_tab_is_visited_once() -> None:
    of = job(TOOTHED, *MILLS)
    floor, low = of.floor, of.tabs[0].top
    upper, lower = rests(of).values()
    deep = comings(upper)
    through = sum(z == pytest.approx(floor) for z in deep)
    assert through >= GAPS - 2 * len(of.tabs)
    assert len(deep) >= GAPS
    assert all(z == pytest.approx(floor) or z >= low - 1e-6 for z in deep)
    # What is left to the lower layer is beside tabs.
    assert 0 < len(comings(lower)) <= 4 * len(of.tabs)
    prove(posted(of), of).require()


def test_the_way_down_in_the_clear_is_fed_faster() -> None:
    of = job(TOOTHED, *MILLS)
    moves = next(iter(rests(of).values()))
    down = {m.feed for m in moves if isinstance(m, Feed) and m.x is None and m.z is not None and m.z < 0}
    across = {m.feed for m in moves if isinstance(m, Feed | FeedArc) and m.x is not None}
    mill = LIBRARY.get("mill-3")
    data = mill.cutting["aluminium"]
    cut = of.settings.machine.spindle_max * mill.flutes * data.chip_load
    assert down == {math.floor(1.5 * cut)}
    assert {round(feed / cut, 2) for feed in across} <= {1.0, *SHARES}
