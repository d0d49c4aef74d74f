"""The condition of undercut as the source derives it, corrected.

Equations (21) to (30) ask where a point of the wall has no tangent: with N = a/b, M = r/b,

    fα = (1 + θw') cos α - N θw' cos(φ + α)
    fθ = N θw' cos(φ + α) + θw'' (sin α - N sin(φ + α))
    Δ1 =  M sin α fθ + ((1 + θw') M sin α + N θw' sin φ) fα
    Δ2 = -M cos α fθ - ((1 + θw') (1 + M cos α) - N θw' cos φ) fα
    F = Δ1² + Δ2² = (D/b)⁴ (1 ∓ κ r)²

F is a square: it touches 0 without changing its sign, and it is 0 as well at a cusp of the roller's way (D =
0), which is no undercut. The checks therefore ask for the sign of 1 ∓ κ r
(:meth:`mechwright_geneva.kinematics.geometry.Stroke.regularity`); F is here for comparison.
"""

import numpy as np
from numpy.typing import ArrayLike

from mechwright.arrays import Array
from mechwright_geneva.kinematics.geometry import LEFT, Frame, Stroke


def singularity(run: Stroke, radius: ArrayLike, side: int) -> Array:
    """F over a stroke, a pure number, for the left or right wall."""
    n, m = run.frame.axes / run.frame.crank, np.asarray(radius) / run.frame.crank
    turn = alpha(run) + (0.0 if side == LEFT else np.pi)
    p, q, phi = run.first, run.second, run.phi
    f_alpha = (1 + p) * np.cos(turn) - n * p * np.cos(phi + turn)
    f_theta = n * p * np.cos(phi + turn) + q * (np.sin(turn) - n * np.sin(phi + turn))
    one = m * np.sin(turn) * f_theta + ((1 + p) * m * np.sin(turn) + n * p * np.sin(phi)) * f_alpha
    two = -m * np.cos(turn) * f_theta - ((1 + p) * (1 + m * np.cos(turn)) - n * p * np.cos(phi)) * f_alpha
    value: Array = one**2 + two**2
    return value


def critical_at_middle(frame: Frame, p: ArrayLike) -> Array:
    """M_crit at mid stroke of a symmetric law with θw' = p there: ((1+p) - N p)²/|(1+p)² - N p²|."""
    n, p = frame.axes / frame.crank, np.asarray(p, dtype=float)
    value: Array = ((1 + p) - n * p) ** 2 / np.abs((1 + p) ** 2 - n * p**2)
    return value


def alpha(run: Stroke) -> Array:
    """α of equation (3), rad in (-π, π]: from the line crank centre - roller to the left contact."""
    a, b, p = run.frame.axes, run.frame.crank, run.first
    angle: Array = np.arctan2(a * p * np.sin(run.phi), (1 + p) * b - a * p * np.cos(run.phi))
    return angle
