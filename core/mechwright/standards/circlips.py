"""Circlips: DIN 471 on shafts, DIN 472 in bores.

Glossary
--------
depth t
    Half the difference of the shaft or bore and its groove.
edge n
    Least length from the groove's far side to the end of the shaft: 3 t.
"""

import math
from dataclasses import dataclass

from mechwright.contracts.bought import Bought
from mechwright.contracts.shape import Shape, ring
from mechwright.errors import DesignError
from mechwright.standards.table import table

YIELD = 200.0
"""Yield strength for which DIN 471 and 472 print the loads of grooves, MPa."""

ON_SHAFTS, IN_BORES = "DIN 471", "DIN 472"
STANDARDS = frozenset({ON_SHAFTS, IN_BORES})
"""Of circlips: on shafts, in bores, all."""

_THINNER = ((0.8, 0.05), (1.75, 0.06), (3.0, 0.07))
"""Thicknesses up to and including, and by how much a ring may be thinner, mm; handbook."""

_SHARE = 1.2
"""By how much the printed load of a groove is below yield on its area."""


@dataclass(frozen=True)
class Circlip:
    """A ring and its groove, mm; ``inside`` one in a bore.

    Parameters
    ----------
    size
        Diameter of shaft or bore.
    thickness
        s.
    groove
        Diameter d2.
    tolerance
        Of d2: 0/-tolerance on shafts, +tolerance/0 in bores.
    height
        a, by which the ring's lugs stand over the shaft, or into the bore.
    mass
        g.
    ring_load
        What the ring bears with a sharp corner against it, N; None where the table does not say.
    """

    size: float
    thickness: float
    groove: float
    tolerance: float
    height: float
    mass: float
    inside: bool
    ring_load: float | None = None

    @property
    def depth(self) -> float:
        """Depth t of the groove."""
        return abs(self.size - self.groove) / 2

    @property
    def width(self) -> float:
        """Width m of the groove, H13."""
        return round(self.thickness + 0.1, 6)

    @property
    def thinner(self) -> float:
        """By how much its thickness may be below the nominal one, mm.

        >>> shaft_circlip(10).thinner, shaft_circlip(8).thinner
        (0.06, 0.05)
        """
        return next(under for most, under in _THINNER if self.thickness <= most)

    @property
    def edge(self) -> float:
        """n, from the groove to the end of the shaft or bore."""
        return round(3 * self.depth, 6)

    @property
    def room(self) -> float:
        """Diameter that the seated ring takes with its lugs: outside on a shaft, inside in a bore."""
        return self.size + (-2 if self.inside else 2) * self.height

    def groove_load(self, strength: float = YIELD) -> float:
        """Axial load that the groove bears, N, in a material of this yield strength, MPa.

        >>> round(shaft_circlip(10).groove_load())
        1026
        """
        return math.pi / 4 * abs(self.size**2 - self.groove**2) * strength / _SHARE

    @property
    def part_name(self) -> str:
        """Of the part that it is in a machine: that of all rings of its size on shafts."""
        return f"circlip-{self.size:g}"

    @property
    def bought(self) -> Bought:
        """How it is ordered; a whole ring as far as the lugs sweep, from z = 0 to its thickness."""
        number = IN_BORES if self.inside else ON_SHAFTS
        low, high = sorted((self.groove, self.room))
        envelope = Shape((ring(low, high, self.thickness),))
        return Bought(f"{number} - {self.size:g} x {self.thickness:g}", number, self.mass, envelope)


def shaft_circlips() -> tuple[Circlip, ...]:
    """DIN 471, by shaft."""
    return tuple(
        Circlip(
            row["size"],
            row["thickness"],
            row["groove"],
            row["under"],
            row["height"],
            row["mass"],
            inside=False,
            ring_load=1000 * row["ring_load"],
        )
        for row in table("circlips-shaft").rows
    )


def bore_circlips() -> tuple[Circlip, ...]:
    """DIN 472, by bore."""
    return tuple(
        Circlip(
            row["size"], row["thickness"], row["groove"], row["over"], row["height"], row["mass"], inside=True
        )
        for row in table("circlips-bore").rows
    )


def shaft_circlip(diameter: float) -> Circlip:
    """The ring for a shaft, mm; raises DesignError that lists the sizes."""
    return _of(diameter, shaft_circlips(), "DIN 471 has no ring for a shaft of")


def bore_circlip(diameter: float) -> Circlip:
    """The ring for a bore, mm; raises DesignError that lists the sizes.

    >>> bore_circlip(22).width, bore_circlip(22).edge
    (1.1, 1.5)
    """
    return _of(diameter, bore_circlips(), "DIN 472 has no ring for a bore of")


def _of(diameter: float, rings: tuple[Circlip, ...], words: str) -> Circlip:
    for one in rings:
        if one.size == diameter:
            return one
    raise DesignError(f"{words} {diameter:g} mm here; one of: {', '.join(f'{r.size:g}' for r in rings)}")
