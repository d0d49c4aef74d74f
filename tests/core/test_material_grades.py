"""Grades of materials: figures of handbooks, what they are ordered as, and how they are cut."""

import re
from pathlib import Path

import pytest

from mechwright.contracts.materials import GROUPS, MATERIALS, entry, material
from mechwright.mechanics.strength.allowed import allowed
from mechwright.standards.screws import least_engaged
from mechwright.standards.stock import bar_stock, plate_stock
from mechwright_cam.operations.rates import rates
from mechwright_cam.shop.library import built_in, load_library
from mechwright_cam.shop.machine import Machine
from mechwright_cam.shop.toml_text import tool_table
from mechwright_cam.shop.tool import CuttingData, CuttingTable

ROOT = Path(__file__).parents[2]

HANDBOOK = {
    "5754": (2.67, (80, 80), 70, 24, "5052-H32"),
    "6082": (2.70, (240, 260), 70, 23.4, "6061-T6"),
    "7075": (2.81, (440, 470), 72, 23.5, "7075-T651"),
    "5083": (2.66, (110, 125), 71, 24, "MIC-6"),
    "S235": (7.85, (235, 235), 210, 12, "A36"),
    "C45": (7.85, (305, 340), 210, 11.5, "1045"),
    "1.4301": (7.9, (210, 210), 200, 16, "304"),
}
"""Density, yield strength from and to, modulus, GPa, expansion and US grade; handbook."""


@pytest.mark.parametrize("name", HANDBOOK)
def test_a_grade_has_the_figures_of_handbooks(name):
    density, (low, high), modulus, expansion, american = HANDBOOK[name]
    found = material(name)
    assert (found.density, found.modulus, found.expansion) == (density, 1000 * modulus, expansion)
    assert low <= found.strength <= high
    assert american.split("-")[0] in found.grades.us_plate
    assert found.group in GROUPS


THREADS = {"S235": 216.0, "C45": 348.0, "6082": 188.5, "5754": 123.5, "7075": 331.5}
"""Shear strength of threads, MPa: 0.6 of Rm of steel, 0.65 of aluminium's."""


@pytest.mark.parametrize("name", THREADS)
def test_threads_strip_at_the_shear_strength_of_their_grade(name):
    assert allowed(name).shear == THREADS[name]


def test_stronger_grades_bear_more_in_every_way():
    for weak, strong in (("5754", "6082"), ("6082", "7075"), ("S235", "C45"), ("1.4305", "1.4301")):
        less, more = allowed(weak), allowed(strong)
        assert all(getattr(less, one) < getattr(more, one) for one in vars(less))
    assert allowed("6082") == allowed("aluminium")


def test_a_grade_has_an_entry_of_its_own_or_that_of_its_group():
    assert (least_engaged("5754"), least_engaged("7075"), least_engaged("1.4301")) == (2.0, 1.5, 1.0)
    assert plate_stock("5083").thicknesses[0] == 5
    assert plate_stock("7075") == plate_stock("aluminium")
    assert bar_stock("C45") == bar_stock("steel")
    assert entry({"steel": 1}, "7075") is None


def test_a_grade_is_cut_as_its_group_and_stainless_more_slowly():
    for tool in built_in():
        assert tool.cutting["7075"] == tool.cutting["aluminium"]
        if "steel" not in tool.cutting:  # a cutter for aluminium
            continue
        assert tool.cutting["C45"] == tool.cutting["steel"]
        stainless, steel = tool.cutting["1.4301"], tool.cutting["steel"]
        assert stainless.cutting_speed == pytest.approx(0.6 * steel.cutting_speed)
        assert stainless.chip_load == steel.chip_load
    mill = built_in().get("mill-6")
    machine = Machine(spindle_max=60000, max_feed=20000)
    slow, usual = rates(mill, "1.4301", machine), rates(mill, "steel", machine)
    assert slow.spindle == pytest.approx(0.6 * usual.spindle, rel=1e-3)


def test_data_of_a_grade_itself_come_first():
    table = CuttingTable(
        {
            "aluminium": CuttingData(cutting_speed=300, chip_load=0.05),
            "7075": CuttingData(cutting_speed=200, chip_load=0.04),
        }
    )
    assert (table["7075"].cutting_speed, table["6082"].cutting_speed) == (200, 300)
    assert "5754" in table
    assert "steel" not in table
    assert "C45" not in table
    with pytest.raises(KeyError):
        table["C45"]
    with pytest.raises(KeyError):
        table["cheese"]


@pytest.mark.parametrize("units", ["mm", "inch"])
def test_data_of_a_grade_are_written_and_read_again(tmp_path, units):
    data = CuttingData(cutting_speed=70, chip_load=0.02)
    mill = (
        built_in().get("mill-6").model_copy(update={"cutting": CuttingTable({"1.4301": data, "C45": data})})
    )
    path = tmp_path / "crib.toml"
    head = "" if units == "mm" else 'units = "inch"\n'
    path.write_text(f"built_in = false\n{head}{tool_table(mill, units)}")
    (again,) = load_library(path)
    assert set(again.cutting) == {"1.4301", "C45"}
    assert again.cutting["1.4301"].cutting_speed == pytest.approx(70)
    assert again.cutting["1.4301"].chip_load == pytest.approx(0.02)


def test_the_page_of_materials_has_every_figure():
    text = (ROOT / "docs/materials.md").read_text()
    rows = {
        row.split("`")[1]: row
        for row in re.findall(r"^\| `[^|]+` \|.*1?\|.*\|.*\|.*\|.*\|.*\|$", text, re.MULTILINE)
    }
    for one in MATERIALS.values():
        cells = [cell.strip() for cell in rows[one.name].split("|")[1:-1]]
        assert cells[2:6] == [one.grades.plate, one.grades.us_plate, one.grades.bar, one.grades.us_bar]
        assert cells[6:] == [f"{x:g}" for x in (one.density, one.strength, one.modulus / 1000, one.expansion)]
