"""Figures that a linkage is chosen for: of the paths of its points, and of the motion of its output.

Paths and outputs are sampled once over the input, with the rates per unit of the input; figures are those of
the curve between the samples. Leading axes are designs. A design that does not close at every sample has NaN.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.mechanics.linkage.kinematics.curves import Curve
from mechwright.mechanics.planar.dynamics import GROUND
from mechwright.mechanics.planar.machine import Machine, Prismatic
from mechwright.mechanics.planar.positions import Solution
from mechwright.mechanics.planar.relative_motion import relative
from mechwright.mechanics.planar.rigid import PointMotion

NODES, WEIGHTS = np.polynomial.legendre.leggauss(6)


@dataclass(frozen=True)
class Extremes:
    """Least and greatest value of a curve (...,), and the inputs at which they are, rad."""

    least: Array
    least_at: Array
    greatest: Array
    greatest_at: Array

    @property
    def extent(self) -> Array:
        """Their difference: the stroke of what slides, the swing of what turns."""
        return np.asarray(self.greatest - self.least)


def extremes(curve: Curve, begin: Any = None, end: Any = None) -> Extremes:
    """The extremes of a curve over all of its input, or from one input to another.

    Over whole turns ``end`` may be below ``begin``: the stretch then goes through the end of the samples.

    >>> at = np.linspace(0.0, 7.0, 15)
    >>> wave = Curve(at, np.sin(at), np.cos(at), -np.sin(at), -np.cos(at))
    >>> found = extremes(wave)
    >>> bool(abs(found.greatest_at - np.pi / 2) < 1e-6), bool(abs(found.extent - 2) < 1e-9)
    (True, True)
    """
    start = curve.at[0] if begin is None else begin
    stop = curve.at[-1] if end is None else end
    inner, _ = curve.roots(1)
    whole = begin is None and end is None
    inner = inner if whole else np.where(_within(curve, inner, start, stop), inner, np.nan)
    designs = curve.value.shape[:-1]
    ends = np.broadcast_to(np.array([start, stop], float), (*designs, 2))
    inputs = np.concatenate([ends, inner], axis=-1)
    values = curve.at_input(np.where(np.isnan(inputs), start, inputs))
    if whole:  # the last sample is not the first one again where a link has turned
        values[..., :2] = curve.value[..., [0, -1]]
    values = np.where(np.isnan(inputs), np.nan, values)
    low, high = (
        np.argmin(np.where(np.isnan(values), np.inf, sign * values), axis=-1)[..., None] for sign in (1, -1)
    )
    closes = np.isfinite(curve.value).all(axis=-1)

    def taken(table: Array, place: NDArray[np.intp]) -> Array:
        return np.where(closes, np.take_along_axis(table, place, axis=-1)[..., 0], np.nan)

    return Extremes(taken(values, low), taken(inputs, low), taken(values, high), taken(inputs, high))


def _within(curve: Curve, inputs: Array, begin: float, end: float) -> NDArray[np.bool_]:
    if not curve.closed:
        return np.asarray((begin <= inputs) & (inputs <= end))
    stretch = end - begin if 0 <= end - begin <= curve.span else (end - begin) % curve.span
    return np.asarray((inputs - begin) % curve.span <= stretch)


def reversals(curve: Curve) -> Array:
    """Inputs (..., k), rad, at which an output turns back, in rising order; NaN where a design has fewer."""
    return curve.roots(1)[0]


@dataclass(frozen=True)
class Stroke:
    """How far an output goes over a turn of the input.

    Parameters
    ----------
    extremes
        Both ends: mm of what slides, rad of what turns.
    forward
        From the least to the greatest value the input turns by this, rad (...,), in the sense of its angles.
    time_ratio
        The longer of the ways forward and back over the shorter one, at constant speed of the input; NaN
        where the output does not turn back.
    """

    extremes: Extremes
    forward: Array
    time_ratio: Array


def stroke(curve: Curve) -> Stroke:
    """The stroke of an output over a whole turn; raises ValueError where the samples are no whole turn."""
    if not curve.closed:
        raise ValueError(f"inputs from {curve.at[0]:g} to {curve.at[-1]:g} rad are no whole turn")
    ends, turns = extremes(curve), curve.roots(1)[0]
    back = np.isfinite(turns).any(axis=-1)
    forward = np.where(back, np.mod(ends.greatest_at - ends.least_at, curve.span), np.nan)
    rest = curve.span - forward
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.maximum(forward, rest) / np.minimum(forward, rest)
    return Stroke(ends, forward, ratio)


def output_curve(machine: Machine, found: Solution, at: Array, output: str) -> Curve:
    """The motion of an output: its slide on the ground in mm, where it has one; else its angle in rad."""
    for joint in machine.between(output, GROUND):
        if isinstance(joint, Prismatic):
            seen = relative(found.bodies[joint.block], found.bodies[joint.guide]).point(joint.point)
            from_line = PointMotion(seen.position - joint.line, seen.velocity, seen.acceleration, seen.jerk)
            turn = np.exp(-1j * np.asarray(joint.line_angle))
            rates = (from_line.position, from_line.velocity, from_line.acceleration, from_line.jerk)
            return Curve.of_point(at, PointMotion(*(one * turn for one in rates)))
    return Curve.of_turning(at, found.bodies[output].turning)


@dataclass(frozen=True)
class Path:
    """The path of a point in a frame whose X has a direction: along it and to the left of it, mm."""

    along: Curve
    across: Curve

    @classmethod
    def of(cls, at: Array, point: PointMotion, direction: Any = 0.0) -> "Path":
        """The path over inputs (n,), rad; rates are those per unit of the input."""
        turned = direction + np.pi / 2
        return cls(Curve.of_point(at, point, direction), Curve.of_point(at, point, turned))


def path_length(path: Path) -> Array:
    """The length (...,) of a path over all of its input, mm: Gauss's rule in each interval."""
    x, y = path.along.derived(1), path.across.derived(1)
    shares = (NODES + 1) / 2
    powers = shares ** np.arange(x.shape[-1])[:, None]
    speed = np.hypot(x @ powers, y @ powers)
    return np.asarray((speed @ WEIGHTS / 2 * np.diff(path.along.at)).sum(axis=-1))


@dataclass(frozen=True)
class Straightness:
    """How straight a stretch of a path is.

    Parameters
    ----------
    across
        Extremes of the path across its direction, over the stretch.
    ends
        Places (..., 2) of both ends of the stretch along the direction, mm.
    """

    across: Extremes
    ends: Array

    @property
    def band(self) -> Array:
        """Width (...,) of the band along the direction that the stretch is in, mm."""
        return self.across.extent

    @property
    def length(self) -> Array:
        """Distance (...,) of both ends along the direction, mm."""
        return np.asarray(np.abs(self.ends[..., 1] - self.ends[..., 0]))


def straightness(path: Path, begin: float, end: float) -> Straightness:
    """How straight a path is along its direction from one input to another, rad."""
    return Straightness(extremes(path.across, begin, end), path.along.at_input(np.array([begin, end])))


@dataclass(frozen=True)
class Stance:
    """The part of a leg's path in which the foot is low.

    Parameters
    ----------
    begin, end
        Inputs (...,), rad, between which the foot stays below the height over its lowest point, about this
        point; ``end`` is the greater one.
    share
        Share (...,) of the turn from ``begin`` to ``end``.
    whole_share
        Share (...,) of the turn in which the foot is below the height, other dips included.
    ends
        Places (..., 2) along the path's direction there, mm.
    """

    begin: Array
    end: Array
    share: Array
    whole_share: Array
    ends: Array

    @property
    def travel(self) -> Array:
        """Way (...,) of the foot along the direction from ``begin`` to ``end``, mm."""
        return np.asarray(np.abs(self.ends[..., 1] - self.ends[..., 0]))


@dataclass(frozen=True)
class Gait:
    """What a leg's path is like: stride along and lift across the direction (...,), mm."""

    stride: Array
    lift: Array
    lowest: Array
    lowest_at: Array


def gait(path: Path) -> Gait:
    """Stride and lift of a leg, whose foot walks along the direction of the path."""
    across = extremes(path.across)
    return Gait(extremes(path.along).extent, across.extent, across.least, across.least_at)


def stance(path: Path, height: Any) -> Stance:
    """When a foot is below a height (...,) over its lowest point, mm.

    Raises
    ------
    ValueError
        The samples are no whole turn.
    """
    curve = path.across
    if not curve.closed:
        raise ValueError(f"inputs from {curve.at[0]:g} to {curve.at[-1]:g} rad are no whole turn")
    low = gait(path)
    crossings, signs = curve.roots(0, low.lowest + height)
    lowest = low.lowest_at[..., None]
    # After each fall below the height the foot stays there up to the next rise.
    after = np.mod(crossings - lowest, curve.span)
    rises = np.where(signs > 0, after, np.nan)
    falls = np.where(signs < 0, curve.span - after, np.nan)
    end, begin = low.lowest_at + _least(rises), low.lowest_at - _least(falls)
    whole = 1 + np.where(signs == 0, 0.0, signs * after).sum(axis=-1) / curve.span
    share = np.where(np.isnan(begin), whole, (end - begin) / curve.span)
    ends = path.along.at_input(np.stack([begin, end], axis=-1))
    share, whole = (np.where(np.isfinite(low.lowest), one, np.nan) for one in (share, whole))
    return Stance(begin, end, share, whole, ends)


def _least(values: Array) -> Array:
    """The least of each row (..., k); NaN where it has none."""
    least = np.min(np.where(np.isnan(values), np.inf, values), axis=-1, initial=np.inf)
    return np.asarray(np.where(np.isinf(least), np.nan, least))
