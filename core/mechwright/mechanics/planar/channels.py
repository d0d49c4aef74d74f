"""Channels of a motion: what turns, and points, from pose to jerk."""

from mechwright.contracts.motion import Channel
from mechwright.mechanics.planar.rigid import PointMotion, Pole, Turning


def turning_channels(turning: Turning, angle: str, suffix: str) -> dict[str, Channel]:
    """The angle by its own name, and its rates as ``omega``, ``alpha`` and ``jerk`` with a suffix."""
    return {
        angle: Channel(turning.theta, "rad"),
        f"omega{suffix}": Channel(turning.omega, "rad/s"),
        f"alpha{suffix}": Channel(turning.alpha, "rad/s^2"),
        f"jerk{suffix}": Channel(turning.jerk, "rad/s^3"),
    }


def point_channels(name: str, point: PointMotion) -> dict[str, Channel]:
    """Place, velocity, acceleration and jerk of a point by coordinates: ``xP``, ``yP``, ``vxP``, ..."""
    found = {}
    for prefix, value, unit in (
        ("", point.position, "mm"),
        ("v", point.velocity, "mm/s"),
        ("a", point.acceleration, "mm/s^2"),
        ("j", point.jerk, "mm/s^3"),
    ):
        found[f"{prefix}x{name}"] = Channel(value.real, unit)
        found[f"{prefix}y{name}"] = Channel(value.imag, unit)
    return found


def pole_channels(pole: Pole, pivot: complex | None = None, suffix: str = "") -> dict[str, Channel]:
    """The acceleration pole on the ground, moved by ``pivot``, mm, and in the coupler."""
    fixed = pole.fixed if pivot is None else pole.fixed + pivot
    return {
        f"xG{suffix}": Channel(fixed.real, "mm"),
        f"yG{suffix}": Channel(fixed.imag, "mm"),
        f"xG_coupler{suffix}": Channel(pole.moving.real, "mm"),
        f"yG_coupler{suffix}": Channel(pole.moving.imag, "mm"),
    }
