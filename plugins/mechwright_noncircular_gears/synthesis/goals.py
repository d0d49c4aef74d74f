"""What each kind of requirement makes least, as functions of ψ and its derivatives.

A goal is a bound y that functions stay below at every place of a window: |f| <= y, and equations that hold
at single places. The pitch curves' slope and curvature are bounded for all goals alike.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mechwright import Scalar
from mechwright_noncircular_gears.requirements import (
    ApproachRequirement,
    FitRequirement,
    GenevaRequirement,
    QuickReturnRequirement,
    SliderRequirement,
)
from mechwright_noncircular_gears.synthesis.waves import Complex, Point, Pointwise

Place = tuple[float, Pointwise]
"""An angle φ, rad, and a function that is 0 there."""


class Goal(ABC):
    """What is made least: the bound, which is the first of the unknowns y."""

    even: bool = True
    """Whether the best law is even about φ = 0, from the symmetry of what is wanted."""

    window: float = math.tau
    """rad of the driver, about φ = 0, in which :attr:`bounded` holds."""

    start: tuple[float, ...] = (1.0,)
    """First guess of the unknowns y, the bound first."""

    measure: str
    """What the bound is, as people are told it."""

    told: tuple[str, ...] = ()
    """Names of the unknowns beside the bound, rad, as figures of a design."""

    @abstractmethod
    def bounded(self) -> Sequence[Pointwise]:
        """Functions that are to be at least 0 in the window."""

    def places(self) -> Sequence[Place]:
        """Equations."""
        return ()

    @abstractmethod
    def neutral(self) -> tuple[str, float] | None:
        """The key of what is wanted, and its value that a constant ratio meets; None where any law does."""

    @abstractmethod
    def residual(self, least: float) -> Scalar:
        """The bound as it is told, with its unit."""


@dataclass(frozen=True)
class Equalised(Goal):
    """Least greatest acceleration of a straight-slot Geneva wheel, W'' = w''(ψ) i² + w'(ψ) i'.

    With the crank x from the middle of the index and L = sin(π/n), w = atan2(L sin x, 1 - L cos x). The bound
    is the peak over Δ/T² for the index angle Δ = 2π/n in T of the input; 4 is the least for any motion from
    rest to rest.
    """

    wanted: GenevaRequirement
    measure = "greatest_ca"

    @property
    def window(self) -> float:  # type: ignore[override]
        """The index."""
        return math.radians(self.wanted.index_angle)

    @property
    def half(self) -> float:
        """Crank from the middle to the end of the index, rad."""
        return math.pi / 2 - math.pi / self.wanted.slots

    start = (8.0,)

    def _peak(self, at: Point) -> Complex:
        ratio = math.sin(math.pi / self.wanted.slots)
        sin, cos = np.sin(at.psi), np.cos(at.psi)
        d = 1 + ratio**2 - 2 * ratio * cos
        rate = ratio * (cos - ratio) / d
        bend = -ratio * (1 - ratio**2) * sin / d**2
        return (bend * at.i**2 + rate * at.first) * self.window**2 / (math.tau / self.wanted.slots)

    def bounded(self) -> Sequence[Pointwise]:
        """The acceleration on both sides."""
        return (
            lambda at: at.y[0] - self._peak(at),
            lambda at: at.y[0] + self._peak(at),
        )

    def places(self) -> Sequence[Place]:
        """The crank enters the slot where the index begins."""
        return ((self.window / 2, lambda at: at.psi - self.half),)

    def neutral(self) -> tuple[str, float]:
        """The wheel at constant speed of its crank."""
        return "index_angle", math.degrees(2 * self.half)

    def residual(self, least: float) -> Scalar:
        """The peak over Δ/T²."""
        return Scalar(least, "")


@dataclass(frozen=True)
class Constant(Goal):
    """Least deviation of a slider's speed from its mean over a window of the input."""

    wanted: SliderRequirement
    measure = "deviation"
    even = False
    told = ("crank_at_zero",)

    @property
    def window(self) -> float:  # type: ignore[override]
        """The part of the turn in which the speed is to be constant."""
        return math.radians(self.wanted.window)

    @property
    def ends(self) -> tuple[float, float]:
        """Crank at both ends of the window, rad."""
        return math.radians(self.wanted.stroke_start), math.radians(self.wanted.stroke_end)

    @property
    def start(self) -> tuple[float, ...]:  # type: ignore[override]
        """Half of the speed, and the crank in the middle."""
        return 0.5, sum(self.ends) / 2

    def _place(self, t: float) -> float:
        return math.cos(t) + math.sqrt(self.wanted.rod_ratio**2 - math.sin(t) ** 2)

    def _speed(self, at: Point) -> Complex:
        """Over the mean speed of the window."""
        t = at.psi + at.y[1]
        sin, cos = np.sin(t), np.cos(t)
        rate = -sin - sin * cos / np.sqrt(self.wanted.rod_ratio**2 - sin**2)
        mean = (self._place(self.ends[1]) - self._place(self.ends[0])) / self.window
        share: Complex = rate * at.i / mean
        return share

    def bounded(self) -> Sequence[Pointwise]:
        """The deviation on both sides."""
        return (
            lambda at: at.y[0] - (self._speed(at) - 1),
            lambda at: at.y[0] + (self._speed(at) - 1),
        )

    def places(self) -> Sequence[Place]:
        """The crank at both ends of the window."""
        begin, end = self.ends
        return (
            (-self.window / 2, lambda at: at.psi + at.y[1] - begin),
            (self.window / 2, lambda at: at.psi + at.y[1] - end),
        )

    def neutral(self) -> tuple[str, float]:
        """The crank at constant speed."""
        return "window", self.wanted.stroke_end - self.wanted.stroke_start

    def residual(self, least: float) -> Scalar:
        """Share of the mean speed."""
        return Scalar(100 * least, "%")


@dataclass(frozen=True)
class QuickReturn(Goal):
    """Flattest pitch curves, the least greatest slope, for a ratio of the times of both parts of a turn."""

    wanted: QuickReturnRequirement
    measure = "greatest_slope"

    def bounded(self) -> Sequence[Pointwise]:
        """The slope on both sides."""
        return (
            lambda at: at.y[0] - at.slope,
            lambda at: at.y[0] + at.slope,
        )

    def places(self) -> Sequence[Place]:
        """The slow part begins and ends the same angle from the middle."""
        ratio = self.wanted.time_ratio
        share = math.pi * ratio / (1 + ratio)
        half = math.radians(self.wanted.forward_angle) / 2
        return ((share, lambda at: at.psi - half),)

    def neutral(self) -> tuple[str, float]:
        """Both parts at one speed."""
        return "time_ratio", self.wanted.forward_angle / (360 - self.wanted.forward_angle)

    def residual(self, least: float) -> Scalar:
        """The greatest slope ν."""
        return Scalar(math.atan(least), "rad")


@dataclass(frozen=True)
class Approach(Goal):
    """The least greatest ratio over a window."""

    wanted: ApproachRequirement
    measure = "greatest_ratio"

    @property
    def window(self) -> float:  # type: ignore[override]
        """Where the driven gear is to be slow."""
        return math.radians(self.wanted.window)

    def bounded(self) -> Sequence[Pointwise]:
        """The ratio."""
        return (lambda at: at.y[0] - at.i,)

    def neutral(self) -> None:
        """A constant ratio is slow, too."""

    def residual(self, least: float) -> Scalar:
        """The greatest ratio in the window."""
        return Scalar(least, "")


def goal_of(wanted: FitRequirement) -> Goal:
    """The goal of a table."""
    if isinstance(wanted, GenevaRequirement):
        return Equalised(wanted)
    if isinstance(wanted, SliderRequirement):
        return Constant(wanted)
    if isinstance(wanted, QuickReturnRequirement):
        return QuickReturn(wanted)
    assert isinstance(wanted, ApproachRequirement)  # noqa: S101 - the last of them
    return Approach(wanted)
