"""What an adjustable linkage shall do: points of each phase, and the limits of what can be built."""

import math
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.adjustable.mechanism import Pins, Unknowns, follow
from mechwright.mechanics.adjustable.space import Points
from mechwright.mechanics.tracing.order import isotonic

RANGE_SAMPLES, TURN_SAMPLES = 13, 36
"""Crank angles per phase at which the transmission angle is held: over the phase, or over a whole turn."""


@dataclass(frozen=True, slots=True)
class Limits:
    """Limits of a linkage, lengths in the space's unit.

    Parameters
    ----------
    least_transmission
        Of the acute transmission angle, rad.
    shortest, longest
        Of every link, the ground and the path point's distances from the coupler's joints.
    full_turn
        Whether the transmission angle is kept over a whole turn of the crank; else over each phase alone.
    least_chord
        Between the holes of two phases in one plate; 0 to leave them free.
    """

    least_transmission: float
    shortest: float
    longest: float
    full_turn: bool = False
    least_chord: float = 0.0


@dataclass(frozen=True, slots=True)
class Task:
    """Points that the path shall pass, those in the pose of setting left out.

    Parameters
    ----------
    unknowns
        The linkage.
    targets
        Points (n,) of all phases, one phase after the other.
    phase
        Phase (n,) of each, from 0.
    size
        Of the path: residuals are counted in it.
    limits
        Of the linkage.
    """

    unknowns: Unknowns
    targets: Points
    phase: np.ndarray
    size: float
    limits: Limits

    def made(self, x: Array) -> Pins:
        """The pins (..., phases) of unknowns (..., k)."""
        return self.unknowns.pins(x)

    def ordered(self, theta: Array, sense: Array) -> Array:
        """The nearest angles (s, n) that go one way from the pose of setting, within a turn in each phase."""
        found = theta * sense
        for phase in range(self.unknowns.phases):
            own = self.phase == phase
            found[:, own] = np.clip(isotonic(found[:, own]), 0.0, math.tau)
        return np.asarray(found * sense)

    def misses(self, x: Array, theta: Array) -> Array:
        """Differences (..., n, 2 or 3) from the points, in sizes of the path."""
        return self.missed(self.unknowns.pins(x), theta)

    def missed(self, pins: Pins, theta: Array) -> Array:
        """The same of pins (..., phases)."""
        found, _ = follow(self.unknowns.space, pins.of(self.phase), self.unknowns.ratio, theta)
        return self.unknowns.space.misses(found, self.targets) / self.size

    def excess(self, x: Array, theta: Array) -> Array:
        """By how much each limit is passed, (..., k); 0 where it is kept."""
        return self.exceeded(self.unknowns.pins(x), theta)

    def exceeded(self, pins: Pins, theta: Array) -> Array:
        """The same of pins (..., phases)."""
        sweep = self.sweep(theta)
        phases, samples = sweep.shape[-2:]
        number = np.repeat(np.arange(phases), samples)
        flat = sweep.reshape(*sweep.shape[:-2], -1)
        _, cosine = follow(self.unknowns.space, pins.of(number), self.unknowns.ratio, flat)
        pinched = np.maximum(np.abs(cosine) - math.cos(self.limits.least_transmission), 0.0)
        lengths = np.log(np.concatenate(self.lengths(pins), axis=-1) + 1e-300)
        beyond = np.maximum(lengths - math.log(self.limits.longest), 0.0)
        below = np.maximum(math.log(self.limits.shortest) - lengths, 0.0)
        found = [pinched / math.sqrt(samples), beyond, below]
        if self.limits.least_chord > 0 and self.unknowns.phases > 1:
            chords = np.concatenate(self.chords(pins), axis=-1)
            found.append(np.maximum(self.limits.least_chord - chords, 0.0) / self.size)
        return np.concatenate(found, axis=-1)

    def sweep(self, theta: Array) -> Array:
        """Crank angles (..., phases, samples) over which the transmission angle counts."""
        if self.limits.full_turn:
            turn = np.linspace(0.0, math.tau, TURN_SAMPLES, endpoint=False)
            return np.broadcast_to(turn, (*theta.shape[:-1], self.unknowns.phases, TURN_SAMPLES))
        ends = np.stack([theta[..., self.phase == k][..., -1] for k in range(self.unknowns.phases)], axis=-1)
        return np.asarray(ends[..., None] * np.linspace(0.0, 1.0, RANGE_SAMPLES))

    def lengths(self, pins: Pins) -> list[Array]:
        """Links, ground and the path point's distances, each (..., phases)."""
        apart = self.unknowns.space.apart
        found = [
            apart(pins.a0, pins.a), apart(pins.a, pins.c), apart(pins.b1, pins.c), apart(pins.a0, pins.b0),
        ]  # fmt: skip
        return found + ([apart(pins.b0, pins.b1)] if self.unknowns.bars == 5 else [])

    def dimensions(self, pins: Pins) -> Array:
        """Lengths that all phases have in common, (..., m): see ``mechwright.mechanics.tracing.stepped``.

        Crank, follower or rocker, and the arm; with moving pivots the ground, with fixed ones the coupler.
        """
        apart, unknowns = self.unknowns.space.apart, self.unknowns
        found = [apart(pins.a0, pins.a), apart(pins.b1, pins.c)]
        found += [apart(pins.b0, pins.b1)] if unknowns.bars == 5 else []
        found += [apart(pins.a0, pins.b0)] if unknowns.moves == "moving" else []
        found += [apart(pins.a, pins.c)] if unknowns.moves == "fixed" else []
        return np.stack([one[..., 0] for one in found], axis=-1)

    def chords(self, pins: Pins) -> list[Array]:
        """Distances (..., pairs) between the places of each pivot that is set."""
        pairs = list(combinations(range(self.unknowns.phases), 2))
        if not pairs:
            return []
        one, two = (np.array(row) for row in zip(*pairs, strict=True))
        names = {"moving": ("a", "c"), "fixed": ("a0", "b0"), "both": ("a", "c", "a0", "b0")}
        places = [getattr(pins, name) for name in names[self.unknowns.moves]]
        return [self.unknowns.space.apart(at[..., one], at[..., two]) for at in places]
