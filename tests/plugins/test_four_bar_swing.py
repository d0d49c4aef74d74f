"""Crank-rockers of a given swing and time ratio, against closed forms, known linkages and their own motion."""

import math
from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError

from mechwright import Synthesis
from mechwright_four_bar.family import FourBars
from mechwright_four_bar.kinematics.dimensions import FourBar, Kind
from mechwright_four_bar.kinematics.reach import bar_of
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.requirements import SwingRequirement
from mechwright_four_bar.synthesis.swing import smallest, widest


def asked(**table: Any) -> Synthesis[FourBarParams]:
    return FourBars().synthesise("swing", SwingRequirement(**table), lambda part, text: None)


def known(rng: np.random.Generator) -> FourBar:
    """A crank-rocker with a swing and a transmission angle that can be asked for."""
    while True:
        bar = FourBar(*rng.uniform(20, 200, 4))
        if bar.kind is Kind.CRANK_ROCKER and math.degrees(bar.least_transmission_angle()) > 5:
            limits = bar.folding()
            if 2 < math.degrees(limits.swing) < 165 and limits.time_ratio < 4.5:
                return bar


@pytest.mark.parametrize("name", ["crank", "coupler", "follower", "ground"])
def test_no_known_linkage_is_better_or_smaller(name: str) -> None:
    """Asked for their own swing, time ratio, limits and one length, random crank-rockers are met or beaten."""
    rng = np.random.default_rng(["crank", "coupler", "follower", "ground"].index(name))
    for _ in range(12):
        bar = known(rng)
        limits, least = bar.folding(), bar.least_transmission_angle()
        wanted = SwingRequirement(
            swing=math.degrees(limits.swing),
            time_ratio=limits.time_ratio,
            **{name: getattr(bar, name)},
            shortest_link=min(bar.lengths) * 0.999,
            longest_link=bar.longest * 1.001,
            least_transmission_angle=max(1.0, math.degrees(least) * 0.999),
        )
        sides = [(widest(wanted, side), smallest(wanted, side, least * 0.9999)) for side in (1, -1)]
        assert max(one.least_angle[0] for one, _ in sides if one is not None) >= least * (1 - 1e-9)
        assert min(one.longest[0] for _, one in sides if one is not None) <= bar.longest * (1 + 1e-4)


def test_centric_linkages_are_those_of_the_closed_form() -> None:
    """K = 1: a = b sin(ψ/2), a² + f² = b² + c², and both extremes of the angle at B have cos μ = a f/(b c)."""
    result = asked(swing=70, follower=80, longest_link=200, least_transmission_angle=40, designs=3)
    assert len(result.candidates) == 2
    for one in result.candidates:
        a, c, b, f = bar_of(one.params).lengths
        assert a == pytest.approx(80 * math.sin(math.radians(35)))
        assert a * a + f * f == pytest.approx(b * b + c * c)
        assert math.cos(one.figures["least_transmission_angle"].value) == pytest.approx(a * f / (b * c))


@pytest.mark.parametrize(
    "table",
    [
        {"swing": 110, "follower": 40},
        {"swing": 60, "time_ratio": 1.25, "ground": 100},
        {"swing": 25, "time_ratio": 1.6, "quick": "cw", "crank": 15, "least_transmission_angle": 20},
        {"swing": 45, "time_ratio": 1.1, "coupler": 150, "middle_angle": -30},
    ],
)
def test_the_motion_has_what_was_asked_for(table: dict[str, Any]) -> None:
    result = asked(**table, designs=1)
    limit = table.get("least_transmission_angle", 30)
    (candidate,), (note,) = result.candidates, result.findings
    one = candidate.params
    branch = "crossed" if one.branch == "open" else "open"
    assert f'branch = "{branch}"' in note.message
    mirrored = one.model_copy(update={"ground_angle": note.value, "branch": branch})
    pivots = set()
    for params in (one, mirrored):
        motion = FourBars().solve(params, 7201)
        psi = np.unwrap(motion.channels["psi"].values)
        assert math.degrees(np.ptp(psi)) == pytest.approx(table["swing"], abs=1e-3)
        middle = math.degrees((psi.max() + psi.min()) / 2) - table.get("middle_angle", 90)
        assert abs(math.remainder(middle, 360)) < 1e-3
        assert motion.scalars["time_ratio"].value == pytest.approx(table.get("time_ratio", 1))
        assert motion.scalars["least_transmission_angle"].value >= math.radians(limit) * (1 - 1e-9)
        if "time_ratio" in table:
            rising = float(np.mean(np.diff(psi) > 0))
            assert (rising < 0.5) == (table.get("quick", "ccw") == "ccw")
            slow = max(rising, 1 - rising)
            assert slow / (1 - slow) == pytest.approx(table["time_ratio"], abs=0.01)
        side = math.sin(math.radians(params.ground_angle - table.get("middle_angle", 90)))
        pivots.add(side > 0)
    assert pivots == {True, False}  # the mirror images


def test_what_cannot_be_is_said_with_what_can() -> None:
    (fault,) = asked(swing=160).findings
    assert fault.code == "swing.transmission"
    assert fault.value == pytest.approx(10, abs=0.01)
    (fault,) = asked(swing=90, least_transmission_angle=43, longest_link=150).findings
    assert fault.code == "swing.links"
    assert fault.value is not None
    assert asked(swing=90, least_transmission_angle=math.floor(fault.value), longest_link=150).candidates
    (fault,) = asked(swing=90, longest_link=90).findings
    assert "there is no such four-bar" in fault.message


def test_one_length_is_given() -> None:
    assert SwingRequirement(ground=90).follower is None
    with pytest.raises(
        ValidationError, match="crank and ground: give one of crank, coupler, follower and gr"
    ):
        SwingRequirement(crank=20, ground=90)
    with pytest.raises(ValidationError, match="no length is given"):
        SwingRequirement(follower=None)


def test_designs_are_best_first_and_distinct() -> None:
    result = asked(swing=60, time_ratio=1.2, ground=100)
    angles = [one.figures["least_transmission_angle"].value for one in result.candidates]
    longest = [one.figures["longest_link"].value for one in result.candidates]
    assert angles[0] >= max(angles) - math.radians(3.001)
    shapes = {tuple(round(length) for length in bar_of(one.params).lengths) for one in result.candidates}
    assert len(result.candidates) == len(shapes) > 1
    assert all(isinstance(one.params, FourBarParams) for one in result.candidates)
    assert max(longest) <= 400
