"""Cutter compensation turned on along an arc: the way of the centre, against the circle that it has to be."""

import math

import numpy as np
import pytest
from by_control import interpret

HEAD = "G17 G21 G40 G90 G94 G54\nG0 X0 Y0 Z5\n"


@pytest.mark.parametrize("side", [41, 42])
@pytest.mark.parametrize("ccw", [False, True])
@pytest.mark.parametrize("turn", [0.4, 1.3, math.pi / 2, 2.5, 4.0])
@pytest.mark.parametrize("size", [0.05, 1.0])
def test_the_tool_arrives_beside_the_contour_in_its_direction(
    side: int, ccw: bool, turn: float, size: float
) -> None:
    about, radius = size * np.array((7.0, 4.0)), size * 2.0
    sense = 1 if ccw else -1
    begin = math.atan2(*(-about)[::-1])
    angle = begin + sense * turn
    radial = np.array((math.cos(angle), math.sin(angle)))
    heading = sense * np.array((-radial[1], radial[0]))
    contour = about + np.hypot(*about) * radial
    x, y = contour.tolist()
    word = f"G{3 if ccw else 2} X{x:.9f} Y{y:.9f} I{about[0]:.9f} J{about[1]:.9f} F100"
    run = interpret(f"{HEAD}G{side} D1\n{word}\nG40\nG1 X60 Y60\nM2\n", diameters={1: 2 * radius})
    step = next(k for k in range(len(run)) if run.sweep[k])
    left = np.array((-heading[1], heading[0])) * (1 if side == 41 else -1)
    start, end, middle = run.start[step][:2], run.end[step][:2], run.centre[step]
    np.testing.assert_allclose(start, (0, 0), atol=1e-12)
    np.testing.assert_allclose(end, contour + radius * left, atol=1e-7)
    # The circle through both with this direction at its end, and the sense in which it is run.
    assert math.dist(middle, start) == pytest.approx(math.dist(middle, end), abs=1e-7)
    spoke = end - middle
    along = np.sign(run.sweep[step]) * np.array((-spoke[1], spoke[0])) / np.hypot(*spoke)
    np.testing.assert_allclose(along, heading, atol=1e-7)
    turned = math.remainder(
        math.atan2(*(end - middle)[::-1]) - math.atan2(*(start - middle)[::-1]) - run.sweep[step], math.tau
    )
    assert turned == pytest.approx(0.0, abs=1e-9)


def test_a_start_on_the_tangent_of_the_end_is_led_straight() -> None:
    """The arc that would begin there is a line: the tool is as far from the tangent as it has to be."""
    turn = math.acos(1 - 2.0 / 10.0)
    x, y = 10 * math.sin(turn), 10 * (1 - math.cos(turn))
    word = f"G3 X{x:.9f} Y{y:.9f} I0 J10 F100"
    run = interpret(f"{HEAD}G41 D1\n{word}\nG40\nG1 X60 Y60\nM2\n", diameters={1: 4.0})
    step = next(k for k in range(len(run)) if run.feed[k])
    end = (x - 2 * math.sin(turn), y + 2 * math.cos(turn))
    np.testing.assert_allclose(run.end[step][:2], end, atol=1e-7)
    assert run.sweep[step] == 0
    assert math.atan2(end[1], end[0]) == pytest.approx(turn)


@pytest.mark.parametrize("mirrored", [False, True])
@pytest.mark.parametrize(("left", "beyond"), [(True, 5.0), (False, 40.0)])
def test_in_an_inner_corner_of_an_arc_and_a_line_the_tool_touches_both(
    left: bool, beyond: float, mirrored: bool
) -> None:
    """A quarter of a circle of 10 mm, and off at a right angle to the side on which the tool of 2 mm is."""
    s = -1 if mirrored else 1
    side = 41 if left != mirrored else 42
    arc = f"G{2 if mirrored else 3} X20 Y{10 * s} I0 J{10 * s}"
    lines = ["G0 X-10 Y0", f"G{side}.1 D2 G1 X0 F100", "X10", arc, f"G1 X{beyond}", "G40", "G0 Z9", "M2"]
    run = interpret("G17 G21 G40 G90 G94 G54\nG0 Z5\n" + "\n".join(lines))
    (step,) = np.flatnonzero(run.sweep)
    reach = 9.0 if left else 11.0
    there = (10 + math.sqrt(reach**2 - 1), 9.0 * s)
    assert run.start[step, :2] == pytest.approx((10, s if left else -s), abs=1e-6)
    assert run.end[step, :2] == pytest.approx(there, abs=1e-6)
    assert run.start[step + 1, :2] == pytest.approx(there, abs=1e-6)
    assert run.end[step + 1, :2] == pytest.approx((beyond, 9.0 * s), abs=1e-6)
