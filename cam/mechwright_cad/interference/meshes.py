"""Bodies in space: triangles against triangles over the whole motion."""

import math

import manifold3d
import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright_cad.interference.invariants import pairs_that_may_meet
from mechwright_cad.interference.path import Path
from mechwright_cad.interference.surface import Surface
from mechwright_cad.interference.sweep import sweep
from mechwright_cad.interference.tree import Tree

_LOOKS = 25
"""Instants at which two bodies are looked at before they are followed between: every 15 degrees of a turn."""

_BATCH = 100
"""Points of an overlap that are measured at a time."""

_FINE = 12
"""Steps across an overlap at which its surface is measured: its deepest place to a few per cent."""

_POINTS = 500
"""Most points of an overlap that are measured; one with more triangles is not divided, and every few are."""


def meetings(fixed: Surface, moving: Surface, path: Path) -> Array:
    """Times (n,), in samples, at which two bodies overlap by more than the skin; empty if they never do."""
    if not fixed.core.points.size:
        return np.empty(0)
    core, other = fixed.core.tree, moving.tree
    times = np.zeros(1) if path.still else np.linspace(0.0, path.samples - 1.0, _LOOKS)
    near = times[_spheres_meet(core, other, path, times)]
    # Whether one is inside the other only a look can tell; from a clear start, boundaries have to meet first.
    if near.size and near[0] == 0 and _overlaps(fixed.core, moving, path, 0.0):
        return np.array([time for time in near if _overlaps(fixed.core, moving, path, float(time))])
    if path.still:
        return np.empty(0)
    pairs = pairs_that_may_meet(core, other, path)
    if not pairs[0].size:
        return np.empty(0)
    # Some looks are cheaper than a sweep that finds a long collision.
    met = np.array([time for time in near if _overlaps(fixed.core, moving, path, float(time))])
    return met if met.size else sweep(core, other, path, pairs).hits


def _spheres_meet(core: Tree, other: Tree, path: Path, times: Array) -> NDArray[np.bool_]:
    """Whether (n,) the spheres about two bodies meet at some times (n,)."""
    rotation, position = path.at(times)
    away = rotation @ other.centre[1] + position - core.centre[1]
    meet: NDArray[np.bool_] = np.linalg.norm(away, axis=1) <= core.radius[1] + other.radius[1]
    return meet


def _overlaps(fixed: Surface, moving: Surface, path: Path, time: float) -> bool:
    return not (fixed.manifold ^ _placed(moving, path, time)).is_empty()


def _placed(moving: Surface, path: Path, time: float) -> manifold3d.Manifold:
    rotation, position = path.at(np.array([time]))
    return moving.manifold.transform(np.column_stack((rotation[0], position[0])))


def depth(fixed: Surface, moving: Surface, path: Path, time: float) -> tuple[float, Array]:
    """How deep two bodies stand in each other, mm, and where (3,), in the fixed body's frame.

    That is the greatest distance of a point of either surface, inside the other body, from its surface.
    """
    common = fixed.manifold ^ _placed(moving, path, time)
    if common.is_empty():
        return 0.0, np.zeros(3)
    rotation, position = path.at(np.array([time]))
    x0, y0, z0, x1, y1, z1 = common.bounding_box()
    if common.num_tri() < _POINTS:
        common = common.refine_to_length(max(x1 - x0, y1 - y0, z1 - z0) / _FINE)
    points = np.asarray(common.to_mesh64().vert_properties)[:, :3]
    points = points[:: max(1, len(points) // _POINTS)]
    theirs = (points - position[0]) @ rotation[0]
    bound = np.maximum(fixed.nearest.bound(points), moving.nearest.bound(theirs))
    best, at = 0.0, points[0]
    for some in np.array_split(np.argsort(-bound), math.ceil(len(points) / _BATCH)):
        if bound[some[0]] <= best:
            break
        far = np.maximum(fixed.nearest.distance(points[some]), moving.nearest.distance(theirs[some]))
        if far.max() > best:
            best, at = float(far.max()), points[some[far.argmax()]]
    return best, at
