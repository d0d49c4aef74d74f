"""Mistakes in files are told with their line, and the table to which a key belongs."""

import re
import time

import pytest

from mechwright.contracts.family import Family
from mechwright.designs.design import load
from mechwright.designs.hints import line_of
from mechwright.designs.requirement import load_requirement
from mechwright.designs.tables import read_table
from mechwright.designs.toml_hints import toml_hint
from mechwright.errors import DesignError
from mechwright.plugins.host import host
from mechwright.standards.motors import motor

HEAD = 'format = 1\nfamily = "four-bar"\n'
TOLD = {
    "decimal comma": (
        "[parameters]\ncrank = 12,5  # mm\n",
        "line 4 has a decimal comma; write a point: crank = 12.5",
    ),
    "negative decimal comma": (
        "[parameters]\npivot_x = -0,25\n",
        "line 4 has a decimal comma; write a point: pivot_x = -0.25",
    ),
    "decimal comma in a text": (
        '[parameters]\n\ncrank = "12,5 mm"\n',
        "line 5: parameters.crank: '12,5 mm' cannot be read in mm; write a point for the decimal comma: '12.5 mm'",
    ),
    "no quotes": ("[parameters]\nbranch = open\n", 'line 4 has a text without quotes; write branch = "open"'),
    "a unit": (
        "[parameters]\ncrank = 30 mm  # long\n",
        'line 4 has a unit without quotes; write crank = "30 mm"',
    ),
    "a comma and a unit": ("[parameters]\ncrank = 3,5mm\n", 'write crank = "3.5 mm"'),
    "an inch mark": ('[parameters]\ncrank = 1/4"\n', 'write crank = "1/4 in"'),
    "a degree": ("[parameters]\nground_angle = -90°\n", 'write ground_angle = "-90 deg"'),
    "quotes of print": ("[parameters]\nbranch = “open”\n", 'quotes as in print; write branch = "open"'),
    "a colon": ("[parameters]\ncrank: 30\n", "line 4 has a colon; write crank = 30"),
    "a semicolon": ("[parameters]\ncrank = 30;\n", "that does not belong there; write crank = 30"),
    "a semicolon behind a word": ("[parameters]\ncrank = Yes;\n", "true or false; write crank = true"),
    "a comment behind a value": ("[parameters]\ncrank = 30 // long\n", "begins with //; write # before it"),
    "a comment behind a unit": ("[parameters]\ncrank = 3 mm  -- long\n", 'write crank = "3 mm"'),
    "a comma at the end": ("[parameters]\ncrank = 30,\n", "write crank = 30"),
    "no equals sign": ("[parameters]\ncrank 30\n", "line 4 lacks an equals sign; write crank = 30"),
    "a fraction": ("[parameters]\ncrank = 81/2\n", "line 4 has a fraction; write crank = 40.5"),
    "a zero in front": ("[parameters]\ncrank = 030.5\n", "line 4 has a zero in front; write crank = 30.5"),
    "a bare point": ("[parameters]\nclearance = .5\n", "write clearance = 0.5"),
    "a point at the end": ("[parameters]\ncrank = 30.\n", "write crank = 30.0"),
    "a word for true": ("[cam]\nclimb = Yes\n", "has a word for true or false; write climb = true"),
    "a word for false": ("[cam]\nclimb = off\n", "has a word for true or false; write climb = false"),
    "another comment": ("[parameters]\n// the crank\n", "line 4 begins with //; a comment begins with #"),
    "a key twice": (
        "[cam]\nclimb = true\n[parameters]\ncrank = 30\n# again\ncrank = 31\n",
        "crank stands on line 6 already; leave out one of the two",
    ),
    "no second quote": ('[parameters]\nbranch = "open\n', "line 4 lacks a quote"),
    "no first quote": ('[parameters]\nbranch = open"\n', "line 4 lacks a quote"),
    "in the head": (
        "crank = 30\n[parameters]\n",
        "line 3: unknown key 'crank'; it stands in the head of the file and belongs to [parameters]",
    ),
    "of the workshop": (
        '[parameters]\ncrank = 30\ncontrol = "haas"\n',
        "line 5: parameters: unknown key 'control'; it stands in [parameters] and belongs to [cam]",
    ),
    "of the family": (
        "[cam]\ncoupler = 30\n",
        "line 4: cam: unknown key 'coupler'; it stands in [cam] and belongs to [parameters]",
    ),
    "of a table inside": (
        "[cam]\ntravel_x = 30\n",
        "line 4: cam: unknown key 'travel_x'; it stands in [cam] and belongs to [cam.machine]",
    ),
    "of several tables": (
        "[parameters]\n\n[tolerances]\nclearance = 2\nname = 2\n",
        "line 7: tolerances: unknown key 'name'; it stands in [tolerances] and belongs to the head of the file or [cam.machine]",
    ),
    "of the head": (
        '[parameters]\nfamily = "geneva"\n',
        "line 4: parameters: unknown key 'family'; it stands in [parameters] and belongs to the head of the file",
    ),
    "misspelt": (
        "[parameters]\n# crnk\ncrnk = 3\n",
        "line 5: parameters: unknown key 'crnk'; did you mean 'crank'?",
    ),
    "another word for it": (
        "[parameters]\nrocker = 30\n",
        "line 4: parameters: unknown key 'rocker'; it is called follower",
    ),
    "how it begins": (
        "[parameters]\nbushing = 30\n",
        "line 4: parameters: unknown key 'bushing'; did you mean 'bushing_wall'?",
    ),
    "a word of several": (
        "[parameters]\nwidth = 30\n",
        "line 4: parameters: unknown key 'width'; did you mean 'web_width'?",
    ),
    "a table": ("[parametres]\n", "line 3: unknown key 'parametres'; did you mean 'parameters'?"),
}


@pytest.mark.parametrize("case", TOLD)
def test_a_mistake_is_told_with_its_line(case, tmp_path):
    text, said = TOLD[case]
    path = tmp_path / "d.toml"
    path.write_text(HEAD + text)
    with pytest.raises(DesignError) as caught:
        load(path, host())
    lines = str(caught.value).splitlines()
    assert any(said in line for line in lines), lines
    assert all(line.startswith(f"{path}: ") for line in lines)


def test_what_is_toml_without_a_likely_slip_keeps_its_own_words(tmp_path):
    path = tmp_path / "d.toml"
    path.write_text(HEAD + "[parameters\n")
    with pytest.raises(DesignError, match=r"is no valid TOML: [^;]*\(at line 3, column \d+\)$"):
        load(path, host())


def test_a_requirement_file_too(tmp_path):
    path = tmp_path / "r.toml"
    path.write_text('family = "four-bar"\n[cam]\nstarts = 3\n[requirement]\nkind = "path"\n')
    with pytest.raises(
        DesignError, match=r"line 3: cam: .*it stands in \[cam\] and belongs to \[requirement\]"
    ):
        load_requirement(path, host())


def test_lines_are_found_under_dotted_quoted_and_spaced_keys():
    text = '[ "cam" . machine ]\nname = 1\n[cam.part.crank]\n"origin" = 2\n[[x]]\nholes.a = 3\n'
    assert line_of(text, "cam.machine", "name") == 2
    assert line_of(text, "cam.part.crank", "origin") == 4
    assert line_of(text, "", "cam") == 0
    assert line_of(text, "nowhere", "name") == 0


@pytest.mark.parametrize("line", [" " * 200_000 + "x", "a = 1" + " // " * 50_000 + '"'])
def test_a_line_that_nobody_typed_takes_no_time(line):
    """The time of the search for what was meant grows with the square of the blanks."""
    begun = time.process_time()
    assert not toml_hint(line, "Invalid value (at line 1, column 2)")
    assert time.process_time() - begun < 1


@pytest.mark.parametrize("family", sorted(host().of(Family)))
def test_what_is_said_of_another_word_names_a_key(family):
    """None is a key itself, and each is told a key that there is, or the command that helps."""
    model = host().family(family).Params
    assert not set(model.also) & set(model.model_fields)
    for word, said in model.also.items():
        names = set(re.findall(r"\w+", said))
        assert names & (set(model.model_fields) | {"synthesize"}), word
        with pytest.raises(DesignError, match=f"unknown key '{word}'; {re.escape(said)}"):
            read_table(model, {word: 1}, "a.toml", "parameters")


@pytest.mark.parametrize("name", ["NEMA 17", "nema17", "nema-17"])
def test_a_motor_is_told_its_lengths(name):
    with pytest.raises(DesignError, match="did you mean 'NEMA 17 - 34', 'NEMA 17 - 40' or 'NEMA 17 - 48'"):
        motor(name)
