"""Pressure on the plain bearings of a linkage: which joint has the most, and what is said of it."""

from collections.abc import Mapping

from mechwright.contracts.finding import Change, Finding
from mechwright.contracts.motion import Scalar
from mechwright.mechanics.strength.bearings_life import SINTERED_PRESSURE
from mechwright.tolerances import exceeds


def most_pressed(
    peaks: Mapping[str, Scalar], widths: Mapping[str, float], pin: float
) -> tuple[str, float, float]:
    """The joint with the greatest pressure, its force in N, and the pressure in N/mm² on its projected area.

    Parameters
    ----------
    peaks
        Greatest force of each joint, as ``force_`` and its name, N.
    widths
        Joint to the width of its bearing, mm.
    pin
        Diameter of all pins, mm.
    """
    forces = {joint: peaks[f"force_{joint}"].value for joint in widths}
    joint = max(forces, key=lambda one: forces[one] / widths[one])
    return joint, forces[joint], forces[joint] / (pin * widths[joint])


def too_pressed(
    code: str, joint: str, force: float, pressure: float, proposed: tuple[Change, ...]
) -> list[Finding]:
    """A warning of a joint whose pressure is more than sintered bronze carries."""
    if not exceeds(pressure, SINTERED_PRESSURE):
        return []
    return [
        Finding.warning(
            code,
            "pin_diameter",
            f"joint {joint} carries up to {force:.4g} N, {pressure:.4g} N/mm² on its bearing",
            pressure,
            SINTERED_PRESSURE,
            "N/mm^2",
            "take thicker pins or plates, a smaller load or a lower speed",
            proposed=proposed,
        )
    ]
