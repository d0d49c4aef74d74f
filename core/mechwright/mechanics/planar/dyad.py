"""Two links joined in C over a vector that moves: c e^{iσ} - l e^{iψ} = d, and its first three derivatives.

With d from the free end of the first link to that of the second, D = |d| and the branch β = ±1:

* c e^{iσ} = d (k + i β W) / (2 D²), k = c² - l² + D², W² = (c + D + l)(c + D - l)(l + c - D)(l - c + D);
* the n-th derivative is c e^{iσ} i σ⁽ⁿ⁾ - l e^{iψ} i ψ⁽ⁿ⁾ = Rₙ with Rₙ of d and of lower derivatives, so
  σ⁽ⁿ⁾ = -Re(Rₙ e^{-iψ}) / (c sin(σ - ψ)) and ψ⁽ⁿ⁾ = -Re(Rₙ e^{-iσ}) / (l sin(σ - ψ)).

At a toggle, sin(σ - ψ) = 0, the derivatives are infinite.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from mechwright.arrays import Array
from mechwright.mechanics.planar.rigid import Plane, Turning


@dataclass(frozen=True, slots=True)
class Rates:
    """Direction exp(i angle) (...) of a link, and the first three derivatives of its angle by the input's."""

    direction: Plane
    first: Array
    second: Array
    third: Array

    def turning(self, drive: Turning) -> Turning:
        """The same over time, with the input's own rates; the angle runs on over a turn."""
        angle = continuous(np.angle(self.direction))
        return Turning(angle, *drive.carried(self.first, self.second, self.third))


def dyad(
    d: Sequence[Plane], first: ArrayLike, second: ArrayLike, branch: int, rates: int = 3
) -> tuple[Rates, Rates]:
    """Both links over the vector d (...) and its three derivatives by the input's angle.

    Parameters
    ----------
    d
        mm, mm/rad, mm/rad², mm/rad³.
    first, second
        Lengths c and l, mm.
    branch
        +1 where C is to the left of d, -1 where it is to the right.
    rates
        The highest derivative that is needed, 0 to 3; d needs no higher ones. Those above are NaN.

    NaN where the two do not reach.
    """
    c, l = np.asarray(first), np.asarray(second)
    with np.errstate(invalid="ignore", divide="ignore"):
        s, p = directions(d[0], c, l, branch)
        sine = (s * np.conj(p)).imag
        one, two = -1 / (c * sine), -1 / (l * sine)
        none: Array = np.broadcast_to(np.float64(np.nan), sine.shape)
        w1 = w2 = w3 = v1 = v2 = v3 = none
        if rates > 0:
            r = d[1]
            w1, v1 = one * (r * np.conj(p)).real, two * (r * np.conj(s)).real
        if rates > 1:
            r = d[2] + c * w1**2 * s - l * v1**2 * p
            w2, v2 = one * (r * np.conj(p)).real, two * (r * np.conj(s)).real
        if rates > 2:
            r = d[3] + c * (3 * w1 * w2 + 1j * w1**3) * s - l * (3 * v1 * v2 + 1j * v1**3) * p
            w3, v3 = one * (r * np.conj(p)).real, two * (r * np.conj(s)).real
    return Rates(s, w1, w2, w3), Rates(p, v1, v2, v3)


def directions(d: Plane, first: ArrayLike, second: ArrayLike, branch: int) -> tuple[Plane, Plane]:
    """Directions exp(i angle) (...) of both links over the vector d (...), mm.

    NaN where the two do not reach.
    """
    c, l = np.asarray(first), np.asarray(second)
    distance = np.abs(d)
    with np.errstate(invalid="ignore", divide="ignore"):
        k = (c - l) * (c + l) + distance**2
        w = np.sqrt((c + distance + l) * (c + distance - l) * (l + c - distance) * (l - c + distance))
        s = d * (k + 1j * branch * w) / (2 * c * distance**2)
        p = (c * s - d) / l
        p /= np.abs(p)  # what is left of the rounding where l is far smaller than c
    return s, p


def continuous(angle: Array) -> Array:
    """Angles (..., n), rad, without jumps by a turn along the samples; NaN stays NaN and parts nothing.

    A turn between two samples that have a gap between them is not seen.

    >>> continuous(np.array([3.0, np.nan, -3.0])).round(6).tolist()
    [3.0, nan, 3.283185]
    """
    angle = np.asarray(angle)
    finite = np.isfinite(angle)
    if angle.ndim == 0:
        return angle
    if finite.all():
        return np.unwrap(angle) if (np.abs(np.diff(angle)) > np.pi).any() else angle
    last = np.maximum.accumulate(np.where(finite, np.arange(angle.shape[-1]), 0), axis=-1)
    filled = np.nan_to_num(np.take_along_axis(angle, last, axis=-1))
    return np.where(finite, np.unwrap(filled), np.nan)
