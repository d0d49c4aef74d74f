"""A slider-crank: its machine, its motion, and the slider's place in closed form.

The slide frame has the crank's pivot A0 in its origin and the slide along x at the height e; with φ' = φ - θ
the crank pin stands at A = a exp(i φ'), the slider's pin at B = s + i e. With t = e - a sin φ' and
w = ±√(c² - t²), the two assemblies, c exp(i σ') = w + i t and s = a cos φ' + w.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from mechwright import Array, KinematicsError
from mechwright.mechanics.planar import BodyMotion, PointMotion, Turning
from mechwright.mechanics.planar.assembly_order import Group, assembly_order
from mechwright.mechanics.planar.dynamics import GROUND
from mechwright.mechanics.planar.machine import Drive, Machine, Prismatic, Revolute
from mechwright.mechanics.planar.positions import Solution, solve
from mechwright_slider_crank.kinematics.limit_motion import at_limit, rod_at_limit


@dataclass(frozen=True)
class SliderCrank:
    """A slider-crank; over a table of designs sizes and direction are columns (n, 1).

    Parameters
    ----------
    crank, rod
        a and c, above 0, mm.
    offset
        e of the slide line, to the left of its direction, mm.
    direction
        θ, of the slide, rad.
    branch
        +1 if the slider is ahead of the crank pin along the slide, -1 if behind.

    Examples
    --------
    >>> link = SliderCrank(50.0, 150.0, 20.0)
    >>> round(float(link.positions(math.radians(60))), 6)
    173.179117
    """

    crank: float
    rod: float
    offset: float
    direction: float = 0.0
    branch: int = 1

    @property
    def joints(self) -> tuple[Revolute, Revolute, Revolute, Prismatic]:
        """Shaft, crank pin, wrist pin and guide; the slider's frame has its x axis along the slide."""
        line = 1j * self.offset * np.exp(1j * np.asarray(self.direction))
        return (
            Revolute("shaft", GROUND, "crank", 0j, 0j),
            Revolute("crank-pin", "crank", "rod", self.crank + 0j, 0j),
            Revolute("wrist-pin", "rod", "slider", self.rod + 0j, 0j),
            Prismatic("guide", GROUND, "slider", line, 0j, self.direction),
        )

    @cached_property
    def machine(self) -> Machine:
        """Links and joints, driven at the crank."""
        return Machine(self.joints, [Drive("crank")], {"wrist-pin": self.branch})

    @cached_property
    def order(self) -> tuple[Group, ...]:
        """The groups of the machine, in the order in which they are solved."""
        return assembly_order(self.machine)

    @property
    def at_limit(self) -> Any:
        """Whether the crank only just turns, so that the assembly changes."""
        return at_limit(self.crank, self.rod, self.offset)

    def _coupler_x(self, sin: Array) -> Array:
        """The signed w; NaN where the linkage cannot be assembled."""
        t = self.offset - self.crank * sin
        with np.errstate(invalid="ignore"):
            w: Array = self.branch * np.sqrt(self.rod * self.rod - t * t)
        return w

    def positions(self, phi: ArrayLike) -> Array:
        """Slide positions s (...), mm, at crank angles (...), rad; NaN where there is none."""
        angle = np.asarray(phi, dtype=float) - self.direction
        s: Array = self.crank * np.cos(angle) + self._coupler_x(np.sin(angle))
        return s

    def course(self, phi: Array) -> Array:
        """The same of a crank that goes on from the angle 0, at the limit through both assemblies."""
        found = self.positions(phi)
        if not np.any(self.at_limit):
            return found
        angle = phi - self.direction
        w, *_ = rod_at_limit(self.crank, self.offset, self.branch, angle, -self.direction)
        return np.where(self.at_limit, self.crank * np.cos(angle) + w, found)

    def velocities(self, phi: ArrayLike) -> Array:
        """Velocities of the slider (...) per crank radian, mm/rad; NaN where there is none."""
        angle = np.asarray(phi, dtype=float) - self.direction
        x, y = self.crank * np.cos(angle), self.crank * np.sin(angle)
        return np.asarray(-y + (self.offset - y) * x / self._coupler_x(np.sin(angle)))

    def counted(self, sigma: Array) -> Array:
        """Angles of the rod (..., n), rad, as they count: within ±90° of the slide, or of its opposite."""
        middle = self.direction + np.where(np.asarray(self.branch) > 0, 0.0, math.pi)
        return np.asarray(sigma + math.tau * np.round((middle - sigma) / math.tau))

    def bodies(self, phi: ArrayLike, omega: float | Turning = 1.0) -> "Bodies":
        """Motion of crank, coupler and slider at crank angles (..., n), rad.

        ``omega`` is the crank's constant speed, rad/s, or the crank itself at the same samples. A linkage at
        its limit is in its assembly at the crank angle 0, and goes smoothly through its change points.

        Raises
        ------
        KinematicsError
            The linkage cannot be assembled at some angle, or the coupler stands across the slide there.
        """
        phi = np.atleast_1d(np.asarray(phi, dtype=float))
        drive = omega if isinstance(omega, Turning) else Turning.of(phi, omega)
        angle = phi - self.direction
        t, limit = self.offset - self.crank * np.sin(angle), self.at_limit
        wrong = ~(np.abs(t) < self.rod) & ~np.asarray(limit)
        if wrong.any():
            worst = int(np.argmax(wrong * np.abs(t)))
            rods = np.broadcast_to(self.rod, wrong.shape).ravel()
            raise KinematicsError(
                f"the linkage cannot move at a crank angle of "
                f"{math.degrees(np.broadcast_to(phi, wrong.shape).ravel()[worst]):.6g}°: the rod of "
                f"{rods[worst]:g} mm has to be longer than {np.abs(t).ravel()[worst]:.6g} mm"
            )
        found = solve(self.machine, [drive], self.order)
        crank, own = found.bodies["crank"], found.bodies["rod"].turning
        turning = Turning(self.counted(own.theta), own.omega, own.alpha, own.jerk)
        rod = BodyMotion(crank.point(self.crank), turning)
        with np.errstate(invalid="ignore"):  # infinite rates at a change point
            pin = rod.point(self.rod)
        if np.any(limit):
            turning, pin = self._smooth(drive, angle, turning, pin)
            rod = BodyMotion(rod.origin, turning)
        slider = BodyMotion.sliding(pin, self.direction)
        return Bodies(self, Solution({**found.bodies, "rod": rod, "slider": slider}, found.sines))

    def _smooth(
        self, drive: Turning, angle: Array, turning: Turning, pin: PointMotion
    ) -> tuple[Turning, PointMotion]:
        """The rod and its pin, of linkages at their limits through both assemblies.

        The slider's rates per crank radian follow from the rod's ω, α and j: -a sin φ' - t ω,
        -a cos φ' - w ω² - t α and a sin φ' + t ω³ - 3 w ω α - t j.
        """
        w, turn, bend, third = rod_at_limit(self.crank, self.offset, self.branch, angle, -self.direction)
        x, y = self.crank * np.cos(angle), self.crank * np.sin(angle)
        t, along, limit = self.offset - y, np.exp(1j * np.asarray(self.direction)), self.at_limit
        theta = np.unwrap(np.arctan2(t, w)) + self.direction
        slid = (
            -y - t * turn,
            -x - w * turn * turn - t * bend,
            y + t * turn**3 - 3 * w * turn * bend - t * third,
        )
        points = ((x + w + 1j * self.offset) * along, *(rate * along for rate in drive.carried(*slid)))
        turnings = (theta, *drive.carried(turn, bend, third))
        known = (pin.position, pin.velocity, pin.acceleration, pin.jerk)
        swung = (turning.theta, turning.omega, turning.alpha, turning.jerk)
        return Turning(*_either(limit, turnings, swung)), PointMotion(*_either(limit, points, known))


def _either(which: Any, some: Sequence[Any], others: Sequence[Any]) -> Iterator[Any]:
    return (np.where(which, one, two) for one, two in zip(some, others, strict=True))


@dataclass(frozen=True)
class Bodies:
    """The moving bodies at (..., n) samples, and the ground."""

    linkage: SliderCrank
    solution: Solution

    @property
    def crank(self) -> BodyMotion:
        """Origin in A0, x towards A."""
        return self.solution.bodies["crank"]

    @property
    def rod(self) -> BodyMotion:
        """Origin in A, x towards B."""
        return self.solution.bodies["rod"]

    @property
    def slider(self) -> BodyMotion:
        """Origin in B, x along the slide."""
        return self.solution.bodies["slider"]

    @property
    def along(self) -> tuple[Array, Array, Array, Array]:
        """Place of the slider along the slide, mm, and its three rates."""
        pin, back = self.slider.origin, np.exp(-1j * np.asarray(self.linkage.direction))
        return (
            (pin.position * back).real,
            (pin.velocity * back).real,
            (pin.acceleration * back).real,
            (pin.jerk * back).real,
        )

    @property
    def position(self) -> Array:
        """Slide position s, mm."""
        return self.along[0]
