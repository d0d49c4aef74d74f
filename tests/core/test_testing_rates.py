"""The kit's comparison of rates with difference quotients, where laws meet."""

from dataclasses import replace

import numpy as np
import pytest

from mechwright.contracts.motion import Motion
from mechwright.mechanics.laws import LAWS
from mechwright.testing.rates import assert_rates, between
from mechwright_cam_follower.family import CamFollower

PAIRS = (("lift", "velocity"), ("velocity", "acceleration"))
SMOOTH = {"4-5-6-7"}
SAMPLES = 2881


def cam(law: str, turning: str = "ccw") -> tuple[Motion, tuple[float, ...]]:
    family = CamFollower()
    params = family.Params(laws=[law], turning=turning)
    return family.solve(params, SAMPLES), tuple(family.breaks(params))


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("turning", ["ccw", "cw"])
def test_a_right_cam_passes_between_its_breaks_and_only_there(law: str, turning: str) -> None:
    motion, breaks = cam(law, turning)
    assert_rates(motion, PAIRS, "omega1", breaks)
    if law not in SMOOTH:
        with pytest.raises(AssertionError, match="the difference quotient says"):
            assert_rates(motion, PAIRS, "omega1", ())


@pytest.mark.parametrize("at", [100, 1400, 2700])
def test_a_wrong_rate_fails_in_every_piece(at: int) -> None:
    motion, breaks = cam("modified-sine")
    wrong = motion.channels["velocity"].values.copy()
    wrong[at] += 1e-3 * np.abs(wrong).max()
    channels = {**motion.channels, "velocity": replace(motion.channels["velocity"], values=wrong)}
    with pytest.raises(AssertionError, match=r"channel (velocity|acceleration) from sample"):
        assert_rates(replace(motion, channels=channels), PAIRS, "omega1", breaks)


def test_breaks_cannot_hide_a_motion() -> None:
    time = np.linspace(0.0, 1.0, 101)
    with pytest.raises(AssertionError, match="20 of them leave less than half"):
        between(time, [0.05 * k + 0.001 for k in range(20)])
    for outside in (-0.1, 1.1):
        with pytest.raises(AssertionError, match="is not in the motion, which is 0 to 1"):
            between(time, [outside])
    assert between(-time, [-0.5]) == [slice(0, 50), slice(51, 101)]
    assert between(time, [0.0, 0.255, 1.0]) == [slice(1, 26), slice(26, 100)]
