"""How a cutter goes down along a circle, and which narrow places it clears with which path."""

import math
from dataclasses import replace
from itertools import pairwise
from types import SimpleNamespace

import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from planning_parts import LIBRARY

from mechwright_cam.operations.clearing import COARSE_FROM
from mechwright_cam.operations.layer import NEARLY, Layer
from mechwright_cam.operations.pen import Pen
from mechwright_cam.operations.rates import Rates
from mechwright_cam.operations.runs import Cavity, Run, write_levels
from mechwright_cam.program.moves import Feed, FeedArc, Rapid
from mechwright_cam.shop.settings import CamSettings
from mechwright_plane.path import circle, polyline

RATES = Rates(10_000, 1000, 500, 250, 5000, 0.03, 1000)


def turns(pen: Pen) -> list[FeedArc]:
    return [move for move in pen.moves if isinstance(move, FeedArc)]


@given(
    st.floats(1.0, 20.0), st.floats(0.5, 20.0), st.floats(0.0, 5.0), st.floats(0.1, 6.0), st.floats(0.2, 4.0)
)
def test_a_helix_is_no_steeper_than_it_may_be_and_no_longer_than_that_takes(angle, radius, top, depth, step):
    slope = math.tan(math.radians(angle))
    pen = Pen(LIBRARY.get("mill-6"), RATES, 10.0, slope)
    pen.helix(circle((3.0, 1.0), radius, (3.0 + radius, 1.0), True), radius, top, top - depth, step)
    most = min(step, slope * math.tau * radius)
    heights = [top, *(move.z for move in turns(pen) if move.z is not None)]
    assert heights[-1] == pytest.approx(top - depth, abs=1e-4)
    assert all(one >= two for one, two in pairwise(heights))
    # Whole turns, as long as the one at the bottom, each within the tenth of a micrometre that is printed.
    pieces = len([move for move in turns(pen) if move.z is None])
    whole = heights[::pieces]
    assert len(heights) - 1 == pieces * (len(whole) - 1)
    assert depth / most - 1e-3 <= len(whole) - 1 <= math.ceil(depth / (0.998 * most)) + 1
    assert max(one - two for one, two in pairwise(whole)) <= most * (1 + 1e-9) + 2e-4


@pytest.mark.parametrize("count", [1, 2, 10])
def test_a_helix_as_deep_as_whole_turns_are_steep_has_one_more(count):
    """Rounding of heights makes some turns steeper than they are on average, and none may be too steep."""
    slope = math.tan(math.radians(3))
    pen = Pen(LIBRARY.get("mill-6"), RATES, 10.0, slope)
    most = slope * math.tau * 5.0
    pen.helix(circle((0.0, 0.0), 5.0, (5.0, 0.0), True), 5.0, 0.0, -count * most)
    pieces = len([move for move in turns(pen) if move.z is None])
    whole = [0.0, *(move.z for move in turns(pen) if move.z is not None)][::pieces]
    assert len(whole) - 1 == count + 1
    assert max(one - two for one, two in pairwise(whole)) < most


@pytest.mark.parametrize("angle", [1.0, 3.0, 8.0])
def test_a_way_down_is_fed_between_a_cut_and_a_ramp_as_it_is_steep(angle):
    """Of 0 a cut's feed, from the ramp's own slope on, 3 degrees at most, the ramp's, and evenly between them."""
    ramp = 336.0
    pen = Pen(LIBRARY.get("mill-6"), replace(RATES, ramp=ramp), 10.0, math.tan(math.radians(angle)))
    steep, full = math.tan(math.radians(min(angle, 3.0))), ramp / 0.5
    for share in (0.0, 0.25, 0.6, 0.95):
        wanted = full + (ramp - full) * share
        assert pen.ramp_feed(share * steep * 40.0, 40.0) == pytest.approx(wanted, abs=5.0)
    assert pen.ramp_feed(-1.0, 40.0) == pytest.approx(full, abs=5.0)
    steepest = {pen.ramp_feed(share * steep * 40.0, 40.0) for share in (1.0, 1.5, 20.0)}
    assert len({*steepest, pen.ramp_feed(1.0, 0.0)}) == 1  # not another one beyond the steepest
    assert ramp <= steepest.pop() <= ramp + 5.0


class Cuts:
    """A layer of which it is known how much of a heavy area of 100 mm² each allowance takes off."""

    rough_heavy, _writing = Layer.rough_heavy, Layer._writing
    settings = CamSettings()

    def __init__(self, **taken: float) -> None:
        self.taken, self.ran, self.left = taken, [], 100.0
        self.steps = SimpleNamespace(step_down=lambda mill, to_size=False: 1.0)
        self.stock = None

    def _heavy(self, _):
        self.left = self.left if self.stock is None else self.stock
        return shapely.box(0, 0, 10, self.left / 10) if self.left else shapely.Polygon()

    def _roughing(self, _, allowance, thick):
        share = self.taken["coarse" if allowance == COARSE_FROM else "exact"]
        after = self.left * (1 - share)
        return SimpleNamespace(
            taken=share * thick.area,
            write=lambda *_, **__: None,
            after_core=lambda: after,
            allowance=allowance,
        )

    def add(self, what, mill, write):
        self.ran.append(write.func)


@pytest.mark.parametrize(
    ("coarse", "exact", "passes", "left"),
    [
        (1.0, 1.0, 1, 0.0),  # nothing is left for the exact path
        (NEARLY, 1.0, 2, 0.0),  # worth its time: then the exact one takes the rest
        (NEARLY - 0.01, 1.0, 1, 0.0),  # the exact one has to go there anyway, and goes alone
        (0.0, 1.0, 1, 0.0),
        (0.0, 0.2, 1, 80.0),  # the exact one takes what it can, however little
    ],
)
def test_a_coarse_path_through_narrow_places_is_run_where_it_takes_nearly_all(coarse, exact, passes, left):
    layer = Cuts(coarse=coarse, exact=exact)
    layer.rough_heavy(LIBRARY.get("mill-6"))
    assert len(layer.ran) == passes
    assert layer.stock == pytest.approx(left)


@pytest.mark.parametrize("cleared", [True, False])
@pytest.mark.parametrize("back", [True, False])
def test_with_a_way_back_the_cutter_stays_in_its_cavity_from_level_to_level(back, cleared):
    """Two runs at three levels: it comes to the first from above, and later at depth, at the feed for air if it may."""
    first, second = (polyline([(0.0, y), (20.0, y)]) for y in (0.0, 3.0))
    runs = (Run(first, open=True, linked=False), Run(second, open=True, linked=True))
    pen = Pen(LIBRARY.get("mill-6"), RATES, 10.0, math.tan(math.radians(3)))
    write_levels(
        pen, Cavity(shapely.box(0, 0, 20, 3), runs, back, cleared), 0.0, [-1.0, -2.0, -3.0], thinning=False
    )
    lifts = [move for move in pen.moves if isinstance(move, Rapid) and move.z == 10.0 and move.x is None]
    assert len(lifts) == (0 if back else 2)
    returns = [m for m in pen.moves if isinstance(m, Feed) and (m.x, m.y) == (0.0, 0.0)]
    assert [move.feed for move in returns] == ([pen.air if cleared else RATES.feed] * 2 if back else [])
    assert [m.z for m in pen.moves if isinstance(m, Feed) and m.x is None] == ([-1.0, -2.0, -3.0])
