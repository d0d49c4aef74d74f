"""Dyads of a body on the sphere: a moving axis W that stays at one angle from a fixed axis G.

Between the first pose and another the body turns by R, and

    G . (R - 1) W = 0

For five poses these are four equations, bilinear in the directions G and W: six dyads, of which 0, 2, 4 or 6
are real. With W = (x, y, 1) and the equations times 1, x, y, x², xy, y² as 24 linear ones for the 30 products
of the powers up to the third with G, the null space has dimension 6, and multiplication by x within it has
the solutions as eigenvectors.
"""

from dataclasses import dataclass

import numpy as np

from mechwright import Array
from mechwright_spherical.kinematics.vectors import arc

COUNT = 6
"""Dyads of five poses in general, complex ones included."""

SINGULAR = 1e-9
"""Share of the largest singular value below which the null space has more than six dimensions."""

CLOSED = 1e-11
"""Residual of a dyad that is real and closes at all poses."""

NEWTON = 12
"""Most steps of Newton from an eigenvector."""

_POWERS = [(i, degree - i) for degree in range(4) for i in range(degree, -1, -1)]
"""Powers of x and y, up to the third in all."""

_TIMES = _POWERS[:6]
"""Those that the equations are multiplied by."""


@dataclass(frozen=True)
class Dyad:
    """A possible input or output link.

    Parameters
    ----------
    fixed
        (3,) unit vector G, at most 90 degrees from W.
    moving
        (3,) unit vector W in the first pose.
    """

    fixed: Array
    moving: Array

    @property
    def arc(self) -> float:
        """Angle between both, rad."""
        return float(arc(self.fixed, self.moving))


def turns(rotations: Array) -> Array:
    """(n - 1, 3, 3) turns of the body from the first of its orientations (n, 3, 3) to the others."""
    found: Array = rotations[1:] @ rotations[0].T
    return found


def of_five(rotations: Array) -> list[Dyad] | None:
    """The real dyads of five orientations (5, 3, 3); None of special ones, which have infinitely many.

    The equations are turned at random first, so that no solution lies at z = 0.
    """
    mixed = np.linalg.qr(np.random.default_rng(0).normal(size=(3, 3)))[0]
    forms = mixed.T @ (turns(rotations) - np.eye(3)) @ mixed
    matrix = np.zeros((24, 30))
    for block, (i, k) in enumerate(_TIMES):
        for column, (by_x, by_y) in ((0, (1, 0)), (1, (0, 1)), (2, (0, 0))):
            place = _POWERS.index((i + by_x, k + by_y))
            matrix[4 * block : 4 * block + 4, 3 * place : 3 * place + 3] += forms[:, :, column]
    _, sizes, basis = np.linalg.svd(matrix)
    if sizes[-1] < SINGULAR * sizes[0]:
        return None
    null = basis[len(sizes) :].T
    moved = np.concatenate([null[3 * _POWERS.index((i + 1, k)) :][:3] for i, k in _TIMES])
    _, vectors = np.linalg.eig(np.linalg.lstsq(null[:18], moved, rcond=None)[0])
    found: list[Dyad] = []
    for products in (null @ vectors).T:
        # The products are (1, x, y) times G: rank 1.
        u, _, v = np.linalg.svd(products[:9].reshape(3, 3))
        w = u[[1, 2, 0], 0]
        dyad = _real(w / w[np.abs(w).argmax()], v[0] / v[0][np.abs(v[0]).argmax()], forms, mixed)
        if dyad is not None and not any(_same(dyad, other) for other in found):
            found.append(dyad)
    return found


def _real(w: Array, g: Array, forms: Array, mixed: Array) -> Dyad | None:
    """Newton's steps from the real parts; None where these lead to no solution that was there."""
    if max(np.abs(w.imag).max(), np.abs(g.imag).max()) > 1e-4:
        return None
    w, g = w.real / np.linalg.norm(w.real), g.real / np.linalg.norm(g.real)
    for _ in range(NEWTON):
        by_w, by_g = g @ forms, forms @ w
        residual = np.concatenate((by_g @ g, [w @ w - 1, g @ g - 1]))
        slopes = np.zeros((6, 6))
        slopes[:4, :3], slopes[:4, 3:] = by_w, by_g
        slopes[4, :3], slopes[5, 3:] = 2 * w, 2 * g
        step = np.linalg.lstsq(slopes, residual, rcond=None)[0]
        w, g = w - step[:3], g - step[3:]
    if not np.abs(forms @ w @ g).max() < CLOSED:
        return None
    w, g = mixed @ w, mixed @ g
    return Dyad(g if g @ w > 0 else -g, w)


def _same(one: Dyad, other: Dyad) -> bool:
    return bool(min(abs(one.moving @ other.moving), abs(one.fixed @ other.fixed)) > 1 - 1e-12)
