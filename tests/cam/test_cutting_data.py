"""Tables [cam.cutting.TOOL]: cutting data of a design over those of the library."""

import pytest

from mechwright.designs.design import load
from mechwright.errors import ToolError
from mechwright.plugins.host import host
from mechwright_cam.planning.prepare import prepare
from mechwright_cam.shop.library import built_in
from mechwright_cam.shop.tool import CuttingChange

HEAD = 'format = 1\nfamily = "elliptic-gears"\nname = "pair"\n[parameters]\nteeth = 21\nmodule = 3\n'
TOOLS = '[cam]\ntools = ["mill-6", "mill-3", "mill-2", "drill-8", "spot-6"]\n'


def jobs(tmp_path, text):
    path = tmp_path / "pair.toml"
    path.write_text(HEAD + text)
    design = load(path, host())
    findings, found = prepare(design, design.family.parts(design.params))
    return {job.part.name: {tool.name: tool for tool in job.tools} for job in found}, findings


@pytest.mark.parametrize(
    ("key", "value"),
    [("cutting_speed", 81.0), ("chip_load", 0.013), ("step_down", 0.31), ("step_over", 0.27)],
)
def test_one_figure_changes_and_the_others_stay(key, value):
    before = built_in().get("mill-6")
    after = built_in().cutting({"mill-6": CuttingChange(**{key: value})}).get("mill-6")
    for material, data in after.cutting.items():
        assert getattr(data, key) == value
        assert data == before.cutting[material].model_copy(update={key: value})


def test_a_design_changes_its_own_tools_and_a_part_its_own(tmp_path):
    text = TOOLS + "[cam.cutting.mill-6]\nstep_down = 0.3\n"
    found, _ = jobs(tmp_path, text)
    assert found["gear"]["mill-6"].cutting["steel"].step_down == 0.3
    assert found["gear"]["mill-3"] == built_in().get("mill-3")
    text += "[cam.part.gear.cutting.mill-6]\nstep_over = 0.2\n"
    found, _ = jobs(tmp_path, text)
    data = found["gear"]["mill-6"].cutting["steel"]
    assert (data.step_down, data.step_over) == (0.3, 0.2)


def test_data_far_from_the_usual_are_a_warning(tmp_path):
    _, findings = jobs(tmp_path, TOOLS + "[cam.cutting.mill-6]\ncutting_speed = 1500\n")
    assert "cam.cutting-data" in {finding.code for finding in findings}


def test_speed_and_chip_load_stand_for_a_material_that_the_library_does_not_know():
    mill = built_in().get("mill-6")
    bare = built_in().extended((mill.model_copy(update={"cutting": {}}),))
    half = bare.cutting({"mill-6": CuttingChange(cutting_speed=50)})
    assert half.get("mill-6").cutting == {}
    whole = bare.cutting({"mill-6": CuttingChange(cutting_speed=50, chip_load=0.02)})
    assert whole.get("mill-6").cutting["steel"].chip_load == 0.02


@pytest.mark.parametrize(
    ("table", "key"),
    [
        ("[cam.cutting.mill-66]\nstep_down = 0.3\n", r"cam\.cutting"),
        ("[cam.measured]\nlengths = { mill-66 = 80 }\n", r"cam\.measured\.lengths"),
        ("[cam.part.gear.cutting.mill-66]\nstep_down = 0.3\n", r"cam\.part\.gear\.cutting"),
    ],
)
def test_a_name_of_no_tool_is_refused(table, key, tmp_path):
    with pytest.raises(ToolError, match=key + r": no tool 'mill-66' in the library; did you mean"):
        jobs(tmp_path, table)


def test_data_of_a_tool_that_is_not_used_are_told_of(tmp_path):
    _, findings = jobs(tmp_path, TOOLS + "[cam.cutting.mill-12]\nstep_down = 0.3\n")
    assert [f.parameter for f in findings if f.code == "cam.cutting-unused"] == ["cam.cutting.mill-12"]
    _, findings = jobs(tmp_path, TOOLS + "[cam.cutting.mill-6]\nstep_down = 0.3\n")
    assert "cam.cutting-unused" not in {finding.code for finding in findings}
