"""The numbers of the published example: an adjustable five-bar path generator, as printed.

Of the source only every other page survives. What follows from its numbers and is not printed is said to be
so.
"""

import numpy as np

PINS: dict[str, tuple[float, float]] = {
    "a0": (0.0, 0.0004),
    "a1": (0.1219, 0.9930),
    "a1n": (-0.1344, 0.9913),
    "b0": (1.25, 0.0),
    # Not printed: b0 + R4 (cos 45°, sin 45°) with R4 = 1.
    "b1": (1.25 + float(np.sqrt(0.5)), float(np.sqrt(0.5))),
    "c1": (0.8913, 1.4542),
    "c1n": (1.2167, 1.7775),
}
"""Pins of the planar mechanism; a0, b0, R4 and the arm's angle of 45 degrees were chosen, the rest
converged."""

RATIO = 0.5
"""δφ = 0.5 δθ."""

ANGLES = (0.0, -10.0, -20.0, -30.0)
"""Crank displacements of phase 1, degrees: positions 1 to 4."""

ANGLES_N = (0.0, -10.0, -20.0)
"""Crank displacements of phase 2, degrees: positions 5 to 7. Position 5 is position 1."""

LENGTH, RADIUS = 5.0, 1.0
"""Projection length and sphere: not printed, but the only ones that give Tables 3 and 4."""

TABLE_2 = (
    (0.1816, 1.8993),
    (0.2757, 1.8649),
    (0.3574, 1.7945),
    (0.4208, 1.6891),
    (0.1816, 1.8993),
    (0.3565, 1.9073),
    (0.5237, 1.8872),
)
"""Path points of the planar mechanism, positions 1 to 7."""

TABLE_3 = (
    (0.0339, 0.3549, 0.9343),
    (0.0516, 0.3490, 0.9357),
    (0.0671, 0.3370, 0.9391),
    (0.0795, 0.3190, 0.9444),
    (0.0339, 0.3549, 0.9343),
    (0.0665, 0.3556, 0.9322),
    (0.0975, 0.3514, 0.9311),
)
"""Projected path points."""

TABLE_4 = {
    "a0": (0.0, 0.0001, 1.0),
    "a1": (0.0239, 0.1947, 0.9806),
    "a1n": (-0.0264, 0.1944, 0.9806),
    "b0": (0.2425, 0.0, 0.9701),
    "b1": (0.3614, 0.1306, 0.9232),
    "c1": (0.1687, 0.2753, 0.9464),
    "c1n": (0.2235, 0.3265, 0.9184),
}
"""Projected pins."""

CRANK_GUESS = (0.01, 0.1, 0.9, -0.1, 0.9)
"""First guess of a0y, a1, a1n."""

DRIVEN_GUESS = (0.9, 1.5, 1.2, 1.8, 1.3)
"""First guess of c1, c1n, R3."""
