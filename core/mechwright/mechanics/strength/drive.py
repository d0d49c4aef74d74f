"""Torque that a mechanism asks of its drive, and the flywheel that evens it out.

With the ratio i = dθ_out/dθ_in and its slope i' = di/dθ_in the output's acceleration is i' ω² + i α, so that
an inertia J and a torque T_out at the output ask T = i (J (i' ω² + i α) + T_out) of the input.
"""

import math

import numpy as np

from mechwright.arrays import Array


def drive_torque(
    ratio: "float | Array",
    slope: "float | Array",
    speed: "float | Array",
    *,
    inertia: float,
    load: "float | Array" = 0.0,
    acceleration: "float | Array" = 0.0,
) -> Array:
    """N m at the input; ``speed`` rad/s and ``acceleration`` rad/s² of the input, inertia kg m², load N m."""
    output = slope * np.square(speed) + ratio * np.asarray(acceleration)
    return np.asarray(ratio * (inertia * output + load))


def rms(torque: Array) -> float:
    """Root mean square of samples at equal steps of time, over one period without its end."""
    return float(np.sqrt(np.mean(np.square(torque))))


def energy_swing(torque: Array, angle: Array) -> float:
    """Greatest less least of the work that a torque (n,), N m, does beyond its mean over the angle, J.

    The angles (n,), rad, rise over one period, both ends included.
    """
    pieces = (torque[1:] + torque[:-1]) / 2 * np.diff(angle)
    work = np.concatenate([[0.0], np.cumsum(pieces)])
    beyond = work - work[-1] * (angle - angle[0]) / (angle[-1] - angle[0])
    return float(beyond.max() - beyond.min())


def inertia_swing(inertia: float, speed: float, greatest: float, least: float) -> float:
    """The same of an inertia at the output alone, between two ratios: J ω² (i_max² - i_min²)/2."""
    return inertia * speed**2 * (greatest**2 - least**2) / 2


def sine_swing(amplitude: float, per_turn: float) -> float:
    """The same of a torque T₁ sin(n θ): 2 T₁/n."""
    return 2 * amplitude / per_turn


def flywheel(swing: float, unevenness: float, speed: float) -> float:
    """Inertia, kg m², that keeps the speed, rad/s, within δ = (ω_max - ω_min)/ω: J = ΔE/(δ ω²)."""
    return swing / (unevenness * speed**2)


def disc_inertia(diameter: float, thickness: float, density: float) -> float:
    """Of a disc, kg m²; sizes mm, density kg/m³.

    >>> round(disc_inertia(120, 12, 7850), 7)
    0.0019177
    """
    return math.pi / 32 * density * thickness / 1000 * (diameter / 1000) ** 4
