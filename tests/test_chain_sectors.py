"""Sectors as stages of chains: by their own swing, and behind a lever, within their travel."""

import math
from typing import Any

import numpy as np
import pytest
from test_chain import CIRCLES, SWING, chain, linked

from mechwright import Turning
from mechwright.contracts.finding import errors
from mechwright.designs.design import Design
from mechwright.mechanics.chain.running import inputs_of
from mechwright_noncircular_gears.kinematics.law import law_of
from mechwright_noncircular_gears.sized import SizedParams

LEVER = ("cam-follower", {"follower": "oscillating", "laws": ["4-5-6-7"]})
"""It swings by 20 degrees."""

NARROW = {**SWING, "sector": 30, "teeth": 12, "module": 3}


def codes(design: Design) -> list[str]:
    """Of all errors."""
    return [one.code for one in errors(design.check())]


def test_sectors_begin_a_chain_by_their_own_swing() -> None:
    """There and back over the travel, and what they turn goes by their law."""
    design = chain(("noncircular-gears", {**SWING, "bore": 6}), ("slider-crank", {}, {"start": 40}))
    assert not [one for one in codes(design) if one.startswith("chain.")]
    motion = design.solve(721)
    phi, crank = motion["1.theta1"], motion["2.phi"]
    assert [phi[0], phi[360], phi[-1]] == pytest.approx([0.0, math.radians(120), 0.0], abs=1e-9)
    law = law_of(SizedParams.model_validate(SWING))
    assert crank == pytest.approx(math.radians(40) - law.angle(phi), abs=1e-9)
    time, slope = motion["time"], motion["2.omega_a"]
    assert np.gradient(crank, time, edge_order=2) == pytest.approx(slope, abs=2e-3 * np.abs(slope).max())


def test_sectors_behind_a_lever_start_where_their_travel_holds_its_swing() -> None:
    """The file leaves ``start`` out: the middle of the swing is that of the travel."""
    design = chain(LEVER, ("noncircular-gears", NARROW))
    assert set(design.chosen) == {"stage.2.start"}
    links = linked(design)
    first = Turning.of(np.linspace(0.0, math.tau, 721), 1.0)
    theta = np.degrees(list(inputs_of(links, first))[1].theta)
    assert [theta.min(), theta.max()] == pytest.approx([5.0, 25.0], abs=0.01)
    assert not [one for one in codes(design) if one.startswith("chain.")]


@pytest.mark.parametrize(
    ("stages", "parameter"),
    [
        ([("noncircular-gears", CIRCLES), ("noncircular-gears", NARROW)], "stage.2.family"),
        ([LEVER, ("noncircular-gears", {**NARROW, "sector": 15})], "stage.2.parameters.sector"),
        ([LEVER, ("noncircular-gears", NARROW, {"start": 90})], "stage.2.start"),
    ],
)
def test_sectors_that_are_driven_beyond_their_travel_are_refused_with_the_cure(
    stages: Any, parameter: str
) -> None:
    """Turned on, swung too far, or swung at the wrong place."""
    design = chain(*stages)
    (found,) = (one for one in design.check() if one.code == "chain.travel")
    assert found.parameter == parameter
    left = [codes(design.changed(change)) for change in found.proposed[-1:]]
    assert left
    assert "chain.travel" not in left[0]
