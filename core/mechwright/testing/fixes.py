"""Whether a printed remedy holds: the file with the change is written, read and checked anew."""

import tomllib
from abc import abstractmethod
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, ClassVar

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from pydantic import ValidationError

from mechwright.contracts.family import Family
from mechwright.contracts.finding import Finding, Severity, Stage, errors
from mechwright.designs.change import rewritten
from mechwright.designs.design import Design
from mechwright.designs.text import toml
from mechwright.remedies import Limits, tried

LIMITS = Limits(tries=24, seconds=3.0)
"""For each design: a contract asks whether what is found is true, not whether everything is found."""

EXAMPLES = 6
"""Random designs whose remedies are tried: each takes up to some seconds."""


class FixTests:
    """The part of :class:`mechwright.testing.FamilyContract` that is about remedies."""

    family: ClassVar[type[Family[Any]]]
    """The class under test."""
    refused: ClassVar[Sequence[tuple[Mapping[str, Any], str]]] = ()
    """Tables that must not build."""

    @abstractmethod
    def strategy(self) -> st.SearchStrategy[Mapping[str, Any]]:
        """Random tables."""

    def test_fixes_of_refused_designs(self) -> None:
        """With a change that is told as the remedy of a finding, that is gone, and no new error stands."""
        faults = [fault for table, _ in self.refused for fault in fix_faults(self.family(), table)]
        assert not faults, "; ".join(faults)

    def test_judge_says_what_check_says(self) -> None:
        """What is found fast is part of what is found, with the same parameter and in the same words."""
        family = self.family()
        for table, _ in self.refused:
            try:
                params = family.Params.model_validate(dict(table))
            except ValidationError:
                continue
            said = {_statement(one) for one in family.check(params)}
            for one in filter(_counts, family.judge(params)):
                assert _statement(one) in said, f"{one} is not in check"

    def test_fixes_of_random_designs(self) -> None:
        """The same of any design."""

        # Inside the method: hypothesis wants one test function for each class that inherits this one.
        @settings(
            max_examples=EXAMPLES,
            deadline=None,
            suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],
        )
        @given(self.strategy())
        def fixes_hold(table: Mapping[str, Any]) -> None:
            faults = fix_faults(self.family(), table)
            assert not faults, "; ".join(faults)

        fixes_hold()


def fix_faults(family: Family[Any], table: Mapping[str, Any]) -> list[str]:
    """Remedies of a table's findings that do not hold; none for a table that validation refuses."""
    try:
        params = family.Params.model_validate(dict(table))
    except ValidationError:
        return []
    lines = [f"{key} = {toml(value)}\n" for key, value in table.items() if value is not None]
    text = "".join(["[parameters]\n", *lines])
    design = Design("tried", family, params, Path("tried.toml"), "", content=tomllib.loads(text))
    findings = list(family.check(params))
    stood = {_identity(finding) for finding in errors(findings)}
    faults = []
    for finding in tried(design, findings, LIMITS):
        if finding.fix is None:
            continue
        changed = tomllib.loads(rewritten(text, finding.fix))["parameters"]
        left = [one for one in family.check(family.Params.model_validate(changed)) if _counts(one)]
        where = f"finding {finding.code!r} with {dict(finding.fix)}"
        if _identity(finding) in map(_identity, left):
            faults.append(f"{where}: it is found all the same")
        faults += [f"{where}: {one}" for one in errors(left) if _identity(one) not in stood]
    return faults


def _counts(finding: Finding) -> bool:
    return finding.severity is not Severity.NOTE


def _statement(finding: Finding) -> tuple[Severity, Stage, str, str, str]:
    return finding.severity, finding.stage, *_identity(finding), finding.message


def _identity(finding: Finding) -> tuple[str, str]:
    return finding.code, finding.parameter
