"""Fillets between floor and walls of a recess: sections and volume against closed forms."""

import math
from dataclasses import replace

import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright.contracts.moments import volume
from mechwright.contracts.part import Feature, Part, Pocket, Profile
from mechwright.contracts.sections import sections, walls
from mechwright.errors import GeometryError
from mechwright.geometry import Loop, Outline, circle

PLATE = Loop.polygon([(-30, -20), (30, -20), (30, 20), (-30, 20)])


def plate(*features: Feature) -> Part:
    return Part(
        "plate",
        Outline(PLATE),
        10,
        "steel",
        machined=(*features, Profile("outside", PLATE, "outside", 0, 10)),
    )


def quarter(radius: float) -> float:
    """Area between a quarter of a circle and its two tangents."""
    return (1 - math.pi / 4) * radius**2


def centroid(radius: float) -> float:
    """Distance of that area's centroid from each tangent."""
    return radius * (10 - 3 * math.pi) / (3 * (4 - math.pi))


@settings(max_examples=8)
@given(radius=st.floats(0.2, 4), around=st.floats(5, 15))
def test_volume_of_the_fillet_in_a_round_recess(radius: float, around: float) -> None:
    # Pappus: the fillet's area goes round with its centroid.
    flat = Pocket("p", Loop((circle((0, 0), around),)), (), 0, 5)
    rounded = Pocket("p", flat.boundary, (), 0, 5, radius)
    more = volume(plate(rounded)) - volume(plate(flat))
    assert more == pytest.approx(quarter(radius) * math.tau * (around - centroid(radius)), rel=1e-4)


def test_volume_of_a_round_bottomed_groove_across_the_plate() -> None:
    groove = Pocket("g", Loop.polygon([(-40, -3), (40, -3), (40, 3), (-40, 3)]), (), 0, 5, 3.0)
    taken = 60 * (2 * 6 + math.pi / 2 * 9)
    assert volume(plate()) - volume(plate(groove)) == pytest.approx(taken, rel=1e-5)


def test_a_fillet_is_only_where_a_wall_stands() -> None:
    corner = Pocket("p", Loop.polygon([(0, 0), (30, 0), (30, 20), (0, 20)]), (), 0, 4, 1.0)
    assert walls(plate(corner), corner).length == pytest.approx(50, abs=0.01)
    more = volume(plate(corner)) - (60 * 40 * 10 - 30 * 20 * 4)
    # The two fillets share a corner: less than two straight ones.
    assert more == pytest.approx(quarter(1) * 50, rel=0.02)
    assert more < quarter(1) * 50


def test_sections_grow_towards_the_floor_and_end_there() -> None:
    pocket = Pocket("p", Loop((circle((0, 0), 10),)), (), 0, 5, 2.0)
    layers = sections(plate(pocket))
    areas = [layer.shape.area for layer in layers]
    assert areas == sorted(areas)
    assert len(layers) == 10
    foot = layers[-2]
    assert foot.bottom == 5
    assert foot.shape.area == pytest.approx(2400 - math.pi * 64, rel=1e-4)
    assert len(sections(plate(pocket), steps=0)) == 2
    assert len(sections(plate(replace(pocket, floor_radius=0.5)))) == 10
    assert len(sections(plate(replace(pocket, floor_radius=0.0)))) == 2


def test_a_bore_through_the_floor_takes_the_fillet_with_it() -> None:
    pocket = Pocket("p", Loop.polygon([(-10, -10), (10, -10), (10, 10), (-10, 10)]), (), 0, 4, 2.0)
    slot = Pocket("q", Loop.polygon([(-4, 6), (4, 6), (4, 10), (-4, 10)]), (), 0, 6)
    foot = next(layer for layer in sections(plate(pocket, slot)) if layer.bottom == 4)
    assert not foot.shape.buffer(-1e-6).intersects(shapely.box(-4, 6, 4, 10))


@pytest.mark.parametrize("radius", [-0.1, 5.1])
def test_a_radius_that_is_none_is_refused(radius: float) -> None:
    with pytest.raises(GeometryError, match=r"pocket p: the floor_radius is .* not 0 to its depth of 5 mm"):
        Pocket("p", PLATE, (), 0, 5, radius)


def test_inset_is_a_quarter_of_a_circle() -> None:
    pocket = Pocket("p", PLATE, (), 0, 5, 3.0)
    assert pocket.inset(0) == 3
    assert pocket.inset(3 * (1 - math.cos(math.pi / 4))) == pytest.approx(3 * (1 - math.sin(math.pi / 4)))
    assert pocket.inset(3) == pocket.inset(4) == 0
