"""What is at hand stays as it is: a remedy changes the design and not the mill, and knows what the shop lends."""

import json
import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from by_night import by_night

from mechwright.contracts.finding import Finding
from mechwright.designs.change import rewritten
from mechwright.designs.design import Design, load
from mechwright.plugins.host import host
from mechwright.remedies import Bench, Limits, of_family
from mechwright.remedies.keys import Key, keys_of
from mechwright.remedies.remedied import with_proposed
from mechwright.remedies.values import ladder
from mechwright.remedies.words import said
from mechwright_cam.shop.table import settings_of

Run = Callable[..., tuple[int, str, str]]

LARGE = {
    "four-bar": "crank = 300\ncoupler = 800\nfollower = 700\nground = 900\n",
    "slider-crank": "crank = 300\nrod = 1000\n",
    "spherical": 'kind = "four-bar"\nradius = 500\n',
    "geneva": "entry_radius = 400\n",
    "elliptic-gears": "semi_major = 300\nteeth = 80\n",
}
NIGHT = ("spherical", "geneva", "elliptic-gears")
SHOP = """\
[prefer.cam]
clearance = 7
hold.tabs = 6

[[stock]]
material = "aluminium"
thickness = [8]

[[tool]]
name = "mine-6"
number = 1
kind = "end-mill"
diameter = 6
flute_length = 20
[tool.cutting]
aluminium = { cutting_speed = 150, chip_load = 0.03 }
"""


@pytest.mark.parametrize(
    "family", [pytest.param(name, marks=by_night) if name in NIGHT else name for name in LARGE]
)
def test_what_is_larger_than_the_mill_is_made_smaller_and_keeps_its_shape(
    family: str, command_line: Run, tmp_path: Path
) -> None:
    path = tmp_path / "large.toml"
    text = f'family = "{family}"\n[parameters]\n{LARGE[family]}'
    path.write_text(text, encoding="utf-8")
    code, told, _ = command_line("check", path, "--json")
    large = [one for one in json.loads(told)["findings"] if one["code"] == "cam.travel"]
    assert code == 1
    assert large
    for one in large:
        assert one["fix"]
        assert all(key.startswith("parameters.") for key in one["fix"])
        before = load(path, host()).content["parameters"]
        ratios = [value / before[key.removeprefix("parameters.")] for key, value in one["fix"].items()]
        assert max(ratios) < 1
        assert max(ratios) - min(ratios) < 0.02  # rounded to three digits
    last = min(large, key=lambda one: min(one["fix"].values()))
    path.write_text(rewritten(text, last["fix"]), encoding="utf-8")
    after = json.loads(command_line("check", path, "--json")[1])["findings"]
    assert "cam.travel" not in {one["code"] for one in after}


def test_the_travel_that_a_part_needs_is_named(command_line: Run, tmp_path: Path) -> None:
    path = tmp_path / "small-mill.toml"
    path.write_text('family = "four-bar"\n[cam.machine]\ntravel_x = 11\ntravel_y = 11\n', encoding="utf-8")
    code, told, _ = command_line("check", path, "--json")
    found = [one for one in json.loads(told)["findings"] if one["code"] == "cam.travel"]
    assert code == 1
    assert found
    for one in found:
        assert one["message"].endswith(f"of travel in {one['parameter'][-1].upper()}, the machine has 11")
        if one["fix"] is None:
            least = math.ceil(one["value"] / 10) * 10
            words = f"take a machine with {least} mm in {one['parameter'][-1].upper()}, or a smaller part"
            assert one["remedy"].startswith(words)
    assert any(one["fix"] is None for one in found)


def test_no_search_changes_a_figure_of_the_mill(tmp_path: Path) -> None:
    path = tmp_path / "any.toml"
    path.write_text('family = "four-bar"\n', encoding="utf-8")
    bench = of_family(load(path, host()), Limits())
    assert bench.found({"cam.machine.travel_x": 2000}) is None
    assert bench.found({"cam.machine.retract_z": -5}) is not None
    assert "cam.machine.spindle_max" not in bench.keys
    assert "cam.machine.retract_z" in bench.keys


@pytest.fixture
def in_a_shop(tmp_path: Path) -> Callable[[str], Design]:
    def made(more: str = "") -> Design:
        (tmp_path / "shop.toml").write_text(SHOP)
        path = tmp_path / "gear.toml"
        path.write_text(f'family = "elliptic-gears"\nshop = "shop.toml"\n[cam]\n{more}')
        return load(path, host())

    return made


def test_a_remedy_says_what_the_shop_lends(in_a_shop: Callable[[str], Design]) -> None:
    bench = of_family(in_a_shop(""), Limits())
    assert said(bench, {"cam.clearance": 8}) == "set cam.clearance = 8 (now 7, lent by the shop)"
    assert said(bench, {"cam.hold.tabs": 4}) == "set cam.hold.tabs = 4 (now 6, lent by the shop)"
    assert said(bench, {"cam.breakthrough": 1}) == "set cam.breakthrough = 1 (now 0.3, by default)"
    assert bench.now(bench.keys["cam.clearance"]) == 7


def test_what_the_file_says_goes_back_to_what_the_shop_lends(in_a_shop: Callable[[str], Design]) -> None:
    design = in_a_shop("clearance = 9\n")
    key = keys_of(design)["cam.clearance"]
    assert (key.now(design.content), key.default, key.lender) == (9, 7, "shop")
    assert said(of_family(design, Limits()), {"cam.clearance": None}) == "leave out cam.clearance (now 9)"
    assert keys_of(design)["machine.plates"].lender == ""  # the design has no machine that plates could be of


def _found(design: Design, ask: Callable[[Design], Finding | None]) -> Finding:
    """What is told of a design where ``ask`` finds an error, with what it proposes tried."""
    finding = ask(design)
    assert finding is not None
    bench = Bench(design, lambda changed: [one for one in [ask(changed)] if one is not None])
    return with_proposed(bench, finding)


def test_tools_that_the_shop_lends_are_not_left_out_but_left_to_the_program(
    in_a_shop: Callable[[str], Design], tmp_path: Path
) -> None:
    """Leaving ``cam.tools`` out would leave the two mills of the shop as they are."""

    def lacks(design: Design) -> Finding | None:
        tools = settings_of(design).cam.tools
        free = ({"cam.tools": None},)
        return Finding.error("cam.cannot-cut", "cam.tools", "no mill fits", proposed=free) if tools else None

    in_a_shop("")
    shop = tmp_path / "shop.toml"
    shop.write_text(SHOP.replace("clearance = 7", 'clearance = 7\ntools = ["mine-6"]'))
    lent = load(tmp_path / "gear.toml", host())
    told = _found(lent, lacks)
    assert told.fix == {"cam.tools": []}
    assert told.remedy == 'set cam.tools = [] (now ["mine-6"], lent by the shop)'
    assert settings_of(lent.changed(told.fix)).cam.tools == ()
    shop.write_text(SHOP)
    said = _found(in_a_shop('tools = ["mine-6"]\n'), lacks)
    assert said.fix == {"cam.tools": None}


def test_what_a_proposal_brings_to_light_is_followed(in_a_shop: Callable[[str], Design]) -> None:
    """Tabs have no room, the clamp is too wide then, and only tape and a thinner plate do."""

    def judged(design: Design) -> Finding | None:
        hold, thickness = settings_of(design).cam.hold, vars(design.params)["thickness"]
        if hold.method == "tabs":
            ways = ({"cam.hold.method": "bore"}, {"cam.hold.method": "none", "cam.hold.bed": "tape"})
            return Finding.error("cam.cannot-cut", "cam.hold.tabs", "no room", proposed=ways)
        if hold.method == "bore":
            return Finding.error("cam.cannot-cut", "cam.hold.clamp_diameter", "too wide")
        if thickness > 5:
            thin = tuple({"parameters.thickness": share * thickness} for share in (0.8, 0.4))
            return Finding.error("gear.cut-mesh", "cam.tools", "collides", proposed=thin)
        return None

    told = _found(in_a_shop(""), judged)
    assert told.fix == {"cam.hold.method": "none", "cam.hold.bed": "tape", "parameters.thickness": 4}


def test_a_list_that_was_asked_for_is_not_left_out() -> None:
    """Leaving out the swings of a lever cures it as well as leaving out the mechanism."""
    asked = Key("parameters.swings", "other", first=True)
    assert ladder(asked, [30, 30, 0, 0]) == []
    assert ladder(replace(asked, first=False), [30, 30, 0, 0]) == [None]
