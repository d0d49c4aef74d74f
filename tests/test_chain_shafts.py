"""Shafts and spacers of a chain stand at the heights of the hubs that they carry, at every level."""

import pytest
from test_chain import CIRCLES, D1, chain

from mechwright.designs.design import Design
from mechwright.mechanics.chain.planes import part_heights

WHEEL = (
    "geneva",
    {"slots": 6, "law": "straight", "entry_radius": 120, "roller_radius": 5, "driver_bore": 10},
)


def spans(design: Design) -> dict[str, tuple[float, float]]:
    """Lower and upper end of every part in the chain, mm; each has one copy."""
    poses = design.solve(2).poses
    found = {}
    for part in design.parts():
        low, high = part_heights(part)
        (one,) = part.instances
        at = one.z + float(poses[one.body].position[0, 2])
        found[part.name] = (low + at, high + at)
    return found


@pytest.mark.parametrize("bore", [10, 8], ids=["spacers", "collars"])
def test_shafts_of_three_stages_stand_in_their_hubs(bore: float) -> None:
    """The shaft behind the last stage stood too high by the stage's level, those between by theirs."""
    stages = [("noncircular-gears", {**CIRCLES, "bore": size}) for size in (10, bore, 10)]
    at = spans(chain(stages[0], stages[1], (*stages[2], {"turned": 20})))
    assert at["2-gear-2"][0] == 11
    assert at["3-gear-1"] == at["3-gear-2"] == (22, 32)
    assert at["shaft-out"] == (22, 32 + 2 * 10)
    assert at["shaft-2"] == (11, 32)
    assert at["shaft-1"] == (-20, 21)
    if bore == 10:
        assert at["spacer-1"] == (10, 11)
        assert at["spacer-2"] == (21, 22)


def test_the_shaft_of_a_wheel_behind_gears_begins_where_the_wheel_does() -> None:
    """Of a Geneva wheel as well, whatever the gap below it."""
    at = spans(chain(("noncircular-gears", {**D1, "bore": 10}), (*WHEEL, {"gap": 3})))
    assert at["shaft-out"][0] == at["2-wheel"][0] == 14.5
    assert at["spacer-1"] == (10, 13)
