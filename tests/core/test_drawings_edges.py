"""Contours of a chamfer's layer are the edges that they lie on, however large these are."""

import pytest
from fuzzing import alarm

from mechwright.contracts.details import Chamfer
from mechwright.drawings.edged import NEAR, alike, is_edge
from mechwright.geometry import Loop, circle

shapely = pytest.importorskip("shapely")


class Drawn:
    """A contour."""

    def __init__(self, radius: float, centre: tuple[float, float] = (3.0, 4.0)) -> None:
        self.loop = Loop((circle(centre, radius),))


@pytest.mark.parametrize("radius", [5.0, 400.0])
@pytest.mark.parametrize("side", ["inside", "outside"])
def test_a_contour_is_the_edge_or_where_its_chamfer_ends_and_no_other(radius, side):
    edge = Chamfer("edge", Drawn(radius).loop, side, 0.5)
    beyond = 0.5 if side == "inside" else -0.5
    for ends in (radius, radius + beyond):
        assert is_edge(Drawn(ends), edge)
        assert is_edge(Drawn(ends + 0.9 * NEAR), edge)
        assert is_edge(Drawn(ends - 0.9 * NEAR), edge)
        assert not is_edge(Drawn(ends + 1.1 * NEAR), edge)
        assert not is_edge(Drawn(ends - 1.1 * NEAR), edge)
    assert not is_edge(Drawn(radius - beyond), edge)
    assert not is_edge(Drawn(radius, (3.0, 4.0 + 1.1 * NEAR)), edge)


def test_one_line_within_another_is_not_it():
    """A notch that goes back on itself lies on the straight edge from there to here, and leaves no gap in it."""
    square = shapely.LinearRing([(0, 0), (10, 0), (10, 10), (0, 10)])
    notched = shapely.LinearRing([(0, 0), (4, 0), (4, 3), (5, 3), (5, 0), (10, 0), (10, 10), (0, 10)])
    assert not alike(square, notched)
    assert not alike(notched, square)
    assert alike(square, shapely.LinearRing([(0, 10), (10, 10), (10, 0), (0, 0)]))


def test_a_contour_of_many_corners_is_compared_in_seconds():
    """It took time in proportion to the square of its corners: minutes for one of a hundred metres."""
    edge = Chamfer("edge", Drawn(50_000.0).loop, "inside", 0.5)
    with alarm(10):
        assert is_edge(Drawn(50_000.0), edge)
        assert not is_edge(Drawn(50_000.1), edge)
