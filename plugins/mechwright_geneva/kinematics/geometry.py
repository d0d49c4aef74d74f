"""Geometry, motion and contact points of the mechanism, for one design or many.

Glossary
--------
half angles
    θd0 of the crank and θw0 = π/n of the wheel: a stroke turns them by 2 θd0 and 2 θw0.
offset angle θoff
    Half the angle between the two mouths of a slot, seen from the wheel; its sign tells which side of the
    roller's way the island is on.
entry radius l
    Distance of the roller's centre from the wheel's axis when the stroke begins and ends.
a, b
    Distance of the axes, and radius of the crank.
φ
    θd0 - θd, 0 at mid stroke.
left, right
    The walls as the roller sees them on its way. Left is the branch α of equation (3), right is α + π.

The wheel turns counter-clockwise about 0, the crank clockwise about a on the real axis; points of the plane
are complex numbers, mm. The wheel's frame is the fixed frame at θw = 0, when the roller enters slot 0, whose
axis of symmetry then lies at -θw0. With W = θw0 + θoff:

    b = l sin W / sin θd0,  a = l cos W + b cos θd0
    C = a - b exp(iφ)                      the roller's centre, fixed frame
    (2) wheel frame: (C ± r n) exp(-i θw)
    (3) n = i V/|V|, V = dC/dθd - i θw' C: atan2 in complex numbers, whole plane, no branches to mix up
    κ = Im(conj(V) A)/|V|³, A = C'' - 2i θw' C' - i θw'' C - θw'² C
    A wall moves with |V| (1 - κ r) on the left and |V| (1 + κ r) on the right.
    Normal, walls and κ are those of mechwright.mechanics.envelope.

Every array has the design axis first and the sample axis last.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mechwright import Array
from mechwright.contracts.design_table import Rowwise, number
from mechwright.mechanics.envelope import LEFT, RIGHT, Points, left_normal, regularity, touched, way_curvature
from mechwright.mechanics.laws import Law

__all__ = ["LEFT", "RIGHT", "Frame", "Points", "Stroke", "corner_angle", "regime", "stroke"]


@dataclass(frozen=True)
class Frame(Rowwise):
    """The fixed geometry of one design, or of many as columns (m, 1); angles in rad, lengths in mm."""

    wheel_half: Array
    crank_half: Array
    offset: Array
    entry_radius: Array

    @classmethod
    def of(
        cls, wheel_half: ArrayLike, crank_half: ArrayLike, offset: ArrayLike, entry_radius: ArrayLike
    ) -> "Frame":
        """Scalars stay scalars, arrays (m,) become columns (m, 1)."""
        values = (np.asarray(v, dtype=float) for v in (wheel_half, crank_half, offset, entry_radius))
        return cls(*(v[:, None] if v.ndim == 1 else v for v in values))

    def columns(self, size: int) -> "Frame":
        """The same with columns (size, 1) of all but θw0."""
        values = (
            np.broadcast_to(one, (size, 1)) for one in (self.crank_half, self.offset, self.entry_radius)
        )
        return Frame(self.wheel_half, *values)

    @cached_property
    def entry_angle(self) -> Array:
        """W = θw0 + θoff."""
        return self.wheel_half + self.offset

    @cached_property
    def crank(self) -> Array:
        """Crank radius b."""
        value: Array = self.entry_radius * np.sin(self.entry_angle) / np.sin(self.crank_half)
        return value

    @cached_property
    def axes(self) -> Array:
        """Distance of the axes a."""
        value: Array = self.entry_radius * np.cos(self.entry_angle) + self.crank * np.cos(self.crank_half)
        return value

    @cached_property
    def bottom(self) -> Array:
        """Distance a - b of the slot's bottom from the wheel's axis, in the form that does not cancel."""
        half = self.crank_half / 2
        value: Array = self.entry_radius * np.cos(self.entry_angle + half) / np.cos(half)
        return value

    @property
    def turning_ratio(self) -> Array:
        """b/(a - b): the θw' at mid stroke at which the roller's way has a cusp there."""
        value: Array = self.crank / self.bottom
        return value


@dataclass(frozen=True)
class Stroke:
    """One stroke at the shares u of its crank angle.

    Parameters
    ----------
    frame
        The fixed geometry.
    phi
        φ.
    theta, first, second, third
        θw and its derivatives over θd.
    """

    frame: Frame
    phi: Array
    theta: Array
    first: Array
    second: Array
    third: Array

    @cached_property
    def _arm(self) -> Points:
        arm: Points = self.frame.crank * np.exp(1j * self.phi)
        return arm

    @cached_property
    def centre(self) -> Points:
        """C in the fixed frame."""
        centre: Points = self.frame.axes - self._arm
        return centre

    @cached_property
    def velocity(self) -> Points:
        """V, fixed axes: how the centre moves over the wheel per radian of the crank; dC/dθd is i arm."""
        velocity: Points = 1j * (self._arm - self.first * self.centre)
        return velocity

    @cached_property
    def acceleration(self) -> Points:
        """A, fixed axes; d²C/dθd² is the arm."""
        turned = (self.first * self.first + 1j * self.second) * self.centre
        acceleration: Points = (1 + 2 * self.first) * self._arm - turned
        return acceleration

    @cached_property
    def speed(self) -> Array:
        """|V|, mm per radian of the crank."""
        speed: Array = np.sqrt(self.velocity.real**2 + self.velocity.imag**2)
        return speed

    @cached_property
    def to_wheel(self) -> Points:
        """exp(-i θw): turns fixed points into the wheel's frame."""
        turned: Points = np.exp(-1j * self.theta)
        return turned

    @property
    def track(self) -> Points:
        """The roller's centre in the wheel's frame."""
        points: Points = self.centre * self.to_wheel
        return points

    @cached_property
    def normal(self) -> Points:
        """The unit normal to the left of the roller's way, fixed axes; 0 where the roller turns back."""
        return left_normal(self.velocity, self.speed)

    def wall(self, radius: ArrayLike, side: int) -> Points:
        """The left or right wall of a slot for a roller of this radius, wheel frame."""
        points: Points = touched(self.centre, self.normal, radius, side) * self.to_wheel
        return points

    def lever(self, normal: Points) -> Array:
        """Lever of a normal about the wheel's axis, mm; above 0 where a push along it turns the wheel on."""
        value: Array = (np.conj(self.centre) * normal).imag
        return value

    @cached_property
    def curvature(self) -> Array:
        """κ of the roller's way, 1/mm, positive where it bends to the left."""
        return way_curvature(self.velocity, self.acceleration, self.speed)

    def regularity(self, radius: ArrayLike, side: int) -> Array:
        """1 - κ r on the left, 1 + κ r on the right: the wall turns back where this is below 0."""
        return regularity(self.curvature, radius, side)


def corner_angle(one: Any, two: Any, opposite: Any) -> Any:
    """Angle (...), rad, between two sides of a triangle, by its third side; NaN where they do not meet."""
    with np.errstate(invalid="ignore"):
        return number(np.arccos((one**2 + two**2 - opposite**2) / (2 * one * two)))


def stroke(frame: Frame, law: Law, u: ArrayLike) -> Stroke:
    """The stroke at u (k,) in [0, 1]."""
    u = np.asarray(u, dtype=float)
    rates = law.at(u)
    time = 2 * frame.crank_half
    way = 2 * frame.wheel_half
    phi = frame.crank_half - time * u
    first, second, third = way / time * rates.v, way / time**2 * rates.a, way / time**3 * rates.j
    return Stroke(frame, phi, way * rates.s, first, second, third)


def regime(frame: Frame, law: Law) -> NDArray[np.int_]:
    """-1 (A): the island is on the right and wants θoff > 0; +1 (B): on the left, θoff < 0.

    Decided by p = θw' at mid stroke against b/(a - b). 0 is the cusp between them.
    """
    p = frame.wheel_half / frame.crank_half * law.at(0.5).v
    # (a - b) p - b keeps its sign where the slot's bottom passes the axis.
    side: NDArray[np.int_] = np.sign(frame.bottom * p - frame.crank).astype(int)
    return side
