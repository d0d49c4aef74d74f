"""What the crank of a Geneva drive says of its place on the locking disc is so."""

import numpy as np
import pytest

from mechwright_geneva.family import Geneva
from mechwright_geneva.parameters import GenevaParams


@pytest.mark.parametrize("values", [{}, {"slots": 6}, {"slots": 8, "rollers": 2}])
def test_a_hollow_of_the_disc_lies_under_every_roller(values):
    params = GenevaParams.model_validate(values)
    parts = {part.name: part for part in Geneva().parts(params)}
    mark, *_ = parts["crank"].marks
    assert "hollow" in mark.note
    motion = Geneva().solve(params, 2)
    rim = np.array(parts["locking-disc"].outline.outer.flatten(0.01))
    angle, radius = np.arctan2(rim[:, 1], rim[:, 0]), np.hypot(*rim.T)
    turn, centre = motion.poses["driver"].rotation[0], motion.poses["driver"].position[0]
    for name, poses in motion.poses.items():
        if name.startswith("roller"):
            x, y, _ = turn.T @ (poses.position[0] - centre)
            away = np.abs((angle - np.arctan2(y, x) + np.pi) % (2 * np.pi) - np.pi)
            assert radius[away < 0.2].min() < 0.9 * radius.max(), "there the disc is hollow"
            assert radius[away.argmin()] == pytest.approx(radius[away < 0.5].min(), rel=0.05), "in its middle"
