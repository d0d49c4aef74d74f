"""The mesh proof of a design: as drawn, and as the cutters leave it."""

from mechwright import TOLERANCES, Array, kept
from mechwright.mechanics.gearing import MeshProof, Teeth, first_depth, prove_mesh
from mechwright_elliptic_gears.kinematics.ellipse import EllipticPair
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.gear import pair_of, rack_of, teeth_of, toothed

FLATTEN = 2.5e-6
"""Chord error of the polygons of the proof, in semi-major axes: that many radians of transmission error, give
or take the ratio of the axes. For 40 teeth it puts 64 points on a flank."""


def prove(params: EllipticGearParams) -> MeshProof:
    """Run the finished outline against its copy."""
    return _prove(teeth_of(params), pair_of(params))


def first_collision(params: EllipticGearParams) -> tuple[float, float]:
    """Depth of the first collision that is seen, 0 for none, and what counts as contact, both mm.

    Less than the whole turn is looked at. Half a turn of the picture about its middle makes each gear its
    mate: from a quarter of the pitch curve to three, all is seen. Gears with an odd number of teeth are
    mirror images of themselves besides: from a quarter to a half, it is.
    """
    return _first_collision(teeth_of(params), pair_of(params))


@kept
def _first_collision(teeth: Teeth, pair: EllipticPair) -> tuple[float, float]:
    points, allowance = _outline(teeth, pair)
    span = (0.25, 0.5 if teeth.count % 2 else 0.75)
    return first_depth(points, points, pair, teeth.count, span=span, allowance=allowance), allowance


@kept
def _prove(teeth: Teeth, pair: EllipticPair) -> MeshProof:
    points, allowance = _outline(teeth, pair)
    return prove_mesh(pair, teeth.rack, teeth.count, (points, points), allowance)


def _outline(teeth: Teeth, pair: EllipticPair) -> tuple[Array, float]:
    """Corners (n, 2), mm, of a gear, and the depth, mm, that its making can cause in its mate."""
    outer, deviation = toothed(teeth)
    tolerance = min(FLATTEN * pair.distance / 2, TOLERANCES.flatten)
    return outer.flatten(tolerance), 2 * (deviation + tolerance)


def prove_outlines(
    params: EllipticGearParams, points: Array, allowance: float, mate: Array | None = None
) -> MeshProof:
    """Run an outline (n, 2), mm, counter-clockwise, part frame, against that of its mate, or its copy.

    ``allowance`` is the depth, mm, that the making of the outline itself can cause.
    """
    outlines = points, points if mate is None else mate
    return prove_mesh(pair_of(params), rack_of(params), params.teeth, outlines, allowance)
