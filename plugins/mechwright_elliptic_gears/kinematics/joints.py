"""What holds the gears of a pair or a train, and what is fixed to them."""

from mechwright import GROUND, Joint
from mechwright.contracts.joint import fixed
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.gear import ellipse_of
from mechwright_elliptic_gears.parts.layout import joining_bodies


def held_by(params: EllipticGearParams) -> dict[str, Joint]:
    """Joints of all bodies of the motion; the ratio of elliptic gears changes over the turn."""
    a = ellipse_of(params).semi_major
    focus = (2 * a * params.eccentricity, 0.0, 0.0)
    if params.phase_angle is None:
        return {
            "o2": Joint("revolute", GROUND, "gear-2", drives=True),
            "o4": Joint("revolute", GROUND, "gear-4", (2 * a, 0.0, 0.0)),
            "mesh": Joint("gear", "gear-2", "gear-4"),
            **_coupler("gear-2", "gear-4", focus),
        }
    return {
        **fixed(GROUND, "base", "axis-2", "axis-5"),
        "o2": Joint("revolute", "base", "gear-2", (-2 * a, 0.0, 0.0), drives=True),
        "o4": Joint("revolute", "base", "gear-3"),
        "o5": Joint("revolute", "base", "gear-5", (2 * a, 0.0, 0.0)),
        **fixed("gear-3", "gear-4", *joining_bodies(params)),
        **fixed("gear-4", "joint-j"),
        **fixed("gear-5", "joint-k"),
        "mesh": Joint("gear", "gear-2", "gear-3"),
        "second-mesh": Joint("gear", "gear-3", "gear-5"),
        **_coupler("gear-4", "gear-5", focus),
    }


def _coupler(one: str, two: str, focus: tuple[float, float, float]) -> dict[str, Joint]:
    """The link between the free foci of two gears, 2a long."""
    return {"j": Joint("revolute", one, "coupler", focus), "k": Joint("revolute", two, "coupler", focus)}
