"""Plugins that end the process which loads them, or spoil it: each is named, and the rest is used."""

import os
import shutil
import subprocess
import sys
from importlib.metadata import EntryPoint
from importlib.util import find_spec
from pathlib import Path

import pytest
from by_night import NIGHT, by_night
from ways_of_dying import FAMILY, HEALED, WAYS

from mechwright.contracts import guard
from mechwright.plugins.host import GROUP
from mechwright.plugins.trial import VERDICTS, Candidate, verdicts

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="limits, signals and forks of Linux")
GOOD = FAMILY.format(more="", first="pass").replace("rude", "good")


@pytest.fixture(autouse=True)
def nothing_is_known(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(VERDICTS, "{}")


@pytest.fixture
def candidates(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.syspath_prepend(tmp_path)

    def make(*sources: str) -> list[Candidate]:
        found = []
        for number, source in enumerate(sources):
            name = f"way_{tmp_path.name}_{number}".replace("-", "_")
            (tmp_path / f"{name}.py").write_text(source, encoding="utf-8")
            found.append(Candidate(f"dist-{number}", EntryPoint(f"p{number}", name, GROUP)))
        return found

    return make


DAILY = list(WAYS)[:: 1 if NIGHT else 8]


def test_sixty_ways_are_known() -> None:
    assert len(WAYS) >= 60


@pytest.mark.parametrize("way", DAILY)
def test_each_way_is_named_and_its_neighbours_are_used(way: str, candidates) -> None:
    source, said = WAYS[way]
    before, bad, after = candidates(GOOD, source, GOOD)
    found = verdicts([before, bad, after])
    assert found[before.key] == found[after.key] == ""
    assert said in found[bad.key]


@pytest.mark.parametrize("text", HEALED.values(), ids=HEALED)
def test_what_can_be_set_back_is_no_verdict(text: str, candidates) -> None:
    first, second = candidates(f"{text}\n{GOOD}", GOOD)
    assert verdicts([first, second]) == {first.key: "", second.key: ""}


def test_what_is_found_once_is_known_to_processes_that_are_started(candidates, monkeypatch) -> None:
    bad, good = candidates("import os; os._exit(0)", GOOD)
    first = verdicts([bad, good])
    monkeypatch.setattr(subprocess, "Popen", None)
    assert verdicts([bad, good]) == first
    monkeypatch.setenv(VERDICTS, "nonsense")
    with pytest.raises(TypeError):
        verdicts([bad, good])


def test_a_module_that_does_not_return_is_named(candidates, monkeypatch) -> None:
    monkeypatch.setattr(guard, "LOADING", 0.5)
    monkeypatch.setattr("mechwright.plugins.trial._MORE", 1.0)
    sleeping, deaf = candidates(
        "import time; time.sleep(600)",
        "import signal, time; signal.pthread_sigmask(signal.SIG_BLOCK, [14]); time.sleep(600)",
    )
    assert verdicts([sleeping])[sleeping.key] == "takes more than 0.5 s"
    assert verdicts([deaf])[deaf.key] == "takes more than 0.5 s while it is loaded"


def test_what_is_called_at_the_end_has_as_long(candidates, monkeypatch) -> None:
    monkeypatch.setattr(guard, "LOADING", 1.0)
    slow, good = candidates(f"import atexit, time; atexit.register(time.sleep, 600)\n{GOOD}", GOOD)
    assert verdicts([slow, good]) == {slow.key: "takes more than 1 s when the program ends", good.key: ""}


def test_without_a_second_process_nothing_is_said(candidates, monkeypatch) -> None:
    def none(*_: object, **__: object) -> None:
        raise OSError

    monkeypatch.setattr(subprocess, "Popen", none)
    assert verdicts(candidates(GOOD)) == {}


LIBRARIES = (
    "scipy.optimize",
    "scipy.stats",
    "shapely",
    "shapely.ops",
    "pydantic",
    "ezdxf",
    "typer",
    "rich.progress",
    "pint",
    "importlib_metadata",
)
MORE = (
    "asyncio",
    "multiprocessing",
    "concurrent.futures",
    "unittest.mock",
    "logging.config",
    "xml.dom.minidom",
)


def test_modules_that_libraries_bring_are_no_disturbance(candidates) -> None:
    at_hand = [name for name in (*LIBRARIES, *MORE) if find_spec(name.partition(".")[0])]
    assert len(at_hand) > len(MORE)
    text = "\n".join(f"import {name}" for name in at_hand)
    (one,) = candidates(f"{text}\n{GOOD}")
    assert verdicts([one]) == {one.key: ""}


def installed(folder: Path, sources: dict[str, str]) -> None:
    for name, source in sources.items():
        (folder / f"{name}.py").write_text(source, encoding="utf-8")
        info = folder / f"{name}_mechanisms-1.dist-info"
        info.mkdir()
        (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}-mechanisms\nVersion: 1\n")
        (info / "entry_points.txt").write_text(f"[mechwright]\n{name} = {name}\n")


def run(folder: Path, *words: str) -> "subprocess.CompletedProcess[str]":
    environment = {
        **os.environ,
        "PYTHONPATH": os.pathsep.join([str(folder), os.environ.get("PYTHONPATH", "")]),
    }
    environment.pop(VERDICTS, None)
    return subprocess.run(
        [sys.executable, "-m", "mechwright", *words],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
        timeout=280,
    )


@pytest.mark.parametrize("few", [pytest.param(False, marks=by_night), True])
def test_a_command_names_every_one_and_does_its_work(tmp_path: Path, few: bool) -> None:
    ways = {name: way for name, way in WAYS.items() if not few or name in {"exit 0", "json.dumps", "null"}}
    sources = {f"way{number}": source for number, (source, _) in enumerate(ways.values())}
    installed(tmp_path, {**sources, "good": GOOD})
    done = run(tmp_path, "families")
    assert done.returncode == 0, done.stderr
    for number, (_, said) in enumerate(ways.values()):
        lines = [
            one for one in done.stderr.splitlines() if f"plugin way{number} of way{number}-mechanisms" in one
        ]
        assert any(said in one for one in lines), (said, lines)
    assert "elliptic-gears" in done.stdout
    assert "good" in done.stdout


def test_a_plugin_that_ends_the_program_the_second_time_is_named(tmp_path: Path) -> None:
    source = (
        "import os, pathlib\nfile = pathlib.Path(__file__).with_name('tried')\n"
        "if file.exists(): os._exit(0)\nfile.touch()\n"
    )
    installed(tmp_path, {"rude": source + GOOD.replace("good", "rude"), "good": GOOD})
    done = run(tmp_path, "families")
    assert (tmp_path / "tried").exists()
    assert "plugin rude of rude-mechanisms is not used: SystemExit: 0" in done.stderr
    assert done.returncode == 0
    assert "good" in done.stdout


DELETED = """
import os, threading, time
class Rude:
    def __del__(self):
        os._exit(0)
class Faulty:
    def __del__(self):
        1 / 0
kept = Rude()
Faulty()
"""


def test_what_a_plugin_deletes_changes_no_exit_code(tmp_path: Path) -> None:
    """Its objects are deleted when the interpreter ends; an error there is a line, and ends nothing."""
    installed(tmp_path, {"rude": DELETED + GOOD.replace("good", "rude")})
    (tmp_path / "d.toml").write_text('family = "rude"\nx = 1\n')
    done = run(tmp_path, "check", "d.toml")
    assert done.returncode == 2
    assert "Traceback" not in done.stderr
    first, *_ = done.stderr.splitlines()
    assert first.startswith("mechwright: warning: ")
    assert "an error that ends nothing: ZeroDivisionError: division by zero (rude.py, line 8)" in first


def test_a_build_fails_with_a_code_where_its_family_ends_the_program(tmp_path: Path) -> None:
    installed(tmp_path, {"rude": "import os; os._exit(0)"})
    (tmp_path / "d.toml").write_text('family = "rude"\n')
    done = run(tmp_path, "build", "d.toml", "-o", "out")
    assert done.returncode == 2
    assert "plugin rude of rude-mechanisms is not used: ends the program with exit code 0" in done.stderr
    shutil.copy(Path(__file__).parents[2] / "examples" / "four-bar-double-rocker.toml", tmp_path)
    assert run(tmp_path, "check", "four-bar-double-rocker.toml").returncode == 0
