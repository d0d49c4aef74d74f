"""Several designs in one command: each for itself, side by side, with a table of what became of them."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from by_night import by_night

from mechwright.cli import orders
from mechwright.cli.orders import Order, Outcome, done, into, killed
from mechwright.contracts.finding import Stage
from mechwright.contracts.synthesis import unheard
from mechwright.pipeline import Wanted
from mechwright.testing.commands import run

EXAMPLES = Path(__file__).parents[1] / "examples"
PAIR = (EXAMPLES / "elliptic-pair.toml").read_text(encoding="utf-8")


@pytest.fixture
def designs(tmp_path: Path) -> list[Path]:
    """A pair, one whose table is wrong, and one that cannot be."""
    texts = {
        "good": PAIR,
        "typo": PAIR.replace("teeth =", "tooth ="),
        "never": PAIR.replace("eccentricity = 0.4", "eccentricity = 0.85"),
    }
    for name, text in texts.items():
        (tmp_path / f"{name}.toml").write_text(text, encoding="utf-8")
    return [tmp_path / f"{name}.toml" for name in texts]


def alone(path: Path, folder: Path, command: str = "solve") -> Outcome:
    return done(Order(path, Wanted(command), folder, Stage.MOTION), unheard)


def test_folders_are_named_by_files() -> None:
    found = into([Path("a/one.toml"), Path("b/two.toml")], Path("out"))
    assert found == {Path("a/one.toml"): Path("out/one"), Path("b/two.toml"): Path("out/two")}


@pytest.mark.parametrize("other", ["b/pair.toml", "b/Pair.toml", "a/pair.toml"])
def test_two_of_one_name_are_refused_before_anything_is_built(tmp_path: Path, other: str) -> None:
    done = run("build", "a/pair.toml", other, "-o", tmp_path / "out")
    assert done.returncode == 2
    (line,) = done.stderr.splitlines()
    assert "a/pair.toml" in line
    assert other in line
    assert not (tmp_path / "out").exists()


def test_what_is_wrong_with_a_design_is_its_outcome(designs: list[Path], tmp_path: Path) -> None:
    good, typo = (alone(path, tmp_path / "out" / path.stem) for path in designs[:2])
    assert good.ok
    assert good.reason == ""
    assert "motion.csv" in good.said.files
    assert not typo.ok
    assert "tooth" in typo.reason
    assert str(designs[1]) in typo.reason
    assert "\n" not in typo.reason
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["good"]


@by_night
def test_a_check_is_refused_by_its_first_error(designs: list[Path]) -> None:
    checked = done(Order(designs[2], Wanted("check")), unheard)
    assert not checked.ok
    assert checked.reason == str(checked.said.findings[0])
    said = run("check", designs[2]).stdout.splitlines()
    # Remedies are sought for a time, and may differ.
    told = [str(finding).partition(";")[0] for finding in checked.said.findings]
    assert told == [line.partition(";")[0] for line in said[:-1]]


def test_a_design_whose_process_is_killed_says_so() -> None:
    found = killed(Order(Path("pair.toml"), Wanted()), 1.0)
    assert not found.ok
    assert "pair.toml" in found.reason
    assert "--workers" in found.reason


def test_a_fault_that_nobody_expected_is_told_in_a_line(
    designs: list[Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(*_: object, **__: object) -> None:
        raise ZeroDivisionError("by nothing")

    monkeypatch.setattr(orders.Mechanism, "write", broken)
    found = alone(designs[0], tmp_path / "out")
    assert not found.ok
    assert "ZeroDivisionError: by nothing" in found.reason


def test_tolerances_are_of_one_design(designs: list[Path]) -> None:
    done = run("check", *designs, "--tolerances")
    assert (done.returncode, done.stderr.count("\n")) == (2, 1)
    assert "--tolerances" in done.stderr


@by_night
def test_checks_side_by_side_are_those_of_each(designs: list[Path]) -> None:
    done = run("check", *designs, "--json", "--workers", 2)
    assert done.returncode == 1
    told = json.loads(done.stdout)
    assert [one["outcome"] for one in told["designs"]] == [
        "can be built",
        "cannot be built",
        "cannot be built",
    ]
    single = json.loads(run("check", designs[0], "--json").stdout)
    assert {key: told["designs"][0][key] for key in single} == single


@by_night
def test_each_is_built_as_if_alone_and_the_refused_stop_nobody(designs: list[Path], tmp_path: Path) -> None:
    out = tmp_path / "out"
    done = run("cam", *designs, "-o", out, "--workers", 2)
    assert done.returncode == 1
    assert done.stdout.splitlines()[0].split() == ["design", "outcome", "seconds", "reason"]
    assert "3 designs: 1 written, 2 refused" in done.stdout
    assert run("cam", designs[0], "-o", tmp_path / "one").returncode == 0
    for path in (tmp_path / "one").iterdir():
        assert (out / "good" / path.name).read_bytes() == path.read_bytes(), path.name
    assert sorted(path.name for path in out.iterdir()) == ["good"]


@by_night
def test_the_keyboard_leaves_nothing_half_written(designs: list[Path], tmp_path: Path) -> None:
    out, more = tmp_path / "out", tmp_path / "more.toml"
    more.write_text(PAIR.replace("teeth = 25", "teeth = 99").replace("semi_major = 50", "semi_major = 190"))
    process = subprocess.Popen(
        [sys.executable, "-m", "mechwright", "cam", designs[0], more, "-o", out, "--workers", "1"],
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    end = time.monotonic() + 120
    while not (out / "good").exists() and time.monotonic() < end:
        time.sleep(0.1)
    os.kill(process.pid, signal.SIGINT)
    _, said = process.communicate(timeout=60)
    assert process.returncode == 130
    assert said == (
        f"mechwright: stopped; all of good is written in {out}; 1 of 2 designs are as they were\n"
    )
    assert [path.name for path in out.iterdir()] == ["good"]
