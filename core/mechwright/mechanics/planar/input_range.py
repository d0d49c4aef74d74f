"""Limits of the input of a planar machine with one drive: between which values all its groups close.

Glossary
--------
end
    A value of the input at which a group stops to close: a dead point of the group.
change point
    A value at which a group is at its dead point and closes on both sides, as where a kite's bars are in one
    line. The machine may leave it in either of two assemblies.
piece
    An interval within which no group has an end or a change point.

The closing quantities of a group are smooth within a piece of the groups before it, up to a square root at
its ends. With the input as c - h cos t they are smooth in t up to the ends.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.errors import KinematicsError
from mechwright.mechanics.planar.assembly_order import Cluster, Driven, Dyad, Group, assembly_order
from mechwright.mechanics.planar.closing import ClosingQuantity, closing_quantities, size_of
from mechwright.mechanics.planar.dead_point import cluster_limits
from mechwright.mechanics.planar.machine import GearPair, Machine, Revolute
from mechwright.mechanics.planar.positions import cluster_name, solve
from mechwright.mechanics.planar.rigid import BodyMotion, PointMotion, Turning
from mechwright.mechanics.planar.swing import TURN_BACK
from mechwright.mechanics.planar.zeros import zeros

TOUCH = 1e-12
"""A closing quantity with so small a minimum touches 0: some hundred times its rounding."""

FIRST = -math.pi + 0.1234567
"""Where a turn is cut open, away from the axes of symmetry of a linkage."""

EDGE = 1e-5
"""Distance of the outermost samples in t, 5e-11 of a piece's half in the input."""

PER_TURN = 192
"""Nodes per turn, or over the bounds of a slide, at which closing quantities are first looked at."""

LARGEST_TEETH = 400
"""Largest denominator of a ratio of gears."""


@dataclass(frozen=True)
class Limit:
    """Where a group is at its dead point.

    Parameters
    ----------
    value
        Of the input, rad, or mm of a slide.
    joint
        Name of the inner joint of the group.
    kind
        What its links do there, as :class:`~mechwright.mechanics.planar.closing.ClosingQuantity` says, or
        ``"dead point"`` of a group without a closed form.
    change_point
        Whether the group closes on both sides.
    """

    value: float
    joint: str
    kind: str
    change_point: bool = False


@dataclass(frozen=True)
class Interval:
    """Values of the input between which all groups close, rad or mm; an end without a limit is a bound given.

    Angles may lie outside of a turn: the middle is in -π to π.
    """

    low: float
    high: float
    low_limit: Limit | None = None
    high_limit: Limit | None = None


@dataclass(frozen=True)
class InputRange:
    """The intervals of the input, in order of their low ends.

    Parameters
    ----------
    intervals
        None where the machine closes nowhere.
    turns_fully
        Whether it closes over the whole turn, or over all turns after which gears come back.
    change_points
        Within the intervals, in order.
    """

    intervals: tuple[Interval, ...]
    turns_fully: bool
    change_points: tuple[Limit, ...] = ()


@dataclass(frozen=True)
class _Piece:
    low: float
    high: float
    low_limit: Limit | None = None
    high_limit: Limit | None = None
    turn: float = math.tau

    def at(self, t: Array) -> tuple[Array, Array]:
        """The input at t in 0 to π, and its derivative."""
        middle, half = (self.low + self.high) / 2, (self.high - self.low) / 2
        near = t < math.pi / 2
        lever = 2 * half * np.sin(np.where(near, t, math.pi - t) / 2) ** 2
        return np.where(near, self.low + lever, self.high - lever), half * np.sin(t) + 0 * middle

    def nodes(
        self,
    ) -> Array:
        """Values of t, more for a longer piece; none is in the middle or at another place of symmetry."""
        count = max(24, math.ceil(PER_TURN * (self.high - self.low) / self.turn))
        even = np.linspace(0.0, 1.0, count + 1)
        return EDGE + (math.pi - 2 * EDGE) * (even + 0.013 * even * (1 - even))


def ranges(
    machine: Machine, transmission: float = 0.0, bounds: tuple[float, float] | None = None
) -> InputRange:
    """Between which values of the input all groups of a machine close, on the branches given.

    Parameters
    ----------
    machine
        Of one design, with one drive.
    transmission
        Least transmission angle of a dyad, rad. Of a group without closed form it limits the smallest
        singular value: its sine is the least share of the largest value in the interval.
    bounds
        Values of the input, rad or mm, that it is looked for between. The default is a turn, or as many as
        bring gears back; of a slide it is the size of the machine to both sides.

    Ends are exact to about 1e-12 rad, unless a gap or an interval is thin: of one as thin as w they are
    exact to about 1e-15/w. An interval has no more than 5e-11 of its length outside of those found. A group
    without closed form is followed from the drawn pose: the one interval around it is found.

    Raises
    ------
    KinematicsError
        The machine has not one drive, is of several designs, cannot be put together, or stays at a
        dead point.

    Examples
    --------
    A crank that turns between two toggles, D = 60 + 75:

    >>> from mechwright.mechanics.planar.machine import Drive
    >>> joints = [
    ...     Revolute("A0", "ground", "crank", 0, 0), Revolute("A", "crank", "coupler", 70, 0),
    ...     Revolute("B", "coupler", "rocker", 60, 75), Revolute("B0", "ground", "rocker", 110, 0),
    ... ]
    >>> found = ranges(Machine(joints, [Drive("crank")]))
    >>> [(round(math.degrees(one.low), 6), round(math.degrees(one.high), 6)) for one in found.intervals]
    [(-94.562439, 94.562439)]
    >>> found.intervals[0].high_limit.joint, found.intervals[0].high_limit.kind
    ('B', 'stretched')
    """
    if len(machine.drives) != 1:
        raise KinematicsError(f"limits of the input need one drive; the machine has {len(machine.drives)}")
    places = (
        joint.place(link)
        for joint in machine.joints
        if not isinstance(joint, GearPair)
        for link in joint.links
    )
    if any(np.size(place) > 1 for place in places):
        raise KinematicsError(
            "limits of the input are those of one design; the machine has columns of designs"
        )
    order = assembly_order(machine)
    turns = isinstance(machine.driven_joint(machine.drives[0]), Revolute)
    period = math.tau * period_turns(machine) if turns and bounds is None else None
    low, high = _window(machine, order, period, bounds)
    pieces = [_Piece(low, high, turn=math.tau if turns else high - low)]
    for number, group in enumerate(order):
        if isinstance(group, Dyad):
            pieces = [
                part
                for piece in pieces
                for part in _divided(machine, order[:number], group, piece, transmission)
            ]
        elif isinstance(group, Cluster):
            pieces = list(_around_drawn(machine, order[: number + 1], pieces, transmission, period))
    return _joined(pieces, period)


def usable(
    machine: Machine, transmission: float = TURN_BACK, bounds: tuple[float, float] | None = None
) -> InputRange:
    """The same with every interval shortened to where no transmission angle is below the one given, rad.

    A change point parts an interval in two. Parameters and errors are those of :func:`ranges`.
    """
    return ranges(machine, transmission, bounds)


def period_turns(machine: Machine) -> int:
    """The turns of the input after which all gears are back where they were."""
    turns = 1
    for joint in machine.joints:
        if isinstance(joint, GearPair):
            turns *= Fraction(joint.ratio).limit_denominator(LARGEST_TEETH).denominator
    return turns


def _window(
    machine: Machine, order: Sequence[Group], period: float | None, bounds: tuple[float, float] | None
) -> tuple[float, float]:
    if bounds is not None:
        return bounds
    if any(isinstance(group, Cluster) for group in order):
        middle = float(np.ravel(machine.drawn_at[0])[0])
        reach = size_of(machine) if period is None else period
        return middle - reach, middle + reach
    if period is None:
        return -size_of(machine), size_of(machine)
    return FIRST, FIRST + period


def _divided(
    machine: Machine, before: Sequence[Group], group: Dyad, piece: _Piece, transmission: float
) -> Iterator[_Piece]:
    """The pieces of a piece in which one more dyad closes."""
    nodes = piece.nodes()

    def quantities(t: Array) -> tuple[ClosingQuantity, ...]:
        q, rate = piece.at(t)
        found = closing_quantities(machine, group, _bodies(machine, before, piece, q), transmission)
        return tuple(replace(one, slope=one.slope * rate) for one in found)

    kinds = quantities(nodes[:1])
    cuts: list[tuple[float, Limit | None]] = [(0.0, piece.low_limit), (math.pi, piece.high_limit)]
    for number, kind in enumerate(kinds):

        def function(t: Array, number: int = number) -> tuple[Array, Array]:
            one = quantities(t)[number]
            return np.broadcast_to(one.value, t.shape), np.broadcast_to(one.slope, t.shape)

        found = zeros(function, nodes, TOUCH)
        for places, touches in ((found.crossings, False), (found.touches, True)):
            for t in places:
                value = float(piece.at(np.array([t]))[0][0])
                cuts.append((float(t), Limit(value, group.inner.name, kind.limit, touches)))
    cuts.sort(key=lambda cut: cut[0])
    for (a, low), (b, high) in pairwise(cuts):
        middle = quantities(np.array([(a + b) / 2]))
        if all(one.both_sides or one.value[0] > 0 for one in middle):
            yield _Piece(
                low.value if low is not None and a > 0 else piece.low,
                high.value if high is not None and b < math.pi else piece.high,
                low,
                high,
                piece.turn,
            )


def _bodies(machine: Machine, before: Sequence[Group], piece: _Piece, q: Array) -> Mapping[str, BodyMotion]:
    """Motion of the links before a group at values of the input in any order.

    Gears need the turns of their mates, and clusters the way from the drawn pose: these are followed in small
    steps, in order.
    """
    if all(isinstance(group, Driven | Dyad) for group in before):
        return solve(machine, [Turning.of(q, 1.0)], before, 1).bodies
    steps = piece.at(piece.nodes())[0]
    every, places = np.unique(np.concatenate([q, steps]), return_inverse=True)
    bodies = solve(machine, [Turning.of(every, 1.0)], before, 1).bodies
    back = places[: q.size].astype(np.intp)
    return {name: _samples(body, back) for name, body in bodies.items()}


def _samples(body: BodyMotion, places: NDArray[np.intp]) -> BodyMotion:
    """A motion at some of its samples; jerks are not needed."""
    origin, turning = body.origin, body.turning
    return BodyMotion(
        PointMotion(
            *(one[places] for one in (origin.position, origin.velocity, origin.acceleration, origin.jerk))
        ),
        Turning(*(one[places] for one in (turning.theta, turning.omega, turning.alpha, turning.jerk))),
    )


def _around_drawn(
    machine: Machine,
    order: Sequence[Group],
    pieces: Sequence[_Piece],
    transmission: float,
    period: float | None,
) -> Iterator[_Piece]:
    """The piece around the drawn pose, as far as a cluster closes."""
    drawn, cluster = float(np.ravel(machine.drawn_at[0])[0]), order[-1]
    assert isinstance(cluster, Cluster)  # noqa: S101 - as the caller knows
    name = cluster_name(cluster)
    for piece in pieces:
        if not piece.low < drawn < piece.high:
            continue
        turns = period is not None and piece.high - drawn >= period
        ends = cluster_limits(machine, order, (piece.low, piece.high), math.sin(transmission), turns=turns)
        if turns and ends == (None, None):
            yield replace(piece, low=drawn)
            continue
        low, high = (None if end is None else Limit(end, name, "dead point") for end in ends)
        yield _Piece(
            piece.low if low is None else low.value,
            piece.high if high is None else high.value,
            low or piece.low_limit,
            high or piece.high_limit,
            piece.turn,
        )


def _joined(pieces: Sequence[_Piece], period: float | None) -> InputRange:
    """Pieces joined over change points, and over the place where a turn was cut open."""
    whole: list[_Piece] = []
    changes: list[Limit] = []
    for piece in sorted(pieces, key=lambda one: one.low):
        if (
            whole
            and piece.low_limit is not None
            and piece.low_limit.change_point
            and whole[-1].high == piece.low
        ):
            changes.append(piece.low_limit)
            whole[-1] = replace(whole[-1], high=piece.high, high_limit=piece.high_limit)
        else:
            whole.append(piece)
    if period is None or not whole:
        return InputRange(tuple(_interval(one, 0.0) for one in whole), False, tuple(changes))
    first, last = whole[0], whole[-1]
    if first.low_limit is None and last.high_limit is None and last.high - first.low >= period:
        if len(whole) == 1:
            return InputRange((Interval(0.0, period),), True, tuple(changes))
        joined = replace(last, high=first.high + period, high_limit=first.high_limit)
        whole = [*whole[1:-1], joined]
    found = sorted((_interval(one, period) for one in whole), key=lambda one: one.low)
    return InputRange(tuple(found), False, tuple(changes))


def _interval(piece: _Piece, period: float) -> Interval:
    """With its middle in half a period to both sides of 0."""
    shift = period * math.ceil((piece.low + piece.high) / 2 / period - 0.5) if period else 0.0

    def moved(limit: Limit | None, value: float) -> Limit | None:
        return None if limit is None else replace(limit, value=value)

    low, high = piece.low - shift, piece.high - shift
    return Interval(low, high, moved(piece.low_limit, low), moved(piece.high_limit, high))
