"""The polar moment of gears from their pitch curves, against that of the teeth as they are drawn."""

import math

import pytest

from mechwright.mechanics.gearing import Rack, Teeth, gear_loop
from mechwright.mechanics.gearing.inertia import UNSURE, near_moment
from mechwright_elliptic_gears.kinematics.ellipse import Ellipse
from mechwright_noncircular_gears.sized import SizedParams
from mechwright_noncircular_gears.table import table_of


@pytest.mark.parametrize(("teeth", "eccentricity"), [(20, 0.1), (25, 0.5), (41, 0.6)])
def test_drawn_teeth_have_nearly_that_moment(teeth: int, eccentricity: float) -> None:
    ellipse = Ellipse(40.0, eccentricity)
    module = ellipse.perimeter / (math.pi * teeth)
    rack = Rack(module, math.radians(20), module, 1.25 * module, 0.3 * module, 0.05)
    loop, _ = gear_loop(Teeth(ellipse, rack, teeth, 0.0))
    drawn, near = loop.moments[3] + loop.moments[4], near_moment(ellipse, rack)
    assert UNSURE[0] * near < drawn < UNSURE[1] * near


def test_a_ring_is_its_rim_without_the_opening_that_its_teeth_leave() -> None:
    law = {"law": "fourier", "sines": [2.0], "internal": True, "module": 4.0, "teeth": 20, "mate_lobes": 3}
    params = SizedParams.model_validate(law)
    ring, rim = table_of(params).teeth[1], table_of(params).ring_plate
    low, high = sorted(rim.moment + share * near_moment(ring.curve, ring.rack) for share in UNSURE)
    assert low < table_of(params).outlines[1].polar_moment < high
