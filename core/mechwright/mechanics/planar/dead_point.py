"""Dead points of links that no closed form finds: where their curve of poses turns back in the input.

Poses x and the input q form a curve F(x, q) = 0 with the tangent (x', q'), the null vector of (∂F/∂x, ∂F/∂q).
At a dead point q' = 0. The curve itself is smooth there. It is followed by its own length s from the drawn
pose on, so that no gap in q is jumped over. q'(s) = 0 is a simple zero at which q is at its extreme: an error
δ of s is one of δ² in q.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.errors import KinematicsError
from mechwright.mechanics.planar.assembly_order import Cluster, Group
from mechwright.mechanics.planar.closing import size_of
from mechwright.mechanics.planar.cluster import ClusterEquations
from mechwright.mechanics.planar.machine import Machine, Revolute
from mechwright.mechanics.planar.positions import solve
from mechwright.mechanics.planar.rigid import BodyMotion, PointMotion, Turning

ROUNDS = 40
EXACT = 1e-14
"""Corrections of a pose over the size of the machine, below which it is exact."""

FIRST_STEP, LONGEST_STEP, SHORTEST_STEP = 0.02, 0.2, 1e-10
"""Steps along the curve over the size of the machine."""

STRAIGHT = 0.98
"""Least cosine between the tangents of two neighbours."""

STEEP, NEARLY_STRAIGHT = 0.2, 0.9995
"""Where q' is below STEEP of its value in the drawn pose, a turn back is near, and steps are shorter."""

Ends = tuple[float | None, float | None]


def cluster_limits(
    machine: Machine,
    order: Sequence[Group],
    bounds: tuple[float, float],
    share: float,
    *,
    turns: bool,
) -> Ends:
    """How far the last group of an order, a cluster, closes to both sides of the drawn pose.

    Parameters
    ----------
    machine, order
        The machine, and its groups up to the cluster.
    bounds
        The least and the greatest input to which it is followed, within which the groups before it close.
    share
        Where above 0, an end is where the smallest singular value over the largest one is this share of its
        greatest value.
    turns
        Whether the upper bound is a whole turn from the drawn pose: where the cluster closes over it, nothing
        below the drawn pose is different.

    Returns
    -------
    low, high
        Both ends; None where it closes up to the bound.

    Raises
    ------
    KinematicsError
        The drawn pose is none, even nearly.
    """
    curve = _Curve.of(machine, order)
    start = curve.drawn()
    courses = [curve.from_drawn(start, 1.0, bounds[1])]
    if share > 0 or not turns or courses[0].end is not None:
        courses.append(curve.from_drawn(start, -1.0, bounds[0]))
    greatest = max(max(one.sines) for one in courses)
    ends = [curve.cut(one, share * greatest) for one in courses]
    return (ends[1] if len(ends) > 1 else None), ends[0]


@dataclass(frozen=True)
class _Course:
    """Points (m + 1,) along a curve, tangents there, singular values; and where it turns back."""

    points: list[Array]
    tangents: list[Array]
    sines: list[float]
    end: float | None


@dataclass(frozen=True)
class _Curve:
    """The curve y = (x, q) (m + 1,) of the last of some groups; angles times ``size`` are lengths."""

    machine: Machine
    before: Sequence[Group]
    cluster: Cluster
    size: float
    scale: Array

    @classmethod
    def of(cls, machine: Machine, order: Sequence[Group]) -> "_Curve":
        cluster, size = order[-1], size_of(machine)
        assert isinstance(cluster, Cluster)  # noqa: S101 - as the caller knows
        turns = isinstance(machine.driven_joint(machine.drives[0]), Revolute)
        scale = np.append(np.tile([1.0, 1.0, size], len(cluster.links)), size if turns else 1.0)
        return cls(machine, order[:-1], cluster, size, scale)

    def drawn(self) -> Array:
        """The exact pose at the drawn input."""
        rough = []
        for link in self.cluster.links:
            pose = self.machine.drawn[link]
            rough += [np.real(pose.origin), np.imag(pose.origin), pose.angle]
        start = np.array([float(np.ravel(one)[0]) for one in (*rough, self.machine.drawn_at[0])]) * self.scale
        found = self._at(start, np.eye(start.size)[-1], 0.0)
        if found is None:
            raise KinematicsError(f"{', '.join(self.cluster.links)} do not close in the drawn pose")
        return found

    def from_drawn(self, start: Array, sense: float, bound: float) -> _Course:
        """The curve from the drawn pose on, followed once for all limits."""
        key, known = ("curve", self.cluster.links, sense, bound), self.machine.followed
        if key not in known:
            known[key] = self.follow(start, sense, bound)
        found: _Course = known[key]
        return found

    def follow(self, start: Array, sense: float, bound: float) -> _Course:
        """The curve from a point on, until the input turns back or passes a bound."""
        y, along = start, self._tangent(start, None)
        along = along * np.sign(along[-1]) * sense
        course = _Course([y], [along], [self._sine(y)], None)
        step, first = FIRST_STEP * self.size, abs(along[-1])
        while step > SHORTEST_STEP * self.size:
            ahead = self._at(y, along, step)
            there = None if ahead is None else self._tangent(ahead, along)
            cosine = -1.0 if there is None else float(there @ along)
            steep = there is None or min(along[-1] * sense, there[-1] * sense) < STEEP * first
            if ahead is None or there is None or cosine < (NEARLY_STRAIGHT if steep else STRAIGHT):
                step /= 2
                continue
            if there[-1] * sense <= 0:
                return _Course(course.points, course.tangents, course.sines, self._turn_back(y, along, step))
            y, along = ahead, there
            course.points.append(y)
            course.tangents.append(along)
            course.sines.append(self._sine(y))
            if (y[-1] / self.scale[-1] - bound) * sense >= 0:
                return course
            step = min(1.5 * step, LONGEST_STEP * self.size)
        return _Course(course.points, course.tangents, course.sines, float(y[-1] / self.scale[-1]))

    def cut(self, course: _Course, least: float) -> float | None:
        """The end of a course, or where its singular values first fall below a limit."""
        below = np.flatnonzero(np.array(course.sines) < least)
        if not below.size:
            if least == 0 or course.end is None:
                return course.end
            below = np.array([len(course.points)])
        if below[0] == 0:
            return float(course.points[0][-1] / self.scale[-1])
        y, along = course.points[below[0] - 1], course.tangents[below[0] - 1]
        low, high = 0.0, LONGEST_STEP * self.size
        if below[0] < len(course.points):
            high = float(along @ (course.points[below[0]] - y))
        best = y
        while high - low > 1e-13 * self.size:
            middle = (low + high) / 2
            found = self._at(y, along, middle)
            back = found is None or self._tangent(found, along)[-1] * along[-1] <= 0
            if found is None or back or self._sine(found) < least:
                high = middle
            else:
                low, best = middle, found
        return float(best[-1] / self.scale[-1])

    def _turn_back(self, start: Array, along: Array, last: float) -> float:
        """The input where q' = 0, between a point and the one at a distance."""
        y, (a, fa) = start, (0.0, along[-1])
        b, fb = last, self._tangent(self._sure(start, along, last), along)[-1]
        for number in range(ROUNDS):
            length = b - fb * (b - a) / (fb - fa) if number % 4 != 3 else (a + b) / 2
            y = self._sure(start, along, length)
            here = self._tangent(y, along)[-1]
            (a, fa), (b, fb) = ((length, here), (b, fb)) if here * fa > 0 else ((a, fa), (length, here))
            if abs(here) < 1e-9 or b - a < 1e-9 * last:
                break
        return float(y[-1] / self.scale[-1])

    def _sure(self, start: Array, along: Array, length: float) -> Array:
        found = self._at(start, along, length)
        return start + length * along if found is None else found

    def _tangent(self, y: Array, along: Array | None) -> Array:
        tangent: Array = np.linalg.svd(self._equations(y)[1])[2][-1]
        return tangent if along is None or tangent @ along > 0 else -tangent

    def _sine(self, y: Array) -> float:
        values = np.linalg.svd(self._equations(y)[1][:, :-1], compute_uv=False)
        return float(values[-1] / values[0])

    def _at(self, start: Array, along: Array, length: float) -> Array | None:
        """The point of the curve at a distance from the start along a direction; None where Newton fails."""
        y, before = start + length * along, np.inf
        for _ in range(ROUNDS):
            value, slopes = self._equations(y)
            rows = np.vstack([slopes, along])
            right = np.append(value, along @ (y - start) - length)
            if not np.isfinite(rows).all() or not np.isfinite(right).all():
                return None
            change = np.linalg.lstsq(rows, right, rcond=None)[0]
            y = y - change
            moved = float(np.abs(change).max())
            if moved <= EXACT * self.size or (moved < 1e-11 * self.size and moved >= before / 2):
                return y
            if moved > before and moved > self.size:
                return None
            before = moved
        return None

    def _equations(self, y: Array) -> tuple[Array, Array]:
        """F (m,) and its derivatives (m, m + 1)."""
        sought = ClusterEquations(self.machine, self.cluster)
        coordinates = y / self.scale
        inputs = [Turning.of(coordinates[-1:], 1.0)]
        bodies = {
            name: _flat(body) for name, body in solve(self.machine, inputs, self.before, 1).bodies.items()
        }
        x = coordinates[None, :-1]
        rows = sought.equations(sought.bodies((x,), bodies), inputs, 1)
        value, by_input = (np.array([float(np.ravel(one[order])[0]) for one in rows]) for order in (0, 1))
        slopes = np.concatenate([sought.jacobian(x, bodies, inputs)[0], by_input[:, None]], axis=1)
        return value, slopes / self.scale


def _flat(body: BodyMotion) -> BodyMotion:
    """A motion at one sample, each number (1,)."""
    origin, turning = body.origin, body.turning
    return BodyMotion(
        PointMotion(
            *(np.ravel(one) for one in (origin.position, origin.velocity, origin.acceleration, origin.jerk))
        ),
        Turning(*(np.ravel(one) for one in (turning.theta, turning.omega, turning.alpha, turning.jerk))),
    )
