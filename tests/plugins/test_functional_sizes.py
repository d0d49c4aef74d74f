"""Sizes by which wheels and cams are measured, against their outlines and solids of the same design."""

import math
from pathlib import Path

import numpy as np
import pytest
import shapely

from mechwright import host
from mechwright.designs.design import load
from mechwright.geometry import Loop, circle
from mechwright_cam_follower.parts.gauging import edge_measures

EXAMPLES = Path(__file__).parents[2] / "examples"


def part(example, name):
    (found,) = [one for one in load(EXAMPLES / f"{example}.toml", host()).parts() if one.name == name]
    return found, {one.what: one for one in found.measures}


@pytest.mark.parametrize("example", ["geneva-straight", "geneva-cycloidal", "geneva-machine"])
def test_slot_and_locking_arcs_of_a_wheel_are_as_wide_as_it_is_cut(example):
    wheel, sizes = part(example, "wheel")
    gaps = shapely.Polygon(wheel.outline.outer.flatten(1e-5))
    pockets = [one for one in wheel.features if one.name.startswith("groove")]
    if pockets:
        walls = shapely.LinearRing(pockets[0].boundary.flatten(1e-5))
        lines = shapely.Polygon(walls)
        width = 2 * shapely.maximum_inscribed_circle(lines, tolerance=1e-5).length
        assert sizes["width of a slot"].nominal == pytest.approx(width, abs=1e-3)
    arcs = [one for one in wheel.outline.outer.segments if getattr(one, "tag", "") == "lock"]
    bottom = min(math.hypot(*one.centre) - one.radius for one in arcs)
    assert sizes["axis to the bottom of a locking arc"].nominal == pytest.approx(bottom, abs=1e-4)
    assert gaps.exterior.distance(shapely.Point(0, 0)) <= bottom + 1e-4


@pytest.mark.parametrize("example", ["geneva-straight", "geneva-machine"])
def test_the_locking_disc_is_as_large_as_its_edge(example):
    disc, sizes = part(example, "locking-disc")
    far = np.hypot(*disc.outline.outer.flatten(1e-5).T).max()
    assert sizes["axis to the locking edge"].nominal == pytest.approx(far, abs=1e-4)


@pytest.mark.parametrize("example", ["cam-lever", "cam-flat", "cam-conjugate"])
def test_a_cam_is_measured_where_its_edge_is(example):
    cam, sizes = part(example, "cam")
    edge = shapely.LinearRing(cam.outline.outer.flatten(1e-6))
    for angle in range(0, 360, 30):
        found = sizes[f"axis to the edge at {angle}°"]
        for size in (found.nominal, found.least, found.greatest):
            place = shapely.Point(size * math.cos(math.radians(angle)), size * math.sin(math.radians(angle)))
            off = edge.distance(place)
            if size == found.nominal:
                assert off < 2e-4
        assert edge.distance(place) == pytest.approx(0.010, abs=4e-4), "leftover across the wall"


def test_a_disc_has_its_radius_everywhere_and_an_offset_circle_leans():
    for one in edge_measures(Loop((circle((0, 0), 20.0),))):
        assert one.nominal == pytest.approx(20.0, abs=1e-4)
        assert one.greatest - one.nominal == pytest.approx(0.01, abs=1e-4)
    rows = {one.what: one for one in edge_measures(Loop((circle((5, 0), 20.0),)))}
    assert rows["axis to the edge at 0°"].nominal == pytest.approx(25.0, abs=1e-4)
    assert rows["axis to the edge at 180°"].nominal == pytest.approx(15.0, abs=1e-4)
    assert rows["axis to the edge at 90°"].nominal == pytest.approx(math.sqrt(400 - 25), abs=1e-4)
