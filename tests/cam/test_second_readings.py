"""Second readings of the manuals of Fanuc, Haas, Mach3 and HEIDENHAIN, held against the tables that the reader goes by.

The files of ``tests/data/second_readings`` were written from the manuals, without the tables. What the reader takes the
manual has; what the manual has and the reader does not take is refused.
"""

import tomllib
from pathlib import Path
from typing import Any

import pytest
from by_control import BY_NAME, interpret
from klartext_blocks import numbered

from mechwright.errors import ProgramError
from mechwright_cam.controls.words import klartext
from mechwright_cam.controls.words.table import Code, Use

FOLDER = Path(__file__).parents[1] / "data" / "second_readings"
READ = {path.stem: tomllib.loads(path.read_text()) for path in FOLDER.glob("*.toml")}
MILLS = ("fanuc", "haas", "mach3")
VALUES = {
    "X": "20.",
    "Y": "20.",
    "Z": "-1.",
    "R": "3.",
    "Q": "1.",
    "P": "1",
    "L": "1",
    "K": "1",
    "D": "1",
    "H": "1",
}
START = "G17 G21 G40 G49 G80 G90 G94\nG98\nG54\nS900 M3\nG0 X0. Y0. Z5.\nG1 X1. F100.\n"
CASES = [(control, word, letters) for control in MILLS for word, letters in READ[control]["takes"].items()]


def rows(control: str) -> dict[str, Code]:
    return BY_NAME[control].dialect.words.known


def taken(row: Code) -> set[str]:
    return {*row.takes, *row.first_of}


@pytest.mark.parametrize(("control", "word", "letters"), CASES)
def test_no_code_takes_more_than_its_manual_gives_it(control: str, word: str, letters: str) -> None:
    assert taken(rows(control)[word]) <= set(letters), "the table gives it more than the manual"


@pytest.mark.parametrize(("control", "word", "letters"), CASES)
def test_what_a_code_does_not_take_is_refused_beside_it(control: str, word: str, letters: str) -> None:
    """Of the addresses of the manual as well as of all others; those that are codes themselves aside."""
    row = rows(control)[word]
    own = {
        letter: VALUES.get(letter, "1.")
        for letter in row.takes
        if letter in row.one_of or row.needs == letter
    }
    for letter in set("ABCEDHIJKLPQR") - taken(row):
        value = VALUES.get(letter, "1.")
        words = " ".join(f"{name}{number}" for name, number in {**own, letter: value}.items())
        text = f"{START}{word} {words}\nM30\n"
        with pytest.raises(ProgramError, match=r"^line 7: "):
            interpret(text, BY_NAME[control], diameters={1: 4.0})


@pytest.mark.parametrize("control", MILLS)
def test_every_code_that_is_read_is_one_of_the_manual(control: str) -> None:
    said = READ[control]
    known = set(said["takes"]) | set(said["nothing"]["codes"].split()) | set(said["nothing"]["m"].split())
    read = {word for word, row in rows(control).items() if row.use is not Use.REFUSED}
    assert read == known
    assert not set(said["not_listed"]["codes"].split()) & read
    for word in said["nothing"]["codes"].split():
        assert not taken(rows(control)[word]), word


@pytest.mark.parametrize("control", MILLS)
def test_ranges_and_what_stops_the_spindle_are_those_of_the_manual(control: str) -> None:
    said: dict[str, Any] = READ[control]
    table = BY_NAME[control].dialect.words
    for name, (least, most) in said["ranges"].items():
        if name.startswith("G10_L"):
            found = next(one for one in table.tables if one.number == int(name[5:]))
            assert (found.first, found.last) == (least, most), name
        elif name in "HD":
            assert (table.of(name).least, table.of(name).most) == (least, most), name
    stops = {f"M{row.number}" for row in table.m.values() if row.spindle == 0}
    assert stops == set(said["stops_spindle"]["m"].split())


def test_m89_of_haas_stops_the_spindle() -> None:
    """So it is told in chapter 8: coolant through the spindle is ended with the spindle stopped, which stays so."""
    run = interpret(f"{START}M89\nG1 X2.\nM30\n", BY_NAME["haas"])
    assert run.states[int(run.state[run.cutting][-1])].spindle == 0


# -- Klartext ------------------------------------------------------------------------------------------------

NAMES = {"R": {"R0"}, "F": {"F", "FMAX"}}
WRITTEN = {
    "R0": "R0",
    "F": "F90",
    "FMAX": "FMAX",
    "M": "M8",
    "DR": "DR+",
    "RADIUS": "R+9",
    "RL": "RL",
    "RR": "RR",
}


@pytest.mark.parametrize("block", READ["klartext"]["blocks"])
def test_blocks_take_what_their_dialogue_asks_for(block: str) -> None:
    said, left = (set(READ["klartext"][name][block].split()) for name in ("blocks", "not_read"))
    ours = {name for one in klartext.WORDS.known[block].takes for name in NAMES.get(one, {one})}
    assert ours - {"FMAX"} == said - left - {"FMAX"}


@pytest.mark.parametrize("block", READ["klartext"]["blocks"])
def test_what_is_not_read_of_them_is_refused(block: str) -> None:
    whole = {
        "L": "L X+5 F90",
        "CC": "CC X+5 Y+0",
        "C": "C X+5 Y+5 DR+ F90",
        "CR": "CR X+5 Y+5 R+5 DR+ F90",
        "CP": "CP IPA+90 DR+ F90",
    }[block]
    for name in READ["klartext"]["not_read"][block].split():
        word = WRITTEN.get(name, f"{name}+1")
        text = numbered(
            *("BEGIN PGM A MM", "CYCL DEF 247 Q339=+1", "TOOL CALL 1 Z S900", "M3", "L X+0 Y+0 R0 FMAX"),
            *("L Z+5 R0 FMAX", "CC X+5 Y+0", f"{whole} {word}", "M30", "END PGM A MM"),
        )
        with pytest.raises(ProgramError, match=r"^line 8: "):
            interpret(text, BY_NAME["heidenhain-tnc"])


def test_m_functions_and_ranges_are_those_of_the_manual() -> None:
    said = READ["klartext"]
    found = {row.word for row in klartext.WORDS.m.values() if row.use is not Use.REFUSED}
    assert found == set(said["m"]["at_start"].split()) | set(said["m"]["at_end"].split())
    assert said["m"]["most"] == klartext.MOST_M
    for name, most in said["ranges"].items():
        assert klartext.WORDS.of(name).most == most
