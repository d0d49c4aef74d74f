"""What a synthesis gives: designs that meet a requirement, best first."""

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, Generic, TypeVar

from mechwright.contracts.finding import Finding, errors
from mechwright.contracts.motion import Scalar
from mechwright.contracts.parameters import Parameters

P = TypeVar("P", bound=Parameters)

Progress = Callable[[float, str], None]
"""Called now and then by what takes long: the part that is done, 0 to 1, and what it is at."""


def unheard(done: float, what: str) -> None:
    """Progress that nobody is told of."""


@dataclass(frozen=True, slots=True)
class Candidate(Generic[P]):
    """One design that a synthesis has found.

    Parameters
    ----------
    params
        The design.
    residual
        By how much it misses the requirement, in its own unit; 0 for a closed form.
    figures
        What to compare candidates by, name to value and unit, most telling first.
    measure
        What people are told that the residual is: of a requirement that is met by all of its designs, what
        was made least.
    """

    params: P
    residual: Scalar
    figures: Mapping[str, Scalar] = field(default_factory=dict)
    measure: str = "residual"

    @property
    def shown(self) -> dict[str, Scalar]:
        """Residual and figures as they are told to people: angles in degrees."""
        told = {self.measure: self.residual, **self.figures}
        return {name: _in_degrees(one) for name, one in told.items()}

    def as_dict(self) -> dict[str, Any]:
        """Residual and figures as plain data for JSON; angles in degrees."""
        told = {name: {"value": one.value, "unit": one.unit} for name, one in self.shown.items()}
        return {"residual": told.pop(self.measure), "figures": told}


def _in_degrees(figure: Scalar) -> Scalar:
    return Scalar(math.degrees(figure.value), "deg") if figure.unit == "rad" else figure


ALIKE = 0.02
"""Share of a length within which two designs are one: nobody would choose between them. So are mirror images
of each other, where both meet the requirement, and four-bars that draw one curve (cognates)."""

BEYOND = "synthesis.beyond-the-number"
"""Code of designs that come after those that are asked for."""


@dataclass(frozen=True, slots=True)
class Reason:
    """Why designs that a search has found are not given.

    Parameters
    ----------
    code
        Of the finding that speaks against them.
    count
        How many of them.
    message
        What it says of the first.
    """

    code: str
    count: int
    message: str

    def __str__(self) -> str:
        return f"{self.count} {self.code.rpartition('.')[2].replace('-', ' ')}"


class Rejected:
    """Counts the designs that a search has found and does not give.

    >>> rejected = Rejected()
    >>> rejected.by([Finding.error("geneva.undercut", "roller_radius", "too large")]), rejected.by([])
    (True, False)
    >>> [str(reason) for reason in rejected.reasons]
    ['1 undercut']
    """

    def __init__(self, reasons: Iterable[Reason] = ()) -> None:
        self._reasons = {reason.code: reason for reason in reasons}

    def by(self, findings: Iterable[Finding]) -> bool:
        """Whether a finding speaks against a design; it is then counted under the first that does."""
        faults = errors(findings)
        if faults:
            self.because(faults[0].code, str(faults[0]))
        return bool(faults)

    def because(self, code: str, message: str, count: int = 1) -> None:
        """Count one design, or several."""
        if count > 0:
            before = self._reasons.get(code, Reason(code, 0, message))
            self._reasons[code] = Reason(code, before.count + count, before.message)

    def same(self, count: int = 1) -> None:
        """Count designs that differ from an earlier one by nothing that anybody would choose by."""
        self.because("synthesis.near-another", "nearly the same as a design that was found before", count)

    def cognate(self) -> None:
        """Count a linkage whose point runs over the curve of another that may be given."""
        self.because("synthesis.cognate", "it draws the same curve as a linkage that was found before")

    def beyond(self, most: int, count: int) -> None:
        """Count designs that come after the ``most`` that are asked for."""
        self.because(BEYOND, f"the requirement asks for designs = {most}", count)

    @property
    def reasons(self) -> tuple[Reason, ...]:
        """All of them, the most frequent first."""
        return tuple(sorted(self._reasons.values(), key=lambda one: -one.count))


@dataclass(frozen=True, slots=True)
class Synthesis(Generic[P]):
    """The result of a synthesis.

    Parameters
    ----------
    candidates
        Distinct designs, best first. The family's ``check`` has no error for any of them.
    findings
        What there is to say of the requirement: an error, with the nearest feasible value or the best
        residual found, where no candidate meets it.
    rejected
        Why designs that were found are not among the candidates.
    """

    candidates: tuple[Candidate[P], ...]
    findings: tuple[Finding, ...] = ()
    rejected: tuple[Reason, ...] = ()
