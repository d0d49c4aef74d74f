"""Channels of a motion: what turns, and points, from pose to jerk."""

import numpy as np

from mechwright.contracts.motion import Channel
from mechwright.mechanics.planar.rigid import PointMotion, Pole, Turning

RATES = ("velocity", "acceleration", "jerk")
"""Words for the first three rates."""


def turning_channels(turning: Turning, angle: str, suffix: str, body: str = "") -> dict[str, Channel]:
    """The angle of a ``body`` by its own name, and its rates: ``omega``, ``alpha``, ``jerk`` with a suffix.

    ``body`` is as people are told it: ``"the crank"``; without one the names of the channels have to do.
    """
    own = Channel(turning.theta, "rad", f"angle of {body}" if body else "")
    return {angle: own, **rate_channels(turning, suffix, body)}


def rate_channels(turning: Turning, suffix: str, body: str = "") -> dict[str, Channel]:
    """The rates alone."""
    rates = (("omega", turning.omega), ("alpha", turning.alpha), ("jerk", turning.jerk))
    return {
        f"{name}{suffix}": Channel(values, unit, f"angular {word} of {body}" if body else "")
        for (name, values), word, unit in zip(rates, RATES, ("rad/s", "rad/s^2", "rad/s^3"), strict=True)
    }


def point_channels(name: str, point: PointMotion) -> dict[str, Channel]:
    """Place, velocity, acceleration and jerk of a point by coordinates: ``xP``, ``yP``, ``vxP``, ..."""
    found = {}
    for prefix, word, value, unit in (
        ("", "", point.position, "mm"),
        ("v", "velocity", point.velocity, "mm/s"),
        ("a", "acceleration", point.acceleration, "mm/s^2"),
        ("j", "jerk", point.jerk, "mm/s^3"),
    ):
        found[f"{prefix}x{name}"] = Channel(value.real, unit, along("x", word, f"point {name}"))
        found[f"{prefix}y{name}"] = Channel(value.imag, unit, along("y", word, f"point {name}"))
    return found


def along(axis: str, word: str, what: str) -> str:
    """The label of a part of a place or rate.

    >>> along("x", "", "point P"), along("y", "velocity", "point P")
    ('x of point P', 'velocity of point P along y')
    """
    return f"{word} of {what} along {axis}" if word else f"{axis} of {what}"


def pole_channels(
    pole: Pole, pivot: complex | None = None, suffix: str = "", what: str = "the acceleration pole"
) -> dict[str, Channel]:
    """The acceleration pole on the ground, moved by ``pivot``, mm, and in the coupler.

    There are none where the body has no pole at some time: a coupler that only shifts, as in a parallelogram,
    or that rests while what drives it dwells.
    """
    if not (np.isfinite(pole.fixed).all() and np.isfinite(pole.moving).all()):
        return {}
    fixed = pole.fixed if pivot is None else pole.fixed + pivot
    return {
        f"xG{suffix}": Channel(fixed.real, "mm", along("x", "", what)),
        f"yG{suffix}": Channel(fixed.imag, "mm", along("y", "", what)),
        f"xG_coupler{suffix}": Channel(pole.moving.real, "mm", f"{along('x', '', what)} in the coupler"),
        f"yG_coupler{suffix}": Channel(pole.moving.imag, "mm", f"{along('y', '', what)} in the coupler"),
    }
