"""Distances of points from triangles."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.spatial import cKDTree

from mechwright.arrays import Array


@dataclass(frozen=True)
class Nearest:
    """Triangles ready to be asked how far they are, in classes of like size.

    Parameters
    ----------
    corners
        A tree of all corners: the surface is never farther than the nearest of them.
    classes
        For each class a tree of the triangles' centres, their greatest reach, mm, and themselves (k, 3, 3).
    """

    corners: Any
    classes: tuple[tuple[Any, float, Array], ...]

    @classmethod
    def of(cls, triangles: Array) -> "Nearest":
        """Sort triangles (k, 3, 3), mm, by size: a long one would make the search among short ones wide."""
        centre = triangles.mean(axis=1)
        reach = np.linalg.norm(triangles - centre[:, None], axis=2).max(axis=1)
        size = np.floor(np.log2(np.maximum(reach, 1e-9)))
        classes = tuple(
            (cKDTree(centre[size == kind]), float(reach[size == kind].max()), triangles[size == kind])
            for kind in np.unique(size)
        )
        return cls(cKDTree(triangles.reshape(-1, 3)), classes)

    def bound(self, points: Array) -> Array:
        """A bound (n,) of the distances of points (n, 3), mm, from above."""
        far: Array = self.corners.query(points)[0]
        return far

    def distance(self, points: Array) -> Array:
        """Distances (n,) of points (n, 3), mm."""
        best = self.bound(points)
        for tree, reach, triangles in self.classes:
            found = tree.query_ball_point(points, best + reach)
            counts = np.array([len(near) for near in found])
            if not counts.any():
                continue
            which = np.concatenate([near for near in found if near]).astype(np.int64)
            point = np.repeat(np.arange(len(points)), counts)
            far = nearest_to_origin(triangles[which] - points[point][:, None])
            np.minimum.at(best, point, far)
        return best


def nearest_to_origin(triangles: Array) -> Array:
    """Distance (...,) of triangles (..., 3, 3) from the origin, mm; they may be as thin as lines."""
    a = triangles[..., 0, :]
    normal = np.cross(triangles[..., 1, :] - a, triangles[..., 2, :] - a)
    size = np.linalg.norm(normal, axis=-1)
    edges = [triangles[..., (i + 1) % 3, :] - triangles[..., i, :] for i in range(3)]
    longest = np.max([np.einsum("...i,...i->...", edge, edge) for edge in edges], axis=0)
    inside = size > 1e-9 * longest
    best = np.full(triangles.shape[:-2], np.inf)
    for i, edge in enumerate(edges):
        away = -triangles[..., i, :]
        square = np.einsum("...i,...i->...", edge, edge)
        t = np.einsum("...i,...i->...", away, edge) / np.maximum(square, 1e-300)
        best = np.minimum(best, np.linalg.norm(away - np.clip(t, 0.0, 1.0)[..., None] * edge, axis=-1))
        inside &= np.einsum("...i,...i->...", away, np.cross(normal, edge)) >= 0
    height = np.abs(np.einsum("...i,...i->...", a, normal)) / np.maximum(size, 1e-300)
    nearest: Array = np.where(inside, np.minimum(best, height), best)
    return nearest
