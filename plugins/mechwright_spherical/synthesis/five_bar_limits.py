"""Spherical five-bars whose path point runs near prescribed directions: what the search knows of them.

Unknowns are the arcs of ground, crank, coupler, rocker and arm, the angle φ₀ of the arm where the crank
points at the arm's axis, azimuth κ and elevation η of the path point, and a quaternion of any length that
lays the linkage on the points; of timed points the first crank angle besides. The arm turns by the given
ratio r: φ = φ₀ + r θ. The transmission angle μ at C follows the diagonal D from crank pin A to arm pin B,

    cos μ = (cos D - cos α₂ cos α₃)/(sin α₂ sin α₃),   cos D = A.B,

so it is least where the diagonal is longest or shortest over the passage. These places have no closed form:
the passage is cut into stretches, and in each the extreme of a fine grid is corrected by a parabola.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial.transform import Rotation

from mechwright import Array
from mechwright.mechanics.tracing.order import one_way
from mechwright.mechanics.tracing.points import random_angles
from mechwright.mechanics.tracing.search import MARGIN
from mechwright_spherical.kinematics.chain import body_point, third_position
from mechwright_spherical.synthesis.four_bar_limits import USUAL, Bounds, flat, kabsch
from mechwright_spherical.synthesis.path_kernels import five_bars_missed, five_bars_pinched, shares

ARCS = 5
"""Ground, crank, coupler, rocker, arm."""

STRETCHES = 8
"""Parts of the passage, for a ratio up to 1; each has its longest and its shortest diagonal."""

FINE = 12
"""Steps of a stretch: 3.75 degrees of the crank at most, where a parabola misses an extreme by 1e-7."""

TRIED, COARSE = 8, 3
"""Random shapes for each start, most of which cannot be assembled over the whole passage, and the steps of
a stretch in which that is asked."""


@dataclass(frozen=True)
class FiveShapes:
    """Linkages (...) by their unknowns (..., 12), or (..., 13) with the first crank angle."""

    rows: Array

    @property
    def arcs(self) -> Array:
        """(..., 5), rad."""
        return self.rows[..., :ARCS]

    @property
    def first(self) -> Array:
        """(...) crank angle at the first point, of timed points."""
        return self.rows[..., -1]


@dataclass(frozen=True)
class FiveBarRoom:
    """Five-bars of one side and one sense of the crank; see ``mechwright.mechanics.tracing``.

    Parameters
    ----------
    targets
        (n, 3) unit vectors.
    turns
        (n,) crank angles from that at the first point, rad; None where they are free.
    ratio
        Turns of the arm per turn of the crank.
    side
        +1 or -1: the sign of C.(A x B).
    sense
        +1 or -1; that of ``turns`` where these are given.
    closed
        Whether the first point follows on the last, after one turn of the crank.
    size
        Of the path: distance of the farthest point from the middle.
    bounds
        Of arcs and transmission angle.
    """

    targets: Array
    turns: Array | None
    ratio: float
    side: int
    sense: int
    closed: bool
    size: float
    bounds: Bounds

    def made(self, x: Array) -> FiveShapes:
        """See ``Traced``."""
        return FiveShapes(x)

    def missed(self, made: FiveShapes, theta: Array) -> Array:
        """See ``Traced``."""
        lead, rows, angles = flat(made.rows, self.angles(made, theta))
        found = five_bars_missed(rows, angles, self.ratio, float(self.side), self.targets, self.size)
        return found.reshape(*lead, *self.targets.shape)

    def angles(self, made: FiveShapes, theta: Array) -> Array:
        """Crank angles (..., n) of the points, rad."""
        return theta if self.turns is None else made.first[..., None] + self.turns + 0 * theta

    def driven(self, made: FiveShapes, theta: Array) -> tuple[Array, Array]:
        """Pins A and B (3, ..., n) in the linkage's own coordinates: z is a0, and y square to both axes."""
        ground, crank, _, _, arm = (made.arcs[..., k, None] for k in range(ARCS))
        phi = made.rows[..., 5, None] + self.ratio * theta
        zero = 0 * (theta + crank)
        a = np.stack([np.sin(crank) * np.cos(theta), np.sin(crank) * np.sin(theta), np.cos(crank) + zero])
        out, along = np.sin(arm) * np.cos(phi), np.cos(arm) + zero
        b = np.stack(
            [
                np.sin(ground) * along + np.cos(ground) * out,
                np.sin(arm) * np.sin(phi),
                np.cos(ground) * along - np.sin(ground) * out,
            ]
        )
        return a, b

    def exceeded(self, made: FiveShapes, theta: Array) -> Array:
        """Arcs beyond their bounds, rad, and cosines of the transmission angle; 0 or less is kept."""
        low, high = self.bounds.least - made.arcs, made.arcs - self.bounds.greatest
        pinched = self.cosines(made, theta) - math.cos(self.bounds.least_angle)
        shape = (*pinched.shape[:-1], ARCS)
        return (
            np.concatenate([np.broadcast_to(low, shape), np.broadcast_to(high, shape), pinched], axis=-1)
            + MARGIN
        )

    def dimensions(self, made: FiveShapes) -> Array:
        """Arcs, azimuth and elevation of the path point, (..., 7) degrees."""
        return np.degrees(made.rows[..., self.columns])

    @property
    def columns(self) -> tuple[int, ...]:
        """Unknowns that are dimensions: five arcs, then two angles."""
        return (0, 1, 2, 3, 4, 6, 7)

    def cosines(self, made: FiveShapes, theta: Array, fine: int = FINE) -> Array:
        """Greatest cosines of μ and of 180° - μ in each stretch of the passage, (..., 2 stretches)."""
        stretches = STRETCHES * math.ceil(max(1.0, abs(self.ratio)))
        angles = self.angles(made, theta)
        first = angles[..., :1]
        last = first + self.sense * math.tau if self.closed else angles[..., -1:]
        lead, rows, ends = flat(made.rows, np.concatenate([first, last], axis=-1))
        found = five_bars_pinched(rows, ends[:, 0], ends[:, 1], self.ratio, stretches, fine)
        return found.reshape(*lead, -1)

    def ordered(self, theta: Array, sense: Array) -> Array:
        """See ``Traced``; angles that are given are in order."""
        return theta.copy() if self.turns is not None else one_way(theta, sense)

    def starts(self, count: int, rng: np.random.Generator) -> tuple[Array, Array, Array]:
        """See ``Room``: random linkages that can be assembled, each turned onto the points (Kabsch)."""
        many = TRIED * count
        arcs = rng.uniform(self.bounds.least, min(self.bounds.greatest, USUAL), (many, ARCS))
        ranges = (0.0, math.tau), (-1.5, 2.5), (-1.0, 1.0)
        rest = [rng.uniform(low, high, many) for low, high in ranges]
        theta = random_angles(many, self.targets, self.turns, self.sense, self.closed, rng)
        still = np.tile([1.0, 0.0, 0.0, 0.0], (many, 1))
        x = np.concatenate([arcs, np.stack(rest, axis=-1), still, theta[:, :1]], axis=1)
        made = self.made(x)
        good = np.flatnonzero(self.cosines(made, theta, COARSE).max(axis=-1) < 1)[:count]
        x, theta = x[good], theta[good]
        own = replace(self, targets=0 * self.targets, size=1.0).missed(self.made(x), theta)
        good = np.flatnonzero(np.isfinite(own).all(axis=(1, 2)))
        x, theta, own = x[good], theta[good], own[good]
        error = np.empty(0)
        if len(x):
            frames, error = kabsch(own, self.targets)
            x[:, 8:12] = Rotation.from_matrix(frames).as_quat(scalar_first=True)
        if self.turns is None:
            x = x[:, :-1]
        over = np.maximum(self.exceeded(self.made(x), theta), 0.0)
        return x, theta, np.asarray(error * len(self.targets) / self.size**2 + (over**2).sum(axis=-1))

    def pins(self, x: Array, theta: float) -> dict[str, Array]:
        """Unit vectors (3,) a0, b0, a, b, c and p in space at a crank angle, of unknowns (k,)."""
        made = self.made(x)
        at = np.array([theta])
        a, b = self.driven(made, at)
        c = third_position(a, b, np.cos(made.arcs[2]), np.cos(made.arcs[3]), np.asarray(float(self.side)))
        p = body_point((a,), (c,), shares(float(x[6]), float(x[7]), float(x[2])))[0]
        ground = float(made.arcs[0])
        frame = Rotation.from_quat(x[8:12], scalar_first=True).as_matrix()
        own = {
            "a0": np.array([0.0, 0.0, 1.0]),
            "b0": np.array([math.sin(ground), 0.0, math.cos(ground)]),
            **{name: one[:, 0] for name, one in (("a", a), ("b", b), ("c", c), ("p", p))},
        }
        return {name: np.asarray(frame @ one) for name, one in own.items()}
