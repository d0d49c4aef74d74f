"""Faults that nobody expected: plugins that break while they work, a full disk, strange characters."""

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from procedural import Procedural

import mechwright.plugins.host as hosting
from mechwright.cli import failure
from mechwright.contracts.family import Family
from mechwright.contracts.motion import Channel, Motion
from mechwright.contracts.parameters import Parameters
from mechwright.contracts.part import Part
from mechwright.errors import DesignError
from mechwright.geometry import Line, Loop, Outline
from mechwright.plugins.host import Registered

EXAMPLE = Path(__file__).parents[1] / "examples" / "elliptic-pair.toml"
Run = Callable[..., tuple[int, str, str]]


class Odd(Procedural[Parameters]):
    name = "odd"
    title = "Odd"
    summary = "Does what its two class attributes say."
    Params = Parameters
    fault: Exception | None = None
    names: tuple[str, ...] = ("plate",)

    def found(self, params: Parameters) -> list[Any]:
        if self.fault is not None:
            raise self.fault
        return []

    def solve(self, params: Parameters, samples: int) -> Motion:
        return Motion("t", {"t": Channel(np.linspace(0.0, 1.0, samples), "s")})

    def parts(self, params: Parameters) -> list[Part]:
        corners = [(0.0, 0.0), (40.0, 0.0), (40.0, 30.0), (0.0, 30.0), (0.0, 0.0)]
        outline = Outline(Loop(tuple(Line(a, b, "side") for a, b in pairwise(corners))))
        return [Part(name, outline, 5.0, "aluminium") for name in self.names]


@pytest.fixture
def odd(monkeypatch: pytest.MonkeyPatch) -> type[Odd]:
    # In the host itself: what is imported meanwhile would keep another one.
    families = hosting.host().registered[Family]
    monkeypatch.setitem(families, "odd", Registered(Odd(), "odd-mechanisms", "odd"))
    return Odd


@pytest.fixture
def run(command_line: Run, tmp_path: Path) -> Run:
    design = tmp_path / "odd.toml"
    design.write_text('family = "odd"\n')
    return lambda command, *arguments: command_line(command, design, *arguments)


def test_a_plugin_that_breaks_while_it_works_is_named_in_one_line(
    run: Run, odd: type[Odd], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(odd, "fault", ZeroDivisionError("no\nsuch \x1b[31mlength"))
    code, out, err = run("check")
    assert (code, out) == (2, "")
    assert err.startswith(
        f"mechwright: {tmp_path / 'odd.toml'}: plugin odd of odd-mechanisms: family odd: check(): "
        "ZeroDivisionError: no such \\x1b[31m"
    )
    assert "test_cli_failures.py, line" in err
    assert len(err.splitlines()) == 1
    monkeypatch.setenv(failure.TRACEBACK, "1")
    assert "Traceback (most recent call last)" in run("check")[2]


def test_a_fault_outside_of_plugins_is_the_programs_own(odd: type[Odd]) -> None:
    assert failure.lines(KeyError("x"))[0].startswith("this program failed: KeyError: 'x' (unknown place)")
    assert failure.lines(MemoryError()) == ["there is not enough memory for this; nothing was written"]
    assert failure.lines(DesignError("a\nb\x07")) == ["a", "b\\x07"]


def test_a_family_without_instances_has_no_assembly(run: Run, odd: type[Odd], tmp_path: Path) -> None:
    code, _, err = run("model", "-o", tmp_path / "out")
    assert (code, err) == (0, "")
    assert {path.name for path in (tmp_path / "out").iterdir()} == {
        "plate.step",
        "plate-drawing.dxf",
        "plate-drawing.pdf",
        "bill-of-materials.csv",
        "bill-of-materials.html",
        "manifest.json",
    }


def test_two_parts_of_one_name_are_refused(
    run: Run, odd: type[Odd], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(odd, "names", ("plate", "plate"))
    code, _, err = run("model", "-o", tmp_path / "out")
    assert code == 2
    assert "plugin odd of odd-mechanisms: family odd: parts(): two parts are called 'plate'" in err
    assert not (tmp_path / "out").exists()


def test_a_format_that_is_written_anyway_may_be_asked_for(run: Run, odd: type[Odd], tmp_path: Path) -> None:
    code, _, err = run("build", "-o", tmp_path / "out", "--also", "dxf,step,stl,stl")
    assert (code, err) == (0, "")
    assert (tmp_path / "out" / "plate.stl").exists()
    code, _, err = run("build", "-o", tmp_path / "out", "--also", "igs")
    assert code == 2
    assert err.startswith("mechwright: --also: exporter 'igs' is not installed; known: 3mf, dxf")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="the system has no /dev/full")
@pytest.mark.parametrize("unbuffered", ["", "1"])
def test_a_full_disk_is_one_line(unbuffered: str) -> None:
    with Path("/dev/full").open("w") as full:
        done = subprocess.run(
            [sys.executable, "-m", "mechwright", "families"],
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            env={**os.environ, "PYTHONUNBUFFERED": unbuffered},
        )
    assert (done.returncode, done.stderr) == (2, "mechwright: output: No space left on device\n")


def test_a_reader_that_leaves_is_no_fault() -> None:
    command = f"{sys.executable} -m mechwright new elliptic-gears | head -1; echo ${{PIPESTATUS[0]}}"
    done = subprocess.run(["bash", "-c", command], capture_output=True, text=True)
    assert done.stderr == ""
    assert done.stdout.splitlines()[0] == "#:schema ./elliptic-gears.schema.json"


def test_a_design_without_plates_has_nothing_to_mill(
    run: Run, odd: type[Odd], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(odd, "names", ())
    code, _, err = run("cam", "-o", tmp_path / "out")
    assert code == 2
    assert "makes no plate part" in err
    assert not (tmp_path / "out").exists()


@pytest.mark.skipif(sys.platform != "linux", reason="names of any bytes")
@pytest.mark.parametrize("command", ["check", "build", "fix", "sweep", "synthesize"])
@pytest.mark.parametrize("place", [b"p\xffir.toml", b"d\xff/pair.toml"])
def test_a_path_that_is_no_text_is_refused_before_any_work(
    command: str, place: bytes, tmp_path: Path, command_line: Run
) -> None:
    if command == "sweep":
        pytest.importorskip("pyarrow")
    path = tmp_path / os.fsdecode(place)
    path.parent.mkdir(exist_ok=True)
    shutil.copy(EXAMPLE, path)
    more = [] if command in {"check", "fix"} else ["-o", tmp_path / "out"]
    code, _, err = command_line(command, path, *more)
    assert code == 2
    assert "its path is no text in UTF-8" in err
    assert not (tmp_path / "out").exists()


@pytest.mark.skipif(sys.platform != "linux", reason="names of any bytes")
def test_an_output_that_is_no_text_is_refused(tmp_path: Path, command_line: Run) -> None:
    code, _, err = command_line("new", "four-bar", "-o", tmp_path / os.fsdecode(b"n\xff.toml"))
    assert (code, "the name is no text in UTF-8; give another name" in err) == (2, True)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("said", ["x", "", "-1", "1.5", "9" * 20, "\u0665"])
def test_a_date_that_libraries_cannot_read_blames_the_environment(
    said: str, command_line: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SOURCE_DATE_EPOCH", said)
    code, _, err = command_line("check", EXAMPLE)
    assert (code, err.startswith("mechwright: SOURCE_DATE_EPOCH: ")) == (2, True)
