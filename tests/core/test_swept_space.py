"""The space that plates take in motion, beside closed forms of a bar that stands, rocks, turns or is carried."""

import math
from dataclasses import replace

import numpy as np
import pytest
import shapely

from mechwright.contracts.motion import Channel, Motion, Poses
from mechwright.contracts.part import Instance, Part
from mechwright.errors import DesignError
from mechwright.geometry import Loop, Outline, circle
from mechwright.machine.frame.sweep import LOOKS, space_of

LONG, WIDE = 50.0, 4.0
TIME = np.linspace(0.0, 1.0, LOOKS)
TURN = math.tau * TIME
BAR = Outline(Loop.polygon([(0, -WIDE / 2), (LONG, -WIDE / 2), (LONG, WIDE / 2), (0, WIDE / 2)]))
FAR = math.hypot(LONG, WIDE / 2)
CHORDS = 1e-3
"""What chords may leave out, as a share of an area."""


def swept(poses, outline=BAR):
    part = Part("bar", outline, 5.0, "steel", (Instance("body", 2.0),))
    (piece,) = space_of([part], Motion("time", {"time": Channel(TIME, "s")}, {"body": poses})).pieces
    return piece


def about(angles):
    """Poses of a body that turns about (7, -3) at height 10."""
    return Poses.planar(7.0, -3.0, angles, 10.0)


def bar_at(angle):
    return shapely.affinity.translate(
        shapely.affinity.rotate(shapely.box(0, -WIDE / 2, LONG, WIDE / 2), angle, (0, 0)), 7.0, -3.0
    )


def test_a_body_that_stands_takes_itself_at_its_height():
    piece = swept(about(np.full(LOOKS, math.radians(30))))
    assert (piece.body, piece.part, piece.low, piece.high) == ("body", "bar", 12.0, 17.0)
    assert piece.region.symmetric_difference(bar_at(30)).area < 1e-9
    assert shapely.get_num_coordinates(piece.region) == 5


@pytest.mark.parametrize(("low", "high"), [(-20, 20), (60, 140), (-120, 30), (10, 11)])
def test_a_body_that_rocks_takes_a_sector_and_two_flanks(low, high):
    # There and back, fast in the middle and slow at the ends.
    region = swept(about(np.radians(low + (high - low) * (1 - np.cos(TURN)) / 2))).region
    corner = math.atan2(WIDE / 2, LONG)
    area = FAR**2 * (math.radians(high - low) + 2 * corner) / 2 + LONG * WIDE / 2
    assert area * (1 - CHORDS) < region.area < area
    assert all(bar_at(angle).difference(region).area < 1e-9 for angle in (low, high))
    # Looks where there is nothing new to see cost as much as others.
    assert shapely.get_num_coordinates(region) < 12 + 6 * (high - low) / 3


@pytest.mark.parametrize("angles", [TURN, -3 * TURN, np.radians(172 * np.cos(TURN))])
def test_a_body_that_turns_fully_or_nearly_takes_a_disc(angles):
    region = swept(about(angles)).region
    assert region.area == pytest.approx(math.pi * FAR**2, rel=CHORDS)
    assert region.centroid.coords[0] == pytest.approx((7.0, -3.0))


def test_a_body_that_is_carried_is_looked_at_all_along_its_way():
    disc = Outline(Loop((circle((0, 0), 6.0),)))
    poses = Poses.planar(30 * np.cos(TURN), 30 * np.sin(TURN), np.zeros(LOOKS))
    region = swept(poses, disc).region
    area = math.pi * (36**2 - 24**2)
    assert area * (1 - 4 * CHORDS) < region.area < area
    assert len(region.interiors) == 1


def test_a_body_that_tilts_has_no_region():
    poses = about(TURN)
    tilted = poses.rotation @ np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
    with pytest.raises(DesignError, match="tilts"):
        swept(replace(poses, rotation=tilted))
