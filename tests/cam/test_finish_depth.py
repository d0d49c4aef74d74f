"""How deep finishing passes are: no more is taken at once than from a slot."""

import math
import re
from dataclasses import replace

import pytest
from by_control import posted, prove
from by_night import thinned
from planning_parts import LIBRARY, bore, job, plate, rounded_box

from mechwright.contracts.materials import material
from mechwright.contracts.part import Bore, Pocket, Profile
from mechwright_cam.operations.bending import MOST, wall_bending
from mechwright_cam.operations.finishing import cut_width, finish_depth

OUTSIDE = Profile("outside", rounded_box(60, 40, 6), "outside", 0, 6.0)
FEATURES = {
    "recess": Pocket("recess", rounded_box(20, 14, 2), (), 0.0, 4.0),
    "hole": Bore("hole", (0.0, 0.0), 7.0, 0.0, 4.0),
}


@pytest.mark.parametrize(
    ("name", "finish", "way"), thinned(3, [*FEATURES], [(0.05, 1), (0.2, 1), (0.5, 2)], ["computer", "wear"])
)
def test_the_more_is_left_the_less_deep_is_a_pass(name: str, finish: tuple[float, int], way: str) -> None:
    """mill-2 takes up to 4 mm, and in aluminium 1.2 mm² of what is left: as much as of a slot.

    In the hole 0.5 mm are 0.65 mm wide.
    """
    leave, passes = finish
    passes += name == "hole" and leave == 0.5
    settings = {"compensation": way, "spring_passes": 0, "stock_to_leave": leave, "floor_to_leave": 0.0}
    one = job(plate(machined=(FEATURES[name], OUTSIDE)), "mill-2", **settings)
    text = posted(one)
    prove(text, one).require()
    cut = text[text.index(f"{name}: finish") :]
    heights = set(re.findall(r"Z(-[\d.]+)", cut[: cut.index("(operation: outside")]))
    assert len(heights) == passes


@pytest.mark.parametrize("way", ["computer", "wear"])
def test_in_a_bore_that_a_mill_nearly_fills_more_of_it_is_in_the_cut(way: str) -> None:
    """Off a wall of 4 mm the allowance of 0.2 mm is 0.5 mm wide for mill-2.5: too much for 8 mm at once."""
    dowel = Bore("dowel", (0.0, 0.0), 4.0, 0.0, 8.0)
    of = plate(bore(4.0), machined=(dowel, replace(OUTSIDE, depth=8.0)), thickness=8.0)
    one = job(of, "mill-2.5", "mill-8", "drill-3.3", "spot-6", compensation=way)
    prove(posted(one), one).require()
    mill = LIBRARY.get("mill-2.5")
    assert finish_depth(one, mill, 8.3, 8.3) == 8.3
    deep = finish_depth(one, mill, 8.3, 8.3, dowel.diameter / 2)
    assert deep * cut_width(0.75, 1.25, 1.8) <= mill.cutting["aluminium"].step_down * 2.5**2


def test_a_finish_step_below_that_is_kept() -> None:
    mill = LIBRARY.get("mill-6")
    assert finish_depth(job(plate(), finish_step=0.5), mill, 12.0, 12.0) == 3.0
    thick = job(plate(material="steel"), finish_step=10, stock_to_leave=0.5)
    assert finish_depth(thick, mill, 60.0, 60.0) < 60


@pytest.mark.parametrize(
    ("name", "stuff", "high", "passes"),
    [
        ("mill-3", "aluminium", 10.3, 1),  # it bends 0.017 mm off the wall, and as much in the lower of two
        ("mill-3", "steel", 15.3, 3),
        ("mill-1.6", "aluminium", 10.3, 4),  # slender: passes of 2 diameters
        ("mill-6", "aluminium", 10.3, 1),
    ],
)
def test_a_wall_is_finished_in_one_depth_where_the_mill_bears_that(
    name: str, stuff: str, high: float, passes: int
) -> None:
    of, mill = job(plate(material=stuff, thickness=10.0)), LIBRARY.get(name)
    step = finish_depth(of, mill, high, high)
    assert math.ceil(high / step - 1e-9) == passes
    if passes == 1:
        assert wall_bending(of, mill, high, step) <= MOST
        # Half as deep it would bend nearly as much: the load is nearer to its end.
        assert wall_bending(of, mill, high, high / 2) > 0.5 * wall_bending(of, mill, high, high)


def test_a_slender_mill_bends_no_more_in_a_deeper_finishing_pass() -> None:
    """Within a turn of its helix each tooth is in the allowance over the same length."""
    of, mill = job(plate()), LIBRARY.get("mill-1.6")
    assert wall_bending(of, mill, 10.3, 3.4) < wall_bending(of, mill, 10.3, 2.6)


def test_bending_off_a_wall_is_that_of_a_rod_under_a_load_along_its_end() -> None:
    """A load all along a rod bends its end 3/8 as much as the same at the end."""
    of, mill = job(plate()), LIBRARY.get("mill-3")
    rod = mill.model_copy(update={"stick_out": 12.0, "flute_length": 12.0})
    stuff, data = material("aluminium"), mill.cutting["aluminium"]
    angle = math.acos(1 - 0.2 / 1.5)
    chip = data.chip_load * min(1 / math.sin(angle), 2.0) * math.sqrt(0.2 / 3)
    engaged = max(1.5 * angle / math.tan(math.radians(30)), 12.0 * 3 * angle / math.tau)
    force = 0.5 * stuff.force * chip ** (1 - stuff.force_exponent) * engaged
    inertia = math.pi * (0.75 * 3) ** 4 / 64
    assert wall_bending(of, rod, 12.0, 12.0) == pytest.approx(3 / 8 * force * 12**3 / (3 * 6e5 * inertia))
