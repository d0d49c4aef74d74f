"""The programs that LinuxCNC installs as samples: what we read, we read as its own interpreter does."""

import math
import re
import tempfile
from pathlib import Path

import numpy as np
import pytest
from by_control import interpret
from by_night import examples
from hypothesis import given, settings
from hypothesis import strategies as st
from rs274 import needs_rs274, run_rs274
from test_rs274 import distinct

from mechwright.errors import ProgramError
from mechwright_cam.controls.reading import Kind, Run

SAMPLES = Path("/usr/share/linuxcnc/ncfiles")
PAGE = (Path(__file__).parents[2] / "docs" / "control-reading.md").read_text(encoding="utf-8")
NOT_READ = re.findall(r"^\| [^|]+ \| `([^`|]+)` \|$", PAGE, re.MULTILINE)
pytestmark = [needs_rs274, pytest.mark.skipif(not SAMPLES.is_dir(), reason=f"there is no {SAMPLES}")]

READ = (
    *("3dtest.ngc", "arcspiral.ngc", "cds.ngc", "comp-g1.ngc", "comp311.ngc", "comp311_2.ngc"),
    *("3D_Chips.ngc", "flowsnake.ngc"),
    *("gmoccapy_2_tools_with_cutter_radius_compensation.ngc", "plasmatest.ngc", "skeleton.ngc", "tort.ngc"),
)
"""Samples of milling that have to be read."""
TOOLS = range(1, 100)
DIAMETER = 2.54
"""Of all tools; rs274 takes its table for inches."""
TABLE = "".join(f"T{n} P{n} Z0 D0.1\n" for n in TOOLS)


def ours(run: Run) -> np.ndarray:
    moves = np.isin(run.kind, (Kind.RAPID, Kind.FEED, Kind.ARC, Kind.HOME)) & ~run.piece
    ends = run.end[moves].copy()
    ends[~np.isfinite(ends)] = 0.0
    return distinct(np.concatenate((np.zeros((1, 3)), ends)))


def read(text: str) -> Run:
    return interpret(text, start=(0.0, 0.0, 0.0), diameters=dict.fromkeys(TOOLS, DIAMETER))


def agree(text: str, run: Run, slack: float = 1.1e-4) -> None:
    with tempfile.TemporaryDirectory() as folder:
        canon = run_rs274(text, Path(folder), TABLE)
    assert canon.ok, canon.error
    inches = "USE_LENGTH_UNITS(CANON_UNITS_INCHES)" in canon.text.partition("SET_FEED_REFERENCE")[2]
    scale = 25.4 if inches else 1.0
    theirs = distinct(np.concatenate((np.zeros((1, 3)), canon.ends * scale)))
    found = ours(run)
    assert found.shape == theirs.shape
    np.testing.assert_allclose(found, theirs, atol=slack * scale, rtol=0)


@pytest.mark.parametrize(
    "name", sorted(str(p.relative_to(SAMPLES)) for p in SAMPLES.rglob("*.ngc")) or ["none"]
)
def test_what_we_read_we_read_as_linuxcnc_does(name: str) -> None:
    text = (SAMPLES / name).read_text(errors="replace")
    try:
        run = read(text)
    except ProgramError as error:
        assert name not in READ
        reason = str(error).partition(": ")[2]
        known = [row for row in NOT_READ if row in reason]
        assert known, f"{name} is refused for what docs/control-reading.md does not list: {reason}"
        return
    if run.ended and np.isin(run.kind, (Kind.RAPID, Kind.FEED, Kind.ARC)).any():
        agree(text, run)


def test_the_page_lists_what_is_not_read() -> None:
    assert len(NOT_READ) >= 5


# -- compensation -------------------------------------------------------------------------------------------


@st.composite
def contours(draw: st.DrawFn) -> str:
    """A contour of lines and arcs with compensation, corners both ways, entered by a long line."""
    side = draw(st.sampled_from(["G41", "G42"]))
    lines = ["G17 G21 G40 G90", "G0 X-20 Y-15 Z5", "T1 M6", f"{side} D1", "G1 X0 Y0 F100", "Z-1"]
    x = y = 0.0
    heading = draw(st.floats(-0.6, 0.6))
    for _ in range(draw(st.integers(2, 6))):
        length = draw(st.one_of(st.floats(0.2, 3), st.floats(12, 25)))
        x, y = round(x + length * math.cos(heading), 4), round(y + length * math.sin(heading), 4)
        lines.append(f"G1 X{x:.4f} Y{y:.4f}")
        if draw(st.booleans()):
            # An arc that leaves the line tangentially, and turns the heading.
            radius, turn = draw(st.floats(1, 15)), draw(st.floats(0.3, 4.5))
            ccw = draw(st.booleans())
            s = 1 if ccw else -1
            i, j = round(-s * radius * math.sin(heading), 4), round(s * radius * math.cos(heading), 4)
            radius = math.hypot(i, j)
            first = math.atan2(-j, -i)
            x = round(x + i + radius * math.cos(first + s * turn), 4)
            y = round(y + j + radius * math.sin(first + s * turn), 4)
            lines.append(f"{'G3' if ccw else 'G2'} X{x:.4f} Y{y:.4f} I{i:.4f} J{j:.4f}")
            heading += s * turn
        back = st.floats(-0.06, 0.06).map(lambda off: math.pi + off)
        heading += draw(st.one_of(st.floats(-3.1, 3.1), st.just(0.0), st.floats(-0.06, 0.06), back))
    lines += ["G40", "G0 Z9", "X-30 Y-30", "M2", ""]
    return "\n".join(lines)


@given(contours())
@settings(max_examples=examples(8, 25))
def test_random_compensated_contours_are_read_alike(text: str) -> None:
    try:
        run = read(text)
    except ProgramError:
        with tempfile.TemporaryDirectory() as folder:
            assert not run_rs274(text, Path(folder), TABLE).ok, text
        return
    with tempfile.TemporaryDirectory() as folder:
        canon = run_rs274(text, Path(folder), TABLE)
    assert canon.ok, canon.error
    # Where a line and an arc meet flatly, what four decimals leave open is ten times as much along them.
    agree(text, run, slack=1e-3)


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        ("G0 X0 Y0 Z5\nG41 D1\nG1 X1 Y0 F100", "not longer than the tool's radius"),
        ("G0 X0 Y0 Z5\nG42 D1\nG41 D1", "compensation is on already"),
        ("G0 X-9 Y0 Z5\nG41 D1\nG1 X0 Y0 F100\nG3 X1 Y1 I0 J1", "does not fit into an arc of radius 1.000"),
        ("G0 X-9 Y0 Z5\nG41 D1\nG1 X0 Y0 F100\nX20\nX10 Y1", "does not fit into the inner corner"),
        ("G0 X-9 Y0 Z5\nG41 D1\nG1 X0 Y0 F100\nX9\nY.5\nX0", "does not fit into the inner corner"),
        ("G0 X-9 Y0 Z5\nG41 D1\nG1 X0 Y0 F100\nX9\nG40\nG2 X19 Y0 I5 J0", "G40. is an arc; leave on a line"),
        ("G0 X-9 Y0 Z5\nG41 D1\nG2 X0 Y0 I4.6 J0 F100", "the arc ends 0.2000 mm nearer"),
        ("G0 X-9 Y0 Z5\nG41 D1\nG1 X0 Y0 F100\nG2 X9 Y0 I4.6 J0", "the arc ends 0.2000 mm nearer"),
        ("G0 X-9 Y0 Z5\nG41 D1\nT2 M6", "M6 while compensation is on"),
        ("G0 X-9 Y0 Z5\nG41 D1\nG55", "G55 while compensation is on"),
        ("G0 X-9 Y0 Z5\nG41 D1\nG43 H1", "G43 while compensation is on"),
        ("G0 X-9 Y0 Z5\nG41 D1\nG10 L2 P1 X0", "G10 while compensation is on"),
        ("G0 X-9 Y0 Z5\nG41 D1\nG1 X0 Y0 F100\nG18", "the plane changes while compensation is on"),
        ("G0 X-9 Y0 Z5\nG41 D1\nG53 G0 Z0", "G53 while compensation is on"),
        ("G0 X-9 Y0 Z5\nG18 G41 D1", "XY plane only"),
        ("G41 D200", "no tool of that number is known"),
    ],
)
def test_bad_compensation_is_refused_with_its_line(lines: str, said: str) -> None:
    text = "G17 G21 G40 G90\n" + lines
    with pytest.raises(ProgramError, match=rf"^line {text.count(chr(10)) + 1}: .*{said}"):
        read(text)
    if said == "XY plane only":  # it has a plane for lathes as well
        return
    with tempfile.TemporaryDirectory() as folder:
        assert not run_rs274(f"T1 M6\n{text}\nM2\n", Path(folder), TABLE).ok


def test_compensation_follows_the_diameter() -> None:
    """Around a square of 40 mm the tool's centre runs a radius outside, with an arc at each corner."""
    text = "G17 G21 G40 G90\nG0 X-30 Y-20 Z0\nG42 D7\nG1 X-20 Y-20 F99\nX20\nY20\nX-20\nY-20\nG40\nM2"
    for diameter in (4.0, 9.5):
        run = interpret(text, start=(0, 0, 0), diameters={7: diameter})
        r = diameter / 2
        cut = run.end[run.cutting]
        assert np.abs(cut[:, :2]).max() == pytest.approx(20 + r)
        arcs = run.kind == Kind.ARC
        assert arcs.sum() == 3
        assert run.radius[arcs] == pytest.approx([r, r, r])


def test_an_arc_in_another_plane_is_cut_in_short_pieces() -> None:
    run = interpret("G18 G21 G90\nG0 X0 Y3 Z0\nG3 X10 Z0 I5 K0 F99\nM2", start=(0, 0, 0))
    places = run.end[run.cutting]
    assert np.hypot(places[:, 0] - 5, places[:, 2]) == pytest.approx(np.full(len(places), 5.0))
    assert set(places[:, 1].tolist()) == {3.0}
    # G3 in ZX turns from Z to X: from X0 at Z0 by way of... below or above, as rs274 says.
    agree("G18 G21 G90\nG0 X0 Y3 Z0\nG3 X10 Z0 I5 K0 F99\nM2\n", run)
    assert np.abs(np.linalg.norm(np.diff(places, axis=0), axis=1)).max() < 0.15
