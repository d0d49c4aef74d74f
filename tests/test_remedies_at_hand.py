"""What is at hand stays as it is: a remedy changes the design and not the mill, and knows what the shop lends."""

import json
import math
from collections.abc import Callable
from pathlib import Path

import pytest
from by_night import by_night

from mechwright.designs.change import rewritten
from mechwright.designs.design import Design, load
from mechwright.plugins.host import host
from mechwright.remedies import Limits, of_family
from mechwright.remedies.keys import keys_of
from mechwright.remedies.words import said

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
