"""Flexible shaft couplings with clamping hubs."""

from dataclasses import dataclass

from mechwright.contracts.bought import Bought
from mechwright.contracts.fits import hole_fit
from mechwright.contracts.shape import Revolve, Shape
from mechwright.errors import DesignError
from mechwright.standards.table import table

BORES = (5.0, 6.0, 6.35, 8.0, 10.0)
"""In which hubs are sold, mm."""


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
        return Bought(words, "", None, Shape((Revolve(profile),)), note, fits=fits)


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
