"""A closed loop of lengths along an axis, whose gap is a play.

Glossary
--------
length of a stack
    One of the loop. Its sign is +1 where a longer one makes the gap larger, else -1.
gap
    The sum of all lengths with their signs: the play where it is above 0, an interference below.
shim
    A thin ring of a chosen thickness that takes up what a gap has too much. It is chosen after measuring.
"""

import math
from dataclasses import dataclass

from mechwright.contracts.turned import Length
from mechwright.errors import GeometryError
from mechwright.tolerances import TOLERANCES


@dataclass(frozen=True)
class StackLength:
    """A length of a stack.

    Parameters
    ----------
    name
        What it is, in a few words: ``"depth of the lower seat"``.
    sign
        +1 or -1.
    nominal, lower, upper
        Nominal length and its limit deviations, mm.
    bought
        Whether its limits are a maker's: such parts come from one lot and are seldom centred.
    part
        The part that has this length; empty where none has.
    copy
        Body and height of the copy of that part, mm, where it has several; None for any of them.

    Raises
    ------
    GeometryError
        The sign is none, or the limits are no interval.
    """

    name: str
    sign: int
    nominal: float
    lower: float
    upper: float
    bought: bool = False
    part: str = ""
    copy: tuple[str, float] | None = None

    def __post_init__(self) -> None:
        if self.sign not in {1, -1}:
            raise GeometryError(f"length {self.name!r} has the sign {self.sign}; take 1 or -1")
        if not (math.isfinite(self.nominal) and self.lower <= self.upper):
            raise GeometryError(
                f"length {self.name!r}: {self.nominal:g} mm with the limits {self.lower:g} to "
                f"{self.upper:g} mm; the lower limit comes first"
            )

    @classmethod
    def of(cls, length: Length, sign: int, part: str = "") -> "StackLength":
        """A length of a turned part with the limits that its drawing states."""
        return cls(length.name, sign, length.nominal, length.lower, length.upper, part=part)

    @property
    def middle(self) -> float:
        """Middle of the limits of size, mm."""
        return self.nominal + (self.lower + self.upper) / 2

    @property
    def half(self) -> float:
        """Half of the tolerance, mm."""
        return (self.upper - self.lower) / 2


@dataclass(frozen=True)
class Shimming:
    """How the rings of a stack are chosen: assemble without them, measure the gap, put in rings.

    Parameters
    ----------
    designation
        Of the rings without their thickness: ``"DIN 988 - 20 x 28"``.
    thicknesses
        In which they are sold, mm.
    where
        Where the rings go, in a few words.
    least
        Play that stays at least by the measured gap, mm.
    step
        In which the thickness of the set of rings is chosen, mm.
    reading
        How far the measured gap may be off, plus and minus, mm.
    thinner
        By how much a ring may be thinner than its nominal thickness, mm.
    part
        The part that stands for the rings in the parts list.
    """

    designation: str
    thicknesses: tuple[float, ...]
    where: str
    least: float
    step: float = 0.1
    reading: float = 0.02
    thinner: float = 0.03
    part: str = ""

    def thickness(self, gap: float) -> float:
        """Sum of the rings for a measured gap, mm; 0 for none.

        >>> Shimming("DIN 988 - 20 x 28", (0.1, 0.2, 0.3, 0.5), "in the seat", 0.05).thickness(0.295)
        0.2
        """
        return round(_steps(gap, self) * self.step, 6)

    def rings(self, gap: float) -> tuple[float, ...]:
        """Thicknesses of the rings for a measured gap, mm, thickest first.

        >>> Shimming("DIN 988 - 20 x 28", (0.1, 0.2, 0.3, 0.5), "in the seat", 0.05).rings(0.87)
        (0.5, 0.3)
        """
        rest, found = self.thickness(gap), []
        for one in sorted(self.thicknesses, reverse=True):
            while rest >= one - TOLERANCES.closure:
                found.append(one)
                rest = round(rest - one, 6)
        return tuple(found)

    def residual(self, least: float, greatest: float) -> tuple[float, float]:
        """Least and greatest play after the rings were chosen, of gaps between these, mm.

        A gap below ``least + step`` stays as it is. Of others ``least`` to ``least + step`` is left by the
        measured gap, which may be off by ``reading``, and by rings that may be thinner.
        """
        low = least if least < self.least else self.least - self.reading
        counts = [len(self.rings(greatest - k * self.step)) for k in range(_steps(greatest, self) + 1)]
        thinner = max(counts) * self.thinner
        return low, min(greatest, self.least + self.step + self.reading + thinner)


def _steps(gap: float, shimming: Shimming) -> int:
    """Whole steps of rings that a measured gap takes."""
    return max(math.floor((gap - shimming.least) / shimming.step + TOLERANCES.closure), 0)


@dataclass(frozen=True)
class AxialStack:
    """A closed loop of lengths and the play that is meant.

    Parameters
    ----------
    name
        ``"float of shaft 2"``; the names of a build differ.
    lengths
        The lengths of the loop.
    least, greatest
        Play that is meant, mm; infinite where nothing limits it.
    shimming
        How rings are chosen; None where none are put in.
    adjustable
        The length that a remedy changes; empty for the first.
    key
        The design-file key that changes it; empty where none does.
    hub_on
        The shaft on which a hub has this play; empty for other stacks. A hub without a key is bonded once the
        rings are chosen.
    measurable
        Whether it can be measured while the machine is put together.

    Raises
    ------
    GeometryError
        There is no length, or the play that is meant is no interval.
    """

    name: str
    lengths: tuple[StackLength, ...]
    least: float = 0.0
    greatest: float = math.inf
    shimming: Shimming | None = None
    adjustable: str = ""
    key: str = ""
    hub_on: str = ""
    measurable: bool = True

    def __post_init__(self) -> None:
        if not self.lengths:
            raise GeometryError(f"stack {self.name!r} has no lengths; give them")
        if not self.least <= self.greatest:
            raise GeometryError(
                f"stack {self.name!r}: a play of {self.least:g} to {self.greatest:g} mm is no interval"
            )

    @property
    def nominal(self) -> float:
        """Gap of all nominal lengths, mm."""
        return sum(one.sign * one.nominal for one in self.lengths)

    @property
    def middle(self) -> float:
        """Gap of the middles of all limits, mm."""
        return sum(one.sign * one.middle for one in self.lengths)

    @property
    def worst(self) -> tuple[float, float]:
        """Least and greatest gap before rings are put in, mm."""
        half = sum(one.half for one in self.lengths)
        return self.middle - half, self.middle + half

    @property
    def play(self) -> tuple[float, float]:
        """Least and greatest play of the finished stack, mm: with rings, where they are chosen."""
        return self.worst if self.shimming is None else self.shimming.residual(*self.worst)

    @property
    def changed(self) -> StackLength:
        """The length that a remedy changes."""
        found = [one for one in self.lengths if one.name == self.adjustable]
        return found[0] if found else self.lengths[0]
