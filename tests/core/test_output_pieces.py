"""Files that come in pieces: the same bytes as in one, and asked for only as they are written."""

import json
from collections.abc import Iterator
from hashlib import sha256
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mechwright import load
from mechwright.contracts import stretch
from mechwright.contracts.motion import Channel, Motion
from mechwright.errors import DesignError
from mechwright.output.folder import MANIFEST, Output, write_folder
from mechwright.pipeline import tables


def test_pieces_are_written_one_after_the_other(tmp_path: Path) -> None:
    asked: list[int] = []

    def pieces() -> Iterator[bytes]:
        for number in range(3):
            asked.append(number)
            yield f"{number}\n".encode()

    output = Output()
    output.add("table.csv", pieces())
    assert asked == []
    write_folder(tmp_path / "out", output, "solve", {})
    assert (tmp_path / "out" / "table.csv").read_text() == "0\n1\n2\n"
    entry = json.loads((tmp_path / "out" / MANIFEST).read_text())["outputs"]["table.csv"]
    assert entry["sha256"] == sha256(b"0\n1\n2\n").hexdigest()


def test_a_table_has_the_same_text_however_many_rows_are_written_together(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    angle = np.linspace(0.0, 1.0, 23)
    motion = Motion("t", {"t": Channel(angle, "rad"), "x": Channel(angle**3, "")})
    whole = b"".join(tables.motion_csv(motion))
    monkeypatch.setattr(tables, "ROWS", 5)
    pieces = list(tables.motion_csv(motion))
    assert len(pieces) == 6
    assert b"".join(pieces) == whole
    assert whole.splitlines()[0] == b"t [rad],x"
    assert len(whole.splitlines()) == 24


def test_what_fails_while_it_is_written_leaves_nothing(tmp_path: Path) -> None:
    def broken() -> Iterator[bytes]:
        yield b"half"
        raise ZeroDivisionError

    output = Output()
    output.add("table.csv", broken())
    with pytest.raises(ZeroDivisionError):
        write_folder(tmp_path / "out", output, "solve", {})
    assert list(tmp_path.iterdir()) == []


def test_a_long_motion_is_written_in_stretches(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Every row once and in order, with the figures of the whole, and no motion of all samples."""
    (tmp_path / "bar.toml").write_text('format = 1\nfamily = "four-bar"\n')
    whole = load(tmp_path / "bar.toml").design.solve(721)
    build = load(tmp_path / "bar.toml").asked(command="solve", samples=721)
    monkeypatch.setattr(stretch, "TOGETHER", 100)
    files = tables.MotionTables().files(build)
    assert "motion" not in vars(build)
    rows = np.loadtxt(b"".join(files["motion.csv"]).decode().splitlines(), delimiter=",", skiprows=1)
    for column, values in zip(rows.T, whole.arrays.values(), strict=True):
        np.testing.assert_allclose(column, values, rtol=1e-9, atol=1e-10 * np.abs(values).max())
    figures = {name: one["value"] for name, one in json.loads(files["summary.json"]).items()}
    wanted = {name: scalar.value for name, scalar in whole.scalars.items()}
    assert figures == pytest.approx(wanted, rel=1e-9)


def test_the_lead_of_a_stretch_begins_at_the_start_and_stays_before_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(stretch, "LEAD", 4)
    assert stretch.Stretch(100, 0, 10).lead.size == 0
    assert stretch.Stretch(100, 3, 5).places.tolist() == [0, 1, 2, 3, 4]
    assert stretch.Stretch(100, 40, 42).places.tolist() == [0, 10, 20, 30, 40, 41]


@given(st.floats(-50, 50), st.floats(-10, 10), st.integers(2, 300), st.data())
def test_inputs_of_a_stretch_are_those_of_the_whole_to_the_last_bit(travel, start, count, data) -> None:
    first = data.draw(st.integers(0, count - 1))
    some = stretch.Stretch(count, first, data.draw(st.integers(first + 1, count)))
    whole = np.linspace(start, start + travel, count)
    assert stretch.travelled(travel, some, start).tolist() == whole[some.places].tolist()
    assert stretch.travelled(travel, count, start).tolist() == whole.tolist()


def test_too_few_samples_are_refused() -> None:
    with pytest.raises(DesignError, match="samples: 1 are too few for a motion; take at least 2"):
        stretch.travelled(1.0, 1)
