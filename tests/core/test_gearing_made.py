"""Play of gears as made: closed form, polygons run against each other, and bisection with exact predicates."""

import json
import math
from collections import defaultdict
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import shapely

from mechwright.mechanics.gearing import mesh
from mechwright.mechanics.gearing.made import Contacts, error_of, signed_depth
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.gear import outline_of, pair_of, teeth_of

FACTS = json.loads((Path(__file__).parents[1] / "data" / "as-made.json").read_text())["facts"]
CASES = defaultdict(dict)
for fact in FACTS:
    if fact["name"].startswith("gear.") and "teeth" in fact["inputs"]:
        CASES[tuple(fact["inputs"].values())][fact["name"]] = fact["expected"], fact["tolerance"]


def design(e, teeth, semi_major, backlash):
    return EllipticGearParams(
        eccentricity=e, teeth=teeth, semi_major=semi_major, backlash=backlash, bore=10.0
    )


@pytest.mark.parametrize("inputs", CASES, ids=str)
def test_the_closed_form_gives_the_reference(inputs):
    e, teeth, a, backlash, left, centre = inputs
    params = design(e, teeth, a, backlash)
    contacts = Contacts.of(pair_of(params), teeth_of(params), 1801)
    play = contacts.gaps(2 * left).play((centre, 0.0))
    total = play[0] + play[1]
    found = {
        "gear.play_total_min": total.min(),
        "gear.play_total_max": total.max(),
        "gear.te_one_flank": error_of(play),
    }
    assert len(CASES) == 16
    for name, (expected, tolerance) in CASES[inputs].items():
        assert found[name] == pytest.approx(expected, abs=tolerance), name


def ring(params, left):
    """The outline with ``left`` mm on every wall, as corners."""
    grown = shapely.Polygon(outline_of(params).outer.flatten(1e-5)).buffer(left, join_style="mitre")
    return shapely.get_coordinates(shapely.orient_polygons(grown))[:-1]


@pytest.mark.parametrize(("e", "teeth", "left", "centre"), [(0.4, 25, 0.005, 0.0), (0.2, 20, -0.003, -0.02)])
def test_three_ways_agree_within_a_hundredth(e, teeth, left, centre):
    params = design(e, teeth, 50.0, 0.08)
    outline, pair = ring(params, left), replace(pair_of(params), distance=100.0 + centre)
    gaps = Contacts.of(pair_of(params), teeth_of(params)).between(outline, outline)
    closed = gaps.play((centre, 0.0))
    run = mesh(outline, outline, pair, teeth, allowance=0.05)
    for one, other in zip(closed, (run.ahead, run.behind), strict=True):
        assert one == pytest.approx(other, abs=0.01 * float(one.max()))
    theta2 = pair.angles(run.arc)[1]
    for k in (0, 17, 40, 63):
        for sign, play in ((1, closed[0]), (-1, closed[1])):
            exact = bisected(outline, pair, gaps.theta[k], theta2[k], sign)
            assert play[k] == pytest.approx(exact, abs=0.01 * float(play.max()))


def bisected(outline, pair, theta1, theta2, sign):
    """How far the driven gear turns until the two polygons intersect, by halving."""
    driver = shapely.affinity.rotate(shapely.Polygon(outline), theta1, origin=(0, 0), use_radians=True)
    shapely.prepare(driver)

    def meets(turn):
        other = shapely.affinity.rotate(
            shapely.Polygon(outline), theta2 + turn, origin=(0, 0), use_radians=True
        )
        return driver.intersects(shapely.affinity.translate(other, pair.distance))

    low, high = 0.0, 0.01
    assert not meets(0.0)
    assert meets(sign * high)
    for _ in range(20):
        middle = (low + high) / 2
        low, high = (low, middle) if meets(sign * middle) else (middle, high)
    return (low + high) / 2


def test_a_runout_moves_the_play_as_its_normal_says():
    params = design(0.4, 25, 50.0, 0.08)
    contacts = Contacts.of(pair_of(params), teeth_of(params))
    still, moved = contacts.gaps(0.0).play(), contacts.gaps(0.0).play((0.0, 0.01))
    # Along the pitch tangent an axis takes from one flank what it gives to the other, cos δ apart.
    total = moved[0] + moved[1] - still[0] - still[1]
    assert np.abs(total).max() < 1e-12
    assert np.abs(moved[0] - still[0]).min() > 5e-5


def test_depth_is_signed_and_measured_from_the_nearest_edge():
    square = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]])
    points = np.array([[1.0, 0.25], [3.0, 3.0], [1.0, -0.5]])
    assert signed_depth(square, points) == pytest.approx([0.25, -math.sqrt(2), -0.5])
