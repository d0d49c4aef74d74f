"""The bill of materials: its lines, its sums against the assembly's STEP file, and its place in a build."""

import csv
import io
import re
from dataclasses import replace
from pathlib import Path

import cadquery as cq
import numpy as np
import pytest

from mechwright.contracts.bought import Bought
from mechwright.contracts.fits import shaft_fit
from mechwright.contracts.materials import material
from mechwright.contracts.part import Instance, Part
from mechwright.contracts.turned import Step, Turned, tube
from mechwright.geometry import Loop, Outline
from mechwright.pipeline import Blank, Build, Wanted
from mechwright.plugins.host import host
from mechwright.standards.bearings import bearing
from mechwright.standards.dowels import dowel_for
from mechwright.standards.screws import screw
from mechwright.standards.supply import Supply
from mechwright_cad.bill.items import numbers_of
from mechwright_cad.bill.lines import ABSENT, COLUMNS, lines_of
from mechwright_cad.bill.page import BillOfMaterials, bars_of, bill_csv, bill_html
from mechwright_cad.bill.stock import pieces
from mechwright_cad.exporters import StepExporter
from mechwright_cad.solid_models import masses

EXAMPLES = Path(__file__).parents[2] / "examples"

PLATE = Outline(Loop.polygon([(0, 0), (40, 0), (40, 20), (0, 20)]))


def bought(name, what, *bodies):
    return Part(name, None, 0.0, "steel", tuple(Instance(body) for body in bodies), bought=what)


PARTS = (
    bought("bearing", bearing("608").bought, "base", "base"),
    Part("plate", PLATE, 8.0, "aluminium", (Instance("base", 2.0),)),
    Part("spacer", None, 0.0, "brass", (Instance("base"), Instance("crank")), turned=tube(8, 11.9, 6)),
    Part("other", PLATE, 8.0, "aluminium"),
    bought("dowel", dowel_for(4, 16).bought, "base"),
    bought("dowel-b", dowel_for(4, 16).bought, "crank"),
    bought("screw", screw(4, 12).bought, "base", "base", "base"),
)


ORDER = ("spacer", "plate", "bearing", "dowel", "screw")


@pytest.fixture(scope="module")
def lines():
    return lines_of(
        PARTS,
        masses(PARTS),
        (),
        {"spacer": ("spacer.dxf", "spacer.pdf")},
        ORDER,
        supplies=(Supply("oil", "machine oil", "on threads", 1, "as needed"),),
        electrics=(Supply("fuse", "fuse 1 A", "in the line"),),
    )


def test_made_bought_stock_and_supplies_have_numbers_of_their_own(lines):
    assert [(line.item, line.qty, line.name) for line in lines] == [
        (1, 2, "spacer"),
        (2, 1, "plate"),
        (3, 1, "other"),
        (101, 2, "bearing"),
        (102, 2, "dowel, dowel-b"),
        (103, 3, "screw"),
        (201, 2, "stock for spacer"),
        (202, 1, "stock for plate"),
        (203, 1, "stock for other"),
        (301, 1, "oil"),
        (401, 1, "fuse"),
    ]
    assert {line.kind for line in lines} == {"made", "bought", "stock", "supply", "electrical"}


def test_each_line_says_how_it_is_ordered_and_what_it_is_of(lines):
    by_name = {line.name: line for line in lines}
    assert all(line.order for line in lines if line.kind != "made")
    assert by_name["plate"].grade == "EN AW-6082 T651"
    assert by_name["spacer"].grade == "CuZn39Pb3 (CW614N)"
    assert by_name["screw"].grade == "class 8.8"
    assert by_name["screw"].inch.startswith("ASME B18.3.1M")
    assert by_name["stock for plate"].order == "EN AW-6082 T651, plate 8, sawn 62 x 42 mm"
    assert by_name["stock for plate"].inch == "6061-T651, plate 3/8 in (9.525 mm), cut down to 8"
    assert by_name["stock for spacer"].order == "CuZn39Pb3 (CW614N), drawn h9, round 14, sawn 12 mm"
    assert by_name["oil"].note == "on threads"


def test_what_nobody_sells_is_cut_from_the_next_size():
    odd = Part("odd", PLATE, 13.5, "aluminium", (Instance("base"),))
    stud = Part("stud", None, 0.0, "steel", (Instance("base"),), turned=Turned((Step(12.0, 20.0),)))
    fitted = Part(
        "fitted",
        None,
        0.0,
        "steel",
        (Instance("base"),),
        turned=Turned((Step(12.0, 20.0, shaft_fit(12, "h6")),)),
    )
    plate, kept, cut = pieces((odd, stud, fitted), ())
    assert plate.designation == "plate 62.0 x 42.0 x 15"
    assert "face it to 13.5" in plate.note
    assert plate.mass == pytest.approx(62 * 42 * 15 * 2.7e-3)
    assert kept.designation == "round bar 12 x 26"
    assert kept.note.endswith("the outside of 12 mm stays as drawn")
    assert cut.designation == "round bar 14 x 26"


def test_bars_are_added_up_with_their_saw_cuts(lines):
    assert bars_of([line for line in lines if line.kind == "stock"]) == [
        ("CuZn39Pb3 (CW614N), drawn h9, round 14", pytest.approx(2 * 0.015))
    ]


def test_equal_parts_share_an_item_and_mirror_images_do_not():
    odd = Outline(Loop.polygon([(0, 0), (40, 0), (40, 20)]))
    mirrored = Outline(Loop.polygon([(0, 0), (-40, 20), (-40, 0)]))
    at = (Instance("base"),)
    ring = tube(8, 11.9, 6)
    parts = (
        Part("left", odd, 8.0, "aluminium", at),
        Part("right", mirrored, 8.0, "aluminium", at),
        Part("left-again", odd, 8.0, "aluminium", at),
        Part("thicker", odd, 9.0, "aluminium", at),
        Part("ring-a", None, 0.0, "brass", at, turned=ring),
        Part("ring-b", None, 0.0, "brass", at, turned=replace(ring)),
        Part("ring-c", None, 0.0, "steel", at, turned=ring),
    )
    assert numbers_of(parts, ["ring-b", "right"]) == {
        "ring-a": 1,
        "ring-b": 1,
        "right": 2,
        "left": 3,
        "left-again": 3,
        "thicker": 4,
        "ring-c": 5,
    }


def test_a_line_says_how_a_part_is_ordered_or_what_it_is_cut_from(lines):
    by_name = {line.name: line for line in lines}
    assert by_name["screw"].designation == "ISO 4762 - M4 x 12 - 8.8"
    assert by_name["dowel, dowel-b"].standard == "ISO 8734"
    assert by_name["spacer"].stock == "round 11.9 x 6"
    assert by_name["spacer"].drawing == "spacer.dxf spacer.pdf"
    assert by_name["stock for spacer"].designation == "round bar 14 x 12"
    assert by_name["stock for plate"].designation == "plate 62.0 x 42.0 x 8"
    assert by_name["stock for plate"].note.startswith("for item 2; ")
    assert by_name["other"].note == ABSENT
    assert by_name["stock for plate"].mass_each_g == pytest.approx(62 * 42 * 8 * 2.7e-3)


def test_catalogue_masses_and_volumes_add_up(lines):
    by_name = {line.name: line for line in lines}
    assert by_name["bearing"].mass_g == pytest.approx(24.0)
    assert by_name["plate"].mass_g == pytest.approx(40 * 20 * 8 * 2.7e-3)
    assert by_name["spacer"].mass_g == pytest.approx(2 * np.pi / 4 * (11.9**2 - 64) * 6 * 8.5e-3, rel=1e-6)
    assert all(line.mass_g == pytest.approx(line.qty * line.mass_each_g) for line in lines)


def test_plates_that_a_process_speaks_for_are_as_it_says():
    blank = Blank(("plate", "other"), 1, "aluminium", (120.0, 60.0, 8.0))
    stock = [line for line in lines_of(PARTS, masses(PARTS), (blank,), {}, ORDER) if line.kind == "stock"]
    assert [(line.designation, line.name) for line in stock] == [
        ("plate 120.0 x 60.0 x 8", "stock for plate, other"),
        ("round bar 14 x 12", "stock for spacer"),
    ]
    assert stock[0].note == "for item 2, 3; as the setup sheet has it"


def test_the_table_is_read_back_as_it_was(lines):
    text = bill_csv(lines)
    assert text.splitlines()[0] == ",".join(COLUMNS)
    assert "\r" not in text
    rows = list(csv.DictReader(io.StringIO(text)))
    assert [row["designation"] for row in rows] == [line.designation for line in lines]
    assert [float(row["mass_g"]) for row in rows] == pytest.approx([line.mass_g for line in lines], abs=0.005)
    assert bill_csv(lines) == bill_csv(
        lines_of(
            PARTS,
            masses(PARTS),
            (),
            {"spacer": ("spacer.dxf", "spacer.pdf")},
            ORDER,
            supplies=(Supply("oil", "machine oil", "on threads", 1, "as needed"),),
            electrics=(Supply("fuse", "fuse 1 A", "in the line"),),
        )
    )


def test_names_are_escaped_on_the_page(lines):
    page = bill_html("a <b> design", [replace(lines[0], note="1 < 2")])
    assert "a &lt;b&gt; design" in page
    assert "1 &lt; 2" in page
    assert "<h2>Bought" not in page, "no heading over nothing"


@pytest.fixture(scope="module", params=["slider-crank-quick-return", "spherical-crank-rocker"])
def built(request, tmp_path_factory):
    path = EXAMPLES / f"{request.param}.toml"
    with Build(path, host(), Wanted("model")) as build:
        files = BillOfMaterials().files(build)
        motion, sample = build.pose
        step = StepExporter().assembly(build.design.name, build.parts, motion, sample)
        parts = {part.name: part for part in build.parts}
    file = tmp_path_factory.mktemp("bill") / "assembly.step"
    file.write_bytes(step)
    return list(csv.DictReader(io.StringIO(files["bill-of-materials.csv"]))), files, file, parts


def test_bodies_of_the_assembly_are_the_sum_of_what_is_made_and_bought(built):
    rows, files, file, _ = built
    bodies = [row for row in rows if row["kind"] in {"made", "bought"} and ABSENT not in row["note"]]
    assert sum(int(row["qty"]) for row in bodies) == len(cq.importers.importStep(str(file)).solids().vals())
    (count, mass) = re.search(r"(\d+) parts?, ([\d.]+) kg", files["bill-of-materials.html"]).groups()
    made = [row for row in rows if row["kind"] in {"made", "bought"}]
    assert int(count) == sum(int(row["qty"]) for row in made)
    assert float(mass) == pytest.approx(sum(float(row["mass_g"]) for row in made) / 1000, abs=6e-4)


def test_masses_are_those_of_the_bodies_in_the_file(built):
    rows, _, file, parts = built
    grams = 0.0
    for child in cq.Assembly.importStep(str(file)).children:
        name = child.name if child.name in parts else _part_of(child.name, parts)
        grams += child.toCompound().Volume() * material(parts[name].material).density / 1000
    listed = [row for row in rows if row["kind"] in {"made", "bought"} and ABSENT not in row["note"]]
    assert sum(float(row["mass_g"]) for row in listed) == pytest.approx(grams, rel=1e-3)


def _part_of(body, parts):
    """The part of an occurrence, which is named by its body."""
    bodies = {instance.body: name for name, part in parts.items() for instance in part.instances}
    named = [name for name in parts if re.search(rf"-{re.escape(name)}(-\d+)?$", body)]
    return max(named, key=len) if named else bodies[body]


def test_a_part_may_be_ordered_without_a_standard():
    line = lines_of(
        (bought("x", Bought("spring 1 x 8 x 20", "", 2.5, bearing("608").bought.shape), "b"),),
        {"x": 2.5},
        (),
        {},
    )[0]
    assert (line.designation, line.standard, line.mass_g) == ("spring 1 x 8 x 20", "", 2.5)
