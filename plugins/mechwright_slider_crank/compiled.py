"""The kinematics compiled to machine code, for sweeps over very many positions.

The sine and cosine of the C library take most of the time of a plain loop, since a call to them keeps the
compiler from working on several positions at once. The power series here does not.
"""

import math

import numpy as np
from numpy.typing import ArrayLike

from mechwright import Array
from mechwright.mechanics.compiled import compiled, inlined
from mechwright_slider_crank.kinematics import SliderCrank, slide

LARGEST_ANGLE = 1e5
"""Rad. Quarter turns up to 2¹⁶ times the first part of π/2, which has 33 bits, are exact in a double."""

# π/2 in three parts, the first two of 33 bits each, so that their multiples by whole numbers are exact.
_PI_2 = (1.5707963267341256, 6.077100506303966e-11, 2.0222662487959506e-21)

# On |r| <= π/4 the first term left out is 5e-17 of the sine and 2e-18 of the cosine.
_SINE = tuple((-1) ** k / math.factorial(2 * k + 1) for k in range(8))
_COSINE = tuple((-1) ** k / math.factorial(2 * k) for k in range(9))


def cos_sin(angle: float) -> tuple[float, float]:
    """Cosine and sine of an angle up to :data:`LARGEST_ANGLE`, to two units of the last digit of 1.

    >>> cos, sin = cos_sin(2.0)
    >>> abs(float(cos) - math.cos(2.0)) < 3e-16, abs(float(sin) - math.sin(2.0)) < 3e-16
    (True, True)
    """
    quarters = np.floor(angle * (2 / math.pi) + 0.5)
    r = ((angle - quarters * _PI_2[0]) - quarters * _PI_2[1]) - quarters * _PI_2[2]
    z = r * r
    s, c = _SINE[7], _COSINE[8]
    s = _SINE[1] + z * (_SINE[2] + z * (_SINE[3] + z * (_SINE[4] + z * (_SINE[5] + z * (_SINE[6] + z * s)))))
    s = r + r * z * s
    c = _COSINE[4] + z * (_COSINE[5] + z * (_COSINE[6] + z * (_COSINE[7] + z * c)))
    c = 1.0 + z * (_COSINE[1] + z * (_COSINE[2] + z * (_COSINE[3] + z * c)))
    turn = quarters - 4.0 * np.floor(quarters / 4.0)
    cos = c if turn == 0.0 else (-s if turn == 1.0 else (-c if turn == 2.0 else s))
    sin = s if turn == 0.0 else (c if turn == 1.0 else (-s if turn == 2.0 else -c))
    return cos, sin


_circle, _slide = inlined(cos_sin), inlined(slide)


@compiled
def _fill(
    phi: Array, crank: float, rod: float, offset: float, direction: float, branch: int, out: Array
) -> None:
    for k in range(phi.size):
        cos, sin = _circle(phi[k] - direction)
        t = offset - crank * sin
        # The root of a number below 0 is NaN here, as it is in numpy.
        w = branch * np.sqrt(rod * rod - t * t)
        found = _slide(cos, sin, w, crank, offset)
        out[0, k], out[1, k], out[2, k] = found[0], found[1], found[2]


def rates(linkage: SliderCrank, phi: ArrayLike) -> Array:
    """Position, velocity and acceleration of the slider per crank radian, as rows (3, n).

    Examples
    --------
    >>> import numpy as np
    >>> link = SliderCrank(50.0, 150.0, 20.0)
    >>> bool(np.allclose(rates(link, [1.0]), np.array(link.rates([1.0])), rtol=1e-13))
    True
    """
    angles = np.ascontiguousarray(np.atleast_1d(np.asarray(phi, dtype=float)))
    if not np.abs(angles).max(initial=0.0) < LARGEST_ANGLE:
        return np.array(linkage.rates(angles))
    out = np.empty((3, angles.size))
    _fill(angles, linkage.crank, linkage.rod, linkage.offset, linkage.direction, linkage.branch, out)
    return out
