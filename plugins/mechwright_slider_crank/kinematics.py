"""Motion of a slider-crank in closed form, both assemblies, from position to jerk.

The slide frame has the crank's pivot A0 in its origin and the slide along x at the height e; with φ' = φ - θ
the crank pin stands at A = a exp(i φ'), the slider's pin at B = s + i e. With t = e - a sin φ' and
w = ±√(c² - t²), the two assemblies, per crank radian:

* c exp(i σ') = w + i t, s = a cos φ' + w;
* σ'  : ω = -a cos φ' / w, α = (a sin φ' + t ω²) / w, j = (a cos φ' + 3 t ω α + w ω³) / w;
* s   : v = -a sin φ' - t ω, -a cos φ' - w ω² - t α, a sin φ' + t ω³ - 3 w ω α - t j.

"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from mechwright import Array, KinematicsError
from mechwright.mechanics.planar import BodyMotion, PointMotion, Turning
from mechwright_slider_crank.limit_motion import at_limit, rod_at_limit


def _rates(cos: Array, sin: Array, w: Array, crank: float, offset: float) -> tuple[Array, ...]:
    """Slide position, its three rates and the coupler's three per crank radian; ``w`` is signed."""
    x, y = crank * cos, crank * sin
    t = offset - y
    turn = -x / w
    bend = (y + t * turn * turn) / w
    third = (x + 3 * t * turn * bend + w * turn**3) / w
    return _slide(x, y, t, w, turn, bend, third)


def _slide(
    x: Array, y: Array, t: Array, w: Array, turn: Array, bend: Array, third: Array
) -> tuple[Array, ...]:
    """The same from the crank pin's place, and the coupler's rates."""
    turned = t * turn
    acceleration = -x - w * turn * turn - t * bend
    jerk = y + t * turn**3 - 3 * w * turn * bend - t * third
    return x + w, -y - turned, acceleration, jerk, turn, bend, third


@dataclass(frozen=True, slots=True)
class SliderCrank:
    """A slider-crank; for a sweep over designs the sizes may be arrays of the shape of the angles.

    Parameters
    ----------
    crank, rod
        a and c, above 0, mm.
    offset
        e of the slide line, to the left of its direction, mm.
    direction
        θ, of the slide, rad.
    branch
        +1 if the slider is ahead of the crank pin along the slide, -1 if behind.

    Examples
    --------
    >>> link = SliderCrank(50.0, 150.0, 20.0)
    >>> round(float(link.positions(math.radians(60))), 6)
    173.179117
    """

    crank: float
    rod: float
    offset: float
    direction: float = 0.0
    branch: int = 1

    def _coupler_x(self, sin: Array) -> Array:
        """The signed w; NaN where the linkage cannot be assembled."""
        t = self.offset - self.crank * sin
        with np.errstate(invalid="ignore"):
            w: Array = self.branch * np.sqrt(self.rod * self.rod - t * t)
        return w

    def positions(self, phi: ArrayLike) -> Array:
        """Slide positions s (...), mm, at crank angles (...), rad; NaN where there is none."""
        angle = np.asarray(phi, dtype=float) - self.direction
        s: Array = self.crank * np.cos(angle) + self._coupler_x(np.sin(angle))
        return s

    def rates(self, phi: ArrayLike) -> tuple[Array, Array, Array]:
        """Position, velocity and acceleration of the slider (...) per crank radian: mm, mm/rad, mm/rad².

        NaN where the linkage cannot be assembled.
        """
        angle = np.asarray(phi, dtype=float) - self.direction
        cos, sin = np.cos(angle), np.sin(angle)
        s, v, acceleration, *_ = _rates(cos, sin, self._coupler_x(sin), self.crank, self.offset)
        return s, v, acceleration

    @property
    def at_limit(self) -> bool:
        """Whether the crank only just turns, so that the assembly changes; not asked of a sweep."""
        single = not any(np.ndim(size) for size in (self.crank, self.rod, self.offset))
        return single and at_limit(self.crank, self.rod, self.offset)

    def bodies(self, phi: ArrayLike, omega: float | Turning = 1.0) -> "Bodies":
        """Motion of crank, coupler and slider at crank angles (n,), rad.

        ``omega`` is the crank's constant speed, rad/s, or the crank itself at the same samples. A linkage at
        its limit is in its assembly at the crank angle 0, and goes smoothly through its change points.

        Raises
        ------
        KinematicsError
            The linkage cannot be assembled at some angle, or the coupler stands across the slide there.
        """
        phi = np.atleast_1d(np.asarray(phi, dtype=float))
        angle = phi - self.direction
        cos, sin = np.cos(angle), np.sin(angle)
        if self.at_limit:
            return self._smoothly(phi, angle, omega)
        w = self._coupler_x(sin)
        wrong = ~(np.abs(w) > 0)
        if wrong.any():
            worst = int(np.argmax(wrong * np.abs(self.offset - self.crank * sin)))
            reach = np.abs(self.offset - self.crank * sin)[worst]
            raise KinematicsError(
                f"the linkage cannot move at a crank angle of {math.degrees(phi[worst]):.6g}°: the rod of "
                f"{np.broadcast_to(self.rod, phi.shape)[worst]:g} mm has to be longer than {reach:.6g} mm"
            )
        rates = _rates(cos, sin, w, self.crank, self.offset)
        # The coupler never turns past ±90° of the slide, or of its opposite: the angle has no jumps.
        sigma = np.arctan((self.offset - self.crank * sin) / w) + np.where(self.branch > 0, 0.0, math.pi)
        return self._moving(phi, omega, sigma, w, rates)

    def _smoothly(self, phi: Array, angle: Array, omega: float | Turning) -> "Bodies":
        w, turn, bend, third = rod_at_limit(self.crank, self.offset, self.branch, angle, -self.direction)
        x, y = self.crank * np.cos(angle), self.crank * np.sin(angle)
        t = self.offset - y
        sigma = np.unwrap(np.arctan2(t, w))
        return self._moving(phi, omega, sigma, w, _slide(x, y, t, w, turn, bend, third))

    def _moving(
        self, phi: Array, omega: float | Turning, sigma: Array, w: Array, rates: tuple[Array, ...]
    ) -> "Bodies":
        """The bodies over time, from what is known per crank radian."""
        s, v, acceleration, jerk, turn, bend, third = rates
        drive = omega if isinstance(omega, Turning) else Turning.of(phi, omega)
        along = np.exp(1j * self.direction)
        crank = BodyMotion.about(0j, drive)
        rod = BodyMotion(
            crank.point(self.crank), Turning(sigma + self.direction, *drive.carried(turn, bend, third))
        )
        pin = PointMotion(
            (s + 1j * self.offset) * along,
            *(rate * along for rate in drive.carried(v, acceleration, jerk)),
        )
        return Bodies(crank, rod, BodyMotion.sliding(pin, self.direction), s, w)


@dataclass(frozen=True, slots=True)
class Bodies:
    """The moving bodies at (n,) samples.

    Parameters
    ----------
    crank
        Origin in A0, x towards A.
    rod
        Origin in A, x towards B.
    slider
        Origin in B, x along the slide.
    position
        Slide position s (n,), mm.
    coupler_x
        w (n,), the rod's extent along the slide, mm, below 0 for the branch -1.
    """

    crank: BodyMotion
    rod: BodyMotion
    slider: BodyMotion
    position: Array
    coupler_x: Array
