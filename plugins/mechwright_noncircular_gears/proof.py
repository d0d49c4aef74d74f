"""The mesh proof of a design: as drawn, and as the cutters leave it."""

from mechwright import TOLERANCES, Array, kept
from mechwright.mechanics.gearing import MeshProof, RolledPair, Teeth, first_depth, prove_mesh
from mechwright_noncircular_gears.gear import pair_of, rack_of, teeth_of, toothed
from mechwright_noncircular_gears.params import NoncircularParams

FLATTEN = 2.5e-6
"""Chord error of the polygons of the proof, in half centre distances: that many radians of transmission
error, give or take the ratio of the pitch radii."""

COARSE = 40
"""Times that chord error, where only collisions are looked for: a sixth of the corners."""


def prove(params: NoncircularParams) -> MeshProof:
    """Run both finished outlines against each other until the same teeth meet again.

    Of a pair that collides only the positions up to there are looked at.
    """
    return _prove(pair_of(params), teeth_of(params), params.teeth, params.internal)


@kept
def _prove(pair: RolledPair, teeth: tuple[Teeth, Teeth], count: int, internal: bool) -> MeshProof:
    outlines, allowance = _outlines(pair, teeth, internal, FLATTEN)
    return prove_mesh(pair, teeth[0].rack, count, outlines, allowance, stop=True)


def collides(params: NoncircularParams) -> bool:
    """Whether coarse outlines stand in each other: all but the least collisions, in less time."""
    pair = pair_of(params)
    outlines, allowance = _outlines(pair, teeth_of(params), params.internal, COARSE * FLATTEN)
    return first_depth(*outlines, pair, params.teeth, span=(0.0, 1.0), allowance=allowance) > 0


def _outlines(
    pair: RolledPair, teeth: tuple[Teeth, Teeth], internal: bool, chords: float
) -> tuple[tuple[Array, Array], float]:
    """Corners (n, 2) and (m, 2), mm, and the depth, mm, that their making can cause."""
    tolerance = min(chords * pair.distance / 2, TOLERANCES.flatten)
    (one, off), (two, more) = map(toothed, teeth)
    mate = two.reversed() if internal else two
    return (one.flatten(tolerance), mate.flatten(tolerance)), off + more + 2 * tolerance


def prove_outlines(params: NoncircularParams, driver: Array, driven: Array, allowance: float) -> MeshProof:
    """Run outlines (n, 2) and (m, 2), mm, material on the left, each about its axis, against each other.

    ``allowance`` is the depth, mm, that the making of the outlines itself can cause.
    """
    return prove_mesh(pair_of(params), rack_of(params), params.teeth, (driver, driven), allowance)
