"""The outline of a cam: arcs where the follower dwells, elsewhere splines, cut where the jerk jumps."""

import math
from itertools import pairwise

import numpy as np

from mechwright import TOLERANCES, Arc, Array, Loop, Segment, kept
from mechwright.geometry.fit import fit_curves
from mechwright.mechanics.envelope import Points
from mechwright_cam_follower.cycle import Segment as Piece
from mechwright_cam_follower.cycle import cycle_of
from mechwright_cam_follower.geometry import Geometry, geometry_of
from mechwright_cam_follower.params import CamParams

FIT = TOLERANCES.outline / 2
"""Deviation of the fitted outline, mm: half of what an outline may have."""

_QUARTER = math.pi / 4
"""Widest piece that is fitted at once, rad: one piece rarely fits more."""


@kept
def outline_of(params: CamParams, second: bool = False) -> tuple[Loop, float]:
    """The outline of a cam that is not undercut, counter-clockwise, at θ = 0, and its deviation, mm."""
    geometry = geometry_of(params)
    segments: list[Segment] = []
    deviation = 0.0
    for piece in cycle_of(params).segments:
        if piece.law is None:
            segments.append(_dwell(geometry, piece, second))
        else:
            chain, error = _fitted(geometry, piece, second)
            segments += chain
            deviation = max(deviation, error)
    loop = Loop(tuple(segments))
    return (loop if loop.area > 0 else loop.reversed()), deviation


def _dwell(geometry: Geometry[float], piece: Piece, second: bool) -> Arc:
    point = _curve(geometry, piece, np.array([0.0]), second)[0]
    turn = -geometry.params.sense * piece.width
    return Arc((0.0, 0.0), abs(point), math.atan2(point.imag, point.real), turn, "dwell")


def _fitted(geometry: Geometry[float], piece: Piece, second: bool) -> tuple[list[Segment], float]:
    segments: list[Segment] = []
    deviation = 0.0
    ends: list[float] = [0.0]
    for a, b in pairwise(piece.cuts):
        parts = math.ceil((b - a) * piece.width / _QUARTER)
        ends += np.linspace(a, b, parts + 1)[1:].tolist()
    for a, b in pairwise(ends):

        def curves(t: Array, a: float = a, b: float = b) -> Array:
            z = _curve(geometry, piece, (1 - t) * a + t * b, second)
            return np.stack((z.real, z.imag), axis=-1)[None]

        chains, error = fit_curves(curves, 1, FIT, "cam")
        segments += chains[0]
        deviation = max(deviation, error)
    return segments, deviation


def _curve(geometry: Geometry[float], piece: Piece, u: Array, second: bool) -> Points:
    theta = piece.start + piece.width * u
    contact = geometry.contact(piece.at(u), second)
    turned: Points = contact.point * np.exp(-1j * geometry.params.sense * theta)
    return turned
