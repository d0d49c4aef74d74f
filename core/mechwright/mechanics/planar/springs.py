"""Linear springs between two bodies: the loads that they put on both, and their energy.

A tension or compression spring of rate k and free length L₀ between P₁ and P₂ pulls P₂ with
-k (L - L₀) (P₂ - P₁)/L, L = |P₂ - P₁|. A torsion spring of rate k and free angle φ₀ turns the second body
with -k (θ₂ - θ₁ - φ₀). The first body takes the opposite.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.planar.free_bodies import Load
from mechwright.mechanics.planar.rigid import BodyMotion


@dataclass(frozen=True)
class Spring:
    """A tension or compression spring.

    Parameters
    ----------
    one, two
        The bodies, one of which may be the ground.
    place_one, place_two
        Its ends in the frames of the bodies, x + i y, mm.
    rate
        Force per length, N/mm.
    free_length
        Length without force, mm.

    Numbers may be columns (n_designs, 1). The ends must not meet, unless the free length is 0.
    """

    one: str
    two: str
    place_one: Any
    place_two: Any
    rate: Any
    free_length: Any = 0.0

    def loads(self, bodies: Mapping[str, BodyMotion]) -> tuple[Load, Load]:
        """Its forces on both bodies, N, or mN for a rate in mN/mm."""
        start, end = self._ends(bodies)
        span = end - start
        length = np.abs(span)
        with np.errstate(invalid="ignore", divide="ignore"):
            unit = np.where(length > 0, span / length, 0.0)
        force = -self.rate * (span - self.free_length * unit)
        return Load(self.one, -force, start), Load(self.two, force, end)

    def energy(self, bodies: Mapping[str, BodyMotion]) -> Array:
        """Elastic energy (..., n), k (L - L₀)²/2."""
        start, end = self._ends(bodies)
        stored: Array = self.rate * (np.abs(end - start) - self.free_length) ** 2 / 2
        return stored

    def _ends(self, bodies: Mapping[str, BodyMotion]) -> tuple[Any, Any]:
        return bodies[self.one].point(self.place_one).position, bodies[self.two].point(
            self.place_two
        ).position


@dataclass(frozen=True)
class TorsionSpring:
    """A torsion spring.

    Parameters
    ----------
    one, two
        The bodies, one of which may be the ground.
    rate
        Moment per angle, N mm/rad.
    free_angle
        Angle of ``two`` over ``one`` without moment, rad; it counts turns as the motion of the bodies does.
    """

    one: str
    two: str
    rate: Any
    free_angle: Any = 0.0

    def loads(self, bodies: Mapping[str, BodyMotion]) -> tuple[Load, Load]:
        """Its moments on both bodies, N mm, or mN mm for a rate in mN mm/rad."""
        moment = -self.rate * self._twist(bodies)
        places = [bodies[name].origin.position for name in (self.one, self.two)]
        return Load(self.one, 0j, places[0], -moment), Load(self.two, 0j, places[1], moment)

    def energy(self, bodies: Mapping[str, BodyMotion]) -> Array:
        """Elastic energy (..., n), k (θ₂ - θ₁ - φ₀)²/2."""
        stored: Array = self.rate * self._twist(bodies) ** 2 / 2
        return stored

    def _twist(self, bodies: Mapping[str, BodyMotion]) -> Any:
        return bodies[self.two].turning.theta - bodies[self.one].turning.theta - self.free_angle


AnySpring = Spring | TorsionSpring


def spring_loads(springs: Iterable[AnySpring], bodies: Mapping[str, BodyMotion]) -> Iterator[Load]:
    """The loads of all springs; ``bodies`` holds the ground where a spring is fixed to it.

    Examples
    --------
    A spring of 2 N/mm and 10 mm is stretched to 13 mm: it pulls its second end back with 6 N.

    >>> from mechwright.mechanics.planar import Turning
    >>> bodies = {"ground": BodyMotion.about(0j, Turning.of([0.0]))}
    >>> spring = Spring("ground", "ground", 0j, 13 + 0j, 2.0, 10.0)
    >>> [load.force.tolist() for load in spring_loads([spring], bodies)]
    [[(6-0j)], [(-6+0j)]]
    """
    for spring in springs:
        yield from spring.loads(bodies)
