"""Certificates: the checker confirms proven programs, and refutes what is wrong with program, part, shop or itself."""

import ast
import json
import math
import re
import subprocess
import sys
import zlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from by_control import BY_NAME, EVERY, read
from certificates import checked, made, said, written
from hypothesis import given, settings
from hypothesis import strategies as st
from mutant_traces import differences, trace
from mutants import mutant

from mechwright.errors import ProgramError
from mechwright.geometry import Loop, circle
from mechwright_cam.pages.certificate.content import unchecked
from mechwright_cam.pages.certificate.rings import rings
from mechwright_check import RefutedError, UnknownError
from mechwright_check.__main__ import main
from mechwright_check.certificate import case_of
from mechwright_check.checks import check_all
from mechwright_check.geometry import Chords, polygons
from mechwright_check.reading import Reader

CHECKER = Path(__file__).parents[2] / "cam" / "mechwright_check"
MOST_LINES = 1240
"""Lines of the checker, with docstrings and empty ones: so few that one person reads them."""
PLAIN = (
    "profile-outside",
    "pocket-island",
    "peck",
    "rest",
    "tabs",
    "floor",
    "ream",
    "inches",
    "pocket-adaptive",
)
"""Operations within the subset of the checker."""


def test_the_checker_is_small_and_imports_nothing_of_ours() -> None:
    lines, asked = 0, set()
    for path in CHECKER.glob("*.py"):
        text = path.read_text(encoding="utf-8")
        lines += len(text.splitlines())
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.Import):
                asked |= {alias.name.partition(".")[0] for alias in node.names}
            elif isinstance(node, ast.ImportFrom):
                asked.add((node.module or "").partition(".")[0])
    assert lines <= MOST_LINES
    assert asked - sys.stdlib_module_names == {"mechwright_check", "numpy", "shapely", "ezdxf"}


@pytest.mark.parametrize(
    ("operation", "control"),
    [
        (operation, control)
        for n, operation in enumerate(PLAIN)
        for control in (EVERY[n % 7], EVERY[(n + 3) % 7])
    ],
)
def test_proven_programs_are_consistent_on_every_control(
    operation: str, control: str, tmp_path: Path, capsys: Any
) -> None:
    """The moves that the checker derives are those that the proof has seen, one by one, to a micron."""
    assert checked(capsys, written(tmp_path, operation, control))[0] == 0


@pytest.mark.parametrize(
    ("operation", "why"),
    [
        ("thread", "threads"),
        ("chamfer", "broken edges"),
        ("ball", "round end"),
        ("offsets", "several work offsets"),
    ],
)
def test_what_a_certificate_does_not_hold_is_not_checkable(
    operation: str, why: str, tmp_path: Path, capsys: Any
) -> None:
    assert any(why in one for one in unchecked(made(operation, "linuxcnc").job))
    code, line = checked(capsys, written(tmp_path, operation))
    assert (code, why in line) == (2, True)


def test_it_runs_where_mechwright_cannot_be_imported(tmp_path: Path) -> None:
    path = written(tmp_path, "profile-outside")
    code = (
        "import runpy, sys\n"
        "sys.modules.update(mechwright=None, mechwright_cam=None, mechwright_cad=None)\n"
        f"sys.path.insert(0, {str(CHECKER.parent)!r})\n"
        f"sys.argv = ['mechwright-check', {str(path)!r}]\n"
        "runpy.run_module('mechwright_check', run_name='__main__')\n"
    )
    done = subprocess.run([sys.executable, "-I", "-c", code], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert "consistent" in done.stdout


def test_a_drawing_of_ones_own_confirms_or_refutes(tmp_path: Path, capsys: Any) -> None:
    (tmp_path / "other").mkdir()
    path, other = (
        written(tmp_path, "pocket-island"),
        written(tmp_path / "other", "floor").parent / "drawing.dxf",
    )
    drawing = tmp_path / "drawing.dxf"
    code, line = checked(capsys, path, "--dxf", drawing)
    assert (code, "confirmed" in line) == (0, True), line
    code, line = checked(capsys, path, "--dxf", other)
    assert (code, "part is not that of drawing.dxf" in line) == (1, True), line
    assert checked(capsys, path, "--dxf", path)[0] == 2


def test_a_program_without_a_certificate_is_held_against_a_drawing(tmp_path: Path, capsys: Any) -> None:
    written(tmp_path, "pocket-island")
    program, drawing = tmp_path / "pocket-island.nc", tmp_path / "drawing.dxf"
    stock = ",".join(f"{edge:g}" for edge in made("pocket-island", "linuxcnc").job.stock)
    words = ("--control", "linuxcnc", "--thickness", 4, f"--stock={stock}", "--dxf", drawing, "--tools")
    code, line = checked(capsys, program, *words, "24=end-mill:6")
    assert (code, "confirmed" in line) == (0, True), line
    code, line = checked(capsys, program, *words, "24=end-mill:6.1")
    assert (code, "into the part" in line) == (1, True), line
    assert checked(capsys, program, *words[:-1])[0] == 2


def _moved(rings_: list[Any], by: float) -> None:
    for ring in rings_:
        for node in ring:
            node[0] += by
            if len(node) == 5:
                node[2] += by


FAULTS = {
    "a bore elsewhere": ("profile-outside", lambda c: _moved(c["part"]["sections"][0][1:], 30), "mm into the part"),
    "a part elsewhere": ("tabs", lambda c: _moved(c["part"]["sections"][0], 40), "into the part"),
    "a wider pocket": ("pocket-island", lambda c: c["part"]["sections"][0][1][0].__setitem__(0, -17_500), "left on a wall"),
    "a deeper floor": ("pocket-contour", lambda c: c["part"]["levels"].__setitem__(slice(None), [[0, -2100, 0], [-2100, -4000, 1]]), "left on a wall"),
    "a floor less deep": ("pocket-contour", lambda c: c["part"]["levels"].__setitem__(slice(None), [[0, -1900, 0], [-1900, -4000, 1]]), "into the part"),
    "a thicker plate": ("profile-inside", lambda c: (c["part"].update(thickness=6000), c["part"]["levels"][-1].__setitem__(1, -6000), c["limits"].update(lowest=-6300)), "left on a wall"),
    "a gap between levels": ("profile-inside", lambda c: c["part"]["levels"][0].__setitem__(0, -100), "do not fill"),
    "a thicker mill": ("profile-inside", lambda c: c["tools"]["23"].update(radius=4020, tip=4020), "into the part"),
    "a thinner mill": ("profile-inside", lambda c: c["tools"]["23"].update(radius=3980, tip=3980), "left on a wall"),
    "short flutes": ("profile-inside", lambda c: c["tools"]["23"].update(flute_length=3000), "deeper than its flutes"),
    "a mill of steel": ("profile-inside", lambda c: c["tools"]["23"].update(chip=10), "much faster than its edges"),
    "a slow edge": ("profile-inside", lambda c: c["tools"]["23"].update(speed=80), "turns T23 much faster"),
    "a shallow pass": ("tabs", lambda c: c["tools"]["23"].update(step_down=0.05), "takes more in depth"),
    "a gentle ramp": ("profile-inside", lambda c: c["tools"]["23"].update(ramp=0.1, plunge=0.01), "more steeply"),
    "no coolant": ("profile-inside", lambda c: c["tools"]["23"].update(coolant="off"), "coolant is not off"),
    "another offset": ("profile-inside", lambda c: c["machine"].update(work_offset="G55"), "G54 is not the job's"),
    "a small machine": ("tabs", lambda c: c["machine"].update(x=[-20_000, 20_000]), "leaves the travel of X"),
    "a known offset": ("tabs", lambda c: c["machine"].update(zero=[-480_000, 0, None]), "leaves the travel of X"),
    "a slow machine": ("tabs", lambda c: c["machine"].update(max_feed=1000), "feeds faster than the machine"),
    "a slow spindle": ("tabs", lambda c: c["machine"].update(spindle=[100, 5000]), "a speed that the spindle has not"),
    "a low top": ("tabs", lambda c: c["machine"].update(z=[-400_000, -50_000]), "machine Z0 is not within"),
    "a lower table": ("tabs", lambda c: c["limits"].update(lowest=-1500), "do not fill"),
    "a wide limit": ("tabs", lambda c: c["limits"].update(gouge=50), "allows deeper cuts"),
    "a tab elsewhere": ("tabs", lambda c: _moved(c["hold"]["tabs"][0]["rings"], 6000), "into a tab"),
    "a higher tab": ("tabs", lambda c: c["hold"]["tabs"][0].update(top=-1000), "into a tab"),
    "one tab": ("tabs", lambda c: c["hold"].update(tabs=c["hold"]["tabs"][:1]), "left on a wall"),
    "a clamp from the start": ("profile-outside", lambda c: c["hold"]["prisms"][0].update(stop=0), "into a clamp"),
    "a wide clamp": ("profile-outside", lambda c: c["hold"]["prisms"][0].update(rings=[[[-21e3, 0, 0, 0, 1], [21e3, 0, 0, 0, 1]]]), "into a clamp"),
    "a floor upside down": ("pocket-contour", lambda c: [one.__setitem__(2, 1 - one[2]) for one in c["part"]["levels"]], "nothing below it"),
    "another line": ("tabs", lambda c: c["moves"]["line"].__setitem__(5, 3), "claims another move here"),
    "another end": ("tabs", lambda c: c["moves"]["x"].__setitem__(7, c["moves"]["x"][7] + 2), "claims another move here"),
    "another centre": ("tabs", lambda c: c["moves"]["centre"].__setitem__(2, c["moves"]["centre"][2] + 2), "claims another"),
    "another tool": ("rest", lambda c: c["moves"]["tool"][0].__setitem__(1, 9), "claims another move here"),
    "another feed": ("rest", lambda c: c["moves"]["feed"][1].__setitem__(1, 9), "claims another move here"),
    "a move less": ("rest", lambda c: c["moves"].update(kind=c["moves"]["kind"][:-1]), "the program makes"),
    "another hash": ("rest", lambda c: c["files"][0].update(sha256="0" * 64), "its hash is another"),
    "no tools": ("rest", lambda c: c.update(tools={}), "is no tool of the job"),
    "no moves": ("rest", lambda c: c.pop("moves"), "damaged"),
    "text for a number": ("rest", lambda c: c["tools"]["21"].update(radius="six"), "damaged"),
    "a hole by itself": ("rest", lambda c: c["part"]["sections"][0].pop(0), ""),
    "an outline that crosses itself": ("rest", lambda c: c["part"]["sections"][0][0].reverse(), ""),
}  # fmt: skip
"""A fault of a certificate that is sealed anew: in which program, the change, and what is said of it."""


@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_of_a_certificate_is_refuted(fault: str, tmp_path: Path, capsys: Any) -> None:
    operation, change, words = FAULTS[fault]
    code, line = checked(capsys, written(tmp_path, operation, change=change))
    assert code == 1, line
    assert words in line


def test_a_certificate_that_was_changed_is_refuted_by_its_seal(tmp_path: Path, capsys: Any) -> None:
    path = written(tmp_path, "rest")
    text = path.read_text(encoding="ascii")
    place = text.index('"stock":[') + 10
    path.write_text(text[:place] + str((int(text[place]) + 1) % 10) + text[place + 1 :], encoding="ascii")
    assert "changed after it was written" in checked(capsys, path)[1]
    path.write_text(text[: len(text) // 2], encoding="ascii")
    assert "no whole certificate" in checked(capsys, path)[1]
    path.write_text(text, encoding="ascii")
    program = tmp_path / json.loads(text)["files"][0]["name"]
    program.write_text(program.read_text(encoding="ascii").replace("Z-2", "Z-3", 1), encoding="ascii")
    assert "is not the program that the certificate is of" in checked(capsys, path)[1]
    program.unlink()
    assert checked(capsys, path)[0] == 2


@settings(max_examples=40, deadline=None)
@given(content=st.binary(max_size=300) | st.text(max_size=300).map(str.encode))
def test_any_bytes_give_one_line(content: bytes, tmp_path_factory: Any) -> None:
    path = tmp_path_factory.mktemp("any") / "any.certificate.json"
    path.write_bytes(content)
    assert main([str(path)]) in {1, 2}


def outcome(text: str, operation: str, control: str) -> tuple[int, str]:
    """What the checker says of a text whose certificate claims whatever moves it makes."""
    content = json.loads(said(operation, control))
    try:
        check_all(case_of(content, {content["files"][0]["name"]: text}, []))
    except RefutedError as error:
        return 1, str(error)
    except UnknownError as error:
        return 2, str(error)
    return 0, ""


SURE = (
    *(
        "G54 -> G55",
        "M3 lost",
        "M3 -> M4",
        "M6 lost",
        "M8 lost",
        "G17 -> G18",
        "G21 -> G20",
        "G43 lost",
        "G53 lost",
    ),
    *(
        "another T",
        "another H",
        "S times 10",
        "F times 100",
        "point lost",
        "I off by 1",
        "Y off by 10",
        "Z sign",
    ),
    *("line lost: safe start", "line lost: tool change", "cut short", "tab lost"),
)
"""Faults of a text that nothing excuses."""
SOURCES = [("tabs", "linuxcnc"), ("rest", "haas"), ("profile-outside", "grbl"), ("peck", "fanuc")]


@pytest.mark.parametrize("kind", SURE)
def test_a_fault_of_a_program_is_refuted_even_if_its_certificate_claims_it(kind: str) -> None:
    rng = np.random.default_rng(zlib.crc32(kind.encode()))
    for operation, control in SOURCES:
        one = made(operation, control)
        wrong = mutant(one.text, kind, rng)
        if wrong is None or len(one.files) > 1:
            continue
        code, why = outcome(wrong.text, operation, control)
        if code == 0:
            reader = BY_NAME[control]
            before, after = (trace(read(text, one.job, reader)) for text in (one.text, wrong.text))
            assert not differences(before, after), f"{operation} {control}, {wrong.line}: {wrong.change}"
        elif code == 1 and "left on" not in why and "is not cut" not in why and "held by" not in why:
            assert re.search(r"line \d+: ", why), why


@pytest.mark.parametrize(
    ("control", "block"),
    [
        ("grbl", "Z5 G49"),
        ("grbl", "G1 G49 Z-2"),
        ("grbl", "G43.1 X1 Z2"),
        ("grbl", "G28"),
        ("linuxcnc", "G0 G1 X5"),
        ("linuxcnc", "X5 X6"),
        ("linuxcnc", "X#100"),
        ("linuxcnc", "Z[-6.3+#100]"),
        ("linuxcnc", "G41 D1 X5"),
        ("linuxcnc", "G92 X0"),
        ("linuxcnc", "/G0 X5"),
        ("linuxcnc", "G64 P0.01"),
        ("linuxcnc", "(DEBUG, #1)"),
        ("haas", "G0 X5"),
        ("fanuc", "M98 P1000"),
        ("siemens-840d", "SUPA Z300"),
        ("siemens-840d", "X=AC(5)"),
        ("heidenhain-tnc", "9 L Z+300 M91"),
    ],
)
def test_a_block_outside_of_the_table_is_not_checkable(control: str, block: str) -> None:
    reader = Reader(control, json.loads(said("rest", control))["machine"], {})
    with pytest.raises(UnknownError, match="line 1: "):
        reader.read(block + "\n", 0, "")


def test_every_fault_is_worth_a_word_of_the_grammar() -> None:
    """Unknown programs end in their text's own error, and never in an exception of Python."""
    with pytest.raises((RefutedError, UnknownError)):
        Reader("linuxcnc", {"work_offset": None}, {}).read("G0 X1\n", 0, "")
    with pytest.raises(UnknownError):
        Reader("nobody", {}, {})


@given(st.floats(0.5, 200), st.floats(-300, 300), st.integers(0, 5))
@settings(max_examples=30, deadline=None)
def test_a_circle_of_a_certificate_is_the_circle(radius: float, x: float, holes: int) -> None:
    outer = shapely.Polygon(Loop((circle((x, 1.0), radius),)).flatten())
    inner = [
        shapely.Point(x + radius * (k - 2) / 4, 1.0).buffer(radius / 12, quad_segs=60) for k in range(holes)
    ]
    shape = shapely.difference(outer, shapely.union_all(inner))
    nodes = rings(shape)
    again = polygons(nodes)
    assert [len(ring) for ring in nodes] == [2] * len(nodes)
    assert math.isclose(again.area, shape.area, abs_tol=0.001 * shape.length)
    assert shapely.hausdorff_distance(shapely.boundary(again), shapely.boundary(shape)) < 0.0015


def test_chords_of_a_helix_stay_within_their_sag() -> None:
    row = np.zeros(17)
    row[[1, 2, 5, 4, 7, 10, 11]] = 1, 5, 5, 0, -2, math.tau, 1
    chords = Chords.of(row[None])
    middle = (chords.a + chords.b) / 2
    assert 0 < (5 - np.hypot(middle[:, 0], middle[:, 1])).max() < 0.00031
    assert (chords.a[0, 2], chords.b[-1, 2]) == (0, -2)
    low = chords.below(-1.0)
    assert math.isclose(low.a[:, 2].max(), -1.0)


def test_the_reader_of_our_own_agrees_that_a_program_cannot_be_read() -> None:
    with pytest.raises(ProgramError):
        read("G0 X[1\n", made("rest", "linuxcnc").job, BY_NAME["linuxcnc"])
