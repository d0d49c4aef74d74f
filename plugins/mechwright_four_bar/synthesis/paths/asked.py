"""What a path synthesis is to keep: limits in millimetres and degrees, and what contradicts in them."""

import math
from dataclasses import dataclass

import numpy as np

from mechwright import Array
from mechwright.mechanics.planar import Plane
from mechwright.mechanics.tracing.search import MARGIN
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.synthesis.paths.limits import SIZE

Rectangle = tuple[float, float, float, float]
"""Least x, least y, greatest x, greatest y, mm."""


@dataclass(frozen=True)
class Limits:
    """What a linkage has to keep.

    Parameters
    ----------
    shortest, longest
        Least and greatest length of crank, coupler, follower and ground, mm; the coupler point is no farther
        from A and from B than ``longest``.
    least_angle
        Least transmission angle, rad, above 0.
    frame
        Where A0 and B0 may be.
    """

    shortest: float
    longest: float
    least_angle: float
    frame: Rectangle | None = None

    @property
    def ratio(self) -> float:
        """Longest over shortest link that is allowed."""
        return self.longest / self.shortest

    @property
    def least_ratio(self) -> float:
        """Longest over shortest link that a full turn with such a transmission angle needs.

        tan(45° + μ/2), reached by a coupler, a follower and a ground of one length.
        """
        return math.tan(math.pi / 4 + self.least_angle / 2)

    def contradiction(self) -> str:
        """The pair of limits that no linkage keeps, and why; empty where they go together."""
        if self.longest < self.shortest:
            return f"shortest_link of {self.shortest:g} mm is above longest_link of {self.longest:g} mm"
        if self.ratio < self.least_ratio * (1 + MARGIN):
            return (
                f"shortest_link of {self.shortest:g} mm and longest_link of {self.longest:g} mm contradict "
                f"least_transmission_angle of {math.degrees(self.least_angle):g} degrees: where a crank "
                f"turns fully "
                f"with it, the longest link is at least {self.least_ratio:.4f} times the shortest, here "
                f"{self.shortest * self.least_ratio:.4g} mm"
            )
        if self.frame is not None:
            wide = math.hypot(self.frame[2] - self.frame[0], self.frame[3] - self.frame[1])
            if wide < self.shortest:
                return (
                    f"frame and shortest_link contradict: two pivots in the frame are at most {wide:.4g} "
                    f"mm apart, and "
                    f"the ground is a link of at least {self.shortest:g} mm"
                )
        return ""

    def array(self, centre: complex, size: float, fixed: tuple[float, ...] = ()) -> Array:
        """As the kernels want it, over ``centre`` and ``size``.

        ``fixed`` holds crank, follower, coupler and ground if these are decided, mm, and then the coupler
        point's coordinates if these are, too.
        """
        limits = np.full(SIZE, np.inf)
        limits[:4] = math.log(self.shortest / size) + MARGIN
        limits[4:8] = math.log(self.longest / size) - MARGIN
        if fixed:
            limits[:4] = limits[4:8] = np.log(np.array(fixed[:4]) / size)
        limits[8] = self.longest / size * (1 - MARGIN)
        limits[9] = math.cos(self.least_angle) - MARGIN
        if self.frame is not None:
            x0, y0, x1, y1 = self.frame
            low, high = (complex(x0, y0) - centre) / size, (complex(x1, y1) - centre) / size
            limits[10:14] = low.real + MARGIN, low.imag + MARGIN, high.real - MARGIN, high.imag - MARGIN
        if len(fixed) > 4:
            limits[14:16] = limits[16:18] = np.array(fixed[4:]) / size
        return limits

    def broken(self, bar: FourBar, pivot: complex, point: complex) -> tuple[str, str]:
        """The key of the first limit that a linkage breaks, and by what; empty where it keeps all."""
        if min(bar.lengths) < self.shortest:
            return "shortest_link", f"a link is {min(bar.lengths):.6g} mm long"
        longest = max(*bar.lengths, abs(point), abs(point - bar.coupler))
        if longest > self.longest:
            return "longest_link", f"a link is {longest:.6g} mm long"
        angle = bar.least_transmission_angle() if bar.kind.full_turn else 0.0
        if angle < self.least_angle:
            return (
                "least_transmission_angle",
                f"the transmission angle falls to {math.degrees(angle):.4g} degrees",
            )
        if self.frame is not None:
            x0, y0, x1, y1 = self.frame
            for z in (
                pivot,
                pivot + bar.ground * complex(math.cos(bar.ground_angle), math.sin(bar.ground_angle)),
            ):
                if not (x0 <= z.real <= x1 and y0 <= z.imag <= y1):
                    return "frame", f"a fixed pivot stands at ({z.real:.5g}, {z.imag:.5g})"
        return "", ""


@dataclass(frozen=True)
class PathProblem:
    """A path to be drawn.

    Parameters
    ----------
    targets
        (n,) points, mm, in their order.
    turns
        (n,) crank angles from that at the first point, rad; None where they are free.
    senses
        Of a free crank: +1, -1 or both.
    closed
        Whether the first point follows on the last.
    slack
        Crank angle, rad, by which a point may lie before the one before it.
    limits
        What the linkage keeps.
    """

    targets: Plane
    turns: Array | None
    senses: tuple[int, ...]
    closed: bool
    slack: float
    limits: Limits

    @property
    def centre(self) -> complex:
        """Middle of the points, mm."""
        return complex(self.targets.mean())

    @property
    def size(self) -> float:
        """Distance of the farthest point from the middle, mm."""
        return float(np.abs(self.targets - self.centre).max())

    @property
    def unit(self) -> Plane:
        """The points about their middle, over their size."""
        points: Plane = (self.targets - self.centre) / self.size
        return points
