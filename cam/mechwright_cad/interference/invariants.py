"""What a motion leaves as it is: heights along a direction that stays, distances from a point that stays.

A joint turns about an axis, a spherical linkage about a point, a planar one keeps every height. Of such a
motion, pieces of two bodies whose heights or distances never agree cannot meet at any time, and need not be
looked at from interval to interval. A pin in its bore is decided so at once.
"""

from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright_cad.interference.instants import Ints
from mechwright_cad.interference.nearest import nearest_to_origin
from mechwright_cad.interference.path import LEVEL, Path
from mechwright_cad.interference.tree import Tree

_FEW = 300
"""Pairs of nodes that are handed on: more are found quicker with the motion in sight."""

_DIGITS = 9
"""Decimals of a direction and of a point, mm, that stay: a thousandth of what passes as staying."""

_MANY = 100_000
"""Pairs at which the search for a proof that none may meet is given up."""


@dataclass(frozen=True)
class Frame:
    """A direction that stays, a point that stays, in the coordinates of one body; None if there is none."""

    direction: Array | None
    point: Array | None


def frames(path: Path) -> tuple[Frame, Frame]:
    """What stays, as the fixed and as the moving body see it."""
    turn, shift = path.at(np.arange(path.samples, dtype=float))
    change, step = turn - turn[0], shift - shift[0]
    matrix = np.einsum("nji,njk->ik", change, change)
    direction: tuple[Array | None, Array | None] = (None, None)
    along = np.linalg.eigh(matrix)[1][:, 0]
    there = turn[0] @ along
    wander = np.abs(turn @ along - there).max()
    if wander < LEVEL and np.ptp(step @ there) < LEVEL:
        direction = (there.round(_DIGITS), along.round(_DIGITS))
    point: tuple[Array | None, Array | None] = (None, None)
    right = -np.einsum("nji,nj->i", change, step)
    centre = np.linalg.lstsq(matrix, right, rcond=1e-9)[0]
    here = turn[0] @ centre + shift[0]
    if np.linalg.norm(turn @ centre + shift - here, axis=1).max() < LEVEL:
        # Without the noise of the fit, bodies that share a joint share its point.
        point = (here.round(_DIGITS) + 0.0, centre.round(_DIGITS) + 0.0)
    return Frame(direction[0], point[0]), Frame(direction[1], point[1])


def ranges(tree: Tree, frame: Frame) -> Array:
    """Least and greatest invariants of every node: (2 p, c, 2), c of them, mm; an empty range of no node."""
    pieces = tree.points
    columns = []
    if frame.direction is not None:
        heights = pieces @ frame.direction
        columns.append((heights.min(axis=1), heights.max(axis=1)))
    if frame.point is not None:
        columns.append(_distances(tree, frame.point))
        if frame.direction is not None:
            away = pieces - frame.point
            flat = away - (away @ frame.direction)[..., None] * frame.direction
            columns.append(_reach(flat))
    leaves, m = tree.leaves, len(pieces)
    found = np.empty((2 * leaves, len(columns), 2))
    found[..., 0], found[..., 1] = np.inf, -np.inf
    for place, (low, high) in enumerate(columns):
        found[leaves : leaves + m, place, 0], found[leaves : leaves + m, place, 1] = low, high
    size = leaves
    while size > 1:
        kids = found[size : 2 * size].reshape(size // 2, 2, -1, 2)
        found[size // 2 : size, :, 0] = kids[..., 0].min(axis=1)
        found[size // 2 : size, :, 1] = kids[..., 1].max(axis=1)
        size //= 2
    return found


def _distances(tree: Tree, point: Array) -> tuple[Array, Array]:
    """Least and greatest distance (m,) of the pieces from a point; the bodies of a joint ask for the same."""
    known = tree.distances
    key = tuple(point.tolist())
    if key not in known:
        known[key] = _reach(tree.points - point)
    return known[key]


def _reach(triangles: Array) -> tuple[Array, Array]:
    """Least and greatest distance (m,) of triangles (m, 3, 3) from the origin, mm."""
    far = np.linalg.norm(triangles, axis=2).max(axis=1)
    return nearest_to_origin(triangles), far


def pairs_that_may_meet(fixed: Tree, moving: Tree, path: Path) -> tuple[Ints, Ints]:
    """Pairs of nodes, by number, that the invariants do not keep apart; they cover all that may meet."""
    one = two = np.ones(1, dtype=np.int64)
    here, there = frames(path)
    if here.direction is None and here.point is None:
        return one, two
    mine, other = ranges(fixed, here), ranges(moving, there)
    cover: tuple[Ints, Ints] = (one, two)
    done: list[tuple[Ints, Ints]] = []
    while one.size:
        apart = (mine[one, :, 0] > other[two, :, 1]) | (other[two, :, 0] > mine[one, :, 1])
        left = ~apart.any(axis=1)
        one, two = one[left], two[left]
        found = sum(pairs[0].size for pairs in done)
        if found + one.size <= _FEW:
            cover = _joined([*done, (one, two)])
        elif found + one.size > _MANY:
            return cover
        leaf = (one >= fixed.leaves) & (two >= moving.leaves)
        done.append((one[leaf], two[leaf]))
        one, two = one[~leaf], two[~leaf]
        first = (two >= moving.leaves) | ((one < fixed.leaves) & (fixed.radius[one] >= moving.radius[two]))
        a, b = one[first], two[first]
        c, d = one[~first], two[~first]
        one = np.concatenate((2 * a, 2 * a + 1, c, c))
        two = np.concatenate((b, b, 2 * d, 2 * d + 1))
    pieces = _joined(done)
    return pieces if pieces[0].size <= _FEW else cover


def _joined(parts: list[tuple[Ints, Ints]]) -> tuple[Ints, Ints]:
    return np.concatenate([one for one, _ in parts]), np.concatenate([two for _, two in parts])
