"""Nests: parts in one row, the next part beside each, and what turns with a part, in closed form."""

import math
from types import SimpleNamespace

import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from mechwright.contracts.part import Bore, Instance, Part, Profile
from mechwright.geometry import Loop, Outline, packing
from mechwright_cam.operations import channel
from mechwright_cam.planning import nesting
from mechwright_cam.shop.settings import CamSettings
from mechwright_plane.nest import moved_feature


@pytest.mark.parametrize("count", [2, 3, 5])
@pytest.mark.parametrize(
    ("width", "height", "turn"), [(60.0, 40.0, False), (60.0, 40.0, True), (10.0, 60.0, False)]
)
def test_alike_parts_lie_in_one_row_where_the_machine_has_room_for_no_other(count, width, height, turn):
    """8 mm apart, with 8 mm beside them: in a row either way."""
    wide, high = width + 8.0, height + 8.0
    for room in ((count * wide, high), (wide, count * high)):
        found = packing.open_layout([(width, height)] * count, 8.0, turn, room)
        assert (found.width + 8.0, found.height + 8.0) == pytest.approx(room, abs=1e-6)


@pytest.mark.parametrize("gap", [0.5, 1.0, 3.0])
@pytest.mark.parametrize("count", [2, 4, 9])
def test_the_channel_around_a_part_ends_before_the_next_one(gap, count):
    """Squares in rows and columns: the next one is beside, not across a corner."""
    outline = Outline(Loop.polygon([(0, 0), (20, 0), (20, 20), (0, 20)]))
    copies = tuple(Instance(f"b{i}") for i in range(count))
    square = Part("square", outline, 3.0, "aluminium", copies)
    nest = nesting.nest_of("nest", [square], CamSettings(), gap)
    shapes = [one.outline.polygon() for one in nest.placed]
    of = SimpleNamespace(part=nest, target=shapely.union_all(shapes))
    for shape in shapes:
        assert channel._neighbour(of, shape) == pytest.approx(gap, abs=1e-6)
        turned = shapely.Polygon(shapely.get_coordinates(shape)[::-1])
        assert channel._neighbour(of, turned) == pytest.approx(gap, abs=1e-6)
    alone = SimpleNamespace(part=nest.placed[0].part, target=shapes[0])
    assert channel._neighbour(alone, shapes[0]) == math.inf


@given(st.floats(-3.2, 3.2), *[st.floats(-50.0, 50.0)] * 4)
def test_middles_and_sites_are_turned_as_outlines_are(angle, x, y, px, py):
    """As numbers of the complex plane: a turn is a product, a shift a sum."""
    there = (complex(px, py)) * complex(math.cos(angle), math.sin(angle)) + complex(x, y)
    hole = moved_feature(Bore("bore", (px, py), 8.0, 0.0, 3.0), x, y, angle)
    square = Loop.polygon([(px, py), (px + 9.0, py), (px + 9.0, py + 9.0), (px, py + 9.0)])
    rim = moved_feature(Profile("rim", square, "outside", 0.0, 3.0, (((px, py), 4.0),)), x, y, angle)
    for found in (hole.centre, rim.tab_sites[0][0], rim.loop.flatten()[0]):
        assert complex(*found) == pytest.approx(there, abs=1e-6)
