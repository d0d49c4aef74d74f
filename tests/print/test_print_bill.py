"""The bill of materials of a machine whose parts are printed: filament by mass, inserts, rods, tools."""

import csv
import io
import math
import re
import shutil

import pytest
import tomlkit

from mechwright.pipeline import Build, Wanted
from mechwright.plugins.host import host
from mechwright_cad.bill.page import CSV, HTML, BillOfMaterials
from mechwright_print.job.print_job import PrintJob


def bill(tmp_path, request, example: str, head: str, **table) -> tuple[list[dict], dict, str]:
    """The lines, the masses of the print, and the page."""
    source = request.config.rootpath / f"examples/{example}.toml"
    for beside in source.parent.glob("*.dxf"):
        shutil.copy(beside, tmp_path)
    content = tomlkit.parse(source.read_text())
    if table:
        content["print"] = table
    path = tmp_path / "design.toml"
    path.write_text(head + tomlkit.dumps(content))
    with Build(path, host(), Wanted("build")) as build:
        files = BillOfMaterials().files(build)
        masses = build.made(PrintJob).masses if head else {}
    return list(csv.DictReader(io.StringIO(files[CSV]))), masses, files[HTML]


def test_filament_is_stock_by_its_mass_and_shafts_are_rods(tmp_path, request):
    lines, masses, page = bill(tmp_path, request, "geneva-straight", 'process = "print"\n')
    by_name = {line["name"]: line for line in lines}
    (filament,) = [line for line in lines if line["designation"] == "filament PLA"]
    total = sum(masses.values())
    assert float(filament["mass_g"]) == pytest.approx(total, abs=0.01)
    assert filament["order"] == f"PLA filament, {math.ceil(total)} g"
    assert filament["kind"] == "stock"
    for name in ("wheel", "locking-disc", "crank"):
        assert by_name[name]["material"] == "PLA"
        assert float(by_name[name]["mass_g"]) == pytest.approx(masses[name], abs=0.01)
    assert not [line for line in lines if line["designation"].startswith("plate ")]
    assert by_name["stock for roller"]["designation"].startswith("round bar ")
    assert "PLA filament" in page


def test_only_what_the_printer_makes_is_of_filament(tmp_path, request):
    head = 'process = { default = "laser", parts.crank = "print" }\n'
    lines, masses, _ = bill(tmp_path, request, "geneva-straight", head, fits="ream")
    assert list(masses) == ["crank"]
    by_name = {line["name"]: line for line in lines}
    assert by_name["crank"]["material"] == "PLA"
    assert by_name["wheel"]["material"] == "aluminium"
    (tool,) = [line for line in lines if line["order"] == "ream 5 H7"]
    assert (tool["unit"], tool["kind"]) == ("tool", "supply")
    assert tool["note"] == f"for item {by_name['crank']['item']}, after printing"


def test_gears_get_a_bush(tmp_path, request):
    holes = {"gear-1.bore": "bush", "gear-2.bore": "bush"}
    lines, _, _ = bill(tmp_path, request, "spur-gears", 'process = "print"\n', holes=holes)
    bushes = {line["order"]: int(line["qty"]) for line in lines if line["order"].startswith("ISO 2795")}
    sizes = [re.search(r"J (\d+) x (\d+) x (\d+)", order).groups() for order in bushes]
    assert len(sizes) == len(bushes) > 0
    assert sum(bushes.values()) == 2
    with Build(tmp_path / "design.toml", host()) as build:
        job = build.made(PrintJob)
        for one in job.parts:
            (hole,) = one.made.holes
            assert hole.bush.bore == hole.fit.size
            assert hole.target == pytest.approx(hole.bush.outside + 2 * job.printer.side_clearance("snug"))
            assert hole.bush.length <= one.part.thickness
            (bore,) = [feature for feature in one.made.model.features if feature.name == "bore"]
            assert bore.diameter == pytest.approx(hole.target - job.printer.hole_off(hole.target))


def test_inserts_are_counted(tmp_path, request):
    lines, _, _ = bill(tmp_path, request, "nema-17-plate", 'process = "print"\n')
    inserts = {line["order"]: int(line["qty"]) for line in lines if line["order"].startswith("heat-set")}
    assert inserts == {"heat-set insert M5 x 9.5": 4}
    plain, _, _ = bill(tmp_path, request, "nema-17-plate", "")
    assert not [line for line in plain if "heat-set" in line["order"] or "filament" in line["designation"]]
