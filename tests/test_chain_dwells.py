"""Stages behind what dwells: a coupler that rests has no acceleration pole, and all else of it moves on."""

from pathlib import Path

import numpy as np
import pytest

from mechwright import host
from mechwright.designs.design import Design, design_of
from mechwright.mechanics.chain import Chain, ChainParams
from mechwright.mechanics.chain.checks import loaded, torques_of


def _behind_wheel(family: str, law: str) -> Design:
    stages = [
        {"family": "geneva", "parameters": {"slots": 4, "law": law}},
        {"family": family, "parameters": {}},
    ]
    return design_of({"name": "chain", "stage": stages}, Path("chain.toml"), "", host())


@pytest.mark.parametrize(
    ("family", "law"), [("slider-crank", "straight"), ("slider-crank", "cycloidal"), ("four-bar", "straight")]
)
def test_a_linkage_behind_a_wheel_that_rests_has_a_motion(family: str, law: str) -> None:
    """It was refused for a pole that is nowhere while all points rest."""
    design = _behind_wheel(family, law)
    motion = design.family.solve(design.params, 181)
    wheel, driven = motion["1.omega_w"], motion["2.omega_c"]
    rests = wheel == 0
    assert 0.2 < rests.mean() < 0.9
    assert np.abs(driven[rests]).max() == 0
    assert np.abs(driven[~rests]).max() > 0.1
    assert not [name for name in motion.channels if name.startswith(("2.xG", "2.yG"))]
    assert all(np.isfinite(motion[name]).all() for name in motion.channels)


def test_the_torque_of_what_stands_behind_a_wheel_is_laid_on_it() -> None:
    """As on gears: its strength is judged with it, where it was only told that it is not."""
    design = _behind_wheel("slider-crank", "straight")
    assert isinstance(design.family, Chain)
    assert isinstance(design.params, ChainParams)
    wheel, _ = loaded(design.params, design.family.families)
    _, behind = torques_of(design.params, design.family.families)
    assert getattr(wheel, "load_torque") == pytest.approx(np.abs(behind).max())  # noqa: B009 - any family's
    assert np.abs(behind).max() > 1e-3
    assert "chain.load" not in [one.code for one in design.family.judge(design.params)]
