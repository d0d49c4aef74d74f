"""What is raised where findings forbid what is asked for."""

from collections.abc import Iterable
from pathlib import Path

from mechwright.contracts.finding import Finding, Findings
from mechwright.errors import DesignError


class RefusedError(DesignError):
    """Findings forbid what is asked for; the message is the first of them.

    Parameters
    ----------
    path
        The design file.
    findings
        The errors, at least one.
    """

    def __init__(self, path: Path, findings: Iterable[Finding]) -> None:
        self.findings = Findings(findings)
        more = len(self.findings) - 1
        super().__init__(f"{path}: {self.findings[0]}" + (f" (and {more} more)" if more else ""))
