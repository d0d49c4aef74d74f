"""Remedies that change several sizes, or that a search finds: for errors that no change of one size mends."""

from dataclasses import replace
from typing import Any

from mechwright import Finding, Severity, kept
from mechwright.contracts.finding import errors
from mechwright_geneva.defaults.dimensions import complete, mechanism_of
from mechwright_geneva.parameters import GenevaParams
from mechwright_geneva.rules.rule_table import RULES
from mechwright_geneva.rules.slot_search import slot_remedy

SEARCHED = tuple(
    f"geneva.{name}" for name in ("offset-sign", "mouth", "undercut", "loop", "island-tip", "island", "web")
)
"""Codes of what is wrong with a curved slot: another offset angle or roller may mend it."""

GROUPS = (
    ("crank_half_angle", "offset_angle"),
    ("roller_radius", "pin_diameter"),
    ("entry_radius", "centre_distance"),
    ("bore", "driver_bore", "fixing", "hub_diameter", "keyway_width", "driver_keyway_width", "least_wall"),
    ("lock_radius", "lock_clearance", "groove_clearance", "counterbore_diameter", "rollers"),
)
"""Keys that are left out together; a later group along with all before it. So what says most about the
mechanism, wheel and bores, stands longest."""

_LAST = "choose another law, or the sizes that stand in the way smaller"

_TENTH, _CLOSE = 0.1, 0.01
"""How near to the first value that is not valid the one is that is named: a tenth, or a hundredth of it."""


def with_remedy(params: GenevaParams, finding: Finding) -> Finding:
    """An error with a remedy about sizes that the design gives, and not about what has been made of them.

    Where no change of one size mends it, the remedy is the change of several that does.
    """
    if finding.severity is not Severity.ERROR:
        return finding
    given = [key for key in GenevaParams.model_fields if key in params.model_fields_set]
    remedy = finding.remedy
    if not remedy and finding.code in SEARCHED and params.law != "straight":
        remedy = slot_remedy(mechanism_of(params))
    if not (remedy and set(given) & {finding.parameter, *remedy.split()}):
        remedy = without_sizes(params) or remedy or _LAST
    return replace(finding, remedy=remedy)


@kept
def without_sizes(params: GenevaParams) -> str:
    """The change that makes a design valid, in words; tried. Empty if none does."""
    omitted: set[str] = set()
    for group in GROUPS:
        given = {key for key in group if key in params.model_fields_set}
        omitted |= given
        if not given:
            continue
        table = {k: v for k, v in params.model_dump(exclude_unset=True).items() if k not in omitted}
        if not _valid(table):
            continue
        sizes = complete(GenevaParams.model_validate(table))
        values = {key: getattr(sizes, key) for key in GenevaParams.model_fields if key in omitted}
        if len(values) == 1:
            values = {key: _nearest(table, key, getattr(params, key), value) for key, value in values.items()}
        said = ", ".join(f"{key} = {value:.6g}" for key, value in values.items() if value is not None)
        gone = ", ".join(key for key, value in values.items() if value is None)
        return ", and ".join([f"use {said}"] * bool(said) + [f"leave out {gone}"] * bool(gone))
    return ""


def _valid(table: dict[str, Any]) -> bool:
    return not errors(RULES.findings(mechanism_of(GenevaParams.model_validate(table)), quick=True))


def _nearest(table: dict[str, Any], key: str, given: float, value: float | None) -> float | None:
    """The value nearest to the given one, in tenths, from which on up to a valid one the design is valid."""
    if value is None or isinstance(given, int):
        return value
    bad, good = given, value
    while abs(good - bad) > max(_TENTH, _CLOSE * abs(good)):
        middle = round((good + bad) / 2, 1)
        if middle in (good, bad):
            break
        if _valid({**table, key: middle}):
            good = middle
        else:
            bad = middle
    return good
