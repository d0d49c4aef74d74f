"""Plain bushes of sintered bronze, ISO 2795."""

import math
from dataclasses import dataclass

from mechwright.contracts.bought import Bought
from mechwright.contracts.fits import hole_fit, shaft_fit
from mechwright.contracts.shape import Shape, ring
from mechwright.errors import DesignError
from mechwright.standards.table import table

STANDARD = "ISO 2795"
"""Of sintered bushes."""

SINTERED = 6.6e-3
"""Density of sintered bronze with its oil, g/mm³; handbook, unchecked."""


@dataclass(frozen=True)
class BushSize:
    """Bore and outside, mm, and the lengths in which the bush is sold."""

    bore: float
    outside: float
    lengths: tuple[float, ...]


@dataclass(frozen=True)
class Bush:
    """A bush of one length, mm."""

    bore: float
    outside: float
    length: float

    @property
    def bought(self) -> Bought:
        """How it is ordered; it stands on z = 0."""
        volume = math.pi / 4 * (self.outside**2 - self.bore**2) * self.length
        return Bought(
            f"ISO 2795 - J {self.bore:g} x {self.outside:g} x {self.length:g} - sintered bronze",
            STANDARD,
            round(SINTERED * volume, 3),
            Shape((ring(self.bore, self.outside, self.length),)),
            "housing H7; bore H7 when pressed in",
            fits=(hole_fit(self.bore, "H7"), shaft_fit(self.outside, "r6")),
        )


def bushes() -> tuple[BushSize, ...]:
    """All sizes, by bore."""
    return table("bushes").of(BushSize)


def bush_for(bore: float, length: float) -> Bush:
    """The longest bush on a shaft, mm, at most ``length`` long; raises DesignError where there is none.

    >>> bush_for(8, 10)
    Bush(bore=8, outside=12, length=8)
    """
    size = next((one for one in bushes() if one.bore == bore), None)
    if size is None:
        raise DesignError(
            f"no bush has a bore of {bore:g} mm; one of: {', '.join(f'{b.bore:g}' for b in bushes())}"
        )
    fitting = [one for one in size.lengths if one <= length]
    if not fitting:
        raise DesignError(
            f"the shortest bush on a shaft of {bore:g} mm is {size.lengths[0]:g} mm long; "
            f"there are {length:g} mm"
        )
    return Bush(size.bore, size.outside, fitting[-1])
