"""Cutter compensation turned on along an arc: the way of the centre, against the circle that it has to be."""

import math

import numpy as np
import pytest
from by_control import interpret

HEAD = "G17 G21 G40 G90 G94 G54\nG0 X0 Y0 Z5\n"


@pytest.mark.parametrize("side", [41, 42])
@pytest.mark.parametrize("ccw", [False, True])
@pytest.mark.parametrize("turn", [0.4, 1.3, math.pi / 2, 2.5])
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
