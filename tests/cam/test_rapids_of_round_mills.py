"""A ball that has been as deep beside a place has left a cusp there: no rapid goes into it."""

import pytest
from by_control import BY_NAME, prove
from golden_operations import made


@pytest.mark.parametrize("control", ["linuxcnc", "fanuc"])
def test_a_rapid_into_the_cusp_that_a_ball_has_left_beside_its_path(control: str) -> None:
    """A fault that the mutants found: G9 for G1 leaves G0 in force, down onto the cusp in a dish's middle."""
    one = made("ball", control)[0]
    lines = one.text.splitlines()
    start = next(k for k, line in enumerate(lines) if "level the floor" in line.lower())
    feed = next(k for k, line in enumerate(lines) if k > start and line.startswith("G1 Z0"))
    lines[feed] = lines[feed].replace("G1 ", "")
    lines[feed + 1] = lines[feed + 1].split(" F")[0]
    lines[feed + 2] += " F294." if " F" not in lines[feed + 2] else ""
    check = prove("\n".join(lines), one.job, BY_NAME[control]).checks["rapids-in-stock"]
    assert not check.passed
    assert check.line == feed + 2
