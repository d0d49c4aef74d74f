"""The descent of the path searches, in a valley where plain steps creep."""

import numpy as np
import pytest

from mechwright.arrays import Array
from mechwright.mechanics.tracing import descent


class Valley:
    """Rosenbrock's valley, narrow: misses (1, 3) of one point, of which the angle takes the last away."""

    narrow = 100.0

    def made(self, x: Array) -> Array:
        return x

    def missed(self, made: Array, theta: Array) -> Array:
        x, y = made[..., 0, None], made[..., 1, None]
        return np.stack([self.narrow * (y - x**2) + 0 * theta, 1 - x + 0 * theta, theta - x], axis=-1)

    def exceeded(self, made: Array, theta: Array) -> Array:
        return made[..., :1] - 2 + 0 * theta[..., :1]

    def ordered(self, theta: Array, sense: Array) -> Array:
        return theta.copy()


def least(steps: int) -> float:
    """Sum of squares after so many steps from the other side of the valley."""
    x, theta = np.array([[-1.2, 1.0]]), np.zeros((1, 1))
    x, theta = descent.descend(Valley(), x, theta, np.ones((1, 1)), 1.0, steps, fine=True)
    return float(descent.squares(Valley(), x, theta)[0])


def test_steps_follow_the_bend_of_a_valley(monkeypatch: pytest.MonkeyPatch) -> None:
    assert least(60) < 1e-20
    monkeypatch.setattr(descent, "BENT", 0.0)
    assert least(60) > 0.1


def test_the_angle_is_at_its_point() -> None:
    x, theta = descent.descend(
        Valley(), np.array([[0.5, 0.3]]), np.zeros((1, 1)), np.ones((1, 1)), 1.0, 100, fine=True
    )
    assert x[0] == pytest.approx([1, 1])
    assert theta[0] == pytest.approx([1])
