"""What becomes of a piece that nothing holds: it is taken away at a stop, or no cutter comes near it."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from mechwright.contracts.part import Profile
from mechwright_cam.controls.reading.run import Ints
from mechwright_cam.proof.entry_rules import ABOVE
from mechwright_cam.proof.footprint import BEFORE, UNSURE, Footprint, Mask
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.pieces import Pieces
from mechwright_cam.proof.scene import Scene
from mechwright_cam.proof.stops import TAKES, stops_that_say
from mechwright_cam.proof.workholding import Workholding
from mechwright_cam.setup.views import inside_of

CLOSING = 2.0
"""A cut that frees a piece may go on so many diameters of the cutter: over its own beginning, and away."""
PLAY = 1.0
"""A loose piece moves by the width of the cut that freed it, the cutter's diameter, and so much more, mm."""
PART = 0.5
"""A piece with so much of the finished part is the part, or one of its parts: share of its own cells."""


@dataclass(frozen=True)
class LoosePiece:
    """A piece that nothing holds."""

    step: int
    """The step that frees it."""
    cells: Mask
    place: tuple[float, float]
    area: float
    """Its area, mm²."""
    is_part: bool
    """Whether it is the finished part, or one of them."""
    where: str
    """Where it is, in words."""
    taken: int | None
    """The stop at which it is taken away; -1 if that is when the plate is turned over."""
    grid: Footprint
    """The grid of its cells."""


def loose_pieces(scene: Scene, pieces: Pieces, held: Sequence[Workholding]) -> Iterator[LoosePiece]:
    """The pieces that nothing holds, as they come loose; what such a piece falls into is not told again."""
    left = [(piece, -1) for piece in pieces.whole]
    while left:
        piece, since = left.pop()
        if piece.parts == since:  # one step has made more than two of it
            left += [(one, since) for one in piece.into]
            continue
        cells = pieces.mask(piece, since)
        if not any(grip.secures(cells, since) for grip in held):
            yield _loose(scene, pieces.footprint, cells, since)
            continue
        end = max(piece.parts if piece.into else pieces.last(piece), since + 1)
        rest = pieces.mask(piece, end - 1)  # what was held may have been cut away
        if rest.any() and not any(grip.secures(rest, end - 1) for grip in held):
            yield _loose(scene, pieces.footprint, rest, pieces.last_before(piece, end))
            continue
        left += [(one, piece.parts) for one in piece.into]


def _loose(scene: Scene, found: Footprint, cells: Mask, step: int) -> LoosePiece:
    x, y = place = found.place(cells)
    part = np.count_nonzero(found.inside(found.part, cells))
    area = np.count_nonzero(found.within(cells, UNSURE * found.cell)) * found.cell**2
    openings = [f for f in scene.job.features if not (isinstance(f, Profile) and f.side == "outside")]
    name = next((f.name for f in openings if shapely.contains_xy(inside_of(f), x, y)), "")
    where = f"in {name}" if name else "beside the part"
    stops = [stop for stop in stops_that_say(scene.run, TAKES) if stop > step]
    is_part = bool(part >= PART * np.count_nonzero(cells))
    taken = stops[0] if stops else None
    if step == BEFORE and scene.job.side == "underside":
        taken = -1  # who lifts the plate finds it on the table
    return LoosePiece(step, cells, place, area, is_part, where, taken, found)


def passed(scene: Scene, loose: LoosePiece) -> int | None:
    """The first step in which a cutter comes as near to a loose piece as that may move; None if none does."""
    if milled_away(scene, loose):
        return None
    paths, found, freed = scene.paths, loose.grid, _kerf(scene, loose)
    until = len(scene.run) if loose.taken is None else loose.taken
    steps = paths.steps[(paths.steps > _closed(scene, loose)) & (paths.steps < until)]
    way = paths.end[steps] - paths.start[steps]
    up = (np.hypot(*way[:, :2].T) <= NEAR) & (way[:, 2] > 0)
    steps = steps[(paths.low[steps] < ABOVE) & ~up]
    near: list[int] = []
    for radius in np.unique(paths.radius[steps]).tolist():
        zone = found.within(loose.cells, radius + freed + PLAY)
        border = (zone.shape[0] - found.cut.shape[0]) // 2
        mine: Ints = steps[paths.radius[steps] == radius]
        places, z, owner = paths.samples(mine, found.cell)
        row, column, inside = found.cells(places, border)
        inside &= z < ABOVE
        row, column, owner = row[inside], column[inside], owner[inside]
        near += owner[zone[row, column]][:1].tolist()
    return min(near, default=None)


def milled_away(scene: Scene, loose: LoosePiece) -> bool:
    """Whether the cut that frees a piece takes all of it in going on."""
    return bool(loose.grid.cut[loose.cells].max() <= _closed(scene, loose))


def _kerf(scene: Scene, loose: LoosePiece) -> float:
    """Width of the cut that frees a piece, mm."""
    return float(scene.paths.radius[loose.step]) * 2 if loose.step >= 0 else 0.0


def _closed(scene: Scene, loose: LoosePiece) -> int:
    """The last step of the cut that frees a piece, in so far as it may go on."""
    run, step, gone, length = scene.run, loose.step, 0.0, CLOSING * _kerf(scene, loose)
    while step + 1 < len(run) and run.cutting[step + 1] and step >= 0:
        gone += float(run.length[step + 1])
        if not gone <= length:
            break
        step += 1
    return step
