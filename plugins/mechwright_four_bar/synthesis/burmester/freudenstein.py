"""Linkages whose follower answers given angles of the crank.

With the ground as unit, and angles from the ground line (Freudenstein 1954):

    K1 cos ψ - K2 cos φ + K3 = cos(φ - ψ),   crank a = 1/K1, follower b = 1/K2, c² = 1 + a² + b² - 2 a b K3

Three pairs determine the K's. With ψ turned by an unknown angle four pairs do, with φ turned as well five:
seen from the follower the crank's joint is a joint of a body with the poses (-e^{-iψ}, φ - ψ), of which the
ground is always one of the four dyads, so that there are at most three answers.
"""

import math
from dataclasses import dataclass

import numpy as np

from mechwright import Array
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.synthesis.burmester import dyads

LONGEST = 1e6
"""Links longer than this many grounds are none."""

GROUND = 1e-7
"""A dyad so near to the ground line is the ground."""

SAME = 1e-6
"""rad, and share of a length, in which two answers that are one agree."""

SAMPLES = 3600
"""Angles among which changes of sign are sought for four pairs: a tenth of a degree apart."""

HALVINGS = 60
"""Halvings of such a step: down to rounding."""


@dataclass(frozen=True)
class Answering:
    """A linkage over a ground of 1 that answers.

    Parameters
    ----------
    crank, coupler, follower
        Over the ground, above 0.
    phi, psi
        Angles of crank and follower at the first pair, from the ground line, rad.
    """

    crank: float
    coupler: float
    follower: float
    phi: float
    psi: float

    def bar(self, ground: float, branch: int = 1) -> FourBar:
        """Its dimensions over a ground, mm, along X."""
        return FourBar(
            self.crank * ground, self.coupler * ground, self.follower * ground, ground, 0.0, branch
        )


def linkage_of(k: Array, phi: float, psi: float) -> Answering | None:
    """From the K's, for angles (n,) at the first pair; None where there is no such linkage."""
    if min(abs(k[0]), abs(k[1])) < 1 / LONGEST:
        return None
    a, b = 1 / float(k[0]), 1 / float(k[1])
    square = 1 + a * a + b * b - 2 * a * b * float(k[2])
    if not square > 0:
        return None
    # An arm of negative length points the other way.
    phi, psi = phi + (math.pi if a < 0 else 0.0), psi + (math.pi if b < 0 else 0.0)
    return Answering(
        abs(a), math.sqrt(square), abs(b), math.remainder(phi, math.tau), math.remainder(psi, math.tau)
    )


def _rows(phi: Array, psi: Array) -> tuple[Array, Array]:
    return np.stack((np.cos(psi), -np.cos(phi), np.ones_like(phi)), axis=-1), np.cos(phi - psi)


def coefficients(phi: Array, psi: Array) -> Array:
    """K (3,) of three or more pairs (n,), rad from the ground line: exact for three, else by least squares.

    >>> phi = np.radians([49.0192378865, 75.0, 100.980762114])
    >>> coefficients(phi, np.radians([8.4188701602, 52.6466250649, 85.5766005821])).round(6).tolist()
    [1.532366, 1.893543, 0.48521]
    """
    rows, right = _rows(phi, psi)
    return np.asarray(np.linalg.lstsq(rows, right, rcond=None)[0], dtype=float)


def of_three(phi: Array, psi: Array) -> list[Answering]:
    """The linkage of three pairs of angles (3,) from the ground line, rad: one or none."""
    found = linkage_of(coefficients(phi, psi), float(phi[0]), float(psi[0]))
    return [] if found is None else [found]


def of_four(phi: Array, psi: Array) -> list[Answering]:
    """The linkages of four pairs, the follower turned by an unknown angle: ``psi`` (4,) is relative."""

    def determinant(turn: Array) -> Array:
        rows, right = _rows(np.broadcast_to(phi, (turn.size, 4)), psi + turn[:, None])
        values: Array = np.linalg.det(np.concatenate((rows, right[..., None]), axis=-1))
        return values

    grid = np.linspace(0, math.tau, SAMPLES + 1)
    values = determinant(grid)
    low, high = (grid[k : k + SAMPLES][values[:-1] * values[1:] < 0] for k in (0, 1))
    sign = np.sign(determinant(low)) if low.size else low
    for _ in range(HALVINGS if low.size else 0):
        middle = (low + high) / 2
        same = np.sign(determinant(middle)) == sign
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    found: list[Answering] = []
    for turn in (low + high) / 2:
        one = linkage_of(coefficients(phi[:3], psi[:3] + turn), float(phi[0]), float(psi[0] + turn))
        # An arm of negative length is the same linkage at the opposite turn.
        if one is not None and not any(_same(one, other) for other in found):
            found.append(one)
    return found


def _same(one: Answering, other: Answering) -> bool:
    return (
        abs(math.remainder(one.psi - other.psi, math.tau)) < SAME
        and abs(one.crank - other.crank) < SAME * one.crank
    )


def of_five(phi: Array, psi: Array) -> list[Answering]:
    """The linkages of five pairs, both links turned by unknown angles: ``phi``, ``psi`` (5,) are relative."""
    found = []
    # The crank's plane, its origin A0, as the follower's plane about B0 sees it.
    for dyad in dyads.of_five(dyads.Poses(-np.exp(-1j * psi), phi - psi)).dyads:
        a, b, c = abs(dyad.joint), abs(dyad.pivot), dyad.length
        if min(a, b) < GROUND or max(a, b) > LONGEST:
            continue
        found.append(
            Answering(
                a, c, b,
                math.remainder(float(np.angle(dyad.joint) + phi[0]), math.tau),
                math.remainder(float(np.angle(dyad.pivot) + psi[0]), math.tau),
            )
        )  # fmt: skip
    return found
