"""A shop in inches with three mills, two drills and a reamer makes the first examples, or says what to buy."""

from pathlib import Path

import pytest
from by_night import in_ci

from mechwright.contracts.finding import errors
from mechwright.designs.design import load
from mechwright.pipeline import Build, Wanted
from mechwright.plugins.host import host
from mechwright_cam.machining import Machining
from mechwright_cam.planning.assign import Assignments
from mechwright_cam.planning.prepare import library_of
from mechwright_cam.planning.to_buy import lacking
from mechwright_cam.shop.table import settings_of
from mechwright_cam.shop.toml_text import tool_table
from mechwright_cam.shop.tool import ToolKind
from mechwright_cam.shop.workshop_file import VARIABLE, read_shop

EXAMPLES = Path(__file__).parents[2] / "examples"
SHOP = EXAMPLES / "shops" / "bench-inches.toml"
FIRST = {
    "elliptic-pair": set(),
    "geneva-prototype": set(),
    "slider-crank-quick-return": set(),
    "spherical-crank-rocker": set(),
    "crank-rocker-finished": {ToolKind.CHAMFER, ToolKind.THREAD_MILL},
}
"""The first example of each family, and the kinds of tool that are to be bought for it."""


def test_the_shop_is_three_mills_two_drills_and_a_reamer() -> None:
    shop = read_shop(SHOP)
    kinds = [str(tool.kind) for tool in shop.library]
    assert sorted(kinds) == ["drill"] * 2 + ["end-mill"] * 3 + ["reamer", "spot-drill"]
    assert shop.workshop.units == "inch"
    assert shop.library.get("reamer-6h7").diameter == 6.0
    assert shop.library.get("mill-1-8").diameter == 3.175


@in_ci
@pytest.mark.parametrize("name", FIRST)
def test_first_examples_are_built_or_a_tool_is_named_with_which_they_are(
    name: str, tmp_path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(VARIABLE, str(SHOP))
    with Build(load(EXAMPLES / f"{name}.toml", host()), host(), Wanted("cam")) as build:
        machining = build.made(Machining)
        if not errors(machining.findings):
            assert not FIRST[name]
            assert all(one.proof.ok and "G20" in one.text for one in machining.proven_programs)
            return
        design, library = build.design, library_of(build.design)
        buy, told = {}, [one.message for one in machining.findings if one.code == "shop.buy"]
        for part in machining.plates:
            for tool in lacking(part, settings_of(design).of(part.name), library, Assignments()):
                buy[tool.name] = tool
    assert {tool.kind for tool in buy.values()} == FIRST[name]
    assert all(any(f"{tool.diameter:g} mm" in line for line in told) for tool in buy.values())
    text = SHOP.read_text() + "".join("\n" + tool_table(tool, "inch") for tool in buy.values())
    (tmp_path / "shop.toml").write_text(text)
    monkeypatch.setenv(VARIABLE, str(tmp_path / "shop.toml"))
    with Build(load(EXAMPLES / f"{name}.toml", host()), host(), Wanted("cam")) as build:
        machining = build.made(Machining)
        assert not errors(machining.findings)
        assert all(one.proof.ok for one in machining.proven_programs)


def test_a_part_that_the_crib_does_not_make_names_a_tool(tmp_path) -> None:
    """By day on one small part: without its small mills the shop says which one the dowel holes want."""
    text = SHOP.read_text()
    start = text.index('[[tool]]\nname = "mill-3-16"')
    end = text.index('[[tool]]\nname = "drill-1"')
    (tmp_path / "shop.toml").write_text(text[:start] + text[end:])
    path = tmp_path / "rod.toml"
    path.write_text('format = 1\nfamily = "slider-crank"\nshop = "shop.toml"\n')
    with Build(load(path, host()), host(), Wanted("check")) as build:
        machining = build.made(Machining)
        told = [one.message for one in machining.findings if one.code == "shop.buy"]
    assert errors(machining.findings)
    assert told
    assert all("can be cut with what shop.toml has and " in line for line in told)
