"""Last digits that differ from processor to processor decide no corner, and the kernels have names."""

import os
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mechwright.arrays import GRID, on_grid, turned
from mechwright.geometry import Loop
from mechwright.kernels import kernels

PLACES = st.floats(-1e4, 1e4)


@given(st.integers(-(10**10), 10**10), st.floats(-0.49, 0.49))
def test_what_is_near_a_point_of_the_grid_is_there(number: int, off: float) -> None:
    assert float(on_grid(np.array((number + off) * GRID))) == number * GRID


@given(st.lists(st.tuples(PLACES, PLACES), min_size=1), st.floats(-7, 7))
def test_turning_is_the_product_of_matrices(points: list[tuple[float, float]], angle: float) -> None:
    c, s = np.cos(angle), np.sin(angle)
    product = np.array(points) @ np.array([[c, s], [-s, c]])
    assert turned(np.array(points), angle) == pytest.approx(product, abs=1e-9)


def test_corners_are_the_same_whatever_their_last_digits_are() -> None:
    rng = np.random.default_rng(7)
    corners = np.array([(0.0, 0.0), (40.0, 0.0), (30.0, 25.0), (-5.0, 30.0)])
    first = Loop.polygon(corners.tolist()).flatten()
    for _ in range(20):
        again = Loop.polygon((corners + rng.uniform(-1e-12, 1e-12, corners.shape)).tolist()).flatten()
        assert again.tobytes() == first.tobytes() or (abs(again - first) == 0).all()


def test_kernels_are_those_that_are_set() -> None:
    one, *_ = kernels().split(", ")
    assert one
    words = [sys.executable, "-c", "from mechwright.kernels import kernels; print(kernels())"]
    for variable in ("OPENBLAS_CORETYPE", "NPY_DISABLE_CPU_FEATURES"):
        value = {"OPENBLAS_CORETYPE": "Prescott"}.get(variable) or ",".join(kernels().split(", ")[2:])
        if value and "x86_64" in kernels() and "unknown" not in kernels():
            done = subprocess.run(
                words, env=os.environ | {variable: value}, capture_output=True, text=True, check=True
            )
            assert done.stdout.strip() != kernels()
