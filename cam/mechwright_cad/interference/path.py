"""How one body moves as another one sees it, at any instant between the samples of a motion.

Times are counted in samples: 0 is the first sample, 2.5 lies half-way between the third and the fourth.
Between samples the motion is a cubic with slopes from central differences; where it is smooth the error falls
with the fourth power of the step, and :attr:`Path.error` estimates it from the samples themselves.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.motion import Poses

STILL = 1e-9
"""Two bodies that move less than this against each other over the whole motion, mm and rad, are at rest."""

PARALLEL = 1e-9
"""Most by which the third direction cosine of two plates' normals may miss ±1: an angle of 45 µrad, with
which a plate of 100 mm leans out of its plane by less than what passes as contact."""

LEVEL = 1e-6
"""Plates whose relative height changes less than this over the motion, mm, stay at their heights."""

_ERROR_SHARE = 16
"""A cubic on twice the step has sixteen times the error."""


@dataclass(frozen=True)
class Path:
    """A relative motion: coordinates that interpolate well, and the map that they stand for.

    Parameters
    ----------
    position
        (n, d) mm: the moving body's origin in the fixed body's frame.
    attitude
        (n, 1) angle, rad, continuous, for d = 2; (n, 4) unit quaternion without jumps of sign for d = 3.
    """

    position: Array
    attitude: Array

    @property
    def dimension(self) -> int:
        """Two in the plane, three in space."""
        return int(self.position.shape[1])

    @property
    def samples(self) -> int:
        """Number of samples n."""
        return len(self.position)

    @cached_property
    def still(self) -> bool:
        """Whether the two bodies are at rest against each other."""
        return bool(max(np.ptp(self.position, axis=0).max(), np.ptp(self.attitude, axis=0).max()) < STILL)

    @cached_property
    def _values(self) -> Array:
        return np.column_stack((self.position, self.attitude))

    @cached_property
    def _slopes(self) -> Array:
        values = self._values
        if len(values) < 3:
            slopes: Array = np.tile(values[-1] - values[0], (len(values), 1))
            return slopes
        return np.gradient(values, axis=0, edge_order=2)

    def at(self, times: Array) -> tuple[Array, Array]:
        """Rotations (n, d, d) and positions (n, d), mm, at some times (n,)."""
        first = np.clip(np.floor(times).astype(np.int64), 0, max(self.samples - 2, 0))
        last = np.minimum(first + 1, self.samples - 1)
        t = (times - first)[:, None]
        s = 1 - t
        values = (
            (1 + 2 * t) * s * s * self._values[first]
            + t * s * s * self._slopes[first]
            + t * t * (3 - 2 * t) * self._values[last]
            - t * t * s * self._slopes[last]
        )
        d = self.dimension
        return rotations(values[:, d:]), values[:, :d]

    def error(self, reach: float) -> float:
        """Estimated error of the interpolation, mm, for points up to ``reach`` mm from the moving origin.

        Every second sample is left out and predicted from the others.
        """
        if self.samples < 7:
            return float("inf")
        coarse = Path(self.position[::2], self.attitude[::2])
        # The ends have one-sided slopes, and are left to the inside to judge.
        known = np.arange(3, self.samples - 3, 2)
        turn, place = coarse.at(known / 2)
        off = np.linalg.norm(place - self.position[known], axis=1)
        lean = np.linalg.norm(turn - rotations(self.attitude[known]), axis=(1, 2))
        return float((off + reach * lean).max(initial=0.0)) / _ERROR_SHARE


def rotations(attitude: Array) -> Array:
    """Rotation matrices (n, d, d) of angles (n, 1), rad, or of quaternions (n, 4) of any length."""
    if attitude.shape[1] == 1:
        c, s = np.cos(attitude[:, 0]), np.sin(attitude[:, 0])
        return np.stack((np.stack((c, -s), axis=-1), np.stack((s, c), axis=-1)), axis=-2)
    w, x, y, z = (attitude / np.linalg.norm(attitude, axis=1)[:, None]).T
    rows = (
        (1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)),
        (2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)),
        (2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)),
    )
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def relative(fixed: Poses, moving: Poses) -> tuple[Array, Array]:
    """Rotations (n, 3, 3) and positions (n, 3), mm, of one body in the frame of another."""
    back = fixed.rotation.transpose(0, 2, 1)
    position: Array = np.einsum("nij,nj->ni", back, moving.position - fixed.position)
    return back @ moving.rotation, position


def flat(rotation: Array, position: Array) -> bool | None:
    """Whether two plates stay parallel at one height: True face up, False face down, None if they do not."""
    cosine = rotation[:, 2, 2]
    if np.ptp(position[:, 2]) > LEVEL or (1 - np.abs(cosine)).max() > PARALLEL:
        return None
    return bool(cosine[0] > 0)


def plane_path(rotation: Array, position: Array) -> Path:
    """The path in the plane of two parallel plates; a plate that lies face down is mirrored in y first."""
    angle = np.unwrap(np.arctan2(rotation[:, 1, 0], rotation[:, 0, 0]))
    return Path(position[:, :2].copy(), angle[:, None])


def space_path(rotation: Array, position: Array) -> Path:
    """The path in space."""
    quaternion = _quaternions(rotation)
    flips = np.einsum("ij,ij->i", quaternion[1:], quaternion[:-1]) < 0
    sign = np.concatenate(([1.0], np.cumprod(np.where(flips, -1.0, 1.0))))
    return Path(position.copy(), quaternion * sign[:, None])


def _quaternions(rotation: Array) -> Array:
    """Unit quaternions (n, 4) of rotation matrices, from the largest of the four components."""
    m = rotation
    xx, yy, zz = m[:, 0, 0], m[:, 1, 1], m[:, 2, 2]
    squares = 1 + np.stack((xx + yy + zz, xx - yy - zz, yy - xx - zz, zz - xx - yy), axis=-1)
    a, b, c = m[:, 2, 1] - m[:, 1, 2], m[:, 0, 2] - m[:, 2, 0], m[:, 1, 0] - m[:, 0, 1]
    d, e, f = m[:, 0, 1] + m[:, 1, 0], m[:, 0, 2] + m[:, 2, 0], m[:, 1, 2] + m[:, 2, 1]
    table = np.stack(
        [
            np.stack(row, axis=-1)
            for row in (
                (squares[:, 0], a, b, c),
                (a, squares[:, 1], d, e),
                (b, d, squares[:, 2], f),
                (c, e, f, squares[:, 3]),
            )
        ],
        axis=-2,
    )
    picked: Array = table[np.arange(len(m)), squares.argmax(axis=1)]
    unit: Array = picked / np.linalg.norm(picked, axis=1)[:, None]
    return unit
