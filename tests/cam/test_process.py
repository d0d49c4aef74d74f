"""The process by which each plate of a design is made."""

import tomllib
from pathlib import Path

import pytest

from mechwright.errors import DesignError
from mechwright.pipeline import Build
from mechwright.pipeline.process import ChosenProcesses, Process, plates_by, process_of
from mechwright.plugins.host import Host, Registered, host
from mechwright_cam.machining import Machining

GENEVA = Path(__file__).parents[2] / "examples" / "geneva-straight.toml"


class Saw(Process):
    """Makes discs of one thickness."""

    name = "saw"
    title = "sawing"

    def refuses(self, part, build):
        return "its slots are too narrow" if part.name == "wheel" else None


def with_saw():
    known = host().registered
    return Host({**known, Process: {**known[Process], "saw": Registered(Saw(), "here", "saw")}})


def build_of(tmp_path, head):
    file = tmp_path / "geneva.toml"
    file.write_text(head + "\n" + GENEVA.read_text(encoding="utf-8"), encoding="utf-8")
    return Build(file, with_saw())


def test_plates_are_milled_where_nothing_is_said(tmp_path):
    with build_of(tmp_path, "") as build:
        assert {process_of(build.design, part.name) for part in build.parts} == {"mill"}
        assert "process" not in tomllib.loads(build.design.text)
        assert not ChosenProcesses().findings(build)
        assert [job.part.name for job in build.made(Machining).jobs] == ["wheel", "locking-disc", "crank"]


@pytest.mark.parametrize(
    ("head", "milled"),
    [
        ('process = "saw"', []),
        ('process = { default = "saw", parts.wheel = "mill" }', ["wheel"]),
        ('process = { parts.crank = "saw" }', ["wheel", "locking-disc"]),
    ],
)
def test_the_mill_makes_what_is_left_to_it(tmp_path, head, milled):
    with build_of(tmp_path, head) as build:
        assert [part.name for part in plates_by(build.design, build.parts, "mill")] == milled
        assert [job.part.name for job in build.made(Machining).jobs] == milled
        assert [one.name for one in build.made(Machining).proven_programs] == milled
        said = tomllib.loads(head)["process"]
        written = tomllib.loads(build.design.text)["process"]
        assert written == (said if isinstance(said, str) else {"default": "mill", **said})


def test_what_a_process_refuses_is_told_with_the_line_that_helps(tmp_path):
    with build_of(tmp_path, 'process = { default = "saw", parts.crank = "mill" }') as build:
        (found,) = [one for one in ChosenProcesses().findings(build) if one.code == "process.refused"]
    assert (found.code, found.parameter) == ("process.refused", "process")
    assert found.message == "sawing does not make wheel: its slots are too narrow"
    assert "process.parts" not in found.remedy
    line = 'process = { default = "saw", parts.crank = "mill", parts.wheel = "mill" }'
    assert line in found.remedy
    with build_of(tmp_path, line) as build:
        assert not ChosenProcesses().findings(build)


def test_a_process_that_nobody_knows_is_refused(tmp_path):
    with build_of(tmp_path, 'process = "lazer"') as build:
        found = ChosenProcesses().findings(build)
    assert {one.code for one in found} == {"process.unknown"}
    assert found[0].message.startswith("no process is named 'lazer'; ")


def test_a_plate_that_is_none_is_refused(tmp_path):
    with (
        build_of(tmp_path, 'process = { parts.whel = "saw" }') as build,
        pytest.raises(
            DesignError, match=r"process\.parts\.whel: no plate has this name; did you mean 'wheel'"
        ),
    ):
        _ = build.parts
