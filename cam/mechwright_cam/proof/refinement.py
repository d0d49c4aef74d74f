"""Pieces that seem loose on the wide cells of a large plate, looked at on the usual ones.

On wide cells more is uncertain, and all that is uncertain counts as cut: a bridge that holds may be missed.
What they call held is so. So only a window around each piece that a cutter would pass is done again with
narrow cells, and what joins it there to held material holds it.

Glossary
--------
window
    A part of the plate around a piece, with a grid of its own.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from mechwright_cam.proof.footprint import (
    BEFORE,
    CELL,
    NEVER,
    UNSURE,
    Bounds,
    Footprint,
    Mask,
    Steps,
    cell_for,
    footprint,
)
from mechwright_cam.proof.loose_pieces import LoosePiece, loose_pieces, passed
from mechwright_cam.proof.pieces import Pieces
from mechwright_cam.proof.scene import Scene
from mechwright_cam.proof.workholding import workholding

AROUND = 4 * UNSURE
"""A window reaches so many wide cells beyond its piece: twice across what may count as cut on both sides."""
CLEAR = 0.5
"""What is uncut on a grid is material up to so many cells from the middle of its cell."""
NARROWER = 0.75
"""A window is worth it whose cells have at most this share of the width."""


@dataclass(frozen=True)
class Joined:
    """Material that is known to be held, in a window."""

    cut: Steps
    """(ny, nx) the step that cuts each cell of the window."""
    until: Steps
    """(ny, nx) up to which step what is there is known to be held; :data:`BEFORE` where it is not."""

    def secures(self, piece: Mask, step: int) -> bool:
        """Whether a piece has some of it when a step is done; of one that is cut no more, for good."""
        cut, until = self.cut[piece], self.until[piece]
        last = NEVER - 1 if (cut == NEVER).all() else step
        return bool((until > last).any())


def refined_loose_pieces(scene: Scene) -> Iterator[LoosePiece]:
    """The pieces that nothing holds: those in a cutter's way have been looked at as closely as can be."""
    wide = scene.footprint
    found = list(loose_pieces(scene, scene.pieces, workholding(scene)))
    if wide.cell <= CELL:
        yield from found
        return
    held = wide.cut.copy()
    for piece in found:
        held[piece.cells] = BEFORE
    for piece in found:
        window = _window(wide, piece)
        lies_still = not piece.is_part and passed(scene, piece) is None
        if lies_still or cell_for(window) > NARROWER * wide.cell:
            yield piece
        else:
            yield from _looked_at(scene, piece, held, window)


def _window(wide: Footprint, piece: LoosePiece) -> Bounds:
    """Around a piece, on the plate."""
    rows, columns = np.flatnonzero(piece.cells.any(axis=1)), np.flatnonzero(piece.cells.any(axis=0))
    ny, nx = piece.cells.shape
    away = math.ceil(AROUND)
    left, right = max(int(columns[0]) - away, 0), min(int(columns[-1]) + 1 + away, nx)
    low, high = max(int(rows[0]) - away, 0), min(int(rows[-1]) + 1 + away, ny)
    cell = wide.cell
    return wide.x + left * cell, wide.y + low * cell, wide.x + right * cell, wide.y + high * cell


def _looked_at(scene: Scene, piece: LoosePiece, held: Steps, window: Bounds) -> Iterator[LoosePiece]:
    """What is loose of a piece in its window; material around it stands until ``held`` of the wide grid."""
    wide, close = scene.footprint, footprint(scene.paths, scene.job, window)
    ny, nx = close.cut.shape
    column = (close.x + (np.arange(nx) + 0.5) * close.cell - wide.x) / wide.cell
    row = (close.y + (np.arange(ny) + 0.5) * close.cell - wide.y) / wide.cell
    i = np.clip(row.astype(np.int64), 0, wide.cut.shape[0] - 1)
    j = np.clip(column.astype(np.int64), 0, wide.cut.shape[1] - 1)
    off = np.hypot(row[:, None] - i[:, None] - 0.5, column - j - 0.5)
    until = np.where(off <= CLEAR, held[np.ix_(i, j)], BEFORE).astype(np.int32)
    mine = piece.cells[np.ix_(i, j)]
    for one in loose_pieces(scene, Pieces(close), [Joined(close.cut, until)]):
        if (one.cells & mine).any():
            yield one
