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

CRANK_GUESS = (0.01, 0.1, 0.9, -0.1, 0.9)
"""First guess of a0y, a1, a1n."""

DRIVEN_GUESS = (0.9, 1.5, 1.2, 1.8, 1.3)
"""First guess of c1, c1n, R3."""
