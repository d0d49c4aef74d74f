"""What cutter and holder cover beside a plate, as boxes in closed form; and how far plates have to be apart."""

import numpy as np
import pytest
from by_control import scene_of
from shop import MILL, plate_job

from mechwright_cam.proof import Scene
from mechwright_cam.proof.neighbours import apart, covered
from mechwright_cam.shop.tool import Tool

HEAD = "G17 G21 G40 G49 G80 G90\nG53 G0 Z0\nT3 M6\nG54 S8000 M3\nG0 X0 Y0\nG43 H3 Z9\n"
HELD = MILL.model_copy(update={"stick_out": 20.0, "holder_diameter": 30.0})


def scene(lines: str, mill: Tool = HELD) -> Scene:
    return scene_of(f"{HEAD}{lines}\nG0 Z9\nM30\n", plate_job(tools=(mill,)))


@pytest.mark.parametrize(("z", "reach"), [(-1.0, 3.0), (-19.99, 3.0), (-20.0, 3.0), (-20.01, 15.0)])
def test_the_holder_counts_where_it_goes_below_the_top(z: float, reach: float) -> None:
    steps, boxes = covered(scene(f"G1 Z{z} F100\nX10 Y4"), 0.0)
    down, along, up = boxes.tolist()
    assert down == [-reach, -reach, reach, reach]
    assert along == [-reach, -reach, 10 + reach, 4 + reach]
    assert up == [10 - reach, 4 - reach, 10 + reach, 4 + reach]
    assert steps.size == 3


def test_the_holder_begins_behind_the_flutes_where_nothing_is_known() -> None:
    mill = MILL.model_copy(update={"holder_diameter": 30.0})
    for z, reach in ((-MILL.flute_length, 3.0), (-MILL.flute_length - 0.01, 15.0)):
        assert covered(scene(f"G1 Z{z} F100", mill), 0.0)[1][0].tolist() == [-reach, -reach, reach, reach]


def test_what_stays_above_the_top_covers_nothing() -> None:
    assert covered(scene("G1 Z2 F100\nX10"), 0.0)[0].size == 0
    assert covered(scene("G1 Z2 F100\nX10"), 2.0)[0].size == 0
    steps, boxes = covered(scene("G1 Z2 F100\nX10"), 2.1)
    assert steps.size == 3
    assert boxes[1].tolist() == [-3, -3, 13, 3]
    # And the holder is 20 mm above the tip, wherever the top is.
    assert covered(scene("G1 Z2 F100"), 22.0)[1][-1].tolist() == [-3, -3, 3, 3]
    assert covered(scene("G1 Z2 F100"), 22.1)[1][-1].tolist() == [-15, -15, 15, 15]


def test_plates_are_apart_by_their_own_width_and_what_is_covered_beyond() -> None:
    boxes = np.array([[-12.0, -3.0, 5.0, 21.0], [0.0, -24.0, 14.5, 6.0]])
    # To the right 14.5 + 10, to the left 10 + 12; rearwards 21 + 20, forwards 20 + 24.
    assert apart(boxes, (-10.0, -20.0, 10.0, 20.0)) == "24.5 mm apart in X or 44.0 mm in Y, from zero to zero"
    turned = -boxes[:, [2, 3, 0, 1]]
    assert apart(turned, (-10.0, -20.0, 10.0, 20.0)) == apart(boxes, (-10.0, -20.0, 10.0, 20.0))
