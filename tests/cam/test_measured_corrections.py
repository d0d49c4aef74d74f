"""What ``measure`` says of the next piece is typed in, and the process then does what was measured."""

import re

import pytest
import tomlkit

from mechwright.cli.hosting import open_host
from mechwright.contracts.inspected import inspected
from mechwright.designs.design import load
from mechwright.pipeline import Build
from mechwright.pipeline.measured.corrections import corrections
from mechwright.pipeline.measured.readings import Reading
from mechwright_cut.cutting import Cutting
from mechwright_print.job.print_job import PrintJob

OFF = 0.02
"""Stock on each wall, mm."""


@pytest.fixture
def made(tmp_path, request):
    """A build of the Geneva example by a process, with keys more in tables of their own."""

    def make(process: str, **tables) -> Build:
        content = tomlkit.parse((request.config.rootpath / "examples/geneva-straight.toml").read_text())
        content.update(tables)
        path = tmp_path / "design.toml"
        path.write_text(f'process = "{process}"\n' + tomlkit.dumps(content))
        return Build(load(path, open_host()), open_host())

    return make


def said(build: Build, inside: float = OFF, outside: float = OFF) -> list[str]:
    part = build.parts["locking-disc"]
    readings = [
        Reading(part, "1", one, one.target + one.walls * (inside if one.walls < 0 else outside))
        for one in inspected(part)
        if one.walls
    ]
    return [one.words for one in corrections(build, readings)]


def typed(words: str) -> dict:
    """The keys that a sentence sets."""
    line = re.search(r"set (.+?) in \[", words)[1]
    return tomlkit.parse(re.sub(r" \(now [^)]*\)", "", line).replace(" and ", "\n")).unwrap()


@pytest.mark.parametrize(
    ("process", "cut"),
    [
        ("laser", {"kerf": 0.3}),
        ("laser", {}),
        ("laser", {"kerfs": [{"process": "co2-laser", "material": "any", "thickness": 5, "kerf": 0.3}]}),
        ("waterjet", {}),
        ("plasma", {}),
    ],
)
def test_the_kerf_that_is_typed_in_is_that_which_was_measured(made, process, cut):
    if process == "laser":
        cut = {"laser": "fibre", **cut}
    build = made(process, cut=cut)
    part = build.parts["locking-disc"]

    def kerf(of: Build) -> float:
        cutting = of.made(Cutting)
        return cutting.kerf(cutting.settings.kind(process, part.material), part).width

    before = kerf(build)
    (words,) = said(build)
    after = made(process, cut={**cut, **typed(words)})
    assert kerf(after) == pytest.approx(before - 2 * OFF, abs=1e-4)
    if "kerfs" in cut:
        assert len(after.made(Cutting).settings.kerfs) == 2


def test_the_registers_of_a_wire_come_nearer_by_the_stock_that_stays(made):
    build = made("wire", cut={"passes": 3, "kerf": 0.3})
    before = build.made(Cutting).settings.registers(0.3)
    (words,) = said(build)
    after = made("wire", cut={"passes": 3, "kerf": 0.3, **typed(words)})
    assert after.made(Cutting).settings.registers(0.3) == pytest.approx([one - OFF for one in before])


def test_a_service_is_told_what_is_too_much(made):
    build = made("service")
    assert said(build) == [f"write to the service that {OFF:.4f} mm too much is left"]
    assert said(build, -0.03, -0.03) == ["write to the service that 0.0300 mm too much is cut off"]


def test_walls_that_differ_are_named(made):
    inside, outside = said(made("laser", cut={"laser": "fibre", "kerf": 0.3}), 0.06, 0.01)
    assert typed(inside) == {"kerf": 0.18}
    assert "as inside walls have it" in inside
    assert typed(outside) == {"kerf": 0.28}


def test_a_printer_gets_its_deviations(made, tmp_path):
    (tmp_path / "printer.toml").write_text("[deviation]\nhole = -0.2\nwall = 0.1\n")
    build = made("print", print={"printer": "printer.toml"})
    (words,) = said(build)
    (tmp_path / "printer.toml").write_text(tomlkit.dumps({"deviation": typed(words)}))
    after = made("print", print={"printer": "printer.toml"}).made(PrintJob).printer
    # holes came out 0.04 mm smaller, outlines 0.04 mm larger
    assert after.deviation.hole == pytest.approx(-0.24)
    assert after.deviation.wall == pytest.approx(0.14)


def test_published_figures_of_a_printer_are_those_of_the_holes_that_were_measured(made):
    build = made("print")
    (words,) = said(build)
    sizes = [one.nominal for one in inspected(build.parts["locking-disc"]) if one.walls < 0]
    hole = build.made(PrintJob).printer.hole_off(sum(sizes) / len(sizes))
    assert typed(words)["hole"] == pytest.approx(hole - 2 * OFF, abs=2e-3)


def test_materials_of_a_beam_are_told_apart(made):
    """Each material and thickness has a kerf of its own."""
    build = made("laser", cut={"laser": "fibre"})
    wheel, disc = build.parts["wheel"], build.parts["locking-disc"]
    readings = [
        Reading(part, "1", one, one.target + one.walls * off)
        for part, off in ((wheel, 0.01), (disc, 0.03))
        for one in inspected(part)
        if one.walls
    ]
    found = corrections(build, readings)
    assert [one.off for one in found] == pytest.approx([0.01, 0.03])
    assert all(
        f"thickness = {part.thickness:g}" in one.words for part, one in zip((wheel, disc), found, strict=True)
    )
