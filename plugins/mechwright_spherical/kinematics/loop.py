"""A spherical linkage with one loop: what four-bars and geared five-bars have in common.

Glossary
--------
crank
    Turns about the fixed axis a0 by the input angle and carries the pin A.
arm
    Turns about the fixed axis b0 by the input angle times the ratio and carries the pin B; with the ratio 0
    it is a part of the frame, and the five-bar is a four-bar.
coupler
    Carries the pins A and C and the path point P.
rocker
    Carries the pins B and C; the output link of a four-bar.
transmission angle
    The angle at C between coupler and rocker: at 0 and 180 degrees the crank can no longer push the rocker.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from mechwright import Array
from mechwright.mechanics.planar import Turning
from mechwright_spherical.kinematics.chain import body_point, coordinates, frame, radicand, spin, third_pin
from mechwright_spherical.kinematics.jets import Jet, circle
from mechwright_spherical.kinematics.vectors import arc, cross, dot

BLOCK = 8192
"""Samples that are worked on at a time: their arrays stay in a processor's cache, which halves the time."""


@dataclass(frozen=True, slots=True)
class Loop:
    """A loop in the position of the input angle 0.

    Parameters
    ----------
    a0, b0
        Fixed axes, (3,), or (3, designs, 1) for many designs at once.
    a1, b1
        Pins of crank and arm at the input angle 0, shaped alike.
    ratio
        Turns of the arm per turn of the crank; 0 for a four-bar.
    ca, cb
        Cosines of the arcs of coupler (A to C) and rocker (B to C).
    side
        +1 or -1: on which side of the arc from A to B the pin C lies, see ``chain.third_pin``.
    point
        The path point in the coupler: its factors of A, C and A x C.
    """

    a0: Array
    a1: Array
    b0: Array
    b1: Array
    ratio: float
    ca: Array
    cb: Array
    side: Array
    point: tuple[Array, Array, Array]

    @classmethod
    def of_pins(
        cls, a0: Array, a1: Array, b0: Array, b1: Array, c1: Array, p1: Array, ratio: float
    ) -> "Loop":
        """The loop that is assembled at the input angle 0 with these pins and this path point."""
        side = np.where(dot(c1, cross(a1, b1)) >= 0, 1.0, -1.0)
        return cls(a0, a1, b0, b1, ratio, dot(a1, c1), dot(b1, c1), side, coordinates(a1, c1, p1))

    def at(self, turning: Turning, order: int = 3) -> "State":
        """The linkage at input angles, with ``order`` rates; NaN where it cannot be assembled."""
        if turning.theta.ndim == 1 and turning.theta.size > BLOCK:
            blocks = [
                self._at(turning.part(slice(start, start + BLOCK)), order)
                for start in range(0, turning.theta.size, BLOCK)
            ]
            return State(*(_joined([getattr(block, name) for block in blocks]) for name in "abcp"))
        return self._at(turning, order)

    def _at(self, turning: Turning, order: int) -> "State":
        a = circle(self.a0, self.a1, turning, order)
        b = circle(self.b0, self.b1, turning.scaled(self.ratio), order)
        b = tuple(np.broadcast_to(x, a[0].shape) for x in b)
        c = third_pin(a, b, self.ca, self.cb, self.side)
        return State(a, b, c, body_point(a, c, self.point))

    def position(self, angle: Array) -> Array:
        """Path points (3, ...) at input angles (...), rad; NaN where the linkage cannot be assembled."""
        return self.at(Turning.of(angle), 0).p[0]

    def room(self, angle: ArrayLike) -> Array:
        """How far the linkage is from coming apart at input angles: ``chain.radicand``."""
        turning = Turning.of(angle)
        (a,), (b,) = (
            circle(self.a0, self.a1, turning, 0),
            circle(self.b0, self.b1, turning.scaled(self.ratio), 0),
        )
        return radicand(a, b, self.ca, self.cb)


@dataclass(frozen=True, slots=True)
class State:
    """Pins and path point of a loop, as jets of vectors (3, ...)."""

    a: Jet
    b: Jet
    c: Jet
    p: Jet

    @property
    def coupler(self) -> tuple[Jet, Jet, Jet]:
        """The coupler's frame: A, and two vectors at right angles to it."""
        return frame(self.a, self.c)

    @property
    def coupler_spin(self) -> Jet:
        """Angular velocity, acceleration and jerk of the coupler."""
        return spin(self.coupler)

    @property
    def transmission(self) -> Array:
        """Transmission angle, rad, 0 to π: between the arcs C to A and C to B."""
        c = self.c[0]
        return arc(cross(c, self.a[0]), cross(c, self.b[0]))


def _joined(jets: list[Jet]) -> Jet:
    return tuple(np.concatenate(values, axis=1) for values in zip(*jets, strict=True))
