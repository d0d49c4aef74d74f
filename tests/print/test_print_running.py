"""The mechanism over the printer's spread: plays that jam are refused with the clearance that works."""

from pathlib import Path

import numpy as np
import pytest
import tomlkit

from mechwright.cli.hosting import open_host
from mechwright.designs.design import load
from mechwright.pipeline import Build
from mechwright.pipeline.tolerances import TolerancesTable
from mechwright.pipeline.tolerances.by_process import MIDDLE, with_spread
from mechwright.pipeline.tolerances.running import ROOM
from mechwright_print.as_made import AsPrinted, printed_spread
from mechwright_print.job.print_job import PrintJob
from mechwright_print.rules.running import backlash_rule, running_rule

GENEVA = Path("examples/geneva-straight.toml").read_text()
GEARS = Path("examples/spur-gears.toml").read_text()
MEASURED = {"measured": True, "spread": 0.02}


def build(tmp_path, text: str, printer: dict, parameters: dict | None = None, **table) -> Build:
    content = tomlkit.parse(text)
    (tmp_path / "printer.toml").write_text(tomlkit.dumps(printer))
    content["print"] = {"printer": "printer.toml", **table}
    content["parameters"].update(parameters or {})
    path = tmp_path / "design.toml"
    path.write_text(tomlkit.dumps(content))
    return Build(load(path, open_host()), open_host())


def test_the_spread_of_the_printer_is_that_of_the_contributors(tmp_path):
    asked = build(tmp_path, GENEVA, {**MEASURED, "uncertainty": {"wall": 0.015}})
    size = 3 * np.hypot(0.02, 0.015)
    job = asked.made(PrintJob)
    found = with_spread(asked.design.table(TolerancesTable), printed_spread(job, job.parts), over=True)
    assert found.settings.centre == pytest.approx(MIDDLE * size, abs=1e-6)
    assert found.settings.gouge == found.settings.leftover == pytest.approx(size / 2, abs=1e-6)
    pin = found.pin("roller-pin", 5.0, "H7/g6")
    plain = type(found)(found.settings).pin("roller-pin", 5.0, "H7/g6")
    # the loosest hole slides: 0.1 mm on each side, plus and minus three standard deviations
    assert pin.upper - plain.upper == pytest.approx(0.2 + 0.06)
    assert pin.lower - plain.lower == pytest.approx(0.2 - 0.06)


def test_prints_that_jam_are_refused_with_the_clearance_that_works(tmp_path):
    asked = build(tmp_path, GENEVA, {**MEASURED, "spread": 0.1}, fits="ream")
    (found,) = running_rule(asked, asked.made(PrintJob))
    assert (found.code, found.severity) == ("print.as-made", "error")
    assert found.value < 0
    works = []
    for change in found.proposed:
        params = {key.partition(".")[2]: value for key, value in change.items() if key.startswith("param")}
        better = build(tmp_path, GENEVA, {**MEASURED, "spread": 0.1}, params, fits="ream")
        works.append(not list(running_rule(better, better.made(PrintJob))))
    assert works[0]
    # and no less of it does: the next smaller room of those that are tried
    first = {key.partition(".")[2]: value for key, value in found.proposed[0].items()}
    plain = build(tmp_path, GENEVA, MEASURED).design.params
    least = {key: round(value - ROOM[0], 3) for key, value in first.items()}
    assert all(value > getattr(plain, key) for key, value in least.items())
    tighter = build(tmp_path, GENEVA, {**MEASURED, "spread": 0.1}, least, fits="ream")
    assert list(running_rule(tighter, tighter.made(PrintJob)))


def test_a_good_printer_jams_nothing_and_a_worse_one_more(tmp_path):
    kept = []
    for spread in (0.005, 0.05, 0.15):
        asked = build(tmp_path, GENEVA, {**MEASURED, "spread": spread}, fits="ream")
        plays = [one for one in asked.made(AsPrinted).outputs if one.output.stays_above]
        kept.append(min(one.kept for one in plays))
    assert kept[0] == 1.0
    assert kept == sorted(kept, reverse=True)
    assert kept[2] < 0.9


def test_teeth_have_the_backlash_of_their_printer(tmp_path):
    need = 3 * np.sqrt(2) * 0.02
    for backlash, told in ((None, True), (round(need - 0.005, 3), True), (round(need + 0.005, 3), False)):
        given = {} if backlash is None else {"backlash": backlash}
        asked = build(tmp_path, GEARS, MEASURED, given)
        found = list(backlash_rule(asked, asked.made(PrintJob)))
        assert bool(found) == told
        if told:
            assert found[0].limit == pytest.approx(need)
            assert found[0].proposed == ({"parameters.backlash": 0.1},)


def test_reaming_takes_the_play_of_the_holes_away(tmp_path):
    halves = []
    for fits in ("open", "ream"):
        asked = build(tmp_path, Path("examples/four-bar-double-rocker.toml").read_text(), MEASURED, fits=fits)
        halves.append([one.half for one in asked.made(AsPrinted).outputs])
    assert halves[0]
    assert all(after < before for before, after in zip(*halves, strict=True))
