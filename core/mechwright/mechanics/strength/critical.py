"""Critical speeds of shafts in bending, rev/min.

Sources: one mass by the stiffness of a beam on two supports; the bare shaft by Euler and Bernoulli;
Dunkerley's sum, which lies below the true value.
"""

import math
from collections.abc import Iterable

from mechwright.mechanics.strength.beam import STEEL
from mechwright.mechanics.strength.shaft import second_moment

SHARE = 0.7
"""Greatest speed in critical speeds; handbook."""

STEEL_DENSITY = 7.85e-6
"""Of steel, kg/mm³."""


def of_mass(d: float, span: float, at: float, mass: float, modulus: float = STEEL) -> float:
    """A mass, kg, on a shaft without any: ω² = 3 E I L/(m a² b²)."""
    stiff = 3 * modulus * second_moment(d) * span / (at * (span - at)) ** 2
    return _per_minute(math.sqrt(1000 * stiff / mass))


def of_shaft(d: float, span: float, density: float = STEEL_DENSITY, modulus: float = STEEL) -> float:
    """The shaft alone: ω = (π/L)² √(E I/(ρ A)); density in kg/mm³."""
    area = math.pi / 4 * d * d
    return _per_minute(
        (math.pi / span) ** 2 * math.sqrt(1000 * modulus * second_moment(d) / (density * area))
    )


def dunkerley(speeds: Iterable[float]) -> float:
    """All together: 1/n² is the sum of those of each.

    >>> round(dunkerley([50980.0, 228501.0]))
    49757
    """
    return 1 / math.sqrt(sum(1 / speed**2 for speed in speeds))


def _per_minute(omega: float) -> float:
    return omega * 60 / math.tau
