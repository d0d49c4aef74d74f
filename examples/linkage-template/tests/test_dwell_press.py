from typing import ClassVar

import numpy as np
import pytest
from hypothesis import strategies as st
from mechwright_dwell_press.family import DwellPress, DwellPresses, DwellPressParams

from mechwright import DesignError
from mechwright.testing import FamilyContract


class TestDwellPresses(FamilyContract):
    family = DwellPresses
    examples = ({}, {"swing_from": 20, "swing_to": 150})
    refused: ClassVar = (
        ({"dwell_press": {"crank": 400.0}}, "dwell_press"),
        ({"pin_diameter": 60.0}, "dwell_press"),
        ({"jansen": {"m": 12.0}}, "jansen"),
        ({"linkage": "jansen"}, "linkage"),
    )
    derivatives = (("s_guide", "v_guide"), ("v_guide", "a_guide"), ("theta_rod", "omega_rod"))
    input_rate = "omega_in"
    variations: ClassVar = {
        "pairs": [[["coupler", "ground"]]],
        "loads": [[{"link": "ram", "force_y": -200}]],
        "springs": [[{"link": "ram", "point": "D", "on": "ground", "on_point": "A0", "rate": 0.5}]],
        "output": ["rocker"],
    }
    max_examples = 5
    max_frames = 5

    def strategy(self):
        """Random presses near the default."""
        return st.fixed_dictionaries(
            {"dwell_press": st.fixed_dictionaries({"crank": st.floats(20, 40), "rod": st.floats(60, 140)})},
            optional={"pin_diameter": st.floats(3, 10), "frame": st.sampled_from(["auto", "one", "two"])},
        )


def test_the_ram_dwells():
    motion = DwellPresses().solve(DwellPressParams(), 721)
    way = motion.channels["s_guide"].values
    turn = np.append(way[:-1], way)
    dwell = min(np.ptp(turn[first : first + 141]) for first in range(720))
    assert np.ptp(way) == pytest.approx(50, abs=0.1)
    assert dwell < 0.001 * np.ptp(way)


def test_the_rod_keeps_its_length():
    motion = DwellPresses().solve(DwellPressParams(), 91)
    x, y = motion.channels["xC"].values, motion.channels["yC"].values
    np.testing.assert_allclose(np.hypot(x - 66, y - motion.channels["s_guide"].values), 90, rtol=1e-12)


def test_new_begins_with_the_press_and_with_nothing_else():
    assert DwellPresses().draft("", "") == DwellPressParams()
    assert DwellPresses().draft("dwell-press", "").entry == DwellPress()
    with pytest.raises(DesignError, match="jansen"):
        DwellPresses().draft("jansen", "")
    with pytest.raises(DesignError, match="reads no drawings"):
        DwellPresses().draft("points.csv", "point,x,y,links")
