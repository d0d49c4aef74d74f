"""Designs that are one: what the kit of families finds of mirror images, cognates and near-identical ones."""

import math

import numpy as np
import pytest

from mechwright import Candidate, Scalar
from mechwright.plugins.host import host
from mechwright.testing.likeness import repeated
from mechwright_four_bar.kinematics.cognates import cognates
from mechwright_four_bar.kinematics.dimensions import FourBar

LINKS = {"crank": 40.0, "coupler": 120.0, "follower": 80.0, "ground": 100.0}
POINT = {"coupler_point_x": 60.0, "coupler_point_y": 35.0}


def told(family, *tables):
    made = host().family(family)
    found = [Candidate(made.Params.model_validate(dict(table)), Scalar(0.0, "mm")) for table in tables]
    return repeated(made, found)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({}, "are one"),
        ({"branch": "crossed", "coupler_point_y": -35.0, "ground_angle": 40.0, "direction": "cw"}, "are one"),
        ({"crank": 40.4, "coupler_point_x": 59.8, "pivot_x": 500.0}, "are one"),
        ({"branch": "crossed"}, ""),
        ({"coupler_point_y": 37.0}, ""),
        ({"follower": 82.0}, ""),
    ],
)
def test_mirrors_and_near_ones_are_one_and_others_are_not(change, said):
    both = LINKS | POINT
    found = told("four-bar", both, both | change)
    assert said in found[0] if said else found == []


def test_cognates_are_one():
    phi = np.linspace(0, 1, 5)
    tables = []
    for one in cognates(FourBar(*LINKS.values(), branch=1), 0j, complex(*POINT.values()), phi):
        if one.bar.kind.full_turn:
            names = zip(
                LINKS, (one.bar.crank, one.bar.coupler, one.bar.follower, one.bar.ground), strict=True
            )
            tables.append(
                dict(names)
                | {
                    "ground_angle": math.degrees(one.bar.ground_angle),
                    "branch": "open" if one.bar.branch > 0 else "crossed",
                    "pivot_x": one.pivot.real,
                    "pivot_y": one.pivot.imag,
                    "coupler_point_x": one.point.real,
                    "coupler_point_y": one.point.imag,
                }
            )
    assert len(tables) == 2, "of the three a crank-rocker has one that its crank turns as well"
    assert told("four-bar", *tables) == ["designs 1 and 2 are cognates of each other"]


def test_pairs_of_gears_are_compared_by_what_their_motion_tells():
    one = {"eccentricity": 0.3}
    assert told("elliptic-gears", one, one) != []
    assert told("elliptic-gears", one, {"eccentricity": 0.35}) == []
