"""Files that come in pieces: the same bytes as in one, and asked for only as they are written."""

import json
from collections.abc import Iterator
from hashlib import sha256
from pathlib import Path

import numpy as np
import pytest

from mechwright.build import tables
from mechwright.contracts.motion import Channel, Motion
from mechwright.output.folder import MANIFEST, Output, write_folder


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
