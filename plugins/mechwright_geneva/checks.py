"""What an engineer would object to in a design, and the figures worth knowing."""

from dataclasses import replace

from mechwright import Finding, Severity, kept
from mechwright_geneva.cures import slot_cure
from mechwright_geneva.mechanism import mechanism_of
from mechwright_geneva.params import GenevaParams
from mechwright_geneva.released import released
from mechwright_geneva.slot_checks import CURED
from mechwright_geneva.unmended import unmended

_LAST = "choose another law, or the sizes that stand in the way smaller"


@kept
def findings(params: GenevaParams) -> tuple[Finding, ...]:
    """Everything that is to be said about a design. No error among it means that the parts can be built."""
    return tuple(_mended(params, finding) for finding in unmended(params))


def _mended(params: GenevaParams, finding: Finding) -> Finding:
    """An error about a size that the design gives, and not about what has been made of it.

    Where no change of one size cures it, the remedy is the change of several that does.
    """
    if finding.severity is not Severity.ERROR:
        return finding
    given = [key for key in GenevaParams.model_fields if key in params.model_fields_set]
    remedy = finding.remedy
    if not remedy and finding.code in CURED and not mechanism_of(params).straight:
        remedy = slot_cure(mechanism_of(params))
    named = next((key for key in given if key in (finding.parameter, *remedy.split())), "")
    if not (remedy and named):
        other, key = released(params)
        remedy, named = (other, key) if other else (remedy or _LAST, finding.parameter)
    return replace(
        finding, remedy=remedy, parameter=finding.parameter if finding.parameter in given else named
    )
