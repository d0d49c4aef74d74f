"""What cannot be made, through the command line: one line that names the feature, key or line, and no file."""

import re
from pathlib import Path

import pytest
from typer.testing import CliRunner

from mechwright.cli.app import make_app

GEAR = """format = 1
family = "elliptic-gears"
name = "pair"
[parameters]
eccentricity = 0.2
teeth = 21
module = 4
thickness = {thickness}
bore = {bore}
[cam]
"""


def design(folder: Path, cam: str, thickness: float = 10, bore: float = 12) -> Path:
    file = folder / "pair.toml"
    file.write_text(GEAR.format(thickness=thickness, bore=bore) + cam)
    return file


GENEVA = """format = 1
family = "geneva"
name = "indexer"
[parameters]
[cam]
tools = ["mill-16", "drill-8", "spot-6"]
"""
SLOT = r"cam\.tools: no listed end mill enters"


def run(folder: Path, *words: str) -> tuple[int, str]:
    """Exit code and everything said; nothing is written beside what was there."""
    before = sorted(path.name for path in folder.rglob("*"))
    done = CliRunner().invoke(make_app(), list(words))
    assert sorted(path.name for path in folder.rglob("*")) == before
    said = done.output + (
        str(done.exception) if done.exception and not isinstance(done.exception, SystemExit) else ""
    )
    assert "Traceback" not in said
    return done.exit_code, " ".join(said.split())


CASES = {
    "a tool longer than the machine's travel": (
        'tools = ["drill-10", "mill-6", "mill-3", "spot-6"]\n[cam.machine]\nnose_to_table = 55\n',
        r"cam\.machine\.nose_to_table: drill-10 in its holder needs \d+ mm .* over part gear, and there are 55; take a shorter tool",
    ),
    "a tool that sticks out further than the travel": (
        'tools = ["mill-6", "mill-3"]\n[cam.machine]\nnose_to_table = 30\n',
        r"cam\.machine\.nose_to_table: .*mill-6",
    ),
    "a feature deeper than the flute": (
        'tools = ["mill-2", "mill-1"]\n',
        r"cam\.tools: no end mill for part gear cuts 20\.3 mm deep; the longest, mill-2, has a flute length of 12",
    ),
    "a bore narrower than every cutter": (
        'tools = ["mill-16"]\n',
        r"cam\.tools: nothing makes bore of 12\.009 mm in part gear: no end mill up to 10\.81 mm and no drill of 12",
    ),
    "an offset the control does not have": (
        'control = "fanuc"\nwork_offset = "G59.1"\n',
        r"cam\.work_offset: .*Fanuc has no work offset G59\.1.* G54 to G59",
    ),
    "an offset that Grbl does not have, for one part": (
        'control = "grbl"\n[cam.part.gear]\nwork_offset = "G54.1 P3"\n',
        r"work_offset: .*Grbl 1\.1 has no work offset G54\.1 P3",
    ),
    "an offset that no control has": ('work_offset = "G60"\n', r"cam\.work_offset: .*G54 to G59"),
    "a control that there is not": ('control = "heidenhain"\n', r"cam\.control: .*heidenhain.*linuxcnc"),
    "a tool that there is not": ('tools = ["mill-7"]\n', r"cam\.tools: no tool 'mill-7'.*did you mean"),
}


def refused(folder: Path, words: list[str], message: str) -> None:
    code, said = run(folder, *words)
    assert code in {1, 2}
    assert re.search(message, said), said


@pytest.mark.parametrize("case", CASES)
def test_what_cannot_be_made_is_refused_by_name(case: str, tmp_path: Path) -> None:
    cam, message = CASES[case]
    file = design(tmp_path, cam, thickness=20 if "flute" in case else 10)
    refused(tmp_path, ["cam", str(file), "-o", str(tmp_path / "out")], message)


def test_build_refuses_alike(tmp_path: Path) -> None:
    cam, message = CASES["a bore narrower than every cutter"]
    refused(tmp_path, ["build", str(design(tmp_path, cam)), "-o", str(tmp_path / "out")], message)


def test_a_slot_narrower_than_every_cutter(tmp_path: Path) -> None:
    file = tmp_path / "geneva.toml"
    file.write_text(GENEVA)
    refused(tmp_path, ["cam", str(file), "-o", str(tmp_path / "out")], SLOT)


WORDS = {
    "G5.1": r"line 3: G5\.1 is no code that is read in programs for LinuxCNC",
    "G33.1 Z-3 K1": r"line 3: G33.1 from an unknown position; move to X, Y and Z first",
    "M77": r"line 3: M77 is no code that is read in programs for LinuxCNC",
    "G1 X1 W5 F100": r"line 3: axis W is not read",
    "G1 X1..2 F100": r"line 3: ",
}


@pytest.mark.parametrize("word", WORDS)
def test_a_program_with_words_that_are_not_known_is_refused_with_its_line(word: str, tmp_path: Path) -> None:
    file, program = design(tmp_path, ""), tmp_path / "foreign.nc"
    program.write_text(f"G17 G21 G40 G49 G80 G90 G94\nG54 S1000 M3\n{word}\nM30\n")
    refused(tmp_path, ["verify", str(program), "--design", str(file), "--part", "gear"], WORDS[word])


def test_a_program_that_cuts_nothing_is_not_proven(tmp_path: Path) -> None:
    file, program = design(tmp_path, ""), tmp_path / "foreign.nc"
    program.write_text("G17 G21 G40 G49 G80 G90 G94\nM30\n")
    refused(tmp_path, ["verify", str(program), "--design", str(file), "--part", "gear"], r"depth|leftover")
