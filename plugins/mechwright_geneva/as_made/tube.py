"""How far the wheel can turn while the roller stands in its slot, exactly.

The roller's centre may be as far from its way over the wheel as half the clearance: in a tube about the way.
Turning the wheel by x carries the centre along a circle about the wheel's axis; the play to one side ends
where that circle first leaves the tube. Where the lever of the slot on the wheel is h, x is half the
clearance over h; where there is none, at mid stroke of a curved slot, it goes with the square root, and only
the tube is right.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial import cKDTree

from mechwright import Array
from mechwright_geneva.kinematics.geometry import Points, Stroke
from mechwright_geneva.kinematics.mechanism import Mechanism

BoolArray = NDArray[np.bool_]

_WAY = 8001
"""Points of the way among which the nearest is sought, before Newton's method."""

_BEYOND = 0.25
"""Crank angle, rad, by which the way goes on beyond both ends of the stroke."""

_STEPS, _HALVINGS, _NEWTON = 400, 40, 4
"""Steps out to the end of the tube; halvings of the step that leaves it; steps towards the nearest point."""

_LEAST_LEVER = 1e-9
"""mm: below, the lever is 0 and the square root decides."""

_REACH = 6.0
"""How far to look, in first orders or square roots of the play."""


@dataclass(frozen=True)
class Tube:
    """The tube of one slot.

    Parameters
    ----------
    mechanism
        The mechanism.
    half
        Half the clearance of roller and slot, mm, above 0.
    """

    mechanism: Mechanism
    half: float

    def play(self, at: ArrayLike) -> tuple[Array, Array]:
        """By how much, rad, the wheel can turn to and fro at crank angles (n,) from the start of a stroke."""
        angles = np.asarray(at, dtype=float)
        lever = np.maximum(np.abs(levers(self.mechanism, angles)), _LEAST_LEVER)
        reach = _REACH * np.minimum(self.half / lever, root(self.mechanism, self.half))
        there, back = self._to_end(angles, reach), self._to_end(angles, -reach)
        return there, back

    def _to_end(self, at: Array, reach: Array) -> Array:
        centre = _way(self.mechanism, at)[0]
        turns = reach[:, None] * np.linspace(0, 1, _STEPS + 1)
        inside = self._inside(centre[:, None] * np.exp(-1j * turns))
        each, first = np.arange(at.size), np.where(inside.all(axis=1), _STEPS, np.argmin(inside, axis=1))
        low, high = turns[each, first - 1], turns[each, first]
        for _ in range(_HALVINGS):
            middle = (low + high) / 2
            good = self._inside(centre * np.exp(-1j * middle))
            low, high = np.where(good, middle, low), np.where(good, high, middle)
        return np.asarray(np.abs(low), dtype=float)

    @cached_property
    def _angles(self) -> Array:
        return np.linspace(-_BEYOND, 2 * self.mechanism.crank_half + _BEYOND, _WAY)

    @cached_property
    def _tree(self) -> cKDTree:
        way = _way(self.mechanism, self._angles)[0]
        return cKDTree(np.column_stack([way.real, way.imag]))

    def _inside(self, points: Points) -> BoolArray:
        """Whether points (...) of the wheel are in the tube."""
        flat = points.ravel()
        best, nearest = self._tree.query(np.column_stack([flat.real, flat.imag]))
        at, step = self._angles[nearest], self._angles[1] - self._angles[0]
        for _ in range(_NEWTON):
            place, first, second = _way(self.mechanism, at)
            off = place - flat
            best = np.minimum(best, np.abs(off))
            slope = (np.conj(first) * off).real
            change = np.abs(first) ** 2 + (np.conj(second) * off).real
            at = at - np.clip(slope / np.where(change > 0, change, np.inf), -step, step)
        return np.asarray((best <= self.half).reshape(points.shape))


def normals(m: Mechanism, run: Stroke) -> Points:
    """Unit normal of the slot, fixed axes; of a straight slot also where the roller turns back in it."""
    if m.straight:
        return np.asarray(1j * run.centre / np.abs(run.centre))
    return run.normal


def levers(m: Mechanism, at: ArrayLike) -> Array:
    """Lever (...), mm, of the slot's normal on the wheel at crank angles of a stroke; signed."""
    run = m.stroke(np.asarray(at, dtype=float) / (2 * m.crank_half))
    return np.asarray((np.conj(run.centre) * normals(m, run)).imag)


def bend(m: Mechanism) -> float:
    """ρ² (κ + 1/ρ), mm, at mid stroke: half of it times x² is how far the way falls off the circle."""
    run = m.stroke(np.array([0.5]))
    rho = float(np.abs(run.centre[0]))
    away = math.copysign(1.0, float((np.conj(run.normal[0]) * run.centre[0]).real))
    return abs(rho * rho * (away * float(run.curvature[0]) + 1 / rho))


def root(m: Mechanism, half: float) -> float:
    """Play to one side at mid stroke of a curved slot, rad, to its first order: a square root."""
    return math.inf if m.straight else math.sqrt(2 * half / bend(m))


@dataclass(frozen=True, slots=True)
class Way:
    """The roller's way, fixed axes: centre, its first two derivatives over the wheel by the crank's angle.

    Parameters
    ----------
    place, first, second
        (...), mm and per radian of the crank.
    theta
        Angle (...) of the wheel, rad.
    """

    place: Points
    first: Points
    second: Points
    theta: Array

    @property
    def normal(self) -> Points:
        """The unit normal to the left; 0 where the roller turns back."""
        speed = np.abs(self.first)
        return np.asarray(1j * self.first / np.where(speed > 0, speed, np.inf))


def way(m: Mechanism, angle: ArrayLike) -> Way:
    """The way at crank angles (...), rad, from the start of a stroke; the wheel rests before and after."""
    at, end = np.asarray(angle, dtype=float), 2 * m.crank_half
    run = m.stroke(np.clip(at / end, 0, 1))
    arm = m.crank * np.exp(1j * (m.crank_half - at))
    resting = (at < 0) | (at > end)
    return Way(
        np.where(resting, m.axes - arm, run.centre),
        np.where(resting, 1j * arm, run.velocity),
        np.where(resting, arm, run.acceleration),
        run.theta,
    )


def _way(m: Mechanism, angle: Array) -> tuple[Points, Points, Points]:
    """The same in the wheel's frame."""
    found = way(m, angle)
    to_wheel = np.exp(-1j * found.theta)
    return found.place * to_wheel, found.first * to_wheel, found.second * to_wheel
