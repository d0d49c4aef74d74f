"""What a synthesis gives: designs that meet a requirement, best first."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, Generic, TypeVar

from mechwright.contracts.finding import Finding
from mechwright.contracts.motion import Scalar
from mechwright.contracts.parameters import Parameters

P = TypeVar("P", bound=Parameters)

Progress = Callable[[float, str], None]
"""Called now and then while a synthesis works: the part that is done, 0 to 1, and what it is at."""


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
    """

    params: P
    residual: Scalar
    figures: Mapping[str, Scalar] = field(default_factory=dict)

    def as_dict(self) -> dict[str, Any]:
        """Residual and figures as plain data for JSON."""
        figures = {name: {"value": one.value, "unit": one.unit} for name, one in self.figures.items()}
        return {"residual": {"value": self.residual.value, "unit": self.residual.unit}, "figures": figures}


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
    """

    candidates: tuple[Candidate[P], ...]
    findings: tuple[Finding, ...] = ()
