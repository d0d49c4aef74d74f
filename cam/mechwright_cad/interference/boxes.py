"""Boxes of the nodes of a tree in space, each along its own surface, and whether two of them stay apart.

Wide surfaces that slide past each other at a small distance are told apart by boxes: a sphere about a flat
piece is as thick as the piece is wide.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright_cad.interference.instants import SAG, Poses, second
from mechwright_cad.interference.separation import dot


@dataclass(frozen=True)
class Boxes:
    """Boxes of nodes; the nodes are on the last axis.

    Parameters
    ----------
    centre
        (3, 2 p) mm.
    half
        (3, 3, 2 p) mm: three half edges, the shortest first, as vectors.
    normal
        (3, 2 p): the unit vector along the shortest.
    reach
        (2 p,) mm: the furthest corner from the origin, or more.
    """

    centre: Array
    half: Array
    normal: Array
    reach: Array

    @classmethod
    def of(cls, filled: Array, leaves: int) -> "Boxes":
        """Boxes along the principal axes of the corners of runs of pieces (leaves, k, 3), mm."""
        centre, normal = np.zeros((2 * leaves, 3)), np.zeros((2 * leaves, 3))
        half = np.zeros((2 * leaves, 3, 3))
        size = 1
        while size <= leaves:
            first = leaves // size
            runs = filled.reshape(first, -1, 3)
            away = runs - runs.mean(axis=1, keepdims=True)
            _, axes = np.linalg.eigh(np.einsum("nki,nkj->nij", away, away))
            along = np.einsum("nki,nij->nkj", runs, axes)
            low, high = along.min(axis=1), along.max(axis=1)
            centre[first : 2 * first] = np.einsum("nj,nij->ni", (low + high) / 2, axes)
            half[first : 2 * first] = ((high - low) / 2)[:, :, None] * axes.transpose(0, 2, 1)
            normal[first : 2 * first] = axes[:, :, 0]
            size *= 2
        reach = np.linalg.norm(centre, axis=1) + np.linalg.norm(half, axis=2).sum(axis=1)
        columns = [np.ascontiguousarray(np.moveaxis(part, 0, -1)) for part in (centre, half, normal)]
        return cls(columns[0], columns[1], columns[2], reach)

    def take(self, nodes: NDArray[np.int64]) -> "Boxes":
        """The boxes of some nodes, by number."""
        parts = (self.centre, self.half, self.normal, self.reach)
        return Boxes(*(np.take(part, nodes, axis=-1) for part in parts))


def stay_apart(fixed: Boxes, moving: Boxes, poses: Poses) -> NDArray[np.bool_]:
    """Whether (n,) boxes stay apart across the surface of either, in the interval of their poses."""
    path = poses.move(moving.centre)
    wander = poses.wander(moving.reach)
    apart = _gap(fixed, moving, poses, path, fixed.normal) > wander
    left = np.flatnonzero(~apart)
    if left.size:
        some = moving.take(left), poses.take(left)
        apart[left] = (
            _gap(fixed.take(left), *some, path[..., left], some[1].turn(some[0].normal)) > wander[left]
        )
    return apart


def _gap(fixed: Boxes, moving: Boxes, poses: Poses, path: Array, axis: Array) -> Array:
    """Gap (n,), mm, between the projections on unit vectors (3, n), less the sag along them."""
    across = np.abs(dot(fixed.half, axis)).sum(axis=0)
    seen = poses.back(axis)
    at = dot(path, axis) - dot(fixed.centre, axis)
    wide = np.abs(dot(moving.half[None], seen[:, None])).sum(axis=1)
    apart = np.maximum((at - wide).min(axis=0), -(at + wide).max(axis=0)) - across
    bend = np.abs(second(at)) + np.abs(dot(moving.half, second(seen))).sum(axis=0)
    gap: Array = apart - SAG * bend
    return gap
