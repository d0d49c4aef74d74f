"""The command ``fix``, and the remedies that ``check`` tells: what is printed, written and never written."""

import json
import re
import tomllib
from collections.abc import Callable
from pathlib import Path

import pytest
from by_night import by_night

from mechwright.designs.change import rewritten

Run = Callable[..., tuple[int, str, str]]

SHORT = """\
# a short crank
format = 1
family = "four-bar"

[parameters]
ground = 90  # between the shafts
crank = 9.0
coupler = "80 mm"
pin_diameter = 6
rim = 4
"""
SMALL = """\
family = "four-bar"
[parameters]
ground = 9
crank = 3.0
coupler = 8
follower = 7
pin_diameter = 6
rim = 4
bushing_wall = 1
"""


@pytest.fixture
def run(command_line: Run) -> Run:
    return command_line


@pytest.fixture
def short(tmp_path: Path) -> Path:
    path = tmp_path / "short.toml"
    path.write_text(SHORT, encoding="utf-8")
    return path


def test_fix_shows_the_difference_and_writes_nothing(run: Run, short: Path) -> None:
    code, out, err = run("fix", short, "--to", "parts")
    assert (code, err) == (0, "")
    assert out.startswith("error [four-bar.bores]")
    lines = out.splitlines()
    changes = [line for line in lines if line.startswith("set ")]
    assert changes
    assert all(" = " in line and "(now " in line for line in changes)
    assert f"--- {short}" in lines
    assert any(line.startswith("+") and " = " in line for line in lines)
    assert "nothing was written" in lines[-1]
    assert short.read_text(encoding="utf-8") == SHORT
    assert list(short.parent.iterdir()) == [short]


def test_what_fix_writes_passes_its_check_and_keeps_the_comments(run: Run, short: Path) -> None:
    code, _, _ = run("fix", short, "--to", "parts", "-o", short.with_name("new.toml"))
    assert code == 0
    assert short.read_text(encoding="utf-8") == SHORT
    new = short.with_name("new.toml").read_text(encoding="utf-8")
    assert new.startswith("# a short crank\n")
    assert tomllib.loads(new) != tomllib.loads(SHORT)
    code, out, _ = run("fix", short.with_name("new.toml"), "--to", "parts")
    assert (code, out) == (0, f"{short.with_name('new.toml')}: can be built as it is\n")


def test_write_changes_the_file_itself_behind_a_link_with_its_rights(run: Run, short: Path) -> None:
    short.chmod(0o640)
    link = short.with_name("link.toml")
    link.symlink_to(short)
    code, out, _ = run("fix", link, "--to", "parts", "--write")
    assert code == 0, out
    assert link.is_symlink()
    assert short.read_text(encoding="utf-8") != SHORT
    assert "# between the shafts" in short.read_text(encoding="utf-8")
    assert short.stat().st_mode & 0o777 == 0o640


@pytest.mark.parametrize("other", ["short.toml", "there.toml"])
def test_a_file_that_is_there_is_never_written_over(run: Run, short: Path, other: str) -> None:
    target = short.with_name(other)
    if not target.exists():
        target.write_text("mine", encoding="utf-8")
    before = target.read_text(encoding="utf-8")
    code, _, err = run("fix", short, "--to", "parts", "-o", target)
    assert code == 2
    assert "is there already" in err
    assert ("--write" in err) == (other == "short.toml")
    assert target.read_text(encoding="utf-8") == before


def test_a_result_that_could_not_be_read_where_it_goes_is_not_written(run: Run, short: Path) -> None:
    (short.parent / "tools.toml").write_text(
        (Path(__file__).parents[1] / "cam" / "mechwright_cam" / "shop" / "tools.toml").read_text(),
        encoding="utf-8",
    )
    short.write_text(SHORT + '[cam]\ntool_library = "tools.toml"\n', encoding="utf-8")
    (short.parent / "out").mkdir()
    assert run("fix", short, "--to", "parts")[0] == 0
    target = short.parent / "out" / "new.toml"
    code, _, err = run("fix", short, "--to", "parts", "-o", target)
    assert code == 2
    assert "tools.toml: cannot be read" in err
    assert not target.exists()


def test_a_design_that_builds_is_left_alone(run: Run, short: Path) -> None:
    short.write_text('family = "four-bar"\n', encoding="utf-8")
    code, out, _ = run("fix", short, "--to", "parts", "--write")
    assert (code, out) == (0, f"{short}: can be built as it is\n")
    assert short.read_text(encoding="utf-8") == 'family = "four-bar"\n'


@pytest.mark.parametrize(
    ("text", "words"),
    [("family = ", "TOML"), ('family = "four-bar"\n[parameters]\ncrank = -3\n', "parameters.crank")],
)
def test_a_file_that_does_not_load_is_refused_as_ever(run: Run, short: Path, text: str, words: str) -> None:
    short.write_text(text, encoding="utf-8")
    code, out, err = run("fix", short, "--write")
    assert (code, out) == (2, "")
    assert words in err
    assert short.read_text(encoding="utf-8") == text


def test_an_unknown_stage_is_refused(run: Run, short: Path) -> None:
    code, _, err = run("fix", short, "--to", "solids")
    assert code == 2
    assert "one of: motion, parts, assembly, machining, output" in err


def test_fix_as_json(run: Run, short: Path) -> None:
    code, out, _ = run("fix", short, "--to", "parts", "--json")
    said = json.loads(out)
    assert (code, said["ok"], said["left"]) == (0, True, [])
    assert all(key.startswith("parameters.") for key in said["fix"])


@by_night
def test_a_small_crank_keeps_its_lengths_and_has_a_pin_that_is_made(run: Run, short: Path) -> None:
    """It builds as it is; of a pin that is said, a thinner one is told that a cutter makes."""
    small = 'family = "slider-crank"\n[parameters]\ncrank = 3\nrod = 10\noffset = 1\n'
    short.write_text(small, encoding="utf-8")
    assert run("build", short, "-o", short.with_name("out"))[0] == 0
    short.write_text(small + "pin = 2\n", encoding="utf-8")
    target = short.with_name("new.toml")
    code, out, _ = run("fix", short, "-o", target)
    assert code == 0, out
    found = tomllib.loads(target.read_text(encoding="utf-8"))["parameters"]
    assert found == {"crank": 3, "rod": 10, "offset": 1, "pin": found["pin"]}
    assert run("build", target, "-o", short.with_name("made"))[0] == 0


@by_night
def test_a_small_linkage_comes_to_build_up_to_its_programs(run: Run, short: Path) -> None:
    """The nearest for its parts alone has walls that no tab holds while they are cut: another is taken."""
    short.write_text(SMALL, encoding="utf-8")
    target = short.with_name("new.toml")
    code, out, _ = run("fix", short, "-o", target)
    assert code == 0, out
    assert run("build", target, "-o", short.with_name("out"))[0] == 0


def test_what_cannot_be_mended_ends_with_one(run: Run, short: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from mechwright.contracts.finding import Finding
    from mechwright_four_bar.family import FourBars

    never = Finding.error("four-bar.never", "crank", "it is never right")
    monkeypatch.setattr(FourBars, "check", lambda self, params: [never])
    code, out, _ = run("fix", short, "--to", "parts", "--write")
    assert code == 1
    assert "cannot be built, and no change" in out
    assert short.read_text(encoding="utf-8") == SHORT


def test_the_nearest_of_too_many_keys_is_told_and_not_written(
    run: Run, short: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from mechwright.remedies import repair

    monkeypatch.setattr(repair, "MOST_CHANGES", 0)
    code, out, _ = run("fix", short, "--to", "parts", "--write")
    assert code == 1
    assert re.search(r"in \d+ tries\nthe nearest design that can is another in \d+ keys:\n  set ", out), out
    assert short.read_text(encoding="utf-8") == SHORT
    data = json.loads(run("fix", short, "--to", "parts", "--json")[1])
    assert (data["fix"], bool(data["nearest"])) == (None, True)


def test_check_tells_remedies_that_were_tried(run: Run, short: Path) -> None:
    code, out, _ = run("check", short, "--json")
    assert code == 1
    findings = [one for one in json.loads(out)["findings"] if one["severity"] == "error"]
    assert findings
    assert "proposed" not in findings[0]
    for finding in findings:
        assert finding["fix"], finding
        assert finding["remedy"].startswith("set ")
    _, out, _ = run("check", short)
    lines = out.splitlines()
    assert len(lines) == len(json.loads(run("check", short, "--json")[1])["findings"]) + 1, "a line for each"


def test_what_is_refused_tells_them_too(run: Run, short: Path) -> None:
    code, _, err = run("model", short, "-o", short.with_name("out"))
    assert code == 1
    assert "; set " in err
    assert all(line.startswith(f"mechwright: {short}: error [four-bar.bores]") for line in err.splitlines())


@pytest.mark.parametrize(
    ("parameters", "code"),
    [
        ("keyway_width = 3\n", "gear.cut-key"),
        pytest.param(
            "eccentricity = 0.5\nsemi_major = 40\nteeth = 50\n[cam]\ncorner_mill = 2\n",
            "gear.cut-mesh",
            marks=by_night,
        ),
        pytest.param(
            "eccentricity = 0.5\nsemi_major = 30\nteeth = 50\nthickness = 14\n",
            "gear.cut-mesh",
            marks=by_night,
        ),
    ],
)
def test_what_cutters_leave_is_told_with_a_proposal_that_works(
    run: Run, tmp_path: Path, parameters: str, code: str
) -> None:
    path = tmp_path / "gear.toml"
    path.write_text(f'family = "elliptic-gears"\n[parameters]\n{parameters}', encoding="utf-8")
    found = json.loads(run("check", path, "--json")[1])["findings"]
    (wrong,) = [one for one in found if one["severity"] == "error"]
    assert wrong["code"] == code
    ((key, value),) = wrong["fix"].items()
    assert wrong["remedy"].startswith(f"set {key.removeprefix('parameters.')} = {value}")
    path.write_text(rewritten(path.read_text(encoding="utf-8"), wrong["fix"]), encoding="utf-8")
    assert run("check", path)[0] == 0


def test_a_thin_plate_has_lower_tabs_unless_their_height_is_given(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "thin.toml"
    thin = 'family = "elliptic-gears"\n[parameters]\nthickness = 1\n'
    path.write_text(thin, encoding="utf-8")
    assert run("cam", path, "-o", tmp_path / "out")[0] == 0
    path.write_text(thin + "[cam.hold]\ntab_height = 1.0\n", encoding="utf-8")
    code, out, _ = run("check", path)
    assert code == 1
    assert (
        "cam.hold.tab_height: 1 mm is not below the thickness of 1 mm; set cam.hold.tab_height = 0.5" in out
    )


@pytest.mark.parametrize(
    ("family", "table", "fix"),
    [
        ("four-bar", 'tools = ["mill-16"]', {"cam.tools": None}),
        ("elliptic-gears", "hold.tabs = 24\nhold.tab_width = 30", "cam.hold.tab_width"),
        ("elliptic-gears", 'compensation = "wear"\nhold.tab_shape = "ramped"', "cam.hold.tab_shape"),
    ],
)
def test_what_a_refusal_of_machining_advises_was_tried(
    run: Run, tmp_path: Path, family: str, table: str, fix: str | dict[str, object]
) -> None:
    path = tmp_path / "refused.toml"
    path.write_text(f'family = "{family}"\n[cam]\n{table}\n', encoding="utf-8")
    found = json.loads(run("check", path, "--json")[1])["findings"]
    wrong = [one for one in found if one["severity"] == "error"]
    assert wrong
    for one in wrong:
        assert one["fix"] == fix if isinstance(fix, dict) else list(one["fix"]) == [fix]
        assert one["remedy"].startswith(("set ", "leave out "))
        assert "use " not in one["message"]


def test_warnings_of_a_command_have_remedies_that_were_tried(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "lever.toml"
    swing = "crank = 70\ncoupler = 60\nfollower = 75\nground = 110\nswing_from = -90\nswing_to = 20\n"
    path.write_text(f'family = "four-bar"\n[parameters]\n{swing}', encoding="utf-8")
    status, _, said = run("solve", path, "-o", tmp_path / "out", "--samples", "9")
    assert (status, said.count("warning [four-bar.transmission]")) == (0, 1)
    assert said.endswith("degrees; set swing_from = -86.7 (now -90), swing_to = -17.8 (now 20)\n")
