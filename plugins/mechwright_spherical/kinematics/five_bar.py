"""The adjustable spherical five-bar: one set of links, two phases.

In the position of the input angle 0 the path point is the same in both phases. There the machine is adjusted:
the coupler stands still, the crank's pin moves along a circle about a0 from a1 to a1n, the rocker's along a
circle about b1 from c1 to c1n. Everything else stays: the axes a0 and b0, the arm's pin b1, and the arcs R1
(crank), R3 (rocker) and R4 (arm), if the pins do lie on those circles.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from mechwright import Array
from mechwright_spherical.kinematics.loop import Loop
from mechwright_spherical.kinematics.projection import project
from mechwright_spherical.kinematics.vectors import arc, azimuth, column, cross, norm, rotate


@dataclass(frozen=True, slots=True)
class AdjustableFiveBar:
    """Pins as unit vectors (3,), or (3, designs, 1) for many designs, in the position of adjustment.

    ``n`` marks the second phase.
    """

    a0: Array
    b0: Array
    b1: Array
    p1: Array
    a1: Array
    c1: Array
    a1n: Array
    c1n: Array
    ratio: float

    def phase(self, number: int) -> Loop:
        """The loop of phase 1 or 2."""
        a, c = (self.a1, self.c1) if number == 1 else (self.a1n, self.c1n)
        return Loop.of_pins(self.a0, a, self.b0, self.b1, c, self.p1, self.ratio)

    @property
    def crank_arcs(self) -> tuple[Array, Array]:
        """R1 in both phases, rad."""
        return arc(self.a0, self.a1), arc(self.a0, self.a1n)

    @property
    def rocker_arcs(self) -> tuple[Array, Array]:
        """R3 in both phases, rad."""
        return arc(self.b1, self.c1), arc(self.b1, self.c1n)

    @property
    def crank_setting(self) -> Array:
        """How far the crank is turned at the adjustment, rad: the sweep of the coupler's slot about a0."""
        return azimuth(self.a0, self.a1, self.a1n)

    @property
    def rocker_setting(self) -> Array:
        """How far the rocker is turned at the adjustment, rad: the sweep of the coupler's slot about b1."""
        return azimuth(self.b1, self.c1, self.c1n)

    def path(self, angles: ArrayLike, angles_n: ArrayLike) -> Array:
        """Path points (3, ..., n1 + n2) of both phases at their input angles (n1,) and (n2,), rad."""
        found = [
            self.phase(number).position(np.asarray(at, dtype=float))
            for number, at in ((1, angles), (2, angles_n))
        ]
        return np.concatenate(found, axis=-1)

    def equalised(self) -> "AdjustableFiveBar":
        """The nearest mechanism with one R1 and one R3: both arcs their means, azimuths as they are."""
        return replace(
            self,
            a1=on_circle(self.a0, self.a1, mean(self.crank_arcs)),
            a1n=on_circle(self.a0, self.a1n, mean(self.crank_arcs)),
            c1=on_circle(self.b1, self.c1, mean(self.rocker_arcs)),
            c1n=on_circle(self.b1, self.c1n, mean(self.rocker_arcs)),
        )


def mean(values: tuple[Array, Array]) -> Array:
    """The mean of both phases."""
    return np.asarray((values[0] + values[1]) / 2)


def on_circle(axis: Array, v: Array, radius: Array) -> Array:
    """Bring a pin to the arc ``radius``, rad, from an axis, on its meridian."""
    normal = cross(axis, v)
    return rotate(normal / norm(normal), radius, column(axis, v))


def projected(
    pins: dict[str, tuple[float, float]] | dict[str, Array],
    path_point: ArrayLike,
    length: ArrayLike,
    ratio: float,
    *,
    centre: ArrayLike = (0.0, 0.0),
) -> AdjustableFiveBar:
    """Project a planar mechanism, pin by pin.

    Parameters
    ----------
    pins
        ``a0``, ``a1``, ``a1n``, ``b0``, ``b1``, ``c1``, ``c1n`` in the plane.
    path_point
        p1 in the plane.
    length
        Projection length, a number, or (designs,) for many.
    ratio
        Of the drive.
    centre
        Of the projection, (2,), or (designs, 2) for many.
    """

    def one(point: ArrayLike) -> Array:
        found = np.moveaxis(project(point, length, centre=centre), -1, 0)
        return found if found.ndim == 1 else found[..., None]

    return AdjustableFiveBar(
        **{name: one(pins[name]) for name in ("a0", "b0", "b1", "a1", "c1", "a1n", "c1n")},
        p1=one(path_point),
        ratio=ratio,
    )
