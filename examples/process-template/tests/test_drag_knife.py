import math

import numpy as np
import pytest
from mechwright_drag_knife.process import FILE, DragKnife, KnifeProgram
from mechwright_drag_knife.program import holder_way, laid_out, program
from mechwright_drag_knife.proof import cuts, faults

from mechwright import Build, Loop, Outline, Part, Process, circle, design, host
from mechwright.pipeline.process_options import process_options

SQUARE = Loop.polygon([(0, 0), (20, 0), (20, 10), (0, 10)])
HOLE = Loop((circle((10.0, 5.0), 3.0, clockwise=True),))
PIECES, _ = laid_out([Part("card", Outline(SQUARE, (HOLE,)), 1.0, "hdpe")], 6.0)
TEXT = program(PIECES, 0.5, 1000.0)


def test_the_holder_goes_before_the_tip_and_swings_about_it_in_corners():
    way = np.array(list(holder_way(SQUARE.flatten(), 0.5, 0.0)))
    assert way[0] == pytest.approx((0.5, 0.0))
    corner = way[(way[:, 0] > 19.99) & (way[:, 1] < 0.51)]
    assert np.hypot(*(corner - (20, 0)).T) == pytest.approx(0.5)
    assert corner[-1] == pytest.approx((20.0, 0.5))


def test_the_tip_follows_a_tractrix():
    """Pulled across its heading over the way s, the blade still leans by 2 atan(exp(-s / offset))."""
    text = "G21\nG0 Z2\nG0 X0 Y0\nG1 Z-0.2 F600\nG1 X0 Y1.5\n"
    (way,) = cuts(text, 0.5)
    x, y = way.coords[-1]
    assert math.atan2(-x, 1.5 - y) == pytest.approx(2 * math.atan(math.exp(-3.0)), rel=0.1)


def test_a_program_cuts_its_contours():
    assert faults(TEXT, PIECES, 0.5) == []


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("G1 X6.0000 Y15.5000", "G1 X7.0000 Y15.5000", "follows no contour"),
        ("Z2", "Z-0.1", "is cut 0 times"),
        ("Z-0.2", "Z0.2", "is cut 0 times"),
        ("G21", "HELLO", "is cut 0 times"),
    ],
)
def test_planted_faults_are_found(old, new, said):
    assert said in "; ".join(faults(TEXT.replace(old, new), PIECES, 0.5))
    assert faults(program(PIECES, 0.8, 1000.0), PIECES, 0.5)


def test_a_design_of_card_is_built(tmp_path):
    text = 'format = 1\nfamily = "slider-crank"\nname = "card"\nprocess = "drag-knife"\n[parameters]\n'
    file = tmp_path / "card.toml"
    file.write_text(text + 'crank = 30\nrod = 90\nspeed = 10\nthickness = 1\nmaterial = "hdpe"\n')
    assert isinstance(host().get(Process, "drag-knife"), DragKnife)
    with Build(file, host()) as build:
        files = KnifeProgram().files(build)
        options = {one.part: one for one in process_options(build) if one.process == "drag-knife"}
    assert files[FILE].startswith("G21")
    assert all(one.chosen and one.able and one.seconds for one in options.values())
    steel = design("slider-crank", crank=30, rod=90, speed=10, thickness=1, material="steel")
    assert "no blade" in DragKnife().refuses(steel.parts["crank"], steel)
