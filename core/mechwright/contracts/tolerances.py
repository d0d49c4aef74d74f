"""What a family says of its tolerances: what varies, what is judged, and how the one changes the other.

Glossary
--------
contributor
    A dimension, a pin in its hole, or a shift that differs from one made mechanism to the next.
deviation
    By how much it does: one number for a dimension, a vector for a pin, which may lie anywhere in its hole.
zone
    The deviations that are allowed, and how likely they are.
output
    What the mechanism is for: an angle, a position, a play. Its error is made minus nominal.
sensitivity
    The first derivative of an output by a deviation.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, get_args

from mechwright.arrays import Array
from mechwright.errors import DesignError

Distribution = Literal["normal", "uniform", "triangular"]
"""``normal`` is cut off at ±3 sigma, where the zone ends."""

DISTRIBUTIONS: tuple[Distribution, ...] = get_args(Distribution)

CUT = 3.0
"""Half the width of a zone, in sigmas of the normal distribution that is cut off there."""

CUT_VARIANCE = 1 - 2 * CUT * math.exp(-CUT * CUT / 2) / math.sqrt(math.tau) / math.erf(CUT / math.sqrt(2))
"""Variance of a normal distribution cut off at ±3 sigma, in sigma²: 0.97334."""


@dataclass(frozen=True, slots=True)
class Zone:
    """Deviations between two limits.

    Examples
    --------
    >>> zone = Zone(0.0, 0.012)
    >>> zone.middle, round(zone.sigma, 9)
    (0.006, 0.001973157)
    """

    lower: float
    upper: float
    distribution: Distribution = "normal"

    def __post_init__(self) -> None:
        if not self.lower <= self.upper:
            raise DesignError(f"a zone from {self.lower:g} to {self.upper:g} holds nothing; exchange them")

    @property
    def middle(self) -> float:
        """The mean."""
        return (self.lower + self.upper) / 2

    @property
    def half(self) -> float:
        """Half the width."""
        return (self.upper - self.lower) / 2

    @property
    def sigma(self) -> float:
        """Standard deviation."""
        match self.distribution:
            case "uniform":
                return self.half / math.sqrt(3)
            case "triangular":
                return self.half / math.sqrt(6)
            case _:
                return self.half / CUT * math.sqrt(CUT_VARIANCE)


@dataclass(frozen=True, slots=True)
class Contributor:
    """What varies.

    A dimension has one zone and ``directions`` 0: its deviation is one number. Where something may stand
    anywhere within a clearance it has the zones whose sum is the clearance, on the diameter: in one
    direction (a roller between two walls, ``directions`` 1) or in two (a pin in a hole, ``directions`` 2).
    Its deviation is a vector, half the clearance long.

    Parameters
    ----------
    name
        Stable, lower-case: the link or joint.
    key
        Keys of the table ``[tolerances]`` that its zones come from, parted by spaces.
    unit
        ``"mm"`` or ``"rad"``.
    nominal
        What the design says, in ``unit``; the clearance that the zones add to.
    zones
        Of the deviation, or whose sum adds to ``nominal`` as the clearance.
    directions
        0, 1 or 2, see above.
    """

    name: str
    key: str
    unit: str
    nominal: float
    zones: tuple[Zone, ...]
    directions: Literal[0, 1, 2] = 0

    @property
    def components(self) -> int:
        """Numbers that make up its deviation."""
        return max(1, self.directions)

    @property
    def lower(self) -> float:
        """Least deviation, or least clearance; a clearance below 0 is made 0 when the parts are fitted."""
        total = sum(zone.lower for zone in self.zones)
        return max(0.0, self.nominal + total) if self.directions else total

    @property
    def upper(self) -> float:
        """Greatest deviation, or greatest clearance."""
        total = sum(zone.upper for zone in self.zones)
        return max(0.0, self.nominal + total) if self.directions else total

    @property
    def mean(self) -> float:
        """Mean deviation; 0 for one without a preferred direction."""
        return 0.0 if self.directions else sum(zone.middle for zone in self.zones)

    @property
    def reach(self) -> float:
        """Greatest size of the deviation from its ``mean``."""
        if self.directions:
            return self.upper / 2
        return (self.upper - self.lower) / 2

    @property
    def variance(self) -> float:
        """Of one component, unit²; for a clearance E[ρ²] over the number of directions, ρ half of it."""
        spread = sum(zone.sigma**2 for zone in self.zones)
        if not self.directions:
            return spread
        radius = (self.nominal + sum(zone.middle for zone in self.zones)) / 2
        return (radius**2 + spread / 4) / self.directions


Figure = Literal["at", "least", "steady", "spread"]


@dataclass(frozen=True, slots=True)
class Output:
    """What is judged.

    Parameters
    ----------
    name
        As an engineer calls it, lower-case.
    unit
        ``"mm"`` or ``"rad"``.
    components
        Numbers that make it up: 1, or 2 or 3 for the error of a point, whose length is judged.
    figure
        ``"at"``: the error in one position. ``"least"``: the least value of a turn, which has to stay above
        0, as a play has; ``"steady"``: the same of a value that does not change over the turn. ``"spread"``:
        greatest less least value of a turn, as a transmission error is.
    """

    name: str
    unit: str
    components: int = 1
    figure: Figure = "at"

    @property
    def stays_above(self) -> bool:
        """Whether it is a value that has to stay above 0."""
        return self.figure in {"least", "steady"}


class ToleranceModel(ABC):
    """How the deviations of one design change its outputs.

    Deviations are given contributor by contributor as arrays (m, ...), m its ``components``; input positions
    as arrays (...) that broadcast with them.
    """

    input_name: str
    """What drives, as the motion calls it."""
    input_unit: str = "rad"
    """Of the input: ``"rad"``, or ``"mm"`` where a slide drives."""
    positions: Array
    """Input positions (n,), rad or mm, over the period that is looked at, in their order."""
    contributors: tuple[Contributor, ...]
    outputs: tuple[Output, ...]
    told: tuple[str, ...] = ()
    """What an engineer has to know besides, a sentence each: positions in which the first order fails."""

    @abstractmethod
    def nominal(self, output: str, at: Array) -> Array:
        """The nominal value (c, ...) of an output."""

    @abstractmethod
    def sensitivities(self, output: str, at: Array) -> Sequence[Array]:
        """The exact first derivatives of an output: an array (c, m, ...) for each contributor.

        NaN where there are none, such as in a dead centre; ``told`` says so.
        """

    @abstractmethod
    def errors(self, output: str, deviations: Sequence[Array], at: Array) -> Array:
        """The exact error (c, ...) of an output; NaN where the mechanism cannot be assembled."""
