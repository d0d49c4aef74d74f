"""The command line at a terminal: the first minute, completion, JSON, progress, and the keyboard that stops it."""

import io
import json
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from by_night import by_night
from hatchling.builders.wheel import WheelBuilder

from mechwright.cli import completing, demo
from mechwright.cli.perform import perform
from mechwright.cli.progress import IN_LINES, fraction, line_of
from mechwright.output import folder
from mechwright.pipeline import Wanted
from mechwright_cam.commands import cam_settings

ROOT = Path(__file__).parents[1]
EXAMPLE = ROOT / "examples" / "elliptic-pair.toml"
LEVER = ROOT / "examples" / "motion" / "four-bar-triple-rocker.toml"
Run = Callable[..., tuple[int, str, str]]


@pytest.fixture
def run(command_line: Run) -> Run:
    return command_line


# The first minute


def test_alone_it_shows_three_lines_to_try(run: Run) -> None:
    code, out, err = run()
    assert (code, err) == (0, "")
    tried = re.findall(r"^mechwright (\w+) ", out, re.M)
    assert tried == ["demo", "new", "build"]
    assert "--help" in out
    for command in tried:
        assert run(command, "--help")[0] == 0


def test_the_example_of_the_package_is_that_of_the_readme() -> None:
    shipped = ROOT / "core" / "mechwright" / "cli" / "demo.toml"
    assert shipped.read_bytes() == EXAMPLE.read_bytes()
    assert str(EXAMPLE.relative_to(ROOT)) in (ROOT / "README.md").read_text()
    packed = {Path(file.path).name for file in WheelBuilder(str(ROOT)).recurse_included_files()}
    assert shipped.name in packed


@pytest.fixture
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    """The motion alone is built, which takes a tenth of the time."""
    monkeypatch.setattr(demo, "perform", lambda path, out, *_: perform(path, out, Wanted("solve")))


@pytest.mark.usefixtures("quick")
def test_the_demo_is_built_and_says_how_to_go_on(run: Run, tmp_path: Path) -> None:
    code, out, err = run("demo", tmp_path / "try", "--no-open")
    assert (code, err) == (0, "")
    assert (tmp_path / "try" / "elliptic-pair.toml").read_bytes() == EXAMPLE.read_bytes()
    page = tmp_path / "try" / "out" / "motion.html"
    assert page.exists()
    assert f"{page}: open it in a browser" in out
    assert run("demo", tmp_path / "try", "--no-open")[0] == 0, "it may be built again"


@pytest.mark.usefixtures("quick")
def test_the_demo_opens_a_browser_only_where_there_is_a_window(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    opened: list[str] = []
    monkeypatch.setattr(demo.webbrowser, "open", lambda uri: opened.append(uri) or True)
    monkeypatch.setattr(sys, "platform", "linux")
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    monkeypatch.delenv("DISPLAY", raising=False)
    assert "open it in a browser" in run("demo", tmp_path / "try", "--open")[1]
    assert opened == []
    monkeypatch.setenv("DISPLAY", ":0")
    run("demo", tmp_path / "try")
    assert opened == [], "nobody looks at a pipe"
    assert "opened in the browser" in run("demo", tmp_path / "try", "--open")[1]
    assert opened == [(tmp_path / "try" / "out" / "motion.html").as_uri()]


def test_the_demo_leaves_a_design_alone_that_was_changed(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "elliptic-pair.toml"
    path.write_text(EXAMPLE.read_text().replace("teeth = 25", "teeth = 27"))
    code, _, err = run("demo", tmp_path, "--no-open")
    assert code == 2
    assert len(err.splitlines()) == 1
    assert "is there already and has been changed" in err
    assert "teeth = 27" in path.read_text()


@by_night
def test_the_demo_is_the_readmes_build(run: Run, tmp_path: Path) -> None:
    assert run("demo", tmp_path / "try", "--no-open")[0] == 0
    assert {"motion.html", "gear.step", "gear.nc", "proof.json"} <= {
        file.name for file in (tmp_path / "try" / "out").iterdir()
    }


# Completion


def complete(shell: str, line: str) -> str:
    """What a shell is given for the last word of a line."""
    words = line.split(" ")
    given = {
        "bash": {"COMP_WORDS": line, "COMP_CWORD": str(len(words) - 1)},
        "zsh": {"_TYPER_COMPLETE_ARGS": line},
        "fish": {"_TYPER_COMPLETE_ARGS": line, "_TYPER_COMPLETE_FISH_ACTION": "get-args"},
    }[shell]
    code = "import sys; sys.argv = ['mechwright']; from mechwright.cli import main; main()"
    done = subprocess.run(
        [sys.executable, "-c", code],
        env={**os.environ, **given, "_MECHWRIGHT_COMPLETE": f"complete_{shell}"},
        capture_output=True,
        text=True,
        check=False,
        cwd=ROOT,
    )
    assert done.stderr == ""
    return done.stdout


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_shells_complete_commands_and_design_files(shell: str) -> None:
    assert re.findall(r"sy\w+", complete(shell, "mechwright sy"))[:1] == ["synthesize"]
    files = complete(shell, "mechwright check examples/elliptic-p")
    assert set(re.findall(r"examples/[\w-]+\.toml", files)) == {
        "examples/elliptic-pair.toml",
        "examples/elliptic-pair-haas.toml",
        "examples/elliptic-pair-machine.toml",
    }


def test_a_shell_completes_what_the_line_asks_for() -> None:
    assert complete("bash", "mechwright new four-bar --requirement p").split() == ["path", "poles", "poses"]


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_shells_complete_the_keys_of_a_setting(shell: str) -> None:
    said = complete(shell, "mechwright verify a.nc --dxf a.dxf --set hold.tab_w")
    assert re.findall(r"hold\.\w+=", said)[:1] == ["hold.tab_width="]
    assert "hold.method" not in said


def test_keys_of_settings_are_those_that_count() -> None:
    offered = dict(cam_settings(""))
    assert offered["hold.tabs="].startswith("Number of tabs")
    assert not {"tools=", "nest=", "operations="} & set(offered)
    assert [key for key, _ in cam_settings("coolant=")] == ["coolant=flood", "coolant=mist", "coolant=off"]


def test_names_that_are_installed_are_offered() -> None:
    assert [name for name, _ in completing.families("g")] == ["geneva"]
    assert completing.controls("") == [
        *("fanuc", "grbl", "haas", "heidenhain-tnc", "linuxcnc", "mach3", "siemens-840d")
    ]
    assert completing.formats("stl,ste") == ["stl,step"]
    others = ("3mf", "dxf", "glb", "mjcf", "sdf", "step", "urdf")
    assert completing.formats("stl,") == [f"stl,{name}" for name in others]
    assert completing.curves("spl") == ["spline", "spline3"]


def test_files_are_offered_by_what_they_hold(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    inner = tmp_path / "designs" / "old"
    inner.mkdir(parents=True)
    (tmp_path / "a.toml").write_text('family = "geneva"\n[parameters]\n')
    (inner / "b.toml").write_text('family = "geneva"\n[requirement]\n')
    (inner / "c.toml").write_text('family = "geneva"\n')
    (tmp_path / "pyproject.toml").write_text('[project]\nname = "x"\n')
    (tmp_path / "binary.toml").write_bytes(b"\xff\xfe")
    assert completing.design_files("") == ["a.toml"]
    assert completing.design_files("de") == ["designs/old/c.toml"]
    assert completing.requirement_files("designs/") == ["designs/old/b.toml"]
    assert completing.design_files(f"{tmp_path}/a") == [f"{tmp_path}/a.toml"]
    assert completing.design_files("nowhere/") == []


def test_the_kinds_of_curves_that_are_offered_are_those_that_are_there() -> None:
    from typing import get_args

    from mechwright_cad.exporters import Curves

    assert set(completing.KINDS_OF_CURVES) == set(get_args(Curves))


# JSON


def test_what_is_written_is_told_as_json(run: Run, tmp_path: Path) -> None:
    out = tmp_path / "out"
    code, said, err = run("solve", EXAMPLE, "-o", out, "--json")
    told = json.loads(said)
    assert (code, err) == (0, "")
    assert (told["design"], told["ok"], told["folder"]) == ("elliptic-pair", True, str(out))
    assert {out / name for name in told["files"]} | {out / "manifest.json"} == set(out.iterdir())
    assert {finding["code"] for finding in told["findings"]} >= {"gear.mesh", "gear.size"}
    assert told["missing"] == told["faults"] == []


@pytest.mark.parametrize("command", ["solve", "cam"])
def test_what_is_refused_is_told_as_json(run: Run, tmp_path: Path, command: str) -> None:
    path = tmp_path / "stuck.toml"
    path.write_text('format = 1\nfamily = "four-bar"\n[parameters]\nground = 1000\n')
    code, said, err = run(command, path, "-o", tmp_path / "out", "--json")
    told = json.loads(said)
    assert (code, err) == (1, "")
    assert told["ok"] is False
    assert told["files"] == []
    assert [one["severity"] for one in told["findings"]] == ["error"] * len(told["findings"]) != []
    assert not (tmp_path / "out").exists()


def test_what_stops_nothing_is_a_finding_in_json_and_the_rest_is_written(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "undercut.toml"
    path.write_text(EXAMPLE.read_text().replace("teeth = 25", "teeth = 13"))
    code, said, _ = run("solve", path, "-o", tmp_path / "out", "--json")
    told = json.loads(said)
    assert (code, told["ok"]) == (0, True)
    assert "gear.undercut" in {one["code"] for one in told["findings"] if one["severity"] == "error"}
    assert "motion.csv" in told["files"]


def test_designs_that_are_found_are_told_as_json(run: Run, tmp_path: Path) -> None:
    asked = tmp_path / "ram.toml"
    text = 'format = 1\nfamily = "slider-crank"\n[requirement]\nkind = "stroke"\nstroke = 120\n'
    asked.write_text(text)
    code, said, _ = run("synthesize", asked, "-o", tmp_path / "out", "--json")
    told = json.loads(said)
    assert (code, told["ok"]) == (0, True)
    assert [one["design"] for one in told["candidates"]] == [
        name for name in told["files"] if name.endswith(".toml")
    ]
    asked.write_text(f"{text}time_ratio = 1.2\ncrank = 10\n")
    code, said, err = run("synthesize", asked, "-o", tmp_path / "none", "--json")
    told = json.loads(said)
    assert (code, told["ok"], told["files"], err) == (1, False, [], "")
    assert told["findings"][0]["severity"] == "error"


# Progress, and the keyboard


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_progress_shows_the_time_that_remains(monkeypatch: pytest.MonkeyPatch) -> None:
    shown = Terminal()
    monkeypatch.setattr(sys, "stderr", shown)
    monkeypatch.setenv("TERM", "xterm")
    with fraction() as progress:
        for done in range(1, 6):
            progress(done / 20, "planning")
            time.sleep(0.12)
    assert "planning" in shown.getvalue()
    left = re.findall(r"left.*?(\d:\d\d:\d\d)", shown.getvalue())
    assert left, shown.getvalue()
    assert all(time <= "0:00:09" for time in left)


def test_nothing_is_shown_in_a_pipe(run: Run, tmp_path: Path) -> None:
    assert run("solve", LEVER, "-o", tmp_path / "out")[2].count("\x1b") == 0


def test_a_stop_before_the_writing_leaves_the_folder_as_it_was(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = tmp_path / "out"
    assert run("solve", LEVER, "-o", out)[0] == 0
    before = {file.name: file.read_bytes() for file in out.iterdir()}

    def stopped(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("mechwright.scripting.performing.write_folder", stopped)
    code, said, err = run("solve", LEVER, "-o", out)
    assert (code, said, err) == (130, "", f"mechwright: stopped; {out} is as it was\n")
    assert {file.name: file.read_bytes() for file in out.iterdir()} == before


def test_a_stop_after_the_writing_says_that_all_of_it_stands(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def written(*arguments: object) -> None:
        folder.write_folder(*arguments)  # type: ignore[arg-type]
        raise KeyboardInterrupt

    monkeypatch.setattr("mechwright.scripting.performing.write_folder", written)
    out = tmp_path / "out"
    assert run("solve", LEVER, "-o", out) == (130, "", f"mechwright: stopped; {out} is written, all of it\n")
    assert (out / "motion.csv").exists()


@pytest.mark.parametrize("command", ["check", "fix"])
def test_a_stop_where_nothing_is_written_says_so(
    run: Run, monkeypatch: pytest.MonkeyPatch, command: str
) -> None:
    def stopped(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("mechwright_four_bar.family.FourBars.check", stopped)
    assert run(command, LEVER) == (130, "", "mechwright: stopped; nothing was written\n")


@pytest.mark.skipif(sys.platform == "win32", reason="a signal of POSIX")
def test_the_keyboard_stops_a_real_run_at_once(tmp_path: Path) -> None:
    code = "from mechwright.cli import main; main()"
    process = subprocess.Popen(
        [sys.executable, "-c", code, "build", str(EXAMPLE), "-o", str(tmp_path / "out")],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, IN_LINES: "1"},
        # A job in the background of a shell ignores the keyboard, and so would what it starts.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    assert line_of(process.stderr.readline()) is not None
    process.send_signal(signal.SIGINT)
    said, err = process.communicate(timeout=60)
    assert (process.returncode, said) == (130, "")
    told = [line for line in err.splitlines() if line_of(line) is None]
    assert len(told) == 1
    assert re.fullmatch(r"mechwright: stopped; .*", told[0])
    assert list(tmp_path.iterdir()) == []
