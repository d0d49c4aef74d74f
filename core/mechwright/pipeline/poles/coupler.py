"""What a family says of the link whose poles are drawn, and what follows from it."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.planar import BodyMotion, Course, Plane, Turning, acceleration_pole
from mechwright.mechanics.planar.poles import Circles, circles

STEP = 0.5
"""Degrees of the crank between points of a locus: smooth where a locus turns sharply."""


@dataclass(frozen=True)
class Coupler:
    """The coupler of a linkage, or any link as seen from another one.

    Parameters
    ----------
    course
        The crank's way over a period; ``acceleration_ratio`` is the design's.
    moved
        The coupler, origin in A and x to B, with the crank as given (n,): as designed, then in its other
        assembly if it keeps to one. Places are from A0.
    drawn
        The linkage at a crank angle, rad: places of its joints from A0, mm, and lines of its links.
    length
        Of the coupler from A to B, mm.
    link, seen_from
        Names of the link, and of the one in whose frame its motion and the drawing are.
    places
        Where places are counted from, in words.
    outline
        The link in its own frame: its joints, and lines; None for A in the origin and B to the right.
    """

    course: Course
    moved: Callable[[Turning], Sequence[BodyMotion]]
    drawn: Callable[[float], tuple[dict[str, complex], Sequence[Sequence[complex]]]]
    length: float
    link: str = "coupler"
    seen_from: str = "ground"
    places: str = "from A0"
    outline: tuple[dict[str, complex], Sequence[Sequence[complex]]] | None = None

    def way(self) -> Array:
        """Crank angles (n,), rad, of a locus."""
        return self.course.way(1 + round(abs(np.degrees(self.course.travel)) / STEP))

    @property
    def assemblies(self) -> int:
        """How many assemblies the linkage keeps apart, 1 or 2."""
        return len(self.moved(self.crank(self.course.start)))

    def body(self, phi: Array | float, ratio: Array | float, assembly: int = 0) -> BodyMotion:
        """The coupler with the crank so."""
        return self.moved(self.crank(phi, ratio))[assembly]

    def crank(self, phi: Array | float, ratio: Array | float = 0.0) -> Turning:
        """The crank at angles (n,), its speed 1 rad/s and its acceleration the ratio (n,)."""
        return Turning.of(np.atleast_1d(phi), 1.0, ratio)

    def locus(self, ratio: float, assembly: int = 0) -> tuple[Plane, Plane]:
        """Poles (n,) over the way for a constant ratio, from A0 on the ground and in the coupler."""
        found = acceleration_pole(self.body(self.way(), ratio, assembly))
        return found.fixed, found.moving

    def pole(self, phi: float, ratio: float) -> complex:
        """The pole at a crank angle."""
        return complex(acceleration_pole(self.body(phi, ratio)).fixed[0])

    def circles(self, phi: float, ratio: float) -> Circles:
        """The circles at a crank angle, arrays (1,)."""
        return circles(self.body(phi, ratio))

    def poles_of_all_ratios(self, phi: float) -> Plane:
        """Poles (n,) at a crank angle in the order of their ratios: the inflection circle, or a line."""
        body = self.body(phi, 0.0)
        omega, alpha = float(body.turning.omega[0]), float(body.turning.alpha[0])
        steps = np.tan(np.linspace(-0.5, 0.5, 721)[1:-1] * np.pi)
        # Even steps round the circle, and where it is a line, or nearly, along that.
        ratios = np.unique(np.concatenate((omega * steps - (alpha / omega if omega else 0.0), steps)))
        return acceleration_pole(self.body(phi, ratios)).fixed
