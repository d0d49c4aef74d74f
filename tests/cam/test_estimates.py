"""Cutting data of small machines: the table that they are read from, published settings, and how they are told."""

import json
import math
from pathlib import Path

import pytest
from shop import plate_job

from mechwright.contracts.materials import GROUPS, material
from mechwright_cam.operations.bending import borne_depth, borne_wall, pass_depth
from mechwright_cam.operations.rates import rates
from mechwright_cam.shop.estimates import completed, estimate, rigidity_of
from mechwright_cam.shop.machine import SIDE_FORCE, Machine, known_machines
from mechwright_cam.shop.tool import CuttingData, Tool

DATA = json.loads(Path(__file__).parents[1].joinpath("data", "makers.json").read_text())
CLASSES = "ABCD"
PUBLISHED = {
    "3018 (A)": Machine(rigidity="A", spindle_min=1000, spindle_max=10000, max_feed=900),
    "LongMill (B)": Machine(rigidity="B", spindle_min=10000, spindle_max=30000, max_feed=3600),
}
MATERIALS = {
    "plywood": "plywood",
    "pine": "plywood",
    "hardwood": "plywood",
    "softwood, mdf": "mdf",
    "acrylic": "acrylic",
    "aluminium": "aluminium",
    "aluminium 6061": "aluminium",
}
APART = {("3018 (A)", "aluminium"): 0.41, ("LongMill (B)", "aluminium 6061"): 0.38}
"""Removal in that of settings that are the upper end of what is published: 32 and 47 N a tooth, and makers
differ three to five times."""


def mill(diameter: float, flutes: int = 1) -> Tool:
    return Tool(name="mill", number=1, kind="end-mill", diameter=diameter, flutes=flutes, flute_length=5)


@pytest.mark.parametrize("row", DATA["materials"], ids=lambda row: row["name"])
@pytest.mark.parametrize("kind", CLASSES)
def test_chip_loads_and_depths_are_those_of_the_table(row, kind) -> None:
    machine = Machine(rigidity=kind, spindle_min=10, spindle_max=200000)
    for place, diameter in enumerate(row["diameters"]):
        data = estimate(mill(diameter), row["name"], machine)
        assert data.chip_load == pytest.approx(row["chip_load"][kind][place], abs=1e-9)
        assert data.step_down * diameter == pytest.approx(row["slot_depth"][kind][place], abs=0.006)


def test_forces_of_the_classes_are_those_of_the_table() -> None:
    assert DATA["side_force"] == SIDE_FORCE


@pytest.mark.parametrize(
    "row",
    [row for row in DATA["published"] if row["machine"] in PUBLISHED],
    ids=lambda row: f"{row['machine']}-{row['material']}-{row['d']}",
)
def test_published_settings_are_within_a_factor_of_two(row) -> None:
    """The volume that is removed, at the published speed and width."""
    machine, name = PUBLISHED[row["machine"]], MATERIALS[row["material"]]
    flutes = row.get("z", 2)
    data = estimate(mill(row["d"], flutes), name, machine)
    feed, deep = data.chip_load * flutes * row["rpm"], data.step_down * row["d"]
    ratio = feed * deep / (row["feed"] * row["depth"])
    apart = APART.get((row["machine"], row["material"]))
    if apart is None:
        assert 0.5 <= ratio <= 2.0
    else:
        assert ratio == pytest.approx(apart, abs=0.02)


SLOWEST = 16000
"""Of the router of an MPCNC, rev/min: for settings that name no speed."""
LIKE = {**MATERIALS, "softer than metal": "plywood", "aluminium, maker of the cutter": "aluminium"}


def removal(row) -> float:
    """What the estimate removes in that of a published setting, at the same speed and width."""
    kind, flutes = ("B" if row["machine"].endswith("(B)") else "A"), row.get("z", 2)
    machine = Machine(rigidity=kind, spindle_min=1000, spindle_max=30000)
    data, speed = estimate(mill(row["d"], flutes), LIKE[row["material"]], machine), row.get("rpm", SLOWEST)
    feed = row.get("feed") or row["chip_load"] * flutes * speed
    return data.chip_load * flutes * speed * data.step_down * row["d"] / (feed * row["depth"])


@pytest.mark.parametrize("row", DATA["published"], ids=lambda row: f"{row['machine']}-{row['material']}")
def test_the_page_has_each_published_setting_with_what_the_estimate_makes_of_it(row) -> None:
    page = Path(__file__).parents[2].joinpath("docs", "small-machines.md").read_text()
    start = f"| {row['machine']} | {row['material']} | {row['d']:g} | {row['depth']:g} | "
    assert f"{start}{removal(row):.2f} |" in page


@pytest.mark.parametrize("name", DATA["machines"])
def test_every_desktop_machine_is_known(name) -> None:
    said, (figures, preset) = DATA["machines"][name], known_machines()[name]
    machine = Machine.model_validate(figures)
    assert [machine.travel_x, machine.travel_y, machine.travel_z] == said["travel"]
    assert machine.rigidity == said["rigidity"]
    if said["speeds"]:
        assert [machine.spindle_min, machine.spindle_max] == said["speeds"]
    else:
        assert "spindle" in preset.unknown
    assert machine.nose_to_table is None  # which nobody publishes


def test_a_machine_without_a_class_is_taken_for_one_by_its_power() -> None:
    kinds = [rigidity_of(Machine(spindle_power=power)) for power in (0.06, 0.7, 2.2, 5.5)]
    assert kinds == list(CLASSES)
    assert rigidity_of(Machine(spindle_power=5.5, rigidity="A")) == "A"


def test_what_a_tool_has_stays_and_what_none_has_is_estimated() -> None:
    own = CuttingData(cutting_speed=80, chip_load=0.02)
    known = mill(3.0).model_copy(update={"cutting": {"pom": own}})
    machine = Machine(rigidity="B")
    with_data, without = completed((known, mill(2.0)), ["pom", "acrylic"], machine)
    assert with_data.cutting["pom"] is own
    assert with_data.is_estimated("acrylic")
    assert not with_data.is_estimated("pom")
    assert without.is_estimated("pom")
    assert completed((known,), ["pom"], machine) == (known,)


def test_there_is_no_estimate_for_steel_nor_for_a_spindle_that_cannot_turn_so_slowly() -> None:
    assert estimate(mill(6.0), "steel", Machine(rigidity="C")) is None
    fast = Machine(rigidity="B", spindle_min=20000, spindle_max=30000)
    assert estimate(mill(6.0), "acrylic", fast) is None  # 377 m/min, and 300 at most
    assert estimate(mill(3.0), "acrylic", fast) is not None


def test_speeds_are_those_of_the_dial() -> None:
    machine = Machine.model_validate(known_machines()["longmill-mk2-30x30"][0])
    tool = completed((mill(6.0),), ["plywood"], machine)[0]
    assert rates(tool, "plywood", machine).spindle in machine.dial
    assert machine.speed(16999) == 12000
    assert machine.speed(100) == 10000
    assert machine.speed(99999) == 30000


def test_a_tooth_takes_no_more_than_the_machine_bears() -> None:
    weak = plate_job(machine={"side_force": 20.0})
    strong = plate_job()
    (tool,) = (tool for tool in weak.tools if tool.name == "mill-6")
    tool = tool.model_copy(update={"cutting": {"aluminium": CuttingData(cutting_speed=100, chip_load=0.02)}})
    stuff = material("aluminium")
    deep = pass_depth(weak, tool, 5.0)
    assert stuff.force * 0.02 ** (1 - stuff.force_exponent) * deep == pytest.approx(20.0)
    assert pass_depth(strong, tool, 5.0) == pytest.approx(3.0)
    assert borne_depth(strong, tool) == borne_wall(strong, tool) == math.inf
    assert borne_wall(weak, tool) < 6.0


def test_every_group_says_of_what_kind_it_is() -> None:
    assert {one.kind for one in GROUPS.values()} == {"wood", "plastic", "soft metal", "steel"}
    assert all(material(name).soft == (one.kind in {"wood", "plastic"}) for name, one in GROUPS.items())
