"""Spherical four-bars whose path point runs near prescribed directions: what the search knows of them.

Unknowns are the arcs α1 to α4, azimuth κ and elevation η of the path point, and a quaternion of any length
that lays the linkage on the points; of timed points the first input angle besides. The transmission angle μ
follows the diagonal from the input's pin to the output's axis:
cos μ = (cos D - cos α3 cos α4)/(sin α3 sin α4), with cos D = cos α1 cos α2 + sin α1 sin α2 cos θ,
least where the passage begins or ends or θ is a whole half turn.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial.transform import Rotation

from mechwright import Array
from mechwright.mechanics.tracing.order import one_way
from mechwright.mechanics.tracing.points import random_angles
from mechwright.mechanics.tracing.search import MARGIN
from mechwright_spherical.kinematics.four_bar import FourBar
from mechwright_spherical.kinematics.mobility import mobility
from mechwright_spherical.synthesis.path_kernels import four_bars_missed

USUAL = math.radians(110.0)
"""Longest arcs of the starts: an arc and its supplement are the same link."""

EXTREMES = 5
"""Input angles at which the transmission angle can be least: both ends, and whole half turns between them."""


@dataclass(frozen=True)
class Bounds:
    """Least and greatest arc, and least transmission angle over the passage of the points, rad."""

    least: float
    greatest: float
    least_angle: float


@dataclass(frozen=True)
class Shapes:
    """Linkages (...) by their unknowns (..., 10), or (..., 11) with the first input angle."""

    rows: Array

    @property
    def first(self) -> Array:
        """(...) input angle at the first point, of timed points."""
        return self.rows[..., -1]


@dataclass(frozen=True)
class FourBarRoom:
    """Four-bars of one side and one sense of the input; see ``mechwright.mechanics.tracing``.

    Parameters
    ----------
    targets
        (n, 3) unit vectors.
    turns
        (n,) input angles from that at the first point, rad; None where they are free.
    side
        +1 or -1: the sign of c.(a x b).
    sense
        +1 or -1; that of ``turns`` where these are given.
    closed
        Whether the first point follows on the last.
    size
        Of the path: distance of the farthest point from the middle.
    bounds
        Of arcs and transmission angle.
    """

    targets: Array
    turns: Array | None
    side: int
    sense: int
    closed: bool
    size: float
    bounds: Bounds

    def made(self, x: Array) -> Shapes:
        """See ``Traced``."""
        return Shapes(x)

    def missed(self, made: Shapes, theta: Array) -> Array:
        """See ``Traced``."""
        lead, rows, angles = flat(made.rows, self._angles(made, theta))
        found = four_bars_missed(rows, angles, float(self.side), self.targets, self.size)
        return found.reshape(*lead, *self.targets.shape)

    def _angles(self, made: Shapes, theta: Array) -> Array:
        return theta if self.turns is None else made.first[..., None] + self.turns + 0 * theta

    def exceeded(self, made: Shapes, theta: Array) -> Array:
        """Arcs beyond their bounds, rad, and cosines of the transmission angle; 0 or less is kept."""
        arcs = made.rows[..., :4]
        a1, a2, a3, a4 = (arcs[..., k, None] for k in range(4))
        ends = self.extremes(self._angles(made, theta))
        diagonal = np.cos(a1) * np.cos(a2) + np.sin(a1) * np.sin(a2) * np.cos(ends)
        cosine = (diagonal - np.cos(a3) * np.cos(a4)) / (np.sin(a3) * np.sin(a4))
        pinched = np.abs(cosine) - math.cos(self.bounds.least_angle)
        low = np.broadcast_to(self.bounds.least - arcs, (*pinched.shape[:-1], 4))
        high = np.broadcast_to(arcs - self.bounds.greatest, low.shape)
        return np.concatenate([low, high, pinched], axis=-1) + MARGIN

    def dimensions(self, made: Shapes) -> Array:
        """Arcs, azimuth and elevation of the path point, (..., 6) degrees."""
        return np.degrees(made.rows[..., self.columns])

    @property
    def columns(self) -> tuple[int, ...]:
        """Unknowns that are dimensions: four arcs, then two angles."""
        return (0, 1, 2, 3, 4, 5)

    def extremes(self, angles: Array) -> Array:
        """Input angles (..., 5) at one of which the transmission angle is least, for angles (..., n).

        It follows the diagonal from c to a, which goes one way between whole half turns of the input.
        """
        first = angles[..., :1]
        last = first + self.sense * math.tau if self.closed else angles[..., -1:]
        low, high = np.minimum(first, last), np.maximum(first, last)
        halves = (np.ceil(low / np.pi) + np.arange(EXTREMES - 2)) * np.pi
        return np.concatenate([low, high, np.clip(halves, low, high)], axis=-1)

    def ordered(self, theta: Array, sense: Array) -> Array:
        """See ``Traced``; angles that are given are in order."""
        return theta.copy() if self.turns is not None else one_way(theta, sense)

    def starts(self, count: int, rng: np.random.Generator) -> tuple[Array, Array, Array]:
        """See ``Room``: random linkages whose input turns fully, each turned onto the points (Kabsch)."""
        arcs = rng.uniform(self.bounds.least, min(self.bounds.greatest, USUAL), (4, 4 * count))
        arcs = arcs[:, mobility(*arcs).input_full][:, :count]
        m = arcs.shape[1]
        point = np.stack([rng.uniform(-1.5, 2.5, m), rng.uniform(-1.0, 1.0, m)])
        theta = random_angles(m, self.targets, self.turns, self.sense, self.closed, rng)
        shapes = np.concatenate([arcs, point]).T
        still = np.tile([1.0, 0.0, 0.0, 0.0], (m, 1))
        x = np.concatenate([shapes, still, theta[:, :1]], axis=1)
        own = replace(self, targets=0 * self.targets, size=1.0).missed(self.made(x), theta)
        good = np.isfinite(own).all(axis=(1, 2))
        x, theta, own = x[good], theta[good], own[good]
        if not len(x):
            return x, theta, np.empty(0)
        frames, error = kabsch(own, self.targets)
        x[:, 6:10] = Rotation.from_matrix(frames).as_quat(scalar_first=True)
        if self.turns is None:
            x = x[:, :10]
        over = np.maximum(self.exceeded(self.made(x), theta), 0.0)
        cost = error * len(self.targets) / self.size**2 + (over**2).sum(axis=-1)
        return x, theta, np.asarray(cost)

    def linkage(self, x: Array) -> FourBar:
        """The four-bar of unknowns (k,)."""
        a1, a2, a3, a4, kappa, eta = x[:6].tolist()
        return FourBar(a1, a2, a3, a4, float(self.side), kappa, eta)

    def frame(self, x: Array) -> Array:
        """Its orientation (3, 3): columns are its axes in space."""
        found: Array = Rotation.from_quat(x[6:10], scalar_first=True).as_matrix()
        return found


def flat(rows: Array, angles: Array) -> tuple[tuple[int, ...], Array, Array]:
    """Shape (...) of linkages (..., k) at angles (..., n) together, and both as (m, k) and (m, n)."""
    lead = np.broadcast_shapes(rows.shape[:-1], angles.shape[:-1])
    one, two = (np.broadcast_to(each, (*lead, each.shape[-1])) for each in (rows, angles))
    return (
        lead,
        np.ascontiguousarray(one).reshape(-1, rows.shape[-1]),
        np.ascontiguousarray(two).reshape(-1, angles.shape[-1]),
    )


def kabsch(points: Array, targets: Array) -> tuple[Array, Array]:
    """Rotations (m, 3, 3) that bring points (m, n, 3) nearest to targets (n, 3); mean square errors (m,)."""
    u, s, vt = np.linalg.svd(np.einsum("mni,nj->mij", points, targets))
    sign = np.sign(np.linalg.det(u) * np.linalg.det(vt))
    fix = np.ones_like(s)
    fix[:, 2] = sign
    frames = np.einsum("mji,mj,mkj->mik", vt, fix, u)
    return frames, 2 - 2 * (s * fix).sum(axis=1) / len(targets)
