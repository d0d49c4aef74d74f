"""Deep-groove ball bearings with two shields (-2Z), sizes of ISO 15."""

import math
from dataclasses import dataclass

from mechwright.contracts.bought import Bought
from mechwright.contracts.fits import between
from mechwright.contracts.shape import Shape, ring
from mechwright.errors import DesignError
from mechwright.standards.table import table

STANDARD = "ISO 15"
"""Of the sizes of ball bearings."""

FRICTION = 0.0015
"""Coefficient of friction at the bore of such a bearing under usual load: SKF, Rolling bearings."""

_BORES = ((18.0, 0.008), (30.0, 0.010))
_WIDTHS = ((50.0, 0.12), (120.0, 0.15))
_OUTSIDES = ((18.0, 0.008), (30.0, 0.009), (50.0, 0.011), (80.0, 0.013))
"""Up to a diameter, mm, a ring of class Normal has a mean bore, a width by its bore, or a mean outside
that is so much less: ISO 492."""


def _below(diameter: float, rows: tuple[tuple[float, float], ...]) -> float:
    return next(less for most, less in rows if diameter <= most)


@dataclass(frozen=True)
class Bearing:
    """A bearing; its ``series`` goes from 62, the heaviest, over 60 and 619 to 618.

    Parameters
    ----------
    bore, outside, width
        d, D, B, mm.
    c, c0
        Dynamic and static load rating, kN.
    shoulder, abutment
        Least diameter of the shoulder on the shaft, greatest of the one in the housing, mm.
    fillet
        Greatest radius at a shoulder, mm.
    mass
        g.
    row
        Where the row is from, see the table's source.
    """

    name: str
    series: str
    bore: float
    outside: float
    width: float
    c: float
    c0: float
    shoulder: float
    abutment: float
    fillet: float
    mass: float
    row: str

    @property
    def dynamic(self) -> float:
        """Dynamic load rating, N."""
        return 1000 * self.c

    @property
    def static(self) -> float:
        """Static load rating, N."""
        return 1000 * self.c0

    @property
    def narrower(self) -> float:
        """By how much its width may be below the nominal one, mm.

        >>> bearing("6000").narrower
        0.12
        """
        return _below(self.bore, _WIDTHS)

    @property
    def bought(self) -> Bought:
        """How it is ordered; one solid from z = 0 to its width, the whole envelope."""
        envelope = ring(self.bore, self.outside, self.width, chamfer=self.fillet)
        fits = (
            between(self.bore, -_below(self.bore, _BORES), 0.0),
            between(self.outside, -_below(self.outside, _OUTSIDES), 0.0),
        )
        return Bought(f"{self.name}-2Z", STANDARD, self.mass, Shape((envelope,)), fits=fits)


def bearings() -> tuple[Bearing, ...]:
    """All of them, by bore, in each bore from the heaviest to the thinnest."""
    return table("bearings").of(Bearing)


def bearing(name: str) -> Bearing:
    """The bearing of that name, such as ``"608"``; raises DesignError that lists the names.

    >>> bearing("6001").outside
    28
    """
    found = {one.name: one for one in bearings()}
    if name not in found:
        raise DesignError(f"no bearing {name!r}; one of: {', '.join(found)}")
    return found[name]


def thinner(one: Bearing) -> Bearing | None:
    """The next thinner series on the same shaft; None for the thinnest.

    >>> thinner(bearing("608")).name, thinner(bearing("618/8"))
    ('619/8', None)
    """
    same = [other for other in bearings() if other.bore == one.bore]
    return next((other for other in same if other.outside < one.outside), None)


def bearing_for(bore: float, room: float = math.inf, *, dynamic: float = 0.0, static: float = 0.0) -> Bearing:
    """The heaviest bearing for a shaft, mm, whose outside is at most ``room``, mm.

    ``dynamic`` and ``static`` are load ratings that it needs at least, N.

    Raises
    ------
    DesignError
        No bearing has this bore, the thinnest one is larger than the room, or one that fits is too weak: the
        limit, and what comes nearest.

    >>> bearing_for(8).name, bearing_for(8, room=20).name
    ('628', '619/8')
    """
    same = [one for one in bearings() if one.bore == bore]
    if not same:
        bores = sorted({one.bore for one in bearings()})
        raise DesignError(
            f"no bearing has a bore of {bore:g} mm; one of: {', '.join(f'{b:g}' for b in bores)}"
        )
    fitting = [one for one in same if one.outside <= room]
    if not fitting:
        last = same[-1]
        raise DesignError(
            f"no bearing on a shaft of {bore:g} mm fits into {room:g} mm; the thinnest, {last.name}, is "
            f"{last.outside:g} mm outside: take a thinner shaft or a bush"
        )
    strong = [one for one in fitting if one.dynamic >= dynamic and one.static >= static]
    if not strong:
        best = fitting[0]
        raise DesignError(
            f"{best.name} carries C {best.dynamic:g} N and C0 {best.static:g} N; {dynamic:g} N and "
            f"{static:g} N are needed within {room:g} mm: take a thicker shaft, or give it more room"
        )
    return strong[0]
