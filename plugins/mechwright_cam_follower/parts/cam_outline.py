"""The outline of a cam: arcs where the follower dwells, elsewhere splines, cut where the jerk jumps."""

import math
from itertools import pairwise

import numpy as np

from mechwright import TOLERANCES, Arc, Array, Loop, Segment
from mechwright.geometry.fit import fit_curves
from mechwright.mechanics.envelope import Points
from mechwright_cam_follower.kinematics.contact import contact_of
from mechwright_cam_follower.kinematics.cycle import Segment as Piece
from mechwright_cam_follower.kinematics.mechanism import Mechanism

FIT = TOLERANCES.outline / 2
"""Deviation of the fitted outline, mm: half of what an outline may have."""

_QUARTER = math.pi / 4
"""Widest piece that is fitted at once, rad: one piece rarely fits more."""


def outline_of(m: Mechanism, cam: int = 0) -> tuple[Loop, float]:
    """The outline of a cam that is not undercut, counter-clockwise, at θ = 0, and its deviation, mm."""
    return m.once(("outline", cam), lambda: _outline(m, cam))


def _outline(m: Mechanism, cam: int) -> tuple[Loop, float]:
    segments: list[Segment] = []
    deviation = 0.0
    for piece in m.cycle.segments:
        if piece.law is None:
            segments.append(_dwell(m, piece, cam))
        else:
            chain, error = _fitted(m, piece, cam)
            segments += chain
            deviation = max(deviation, error)
    loop = Loop(tuple(segments))
    return (loop if loop.area > 0 else loop.reversed()), deviation


def _dwell(m: Mechanism, piece: Piece, cam: int) -> Arc:
    point = _curve(m, piece, np.array([0.0]), cam)[0]
    turn = -m.sense * piece.width
    return Arc((0.0, 0.0), abs(point), math.atan2(point.imag, point.real), turn, "dwell")


def _fitted(m: Mechanism, piece: Piece, cam: int) -> tuple[list[Segment], float]:
    segments: list[Segment] = []
    deviation = 0.0
    ends: list[float] = [0.0]
    for a, b in pairwise(piece.cuts):
        parts = math.ceil((b - a) * piece.width / _QUARTER)
        ends += np.linspace(a, b, parts + 1)[1:].tolist()
    for a, b in pairwise(ends):

        def curves(t: Array, a: float = a, b: float = b) -> Array:
            z = _curve(m, piece, (1 - t) * a + t * b, cam)
            return np.stack((z.real, z.imag), axis=-1)[None]

        chains, error = fit_curves(curves, 1, FIT, "cam")
        segments += chains[0]
        deviation = max(deviation, error)
    return segments, deviation


def _curve(m: Mechanism, piece: Piece, u: Array, cam: int) -> Points:
    theta = piece.start + piece.width * u
    contact = contact_of(m, piece.at(u), cam)
    turned: Points = contact.point * np.exp(-1j * m.sense * theta)
    return turned
