"""The examples build, and say what they are."""

import json
import re
import warnings
from pathlib import Path

import numpy as np
import pytest
from by_night import by_night
from four_bar_reference import poles_of
from typer.testing import CliRunner

from mechwright.cli.app import make_app
from mechwright.contracts.finding import Severity
from mechwright.designs.design import load
from mechwright.designs.requirement import load_requirement
from mechwright.plugins.host import host
from mechwright_four_bar.family import FourBars
from mechwright_four_bar.kinematics.reach import bar_of

EXAMPLES = Path(__file__).parents[2] / "examples"
REQUIREMENTS = sorted(
    path.name
    for path in EXAMPLES.glob("*-requirement.toml")
    if 'family = "four-bar"' in path.read_text(encoding="utf-8")
)


@by_night
def test_the_crank_rocker_builds_without_a_warning(tmp_path):
    path = EXAMPLES / "crank-rocker-three-poles.toml"
    design = load(path, host())
    assert {finding.severity for finding in FourBars().check(design.params)} == {Severity.NOTE}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        done = CliRunner().invoke(make_app(), ["build", str(path), "-o", str(tmp_path / "out")])
    assert done.exit_code == 0, done.output
    assert "warning" not in done.output
    made = {file.name for file in (tmp_path / "out").iterdir()}
    for part in ("ground", "crank", "coupler", "follower"):
        assert {f"{part}.dxf", f"{part}.step"} <= made
        assert any(name.startswith(f"{part}.") and name.endswith((".ngc", ".nc")) for name in made)
    proof = json.loads((tmp_path / "out" / "proof.json").read_text(encoding="utf-8"))
    assert proof
    assert "assembly.step" in made


def test_the_crank_rocker_has_its_poles_where_it_says():
    text = (EXAMPLES / "crank-rocker-three-poles.toml").read_text(encoding="utf-8")
    places = [complex(float(x), float(y)) for x, y in re.findall(r"\((-?[\d.]+), (-?[\d.]+)\)", text)]
    params = load(EXAMPLES / "crank-rocker-three-poles.toml", host()).params
    asked = load_requirement(EXAMPLES / "crank-rocker-poles-requirement.toml", host()).table
    assert places == [complex(*pole) for pole in asked.poles]
    first = np.radians(float(re.search(r"crank angle of ([\d.]+) degrees", text)[1]))
    found = poles_of(bar_of(params), first + np.radians(asked.crank_turns))
    assert np.abs(found - places).max() < 0.03  # the angle is rounded to a hundredth


@pytest.mark.parametrize("name", REQUIREMENTS)
def test_requirement_files_give_designs(name, tmp_path):
    asked = load_requirement(EXAMPLES / name, host())
    few = asked.table.model_copy(update={"designs": 2})
    if hasattr(few, "starts"):
        few = few.model_copy(update={"starts": min(few.starts, 20_000)})
    result = asked.family.synthesise(asked.kind, few, lambda part, text: None)
    assert result.candidates
    assert all(finding.severity is Severity.NOTE for finding in result.findings)


def test_there_are_requirement_files():
    assert len(REQUIREMENTS) == 6
