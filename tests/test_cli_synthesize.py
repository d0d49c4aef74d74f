"""``mechwright synthesize``: designs that meet a requirement, and every way to ask for the wrong thing."""

import json
import math
import re
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

import mechwright.plugins.host as hosting
from mechwright.contracts.family import Family
from mechwright.contracts.motion import Scalar
from mechwright.contracts.synthesis import Candidate, Rejected
from mechwright.designs.design import load
from mechwright.designs.requirement import load_requirement
from mechwright.plugins.host import Registered
from mechwright_cam.shop.library import BUILT_IN
from mechwright_cam.shop.table import settings_of

sys.path.insert(0, str(Path(__file__).parent / "core"))
from disc_family import Disc

Run = Callable[..., tuple[int, str, str]]


@pytest.fixture(autouse=True)
def disc(monkeypatch: pytest.MonkeyPatch) -> None:
    # In the host itself: what is imported meanwhile would keep another one.
    families = hosting.host().registered[Family]
    monkeypatch.setitem(families, "disc", Registered(Disc(), "disc-mechanisms", "disc"))


def requirement(folder: Path, text: str) -> Path:
    path = folder / "wanted.toml"
    path.write_text(text)
    return path


def test_designs_are_written_best_first_with_their_residuals(command_line: Run, tmp_path: Path) -> None:
    path = requirement(tmp_path, 'family = "disc"\n[requirement]\nrim_speed = 200\n[cam]\nclearance = 7\n')
    code, said, wrong = command_line("synthesize", path, "-o", tmp_path / "out")
    assert (code, wrong) == (0, "")
    assert "wanted-1.toml: residual" in said
    summary = json.loads((tmp_path / "out" / "synthesis.json").read_text())
    assert (summary["family"], summary["kind"]) == ("disc", "rim")
    assert summary["requirement"] == {"rim_speed": 200, "count": 2}
    assert [one["design"] for one in summary["candidates"]] == ["wanted-1.toml", "wanted-2.toml"]
    for one in summary["candidates"]:
        design = load(tmp_path / "out" / one["design"], hosting.host())
        rim = design.family.solve(design.params, 2).scalars["rim_speed"].value
        assert rim == pytest.approx(200, abs=1e-9)
        assert one["figures"]["rim"] == {"value": pytest.approx(200), "unit": "mm/s"}
        assert settings_of(design).cam.clearance == 7
        assert command_line("check", tmp_path / "out" / one["design"])[0] == 0
    manifest = json.loads((tmp_path / "out" / "manifest.json").read_text())
    assert set(manifest["outputs"]) == {
        "wanted-1.toml",
        "wanted-2.toml",
        "gallery.html",
        "synthesis.json",
    }


def test_what_nobody_asked_for_bars_no_machine_that_is_named_later(command_line: Run, tmp_path: Path) -> None:
    asked = 'family = "disc"\n[requirement]\n[cam]\nclearance = 7\n[cam.machine]\nrapid = 9000\n'
    path = requirement(tmp_path, asked)
    assert command_line("synthesize", path, "-o", tmp_path / "out")[0] == 0
    design = tmp_path / "out" / "wanted-1.toml"
    text = design.read_text()
    given = [line.split(" =")[0] for line in text.split("[cam]")[1].splitlines() if re.match(r"\w+ =", line)]
    assert given == ["clearance", "rapid"]
    assert "# retract_z = 0.0  # Machine Z of a full retract" in text
    plain = settings_of(load(design, hosting.host())).cam.machine
    assert (plain.retract_z, plain.rapid) == (0, 9000)
    design.write_text(text.replace('# model = ""', 'model = "desktop-router"'))
    named = settings_of(load(design, hosting.host())).cam.machine
    assert (named.retract_z, named.rapid) == (-2, 9000)
    assert named.travel_x != plain.travel_x


def test_a_new_design_with_all_keys_leaves_room_for_a_machine(command_line: Run, tmp_path: Path) -> None:
    path = tmp_path / "new.toml"
    assert command_line("new", "disc", "--all", "-o", path)[0] == 0
    path.write_text(path.read_text().replace('# model = ""', 'model = "desktop-router"'))
    assert settings_of(load(path, hosting.host())).cam.machine.retract_z == -2


def test_a_requirement_that_is_taken_for_a_design_is_told(command_line: Run, tmp_path: Path) -> None:
    path = requirement(tmp_path, 'family = "disc"\n[requirement]\n')
    for command in (("check", path), ("build", path, "-o", tmp_path / "out")):
        code, _, wrong = command_line(*command)
        assert code == 2
        assert "find designs by mechwright synthesize wanted.toml -o FOLDER" in wrong
        assert len(wrong.splitlines()) == 1


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ('family = "disc"\n[study.ranges]\n', "sweep it by mechwright sweep wanted.toml -o FOLDER"),
        ('format = 1\ncontrol = "grbl"\n[[tool]]\n', 'in the head of one: shop = "wanted.toml"'),
    ],
)
def test_a_file_of_another_kind_is_told_what_it_is_for(
    command_line: Run, tmp_path: Path, text: str, told: str
) -> None:
    """A study had an unknown key, and a shop one that "belongs to [cam]"."""
    path = tmp_path / "wanted.toml"
    path.write_text(text, encoding="utf-8")
    code, _, wrong = command_line("check", path)
    assert code == 2
    assert told in wrong
    assert len(wrong.splitlines()) == 1


@pytest.mark.parametrize(
    ("family", "kind", "keys"),
    [
        ("cam-follower", "size", ("lifts", "swings", "roller_radius")),
        ("geneva", "indexing", ("wheel_diameter", "centre_distance", "overall_length")),
    ],
)
def test_a_new_requirement_has_what_one_asks_for_first(
    command_line: Run, family: str, kind: str, keys: tuple[str, ...]
) -> None:
    """That of a cam did not say how far the follower goes, since it may be left out."""
    code, text, _ = command_line("new", family, "--requirement", kind)
    assert code == 0
    assert [key for key in keys if f"\n# {key} = ..." not in text] == []


def test_many_designs_sort_as_they_are_numbered(command_line: Run, tmp_path: Path) -> None:
    path = requirement(tmp_path, 'family = "disc"\n[requirement]\nkind = "rim"\ncount = 12\n')
    assert command_line("synthesize", path, "-o", tmp_path / "out")[0] == 0
    names = sorted(file.name for file in (tmp_path / "out").glob("wanted*"))
    assert (names[0], names[-1]) == ("wanted-01.toml", "wanted-12.toml")


def test_a_requirement_that_cannot_be_met_is_exit_code_1_and_writes_nothing(
    command_line: Run, tmp_path: Path
) -> None:
    path = requirement(tmp_path, 'family = "disc"\n[requirement]\nrim_speed = 90000\n')
    code, said, wrong = command_line("synthesize", path, "-o", tmp_path / "out")
    assert (code, said) == (1, "")
    assert "rim_speed: no disc up to 1000 rev/min" in wrong
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('family = "elliptic"\n', "family: "),
        (
            'family = "disc"\n[requirement]\nkind = "rims"\n',
            "requirement.kind: unknown kind 'rims'; did you mean",
        ),
        ('family = "disc"\n[requirement]\nkind = 3\n', "requirement.kind: unknown kind '3'"),
        ('family = "disc"\n[requirement]\nspeed = 3\n', "requirement: unknown key 'speed'"),
        ('family = "disc"\n[requirement]\nrim_speed = -3\n', "requirement.rim_speed: "),
        ('family = "disc"\nrequirement = 3\n', "requirement: is 3; write a table [requirement]"),
        ('family = "disc"\n[parameters]\nbore = 3\n', "parameters: this file is a design, and asks for none"),
        ('family = "disc"\n[cam]\nclear = 3\n', "cam: unknown key 'clear'"),
        ('family = "disc"\n[cam]\ntool_library = "../a.toml"\n', "leads out"),
    ],
)
def test_a_mistake_is_one_line(command_line: Run, tmp_path: Path, text: str, words: str) -> None:
    code, said, wrong = command_line("synthesize", requirement(tmp_path, text), "-o", tmp_path / "out")
    assert (code, said) == (2, "")
    assert len(wrong.splitlines()) == 1
    assert words in wrong
    assert str(tmp_path / "wanted.toml") in wrong
    assert not (tmp_path / "out").exists()


def test_a_family_without_a_synthesis_says_so(
    command_line: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Disc, "requirements", {})
    path = requirement(tmp_path, 'family = "disc"\n')
    code, _, wrong = command_line("synthesize", path, "-o", tmp_path / "out")
    assert code == 2
    assert "family disc has no synthesis" in wrong
    code, _, wrong = command_line("new", "disc", "--requirement", "rim")
    assert code == 2
    assert "has no synthesis" in wrong


def test_one_kind_has_to_be_named_where_there_are_two(
    command_line: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Disc, "requirements", Disc.requirements | {"hub": Disc.requirements["rim"]})
    path = requirement(tmp_path, 'family = "disc"\n')
    code, _, wrong = command_line("synthesize", path, "-o", tmp_path / "out")
    assert code == 2
    assert "requirement.kind: is missing; one of: rim, hub" in wrong


def test_a_new_requirement_file_can_be_met(command_line: Run, tmp_path: Path) -> None:
    path = tmp_path / "rim.toml"
    assert command_line("new", "disc", "--requirement", "rim", "-o", path)[0] == 0
    asked = load_requirement(path, hosting.host())
    assert (asked.kind, asked.table) == ("rim", Disc.requirements["rim"]())
    assert command_line("synthesize", path, "-o", tmp_path / "out")[0] == 0
    code, _, wrong = command_line("new", "disc", "--requirement", "rin")
    assert code == 2
    assert "did you mean 'rim'" in wrong


def test_a_tool_library_goes_with_the_designs(command_line: Run, tmp_path: Path) -> None:
    library = BUILT_IN
    (tmp_path / "shop").mkdir()
    (tmp_path / "shop" / "own.toml").write_text(library.read_text())
    path = requirement(tmp_path, 'family = "disc"\n[cam]\ntool_library = "shop/own.toml"\n')
    assert command_line("synthesize", path, "-o", tmp_path / "out")[0] == 0
    design = load(tmp_path / "out" / "wanted-1.toml", hosting.host())
    assert settings_of(design).tool_library is not None
    assert settings_of(design).tool_library.read_text() == library.read_text()


def test_the_families_listing_names_the_kinds(command_line: Run) -> None:
    assert "    synthesis: rim" in command_line("families")[1].splitlines()
    (listed,) = [
        family
        for family in json.loads(command_line("families", "--json")[1])["families"]
        if family["name"] == "disc"
    ]
    assert "rim_speed" in listed["requirements"]["rim"]["properties"]


def test_designs_that_the_tables_do_not_let_build_are_named_and_not_given(
    command_line: Run, tmp_path: Path
) -> None:
    """A machine too small for the larger of two discs; one too small for both."""
    text = 'family = "disc"\n[requirement]\nkind = "rim"\n[cam.machine]\ntravel_x = {0}\ntravel_y = {0}\n'
    assert command_line("synthesize", requirement(tmp_path, text.format(500)), "-o", tmp_path / "all")[0] == 0
    whole = json.loads((tmp_path / "all" / "synthesis.json").read_text())
    assert whole["rejected"] == []
    diameters = [
        load(tmp_path / "all" / one["design"], hosting.host()).params.diameter for one in whole["candidates"]
    ]
    assert diameters == [40, 50]
    small = requirement(tmp_path, text.format(10))
    code, _, wrong = command_line("synthesize", small, "-o", tmp_path / "none")
    assert code == 1
    assert "2 found, 0 given: 2 travel" in wrong
    assert not (tmp_path / "none").exists()
    asked = float(re.search(r"synthesis.unbuildable.* asks for ([\d.]+) mm of travel", wrong)[1])
    code, said, _ = command_line(
        "synthesize", requirement(tmp_path, text.format(asked + 5)), "-o", tmp_path / "some"
    )
    assert (code, "2 found, 1 given: 1 travel" in said) == (0, True)
    assert re.search(r"\n  1 travel: error \[cam.travel\] .* of travel", said)
    some = json.loads((tmp_path / "some" / "synthesis.json").read_text())
    assert [(one["code"], one["count"]) for one in some["rejected"]] == [("cam.travel", 1)]


def test_tables_are_blamed_in_words_of_what_they_do_not_let_build(command_line: Run, tmp_path: Path) -> None:
    """All that were found are looked at, those beyond the number too."""
    asked = 'family = "four-bar"\n[requirement]\nkind = "poses"\ndesigns = 1\n[cam.machine]\ntravel_x = 10\n'
    code, _, wrong = command_line("synthesize", requirement(tmp_path, asked), "-o", tmp_path / "out")
    assert code == 1
    assert re.search(r"synthesis.unbuildable.* as its tables say: error \[cam.travel\]", wrong)
    assert re.search(r" 0 given: .*, [2-9] travel\b", wrong)
    assert "beyond the number" not in wrong


def test_the_terminal_says_how_many_were_found_of_how_many(command_line: Run, tmp_path: Path) -> None:
    """Notes stand below the designs; of each reason the words of the first design stand there too."""
    asked = 'family = "four-bar"\n[requirement]\nkind = "poses"\ndesigns = 1\n'
    code, said, wrong = command_line("synthesize", requirement(tmp_path, asked), "-o", tmp_path / "out")
    assert (code, wrong) == (0, "")
    summary = json.loads((tmp_path / "out" / "synthesis.json").read_text())
    lines = said.splitlines()
    assert f"note [{summary['findings'][0]['code']}] {summary['findings'][0]['message']}" in lines
    found = 1 + sum(one["count"] for one in summary["rejected"])
    place = next(place for place, line in enumerate(lines) if line.startswith(f"{found} found, 1 given: "))
    reasons = lines[place + 1 : -1]
    assert len(reasons) == len(summary["rejected"]) > 1
    for line, reason in zip(reasons, summary["rejected"], strict=True):
        assert line.startswith(f"  {reason['count']} ")
        assert line.endswith(f": {reason['message']}")
    assert "beyond the number" in said


def test_designs_are_counted_together_with_those_that_come_after() -> None:
    rejected = Rejected()
    rejected.because("a.b", "first")
    rejected.because("a.b", "second", 3)
    rejected.same(2)
    rejected.beyond(5, 9)
    rejected.beyond(5, 0)
    told = [(one.count, str(one), one.message.split(" = ")[-1]) for one in rejected.reasons]
    assert told == [
        (9, "9 beyond the number", "5"),
        (4, "4 b", "first"),
        (2, "2 near another", "nearly the same as a design that was found before"),
    ]


def test_a_number_that_is_none_is_named_once(command_line: Run, tmp_path: Path) -> None:
    """What is wrong in a list is not counted among its items: no second line says that the list is short."""
    asked = 'family = "four-bar"\n[requirement]\nkind = "path"\npoints = [[1, 2], [nan, 4], [5, 9]]\n'
    code, said, wrong = command_line("synthesize", requirement(tmp_path, asked), "-o", tmp_path / "out")
    assert (code, said) == (2, "")
    assert wrong.splitlines() == [
        f"mechwright: {tmp_path / 'wanted.toml'}: requirement.points.1.0: nan should be a finite number"
    ]
    asked = asked.replace("nan", "3").replace(", [5, 9]", "")
    _, _, wrong = command_line("synthesize", requirement(tmp_path, asked), "-o", tmp_path / "out")
    assert wrong.endswith("requirement.points: has 2 entries; 3 at least are needed\n")
    asked = asked.replace("[3, 4]", "[3, 4, 5]")
    _, _, wrong = command_line("synthesize", requirement(tmp_path, asked), "-o", tmp_path / "out")
    assert "requirement.points.1: has 3 entries; 2 at most are taken\n" in wrong


def test_a_kind_beside_the_table_is_told_where_it_belongs(command_line: Run, tmp_path: Path) -> None:
    asked = 'family = "four-bar"\nkind = "path"\n[requirement]\npoints = [[1, 2], [3, 4], [5, 9]]\n'
    code, _, wrong = command_line("synthesize", requirement(tmp_path, asked), "-o", tmp_path / "out")
    assert code == 2
    assert "unknown key 'kind'; it stands in the head of the file and belongs to [requirement]" in wrong


def test_angles_are_told_in_degrees() -> None:
    candidate = Candidate(
        None, Scalar(math.pi / 6, "rad"), {"turn": Scalar(math.pi, "rad"), "a": Scalar(2.0, "mm")}
    )
    assert candidate.as_dict() == {
        "residual": {"value": pytest.approx(30), "unit": "deg"},
        "figures": {"turn": {"value": 180, "unit": "deg"}, "a": {"value": 2, "unit": "mm"}},
    }


def test_designs_beyond_the_number_stand_in_for_those_that_cannot_be_built(
    command_line: Run, tmp_path: Path
) -> None:
    """Of the two nearest designs one is too large for the machine, and the search has found others."""
    asked = (
        'family = "four-bar"\n[requirement]\nkind = "path"\nclosed = true\nlongest_link = 400\nstarts = 6000\n'
        "designs = 2\npoints = [[40, 0], [20, 15], [-20, 15], [-40, 0], [-20, -15], [20, -15]]\n"
        "[cam.machine]\ntravel_x = 140\ntravel_y = 140\n"
    )
    code, said, wrong = command_line("synthesize", requirement(tmp_path, asked), "-o", tmp_path / "out")
    assert (code, wrong) == (0, "")
    assert "wanted-2.toml" in said
    assert re.search(r" found, 2 given: .*\d travel", said)
