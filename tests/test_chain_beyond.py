"""What a chain asks of a stage may be more than a design of its family may say: it is told, and not handed on."""

from pathlib import Path

import pytest

from mechwright import Design, host
from mechwright.contracts.finding import errors
from mechwright.designs.change import changed
from mechwright.designs.design import design_of


def _chain(*stages):
    table = [{"family": family, "parameters": parameters} for family, parameters in stages]
    return design_of({"name": "chain", "stage": table}, Path("chain.toml"), "", host())


def _beyond(design: Design):
    return [one for one in errors(design.check()) if one.code == "chain.beyond"]


def test_a_torque_that_no_wheel_may_be_asked_for_is_told_of_its_stage():
    """The wheel's family failed at it, as if it had a fault of its own."""
    heavy = ("elliptic-gears", {"load_torque": 1e5, "eccentricity": 0.9, "teeth": 45})
    design = _chain(("geneva", {}), heavy, heavy)
    (found,) = [one for one in _beyond(design) if "geneva" in one.message]
    assert found.parameter == "stage.1"
    assert found.limit == 1e6
    assert found.value is not None
    assert found.value > found.limit


def test_a_speed_that_is_too_low_goes_up_with_the_first_stage():
    design = _chain(
        ("elliptic-gears", {"speed": 0.001, "eccentricity": 0.4}), ("geneva", {}), ("four-bar", {})
    )
    slow = design_of(
        changed(design.content, {"stage.2.parameters.slots": 12}), Path("chain.toml"), "", host()
    )
    found = [one for one in _beyond(slow) if one.unit == "rpm"]
    for one in found:
        assert one.value is not None
        assert one.value < 0.001
        assert "0.001 at least" in one.message
        (change,) = one.proposed
        assert change["stage.1.parameters.speed"] > 0.001
    assert found


@pytest.mark.parametrize("family", ["slider-crank", "geneva", "cam-follower"])
def test_a_speed_that_no_design_may_have_comes_down_with_the_first_stage(family):
    design = _chain(("elliptic-gears", {"speed": 15000, "eccentricity": 0.4}), (family, {}))
    (found,) = [one for one in _beyond(design) if one.unit == "rpm"]
    assert found.value == pytest.approx(15000 * 1.4 / 0.6)
    assert found.limit == 20000
    assert found.parameter == "stage.1.parameters.speed"
    (change,) = found.proposed
    slower = design_of(changed(design.content, change), Path("chain.toml"), "", host())
    assert not [one for one in _beyond(slower) if one.unit == "rpm"]
    assert change[found.parameter] == pytest.approx(15000 * 20000 / found.value, rel=0.02)
