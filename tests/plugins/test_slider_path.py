"""Paths of a point of a slider-crank's rod: found within their limits, counted, and said where there is none."""

import math

import numpy as np
import pytest
from by_night import by_night
from pydantic import ValidationError

from mechwright.contracts.finding import errors
from mechwright.mechanics.tracing.descent import squares
from mechwright_slider_crank.family import SliderCrankFamily
from mechwright_slider_crank.kinematics.slider_crank import SliderCrank
from mechwright_slider_crank.requirements import PathRequirement
from mechwright_slider_crank.synthesis.paths.room import Limits, SliderRoom

FAMILY = SliderCrankFamily()
LINK = SliderCrank(40.0, 120.0, 15.0, 0.4, -1)
PIVOT, POINT = 12 - 7j, 70 + 35j


def path(phi, link=LINK, pivot=PIVOT, point=POINT):
    return pivot + link.bodies(np.atleast_1d(phi)).rod.point(point).position


def asked(points, **more):
    pairs = [(z.real, z.imag) for z in points]
    limits = {"longest_link": 125, "shortest_link": 38, "least_transmission_angle": 62} | more
    return FAMILY.synthesise("path", PathRequirement(points=pairs, **limits), lambda part, what: None)


def met(result, points):
    """Every candidate traces the points it claims to, as its own motion has it, and keeps the limits."""
    for one in result.candidates:
        assert errors(FAMILY.check(one.params)) == []
        figures = {name: figure.value for name, figure in one.figures.items()}
        pivot = complex(figures["pivot_x"], figures["pivot_y"])
        ends = figures["first_crank_angle"] + np.linspace(0, 1, 4001) * math.copysign(
            math.tau, figures["crank_turn"]
        )
        curve = path(ends, one.params.linkage, pivot, one.params.coupler_point)
        near = np.abs(curve[:, None] - points).min(axis=0)
        assert np.sqrt(np.mean(near**2)) <= one.residual.value + 0.05
        assert figures["longest_link"] <= 125
        assert one.params.crank >= 38
        assert math.degrees(figures["least_transmission_angle"]) >= 62 - 1e-9


@pytest.mark.parametrize("closed", [True, False])
def test_a_linkage_comes_back_from_its_path(closed):
    span = math.tau * 11 / 12 if closed else 3.5
    points = path(0.3 + np.linspace(0, span, 12))
    result = asked(points, closed=closed, designs=2)
    best = result.candidates[0]
    assert best.residual.value < 1e-9
    assert best.params.crank == pytest.approx(40, abs=1e-6)
    assert best.params.rod == pytest.approx(120, abs=1e-6)
    assert best.params.offset == pytest.approx(15, abs=1e-6)
    assert best.params.assembly == "behind"
    assert best.figures["pivot_x"].value == pytest.approx(12, abs=1e-6)
    met(result, points)
    assert result.findings[0].code == "path.found"


def test_timed_points_keep_their_crank_angles_and_dense_ones_are_all_met():
    turns = -np.linspace(0, 4.0, 200)
    points = path(1.0 + turns)
    result = asked(points, crank_turns=tuple(np.degrees(turns)), designs=1)
    best = result.candidates[0]
    assert best.residual.value < 1e-8
    assert best.params.clockwise
    assert best.figures["first_crank_angle"].value == pytest.approx(1.0, abs=1e-7)
    assert best.figures["crank_turn"].value == pytest.approx(-4.0)


def test_what_holds_no_linkage_is_said_with_the_pair_that_contradicts():
    points = path(np.linspace(0, 3, 8))
    (finding,) = asked(points, shortest_link=100, longest_link=110).findings
    assert finding.code == "path.contradiction"
    assert "shortest_link of 100 mm and longest_link of 110 mm contradict" in finding.message
    assert "least_transmission_angle of 62 degrees" in finding.message
    (finding,) = asked(np.full(5, 3 + 4j)).findings
    assert finding.message == "all 5 points are (3, 4): a path needs two places at least"
    (finding,) = asked(np.array([1j, 2j, 2j, 5])).findings
    assert finding.message.startswith("points 2 and 3 are both (0, 2)")
    with pytest.raises(ValidationError, match="shortest_link of 50 mm must be below longest_link of 40 mm"):
        asked(points, shortest_link=50, longest_link=40)
    with pytest.raises(ValidationError, match="finite"):
        asked(np.array([1j, math.nan, 2j, 5]))


def test_the_room_knows_the_linkage():
    """Unknowns of a known linkage draw its points; limits are passed by what they are passed by."""
    phi = np.linspace(0, 2, 7)
    points = path(phi + LINK.direction)
    limits = Limits(30.0, 100.0, math.radians(70), (0.0, 0.0, 50.0, 50.0))
    room = SliderRoom(points / 50, None, -1, 1, False, 0.0, 0j, 50.0, limits)
    low, high = math.atanh((15 - 40) / 120), math.atanh((15 + 40) / 120)
    s = 120 / 50 * np.exp(0.4j)
    q = s * POINT / 120
    x = np.array([[math.log(high - low), low, 12 / 50, -7 / 50, s.real, s.imag, q.real, q.imag]])
    assert squares(room, x, phi[None])[0] < 1e-28
    over = room.exceeded(room.made(x), phi[None])[0]
    cosine = math.cos(math.radians(70))
    wanted = [math.log(30 / 40), math.log(120 / 100), abs(POINT) / 100 - 1, abs(POINT - 120) / 100 - 1,
              55 / 120 - cosine, 25 / 120 - cosine, -12 / 50, 7 / 50, -38 / 50, -57 / 50]  # fmt: skip
    np.testing.assert_allclose(over, wanted, atol=2e-9)


def test_lengths_come_in_steps_and_the_rest_is_fitted_again():
    points = path(np.linspace(0.3, 4.2, 9))
    limits = {"longest_link": 200, "shortest_link": 25, "least_transmission_angle": 40}
    result = asked(points, length_step=2.5, starts=6000, designs=2, **limits)
    (note,) = result.findings
    assert note.code == "path.found"
    size = np.abs(points - points.mean()).max()
    for one in result.candidates:
        p = one.params
        for length in (p.crank, p.rod, p.offset, p.coupler_x, p.coupler_y):
            assert length % 2.5 == 0
        pivot = complex(one.figures["pivot_x"].value, one.figures["pivot_y"].value)
        curve = path(np.linspace(0, math.tau, 20001), p.linkage, pivot, p.coupler_point)
        near = np.abs(curve[:, None] - points).min(axis=0)
        assert np.sqrt(np.mean(near**2)) <= one.residual.value + 0.005
        assert p.crank >= 25
        assert one.figures["longest_link"].value <= 200
        assert one.figures["least_transmission_angle"].value >= math.radians(40)
    assert result.candidates[0].residual.value < 0.02 * size, "rounded alone it would miss by a millimetre"


@by_night
def test_steps_that_are_too_coarse_are_said():
    points = path(np.linspace(0.3, 4.2, 9))
    (fault,) = errors(asked(points, length_step=45, starts=300, designs=1).findings)
    assert (fault.code, fault.parameter) == ("path.length-step", "length_step")
