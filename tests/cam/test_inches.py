"""Programs, tables and sheets in inches: what is written is read back as planned, to the last decimal."""

import re

import numpy as np
import pytest
from by_control import CONTROLS
from golden_operations import made
from planning_parts import LIBRARY
from rs274 import needs_rs274, run_rs274
from shop import TOOLS, plate_job
from test_rs274 import LAST_DECIMAL, distinct, our_ends

from mechwright.plugins.host import host
from mechwright_cam.controls.contract import Control
from mechwright_cam.pages.setup_sheet import setup_html
from mechwright_cam.planning import plan
from mechwright_cam.proof.judge import judge
from mechwright_cam.proof.scene import Scene
from mechwright_cam.shop.lengths import Lengths
from mechwright_cam.shop.settings import CamSettings

HALF = 25.4 / 2
"""Of a last decimal: so much rounding moves a coordinate, by 10^-decimals, mm."""


def speaking(control: str, units: str = "inch") -> Control:
    return host().get(Control, control).speaking(units)


@pytest.mark.parametrize("control", CONTROLS)
def test_the_same_plan_in_both_units_ends_in_the_same_places(control: str) -> None:
    program = plan(plate_job(tools=[LIBRARY.get(name) for name in ("spot-6", "drill-8", "mill-6")]))
    ends, feeds = {}, {}
    for units in ("mm", "inch"):
        post = speaking(control, units)
        text = post.write(program)
        assert ("G20" in text, "G21" in text) == (units == "inch", units == "mm")
        run = post.read(text)
        ends[units], feeds[units] = run.end, run.feed
    assert ends["mm"].shape == ends["inch"].shape
    last = speaking(control).resolution
    known = np.isfinite(ends["mm"])  # places in machine coordinates the text does not say
    assert (known == np.isfinite(ends["inch"])).all()
    off = np.abs(np.where(known, ends["mm"], 0.0) - np.where(known, ends["inch"], 0.0))
    # Heights are rounded to one side, so that rapids stay high and cuts go through.
    assert np.nanmax(off) <= last + speaking(control, "mm").resolution
    assert np.nanmax(off[:, :2]) <= (last + speaking(control, "mm").resolution) / 2 + 1e-9
    fed = feeds["mm"] > 0
    np.testing.assert_allclose(feeds["inch"][fed], feeds["mm"][fed], atol=0.31)


def test_the_program_of_the_other_units_is_judged_alike() -> None:
    """A program in inches is proven by the same limits, and one that is off by a factor is not."""
    tools = tuple(LIBRARY.get(name) for name in ("spot-6", "drill-8", "mill-6"))
    job, post = plate_job(tools=tools), speaking("linuxcnc")
    text = post.write(plan(job))
    assert judge(Scene(text, job, post)).ok
    assert judge(Scene(text, job, speaking("linuxcnc", "mm"))).ok
    assert not judge(Scene(text.replace("G20", "G21"), job, post)).ok
    metric = speaking("linuxcnc", "mm").write(plan(job))
    assert not judge(Scene(metric.replace("G21", "G20"), job, post)).ok


@needs_rs274
@pytest.mark.parametrize("units", ["mm", "inch"])
def test_linuxcnc_reads_both_units(units: str, tmp_path) -> None:
    tools = tuple(LIBRARY.get(name) for name in ("spot-6", "drill-8", "mill-6"))
    post = speaking("linuxcnc", units)
    program = plan(plate_job(tools=tools))
    text = post.write(program)
    canon = run_rs274(text, tmp_path, post.tool_table(program.tools)[1])
    assert canon.ok, canon.error
    ours, theirs = distinct(our_ends(post.read(text)) / post.scale), distinct(canon.ends)
    assert ours.shape == theirs.shape
    np.testing.assert_allclose(ours, theirs, atol=LAST_DECIMAL, rtol=0)


@pytest.mark.parametrize("control", CONTROLS)
def test_no_millimetres_are_left_in_a_program(control: str) -> None:
    for one in made("inches", control):
        assert not re.search(r"\bmm\b", one.text, re.IGNORECASE)
        heads = [line for line in one.text.splitlines() if "rapid" not in line]
        words = [abs(float(x)) for line in heads for x in re.findall(r"(?<![A-Z(])[XY](-?[\d.]+)", line)]
        assert max(words) < 1.2  # the plate of 40 mm reaches 0.79 inch from its middle


def test_tables_are_in_inches() -> None:
    tool = TOOLS[2].model_copy(update={"length": 76.2, "wear_length": -0.0254, "wear_diameter": -0.0508})
    _, text = speaking("linuxcnc").tool_table([tool])
    assert ";units=in\nT3 P3 Z2.999 D0.23622 ;mill-6 end-mill flute_length=0.472441 length=3" in text
    assert "wear_length=-0.001 wear_diameter=-0.002 flutes=3" in text
    assert "3,mill-6 end-mill,0.23622,2.999\n" in speaking("mach3").tool_table([tool])[1]
    cam = CamSettings(compensation="control")
    _, fanuc = speaking("fanuc").offset_table([tool], cam)
    assert "G20 G90\nG10 L10 P3 R3.\nG10 L11 P3 R-0.001\nG10 L12 P3 R0.1181\nG10 L13 P3 R-0.001\n" in fanuc
    _, metric = speaking("fanuc", "mm").offset_table([tool], cam)
    assert "G21 G90\nG10 L10 P3 R76.2\nG10 L11 P3 R-0.025\nG10 L12 P3 R3.\nG10 L13 P3 R-0.025\n" in metric


def test_the_sheet_has_inches_and_metric_sizes_beside() -> None:
    tools = tuple(LIBRARY.get(name) for name in ("spot-6", "drill-8", "mill-6"))
    job = plate_job(tools=tools)
    page = setup_html(job, plan(job), None, speaking("haas"))
    assert "⌀0.2362 (6 mm)" in page
    assert "Setting 9 has to be INCH" in page
    assert "Lengths in inches, feeds in inches a minute." in page
    assert f"part {60 / 25.4:.4f}" in page
    assert setup_html(job, plan(job), None, speaking("haas", "mm")).count("Setting 9 has to be MM") == 1


def test_lengths_of_a_sheet() -> None:
    mm, inch = Lengths("mm"), Lengths("inch")
    assert [mm.size(6.0), inch.size(6.35), inch.size(6.0), inch.size(5.105)] == [
        "6",
        "0.25",
        "0.2362 (6 mm)",
        "0.201",
    ]
    assert (inch.signed(-25.4), inch.fixed(25.4, 1), mm.fixed(25.4, 1)) == ("−1.0000", "1.000", "25.4")
