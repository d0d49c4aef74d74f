"""Search for the best train between bounds: differential evolution, many designs at once.

The score of a design is what is to be small. The length of the window jumps where an extreme of the speed
leaves the band, so that the best designs lie on ridges, which methods that follow a slope lose.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mechwright import Array
from mechwright.mechanics.gearing.checks import LEAST_RIM
from mechwright_elliptic_gears.kinematics.equations import Complex, Turning, train
from mechwright_elliptic_gears.kinematics.point import point_of_coupler, speed_of_q
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.layout import SPACER
from mechwright_elliptic_gears.rules.train import SWEEP_GAP, WALL

POPULATION, GENERATIONS = 32, 90
"""Designs at a time, and generations: two thirds of them find two free variables to 1e-3."""

WEIGHT, CROSSING = 0.7, 0.9
"""Step along differences, and the share of variables that a trial takes from it (the usual ones)."""

SAMPLES = 384
"""Of a turn: extremes of the speed are missed by 0.04 mm/s at 50 mm and 10 rad/s, of a band of 10."""

MISSED = 1e9
"""Score of a design that misses the wanted window, and more by how much: above any jerk that can be."""


UNBUILDABLE = 1e15
"""Score of a design that cannot be made, and more by how far: above any that misses a window."""

STEP_IN_TEETH = 0.9
"""Share of the largest module without undercut that is left by the next odd number of teeth, from 19 on."""

_RACK = EllipticGearParams()
"""The rack of the designs: that of all defaults."""


@dataclass(frozen=True)
class Designs:
    """Columns (n,): eccentricity, phase (rad), semi-major axis (mm), speed (rad/s) and place c of Q."""

    eccentricity: Array
    phase: Array
    semi_major: Array
    omega: Array
    c: Complex


def shortfall(designs: Designs, bore: float, cutter: float) -> Array:
    """How far (n,), in semi-major axes, each design is from one that can be made; 0 where it can, as a rule.

    The largest module without undercut is a (1 - e²) sin²α over the straight depth of the rack. With it the
    fillets must take the cutter; with the least module whose fillets do, bore and spacers need room to the
    near vertex; and the joint needs a wall to the shaft. ``check`` asks exactly.
    """
    a, e = designs.semi_major, designs.eccentricity
    sin = math.sin(math.radians(_RACK.pressure_angle))
    straight = _RACK.dedendum - _RACK.tip_radius * (1 - sin)
    largest = STEP_IN_TEETH * a * (1 - e * e) * sin * sin / straight
    depth = (_RACK.dedendum - _RACK.tip_radius) * largest
    mill = 2 * (_RACK.tip_radius * largest + depth**2 / (a / np.sqrt(1 - e * e) + depth))
    least = cutter / (2 * _RACK.tip_radius)
    rim = bore / 2 + (LEAST_RIM + _RACK.dedendum) * least
    sweep = SPACER * bore / 2 + SWEEP_GAP + _RACK.addendum * least
    joint = 0.75 * bore + WALL * bore
    short = np.stack((cutter - mill, max(rim, sweep) - a * (1 - e), joint - 2 * a * e))
    missing: Array = np.maximum(short, 0.0).sum(axis=0) / a
    return missing


def window_lengths(designs: Designs, band: float) -> Array:
    """Length (n,), rad, of each design's longest window, from samples; its ends are interpolated."""
    theta = 2 * np.pi * np.arange(SAMPLES) / SAMPLES
    scale = designs.semi_major * designs.omega
    speed = scale[:, None] * speed_of_q(
        theta, designs.eccentricity[:, None], designs.phase[:, None], designs.c[:, None]
    )
    return longest(speed, band) * (2 * np.pi / SAMPLES)


def peaks(designs: Designs, name: str) -> Array:
    """Greatest ``"acceleration"`` or ``"jerk"`` (n,) of Q among the samples."""
    theta = 2 * np.pi * np.arange(SAMPLES) / SAMPLES
    gear2 = Turning.of(theta, designs.omega[:, None])
    e = designs.eccentricity[:, None]
    _, gear4, gear5 = train(gear2, e, designs.phase[:, None])
    q = point_of_coupler(gear4, gear5, designs.semi_major[:, None], e, designs.c[:, None])
    top: Array = np.abs(getattr(q, name)).max(axis=1)
    return top


def longest(values: Array, band: float) -> Array:
    """Longest cyclic run (n,), in steps, within the band, of each row of values (n, samples)."""
    rows, samples = values.shape
    lows, highs = [values], [values]
    while 2 ** len(lows) <= samples:
        reach = 2 ** (len(lows) - 1)
        lows.append(np.minimum(lows[-1], np.roll(lows[-1], -reach, axis=1)))
        highs.append(np.maximum(highs[-1], np.roll(highs[-1], -reach, axis=1)))
    at, row = np.arange(samples), np.arange(rows)[:, None]
    length = np.zeros(values.shape, dtype=np.int64)
    low = np.full(values.shape, np.inf)
    high = -low
    for k in range(len(lows) - 1, -1, -1):
        there = (at + length) % samples
        new_low, new_high = np.minimum(low, lows[k][row, there]), np.maximum(high, highs[k][row, there])
        fits = (new_high - new_low <= band) & (length + 2**k <= samples)
        length = np.where(fits, length + 2**k, length)
        low, high = np.where(fits, new_low, low), np.where(fits, new_high, high)
    first, one = length.argmax(axis=1), np.arange(rows)
    count = length[one, first]
    lowest, highest = low[one, first], high[one, first]
    last = first + count - 1
    total = (count - 1).astype(np.float64)
    for inside, outside in ((first, first - 1), (last, last + 1)):
        near, far = values[one, inside % samples], values[one, outside % samples]
        goal = np.where(far > near, lowest + band, highest - band)
        part = (goal - near) / np.where(far == near, np.inf, far - near)
        total += np.clip(part, 0.0, 1.0)
    return np.where(count == samples, float(samples), total)


def evolve(score: Callable[[Array], Array], variables: int, rng: np.random.Generator) -> Array:
    """The best point (variables,) of the unit cube that one run of differential evolution finds.

    ``score`` takes points (n, variables) and gives what is to be small (n,).
    """
    if variables == 0:
        return np.empty(0)
    # Every part of each variable's range has one of the first designs (Latin hypercube).
    strata = rng.permuted(np.tile(np.arange(POPULATION), (variables, 1)), axis=1).T
    points = (strata + rng.random((POPULATION, variables))) / POPULATION
    scores = score(points)
    number = np.arange(POPULATION)
    for _ in range(GENERATIONS):
        # Three others of each: two of them span a step from the third or from the best.
        others = rng.random((POPULATION, POPULATION))
        others[number, number] = np.inf
        one, two, three = others.argsort(axis=1)[:, :3].T
        base = np.where((number % 2 == 0)[:, None], points[scores.argmin()], points[one])
        trial = base + WEIGHT * (points[two] - points[three])
        crossed = rng.random(points.shape) < CROSSING
        crossed[number, rng.integers(variables, size=POPULATION)] = True
        trial = np.where(crossed, trial, points)
        trial = 1 - np.abs(1 - np.abs(trial) % 2)  # reflected at the bounds
        found = score(trial)
        better = found <= scores
        points, scores = np.where(better[:, None], trial, points), np.where(better, found, scores)
    best: Array = points[scores.argmin()]
    return best
