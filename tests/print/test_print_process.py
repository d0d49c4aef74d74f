"""Printing as a process of a design: chosen for all plates or for one, and refused with a way out."""

import tomlkit

from mechwright.cli.hosting import open_host
from mechwright.designs.design import load
from mechwright.pipeline import Build
from mechwright.pipeline.process import ChosenProcesses, plates_by
from mechwright_print.job.print_job import printed_parts
from mechwright_print.process import Printing


def build(tmp_path, request, process, **printer) -> Build:
    content = tomlkit.parse((request.config.rootpath / "examples/geneva-straight.toml").read_text())
    if printer:
        (tmp_path / "printer.toml").write_text(tomlkit.dumps(printer))
        content["print"] = {"printer": "printer.toml"}
    path = tmp_path / "design.toml"
    path.write_text(f"process = {process}\n" + tomlkit.dumps(content))
    return Build(load(path, open_host()), open_host())


def test_all_plates_or_single_ones_are_printed(tmp_path, request):
    every = build(tmp_path, request, '"print"')
    assert [one.name for one in printed_parts(every.design, every.parts)] == [
        "wheel",
        "locking-disc",
        "crank",
    ]
    one = build(tmp_path, request, '{ default = "mill", parts.crank = "print" }')
    assert [part.name for part in printed_parts(one.design, one.parts)] == ["crank"]
    assert [part.name for part in plates_by(one.design, one.parts, "mill")] == ["wheel", "locking-disc"]


def test_a_plate_larger_than_the_bed_is_refused_with_the_line_that_mills_it(tmp_path, request):
    small = build(tmp_path, request, '"print"', bed={"x": 100, "y": 100})
    assert not ChosenProcesses().findings(small), "the printer's own rules tell it, once"
    (found,) = [one for one in Printing().objections(small.parts["wheel"], small) if one.code == "print.bed"]
    assert found.severity == "error"
    assert 'parts.wheel = "mill"' in found.remedy
    assert Printing().refuses(small.parts["wheel"], small) == found.message
    assert Printing().refuses(small.parts["crank"], small) is None


def test_the_process_tells_what_is_lost_and_how_long_it_takes(tmp_path, request):
    every = build(tmp_path, request, '"print"')
    lost = Printing().loses(every.parts["crank"], every)
    assert lost[0] == "PLA in place of aluminium, and little pull across layers"
    assert lost[1].startswith("the fits of bore, dowel-1, dowel-2, pin-1: ±0.30 mm")
    times = [Printing().seconds(every.parts[name], every) for name in ("wheel", "crank")]
    assert times[0] > 5 * times[1] > 0
    # a printer that lays down twice as much takes half of the time
    quick = build(tmp_path, request, '"print"', flow=10.0)
    assert Printing().seconds(quick.parts["crank"], quick) * 2 == times[1]


def test_printing_asks_nothing_of_milling(tmp_path, request, command_line):
    """A design whose mill cannot make it is printed all the same."""
    content = tomlkit.parse((request.config.rootpath / "examples/geneva-straight.toml").read_text())
    content.setdefault("cam", {})["machine"] = {"travel_x": 20, "travel_y": 20}
    path = tmp_path / "design.toml"
    path.write_text(tomlkit.dumps(content))
    code, _, err = command_line("print", path, "-o", tmp_path / "out")
    assert code == 0, err
    assert "travel" not in err
