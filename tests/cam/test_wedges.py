"""The end of a slender wedge: the path goes in as far as a straight move may."""

import math

import numpy as np
import pytest
import shapely
from by_night import examples
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright.tolerances import TOLERANCES
from mechwright_cam.operations.wedges import TOUCH, into_wedges
from mechwright_plane.offsets import BIAS, grow, rings


def wedge(half_angle: float) -> shapely.Polygon:
    """A block with a V-shaped notch from above that ends in the origin."""
    width = 60 * math.tan(half_angle)
    return shapely.Polygon([(0, 0), (width, 60), (90, 60), (90, -9), (-90, -9), (-90, 60), (-width, 60)])


@settings(max_examples=examples(40, 100))
@given(half_angle=st.floats(math.radians(5), math.radians(50)), radius=st.floats(1, 5))
def test_the_path_ends_as_near_as_a_straight_move_may(half_angle: float, radius: float) -> None:
    keep = wedge(half_angle)
    (ring,) = rings(grow(keep, radius + BIAS), climb=True)
    deeper = into_wedges(ring, keep, radius, BIAS)
    assert np.array_equal(deeper[0], deeper[-1])
    lowest = deeper[np.argmin(np.where(deeper[:, 1] > -5, deeper[:, 1], np.inf))]
    reach = (radius + TOUCH) / math.sin(half_angle)
    gain = (BIAS - TOUCH) / math.sin(half_angle)
    if BIAS / math.sin(half_angle) > 0.0055:
        assert lowest == pytest.approx((0, reach), abs=0.1 * gain)
        assert len(deeper) == len(ring) + 2
    elif BIAS / math.sin(half_angle) < 0.0045:
        assert np.array_equal(deeper, ring)
    assert shapely.distance(keep, shapely.LineString(deeper)) >= radius + TOLERANCES.flatten


def test_convex_corners_and_wide_ones_are_left_alone() -> None:
    keep = shapely.union(shapely.box(0, 0, 40, 20), shapely.box(0, 0, 15, 50))
    (ring,) = rings(grow(keep, 4 + BIAS), climb=False)
    assert np.array_equal(into_wedges(ring, keep, 4.0, BIAS), ring)
