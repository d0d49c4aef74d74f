"""Motion of the links of a dyad, in closed form up to the jerk, for each kind of joints.

A pin at P₁ (place a of its link) and the inner joint are known in the frames of the links; what is sought are
the two unknown rates of each order, from two linear equations whose determinant is the sine of the
transmission angle times lengths. It is NaN where the dyad does not close, and at a dead point the rates are
infinite.

RRR: :func:`mechwright.mechanics.planar.dyad.dyad`. RRP, with n = e^{iβ} along the slide, the pin at
C = Q + (σ + i h) n and the bar z = C - P₁: σ = Re d + b √(l² - (h - Im d)²), d = (P₁ - Q)/n. RPR:
P₂ - P₁ = (σ + i h) n. PRP and RPP: Q₁ + (s₁ + i h₁) n₁ = Q₂ + (s₂ + i h₂) n₂.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.planar.dyad import continuous, dyad
from mechwright.mechanics.planar.rigid import BodyMotion, Plane, PointMotion, Turning, carried

Solved = tuple[BodyMotion, BodyMotion, Array]
"""Both links, and the sine (...) of the transmission angle: 0 at a dead point."""


@dataclass(frozen=True)
class Slide:
    """A line that moves: a point of it, its direction, and the offset h of what slides on it, mm."""

    point: PointMotion
    turning: Turning
    offset: Any = 0.0

    def at(self, way: "Way", rates: int = 3) -> PointMotion:
        """What has slid so far along it: Q + (σ + i h) n, and its rates; those above ``rates`` are NaN."""
        n, turning, q = self.turning.direction, self.turning, self.point
        first, second = turning.velocity_factor, turning.acceleration_factor
        lever = way.value + 1j * self.offset
        position = q.position + lever * n
        velocity = acceleration = jerk = np.broadcast_to(
            np.complex128(complex(np.nan, np.nan)), position.shape
        )
        if rates > 0:
            velocity = q.velocity + (first * lever + way.first) * n
        if rates > 1:
            acceleration = q.acceleration + (second * lever + 2 * first * way.first + way.second) * n
        if rates > 2:
            rate = turning.jerk_factor * lever + 3 * second * way.first + 3 * first * way.second + way.third
            jerk = q.jerk + rate * n
        return PointMotion(position, velocity, acceleration, jerk)


@dataclass(frozen=True)
class Way:
    """A way along a slide, mm, and its three rates (...)."""

    value: Array
    first: Array
    second: Array
    third: Array


def body_at(pin: PointMotion, place: Any, turning: Turning, rates: int = 3) -> BodyMotion:
    """The link that turns so and has its ``place`` at a pin; rates above ``rates`` are NaN."""
    return BodyMotion(BodyMotion(pin, turning).point(-np.asarray(place, dtype=complex), rates), turning)


def turned(turning: Turning, angle: Any) -> Turning:
    """The same turning counted from another angle, rad."""
    theta = turning.theta + np.asarray(angle, dtype=float)
    parts = (np.broadcast_to(one, theta.shape) for one in (turning.omega, turning.alpha, turning.jerk))
    return Turning(theta, *parts)


def pins(
    one: PointMotion,
    two: PointMotion,
    places: tuple[tuple[Any, Any], tuple[Any, Any]],
    branch: Any,
    rates: int = 3,
) -> Solved:
    """RRR: two bars from P₁ and P₂ to a common pin.

    ``places`` are outer and inner pin of each bar in its link, ``rates`` the highest rate that is needed.
    """
    bars = [np.asarray(inner, complex) - outer for outer, inner in places]
    lengths = [np.abs(bar) for bar in bars]
    d = [
        getattr(two, order) - getattr(one, order)
        for order in ("position", "velocity", "acceleration", "jerk")[: rates + 1]
    ]
    found = []
    swings = dyad(d, lengths[0], lengths[1], branch, rates)
    for pin, (outer, _), swing, bar in zip((one, two), places, swings, bars, strict=True):
        theta = continuous(np.angle(swing.direction)) - np.angle(bar)
        turning = Turning(theta, swing.first, swing.second, swing.third)
        lever = -outer * np.exp(-1j * np.angle(bar)) * swing.direction
        found.append(BodyMotion(carried(pin, turning, lever, rates), turning))
    s, p = (swing.direction for swing in swings)
    return found[0], found[1], np.abs(s.real * p.imag - s.imag * p.real)


def pin_and_slide(
    pin: PointMotion,
    places: tuple[Any, Any],
    slide: Slide,
    second: tuple[Any, Any],
    branch: Any,
    rates: int = 3,
) -> Solved:
    """RRP: a bar from P₁ to a pin of a link that slides.

    Parameters
    ----------
    pin, places
        P₁, and outer and inner pin of the bar in its link.
    slide
        The line that stands already, with the offset of the inner pin from it.
    second
        Place of the inner pin in the sliding link, and the angle of that link against the slide's direction.
    branch
        The sign of the bar along the slide.
    rates
        The highest rate that is needed, 0 to 3; those above are NaN.
    """
    outer, inner = places
    bar = np.asarray(inner, complex) - outer
    length, q, turning, h = np.abs(bar), slide.point, slide.turning, slide.offset
    n = turning.direction
    d = (pin.position - q.position) / n
    with np.errstate(invalid="ignore", divide="ignore"):
        along = branch * np.sqrt(length**2 - (h - d.imag) ** 2)
        sigma = d.real + along
        z = along + 1j * (h - d.imag)  # the bar as seen along the slide
        e = sigma + 1j * h
        b1, a2 = turning.velocity_factor, turning.acceleration_factor
        w1 = w2 = w3 = np.broadcast_to(np.float64(np.nan), sigma.shape)
        if rates > 0:
            right = (q.velocity - pin.velocity) / n + b1 * e
            w1, s1 = _bar_rates(right, z)
        if rates > 1:
            right = (q.acceleration - pin.acceleration) / n + a2 * e + 2 * b1 * s1 + w1**2 * z
            w2, s2 = _bar_rates(right, z)
        if rates > 2:
            right = (q.jerk - pin.jerk) / n + turning.jerk_factor * e + 3 * a2 * s1 + 3 * b1 * s2
            w3, _ = _bar_rates(right + (3 * w1 * w2 + 1j * w1**3) * z, z)
    own = Turning.of(continuous(np.angle(z * n)) - np.angle(bar), w1, w2, w3)
    first = body_at(pin, outer, own, rates)
    place, angle = second
    slid = body_at(first.point(inner, rates), place, turned(turning, -angle), rates)
    return first, slid, np.abs(along) / length


def _bar_rates(right: Plane, z: Plane) -> tuple[Array, Array]:
    """Rate of the bar, and of the way along the slide, that i ω z - σ' = right gives."""
    rate = right.imag / z.real
    return rate, -rate * z.imag - right.real


def slide_between(
    one: PointMotion,
    two: PointMotion,
    offset: Any,
    links: tuple[tuple[Any, Any], ...],
    branch: Any,
    rates: int = 3,
) -> Solved:
    """RPR: links pinned at P₁ and P₂ that slide on each other; P₂ - P₁ = (σ + i ``offset``) n.

    ``links`` are the pin in each link, and the angle of the slide's direction in it; ``rates`` is the highest
    rate that is needed.
    """
    apart = two.position - one.position
    distance = np.abs(apart)
    with np.errstate(invalid="ignore", divide="ignore"):
        sigma = branch * np.sqrt(distance**2 - np.asarray(offset) ** 2)
        e = sigma + 1j * offset
        n = apart / e
        n = n / np.abs(n)
        b1 = b2 = b3 = np.broadcast_to(np.float64(np.nan), sigma.shape)
        if rates > 0:
            x = (two.velocity - one.velocity) / n
            b1, s1 = _swing_rates(x, sigma, offset)
        if rates > 1:
            x = (two.acceleration - one.acceleration) / n - 2j * b1 * s1 + b1**2 * e
            b2, s2 = _swing_rates(x, sigma, offset)
        if rates > 2:
            x = (two.jerk - one.jerk) / n - 3j * b1 * s2 - 3 * (1j * b2 - b1**2) * s1
            x = x + (3 * b1 * b2 + 1j * b1**3) * e
            b3, _ = _swing_rates(x, sigma, offset)
    turning = Turning.of(continuous(np.angle(n)), b1, b2, b3)
    (a, first), (b, second) = links
    swung = body_at(one, a, turned(turning, -first), rates), body_at(two, b, turned(turning, -second), rates)
    return *swung, np.abs(sigma) / distance


def _swing_rates(x: Plane, sigma: Array, offset: Any) -> tuple[Array, Array]:
    """Rates of the slide's direction and of the way along it, from i β' e + σ' = x."""
    rate = x.imag / sigma
    return rate, x.real + rate * offset


def crossing(one: Slide, two: Slide, rates: int = 3) -> tuple[PointMotion, Array]:
    """PRP and RPP: the point that has slid along two lines with known directions, and the sine between them.

    Its rates follow from s₁⁽ᵏ⁾ n₁ - s₂⁽ᵏ⁾ n₂ = R of each order; ``rates`` is the highest that is needed.
    """
    n1, n2 = one.turning.direction, two.turning.direction
    sine = (n1 * np.conj(n2)).imag
    zero = np.zeros(np.broadcast(sine, one.point.position).shape)
    ways = [Way(zero, zero, zero, zero), Way(zero, zero, zero, zero)]
    with np.errstate(invalid="ignore", divide="ignore"):
        for number, order in enumerate(("value", "first", "second", "third")[: rates + 1]):
            here, there = (slide.at(way, number) for slide, way in zip((one, two), ways, strict=True))
            rate = _RATES[order]
            right = getattr(there, rate) - getattr(here, rate)
            along = (right * np.conj(n2)).imag / sine, (right * np.conj(n1)).imag / sine
            ways = [Way(**{**_fields(way), order: value}) for way, value in zip(ways, along, strict=True)]
    return one.at(ways[0], rates), np.abs(sine)


_RATES = {"value": "position", "first": "velocity", "second": "acceleration", "third": "jerk"}


def _fields(way: Way) -> dict[str, Array]:
    return {"value": way.value, "first": way.first, "second": way.second, "third": way.third}
