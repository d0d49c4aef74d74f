"""Motion of the links of a dyad, in closed form up to the jerk, for each kind of joints.

A pin at P₁ (place a of its link) and the inner joint are known in the frames of the links; what is sought are
the two unknown rates of each order, from two linear equations whose determinant is the sine of the
transmission angle times lengths. It is NaN where the dyad does not close, and at a dead point the rates are
infinite.

RRR: :func:`mechwright.mechanics.planar.dyad.joined`. RRP, with n = e^{iβ} along the slide, the pin at
C = Q + (σ + i h) n and the bar z = C - P₁: σ = Re d + b √(l² - (h - Im d)²), d = (P₁ - Q)/n. RPR:
P₂ - P₁ = (σ + i h) n. PRP and RPP: Q₁ + (s₁ + i h₁) n₁ = Q₂ + (s₂ + i h₂) n₂.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.planar.dyad import continuous, joined
from mechwright.mechanics.planar.rigid import BodyMotion, Plane, PointMotion, Turning

Solved = tuple[BodyMotion, BodyMotion, Array]
"""Both links, and the sine (...) of the transmission angle: 0 at a dead point."""


@dataclass(frozen=True)
class Slide:
    """A line that moves: a point of it, its direction, and the offset h of what slides on it, mm."""

    point: PointMotion
    turning: Turning
    offset: Any = 0.0

    def at(self, way: "Way") -> PointMotion:
        """What has slid so far along it: Q + (σ + i h) n, and its rates."""
        n, turning, q = self.turning.direction, self.turning, self.point
        first, second, third = turning.velocity_factor, turning.acceleration_factor, turning.jerk_factor
        lever = way.value + 1j * self.offset
        return PointMotion(
            q.position + lever * n,
            q.velocity + (first * lever + way.first) * n,
            q.acceleration + (second * lever + 2 * first * way.first + way.second) * n,
            q.jerk + (third * lever + 3 * second * way.first + 3 * first * way.second + way.third) * n,
        )


@dataclass(frozen=True)
class Way:
    """A way along a slide, mm, and its three rates (...)."""

    value: Array
    first: Array
    second: Array
    third: Array


def body_at(pin: PointMotion, place: Any, turning: Turning) -> BodyMotion:
    """The link that turns so and has its ``place`` at a pin."""
    return BodyMotion(BodyMotion(pin, turning).point(-np.asarray(place, dtype=complex)), turning)


def turned(turning: Turning, angle: Any) -> Turning:
    """The same turning counted from another angle, rad."""
    return Turning.of(turning.theta + angle, turning.omega, turning.alpha, turning.jerk)


def pins(
    one: PointMotion, two: PointMotion, places: tuple[tuple[Any, Any], tuple[Any, Any]], branch: Any
) -> Solved:
    """RRR: two bars from P₁ and P₂ to a common pin; ``places`` are outer and inner pin of each in its link."""
    bars = [np.asarray(inner, complex) - outer for outer, inner in places]
    lengths = [np.abs(bar) for bar in bars]
    first, second = joined(one, two, lengths[0], lengths[1], branch)
    found = [
        body_at(pin, outer, turned(bar.turning, -np.angle(vector)))
        for pin, (outer, _), bar, vector in zip((one, two), places, (first, second), bars, strict=True)
    ]
    sine = (np.conj(first.turning.direction) * second.turning.direction).imag
    return found[0], found[1], np.abs(sine)


def pin_and_slide(
    pin: PointMotion, places: tuple[Any, Any], slide: Slide, second: tuple[Any, Any], branch: Any
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
        b1, a2, a3 = turning.velocity_factor, turning.acceleration_factor, turning.jerk_factor
        right = (q.velocity - pin.velocity) / n + b1 * e
        w1, s1 = _bar_rates(right, z)
        right = (q.acceleration - pin.acceleration) / n + a2 * e + 2 * b1 * s1 + w1**2 * z
        w2, s2 = _bar_rates(right, z)
        right = (q.jerk - pin.jerk) / n + a3 * e + 3 * a2 * s1 + 3 * b1 * s2 + (3 * w1 * w2 + 1j * w1**3) * z
        w3, _ = _bar_rates(right, z)
    own = Turning.of(continuous(np.angle(z * n)) - np.angle(bar), w1, w2, w3)
    first = body_at(pin, outer, own)
    place, angle = second
    return first, body_at(first.point(inner), place, turned(turning, -angle)), np.abs(along) / length


def _bar_rates(right: Plane, z: Plane) -> tuple[Array, Array]:
    """Rate of the bar, and of the way along the slide, that i ω z - σ' = right gives."""
    rate = right.imag / z.real
    return rate, -rate * z.imag - right.real


def slide_between(
    one: PointMotion, two: PointMotion, offset: Any, links: tuple[tuple[Any, Any], ...], branch: Any
) -> Solved:
    """RPR: links pinned at P₁ and P₂ that slide on each other; P₂ - P₁ = (σ + i ``offset``) n.

    ``links`` are the pin in each link, and the angle of the slide's direction in it.
    """
    apart = two.position - one.position
    distance = np.abs(apart)
    with np.errstate(invalid="ignore", divide="ignore"):
        sigma = branch * np.sqrt(distance**2 - np.asarray(offset) ** 2)
        e = sigma + 1j * offset
        n = apart / e
        n = n / np.abs(n)
        x = (two.velocity - one.velocity) / n
        b1, s1 = _swing_rates(x, sigma, offset)
        x = (two.acceleration - one.acceleration) / n - 2j * b1 * s1 + b1**2 * e
        b2, s2 = _swing_rates(x, sigma, offset)
        x = (two.jerk - one.jerk) / n - 3j * b1 * s2 - 3 * (1j * b2 - b1**2) * s1
        x = x + (3 * b1 * b2 + 1j * b1**3) * e
        b3, _ = _swing_rates(x, sigma, offset)
    turning = Turning.of(continuous(np.angle(n)), b1, b2, b3)
    (a, first), (b, second) = links
    bodies = body_at(one, a, turned(turning, -first)), body_at(two, b, turned(turning, -second))
    return *bodies, np.abs(sigma) / distance


def _swing_rates(x: Plane, sigma: Array, offset: Any) -> tuple[Array, Array]:
    """Rates of the slide's direction and of the way along it, from i β' e + σ' = x."""
    rate = x.imag / sigma
    return rate, x.real + rate * offset


def crossing(one: Slide, two: Slide) -> tuple[PointMotion, Array]:
    """PRP and RPP: the point that has slid along two lines with known directions, and the sine between them.

    Its rates follow from s₁⁽ᵏ⁾ n₁ - s₂⁽ᵏ⁾ n₂ = R of each order.
    """
    n1, n2 = one.turning.direction, two.turning.direction
    sine = (n1 * np.conj(n2)).imag
    zero = np.zeros(np.broadcast(sine, one.point.position).shape)
    ways = [Way(zero, zero, zero, zero), Way(zero, zero, zero, zero)]
    with np.errstate(invalid="ignore", divide="ignore"):
        for order in ("value", "first", "second", "third"):
            here, there = (slide.at(way) for slide, way in zip((one, two), ways, strict=True))
            rate = _RATES[order]
            right = getattr(there, rate) - getattr(here, rate)
            along = (right * np.conj(n2)).imag / sine, (right * np.conj(n1)).imag / sine
            ways = [Way(**{**_fields(way), order: value}) for way, value in zip(ways, along, strict=True)]
    return one.at(ways[0]), np.abs(sine)


_RATES = {"value": "position", "first": "velocity", "second": "acceleration", "third": "jerk"}


def _fields(way: Way) -> dict[str, Array]:
    return {"value": way.value, "first": way.first, "second": way.second, "third": way.third}
