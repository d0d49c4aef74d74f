"""Every example can be read; that they build without a warning is tested family by family."""

from pathlib import Path

import pytest

from mechwright.contracts.family import Family
from mechwright.contracts.finding import Severity
from mechwright.designs.design import load
from mechwright.designs.requirement import load_requirement
from mechwright.plugins.host import host
from mechwright.studies.study import load_study

EXAMPLES = sorted((Path(__file__).parents[1] / "examples").glob("*.toml"))
REQUIREMENTS = [path for path in EXAMPLES if path.stem.endswith("-requirement")]
STUDIES = [path for path in EXAMPLES if path.stem.endswith("-study")]
LINKAGES = sorted((Path(__file__).parents[1] / "examples" / "linkages").glob("*.toml"))
DESIGNS = [path for path in EXAMPLES if path not in REQUIREMENTS + STUDIES]


def test_every_family_has_a_design_and_every_synthesis_a_requirement() -> None:
    families = host().of(Family)
    assert {load(path, host()).family.name for path in (*DESIGNS, *LINKAGES)} == set(families)
    able = {name for name, entry in families.items() if entry.item.requirements}
    assert {load_requirement(path, host()).family.name for path in REQUIREMENTS} == able


@pytest.mark.parametrize("path", DESIGNS, ids=lambda path: path.stem)
def test_a_design_has_no_fault_and_says_what_it_is(path: Path) -> None:
    design = load(path, host())
    found = design.check()
    assert [finding for finding in found if finding.severity is not Severity.NOTE] == []
    assert path.read_text(encoding="utf-8").startswith("# ")


@pytest.mark.parametrize("path", REQUIREMENTS, ids=lambda path: path.stem)
def test_a_requirement_says_how_it_is_met(path: Path) -> None:
    assert f"mechwright synthesize examples/{path.name}" in path.read_text(encoding="utf-8")


@pytest.mark.parametrize("path", STUDIES, ids=lambda path: path.stem)
def test_a_study_says_how_it_is_run_and_is_evaluated_at_once(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    assert text.startswith("# ")
    assert f"mechwright sweep examples/{path.name}" in text
    study = load_study(path, host())
    assert study.count >= 10**6
    assert type(study.family).evaluate is not Family.evaluate
