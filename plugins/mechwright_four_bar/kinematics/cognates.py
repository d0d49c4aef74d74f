"""Roberts' cognates: the other two four-bars that draw the same coupler curve.

With λ = (P - A)/(B - A), a constant of the coupler, C0 = A0 + λ (B0 - A0) is the third fixed pivot, and at
any instant the three linkages are (Roberts 1875, Chebyshev)

    1: A0, B0 with A, B     2: A0, C0 with A0 + P - A, C0 + λ (B - B0)     3: C0, B0 with C0 + (1 - λ)(A -
    A0), B0 + P - B

Each can be driven at either of its pivots.
"""

import math
from dataclasses import dataclass

import numpy as np

from mechwright import Array
from mechwright.mechanics.planar import Plane
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.kinematics.loop import close

LEAST_SHARE = 1e-6
"""λ or 1 - λ this small: the coupler point is a joint, its curve a circle, and there is no cognate."""


@dataclass(frozen=True)
class Drawing:
    """A four-bar with the coupler point that it draws with.

    Parameters
    ----------
    bar
        Its dimensions.
    pivot, point
        A0, mm, and the coupler point in the coupler's frame, mm, as x + i y.
    phi
        (n,) crank angles from X, rad.
    number
        1 for the linkage asked for, 2 and 3 for its cognates.
    """

    bar: FourBar
    pivot: complex
    point: complex
    phi: Array
    number: int = 1


def third_pivot(bar: FourBar, pivot: complex, point: complex) -> complex:
    """C0, x + i y, mm.

    >>> third_pivot(FourBar(40, 120, 80, 100), 0j, 60 + 35j)
    (50+29.166666666666668j)
    """
    ground = bar.ground * complex(math.cos(bar.ground_angle), math.sin(bar.ground_angle))
    return pivot + point / bar.coupler * ground


def cognates(bar: FourBar, pivot: complex, point: complex, phi: Array) -> list[Drawing]:
    """The linkage itself and its two cognates, each driven at either pivot: at most six, the linkage first.

    Parameters
    ----------
    bar, pivot, point
        The linkage, mm.
    phi
        (n,) crank angles from X, rad, that belong together: one way from the first, by less than half a turn
        from each to the next.
    """
    loop = close(bar, phi)
    a0, share = pivot, point / bar.coupler
    b0 = pivot + bar.ground * complex(math.cos(bar.ground_angle), math.sin(bar.ground_angle))
    a, b = pivot + loop.joint_a, pivot + loop.joint_b
    p = a + point * loop.coupler.direction
    found = [Drawing(bar, pivot, point, phi), _drawing(b0, a0, b, a, p, 1)]
    if min(abs(share), abs(1 - share)) > LEAST_SHARE:
        c0 = a0 + share * (b0 - a0)
        for number, one, two, first, last in (
            (2, a0, c0, a0 + p - a, c0 + share * (b - b0)),
            (3, c0, b0, c0 + (1 - share) * (a - a0), b0 + p - b),
        ):
            found += [_drawing(one, two, first, last, p, number), _drawing(two, one, last, first, p, number)]
    return found


def _drawing(a0: complex, b0: complex, a: Plane, b: Plane, p: Plane, number: int) -> Drawing:
    """The linkage with these fixed pivots, joints (n,) and coupler points (n,)."""
    crank, coupler, follower, ground = a - a0, b - a, b - b0, b0 - a0
    # Left of A to B0 or right of it; on the line nothing but rounding says which.
    sides = (np.conj(b0 - a) * coupler).imag
    branch = 1 if sides[np.abs(sides).argmax()] > 0 else -1
    bar = FourBar(
        float(abs(crank[0])),
        float(abs(coupler[0])),
        float(abs(follower[0])),
        abs(ground),
        float(np.angle(ground)),
        branch,
    )
    point = complex((p[0] - a[0]) / coupler[0] * bar.coupler)
    return Drawing(bar, a0, point, np.unwrap(np.angle(crank)), number)
