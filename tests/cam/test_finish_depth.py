"""How deep finishing passes are: no more is taken at once than from a slot."""

import re

import pytest
from by_control import posted, prove
from by_night import thinned
from planning_parts import LIBRARY, job, plate, rounded_box

from mechwright.contracts.part import Bore, Pocket, Profile
from mechwright_cam.operations.finishing import finish_depth
from mechwright_cam.shop.settings import CamSettings

OUTSIDE = Profile("outside", rounded_box(60, 40, 6), "outside", 0, 6.0)
FEATURES = {
    "recess": Pocket("recess", rounded_box(20, 14, 2), (), 0.0, 4.0),
    "hole": Bore("hole", (0.0, 0.0), 7.0, 0.0, 4.0),
}


@pytest.mark.parametrize(
    ("name", "finish", "way"), thinned(3, [*FEATURES], [(0.05, 1), (0.2, 1), (0.5, 2)], ["computer", "wear"])
)
def test_the_more_is_left_the_less_deep_is_a_pass(name: str, finish: tuple[float, int], way: str) -> None:
    """mill-2 takes up to 4 mm, and in aluminium 2 mm² of 0.1 mm more than what is left."""
    leave, passes = finish
    settings = {"compensation": way, "spring_passes": 0, "stock_to_leave": leave, "floor_to_leave": 0.0}
    one = job(plate(machined=(FEATURES[name], OUTSIDE)), "mill-2", **settings)
    text = posted(one)
    prove(text, one).require()
    cut = text[text.index(f"{name}: finish") :]
    heights = set(re.findall(r"Z(-[\d.]+)", cut[: cut.index("(operation: outside")]))
    assert len(heights) == passes


def test_a_finish_step_below_that_is_kept() -> None:
    mill = LIBRARY.get("mill-6")
    assert finish_depth(CamSettings(finish_step=0.5), mill, "aluminium") == 3.0
    assert finish_depth(CamSettings(finish_step=10, stock_to_leave=0.5), mill, "steel") < 60
