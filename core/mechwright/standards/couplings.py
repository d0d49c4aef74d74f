"""Flexible shaft couplings with clamping hubs."""

from dataclasses import dataclass

from mechwright.contracts.bought import Bought
from mechwright.contracts.fits import hole_fit
from mechwright.contracts.shape import Revolve, Shape
from mechwright.errors import DesignError
from mechwright.standards.ordering import inch_length
from mechwright.standards.stock import AS_THICK, InchSize
from mechwright.standards.table import table

BORES = (5.0, 6.0, 6.35, 8.0, 10.0)
"""In which hubs are sold, mm."""


INCH_BORES = {5.0: "3/16", 6.0: "1/4", 6.35: "1/4", 8.0: "5/16", 10.0: "3/8"}
"""The nearest bore by the inch of each."""


class OverloadError(DesignError):
    """No coupling carries so much; ``most``: what the largest with these bores carries, N m."""

    def __init__(self, most: float, message: str) -> None:
        super().__init__(message)
        self.most = most


@dataclass(frozen=True)
class CouplingSize:
    """Outside and length, least and greatest bore, mm, and rated torque, N m."""

    outside: float
    length: float
    least: float
    most: float
    torque: float


@dataclass(frozen=True)
class Coupling:
    """A coupling with two bores, mm, the ``lower`` one below."""

    of: CouplingSize
    lower: float
    upper: float

    @property
    def bought(self) -> Bought:
        """How it is ordered; it stands on z = 0, and each shaft goes into half of it."""
        r, top, middle = self.of.outside / 2, self.of.length, self.of.length / 2
        low, high = self.lower / 2, self.upper / 2
        step = ((low, middle),) if low == high else ((high, middle), (low, middle))
        profile = ((low, 0.0), (r, 0.0), (r, top), (high, top), *step)
        fits = tuple(hole_fit(bore, "H7") for bore in (self.lower, self.upper))
        words = f"flexible coupling {self.of.outside:g} x {top:g}, {self.lower:g} / {self.upper:g} mm"
        note = "jaw or beam, clamping hubs; a rigid one would be over-determined"
        return Bought(words, "", None, Shape((Revolve(profile),)), note, fits=fits, inch=self.inch)

    @property
    def inch(self) -> str:
        """What is sold in inches: the motor's bore stays that of its shaft, the other end is turned to fit.

        >>> coupling_for(6.35, 10, 1.0).inch
        'about 1 x 1 1/8 in, bores 1/4 in and 10 mm, or 3/8 in on a stub of 9.525 mm'
        """
        outside, length = inch_length(self.of.outside), inch_length(self.of.length)
        text = f"about {outside} x {length} in, bores {sold_bore(self.lower)} and {sold_bore(self.upper)}"
        size = InchSize(INCH_BORES[self.upper])
        exact = abs(size.size - self.upper) < AS_THICK
        return text if exact else f"{text}, or {size.name} in on a stub of {size.size:.4g} mm"


def sold_bore(bore: float) -> str:
    """A bore, mm, by the inch where one is exactly so wide.

    >>> sold_bore(6.35), sold_bore(5)
    ('1/4 in', '5 mm')
    """
    name = INCH_BORES.get(bore)
    exact = name is not None and abs(InchSize(name).size - bore) < AS_THICK
    return f"{name} in" if exact else f"{bore:g} mm"


def couplings() -> tuple[CouplingSize, ...]:
    """From the smallest to the largest."""
    return table("couplings").of(CouplingSize)


def coupling_for(lower: float, upper: float, torque: float) -> Coupling:
    """The smallest coupling between two shafts, mm, that carries a torque, N m.

    Raises DesignError for a bore in which no hub is sold, OverloadError for a torque above what these bores
    carry.

    >>> coupling_for(5, 8, 0.3).of.outside
    19
    """
    for bore in (lower, upper):
        if bore not in BORES:
            raise DesignError(f"no coupling for {bore:g} mm; one of: {', '.join(f'{b:g}' for b in BORES)}")
    fitting = [one for one in couplings() if all(one.least <= b <= one.most for b in (lower, upper))]
    for one in fitting:
        if one.torque >= torque:
            return Coupling(one, lower, upper)
    most = fitting[-1].torque
    raise OverloadError(
        most,
        f"couplings for {lower:g} and {upper:g} mm carry {most:g} N m; {torque:g} N m are asked for: "
        "gear down behind the coupling, or fix a hub on the shaft",
    )
