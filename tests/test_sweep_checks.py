"""The checks of a sweep's front: side by side, each saved as soon as it is there, and the same whoever does them."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from strokes import bytes_of

from mechwright.contracts.finding import Finding
from mechwright.errors import MechwrightError, PluginError
from mechwright.plugins.host import host
from mechwright.scripting.mechanism import Mechanism
from mechwright.studies import checks
from mechwright.studies.run import evaluate
from mechwright.studies.standing import Standing
from mechwright.studies.study import load_study
from mechwright.studies.workers import Alone

pytest.importorskip("pyarrow", reason="pip install 'mechwright[scale]'")

TEXT = """
family = "slider-crank"
name = "front"
[study]
count = 64
front = 4
[study.ranges]
crank = { least = 20, greatest = 40 }
rod = { least = 90, greatest = 160 }
[study.objectives]
stroke = "greatest"
least_transmission_angle = "greatest"
"""


@pytest.fixture
def study(tmp_path):
    path = tmp_path / "front.toml"
    path.write_text(TEXT)
    return load_study(path, host())


class Check:
    """A check that refuses some designs, and may fail or be stopped at one of them."""

    def __init__(self, refused=(), stop=None):
        self.refused, self.stop, self.asked = refused, stop, []

    def __call__(self, mechanism, progress=None):
        if len(self.asked) == self.stop:
            raise KeyboardInterrupt
        self.asked.append(round(mechanism.design.params.crank, 6))
        wrong = len(self.asked) - 1 in self.refused
        return [Finding.error("test.refused", "crank", "is refused")] if wrong else []


def swept(study, folder, check, monkeypatch, standing=None):
    monkeypatch.setattr(Mechanism, "check", lambda mechanism, progress=None, **_: check(mechanism, progress))
    return evaluate(study, folder, Alone(), host(), standing=standing)


def test_a_check_that_was_done_is_not_done_again(study, tmp_path, monkeypatch):
    whole = Check(refused={0, 2})
    found = swept(study, tmp_path / "whole", whole, monkeypatch)
    assert [bool(one.refused) for one in found.chosen] == [True, False, True, False, False, False]
    assert [one.name for one in found.chosen if one.name] == [f"front-{n}" for n in (1, 2, 3, 4)]
    first, standing = Check(refused={0, 2}, stop=3), Standing(study)
    with pytest.raises(KeyboardInterrupt):
        swept(study, tmp_path / "out", first, monkeypatch, standing)
    said = f"saved in {tmp_path / 'out'}: all of 64 designs, and 3 checks for the front; the same command goes on"
    assert standing.sentence() == f"{said} from there"
    second = Check()
    swept(study, tmp_path / "out", second, monkeypatch)
    assert first.asked + second.asked == whole.asked
    assert bytes_of(tmp_path / "out") == bytes_of(tmp_path / "whole")


def test_a_check_of_another_design_or_setting_is_done_again(study, tmp_path, monkeypatch):
    with pytest.raises(KeyboardInterrupt):
        swept(study, tmp_path / "out", Check(refused={0, 1}, stop=2), monkeypatch)
    study.path.write_text(TEXT + "[cam]\nclearance = 8\n")
    again = Check()
    found = swept(load_study(study.path, host()), tmp_path / "out", again, monkeypatch)
    assert len(again.asked) == 4
    assert not any(one.refused for one in found.chosen)


@pytest.mark.parametrize("content", ["", "[]", "[" * 9000, '{"of": 1}'])
def test_what_is_no_check_is_done_again(study, tmp_path, monkeypatch, content):
    with pytest.raises(KeyboardInterrupt):
        swept(study, tmp_path / "out", Check(refused={0}, stop=2), monkeypatch)
    for path in (tmp_path / "out" / "checks").iterdir():
        path.write_text(content)
    again = Check()
    swept(study, tmp_path / "out", again, monkeypatch)
    assert len(again.asked) == 4


def test_processes_say_what_one_says(study, tmp_path):
    values = [{"crank": 25.0, "rod": 120.0}, {"crank": 25.0, "rod": 30.0}]
    some = [checks.Candidate(json.dumps(study.file), study.path, one, "front-1") for one in values]
    one = dict(checks._checks(some, [3, 7], 1, study, host()))
    assert one[3] == ""
    assert one[7].startswith("[")
    assert dict(checks._checks(some, [3, 7], 2, study, host())) == one


def test_a_process_that_is_killed_or_fails_is_a_line(study, monkeypatch):
    some = [checks.Candidate("", study.path, {}, "")] * 2

    def gives(said):
        def side_by_side(*_):
            if isinstance(said, Exception):
                raise said
            yield 1, said

        monkeypatch.setattr(checks, "side_by_side", side_by_side)
        return list(checks._checks(some, [0, 1], 2, study, host()))

    with pytest.raises(PluginError, match="was killed, mostly for want of memory"):
        gives(None)
    with pytest.raises(MechwrightError, match="bad plugin"):
        gives(MechwrightError("bad plugin"))


@pytest.mark.skipif(os.name == "nt", reason="signals of Unix")
def test_a_sweep_that_is_stopped_while_it_checks_says_so_and_goes_on(study, tmp_path):
    words = [sys.executable, "-m", "mechwright", "sweep", "front.toml", "-o", "out", "--workers", "2"]
    running = subprocess.Popen(
        words,
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )
    kept, end = tmp_path / "out" / "checks", time.monotonic() + 120
    while not list(kept.glob("*.json")) and running.poll() is None and time.monotonic() < end:
        time.sleep(0.02)
    running.send_signal(signal.SIGTERM)
    _, said = running.communicate(timeout=60)
    assert running.returncode == 128 + signal.SIGTERM
    last = said.splitlines()[-1]
    count = len(list(kept.glob("*.json")))
    assert count
    assert last == (
        f"mechwright: stopped; saved in out: all of 64 designs, and {count} checks for the front; the same "
        "command goes on from there"
    )
    done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, check=True, timeout=120)
    assert "front-4.toml: " in done.stdout
    assert {path.name for path in Path(tmp_path / "out").iterdir() if path.is_dir()} == {"tables"}
