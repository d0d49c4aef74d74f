"""The mesh proof of a design: as drawn, and as the cutters leave it."""

from mechwright import TOLERANCES, Array, kept
from mechwright.mechanics.gearing import MeshProof, Teeth, prove_mesh
from mechwright_elliptic_gears.ellipse import EllipticPair
from mechwright_elliptic_gears.gear import pair_of, rack_of, teeth_of, toothed
from mechwright_elliptic_gears.params import EllipticGearParams

FLATTEN = 2.5e-6
"""Chord error of the polygons of the proof, in semi-major axes: that many radians of transmission error, give
or take the ratio of the axes. For 40 teeth it puts 64 points on a flank."""


def prove(params: EllipticGearParams) -> MeshProof:
    """Run the finished outline against its copy."""
    return _prove(teeth_of(params), pair_of(params))


@kept
def _prove(teeth: Teeth, pair: EllipticPair) -> MeshProof:
    outer, deviation = toothed(teeth)
    tolerance = min(FLATTEN * pair.distance / 2, TOLERANCES.flatten)
    points = outer.flatten(tolerance)
    return prove_mesh(pair, teeth.rack, teeth.count, (points, points), 2 * (deviation + tolerance))


def prove_outlines(
    params: EllipticGearParams, points: Array, allowance: float, mate: Array | None = None
) -> MeshProof:
    """Run an outline (n, 2), mm, counter-clockwise, part frame, against that of its mate, or its copy.

    ``allowance`` is the depth, mm, that the making of the outline itself can cause.
    """
    outlines = points, points if mate is None else mate
    return prove_mesh(pair_of(params), rack_of(params), params.teeth, outlines, allowance)
