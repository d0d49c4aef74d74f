"""Toothed loops, and the mesh proof of a pair: as drawn, or coarsely if collisions alone are sought."""

from mechwright import TOLERANCES, Array, kept
from mechwright.geometry import Loop
from mechwright.mechanics.gearing import (
    MeshProof,
    RolledPair,
    SectorTeeth,
    Teeth,
    first_depth,
    gear_loop,
    prove_mesh,
    sector_loop,
)

FLATTEN = 2.5e-6
"""Chord error of the polygons of the proof, in half centre distances: that many radians of transmission
error, give or take the ratio of the pitch radii."""

COARSE = 40
"""Times that chord error, where only collisions are looked for: a sixth of the corners."""


@kept
def toothed(teeth: Teeth) -> tuple[Loop, float]:
    """The loop of teeth, of a sector with its blank, and its deviation, as :func:`gear_loop`."""
    return sector_loop(teeth) if isinstance(teeth, SectorTeeth) else gear_loop(teeth)


@kept
def prove(pair: RolledPair, teeth: tuple[Teeth, Teeth], count: int, internal: bool) -> MeshProof:
    """Run both outlines against each other until the same of ``count`` teeth meet again.

    Of a pair that collides only the positions up to there are looked at.
    """
    outlines, allowance = _outlines(pair, teeth, internal, FLATTEN)
    return prove_mesh(pair, teeth[0].rack, count, outlines, allowance, stop=True)


def collides(pair: RolledPair, teeth: tuple[Teeth, Teeth], count: int, internal: bool) -> bool:
    """Whether coarse outlines stand in each other: all but the least collisions, in less time."""
    outlines, allowance = _outlines(pair, teeth, internal, COARSE * FLATTEN)
    return first_depth(*outlines, pair, count, span=(0.0, 1.0), allowance=allowance) > 0


def _outlines(
    pair: RolledPair, teeth: tuple[Teeth, Teeth], internal: bool, chords: float
) -> tuple[tuple[Array, Array], float]:
    """Corners (n, 2) and (m, 2), mm, and the depth, mm, that their making can cause."""
    tolerance = min(chords * pair.distance / 2, TOLERANCES.flatten)
    (one, off), (two, more) = map(toothed, teeth)
    mate = two.reversed() if internal else two
    return (one.flatten(tolerance), mate.flatten(tolerance)), off + more + 2 * tolerance
