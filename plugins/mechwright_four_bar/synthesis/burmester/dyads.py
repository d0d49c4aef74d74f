"""Dyads: a joint of the moving body that all poses put on one circle of the ground.

Glossary
--------
pose
    Place d and direction θ of the body's frame: a point w of the body stands at d + w e^{iθ}.
circle point, centre point
    w, a joint of the body, and G, the fixed pivot about which it turns at the distance R:

        abs(d_j + e^{iθ_j} w - G)² = R²

In the eight homogeneous numbers (1, w, G, s = w conj(G), c = abs(w)² + abs(G)² - R²) each pose is one linear
equation (Burmester 1888; McCarthy, Geometric Design of Linkages):

    abs(d)² + 2 Re(conj(d) e^{iθ} w) - 2 Re(conj(d) G) - 2 Re(e^{iθ} s) + c = 0
"""

import math
from dataclasses import dataclass

import numpy as np

from mechwright import Array
from mechwright.mechanics.planar import Plane

REAL = 1e-7
"""Imaginary share of a root up to which it is real, before Newton's steps decide."""

CLOSED = 1e-9
"""Share of the poses' size by which a dyad's lengths may differ at the end: else it is none."""

NEWTON = 6
"""Newton's steps of a root: each doubles its digits."""

SLIDING = 1e-9
"""Homogeneous unit, over the greatest of the others, below which the pivot lies at infinity: a slider."""

FLAT = 1e-12
"""Share of its greatest square below which three places of a joint are on a line, and have no circle."""


DEPENDENT = 1e-9
"""Share of the largest singular value below which the equations of five poses depend on each other."""


@dataclass(frozen=True)
class Poses:
    """Poses of a body.

    Parameters
    ----------
    places
        (n,) places of its origin, mm, x + i y.
    angles
        (n,) its directions, rad.
    """

    places: Plane
    angles: Array

    @property
    def directions(self) -> Plane:
        """e^{iθ} (n,)."""
        turned: Plane = np.exp(1j * self.angles)
        return turned

    @property
    def size(self) -> float:
        """Distance of the farthest place from the middle, mm; 1 for a pure turn."""
        return float(np.abs(self.places - self.places.mean()).max()) or 1.0

    def joints(self, w: complex) -> Plane:
        """Where a point of the body stands in the poses (n,), mm."""
        places: Plane = self.places + w * self.directions
        return places


@dataclass(frozen=True)
class Dyad:
    """A crank or a follower that a body's joint allows.

    Parameters
    ----------
    joint
        w in the body, mm.
    pivot
        G in the ground, mm.
    length
        R, mm.
    """

    joint: complex
    pivot: complex
    length: float


@dataclass(frozen=True)
class DyadCount:
    """Dyads of five poses.

    Parameters
    ----------
    dyads
        Those that turn.
    sliders
        How many slide.
    infinite
        Whether the equations of the poses depend on each other, as where the body turns about one point: then
        infinitely many dyads go through all of them.
    """

    dyads: tuple[Dyad, ...]
    sliders: int
    infinite: bool = False


def of_five(poses: Poses) -> DyadCount:
    """All dyads of five poses: 0 to 4, the sliders counted among them.

    The null space of the five equations has three dimensions; s = w conj(G) gives two conics in it, with four
    points in common.
    """
    size, middle = poses.size, complex(poses.places.mean())
    d, e = (poses.places - middle) / size, poses.directions
    rows = np.column_stack(
        (
            np.abs(d) ** 2, *_parts(2 * np.conj(d) * e), *_parts(-2 * np.conj(d)), *_parts(-2 * e),
            np.ones(d.size),
        )
    )  # fmt: skip
    _, sizes, right = np.linalg.svd(rows)
    if sizes[-1] < DEPENDENT * sizes[0]:
        return DyadCount((), 0, infinite=True)
    # A fixed turn of the null space, so that no solution lies at the infinity of the coordinates used below.
    turn, _ = np.linalg.qr(np.random.default_rng(5).normal(size=(3, 3)))
    null = right[5:].T @ turn
    w, g = null[1] + 1j * null[2], null[3] + 1j * null[4]
    s = null[5] + 1j * null[6]
    conic = np.outer(s, null[0].astype(complex)) - np.outer(w, np.conj(g))
    pair = [_symmetric(conic.real), _symmetric(conic.imag)]
    found: list[Dyad] = []
    sliders = 0
    for u in _common_points(*pair):
        p = null @ u
        if abs(p[0]) <= SLIDING * np.abs(p).max():
            sliders += 1
            continue
        p = p / p[0]
        joint, pivot = complex(p[1], p[2]) * size, complex(p[3], p[4]) * size + middle
        reach = np.abs(poses.joints(joint) - pivot)
        length = float(reach.mean())
        if np.ptp(reach) <= CLOSED * max(size, length):
            found.append(Dyad(joint, pivot, length))
    return DyadCount(tuple(sorted(found, key=lambda one: one.pivot.real)), sliders)


def _parts(values: Plane) -> tuple[Array, Array]:
    """Factors of x and y in Re(values (x + i y))."""
    return values.real, -values.imag


def _symmetric(matrix: Array) -> Array:
    half: Array = (matrix + matrix.T) / 2
    return half


def _crossed(a: Array, b: Array, c: Array, d: Array) -> Array:
    """The polynomial a b - c d, highest power first."""
    return np.asarray(np.polysub(np.convolve(a, b), np.convolve(c, d)), dtype=float)


def _common_points(one: Array, two: Array) -> list[Array]:
    """Real points (3,) of two conics u' M u = 0."""
    # As quadratics in the last coordinate, c2 y² + c1(x) y + c0(x), whose resultant is a quartic.
    polynomials: list[tuple[Array, Array, Array]] = []
    for m in (one, two):
        polynomials.append(
            (
                np.array([m[2, 2]]),
                np.array([2 * m[1, 2], 2 * m[0, 2]]),
                np.array([m[1, 1], 2 * m[0, 1], m[0, 0]]),
            )
        )
    (a2, a1, a0), (b2, b1, b0) = polynomials
    first, last = _crossed(a2, b0, b2, a0), _crossed(a2, b1, b2, a1)
    quartic = _crossed(first, first, last, _crossed(a1, b0, b1, a0))
    points = []
    for x in np.roots(quartic):
        if abs(x.imag) > REAL * (1 + abs(x)) * 1e3:
            continue
        below = np.polyval(last, x.real)
        if below == 0:
            continue
        u = np.array([1.0, x.real, -np.polyval(first, x.real) / below])
        for _ in range(NEWTON):
            slope = 2 * np.stack((one @ u, two @ u))[:, 1:]
            try:
                u[1:] -= np.linalg.solve(slope, [u @ one @ u, u @ two @ u])
            except np.linalg.LinAlgError:
                break
        scale = float(u @ u)
        if max(abs(u @ one @ u), abs(u @ two @ u)) < REAL * scale and np.isfinite(u).all():
            points.append(u / math.sqrt(scale))
    kept: list[Array] = []
    for u in points:
        if all(1 - abs(float(u @ other)) > REAL**2 for other in kept):
            kept.append(u)
    return kept


def of_three(poses: Poses, joint: complex) -> Dyad | None:
    """The dyad of a joint over three poses: the circle through its places; None where these are on a line."""
    one, two, three = poses.joints(joint)
    u, v = two - one, three - one
    cross = (np.conj(u) * v).imag
    if abs(cross) <= FLAT * max(abs(u), abs(v)) ** 2:
        return None
    pivot = complex(one + 1j * (u * abs(v) ** 2 - v * abs(u) ** 2) / (2 * cross))
    return Dyad(joint, pivot, float(abs(one - pivot)))


def of_four(poses: Poses, x: float) -> list[Dyad]:
    """The dyads of four poses whose joint has this x in the body, mm: 1 to 3 points of the curve.

    The joint's places are on one circle if the rows (w_j - w_1, (abs(w_j)² - abs(w_1)²)/2) have determinant
    0, a cubic in the joint's y.
    """
    ys = np.linspace(-1.5, 1.5, 4) * poses.size
    size = poses.size
    values = []
    for y in ys:
        z = (poses.joints(complex(x, y)) - poses.places.mean()) / size
        rows = np.column_stack((z.real, z.imag, np.abs(z) ** 2 / 2))
        values.append(np.linalg.det(rows[1:] - rows[0]))
    cubic = np.polyfit(ys / size, values, 3)
    found = []
    for root in np.roots(cubic):
        if abs(root.imag) > REAL * (1 + abs(root)):
            continue
        joint = complex(x, root.real * size)
        dyad = of_three(Poses(poses.places[:3], poses.angles[:3]), joint)
        if dyad is not None:
            reach = np.abs(poses.joints(joint) - dyad.pivot)
            if np.ptp(reach) <= 1e3 * CLOSED * max(size, dyad.length):
                found.append(dyad)
    return sorted(found, key=lambda one: one.joint.imag)
