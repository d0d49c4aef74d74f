"""What is told of a design that a printer cannot make as drawn, and lines that help."""

import math
from pathlib import Path

import pytest
import tomlkit

from mechwright.cli.hosting import open_host
from mechwright.contracts.part import Part
from mechwright.designs.design import load
from mechwright.errors import DesignError
from mechwright.geometry import Loop, Outline
from mechwright.pipeline import Build
from mechwright_print.rules.inspection import Printable, findings_of
from mechwright_print.rules.walls import narrowest

GEARS = """format = 1
family = "spur-gears"
name = "gears"

[parameters]
teeth = 18
mate_teeth = 30
bore = {bore}
module = {module}
"""
FIVE = "examples/five-bar-published.toml"


def build(tmp_path, text: str, **tables) -> Build:
    """A build of a design file with tables, and a printer file beside it."""
    content = tomlkit.parse(text)
    printer = tables.pop("printer", None)
    if printer is not None:
        (tmp_path / "printer.toml").write_text(tomlkit.dumps(printer))
        tables.setdefault("print", {})["printer"] = "printer.toml"
    for name, table in tables.items():
        content[name] = table
    path = tmp_path / "design.toml"
    path.write_text(tomlkit.dumps(content))
    return Build(load(path, open_host()), open_host())


def gears(tmp_path, module: float = 2.0, **tables) -> Build:
    return build(tmp_path, text_of(module), **tables)


def text_of(module: float) -> str:
    return GEARS.format(module=module, bore=8 if module >= 1.5 else 3)


def codes(found) -> set[str]:
    return {one.code for one in found}


def test_teeth_finer_than_the_nozzle_are_refused_with_the_module_that_works(tmp_path):
    asked = gears(tmp_path, 0.4, print={})
    (found,) = [one for one in findings_of(asked) if one.code == "print.thin-wall"][:1]
    assert found.severity == "error"
    assert "nozzle 0.4 mm" in found.message
    (change,) = found.proposed
    module = change["parameters.module"]
    assert f"set module = {module:g}" in found.remedy
    better = gears(tmp_path, module, print={})
    assert "print.thin-wall" not in codes(findings_of(better))
    worse = gears(tmp_path, 0.75 * module, print={})
    assert "print.thin-wall" in codes(findings_of(worse))


def test_a_nozzle_that_is_named_prints_the_same_teeth(tmp_path):
    fine = gears(tmp_path, 0.8, printer={"nozzle": 0.2})
    assert "print.thin-wall" not in codes(findings_of(fine))
    coarse = gears(tmp_path, 0.8, printer={"nozzle": 0.4})
    (thin, *_) = [one for one in findings_of(coarse) if one.code == "print.thin-wall"]
    assert "set nozzle = 0.2" in thin.remedy


def test_a_bed_too_small_is_told_with_one_that_does(tmp_path):
    small = gears(tmp_path, 2.0, printer={"bed": {"x": 60, "y": 60}})
    found = [one for one in findings_of(small) if one.code == "print.bed"]
    assert [one.severity for one in found] == ["error"]
    assert "take a printer with a bed of 74 x 74 mm" in found[0].remedy
    assert "print.bed" not in codes(findings_of(gears(tmp_path, 2.0, printer={"bed": {"x": 74, "y": 74}})))


def test_heights_off_the_layers_are_told_with_the_first_layer_that_helps(tmp_path):
    odd = gears(tmp_path, 2.0, printer={"layer": 0.28, "first_layer": 0.28})
    (found, *_) = [one for one in findings_of(odd) if one.code == "print.layers"]
    first = float(found.remedy.split("first_layer = ")[1].split()[0])
    assert (10 - first) / 0.28 == pytest.approx(round((10 - first) / 0.28), abs=0.01)
    good = gears(tmp_path, 2.0, printer={"layer": 0.28, "first_layer": first})
    assert "print.layers" not in codes(findings_of(good))


def test_fits_in_their_drawn_size_are_refused_and_reamed_ones_are_not(tmp_path):
    drawn = gears(tmp_path, print={"fits": "drawn"})
    found = [one for one in findings_of(drawn) if one.code == "print.fit"]
    assert len(found) == 1
    assert found[0].limit == pytest.approx(0.015)
    assert found[0].message.startswith("gear-1.bore, gear-2.bore: ")
    assert found[0].value == pytest.approx(0.6)
    assert 'holes = { "gear-1.bore" = "ream", "gear-2.bore" = "ream" }' in found[0].remedy
    reamed = gears(tmp_path, print={"holes": {"gear-1.bore": "ream", "gear-2.bore": "ream"}, "fits": "drawn"})
    assert "print.fit" not in codes(findings_of(reamed))


def test_what_would_jam_is_refused_of_a_measured_printer(tmp_path):
    turning = {"holes": {"gear-1.bore": "turning"}}
    printer = {"measured": True, "spread": 0.05, "clearance": {"turning": 0.05}}
    tight = gears(tmp_path, print=dict(turning), printer=printer)
    (found,) = [one for one in findings_of(tight) if one.code == "print.jam"]
    assert found.severity == "error"
    assert (found.value, found.limit) == (pytest.approx(0.10), pytest.approx(0.15))
    free = {**printer, "clearance": {"turning": 0.1}}
    assert "print.jam" not in codes(findings_of(gears(tmp_path, print=dict(turning), printer=free)))


def test_what_would_rattle_is_refused_at_the_limit_that_is_asked(tmp_path):
    printer = {"measured": True, "spread": 0.02, "clearance": {"snug": 0.02}}
    for limit, told in ((0.09, True), (0.11, False)):
        asked = gears(tmp_path, print={"greatest_play": limit}, printer=printer)
        assert ("print.play" in codes(findings_of(asked))) == told


def test_nothing_is_said_of_a_design_that_is_not_printed(tmp_path):
    silent = gears(tmp_path, 0.4)
    assert Printable().findings(silent) == ()
    named = build(tmp_path, 'process = "print"\n' + text_of(0.4))
    assert "print.thin-wall" in codes(Printable().findings(named))


def test_a_hole_or_part_that_is_not_there_is_named(tmp_path, command_line):
    for table, said in (
        ({"holes": {"gear-1.bor": "ream"}}, "it has: bore"),
        ({"holes": {"gear-7.bore": "ream"}}, "no part is named 'gear-7'"),
        ({"flip": ["gear-9"]}, "no part is named 'gear-9'"),
    ):
        asked = gears(tmp_path, print=table)
        code, _, err = command_line("print", asked.path, "-o", tmp_path / "out")
        assert code != 0
        assert said in err
        assert not (tmp_path / "out").exists()


def test_a_bush_without_room_or_size_is_named(tmp_path):
    geneva = Path("examples/geneva-straight.toml").read_text()
    with pytest.raises(
        DesignError, match=r'crank.pin-1 is printed .* set holes = { "crank.pin-1" = "ream" }'
    ):
        findings_of(build(tmp_path, geneva, print={"holes": {"crank.pin-1": "bush"}}))
    odd = text_of(2.0).replace("bore = 8", "bore = 8.7")
    with pytest.raises(DesignError, match=r"no bush has a bore of 8.7 mm; one of: .*; set it to ream"):
        findings_of(build(tmp_path, odd, print={"holes": {"gear-1.bore": "bush"}}))


@pytest.mark.parametrize(
    ("printer", "said"),
    [
        ({"bed": {"x": 35, "y": 35}}, "print.bed"),
        ({"nozzle": 1.2, "layer": 0.4, "measured": True}, "print.thin-wall"),
    ],
)
def test_what_cannot_be_printed_writes_nothing(tmp_path, command_line, printer, said):
    asked = gears(tmp_path, 1.0, printer=printer)
    code, _, err = command_line("print", asked.path, "-o", tmp_path / "out")
    assert code == 1
    assert f"[{said}]" in err
    assert not (tmp_path / "out").exists()


def part(*corners):
    return Part("part", Outline(Loop.polygon(corners)), 2.0, "pom")


@pytest.mark.parametrize("angle", [0.0, 0.7, 2.1])
def test_narrow_places_are_measured_and_corners_are_none(angle):
    def turned(*corners):
        c, s = math.cos(angle), math.sin(angle)
        return part(*((c * x - s * y, s * x + c * y) for x, y in corners))

    arm = turned((0, 0), (10, 0), (10, 4), (20, 4), (20, 4.6), (10, 4.6), (10, 8), (0, 8))
    assert narrowest(arm, 1.0, "wall").width == pytest.approx(0.6, abs=1e-6)
    assert narrowest(arm, 0.5, "wall") is None
    tooth = turned((0, 0), (10, 0), (5.35, 8), (4.65, 8))
    assert narrowest(tooth, 1.0, "wall").width == pytest.approx(0.7, abs=1e-6)
    assert narrowest(turned((0, 0), (10, 0), (5, 8.66)), 1.0, "wall") is None
    assert narrowest(turned((0, 0), (10, 0), (0, 10)), 1.0, "wall") is None
    assert narrowest(turned((0, 0), (10, 0), (5, 20)), 1.0, "wall") is not None
    slit = turned((0, 0), (10, 0), (10, 4), (3, 4), (3, 4.3), (10, 4.3), (10, 8), (0, 8))
    assert narrowest(slit, 1.0, "gap").width == pytest.approx(0.3, abs=1e-6)
    assert narrowest(slit, 1.0, "wall") is None
