"""Whether one boundary meets another while it moves: every pair of pieces, over every interval of time.

A pair of nodes is dropped for an interval when their spheres stay apart; a pair of pieces when an axis
separates what they sweep (see :mod:`mechwright_cam.interference.separation`). What cannot be dropped is
divided: the larger node, or the interval. So nothing between two samples is missed. Both boundaries are
compared where the motion is a curve: what a corner does within an interval is its chords from start to middle
to end and a bound of the sag, from the second difference.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright.motion import Array
from mechwright_cam.interference.path import Path
from mechwright_cam.interference.separation import dot, gap_along, separation
from mechwright_cam.interference.tree import Boxes, Tree

SAG = 0.25
"""Sag of a corner's path under its chords, per second difference: twice that of a parabola (1/8), so that it
covers what the third derivative adds."""

FLOOR = 1e-4
"""Pieces that move less than this within an interval, mm, are not divided further: what is still undecided
is a contact of which less than a tenth of a micrometre is in doubt."""

BLOCK = 60_000
"""Pairs at a time: bounds the memory to some ten MB."""

_LEVELS = 40
"""Most halvings of an interval; the floor comes first in every real case."""

Ints = NDArray[np.int64]

_ROOT: Ints = np.ones(1, dtype=np.int64)


@dataclass(frozen=True)
class Found:
    """What a sweep found.

    Parameters
    ----------
    hits
        Times (n,), in samples, ascending, at which two pieces meet: at least one in each sample interval in
        which they do.
    closest
        Time at which the least separation of all pairs looked at in detail was seen; None if there were none.
    gap
        That separation, mm; inf without one.
    """

    hits: Array
    closest: float | None
    gap: float


@dataclass(frozen=True)
class _Pairs:
    """Nodes of the fixed and of the moving tree, and the place of their interval in the list."""

    one: Ints
    two: Ints
    when: Ints

    def __len__(self) -> int:
        return len(self.one)

    def take(self, which: Ints | NDArray[np.bool_]) -> "_Pairs":
        return _Pairs(self.one[which], self.two[which], self.when[which])


@dataclass(frozen=True)
class _Poses:
    """Poses at the start, in the middle and at the end of some intervals, which are on the last axis."""

    rotation: Array
    position: Array

    def move(self, points: Array, when: Ints) -> Array:
        """Points (d, n) at the three poses: (3, d, n)."""
        turn, shift = self.rotation[..., when], self.position[..., when]
        moved: Array = turn[:, :, 0] * points[0]
        for axis in range(1, len(points)):
            moved += turn[:, :, axis] * points[axis]
        moved += shift
        return moved

    def turn(self, vectors: Array, when: Ints) -> Array:
        """Directions (d, n) in the middle of the intervals: (d, n)."""
        rotation = self.rotation[1][..., when]
        turned: Array = np.einsum("ijn,jn->in", rotation, vectors)
        return turned


def sweep(fixed: Tree, moving: Tree, path: Path, start_with: tuple[Ints, Ints] = (_ROOT, _ROOT)) -> Found:
    """Find when the boundaries meet.

    Parameters
    ----------
    fixed
        A boundary at rest; edges or triangles.
    moving
        The other one, in its own frame; edges, triangles or balls.
    path
        How the moving frame moves.
    start_with
        Pairs of nodes that are looked at, by number; by default the roots.
    """
    count = path.samples - 1
    hit = np.zeros(count, dtype=bool)
    found: list[Array] = []
    closest: tuple[float, float | None] = (np.inf, None)
    every = _Pairs(np.ones(count, dtype=np.int64), np.ones(count, dtype=np.int64), np.arange(count))
    near = _spheres_meet(fixed, moving, _poses(path, every.when.astype(float), 1.0), every)
    one, two = (np.tile(nodes, int(near.sum())) for nodes in start_with)
    pairs = _Pairs(one, two, np.repeat(every.when[near], len(start_with[0])))
    for level in range(_LEVELS):
        pairs = pairs.take(~hit[pairs.when >> level])
        if not len(pairs):
            break
        number, when = np.unique(pairs.when, return_inverse=True)
        step = 0.5**level
        start: Array = number * np.float64(step)
        poses = _poses(path, start, step)
        later: list[_Pairs] = []
        stack = [_Pairs(pairs.one, pairs.two, when)]
        while stack:
            block = stack.pop()
            if len(block) > BLOCK:
                half = len(block) // 2
                stack += [block.take(np.arange(half)), block.take(np.arange(half, len(block)))]
                continue
            split, leaves, wait = _cull(fixed, moving, poses, block)
            if len(split):
                stack.append(split)
            undecided, met, seen = _pieces(fixed, moving, poses, leaves)
            times: Array = start[met.when] + step / 2
            if len(met):
                found.append(times)
                hit[number[met.when] >> level] = True
            if seen is not None and seen[0] < closest[0]:
                closest = (seen[0], float(start[seen[1]] + step / 2))
            later += [wait, undecided]
        pairs = _halved(later, number)
    hits = np.unique(np.concatenate(found)) if found else np.empty(0)
    return Found(hits, closest[1], closest[0])


def _poses(path: Path, start: Array, step: float) -> _Poses:
    parts = [path.at(start + part * step) for part in (0.0, 0.5, 1.0)]
    return _Poses(
        np.stack([np.moveaxis(rotation, 0, -1) for rotation, _ in parts]),
        np.stack([position.T for _, position in parts]),
    )


def _halved(parts: list[_Pairs], number: Ints) -> _Pairs:
    """Both halves of the intervals of some pairs, by their numbers among all halves."""
    one, two, when = (
        np.concatenate([getattr(part, name) for part in parts]) if parts else np.empty(0, dtype=np.int64)
        for name in ("one", "two", "when")
    )
    twice = 2 * number[when]
    return _Pairs(np.tile(one, 2), np.tile(two, 2), np.concatenate((twice, twice + 1)))


def _spheres_meet(fixed: Tree, moving: Tree, poses: _Poses, pairs: _Pairs) -> NDArray[np.bool_]:
    """Whether (n,) the spheres of two nodes come together in their interval."""
    path = poses.move(moving.centre.T[:, pairs.two], pairs.when)
    reach = fixed.radius[pairs.one] + moving.radius[pairs.two]
    meet: NDArray[np.bool_] = _distance(fixed.centre.T[:, pairs.one], path) <= reach + SAG * _second(path)
    return meet


def _cull(fixed: Tree, moving: Tree, poses: _Poses, pairs: _Pairs) -> tuple[_Pairs, _Pairs, _Pairs]:
    """Drop pairs of spheres that stay apart; give pairs to look at again, pairs of pieces, pairs to halve."""
    path = poses.move(moving.centre.T[:, pairs.two], pairs.when)
    one, two = fixed.radius[pairs.one], moving.radius[pairs.two]
    near = _distance(fixed.centre.T[:, pairs.one], path) <= one + two + SAG * _second(path)
    if fixed.box is not None and moving.box is not None:
        some = np.flatnonzero(near & ((pairs.one < fixed.leaves) | (pairs.two < moving.leaves)))
        near[some[_boxes_part(fixed.box, moving.box, poses, pairs.take(some))]] = False
    pairs, path, one, two = pairs.take(near), path[..., near], one[near], two[near]
    large_one = np.where(pairs.one < fixed.leaves, one, -np.inf)
    large_two = np.where(pairs.two < moving.leaves, two, -np.inf)
    node = np.maximum(large_one, large_two)
    leaf = np.isneginf(node)
    # A node is divided while it is larger than what it moves; then time is.
    slow = ~leaf & (_travel(path) <= 2 * node)
    first = slow & (large_one >= large_two)
    second = slow & ~first
    kids = pairs.take(first)
    others = pairs.take(second)
    split = _Pairs(
        np.concatenate((2 * kids.one, 2 * kids.one + 1, others.one, others.one)),
        np.concatenate((kids.two, kids.two, 2 * others.two, 2 * others.two + 1)),
        np.concatenate((kids.when, kids.when, others.when, others.when)),
    )
    return split, pairs.take(leaf), pairs.take(~leaf & ~slow)


def _boxes_part(fixed: Boxes, moving: Boxes, poses: _Poses, pairs: _Pairs) -> NDArray[np.bool_]:
    """Whether (n,) boxes stay apart across the surface of either node."""
    if not len(pairs):
        return np.zeros(0, dtype=bool)
    here = fixed.corners[pairs.one].transpose(1, 2, 0)
    corners = moving.corners[pairs.two].transpose(1, 2, 0)
    path = np.stack([poses.move(corner, pairs.when) for corner in corners], axis=1)
    swept = path.reshape(-1, *path.shape[2:])
    across = poses.turn(moving.normal[pairs.two].T, pairs.when)
    apart = np.maximum(
        gap_along(here, swept, fixed.normal[pairs.one].T),
        gap_along(here, swept, across),
    )
    parts: NDArray[np.bool_] = apart > SAG * _second(path).max(axis=0)
    return parts


def _pieces(
    fixed: Tree, moving: Tree, poses: _Poses, pairs: _Pairs
) -> tuple[_Pairs, _Pairs, tuple[float, int] | None]:
    """Drop pairs of pieces that stay apart; give those to halve, those that meet, and the closest seen."""
    if not len(pairs):
        return pairs, pairs, None
    here = fixed.points[pairs.one - fixed.leaves].transpose(1, 2, 0)
    corners = moving.points[pairs.two - moving.leaves].transpose(1, 2, 0)
    path = np.stack([poses.move(corner, pairs.when) for corner in corners], axis=1)
    needed = SAG * _second(path).max(axis=0) + moving.ball
    apart = separation(here, path.reshape(-1, *path.shape[2:]), path[1], needed)
    near = apart <= needed
    seen = int(np.argmin(np.where(near, np.inf, apart)))
    closest = None if near[seen] else (float(apart[seen]) - moving.ball, int(pairs.when[seen]))
    pairs, here, path = pairs.take(near), here[..., near], path[..., near]
    meet = separation(here, path[1], path[1], moving.ball) <= moving.ball
    moves = _travel(path).max(axis=0) > FLOOR
    return pairs.take(~meet & moves), pairs.take(meet), closest


def _second(path: Array) -> Array:
    """Size (..., n) of the second difference of three points (3, ..., d, n)."""
    return _size(path[0] - 2 * path[1] + path[2])


def _travel(path: Array) -> Array:
    """How far (..., n) the points (3, ..., d, n) get, mm."""
    return 2 * np.maximum(_size(path[1] - path[0]), _size(path[2] - path[1]))


def _size(vectors: Array) -> Array:
    """Length (..., n) of vectors (..., d, n)."""
    size: Array = np.sqrt(dot(vectors, vectors))
    return size


def _distance(point: Array, path: Array) -> Array:
    """Distance (n,) of points (d, n) from polylines (3, d, n)."""
    return np.minimum(_to_leg(point, path[0], path[1]), _to_leg(point, path[1], path[2]))


def _to_leg(point: Array, a: Array, b: Array) -> Array:
    along, away = b - a, point - a
    t = dot(away, along) / np.maximum(dot(along, along), 1e-300)
    return _size(away - np.clip(t, 0.0, 1.0) * along)
