"""``--at``: the assembly at any angle of the input."""

import math
from pathlib import Path

import numpy as np
import pytest

from mechwright.contracts.motion import Channel, Motion
from mechwright.errors import DesignError
from mechwright.pipeline.pose import sample_at

EXAMPLE = Path(__file__).parents[1] / "examples" / "elliptic-pair.toml"


def turn(samples=3601):
    return Motion("theta", {"theta": Channel(np.linspace(0, math.tau, samples), "rad")})


@pytest.mark.parametrize(
    ("text", "degrees"),
    [("40", 40), ("40.04 deg", 40), ("1 rad", 57.3), ("0", 0), ("360", 360), ("0.5 turn", 180)],
)
def test_the_nearest_sample_of_an_angle(text, degrees):
    motion = turn()
    found = math.degrees(motion.channels["theta"].values[sample_at(motion, text)])
    assert found == pytest.approx(degrees, abs=0.051)


def test_other_inputs_have_their_own_unit():
    motion = Motion("time", {"time": Channel(np.linspace(0, 2, 21), "s")})
    assert sample_at(motion, "0.5") == 5
    assert sample_at(motion, "500 ms") == 5


@pytest.mark.parametrize(
    ("text", "words"), [("3 mm", "cannot be read in deg"), ("400", "0 to 360"), ("-10", "0 to 360")]
)
def test_what_is_no_angle_of_the_motion_is_refused(text, words):
    with pytest.raises(DesignError, match=words):
        sample_at(turn(), text)


def test_the_assembly_stands_where_it_is_asked_to(command_line, tmp_path):
    for name, at in (("start", []), ("zero", ["--at", "0"]), ("later", ["--at", "40 deg"])):
        code, _, said = command_line("model", EXAMPLE, "-o", tmp_path / name, *at)
        assert code == 0, said
    files = {name: (tmp_path / name / "assembly.step").read_bytes() for name in ("start", "zero", "later")}
    assert files["start"] == files["zero"] != files["later"]
    parts = {(tmp_path / name / "gear.step").read_bytes() for name in files}
    assert len(parts) == 1
    code, _, said = command_line("model", EXAMPLE, "-o", tmp_path / "wrong", "--at", "500")
    assert (code, "--at" in said) == (2, True)
    assert not (tmp_path / "wrong").exists()
