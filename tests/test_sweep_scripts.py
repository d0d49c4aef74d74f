"""Sweeps by a script: what the command finds, from a file, a mapping or a mechanism."""

import json
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path
from typing import Any

import pytest
from strokes import TEXT, bytes_of, swept

import mechwright as mw
from mechwright import extras
from mechwright.errors import DesignError, PluginError

CONTENT = tomllib.loads(TEXT.format(more=""))
RANGES = CONTENT["study"]["ranges"]

pytest.importorskip("pyarrow", reason="pip install 'mechwright[scale]'")


@pytest.fixture(autouse=True)
def alone(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """No cluster, and temporary folders that can be listed."""
    monkeypatch.delenv("DASK_SCHEDULER_ADDRESS", raising=False)
    (tmp_path / "temporary").mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "temporary"))


def test_a_script_writes_the_folder_of_the_command(tmp_path: Path) -> None:
    constraint = "[study.constraints]\nleast_transmission_angle = { at_least = 70 }"
    done = swept(tmp_path / "command", "--workers", "1", "--json", text=f"keep = 'all'\n{constraint}")
    said = json.loads(done.stdout)
    found = mw.sweep(tmp_path / "strokes.toml", tmp_path / "script", workers=1)
    assert bytes_of(tmp_path / "script") == bytes_of(tmp_path / "command")
    assert found.folder == tmp_path / "script"
    assert (found.counts.designs, found.counts.feasible) == (24, said["counts"]["feasible"])
    assert found.counts.forbidden == said["counts"]["forbidden"]
    assert found.front.num_rows == said["front"] > 0
    names = ["design", "crank", "rod", "least_transmission_angle", "stroke"]
    assert found.table.column_names == [*names, "forbidden"]
    assert found.table.schema.field("rod").metadata == {b"unit": b"mm"}
    refused = [one for one in found.table["forbidden"].to_pylist() if one]
    assert len(refused) == found.counts.forbidden["constraint.least_transmission_angle"] > 0
    assert sum(found.rates.values()) == pytest.approx(1)
    assert next(iter(found.rates)) == "allowed"
    assert found.rates["allowed"] == found.counts.feasible / 24


def test_a_file_a_mapping_and_a_mechanism_give_the_same_designs(tmp_path: Path) -> None:
    path = tmp_path / "strokes.toml"
    path.write_text(TEXT.format(more=""))
    study = {key: value for key, value in CONTENT["study"].items() if key != "ranges"}
    mechanism = mw.design("slider-crank", name="strokes")
    one, *others = (
        mw.sweep(path, workers=1),
        mw.sweep(CONTENT, workers=1),
        mw.sweep(mechanism, workers=1, ranges=RANGES, **study),
    )
    assert one.table.num_rows == 24
    for other in others:
        assert other.table.equals(one.table)
        assert other.front.equals(one.front)
        assert repr(other) == repr(one)
    assert [one.folder, *(Path(tempfile.gettempdir()).iterdir())] == [None]


def test_keys_replace_those_of_the_file_and_progress_goes_up_to_the_whole(tmp_path: Path) -> None:
    steps: list[float] = []
    found = mw.sweep(CONTENT, count=10, workers=1, progress=lambda done, _: steps.append(done))
    assert found.table.num_rows == 10
    assert steps == sorted(steps)
    assert steps[-1] >= 0.9
    pandas = pytest.importorskip("pandas")
    frame = found.to_pandas()
    assert isinstance(frame, pandas.DataFrame)
    assert frame["rod"].between(60, 160).all()
    assert not found.mechanisms
    assert "<td>" not in found._repr_html_()


def test_designs_of_the_front_are_mechanisms_that_build(tmp_path: Path) -> None:
    found = mw.sweep(CONTENT, stage="parts", count=8, front=1, workers=1)
    (best,) = found.mechanisms
    assert best.design.name == "strokes-1"
    row = next(row for row in found.front.to_pylist() if row["rod"] == best.design.params.rod)
    assert best.design.params.crank == row["crank"]
    assert row["stroke"] == max(found.table["stroke"].to_pylist())
    assert not best.check().errors
    assert "strokes-1" in found._repr_html_()


def test_a_study_without_objectives_has_no_front() -> None:
    study = {key: value for key, value in CONTENT["study"].items() if key != "objectives"}
    found = mw.sweep({**CONTENT, "study": {**study, "columns": ["stroke"]}}, workers=1)
    assert found.front.num_rows == 0
    assert found.front.column_names == found.table.column_names


@pytest.mark.parametrize(
    ("study", "keys", "said"),
    [
        (CONTENT, {"rangs": {"rod": 1}}, "strokes.toml: study: unknown key 'rangs'; did you mean 'ranges'?"),
        ({"family": "slider-crank"}, {}, "study.toml: has no table [study]"),
        (CONTENT, {"workers": 2, "scheduler": "tcp://a:1"}, "take one"),
    ],
)
def test_what_is_wrong_is_one_line(study: dict[str, Any], keys: dict[str, Any], said: str) -> None:
    with pytest.raises(DesignError) as error:
        mw.sweep(study, **keys)
    assert said in str(error.value)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("library", "by", "extra"), [("pyarrow", "sweep", "scale"), ("pandas", "to_pandas", "data")]
)
def test_a_missing_library_is_named_with_its_extra(
    monkeypatch: pytest.MonkeyPatch, library: str, by: str, extra: str
) -> None:
    there = extras._installed
    monkeypatch.setattr(extras, "_installed", lambda one: one != library and there(one))
    with pytest.raises(
        PluginError, match=f"{by}: {library} is not installed, which the extra {extra} brings"
    ):
        mw.sweep(CONTENT, workers=1).to_pandas()


def test_a_script_without_a_guard_is_run_once(tmp_path: Path) -> None:
    """Workers import no script, which would begin the sweep again in each of them."""
    script = tmp_path / "script.py"
    text = f"import mechwright as mw\nprint(mw.sweep({CONTENT!r}, workers=2).table.num_rows)\n"
    script.write_text(text)
    done = subprocess.run([sys.executable, script], capture_output=True, text=True, check=False)
    assert (done.stdout, done.stderr) == ("24\n", "")
