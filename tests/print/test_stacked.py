"""Meshes of stacked layers: their volume is that of the layers, whatever is cut into a plate."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from printed_meshes import is_closed, section

from mechwright.contracts.part import Bore, Part, Pocket, Profile
from mechwright.contracts.sections import sections
from mechwright.errors import GeometryError
from mechwright.geometry import Loop, Outline, circle
from mechwright_print.meshes.printed_mesh import PrintedMesh, volume
from mechwright_print.meshes.stacked import CHORD, stacked

THICK = 8.0
FIRST = 0.3


def plate(through: float, blind: float, depth: float, below: float, floor: float) -> Part:
    """A plate of 70 x 40 x 8 with a bore, a blind bore over it, a pocket, and a blind bore from the underside."""
    rim = Loop.polygon([(0, 0), (70, 0), (70, 40), (0, 40)])
    bore = Bore("bore", (15.0, 20.0), through, 0.0, THICK)
    features = (
        bore,
        Bore("counterbore", (15.0, 20.0), blind, 0.0, depth),
        Pocket(
            "pocket",
            Loop.polygon([(30, 5), (50, 5), (50, 35), (30, 35)]),
            (),
            0.0,
            depth,
            min(floor, depth / 2),
        ),
        Bore("below", (60.0, 20.0), 6.0, THICK - below, below),
        Profile("outside", rim, "outside", 0.0, THICK),
    )
    inner = Loop((circle(bore.centre, through / 2, clockwise=True),))
    return Part("plate", Outline(rim, (inner,)), THICK, "pom", machined=features)


PLATES = st.builds(
    plate,
    st.floats(3, 9),
    st.floats(10, 18),
    st.floats(0.4, 6.5),
    st.floats(0.4, 6.5),
    st.sampled_from([0.0, 1.0]),
)


def of(part: Part, foot: float = 0.0, *, on_top: bool = False) -> PrintedMesh:
    return PrintedMesh(stacked(part, foot, FIRST, on_top=on_top), np.eye(3), np.ones(3), foot, 0.0)


@settings(max_examples=12, deadline=None)
@given(PLATES)
def test_the_volume_is_that_of_the_layers(part):
    mesh = of(part)
    layers = sections(part, CHORD)
    assert is_closed(mesh)
    assert volume(mesh.mesh) == pytest.approx(
        math.fsum(one.shape.area * (one.bottom - one.top) for one in layers), rel=1e-6
    )
    low, high = mesh.mesh.points[:, 2].min(), mesh.mesh.points[:, 2].max()
    assert (low, high) == (0.0, THICK)


@settings(max_examples=8, deadline=None)
@given(PLATES, st.floats(0.05, 0.4), st.booleans())
def test_the_first_layer_alone_stands_back(part, foot, on_top):
    plain, stepped = of(part), of(part, foot, on_top=on_top)
    assert is_closed(stepped)
    bed, above = (THICK - FIRST / 2, THICK - 1.5 * FIRST) if on_top else (FIRST / 2, 1.5 * FIRST)
    narrow = shapely.buffer(section(plain, bed), -foot, join_style="mitre", mitre_limit=100)
    assert shapely.symmetric_difference(section(stepped, bed), narrow).area < 1e-4
    assert section(stepped, above).area == pytest.approx(section(plain, above).area, rel=1e-6)


def test_a_first_layer_of_which_nothing_is_left_is_refused():
    rim = Loop.polygon([(0, 0), (30, 0), (30, 0.5), (0, 0.5)])
    part = Part("strip", Outline(rim), 2.0, "pom", machined=(Profile("outside", rim, "outside", 0.0, 2.0),))
    with pytest.raises(GeometryError, match=r"part strip: nothing is left .* set deviation.foot = 0"):
        stacked(part, 0.3, FIRST, on_top=False)
