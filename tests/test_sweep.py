"""Sweeps by the command: the folder that they write and go on with, and the example."""

import errno
import json
import os
import re
import tomllib
from pathlib import Path

import pytest
from by_night import in_ci
from strokes import bytes_of, swept
from typer.testing import CliRunner

from mechwright.cli.app import make_app
from mechwright.plugins.host import host
from mechwright.studies.study import Asked, study_of

ROOT = Path(__file__).parents[1]


def test_a_sweep_that_was_stopped_goes_on_to_the_same_bytes(tmp_path):
    done = swept(tmp_path / "one", "--workers", "1", "--json")
    assert done.exit_code == 0, done.output
    said = json.loads(done.stdout)
    assert said["counts"]["designs"] == 24
    before = bytes_of(tmp_path / "one")
    assert {"front.parquet", "manifest.json", "study.html", "study.json", "summary.json"} <= set(before)
    assert sum(name.startswith("tables/") for name in before) == 3
    (tmp_path / "one" / "tables" / "part-000001.parquet").unlink()
    (tmp_path / "one" / "tables" / "part-000002.part").write_bytes(b"torn")
    (tmp_path / "one" / "summary.json").unlink()
    assert swept(tmp_path / "one", "--workers", "1").exit_code == 0
    assert bytes_of(tmp_path / "one") == before
    other = swept(tmp_path / "one", text="seed = 2")
    assert other.exit_code == 1
    assert "holds a sweep that was begun with another study;" in str(other.exception)


def test_a_full_disk_is_one_line_and_the_sweep_goes_on_from_there(tmp_path, monkeypatch):
    assert swept(tmp_path / "whole", "--workers", "1").exit_code == 0
    stored, fsync = [], os.fsync

    def full(number):
        if Path(f"/proc/self/fd/{number}").readlink().suffix == ".part":
            stored.append(number)
        if len(stored) == 2:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        fsync(number)

    monkeypatch.setattr(os, "fsync", full)
    done = swept(tmp_path / "out", "--workers", "1")
    assert done.exit_code != 0
    assert str(done.exception).endswith(
        f"part-000001.parquet: cannot be written: No space left on device; saved in {tmp_path / 'out'}: 8 of 24 "
        "designs; the same command goes on with the other 16"
    )
    assert [path.name for path in (tmp_path / "out" / "tables").iterdir()] == ["part-000000.parquet"]
    assert swept(tmp_path / "out", "--workers", "1").exit_code == 0
    assert bytes_of(tmp_path / "out") == bytes_of(tmp_path / "whole")


def test_a_study_in_which_nothing_is_allowed_says_what_forbids(tmp_path):
    constraint = "[study.constraints]\nstroke = { at_least = 1000 }"
    done = swept(tmp_path / "none", "--workers", "1", text="columns = []\n" + constraint)
    assert done.exit_code == 1
    assert "no design is allowed: [constraint.stroke] forbids 24 of 24" in done.stderr
    assert "No design is allowed" in (tmp_path / "none" / "study.html").read_text()


def test_a_folder_of_somebody_else_is_left_alone(tmp_path):
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "letter.txt").write_text("dear")
    done = swept(tmp_path / "mine")
    assert done.exit_code == 1
    assert "holds files that this program has not written" in str(done.exception)
    assert [path.name for path in (tmp_path / "mine").iterdir()] == ["letter.txt"]


def test_the_example_and_the_page_on_it_are_one_study():
    page = (ROOT / "docs" / "scale.md").read_text()
    shown = tomllib.loads(page.split("```toml\n")[1].split("```")[0])
    example = tomllib.loads((ROOT / "examples" / "four-bar-study.toml").read_text())
    for told in (shown, example):
        study_of(told, ROOT / "examples" / "four-bar-study.toml", host())
    assert {k: v for k, v in example["study"].items() if isinstance(v, dict)}.keys() == {
        k: v for k, v in shown["study"].items() if isinstance(v, dict)
    }.keys()
    named = {line.split("`")[1] for line in page.split("| key |")[1].split("\n\n")[0].splitlines()[2:]}
    assert named == set(Asked.model_fields)


@in_ci
def test_the_example_gives_designs_that_build(tmp_path):
    pytest.importorskip("pyarrow", reason="pip install 'mechwright[scale]'")
    text = (ROOT / "examples" / "four-bar-study.toml").read_text()
    few, path = {"count": 256, "refine": 1, "front": 2}, tmp_path / "few.toml"
    for key, value in few.items():
        text = re.sub(rf"^{key} = \d+$", f"{key} = {value}", text, flags=re.M)
    path.write_text(text)
    done = CliRunner().invoke(make_app(), ["sweep", str(path), "-o", str(tmp_path / "out"), "--json"])
    assert done.exit_code == 0, done.output
    said = json.loads(done.stdout)
    assert said["front"] > 10
    written = [one for one in said["chosen"] if one["name"]]
    assert len(written) == 2
    for one in written:
        assert (
            CliRunner().invoke(make_app(), ["check", str(tmp_path / "out" / f"{one['name']}.toml")]).exit_code
            == 0
        )
