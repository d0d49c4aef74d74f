"""The hole of a part as made, found among slivers that passes leave beside it."""

import numpy as np
import pytest

from mechwright.contracts.made_part import MadeHole, MadeRing, MadeSection


def ring(points) -> MadeRing:
    points = np.asarray(points, float)
    return MadeRing(points, np.zeros_like(points), np.zeros(len(points)), np.zeros(len(points), bool))


def test_a_sliver_on_the_wall_is_no_hole() -> None:
    turn = np.linspace(0, 2 * np.pi, 400, endpoint=False)[::-1]
    around = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    bore = ring((0.1, -0.2) + 20 * around)
    few = around[40:46]
    slivers = ring([*(20.0005 * few), *(20.001 * few)[::-1]])
    slivers = slivers if slivers.area < 0 else ring(slivers.points[::-1])
    outside = ring(30 * around[::-1])
    for rings in ((outside, slivers, bore), (slivers, outside, bore), (bore, slivers, outside)):
        found = MadeSection(0.0, 5.0, rings).hole_at(0.0, 0.0, 40.0)
        assert isinstance(found, MadeHole)
        assert (found.x, found.y, found.diameter) == pytest.approx((0.1, -0.2, 40.0), abs=1e-6)
