"""The stock on a grid: volumes, engagement and air against closed forms, and the picture."""

import base64
import math
import re
import struct
import zlib
from dataclasses import replace

import numpy as np
import pytest
from by_control import LINUXCNC, read, setup_html, simulated
from planning_parts import bore, job, plate
from shop import DRILL, MILL, SPOT, TOOLS, plate_job, plate_program

from mechwright.contracts.materials import material
from mechwright_cam.controls.linuxcnc import LinuxCnc
from mechwright_cam.machining import machine
from mechwright_cam.pages.setup_sheet.raster import simulated_view
from mechwright_cam.program.moves import Feed, FeedArc, Operation, Program, Rapid, ToolSection
from mechwright_cam.proof.simulation import Simulation, deviation
from mechwright_cam.shop.power import available


def simulation(*moves: object, feed: float = 600.0) -> tuple[Simulation, object]:
    made = plate_job()
    section = ToolSection(MILL, 8000, "flood", (Operation("o", tuple(moves)),))
    program = Program("plate", "G54", 5.0, (section,))
    return simulated(LinuxCnc().write(program), made), made


def row(x0, x1, y, z, feed=600.0):
    return [Rapid(x0, y), Rapid(z=1), Feed(None, None, z, 100), Feed(x1, y, None, feed), Rapid(z=5)]


def removed(seen: Simulation) -> float:
    return float(-seen.heights.sum()) * seen.cell**2


def test_the_volume_of_a_slot_is_exact_to_the_grid() -> None:
    seen, _ = simulation(*row(-20, 20, 0, -2.0))
    assert removed(seen) == pytest.approx((40 * 6 + math.pi * 9) * 2.0, rel=0.01)


def test_a_slot_is_full_engagement_and_half_a_width_is_a_quarter_turn() -> None:
    seen, _ = simulation(*row(-20, 20, 0, -2.0))
    (work,) = seen.works
    assert work.engagement > 160
    assert work.removal == pytest.approx(6 * 2 * 600 / 1000, rel=0.06)
    assert work.feed_per_tooth == pytest.approx(600 / 8000 / 3)
    assert work.chip == pytest.approx(work.feed_per_tooth)
    # Beside a slot, one half of the cutter at a time; the first slot is slow, so that the second is the worst.
    seen, _ = simulation(*row(-24, 24, 0, -2.0, 60.0), *row(-20, 20, 1.0, -2.0, 2400.0))
    (work,) = seen.works
    assert work.removal == pytest.approx(1 * 2 * 2400 / 1000, rel=0.12)


@pytest.mark.parametrize(
    ("over", "width", "side"), [(12.0, 6, 0), (3.0, 3, 0.5), (-3.0, 3, -0.5), (1.5, 1.5, 0.75)]
)
def test_windows_of_a_row_beside_a_slot_have_the_loads_of_its_width(
    over: float, width: float, side: float
) -> None:
    """4 mm deep; what is taken has its middle so many radii to the left of the path."""
    stuff = material("aluminium")
    seen, _ = simulation(*row(-24, 24, 0, -4.0), *row(-20, 20, over, -4.0))
    (begin,) = np.flatnonzero(seen.loads.down)[1:]
    plunge, level = seen.loads.only(slice(begin, begin + 1)), seen.loads.only(slice(begin + 1, None))
    assert not level.down.any()
    assert level.path.sum() == pytest.approx(40)
    assert ((level.path > 3.5) & (level.path < 6.5)).all()
    np.testing.assert_allclose(level.depth, 4.0, rtol=1e-6)
    np.testing.assert_allclose(level.section, 4.0 * width, rtol=0.02)
    np.testing.assert_allclose(level.width, level.section / 4.0, rtol=1e-6)
    np.testing.assert_allclose(level.engagement, np.arccos(1 - level.width / 3.0))
    np.testing.assert_allclose(level.side, side, atol=0.015)
    np.testing.assert_allclose(level.removal, level.section * 0.6, rtol=1e-9)
    np.testing.assert_allclose(level.tooth, 600 / 8000 / 3)
    np.testing.assert_allclose(level.chip, level.tooth * np.sin(np.minimum(level.engagement, np.pi / 2)))
    for n, engagement in enumerate(level.engagement):
        angle = (np.arange(20000) + 0.5) / 20000 * engagement
        share = (np.sin(angle) ** (1 - stuff.force_exponent)).mean() * engagement / (1 - math.cos(engagement))
        force = stuff.force * level.tooth[n] ** -stuff.force_exponent * share
        assert level.power[n] == pytest.approx(force * level.removal[n] / 60 / 1000, rel=1e-4)
    assert plunge.engagement == pytest.approx(math.pi)
    assert (plunge.feed, plunge.tooth) == (100, pytest.approx(100 / 8000 / 3))
    drilled = stuff.force * plunge.tooth**-stuff.force_exponent
    assert plunge.power == pytest.approx(drilled * plunge.removal / 60 / 1000, rel=1e-6)
    for loads in (plunge, level):
        np.testing.assert_allclose(loads.torque * 8000 * math.tau / 60, 1000 * loads.power)


def test_operations_of_one_tool_have_their_own_greatest_loads() -> None:
    made = plate_job()
    ways = {
        "slot": row(-24, 24, 0, -4.0),
        "beside": row(-20, 20, 1.5, -4.0),
        "fast": row(-24, 24, 12, -2.0, 1200.0),
    }
    operations = tuple(Operation(name, tuple(way)) for name, way in ways.items())
    text = LinuxCnc().write(Program("plate", "G54", 5.0, (ToolSection(MILL, 8000, "flood", operations),)))
    works = simulated(text, made).works
    assert [work.operation for work in works] == list(ways)
    assert [work.removal for work in works] == pytest.approx([14.4, 3.6, 14.4], rel=0.03)
    for work in works:
        assert work.share == pytest.approx(work.power / available(made.settings.machine, 8000))
    assert [work.feed_per_tooth * 24000 for work in works] == pytest.approx([600, 600, 1200])


@pytest.mark.parametrize("over", [0.6, 1.5, 3.0])
def test_the_thickest_chip_follows_the_engagement(over: float) -> None:
    made = plate_job()
    first = ToolSection(MILL, 8000, "flood", (Operation("o", tuple(row(-24, 24, 0, -2.0))),))
    other = MILL.model_copy(update={"number": 9, "name": "mill-9"})
    second = ToolSection(other, 8000, "flood", (Operation("p", tuple(row(-20, 20, over, -2.0))),))
    made = replace(made, tools=(*made.tools, other))
    text = LinuxCnc().write(Program("plate", "G54", 5.0, (first, second)))
    work = simulated(text, made).works[1]
    angle = math.acos(1 - over / 3.0)
    assert work.tool == 9
    assert (
        math.degrees(angle) - 4 <= work.engagement <= math.degrees(angle) + 12
    )  # the ends of the row bite more
    assert work.chip == pytest.approx(600 / 8000 / 3 * math.sin(angle), rel=0.15)


def test_air_is_what_takes_nothing() -> None:
    slot = row(-20, 20, 0, -2.0)
    once, _ = simulation(*slot)
    twice, _ = simulation(*slot, *slot)
    assert once.feed_mm == pytest.approx(43)
    assert once.air_mm == 0
    assert twice.air_mm == pytest.approx(43)
    above, _ = simulation(*row(-20, 20, 0, 0.5))
    assert above.air_mm == above.feed_mm == pytest.approx(40.5)


def test_arcs_and_helices_are_followed() -> None:
    seen, _ = simulation(
        Rapid(15, 0), Rapid(z=0), FeedArc(15, 0, -3.0, -15, 0, True, 600), FeedArc(15, 0, None, -15, 0, True, 600)
    )  # fmt: skip
    assert removed(seen) == pytest.approx(math.pi * (18**2 - 12**2) * 3.0, rel=0.01)


def test_a_drill_leaves_its_point() -> None:
    made = plate_job()
    text = LinuxCnc().write(plate_program())
    run = read(text, made, LINUXCNC)
    stop = int(np.flatnonzero(run.tool == DRILL.number)[0])
    spot_only = "\n".join(text.split("\n")[: int(run.line[stop]) - 1])
    seen = simulated(spot_only, made)
    assert seen.heights.min() == pytest.approx(-2.0, abs=seen.cell)
    cone = math.pi * 2.0**3 / 3
    assert removed(seen) == pytest.approx(cone, rel=0.06)
    assert SPOT.point_angle == 90


def test_the_finished_part_has_no_deviation_and_a_defect_has() -> None:
    made = machine(job(plate(bore(12.0)), "spot-6", "drill-8", "mill-6"), LinuxCnc())
    seen = simulated(made.text, made.job)
    off = deviation(seen, made.job, 2)
    assert np.nanmax(np.abs(off)) == 0
    assert np.isfinite(off).mean() > 0.2
    hurt = made.text.replace(
        "M30", "T24 M6\nG54 S900 M3\nG0 X15 Y5\nG43 H24 Z5\nG1 Z-1 F99\nX18\nG53 G0 Z0\nM30"
    )
    off = deviation(simulated(hurt, made.job), made.job, 2)
    assert np.nanmin(off) == pytest.approx(-1.0)


def pixels(view: str) -> np.ndarray:
    data = base64.b64decode(re.search(r"base64,([^\"]+)", view)[1])
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    width, height = struct.unpack(">II", data[16:24])
    start = data.index(b"IDAT")
    (size,) = struct.unpack(">I", data[start - 4 : start])
    rows = np.frombuffer(zlib.decompress(data[start + 4 : start + 4 + size]), dtype=np.uint8)
    return rows.reshape(height, -1)[:, 1:].reshape(height, width, 3)


def test_the_picture_shows_what_is_left_and_what_is_hurt() -> None:
    seen, made = simulation(*row(-20, 20, 0, -2.0))
    image = pixels(simulated_view(seen, made))
    assert max(image.shape) <= 420
    # Uncut plate at the corner, the slot in the middle: the part is hurt there, as no feature is at -2.
    assert tuple(image[2, 2]) == (222, 212, 190)
    middle = image[image.shape[0] // 2, image.shape[1] // 2 + image.shape[1] // 6]
    assert tuple(middle) == (200, 0, 30)
    # It lies where the stock is, y upwards, and all of that is shown.
    aside = replace(made, stock=(-20.0, -15.0, 60.0, 45.0))
    view = simulated_view(seen, aside)
    assert re.search(r'viewBox="([^"]+)"', view)[1].split() == ["-20", "-45", "80", "60"]
    assert [re.search(rf' {key}="([^"]+)"', view)[1] for key in ("x", "y", "width", "height")] == [
        "-20", "-45", "80", "60",
    ]  # fmt: skip
    assert simulated_view(seen, made) == simulated_view(seen, made)


def test_the_setup_sheet_has_picture_and_loads() -> None:
    made = machine(job(plate(bore(12.0)), "spot-6", "drill-8", "mill-6"), LinuxCnc())
    seen = simulated(made.text, made.job)
    proof = {**made.proof.as_dict(), "simulation": seen.as_dict()}
    page = setup_html(made.job, made.program, proof, picture=simulated_view(seen, made.job))
    assert "data:image/png;base64," in page
    assert "feed in air" in page
    assert "Thickest<br>chip" in page
    assert len(page) < 400_000
    assert {tool.number for tool in TOOLS}
