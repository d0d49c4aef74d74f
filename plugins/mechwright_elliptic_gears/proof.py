"""The mesh proof of a design: as drawn, and as the cutters leave it."""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from mechwright import TOLERANCES, Array
from mechwright_elliptic_gears.ellipse import Ellipse
from mechwright_elliptic_gears.gear import outline_of, teeth_of
from mechwright_elliptic_gears.kinematics import Turning, pitch_radii
from mechwright_elliptic_gears.mesh import Mesh, mesh, swing
from mechwright_elliptic_gears.params import EllipticGearParams

FLATTEN = 2.5e-6
"""Chord error of the polygons of the proof, in semi-major axes: that many radians of transmission error, give
or take the ratio of the axes. For 40 teeth it puts 64 points on a flank."""

_CACHED = 16
"""Proofs that are kept."""


@dataclass(frozen=True)
class MeshProof:
    """What the mesh proof of a pair found.

    Parameters
    ----------
    mesh
        The raw result.
    allowance
        Depth that counts as contact, mm.
    flank_error
        Peak to peak of a flank's normal distance from where the designed backlash puts it, mm, the larger of
        both flanks.
    error
        Peak to peak of the driven gear's angle against the exact motion, without what the designed backlash
        alone makes of it, rad.
    """

    mesh: Mesh
    allowance: float
    flank_error: float
    error: float

    @property
    def collides(self) -> bool:
        """Whether the outlines stand in each other, more deeply than their fits can."""
        return bool(self.mesh.depth.max() > self.allowance)


@lru_cache(_CACHED)
def prove(params: EllipticGearParams) -> MeshProof:
    """Run the finished outline against its copy."""
    outline = outline_of(params)
    tolerance = min(FLATTEN * teeth_of(params).ellipse.semi_major, TOLERANCES.flatten)
    return prove_outlines(params, outline.outer.flatten(tolerance), 2 * (outline.deviation + tolerance))


def prove_outlines(
    params: EllipticGearParams, points: Array, allowance: float, mate: Array | None = None
) -> MeshProof:
    """Run an outline (n, 2), mm, counter-clockwise, part frame, against that of its mate, or its copy.

    ``allowance`` is the depth, mm, that the making of the outline itself can cause.
    """
    teeth = teeth_of(params)
    result = mesh(points, points if mate is None else mate, teeth.ellipse, teeth.count, allowance=allowance)
    normal = teeth.rack.backlash / 2 * math.cos(teeth.rack.pressure_angle)
    levers = contact_levers(teeth.ellipse, result.theta2, teeth.rack.pressure_angle)
    flanks = list(zip((result.ahead, result.behind), levers, strict=True))
    return MeshProof(
        result,
        allowance,
        max(swing(play * lever) for play, lever in flanks),
        max(swing(play - normal / lever) for play, lever in flanks),
    )


def contact_levers(ellipse: Ellipse, theta2: Array, pressure_angle: float) -> tuple[Array, Array]:
    """Distances (n,), mm, of axis O4 from the two lines of action through the pitch point.

    The first belongs to the flank that stops gear 4 turning counter-clockwise, the second to the other. A
    normal play c lets the gear turn by c over the lever.
    """
    s2, s4 = pitch_radii(Turning.of(theta2, 0.0), ellipse.semi_major, ellipse.eccentricity)
    slope = -ellipse.eccentricity * np.sin(theta2) * s2 / (ellipse.semi_major * (1 - ellipse.eccentricity**2))
    # The pitch tangent makes this angle with the perpendicular of the line of centres.
    tilt = np.arctan(slope)
    return s4 * np.cos(tilt - pressure_angle), s4 * np.cos(tilt + pressure_angle)
