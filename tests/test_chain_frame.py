"""One frame for all stages of a chain: its shafts, what they carry, and what stands in the way."""

from pathlib import Path

import pytest

import mechwright as mw
from mechwright.contracts.mounting import MountingError
from mechwright.errors import DesignError

EXAMPLE = Path(__file__).parents[1] / "examples" / "chains" / "geneva-behind-gears-machine.toml"


def design(**changes):
    """The example with changes of dotted keys."""
    return mw.load(EXAMPLE).design.changed({key.replace("__", "."): value for key, value in changes.items()})


def mounting(**changes):
    changed = design(**changes)
    return changed.family.mounting(changed.params)


def test_each_shaft_is_one_spindle_and_the_middle_one_carries_both_hubs():
    gear, middle, wheel = mounting().spindles
    assert (gear.name, middle.name, wheel.name) == ("1-1", "1-2", "2-wheel")
    assert [one.drives for one in (gear, middle, wheel)] == [True, False, False]
    parts = {part.name: part for part in mw.load(EXAMPLE).parts}
    assert (gear.hub.low, gear.hub.high) == (0.0, parts["1-gear-1"].thickness)
    top = 10.0 + 1.0 + 10.5 + parts["2-crank"].thickness - 10.0
    assert middle.hub.low == 0.0
    assert middle.hub.high > top
    assert middle.hub.grip == 10.0, "what is bonded is the shorter hub"
    assert wheel.origin == wheel.hub.low


def test_torque_shares_of_stages_multiply():
    gear, middle, wheel = mounting().spindles
    whole = design()
    first, second = (
        family.mounting(table.parameters).spindles
        for family, table in zip(whole.family.families, whole.params.stage, strict=True)
    )
    shares = {one.body: one.torque for one in first}
    assert middle.torque == pytest.approx(shares["gear-2"])
    own = {one.body: one for one in second}
    assert wheel.torque == pytest.approx(shares["gear-2"] * own["wheel"].torque)
    assert gear.torque == pytest.approx(shares["gear-1"])
    carried = next(one for one in first if one.body == "gear-2").force
    driving = next(one for one in second if one.drives).force
    assert middle.force == pytest.approx(carried + shares["gear-2"] * driving)


def test_shafts_of_the_frame_stand_in_place_of_those_of_the_chain():
    names = {part.name for part in mw.load(EXAMPLE).parts}
    assert {"shaft-1-1", "shaft-1-2", "shaft-2-wheel", "spacer-1", "lower-plate", "upper-plate"} <= names
    assert not {"shaft-in", "shaft-1", "shaft-out"} & names
    alone = {part.name for part in mw.load(EXAMPLE).with_(machine={"frame": "none", "motor": "none"}).parts}
    assert {"shaft-in", "shaft-1", "shaft-out"} <= alone


def test_shafts_stand_in_their_hubs():
    whole = mw.load(EXAMPLE)
    motion = whole.design.solve(2)
    for part in whole.parts:
        if part.name.startswith("shaft-"):
            (at,) = part.instances
            body = motion.poses[at.body].position[0]
            spindle = next(one for one in mounting().spindles if part.name == f"shaft-{one.name}")
            assert body[:2] == pytest.approx(spindle.point)
            low = body[2] + at.z
            assert low < spindle.hub.low < spindle.hub.high < low + part.turned.length


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"stage__2__parameters__driver_bore": 10}, "hubs with bores of 12 and 10 mm"),
        ({"stage__1__parameters__keyway_width": 4}, "a key holds one"),
    ],
)
def test_what_a_shaft_cannot_carry_is_told_with_what_works(changes, said):
    with pytest.raises(MountingError, match=said) as caught:
        mounting(**changes)
    assert any(
        not isinstance(_refused(design(**changes).changed(change)), DesignError)
        for change in caught.value.proposed
    )


def _refused(changed):
    try:
        return changed.family.mounting(changed.params)
    except DesignError as error:
        return error


def test_a_stage_with_a_ground_plate_gets_no_frame():
    chain = mw.load(EXAMPLE.parent / "slider-behind-gears.toml").design
    with pytest.raises(MountingError, match="has a ground plate of its own"):
        chain.family.mounting(chain.params)


def test_a_stage_in_the_way_is_turned():
    changed = design(stage__2__turned=0)
    (fault,) = [one for one in changed.check() if one.code.startswith("frame.")]
    assert {"stage.2.turned": 180.0} in fault.proposed
    assert not [one for one in changed.changed({"stage.2.turned": 180.0}).check() if one.severity == "error"]
