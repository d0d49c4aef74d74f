"""Our interpreter and LinuxCNC's read the same positions from the same text."""

import math
import tempfile
from pathlib import Path

import numpy as np
import pytest
from by_control import interpret
from by_night import examples
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from rs274 import needs_rs274, run_rs274
from shop import TOOLS, plate_program

from mechwright.errors import ProgramError
from mechwright_cam.controls.linuxcnc import LinuxCnc
from mechwright_cam.controls.reading import Kind, Run

pytestmark = needs_rs274
LAST_DECIMAL = 1.1e-4  # canon prints four decimals


def our_ends(run: Run) -> np.ndarray:
    """Ends (n, 3) of all moves as canon has them: a machine coordinate is 0 where no offset is set."""
    moving = np.isin(run.kind, (Kind.RAPID, Kind.FEED, Kind.ARC, Kind.HOME))
    ends = run.end[moving].copy()
    ends[~np.isfinite(ends)] = 0.0
    return ends


def distinct(ends: np.ndarray) -> np.ndarray:
    """Without moves that go nowhere: the two interpreters need not agree on mentioning them."""
    if len(ends) < 2:
        return ends
    moved = np.abs(np.diff(ends, axis=0)).max(axis=1) > LAST_DECIMAL
    return ends[np.concatenate(([True], moved))]


def agree(text: str, folder: Path, tools: str = "", scale: float = 1.0) -> None:
    canon = run_rs274(text, folder, tools)
    assert canon.ok, canon.error
    ours, theirs = distinct(our_ends(interpret(text))), distinct(canon.ends * scale)
    assert ours.shape == theirs.shape, text
    np.testing.assert_allclose(ours, theirs, atol=LAST_DECIMAL * scale, rtol=0, err_msg=text)


def test_the_post_s_program_is_accepted_and_read_alike(tmp_path: Path) -> None:
    post = LinuxCnc()
    agree(post.write(plate_program()), tmp_path, post.tool_table(TOOLS)[1])


def test_cycles(tmp_path: Path) -> None:
    agree(
        "G17 G21 G40 G49 G80 G90 G94\nG54 G0 X1 Y1\nG0 Z8\n"
        "G98 G81 X5 Y5 Z-3 R2 F100\nX7\nY9 Z-4\nG99 X1 Y2\nX3\nG80\nG0 Z9\n"
        "G98 G83 X6 Y2 Z-3.3 R2 Q1 F50\nX9\nG73 X8 Y2 Z-3 R2 Q1.1\nG82 X4 Y4 Z-1 R1 P0.1\n"
        # Another cycle behind a cycle goes back to where the first of them began.
        "G0 Z9\nG99 G81 X5 Y5 Z-3 R2 F100\nG98 G82 X7 Z-3 R1 P0.1\nX8\nG80\nG0 Z4\nG98 G85 X1 Z-1 R1\nG80\nG0 Z9\n"
        "G85 X3 Y3 Z-1 R1\nG89 X2 Y2 Z-2 R1 P0.2\nG80\nG0 Z1\nG99 G81 X1 Y1 Z-1 R3\nM2\n",
        tmp_path,
    )


def test_retracts(tmp_path: Path) -> None:
    agree("G21 G90 G17\nG0 X3 Y4 Z5\nG28 Z6\nG0 X1 Y1\nG91 G28 Z0\nG90 G0 Z3\nG53 G0 X0 Y0\nM2\n", tmp_path)


@pytest.mark.parametrize(
    "line",
    [
        *("G1 X1", "G2 X10.2 Y0 I5 J0 F9", "G2 X1 Y1 F1", "G2 X10 Y0 R3 F1", "G0 G1 X1 F1", "G0 X1 X2"),
        *("G0 X1..2", "G0 X1 (open", "G0 X1 (a (b) c)", "G1.7", "M77", "G4"),
        *("G81 X1 Y1 Z-1 F1", "G83 X1 Y1 Z-1 R1 F1"),
    ],
)
def test_both_refuse(line: str, tmp_path: Path) -> None:
    text = f"G17 G21 G90 G94\nG0 X0 Y0 Z5\n{line}\nM2\n"
    assert not run_rs274(text, tmp_path).ok
    with pytest.raises(ProgramError, match=r"^line 3: "):
        interpret(text)


coordinate = st.integers(-20_000_000, 20_000_000).map(lambda n: n / 10_000 / 20)


def spell(value: float) -> str:
    return f"{value:.4f}"


@st.composite
def programs(draw: st.DrawFn) -> str:
    """A valid program of straight moves, arcs in both forms, helices and mode changes."""
    lines = ["G17 G40 G49 G80 G90 G94", "G0 X0 Y0 Z5"]
    x = y = 0.0
    for _ in range(draw(st.integers(1, 12))):
        kind = draw(st.sampled_from(["line", "line", "arc", "circle", "radius", "incremental"]))
        feed = draw(st.sampled_from(["F100", "F250.5"]))
        if kind == "line":
            axes = draw(st.sets(st.sampled_from("XYZ"), min_size=1))
            values = {axis: round(draw(coordinate), 4) for axis in sorted(axes)}
            x, y = values.get("X", x), values.get("Y", y)
            words = " ".join(axis + spell(value) for axis, value in values.items())
            lines.append(f"{draw(st.sampled_from(['G0', 'G1']))} {words} {feed}")
        elif kind == "incremental":
            dx, dy = round(draw(coordinate), 4), round(draw(coordinate), 4)
            lines += [f"G91 G1 X{spell(dx)} Y{spell(dy)} {feed}", "G90"]
            x, y = x + dx, y + dy
        else:
            word = draw(st.sampled_from(["G2", "G3"]))
            radius = draw(st.floats(0.5, 40.0))
            first = draw(st.floats(-3.1, 3.1))
            i, j = round(radius * math.cos(first), 4), round(radius * math.sin(first), 4)
            helix = draw(st.sampled_from(["", " Z1.5", " Z-2"]))
            if kind == "circle":
                lines.append(f"{word} X{spell(x)} Y{spell(y)}{helix} I{spell(i)} J{spell(j)} {feed}")
                continue
            turn = draw(st.floats(0.1, 6.0))
            across = math.pi + first + turn
            new = (round(x + i + radius * math.cos(across), 4), round(y + j + radius * math.sin(across), 4))
            if kind == "arc":
                centre = f"I{spell(i)} J{spell(j)}"
            else:
                centre = "R" + spell(draw(st.sampled_from([-1, 1])) * (radius + 0.001))
            x, y = new
            lines.append(f"{word} X{spell(x)} Y{spell(y)}{helix} {centre} {feed}")
    return "\n".join([*lines, "M2", ""])


@given(text=programs(), inches=st.booleans())
@settings(max_examples=examples(20, 60), deadline=None, suppress_health_check=[HealthCheck.too_slow])
def test_random_programs_are_read_alike(text: str, inches: bool) -> None:
    with tempfile.TemporaryDirectory() as folder:
        units = "G20\n" if inches else "G21\n"
        agree(units + text, Path(folder), scale=25.4 if inches else 1.0)
