"""Dead points of links that no closed form finds: where their curve of poses turns back in the input.

Poses x and the input q form a curve F(x, q) = 0 with the tangent (x', q'), the null vector of (∂F/∂x, ∂F/∂q).
At a dead point q' = 0. The curve itself is smooth there, so it is followed by its own length s, and q'(s) = 0
is a simple zero at which q is at its extreme: an error δ of s is one of δ² in q.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.planar.assembly_order import Cluster, Group
from mechwright.mechanics.planar.closing import size_of
from mechwright.mechanics.planar.cluster import ClusterEquations
from mechwright.mechanics.planar.machine import Machine
from mechwright.mechanics.planar.positions import Solution, solve
from mechwright.mechanics.planar.rigid import BodyMotion, PointMotion, Turning

ROUNDS = 60
REFINEMENTS = 4
"""Times that the surroundings of a minimum of the smallest singular value are looked at 8 times closer."""

Ends = tuple[float | None, float | None]


def cluster_limits(
    machine: Machine, order: Sequence[Group], sides: tuple[Array, Array], share: float, *, turns: bool
) -> tuple[str, Ends]:
    """How far the last group of an order, a cluster, closes to both sides of the drawn pose.

    Parameters
    ----------
    machine, order
        The machine, and its groups up to the cluster.
    sides
        Values of the input (n,) below and above that of the drawn pose, both away from it and with it; more
        are put between them where they are needed.
    share
        Where above 0, an end is where the smallest singular value over the largest one is this share of its
        greatest value.
    turns
        Whether the values above are a whole turn: where the cluster closes over it, those below are the same.

    Returns
    -------
    name, ends
        Of the cluster its inner joint, and both ends; None where it closes up to the last of the values.
    """
    below, above = sides
    name, course = _course(machine, order, above)
    courses = [course]
    if share > 0 or not turns or not np.isfinite(course[1]).all():
        courses.append(_course(machine, order, below)[1])
    greatest = max(float(np.nanmax(one[1])) for one in courses)
    ends = [_end(machine, order, one, share * greatest) for one in courses]
    return name, (ends[1] if len(ends) > 1 else None, ends[0])


Course = tuple[Array, Array, Array]
"""Values of the input (n,) away from the drawn one, singular values (n,) and poses (n, 3 k)."""


def _course(machine: Machine, order: Sequence[Group], q: Array) -> tuple[str, Course]:
    """The name of a cluster, and the cluster over values of the input, finer where it nears a dead point."""
    cluster = order[-1]
    assert isinstance(cluster, Cluster)  # noqa: S101 - as the caller knows
    upwards = q[-1] > q[0]
    q = np.sort(q)
    for number in range(REFINEMENTS + 1):
        solution = solve(machine, [Turning.of(q, 1.0)], order)
        sines = _sines(solution)
        more = _refined(q, sines)
        if number == REFINEMENTS or more.size == q.size:
            break
        q = more
    some = np.arange(q.size) if upwards else np.arange(q.size)[::-1]
    return list(solution.sines)[-1], (q[some], sines[some], _pose(cluster, solution)[some])


def _sines(solution: Solution) -> Array:
    return np.asarray(list(solution.sines.values())[-1], float)


def _refined(q: Array, sines: Array) -> Array:
    """More values beside a minimum that is no more than a third of its surroundings', to see a thin gap."""
    padded = np.pad(sines, 4, mode="edge")
    around = np.nanmax(np.stack([padded[k : k + q.size] for k in range(9)]), axis=0)
    inner = np.arange(1, q.size - 1)
    with np.errstate(invalid="ignore"):
        least = (sines[inner] <= sines[inner - 1]) & (sines[inner] <= sines[inner + 1])
        low = inner[least & (sines[inner] < around[inner] / 3)]
    cells = np.unique(np.concatenate([low - 1, low]))
    return np.union1d(q, np.concatenate([q, *(np.linspace(q[k], q[k + 1], 9) for k in cells)]))


def _pose(cluster: Cluster, solution: Solution) -> Array:
    """Coordinates (n, 3 k) of the links."""
    found = []
    for link in cluster.links:
        body = solution.bodies[link]
        found += [body.origin.position.real, body.origin.position.imag, body.turning.theta]
    return np.stack(found, axis=-1)


def _end(machine: Machine, order: Sequence[Group], course: Course, least: float) -> float | None:
    """The end on one side."""
    q, sines, poses = course
    closed = np.isfinite(sines) & np.isfinite(poses).all(axis=1)
    count = q.size if closed.all() else int(np.argmin(closed))
    below = np.flatnonzero(sines[:count] < least)
    if below.size:
        return _crossing(machine, order, q[: below[0] + 1], least)
    if count == q.size:
        return None
    if count < 2:
        return float(q[0])
    curve = _Curve(machine, order)
    found = curve.turning_point(poses[count - 1], float(q[count - 1]), float(q[count] - q[count - 1]))
    return float(q[count - 1]) if found is None else found


def _crossing(machine: Machine, order: Sequence[Group], q: Array, least: float) -> float:
    """Where the share of the singular values falls to a limit, between the last two of some values."""
    low, high = float(q[-2]) if q.size > 1 else float(q[0]), float(q[-1])
    way = np.sort(q[:-1])
    while abs(high - low) > 4 * np.spacing(abs(low) + 1.0):
        middle = (low + high) / 2
        if middle in {low, high}:
            break
        every = np.union1d(way, [middle])
        sine = _sines(solve(machine, [Turning.of(every, 1.0)], order))[np.searchsorted(every, middle)]
        low, high = (middle, high) if sine >= least else (low, middle)
    return low


@dataclass(frozen=True)
class _Curve:
    """The curve of poses and inputs of a cluster, the last group of an order; y = (x, q), (m + 1,)."""

    machine: Machine
    order: Sequence[Group]

    def equations(self, y: Array) -> tuple[Array, Array]:
        """F (m,) and its derivatives (m, m + 1); angles are counted in lengths of the machine."""
        cluster = self.order[-1]
        assert isinstance(cluster, Cluster)  # noqa: S101 - as the caller knows
        sought = ClusterEquations(self.machine, cluster)
        inputs = [Turning.of(y[-1:], 1.0)]
        bodies = {
            name: _flat(body) for name, body in solve(self.machine, inputs, self.order[:-1]).bodies.items()
        }
        x = (y[:-1] / self._scale(y.size))[None]
        zero = np.zeros_like(x)
        rows = sought.equations(sought.bodies((x, zero, zero, zero), bodies), inputs)
        value, by_input = (np.array([float(np.ravel(one[order])[0]) for one in rows]) for order in (0, 1))
        by_pose = sought.jacobian(x, bodies, inputs)[0] / self._scale(y.size)
        return value, np.concatenate([by_pose, by_input[:, None]], axis=1)

    def _scale(self, size: int) -> Array:
        return np.tile([1.0, 1.0, size_of(self.machine)], size // 3)

    def turning_point(self, pose: Array, q: float, step: float) -> float | None:
        """The input at which the curve turns back, from a pose near it; None where it does not."""
        start = np.append(pose * self._scale(pose.size + 1), q)
        along = self._tangent(start, None)
        along *= np.sign(along[-1]) * np.sign(step)
        y, length, speed = start, 0.0, along[-1]
        far = 2 * abs(step / speed) if speed else 1.0
        last, speed_there = 0.0, speed
        for _ in range(ROUNDS):  # as far as the input comes back
            last, found = last + far, self._at(start, along, last + far)
            if found is None:
                return None
            speed_there = self._tangent(found, along)[-1]
            if speed_there * speed <= 0:
                break
        ends = [(0.0, speed), (last, speed_there)]
        for number in range(ROUNDS):
            (a, fa), (b, fb) = ends
            length = b - fb * (b - a) / (fb - fa) if number % 4 != 3 else (a + b) / 2
            y_new = self._at(start, along, length)
            if y_new is None:
                return None
            moved, y = abs(y_new[-1] - y[-1]), y_new
            here = self._tangent(y, along)[-1]
            ends = [(length, here), ends[1]] if here * speed > 0 else [ends[0], (length, here)]
            if here == 0 or abs(ends[1][0] - ends[0][0]) < 1e-9 * last or (number > 8 and moved == 0):
                break
        return float(y[-1])

    def _tangent(self, y: Array, along: Array | None) -> Array:
        tangent: Array = np.linalg.svd(self.equations(y)[1])[2][-1]
        return tangent if along is None or tangent @ along > 0 else -tangent

    def _at(self, start: Array, along: Array, length: float) -> Array | None:
        """The point of the curve at a distance from the start along a direction; None where Newton fails."""
        y = start + length * along
        size = size_of(self.machine)
        for _ in range(ROUNDS):
            value, slopes = self.equations(y)
            rows = np.vstack([slopes, along])
            right = np.append(value, along @ (y - start) - length)
            if not np.isfinite(rows).all() or not np.isfinite(right).all():
                return None
            change = np.linalg.solve(rows, right)
            y = y - change
            if np.abs(change).max() < 1e-13 * size:
                return y
        return y if np.abs(value).max() < 1e-10 * size else None


def _flat(body: BodyMotion) -> BodyMotion:
    """A motion at one sample, each number (1,)."""
    origin, turning = body.origin, body.turning
    return BodyMotion(
        PointMotion(
            *(np.ravel(one) for one in (origin.position, origin.velocity, origin.acceleration, origin.jerk))
        ),
        Turning(*(np.ravel(one) for one in (turning.theta, turning.omega, turning.alpha, turning.jerk))),
    )
