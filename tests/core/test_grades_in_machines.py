"""A grade of a material is taken wherever its group is: each table by material has it."""

import tomllib
from pathlib import Path

import pytest
from by_night import by_night

from mechwright.designs.design import design_of
from mechwright.plugins.host import host

EXAMPLES = Path(__file__).parents[2] / "examples"
MACHINES = sorted(one.stem for one in EXAMPLES.glob("*-machine.toml"))
DAY = {"slider-crank-machine", "cam-slide-machine", "elliptic-pair-machine"}


@pytest.mark.parametrize("grade", ["7075", "S235"])
@pytest.mark.parametrize(
    "name", [one if one in DAY else pytest.param(one, marks=by_night) for one in MACHINES]
)
def test_a_machine_of_a_grade_has_parts_or_a_finding(name, grade):
    path = EXAMPLES / f"{name}.toml"
    content = tomllib.loads(path.read_text(encoding="utf-8"))
    if "material" in content["parameters"]:
        content["parameters"]["material"] = grade
    content["machine"]["plate_material"] = grade
    design = design_of(content, path, "", host())
    findings, parts = design.check(), design.parts()
    assert all(one.code for one in findings)
    assert any(part.material == grade for part in parts)
