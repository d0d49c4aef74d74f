"""Raw stock of made parts: round bars, plates, and what they weigh."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from mechwright.contracts.materials import material
from mechwright.contracts.part import Part
from mechwright.pipeline import Blank

ACROSS, ALONG = 2.0, 3.0
"""What a round bar has more than the part, mm, before both are rounded up: in diameter, and at each end."""

AROUND = 11.0
"""What a plate has more all round, mm, where no process says: a cutter of 8 mm, and 3 mm that hold."""

BY_RULE = "cut size with an allowance for cutting and holding"
BY_SHEET = "as the setup sheet has it"


@dataclass(frozen=True)
class Piece:
    """A piece of stock to saw off; mass of one in g."""

    parts: tuple[str, ...]
    count: int
    material: str
    designation: str
    mass: float
    note: str


def finished(part: Part) -> str:
    """The finished size of a made part in a few words; empty for one that is neither plate nor turned."""
    if part.turned is not None:
        return f"round {part.turned.greatest:.4g} x {part.turned.length:.4g}"
    if part.outline is None:
        return ""
    x0, y0, x1, y1 = part.outline.bounds
    return f"plate {x1 - x0:.1f} x {y1 - y0:.1f} x {part.thickness:g}"


def pieces(parts: Sequence[Part], blanks: Sequence[Blank]) -> Iterator[Piece]:
    """What is sawn off: plates as a process has them, then the rest of the parts in their order.

    A part that is neither turned nor a plate has no stock of its own: it may be printed or cast.
    """
    for blank in blanks:
        x, y, z = blank.size
        words = f"plate {x:.1f} x {y:.1f} x {z:g}"
        yield Piece(
            blank.parts, blank.count, blank.material, words, _grams(x * y * z, blank.material), BY_SHEET
        )
    done = {name for blank in blanks for name in blank.parts}
    for part in parts:
        if part.name not in done:
            piece = _piece(part)
            if piece is not None:
                yield piece


def count(part: Part) -> int:
    """How many are made or bought: one of a part that stands in no place."""
    return max(1, len(part.instances))


def _piece(part: Part) -> Piece | None:
    if part.turned is not None:
        across = math.ceil(round(part.turned.greatest + ACROSS, 3))
        along = math.ceil(round(part.turned.length + 2 * ALONG, 3))
        words, volume = f"round bar {across} x {along}", math.pi / 4 * across**2 * along
    elif part.outline is not None:
        x0, y0, x1, y1 = part.outline.bounds
        x, y = x1 - x0 + 2 * AROUND, y1 - y0 + 2 * AROUND
        words, volume = f"plate {x:.1f} x {y:.1f} x {part.thickness:g}", x * y * part.thickness
    else:
        return None
    return Piece((part.name,), count(part), part.material, words, _grams(volume, part.material), BY_RULE)


def _grams(volume: float, name: str) -> float:
    return volume * material(name).density / 1000
