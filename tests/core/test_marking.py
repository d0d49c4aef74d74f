"""Marks find the freest place, keep clear of all edges, and are refused with letters that would fit."""

import re

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright.contracts.details import Chamfer, Engraving, band_of
from mechwright.contracts.edges import deburred
from mechwright.contracts.holes import threaded
from mechwright.contracts.marking import CHORD, MARGIN, marked
from mechwright.contracts.part import Part, Pocket, Profile
from mechwright.errors import DesignError, GeometryError
from mechwright.geometry import Loop, Outline, circle


def bar(length=60.0, width=14.0, angle=0.0, holes=(), thickness=6.0):
    corners = [(0, 0), (length, 0), (length, width), (0, width)]
    inner = tuple(Loop((circle(at, radius, clockwise=True),)) for *at, radius in holes)
    return Part("bar", Outline(Loop.polygon(corners), inner).moved(0, 0, angle), thickness, "steel")


def lines(part):
    (mark,) = [detail for detail in part.details if isinstance(detail, Engraving)]
    return shapely.multilinestrings([shapely.LineString(stroke) for stroke in mark.strokes]), mark


@settings(deadline=None, max_examples=40)
@given(
    length=st.floats(40, 120),
    width=st.floats(10, 60),
    angle=st.floats(-3, 3),
    x=st.floats(0.2, 0.8),
    radius=st.floats(1, 4),
    text=st.text("AMWZ0189-/", min_size=1, max_size=6).filter(lambda t: t.strip()),
    width_of_edge=st.sampled_from([0.0, 0.5]),
)
def test_a_mark_keeps_clear_of_edges_chamfers_and_holes(length, width, angle, x, radius, text, width_of_edge):
    part = bar(length, width, angle, [(x * length, width / 2, radius)])
    if width_of_edge:
        part = deburred(part, width_of_edge)
    height = 4.0
    try:
        marked(part, text)
    except GeometryError as error:
        said = re.search(r"letters of ([\d.]+) mm find one$", str(error))
        if not said:
            with pytest.raises(GeometryError, match="shorten it: not even letters of"):
                marked(part, text)
            return
        height = float(said[1])  # the advice is taken
    found, mark = lines(marked(part, text, height))
    top = part.outline.polygon(CHORD)
    for edge in part.details:
        assert isinstance(edge, Chamfer)
        top = shapely.difference(top, band_of(edge, 0.0, CHORD))
    assert shapely.contains(top, found)
    assert shapely.distance(found, shapely.boundary(top)) >= mark.width / 2 + MARGIN - 3 * CHORD


def test_the_freest_place_is_taken_level_if_it_can_be():
    found, _ = lines(marked(bar(100, 40, 0, [(20, 20, 15)]), "AB"))
    x, y = shapely.get_coordinates(shapely.centroid(shapely.envelope(found)))[0]
    assert x > 60
    assert y == pytest.approx(20, abs=4)
    flat, _ = lines(marked(bar(80, 8), "LONG TEXT", 3.0))
    assert np.ptp(shapely.get_coordinates(flat)[:, 1]) == pytest.approx(3.0)


@pytest.mark.parametrize("angle", [0.5, 1.2, -0.9, 1.5707963])
def test_along_a_bar_that_stands_askew(angle):
    found, _ = lines(marked(bar(80, 8, angle), "LONG TEXT", 3.0))
    corners = shapely.get_coordinates(shapely.minimum_rotated_rectangle(found))
    sides = sorted(np.hypot(*np.diff(corners, axis=0)[:2].T))
    assert sides[0] == pytest.approx(3.0, abs=0.01)
    ends = found.geoms[0].coords
    assert len(ends) >= 2


def test_threads_recesses_and_other_marks_are_kept_clear_of():
    part = threaded(bar(40, 16, 0, [(8, 8, 3)]), "bore-1", "M6")
    found, mark = lines(marked(part, "ABC"))
    clear = shapely.distance(found, shapely.Point(8, 8)) - 3.0
    assert clear >= mark.width / 2 + MARGIN - 3 * CHORD
    outer = part.outline.outer
    recess = Pocket("recess", Loop.polygon([(1, 1), (39, 1), (39, 15), (1, 15)]), (), 0, 1)
    full = Part(
        "bar", Outline(outer), 6.0, "steel", machined=(recess, Profile("outside", outer, "outside", 0, 6))
    )
    with pytest.raises(GeometryError, match=r"no free place on part bar for the mark 'ABC'.*shorten it"):
        marked(full, "ABC")


@pytest.mark.parametrize("text", ["_", ".", "-", "I"])
def test_letters_that_do_not_fill_their_height_stay_on_the_plate(text):
    part = bar(20, 10)
    found, _ = lines(marked(part, text))
    assert shapely.contains(part.outline.polygon(), found)


def test_marks_that_cannot_be():
    with pytest.raises(DesignError, match="no letter 'Ä' to engrave"):
        marked(bar(), "Ä")
    with pytest.raises(GeometryError, match="nothing to engrave"):
        marked(bar(), "  ")
    with pytest.raises(GeometryError, match=r"0\.5 mm deep goes through part bar, 0\.5 mm thick"):
        marked(bar(thickness=0.5), "A", depth=0.5)
