"""The pieces that a plate falls into while it is cut through, in the order of the program.

Backwards in time pieces only grow together: the cells are put back, those cut last first, and where a cell
joins two pieces, the step that cuts it is the one that parts them.

Glossary
--------
zone
    Cells that hang together and are cut by the same step.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from mechwright_cam.controls.reading.run import Ints
from mechwright_cam.proof.finished import CHIP
from mechwright_cam.proof.footprint import NEVER, UNSURE, Footprint, Mask, Steps


@dataclass
class Piece:
    """A piece of the plate: what it parts into, and when."""

    zones: list[int] = field(default_factory=list)
    """What is cut from it while it is in one piece; of one that stays, its rest as well."""
    into: tuple["Piece", ...] = ()
    """The pieces that it parts into; empty if it never does."""
    parts: int = NEVER
    """The step that parts it."""

    def every(self) -> Iterator[int]:
        """All zones of it and of what it parts into."""
        left = [self]
        while left:
            piece = left.pop()
            yield from piece.zones
            left += piece.into


class Pieces:
    """All pieces of a plate."""

    def __init__(self, found: Footprint) -> None:
        self.footprint = found
        self._zone, self._when, self._area, edges = _zones(found)
        self.whole = self._grown_together(edges)
        """What the plate is at the start: one piece, or several."""

    def mask(self, piece: Piece, after: int) -> Mask:
        """(ny, nx) the cells of a piece that the steps up to one have not cut."""
        chosen = np.zeros(self._when.size, dtype=bool)
        chosen[list(piece.every())] = True
        mask: Mask = (chosen & (self._when > after))[self._zone]
        return mask

    def last(self, piece: Piece) -> int:
        """The step after the last cut into a piece that never parts; that which uses it up, if one does."""
        cut = self._when[piece.zones]
        done: int = cut.max()
        return int(cut[cut < NEVER].max(initial=-2)) + 1 if done == NEVER else done

    def last_before(self, piece: Piece, step: int) -> int:
        """The last cut into a piece before a step."""
        cut = self._when[piece.zones]
        return int(cut[cut < step].max(initial=-1))

    def _grown_together(self, edges: Ints) -> list[Piece]:
        when, area = self._when.tolist(), self._area.tolist()
        above = list(range(len(when)))
        first = list(when)  # of each piece, when the last of it is cut
        piece = [Piece([zone]) for zone in above]
        least = max(CHIP / self.footprint.cell - 2 * UNSURE, 0.0) ** 2

        def top(zone: int) -> int:
            while above[zone] != zone:
                above[zone] = above[above[zone]]
                zone = above[zone]
            return zone

        for one, other in edges.tolist():
            a, b = top(one), top(other)
            if a == b:
                continue
            step = min(when[one], when[other])
            if first[a] < first[b] or (first[a] == first[b] and area[a] < area[b]):
                a, b = b, a
            if first[b] > step and min(area[a], area[b]) > least:
                piece[a] = Piece([], (piece[a], piece[b]), step)
            else:
                if first[b] > step and area[b] > area[a]:  # a chip is part of the piece that it hangs on
                    piece[a], piece[b] = piece[b], piece[a]
                piece[a].zones += piece[b].every()
            above[b] = a
            area[a] += area[b]
        return [piece[zone] for zone in range(len(when)) if above[zone] == zone]


def _zones(found: Footprint) -> tuple[Steps, Ints, Ints, Ints]:
    """Number of each cell's zone (ny, nx), the step that cuts each (z,), its cells (z,), and which touch.

    The pairs (e, 2) are sorted: those that are joined last come first.
    """
    cut = found.cut
    ny, nx = cut.shape
    starts = np.ones((ny, nx), dtype=bool)
    starts[:, 1:] = cut[:, 1:] != cut[:, :-1]
    run = (
        np.cumsum(starts.ravel(), dtype=np.int32).reshape(ny, nx) - 1
    )  # stretches of a row that one step cuts
    long = np.diff(np.flatnonzero(starts.ravel()), append=ny * nx)
    when = cut[starts].astype(np.int64)
    change = (starts[1:] | starts[:-1]).nonzero()
    upright = np.column_stack((run[:-1][change], run[1:][change]))
    inner = starts.copy()
    inner[:, 0] = False
    along = np.column_stack((run[inner] - 1, run[inner]))
    same = when[upright[:, 0]] == when[upright[:, 1]]
    label = joined(when.size, np.concatenate((upright[same], _of_one_body(found.body, run))))
    _, zone = np.unique(label, return_inverse=True)
    count = int(zone.max()) + 1
    steps = np.zeros(count, dtype=np.int64)
    steps[zone] = when
    cells = np.bincount(zone, long, minlength=count).astype(np.int64)
    edges = zone[np.concatenate((upright[~same], along))]
    keys = np.unique(edges.min(axis=1) * count + edges.max(axis=1))
    edges = np.column_stack((keys // count, keys % count))
    order = np.argsort(-np.minimum(steps[edges[:, 0]], steps[edges[:, 1]]), kind="stable")
    return zone.astype(np.int32)[run], steps, cells, edges[order]


def _of_one_body(body: Steps, run: Steps) -> Ints:
    """(e, 2) stretches that hang together because they are of one body, wherever they lie."""
    cells = np.flatnonzero(body)
    number, stretch = body.ravel()[cells], run.ravel()[cells].astype(np.int64)
    order = np.lexsort((stretch, number))
    number, pairs = number[order], np.column_stack((stretch[order][:-1], stretch[order][1:]))
    kept: Ints = pairs[number[:-1] == number[1:]]
    return kept


def joined(count: int, pairs: Ints) -> Ints:
    """(count,) the least number in the group of each, where pairs (e, 2) are in one group."""
    label = np.arange(count)
    while pairs.size:
        ends = label[pairs]
        pairs = pairs[ends[:, 0] != ends[:, 1]]
        ends = label[pairs]
        np.minimum.at(label, ends.max(axis=1), ends.min(axis=1))
        while (label[label] != label).any():
            label = label[label]
    return label
