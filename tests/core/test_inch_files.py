"""Files whose bare numbers are in inches."""

import tomllib

import pytest

from mechwright.contracts.table import laid_over
from mechwright.designs.design import design_of, load
from mechwright.designs.hints import schemas_of
from mechwright.designs.inches import converted, units_of, written
from mechwright.errors import DesignError
from mechwright.plugins.host import host
from mechwright.studies.study import load_study

INCH = """
format = 1
family = "slider-crank"
name = "inch"
units = "inch"
[parameters]
crank = 1
rod = 4.5
thickness = "6 mm"
[cam]
clearance = 0.25
hold.method = "none"
hold.toe_clamps = [[-8, -8, -7, -7, 0.5]]
[cam.machine]
rapid = 400
spindle_power = 3
[cam.cutting.mill-6]
cutting_speed = 600
[cam.part.crank-crank]
stock.margin = 0.5
"""


@pytest.fixture
def design(tmp_path):
    path = tmp_path / "inch.toml"
    path.write_text(INCH)
    return load(path, host())


def test_lengths_feeds_and_speeds_are_converted_and_nothing_else(design):
    assert design.units == "inch"
    assert (design.params.crank, design.params.rod, design.params.thickness) == (25.4, 114.3, 6.0)
    cam = design.tables["cam"].cam
    assert cam.clearance == 6.35
    assert cam.hold.toe_clamps == ((-203.2, -203.2, -177.8, -177.8, 12.7),)
    assert (cam.machine.rapid, cam.machine.spindle_power) == (10160.0, 3.0)
    assert cam.cutting["mill-6"].cutting_speed == pytest.approx(182.88)
    assert design.tables["cam"].parts["crank-crank"].stock.margin == 12.7
    # What it leaves out is as in any file.
    assert cam.breakthrough == 0.3


def test_a_change_is_judged_in_mm_and_written_with_its_unit(design):
    changed = design.changed({"parameters.crank": 30.0, "cam.clearance": 8.0})
    assert (changed.params.crank, changed.tables["cam"].cam.clearance) == (30.0, 8.0)
    assert changed.params.rod == 114.3
    schemas = schemas_of(host(), design.content, "parameters")
    said = written({"parameters.crank": 30.0, "cam.climb": False}, "inch", schemas)
    assert said == {"parameters.crank": "30 mm", "cam.climb": False}
    content = tomllib.loads(INCH)
    content["parameters"]["crank"] = said["parameters.crank"]
    assert design_of(content, design.path, "", host()).params.crank == 30.0
    clamps = written({"cam.hold.toe_clamps": [[1.0, 2.0, 3.0, 4.0, 5.0]]}, "inch", schemas)
    assert clamps == {"cam.hold.toe_clamps": [["1 mm", "2 mm", "3 mm", "4 mm", "5 mm"]]}


def test_the_file_of_a_design_in_inches_says_the_same_in_mm(design, tmp_path):
    path = tmp_path / "mm.toml"
    path.write_text(design.text)
    again = load(path, host())
    assert (again.units, again.params) == ("mm", design.params)
    assert again.tables["cam"].cam == design.tables["cam"].cam


def test_units_that_are_none_and_figures_of_mistakes(tmp_path):
    with pytest.raises(DesignError, match='units: is \'feet\'; write "mm" or "inch"'):
        units_of({"units": "feet"}, tmp_path / "a.toml")
    content = tomllib.loads(INCH)
    content["cam"]["clearance"] = 100
    with pytest.raises(
        DesignError, match=r"clearance: 2540.0 .*in inches; the figures of the message are in"
    ):
        design_of(content, tmp_path / "a.toml", "", host())


def test_every_number_with_a_length_in_the_schemas_is_found():
    """Wherever a schema has a length, 1 becomes 25.4, and what has none stays."""
    schema = {
        "properties": {
            "a": {"anyOf": [{"unit": "mm", "type": "number"}, {"type": "null"}]},
            "b": {"prefixItems": [{"unit": "deg"}, {"$ref": "#/$defs/L"}], "type": "array"},
            "c": {"additionalProperties": {"$ref": "#/$defs/T"}},
            "d": {"items": {"unit": "m/min"}},
        },
        "$defs": {"L": {"unit": "mm"}, "T": {"properties": {"v": {"unit": "mm/min"}, "n": {}}}},
    }
    said = {"a": 1, "b": [1, 1], "c": {"x": {"v": 1, "n": 1, "o": True}}, "d": [1, "1 mm"], "e": 1}
    wanted = {
        "a": 25.4,
        "b": [1, 25.4],
        "c": {"x": {"v": 25.4, "n": 1, "o": True}},
        "d": [0.3048, "1 mm"],
        "e": 1,
    }
    assert converted(said, schema) == wanted


def test_tables_lie_over_each_other():
    assert laid_over("haas-vf-2", {"max_feed": 1}) == "haas-vf-2"
    assert laid_over({"a": {"b": 1}}, {"a": 3, "c": 4}) == {"a": {"b": 1}, "c": 4}


def test_requirements_in_inches_and_studies_that_refuse_them(tmp_path):
    from mechwright.designs.requirement import load_requirement

    path = tmp_path / "stroke.toml"
    path.write_text(
        'format = 1\nfamily = "slider-crank"\nunits = "inch"\n[requirement]\nkind = "stroke"\nstroke = 4\n'
    )
    assert load_requirement(path, host()).table.stroke == 101.6
    study = tmp_path / "study.toml"
    study.write_text(
        'format = 1\nfamily = "slider-crank"\nunits = "inch"\n[study.ranges]\ncrank = {low = 1, high = 2}\n'
    )
    with pytest.raises(DesignError, match="a study is in mm"):
        load_study(study, host())
