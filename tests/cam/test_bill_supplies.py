"""What a machine's list has beside its bodies: supplies, loose dowels, washers, and what the motor takes."""

import csv
import io
import re
from pathlib import Path

import pytest

from mechwright.contracts.finding import Severity
from mechwright.pipeline import Build, Wanted
from mechwright.plugins.host import host
from mechwright_cad.bill.inspections import SoldPlates
from mechwright_cad.bill.page import BillOfMaterials

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture(scope="module", params=["geneva-machine", "slider-crank-machine"])
def rows(request):
    with Build(EXAMPLES / f"{request.param}.toml", host(), Wanted("model")) as build:
        files = BillOfMaterials().files(build)
        return request.param, list(csv.DictReader(io.StringIO(files["bill-of-materials.csv"])))


def test_a_machine_can_be_bought_by_its_list(rows):
    _, found = rows
    names = {row["name"] for row in found}
    assert {
        "thread locker",
        "cleaner",
        "oil",
        "power supply",
        "driver",
        "controller",
        "emergency stop",
    } <= names
    assert all(row["item"] and row["qty"] and row["unit"] for row in found)
    assert len({row["item"] for row in found}) == len(found)
    assert all(row["order"] for row in found if row["kind"] != "made")
    assert all(row["grade"] for row in found if row["kind"] in {"made", "stock"})
    assert all(row["note"] for row in found if row["kind"] in {"supply", "electrical", "stock"})
    assert all(float(row["mass_g"]) == 0 for row in found if row["kind"] in {"supply", "electrical"})


def test_the_dowels_of_a_geneva_crank_are_on_the_list_and_those_that_are_drawn_stand_once(rows):
    name, found = rows
    loose = [row for row in found if row["name"] == "dowel" and row["kind"] == "supply"]
    if name == "geneva-machine":
        (row,) = loose
        assert (row["qty"], row["designation"]) == ("2", "ISO 8734 - 4 x 20")
    else:
        assert not loose
        assert sum(row["designation"].startswith("ISO 8734") for row in found) == 1


def test_pillars_are_of_bars_of_their_own_diameter_and_no_plate_is_faced(rows):
    _, found = rows
    stock = [row for row in found if row["kind"] == "stock"]
    (pillar, *_) = [row for row in stock if row["name"] == "stock for pillar"]
    assert pillar["designation"].startswith("round bar 12 x ")
    assert not [row for row in stock if "face it" in row["note"]]


@pytest.mark.parametrize(
    ("plates", "severity"), [("", Severity.WARNING), ("\n[machine]\nplates = [13.5]\n", None)]
)
def test_a_thickness_that_nobody_sells_is_named_with_the_nearest_that_are(tmp_path, plates, severity):
    """Unless such a plate is in hand."""
    text = (EXAMPLES / "geneva-cycloidal.toml").read_text(encoding="utf-8")
    path = tmp_path / "design.toml"
    path.write_text(re.sub(r"(?m)^thickness = .*", "thickness = 13.5", text) + plates, encoding="utf-8")
    found = SoldPlates().findings(Build(path, host()))
    assert [one.severity for one in found] == ([] if severity is None else [severity])
    for one in found:
        assert (one.parameter, one.value) == ("parameters.thickness", 13.5)
        assert one.message.endswith("as wheel takes it: one of 15 mm has to be faced")
        assert one.remedy == "make it 12 or 15 mm"
        assert one.proposed == ({"parameters.thickness": 12.0}, {"parameters.thickness": 15.0})
