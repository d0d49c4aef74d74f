"""The outline of cutters against closed forms and against itself turned round."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mechwright_cam.shop.cutter import Cutter, approach, cusp, cutter
from mechwright_cam.shop.tool import Tool, ToolKind


def tool(kind: ToolKind, diameter: float = 6.0, **more: float) -> Tool:
    return Tool(name="t", number=1, kind=kind, diameter=diameter, flute_length=30, **more)


def test_a_ball_is_half_a_sphere() -> None:
    ball = cutter(tool(ToolKind.BALL))
    height = np.linspace(0, 3, 31)
    np.testing.assert_allclose(ball.radius_at(height) ** 2 + (3 - height) ** 2, 9, atol=1e-12)
    assert ball.radius_at(50.0) == 3
    assert ball.radius_at(-1.0) == 0


def test_a_bull_nose_has_a_flat_and_a_quarter_of_a_circle() -> None:
    bull = cutter(tool(ToolKind.BULL_NOSE, 10, corner_radius=2))
    assert bull.radius_at(0.0) == 3
    assert bull.radius_at(2 * (1 - math.sqrt(0.5))) == pytest.approx(3 + 2 * math.sqrt(0.5))
    assert bull.radius_at(2.0) == 5
    assert bull.height_at(2.9) == 0
    assert bull.height_at(5.0) == pytest.approx(2)
    assert bull.height_at(5.01) == math.inf


def test_a_flat_end_mill_is_a_cylinder() -> None:
    mill = cutter(tool(ToolKind.END_MILL))
    assert mill.radius_at(0.0) == 3
    assert mill.height_at(3.0) == 0


@pytest.mark.parametrize(("kind", "tip"), [(ToolKind.DRILL, 0.0), (ToolKind.CHAMFER, 1.0)])
def test_a_pointed_tool_is_a_cone(kind: ToolKind, tip: float) -> None:
    cone = cutter(tool(kind, point_angle=90, tip_diameter=tip))
    assert cone.radius_at(0.0) == tip / 2
    assert cone.radius_at(1.0) == pytest.approx(1 + tip / 2)
    assert cone.radius_at(9.0) == 3
    assert cone.height_at(2.0) == pytest.approx(2 - tip / 2)


@given(radius=st.floats(0.2, 20), share=st.floats(0.01, 1), height=st.floats(0.001, 0.999))
def test_height_and_radius_undo_each_other(radius: float, share: float, height: float) -> None:
    shape = Cutter(radius, nose=share * radius)
    at = height * shape.nose
    assert shape.height_at(shape.radius_at(at) * (1 - 1e-12)) == pytest.approx(at, rel=1e-5, abs=1e-9)


@given(radius=st.floats(0.5, 10), share=st.floats(0.05, 1))
def test_of_many_cutters_each_is_itself(radius: float, share: float) -> None:
    noses = np.array([0.0, share * radius, radius])
    together = Cutter(np.full(3, radius), noses, np.zeros(3), np.full(3, np.inf)).radius_at(0.3)
    assert together.tolist() == [float(Cutter(radius, nose).radius_at(0.3)) for nose in noses]


@given(step=st.floats(0.01, 5.9))
def test_cusp_between_the_cuts_of_a_ball(step: float) -> None:
    assert cusp(tool(ToolKind.BALL), step) == pytest.approx(3 - math.sqrt(9 - step**2 / 4))


def test_cusp_of_other_mills() -> None:
    assert cusp(tool(ToolKind.END_MILL), 5.9) == 0
    assert cusp(tool(ToolKind.BULL_NOSE, corner_radius=1), 3.9) == 0
    assert cusp(tool(ToolKind.BALL), 6.1) == math.inf


def test_a_round_edge_meets_shallow_work_at_a_small_angle() -> None:
    ball = tool(ToolKind.BALL)
    assert float(approach(ball, 3 * (1 - math.cos(math.radians(30))))) == pytest.approx(0.5)
    assert float(approach(ball, 3.0)) == 1
    assert float(approach(ball, math.inf)) == 1
    assert float(approach(tool(ToolKind.END_MILL), 1e-3)) == 1


def test_nose_of_every_mill() -> None:
    assert tool(ToolKind.END_MILL).nose == 0
    assert tool(ToolKind.BULL_NOSE, corner_radius=0.5).nose == 0.5
    assert tool(ToolKind.BALL).nose == 3
