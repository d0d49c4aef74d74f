"""Which spring holds a follower, and where it hooks.

Every spring of the table is tried on a few tails. Its pins are as near to each other as keeps the follower on
its cam over the whole turn with a tenth of reserve, also where the maker's force is a tenth below the
calculated one. A spring is fit where coils and hooks bear the force that swings between its two lengths. Of
those that press least, the shortest one is chosen.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from mechwright import Array, kept
from mechwright.mechanics.laws import Rates
from mechwright.standards.circlips import shaft_circlips
from mechwright.standards.spring_strength import fatigue_safety
from mechwright.standards.springs import SCATTER, ExtensionSpring, extension_springs
from mechwright_cam_follower.field_kinds import AUTO
from mechwright_cam_follower.kinematics.mechanism import Mechanism, mechanism_of
from mechwright_cam_follower.parameters import CamParams
from mechwright_cam_follower.parts.slide_dimensions import pin_place
from mechwright_cam_follower.spring.hooks import NECK, POSTS, SLIP, Hooks, MountedSpring, pin_for

SAFE = 1.2
"""Least safety of coils and hooks against fatigue."""

TAUT = 0.5
"""By how much a spring is stretched at least, mm: its hooks never come off their pins."""

BESIDE = 1.5
"""Between the spring and what is on the lever's shaft, mm."""

APART = 4.0
"""Between the standing pin and the lever, mm."""

TAILS = (1.0, 1.25, 1.6, 2.0)
"""Tails that are tried, in shares of the shortest that passes the lever's shaft."""

STATIONS = 361
"""Places of a turn at which the spring is compared with what the follower asks."""

HEADS = 5.0
"""Height of the screws of a carriage with their washers, over which the spring of a slide lies, mm."""

RESERVE = 1.1
"""A tenth more than the follower asks: of every spring that the program names or chooses."""

ALIKE = 1.15
"""Springs that press up to so much more than the weakest count as alike, and the shortest is taken."""

_HALVINGS = 20


def inertia_at(m: Mechanism, acceleration: Array) -> Array:
    """Force or torque, N or N·m, that an acceleration of the follower asks for, mm/s² or rad/s²."""
    return np.asarray((m.value("mass") / 1000 if m.slides else m.value("inertia")) * acceleration)


def load_of(m: Mechanism) -> Any:
    """Constant force or torque that presses the follower, N or N·m."""
    return m.value("load" if m.slides else "load_torque")


@dataclass(frozen=True)
class Demand:
    """What a follower asks of its spring at lifts (k,): N of a slide, N m of a lever."""

    lift: Array
    press: Array

    @classmethod
    def of(cls, m: Mechanism) -> "Demand":
        """Over a turn."""
        rates: Rates = m.cycle.at(np.linspace(0.0, math.tau, STATIONS))
        return cls(rates.s, -(inertia_at(m, rates.a * m.omega**2) + load_of(m)))

    def lacks(self, press: Array) -> Array:
        """What springs that press so, (n, k), lack at the worst place, (n, 1); below 0 they lack nothing."""
        need = np.where(self.press > 0, RESERVE * self.press, self.press)
        return np.asarray((need - (1 - SCATTER) * press).max(axis=-1, keepdims=True))


@kept
def mounted_spring(params: CamParams) -> MountedSpring | None:
    """The spring of a design that has a bought one; None where none of the table holds the follower."""
    m = mechanism_of(params)
    found = [one for one in _candidates(m) if _fits(m, one)]
    if not found:
        return None
    top = np.array(m.stroke)
    least = min(float(one.press(top)) for one in found)
    alike = [one for one in found if one.press(top) <= ALIKE * least]
    return min(alike, key=lambda one: (float(one.length(top)) + one.hooks.tail, one.spring.mass))


def spring_tail(m: Mechanism) -> float:
    """From the axis of a lever to its spring's pin, mm; 0 without one."""
    mounted = None if m.given.spring is None else mounted_spring(m.given)
    return 0.0 if mounted is None else mounted.hooks.tail


def nearest(params: CamParams) -> tuple[MountedSpring, float] | None:
    """The fit spring that lacks least, stretched as far as it may be, and what it lacks; None without one."""
    m = mechanism_of(params)
    asked = Demand.of(m)
    found = [(one, asked.lacks(one.press(asked.lift)).item()) for one in _stretched(m) if _fits(m, one)]
    return min(found, key=lambda one: one[1], default=None)


def springs_for(params: CamParams) -> tuple[ExtensionSpring, ...]:
    """Those that are tried: the named one, or all."""
    every = extension_springs()
    return every if params.spring == AUTO else tuple(one for one in every if one.name == params.spring)


def tails_of(m: Mechanism, spring: ExtensionSpring) -> tuple[float, ...]:
    """Tails that are tried, mm: the spring passes the lever's shaft and what is on it."""
    if m.slides:
        return (0.0,)
    bore = m.given.pivot_bore
    ring = max((one.room for one in shaft_circlips() if one.size <= bore), default=bore)
    least = max(ring, bore) / 2 + spring.outside / 2 + BESIDE
    wall = (bore + pin_of(m, spring)) / 2 + m.given.least_wall
    return tuple(float(math.ceil(share * max(least, wall))) for share in TAILS)


def pin_of(m: Mechanism, spring: ExtensionSpring) -> float:
    """The thickest pin over which its hooks slip, and beside which the follower has its wall, mm."""
    return pin_for(spring, m.given.follower_width - 2 * m.given.least_wall)


def _hooked(m: Mechanism) -> Iterator[tuple[list[ExtensionSpring], float]]:
    """Springs that share a tail."""
    shared: dict[float, list[ExtensionSpring]] = {}
    for one in springs_for(m.given):
        for tail in tails_of(m, one):
            shared.setdefault(tail, []).append(one)
    for tail, springs in shared.items():
        yield springs, tail


def _mounted(m: Mechanism, spring: ExtensionSpring, hooks: Hooks) -> MountedSpring:
    top, under = m.given.thickness, HEADS if m.slides else 0.0
    if not m.flat:
        top += m.given.axial_gap + m.given.follower_thickness
    return MountedSpring(spring, hooks, pin_of(m, spring), m.stroke, top, under)


def _column(values: Iterator[float]) -> Array:
    return np.array([*values])[:, None]


def _candidates(m: Mechanism) -> Iterator[MountedSpring]:
    """Every spring with its pins as near to each other as holds the follower."""
    asked = Demand.of(m)
    middle = 0.0 if m.slides else m.stroke / 2
    for springs, tail in _hooked(m):
        rate, initial = _column(s.rate for s in springs), _column(s.initial for s in springs)
        slack = _column(NECK * pin_of(m, s) - s.free for s in springs)
        low = _column(_least_apart(m, s, tail) for s in springs)
        high = _column(s.longest for s in springs) + m.stroke * max(tail, 1.0)

        def lacks(
            apart: Array, tail: float = tail, rate: Any = rate, f0: Any = initial, d: Any = slack
        ) -> Array:
            hooks = Hooks(tail, apart, middle)
            pull = f0 + rate * (hooks.distance(asked.lift) + d)
            return asked.lacks(pull * hooks.lever(asked.lift) * hooks.scale)

        enough = lacks(low) < 0
        near, far = low.copy(), high
        for _ in range(_HALVINGS):
            half = (near + far) / 2
            short = lacks(half) >= 0
            near, far = np.where(short, half, near), np.where(short, far, half)
        apart = np.ceil(np.where(enough, low, far) * 10)[:, 0] / 10
        holds = (lacks(apart[:, None]) < 0)[:, 0]
        for spring, distance in zip(np.array(springs, dtype=object)[holds], apart[holds], strict=True):
            yield _mounted(m, spring, Hooks(tail, float(distance), middle))


def _stretched(m: Mechanism) -> Iterator[MountedSpring]:
    """Every spring with its pins so far apart that it is as long as a static load allows."""
    middle = 0.0 if m.slides else m.stroke / 2
    for springs, tail in _hooked(m):
        for spring in springs:
            ends = (
                _mounted(m, spring, Hooks(tail, float(one), middle)) for one in _distances(m, spring, tail)
            )
            safe = [one for one in ends if _fits(m, one)]
            if safe:
                yield safe[-1]


def _distances(m: Mechanism, spring: ExtensionSpring, tail: float) -> Array:
    return np.linspace(_least_apart(m, spring, tail), spring.longest, 25)


def _least_apart(m: Mechanism, spring: ExtensionSpring, tail: float) -> float:
    """Distance of the pins in the middle at which the spring is taut at the lowest place."""
    least = float(spring.free + TAUT - NECK * pin_of(m, spring))
    if m.slides:
        return least
    half = m.stroke / 2
    across = tail * (1 - math.cos(half))
    clear = m.given.follower_width / 2 + POSTS[-1] / 2 + APART
    return max(math.sqrt(max(least**2 - across**2, 0.0)), clear) + tail * math.sin(half)


def _room(m: Mechanism) -> float:
    """Greatest distance of the pins of a slide's spring, mm: the standing one is clear of the cam's shaft."""
    bore = m.given.bore
    ring = max((one.room for one in shaft_circlips() if one.size <= bore), default=bore)
    beside = max(ring, bore) / 2 + POSTS[-1] / 2 + BESIDE
    pin: float = m.start + pin_place(m)
    # A slide that is off the axis passes the shaft at that distance.
    return pin - math.sqrt(max(beside**2 - m.offset**2, 0.0))


def _fits(m: Mechanism, one: MountedSpring) -> bool:
    """Whether coils, hooks and pins bear the force at both ends of the lift, and the pins have room."""
    ends = np.array([0.0, m.stroke])
    low, high = one.pull(ends)
    length = float(one.length(ends).max())
    spring = one.spring
    if length > spring.longest or one.length(ends).min() < spring.free + TAUT / 2:
        return False
    if m.slides and one.hooks.apart > _room(m):
        return False
    most = min(spring.inside - SLIP, m.given.follower_width - 2 * m.given.least_wall)
    if one.pin > most or one.post is None:
        return False
    return fatigue_safety(float(low), float(high), spring.wire, spring.mean) >= SAFE
