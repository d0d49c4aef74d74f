"""Whether one boundary meets another while it moves: every pair of pieces, over every interval of time.

A pair of nodes is dropped for an interval when their spheres stay apart; a pair of pieces when an axis
separates what they sweep (see :mod:`mechwright_cad.interference.separation`). What cannot be dropped is
divided: the larger node, or the interval. So nothing between two samples is missed. Both boundaries are
compared where the motion is a curve: what a corner does within an interval is its chords from start to middle
to end and a bound of the sag, from the second difference.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright_cad.interference.boxes import stay_apart
from mechwright_cad.interference.instants import SAG, Ints, Poses, second
from mechwright_cad.interference.path import Path
from mechwright_cad.interference.separation import dot, separation
from mechwright_cad.interference.tree import Tree

FLOOR = 1e-4
"""Pieces that move less than this within an interval, mm, are not divided further: what is still undecided
is a contact of which less than a tenth of a micrometre is in doubt."""

FAST = 8
"""Travel, in radii of the larger node, from which an interval is halved before nodes are: of a long edge that
small ones slide along, halves of the interval would tell nothing new."""

BLOCK = 60_000
"""Pairs at a time: bounds the memory to some ten MB."""

_LEVELS = 40
"""Most halvings of an interval; the floor comes first in every real case."""

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
    near = _spheres_meet(fixed, moving, Poses.of(path, every.when.astype(float), 1.0), every)
    one, two = (np.tile(nodes, int(near.sum())) for nodes in start_with)
    pairs = _Pairs(one, two, np.repeat(every.when[near], len(start_with[0])))
    for level in range(_LEVELS):
        pairs = pairs.take(~hit[pairs.when >> level])
        if not len(pairs):
            break
        number, when = np.unique(pairs.when, return_inverse=True)
        step = 0.5**level
        start: Array = number * np.float64(step)
        poses = Poses.of(path, start, step)
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


def _halved(parts: list[_Pairs], number: Ints) -> _Pairs:
    """Both halves of the intervals of some pairs, by their numbers among all halves."""
    one, two, when = (
        np.concatenate([getattr(part, name) for part in parts]) if parts else np.empty(0, dtype=np.int64)
        for name in ("one", "two", "when")
    )
    twice = 2 * number[when]
    return _Pairs(np.tile(one, 2), np.tile(two, 2), np.concatenate((twice, twice + 1)))


def _spheres_meet(fixed: Tree, moving: Tree, poses: Poses, pairs: _Pairs) -> NDArray[np.bool_]:
    """Whether (n,) the spheres of two nodes come together in their interval."""
    path = poses.take(pairs.when).move(np.take(moving.columns, pairs.two, axis=1))
    reach = fixed.radius[pairs.one] + moving.radius[pairs.two]
    return _near(np.take(fixed.columns, pairs.one, axis=1), path, reach)


def _near(point: Array, path: Array, reach: Array) -> NDArray[np.bool_]:
    """Whether (n,) paths (3, d, n) come within ``reach`` (n,) of points (d, n)."""
    near: NDArray[np.bool_] = _distance(point, path) <= reach + SAG * _size(second(path))
    return near


def _cull(fixed: Tree, moving: Tree, poses: Poses, pairs: _Pairs) -> tuple[_Pairs, _Pairs, _Pairs]:
    """Drop pairs of spheres that stay apart; give pairs to look at again, pairs of pieces, pairs to halve."""
    here = poses.take(pairs.when)
    path = here.move(np.take(moving.columns, pairs.two, axis=1))
    one, two = fixed.radius[pairs.one], moving.radius[pairs.two]
    near = _near(np.take(fixed.columns, pairs.one, axis=1), path, one + two)
    if fixed.box is not None and moving.box is not None:
        some = np.flatnonzero(near & ((pairs.one < fixed.leaves) | (pairs.two < moving.leaves)))
        boxes = fixed.box.take(pairs.one[some]), moving.box.take(pairs.two[some])
        near[some[stay_apart(*boxes, here.take(some))]] = False
    pairs, path, one, two = pairs.take(near), path[..., near], one[near], two[near]
    large_one = np.where(pairs.one < fixed.leaves, one, -np.inf)
    large_two = np.where(pairs.two < moving.leaves, two, -np.inf)
    leaf = np.isneginf(np.maximum(large_one, large_two))
    # Time is divided where a node passes by much more than either is large; else the larger node is.
    slow = ~leaf & (_travel(path) <= FAST * np.maximum(one, two))
    first = slow & (large_one >= large_two)
    kids = pairs.take(first)
    others = pairs.take(slow & ~first)
    split = _Pairs(
        np.concatenate((2 * kids.one, 2 * kids.one + 1, others.one, others.one)),
        np.concatenate((kids.two, kids.two, 2 * others.two, 2 * others.two + 1)),
        np.concatenate((kids.when, kids.when, others.when, others.when)),
    )
    return split, pairs.take(leaf), pairs.take(~leaf & ~slow)


def _pieces(
    fixed: Tree, moving: Tree, poses: Poses, pairs: _Pairs
) -> tuple[_Pairs, _Pairs, tuple[float, int] | None]:
    """Drop pairs of pieces that stay apart; give those to halve, those that meet, and the closest seen."""
    if not len(pairs):
        return pairs, pairs, None
    here = np.take(fixed.corners, pairs.one - fixed.leaves, axis=2)
    some = pairs.two - moving.leaves
    there = poses.take(pairs.when)
    path = np.stack([there.move(np.take(corner, some, axis=1)) for corner in moving.corners], axis=1)
    needed = there.wander(moving.reach[some]) + moving.ball
    apart = separation(here, path.reshape(-1, *path.shape[2:]), path[1], needed, SAG * second(path))
    near = apart <= needed
    seen = int(np.argmin(np.where(near, np.inf, apart)))
    closest = None if near[seen] else (float(apart[seen]) - moving.ball, int(pairs.when[seen]))
    pairs, here, path = pairs.take(near), here[..., near], path[..., near]
    meet = separation(here, path[1], path[1], moving.ball) <= moving.ball
    moves = _travel(path).max(axis=0) > FLOOR
    return pairs.take(~meet & moves), pairs.take(meet), closest


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
