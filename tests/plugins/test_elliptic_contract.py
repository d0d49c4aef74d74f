"""The built-in family under the kit that third parties use."""

from mechwright.testing import FamilyContract
from mechwright_elliptic_gears.family import EllipticGears


class TestEllipticGears(FamilyContract):
    family = EllipticGears
    examples = (
        {},
        {"module": 2, "teeth": 39},
        {"bore": 16, "keyway_width": 5, "keyway_depth": 2.4, "keyway_relief": 2},
    )
    refused = (({"teeth": 13}, "teeth"), ({"tooth_offset": 0.3}, "tooth_offset"), ({"bore": 60}, "bore"))
    derivatives = (("theta2", "omega2"), ("theta4", "omega4"), ("omega4", "alpha4"), ("alpha4", "jerk4"))
    input_rate = "omega2"
