"""Extension springs with a full hook at each end: sizes that are stocked, and what they bear."""

import difflib
import math
from dataclasses import dataclass
from functools import cache

from mechwright.contracts.bought import Bought
from mechwright.contracts.shape import Revolve, Shape, ring, slot
from mechwright.errors import DesignError
from mechwright.standards.spring_strength import (
    DENSITY,
    greatest_force,
    initial_stress,
    spring_rate,
)
from mechwright.standards.table import table

STANDARD = "EN 13906-2"
"""Of the calculation of extension springs; no standard fixes their sizes."""

HOOK = 0.8
"""Height of a hook inside, over the inside diameter of the coils."""

SCATTER = 0.1
"""Share by which a maker's force may differ at a length."""

_OVERLAP = 0.02
"""By how much a coil body is drawn higher than wide, mm."""


@dataclass(frozen=True)
class ExtensionSpring:
    """Diameter of the wire, outside diameter of the coils and free length inside of the hooks, mm."""

    wire: float
    outside: float
    free: float

    @property
    def name(self) -> str:
        """As a design file names it.

        >>> ExtensionSpring(1.25, 12.5, 50).name
        '1.25x12.5x50'
        """
        return f"{self.wire:g}x{self.outside:g}x{self.free:g}"

    @property
    def mean(self) -> float:
        """Mean diameter of the coils, mm."""
        return self.outside - self.wire

    @property
    def inside(self) -> float:
        """Inside diameter of coils and hooks, mm."""
        return self.outside - 2 * self.wire

    @property
    def hook(self) -> float:
        """Height of a hook inside, mm."""
        return HOOK * self.inside

    @property
    def coils(self) -> float:
        """Number of coils, which lie on each other: one wire more than coils is the body's length."""
        return (self.free - 2 * self.hook) / self.wire - 1

    @property
    def rate(self) -> float:
        """R, N/mm."""
        return spring_rate(self.wire, self.mean, self.coils)

    @property
    def initial(self) -> float:
        """Force at which the coils begin to part, N."""
        return initial_stress(self.wire, self.mean) * math.pi * self.wire**3 / (8 * self.mean)

    @property
    def greatest(self) -> float:
        """Force that it bears under a static load, N."""
        return greatest_force(self.wire, self.mean)

    @property
    def longest(self) -> float:
        """Length inside of the hooks at that force, mm."""
        return self.free + (self.greatest - self.initial) / self.rate

    @property
    def mass(self) -> float:
        """Of the wire of coils and hooks, g."""
        wound = math.pi * self.mean * (self.coils + 2)
        return round(DENSITY * math.pi / 4 * self.wire**2 * wound, 2)

    def bought(self, apart: float, pin: float) -> Bought:
        """How it is ordered, drawn over two pins of a diameter, mm, so far apart.

        The origin is the axis of one pin, and the other pin stands on +x.
        """
        end = self.inside / 2
        body = end - pin / 2 + end + self.wire / 2
        low, high = body, apart - body
        half = self.outside / 2 + _OVERLAP / 2
        hollow = self.inside / 2 + _OVERLAP / 2
        near, far = end - pin / 2, apart - end + pin / 2
        round_wire = ring(self.inside, self.outside, self.wire, -self.wire / 2).profile
        hooks = (Revolve(round_wire, (near, 0.0)), Revolve(round_wire, (far, 0.0)))
        coils = slot((low, high), self.outside, (-half, half))
        room = slot((low + self.wire, high - self.wire), self.inside, (-hollow, hollow))
        note = (
            f"rate {self.rate:.3g} N/mm, initial force {self.initial:.3g} N, at least {self.greatest:.3g} N "
            f"at {self.longest:.4g} mm; within {SCATTER:.0%} of these another maker's size serves as well"
        )
        words = (
            f"extension spring, wire {self.wire:g}, outside {self.outside:g}, {self.free:g} mm inside the "
            "full hooks, EN 10270-1 SM"
        )
        return Bought(words, STANDARD, self.mass, Shape((coils, *hooks), (room,)), note, stretched=True)


@cache
def extension_springs() -> tuple[ExtensionSpring, ...]:
    """All of them, from the thinnest wire."""
    return tuple(
        ExtensionSpring(row["wire"], row["outside"], free)
        for row in table("extension-springs").rows
        for free in row["lengths"]
    )


def extension_spring(name: str) -> ExtensionSpring:
    """The spring of a name; raises DesignError with the nearest names.

    >>> extension_spring("1x10x40").rate.__round__(3)
    0.533
    """
    found = {one.name: one for one in extension_springs()}
    if name not in found:
        near = difflib.get_close_matches(name, found, 3, 0.0)
        raise DesignError(f"no extension spring {name!r} in the table; such as {', '.join(near)}")
    return found[name]
