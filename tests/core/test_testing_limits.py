"""The test kit tells which limits of a requirement a design of its synthesis breaks."""

import math

from mechwright.contracts.motion import Scalar
from mechwright.contracts.parameters import Parameters
from mechwright.contracts.synthesis import Candidate
from mechwright.testing.limits import limits_broken
from mechwright.units import Degrees, Millimetres


class Asked(Parameters):
    """A requirement with limits."""

    least_angle: Degrees = 30.0
    longest_link: Millimetres = 200.0
    longest_arm: Millimetres | None = None


def told(**figures):
    return limits_broken(Asked(), Candidate(Asked(), Scalar(0.0, "mm"), figures))


def test_a_broken_limit_of_a_synthesis_is_told():
    broken = told(
        least_angle=Scalar(math.radians(29.16), "rad"),
        longest_link=Scalar(200.1, "mm"),
        longest_arm=Scalar(5.0, "mm"),
        swing=Scalar(1.0, "rad"),
    )
    assert [one.partition(",")[0] for one in broken] == ["least_angle: 30 asked", "longest_link: 200 asked"]
    assert "29.16" in broken[0]


def test_limits_that_are_reached_are_kept():
    assert told(least_angle=Scalar(math.radians(30), "rad"), longest_link=Scalar(200.0, "mm")) == []
