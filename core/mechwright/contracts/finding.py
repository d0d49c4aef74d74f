"""What a check has to say about a design."""

from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass
from enum import StrEnum
from typing import Any, TypeVar

from mechwright.errors import DesignError

S = TypeVar("S")


class Severity(StrEnum):
    """How grave a finding is."""

    ERROR = "error"
    """The part would be wrong or cannot be made: nothing is built."""
    WARNING = "warning"
    """It can be built, but an engineer should look."""
    NOTE = "note"
    """A figure worth knowing."""


@dataclass(frozen=True, slots=True)
class Finding:
    """One result of a check.

    Parameters
    ----------
    code
        Stable, dotted, lower-case name of the check (``"gear.undercut"``).
    severity
        Error, warning or note.
    parameter
        The design-file key it is about (``"teeth"``, ``"cam.tools"``); empty if none.
    message
        One sentence that says what was found.
    value, limit
        The number found and the one it is compared with, in ``unit``; None where there is none.
    unit
        Unit of both.
    remedy
        What to do, in words; empty for a note.
    """

    code: str
    severity: Severity
    parameter: str
    message: str
    value: float | None = None
    limit: float | None = None
    unit: str = ""
    remedy: str = ""

    def __str__(self) -> str:
        where = f"{self.parameter}: " if self.parameter else ""
        cure = f"; {self.remedy}" if self.remedy else ""
        return f"{self.severity} [{self.code}] {where}{self.message}{cure}"

    def as_dict(self) -> dict[str, Any]:
        """Give the finding as plain data for JSON."""
        return asdict(self)


def errors(findings: Iterable[Finding]) -> list[Finding]:
    """Give the findings that forbid building."""
    return [finding for finding in findings if finding.severity is Severity.ERROR]


def until_error(subject: S, *checks: Callable[[S], Iterable[Finding]]) -> tuple[Finding, ...]:
    """Run checks one after the other, up to the first that finds an error: later ones rely on the earlier."""
    found: list[Finding] = []
    for check in checks:
        found += check(subject)
        if errors(found):
            break
    return tuple(found)


def refuse(findings: Iterable[Finding]) -> None:
    """Raise the first error among the findings as a DesignError; do nothing if there is none."""
    for finding in errors(findings):
        raise DesignError(f"{finding.parameter}: {finding.message}; {finding.remedy}")
