"""An overcut as it is told: its depth, its width beyond the walls, and all lines that make it."""

import re
from pathlib import Path

import ezdxf
import pytest
from by_control import asked

from mechwright.errors import DesignError
from mechwright_cam.commands.verify_drawing import job_of
from mechwright_cam.setup.job import Job

HEAD = "G90 G94 G17 G91.1 G21\nG40 G49 G80\nG64 P0.002\nG53 G0 Z0\nT1 M6\nS8000 M3\nG54\nG0 X0 Y0\nG43 Z15 H1\nG0 Z2\n"
END = "G0 Z15\nM5\nG53 G0 Z0\nM30\n"
LINE = HEAD.count("\n") + 1
NO_OPTIONS = {"control": "", "material": "", "units": "", "layers": ()}


@pytest.fixture(scope="module")
def drawing(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A plate of 120 mm with a bore of 20 mm and a recess of 3 mm between X30 and X50."""
    path = tmp_path_factory.mktemp("drawing") / "plate.dxf"
    document = ezdxf.new("R2010", units=4)
    space = document.modelspace()
    space.add_lwpolyline([(-60, -60), (60, -60), (60, 60), (-60, 60)], close=True)
    space.add_circle((0, 0), 10)
    box = [(30, -15), (50, -15), (50, 15), (30, 15)]
    space.add_lwpolyline(box, close=True, dxfattribs={"layer": "POCKET_3"})
    document.saveas(path)
    return path


def job(drawing: Path, hold: str = "vacuum", *changes: str) -> Job:
    return job_of(
        drawing, 6.0, "1=mill-6", library=None, hold=hold, stock="20", changes=changes, **NO_OPTIONS
    )


def helix(radius: float) -> str:
    """Down to Z-6.2 around the bore, once round there, and back to its axis."""
    turns = [f"G3 X{radius} Y0 Z{z} I-{radius} J0" for z in (-2, -4, -6.2)]
    return "\n".join(
        [f"G1 X{radius} Y0 Z0.05 F300", *turns, f"G3 X{radius} Y0 I-{radius} J0", "G1 X0 Y0", ""]
    )


@pytest.mark.parametrize("wide", [6, 9, 23])
def test_a_bore_that_is_too_wide_is_told_as_wide_as_it_is(drawing: Path, wide: int) -> None:
    found = asked("gouge", HEAD + helix(7 + wide) + END, job(drawing))
    assert not found.passed
    assert found.value == pytest.approx(wide, abs=2e-3)
    assert f"cuts {wide}.000 mm into the finished part, the limit is 0.005 mm" in found.message
    assert found.line == LINE + 3
    assert found.message.endswith(
        f"; lines {LINE + 1}, {LINE + 2}, {LINE + 4} and {LINE + 5} cut into it too"
    )


@pytest.mark.parametrize(("wide", "said"), [(2, 2), (4, 4), (6, 6), (9, 8)])
def test_of_a_recess_the_width_beyond_its_wall_is_told_beside_its_depth(
    drawing: Path, wide: int, said: int
) -> None:
    """Its rim to the plate's edge is 10 mm wide: 9 mm beyond the recess is 1 mm, and the cutter, off the edge."""
    path = f"G0 X40 Y0\nG1 Z-3 F300\nG1 X{47 + wide}\nX40\n"
    found = asked("gouge", HEAD + path + END, job(drawing))
    depth = min(wide, 3)
    assert f"line {LINE + 2}: cuts {depth}.000 mm into the finished part" in found.message
    beyond = f"; seen from above it reaches {said}.000 mm beyond the nearest wall"
    assert (beyond in found.message) == (wide > depth)
    assert found.message.endswith(f"; line {LINE + 3} cuts into it too")


def test_lines_are_counted_where_they_are_many(drawing: Path) -> None:
    cuts = "".join(f"G0 X{-15 - k}\nG1 Z-1 F300\nG0 Z2\n" for k in range(9))
    found = asked("gouge", f"{HEAD}G0 Y-30\n{cuts}{END}", job(drawing))
    assert re.search(r"; lines \d+(, \d+){5} and more, 17 in all, cut into it too$", found.message)


def test_a_program_that_stays_out_tells_nothing(drawing: Path) -> None:
    assert (
        asked("gouge", HEAD + helix(6.99) + END, job(drawing)).message
        == "the cutter stays out of the finished part"
    )


def test_lines_of_several_files_are_told_with_their_file(drawing: Path) -> None:
    cut = f"{HEAD}G0 X-30 Y-30\nG1 Z-1 F300\nX-31\n{END}"
    found = asked("gouge", {"a.nc": cut, "b.nc": cut}, job(drawing))
    assert re.match(rf"a\.nc: line {LINE + 1}: cuts 1\.000 mm", found.message)
    said = f"; a.nc: lines {LINE + 2} and {LINE + 3}, b.nc: lines {LINE + 1} to {LINE + 3} cut into it too"
    assert found.message.endswith(said)


# -- what is planned, and what holds -------------------------------------------------------------------------


@pytest.mark.parametrize("word", ["M7\n", "M8\n", ""])
def test_coolant_is_judged_where_it_is_set(drawing: Path, word: str) -> None:
    text = HEAD + word + helix(6.99) + END
    runs = {"M7\n": "mist", "M8\n": "flood", "": "off"}[word]
    free = asked("coolant", text, job(drawing))
    assert (free.passed, free.message) == (True, f"no coolant is planned; in the work it is {runs}")
    for planned in ("mist", "flood", "off"):
        found = asked("coolant", text, job(drawing, "vacuum", f"coolant={planned}"))
        assert found.passed == (planned == runs)


def test_a_vice_and_clamps_hold_a_drawing_s_part(drawing: Path) -> None:
    vice = job(drawing, "vice")
    assert [jaw.edge for jaw in vice.jaws] == ["front", "rear"]
    assert [jaw.edge for jaw in job(drawing, "vice", 'stock.finished=["left", "right"]').jaws] == [
        "left",
        "right",
    ]
    (toe,) = job(drawing, "clamps", "hold.toe_clamps=[[-80, -10, -55, 10, 12]]").toes
    assert toe.shape.bounds == (-80, -10, -55, 10)
    with pytest.raises(DesignError, match=r"^--hold: the places of clamps .* --set hold.toe_clamps="):
        job(drawing, "clamps")
