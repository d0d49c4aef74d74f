"""Where a spring hooks, how long it is at a lift, and what it presses with.

The spring of a lever pulls at a pin on the lever's tail, which goes on beyond the lever's axis, away from the
roller or the face. The other pin stands so that the spring is square to the tail in the middle of the swing.
With the tail t, the distance l of the pins in the middle, and δ the swing from there

    a² = t² (1 - cos δ)² + (l + t sin δ)²
    da/dψ = t (t (1 - cos δ) sin δ + (l + t sin δ) cos δ)/a

a being the distance of the pins. By virtual work a spring of the force F presses with F da/dψ. The spring of
a slide lies along it, so a grows as the lift does.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from mechwright import Array, Step
from mechwright.standards.springs import ExtensionSpring

NECK = 0.8
"""Diameter of a pin's groove over the pin's."""

PINS = (10.0, 8.0, 6.0, 5.0, 4.0, 3.0)
"""Diameters of pins, mm."""

SLIP = 0.5
"""By how much a hook is wider than the pin over which it is slipped, mm."""


POSTS = (6.0, 8.0, 10.0, 12.0, 16.0)
"""Diameters of the pin that stands, below its upper end, mm."""

SHOULDER = 2.0
"""By how much it is thicker there, mm."""

FREE = 1.0
"""Between the spring and the lever under it, mm."""

ROOM, TIP = 0.25, 1.5
"""Of a groove beside the wire on either side, and length of a pin above it, mm."""

FOOT = 20.0
"""How far the pin that stands goes down below the cam's underside at most, mm."""

CEILING = 10.0
"""How far the pin that hangs goes up above the axis of its spring at most, mm."""

BENDING = 200.0
"""Bending stress of pins under a force that swells, MPa: two thirds of what steel bears for ever."""


def pin_for(spring: ExtensionSpring, most: float) -> float:
    """The thickest pin, at most so thick, over which its hooks slip, mm; the thinnest where none does."""
    return next(one for one in PINS if one <= min(spring.inside - SLIP, most) or one == PINS[-1])


def bends(force: float, arm: float, diameter: float) -> bool:
    """Whether a force, N, at the end of an arm, mm, is too much for a round pin, mm."""
    return 32 * force * arm / (math.pi * diameter**3) > BENDING


@dataclass(frozen=True)
class Hooks:
    """Two pins and the spring between them; numbers, or columns (n, 1) of n springs.

    Parameters
    ----------
    tail
        From the lever's axis to the pin, mm; 0 of a slide.
    apart
        Distance of the pins in the middle of the swing, of a slide at no lift, mm.
    middle
        Middle of the swing, rad; 0 of a slide.
    """

    tail: float
    apart: Any
    middle: float = 0.0

    def distance(self, lift: Array) -> Array:
        """Distance of the pins, mm, at lifts, mm or rad."""
        if self.tail == 0:
            return np.asarray(self.apart + lift)
        swing = lift - self.middle
        across, along = self.tail * (1 - np.cos(swing)), self.apart + self.tail * np.sin(swing)
        return np.asarray(np.hypot(across, along))

    def lever(self, lift: Array) -> Array:
        """Rate of the distance over the lift: mm/rad of a lever, 1 of a slide."""
        if self.tail == 0:
            return np.ones_like(lift)
        swing = lift - self.middle
        across, along = self.tail * (1 - np.cos(swing)), self.apart + self.tail * np.sin(swing)
        moved = across * np.sin(swing) + along * np.cos(swing)
        return np.asarray(self.tail * moved / np.hypot(across, along))

    @property
    def scale(self) -> float:
        """From what the lever gives to N m, or N."""
        return 1.0 if self.tail == 0 else 1e-3


@dataclass(frozen=True)
class MountedSpring:
    """A follower that a spring holds.

    Parameters
    ----------
    spring, hooks
        Which one, and where it hooks.
    pin
        Diameter of its pins, mm.
    stroke
        Greatest lift, mm or rad.
    top
        Height of the follower's upper face over the cam's underside, mm.
    under
        What lies on that face under the spring, mm.
    """

    spring: ExtensionSpring
    hooks: Hooks
    pin: float
    stroke: float
    top: float
    under: float = 0.0

    @property
    def neck(self) -> float:
        """Diameter of the groove of a pin, mm."""
        return round(NECK * self.pin, 3)

    @property
    def height(self) -> float:
        """Of the spring's axis over the follower's upper face, mm."""
        return self.under + FREE + self.spring.outside / 2

    @property
    def hangs(self) -> bool:
        """Whether the other pin hangs from above, as that of a slide; that of a lever stands."""
        return self.hooks.tail == 0

    @property
    def shank(self) -> float:
        """Height over the follower's upper face, mm, at which the other pin's shank ends."""
        return self.height + (1 if self.hangs else -1) * (FREE + self.spring.outside / 2)

    @property
    def strongest(self) -> float:
        """Force at the greatest lift, N."""
        return float(self.pull(np.array(self.stroke)))

    @property
    def post(self) -> float | None:
        """Diameter of the pin that stands, mm; None where none bears the spring."""
        force = self.strongest
        high = self.height + CEILING if self.hangs else self.top + self.height + FOOT
        if bends(force, self.height, self.pin):
            return None
        able = (one for one in POSTS if one >= self.pin + SHOULDER and not bends(force, high, one))
        return next(able, None)

    @property
    def head(self) -> tuple[Step, ...]:
        """The pin on the follower from its upper face on, with the groove for the hook."""
        return self._head(self.height)

    @property
    def post_head(self) -> tuple[Step, ...]:
        """The other pin from its shank on."""
        return self._head(FREE + self.spring.outside / 2)

    def _head(self, height: float) -> tuple[Step, ...]:
        wide = self.spring.wire + 2 * ROOM
        return (
            Step(self.pin, height - wide / 2),
            Step(self.neck, wide),
            Step(self.pin, max(TIP, self.spring.wire)),
        )

    def length(self, lift: Array) -> Array:
        """Length inside of the spring's hooks, mm."""
        return self.hooks.distance(lift) + self.neck

    def pull_at(self, apart: Any) -> Array:
        """Force of the spring, N, where its pins are so far apart, mm."""
        return np.asarray(self.spring.initial + self.spring.rate * (apart + self.neck - self.spring.free))

    def pull(self, lift: Array) -> Array:
        """Force of the spring, N."""
        return self.pull_at(self.hooks.distance(lift))

    def press(self, lift: Array) -> Array:
        """What it presses the follower with: N m of a lever, N of a slide."""
        return np.asarray(self.pull(lift) * self.hooks.lever(lift) * self.hooks.scale)
