"""What an engineer would object to in a design, and the figures worth knowing."""

from dataclasses import replace

from mechwright import Finding, Severity, kept
from mechwright_geneva.params import GenevaParams
from mechwright_geneva.released import released
from mechwright_geneva.unmended import unmended


@kept
def findings(params: GenevaParams) -> tuple[Finding, ...]:
    """Everything that is to be said about a design. No error among it means that the parts can be built."""
    return tuple(_mended(params, finding) for finding in unmended(params))


def _mended(params: GenevaParams, finding: Finding) -> Finding:
    """An error that no change of one size cures, with the changes of several that do.

    It is about a size that the design gives, not about what has been made of it.
    """
    if finding.severity is not Severity.ERROR or finding.remedy:
        return finding
    remedy, key = released(params)
    given = finding.parameter in params.model_fields_set
    return replace(finding, remedy=remedy, parameter=finding.parameter if given else key)
