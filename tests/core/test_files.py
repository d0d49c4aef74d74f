"""Output folders change as a whole or not at all."""

import hashlib
import json
import os
from pathlib import Path

import pytest

from mechwright.errors import OutputError
from mechwright.output import folder as files
from mechwright.output.folder import MANIFEST, Output, check_folder, rewrite, write_folder, write_new


def run(target: Path, command: str, **contents: str) -> None:
    output = Output()
    for name, text in contents.items():
        output.add(name, text)
    write_folder(target, output, command, {"design": "d"})


def names(folder: Path) -> set[str]:
    return {entry.name for entry in folder.iterdir()}


def test_a_new_folder_is_made_with_its_parents(tmp_path: Path) -> None:
    run(tmp_path / "a" / "b", "solve", x="1")
    assert names(tmp_path / "a" / "b") == {"x", MANIFEST}
    manifest = json.loads((tmp_path / "a" / "b" / MANIFEST).read_text())
    assert manifest["design"] == "d"
    assert manifest["outputs"]["x"]["command"] == "solve"
    assert names(tmp_path / "a") == {"b"}


def test_a_symbolic_link_stays_one_and_its_folder_is_written(tmp_path: Path) -> None:
    (tmp_path / "real").mkdir()
    (tmp_path / "link").symlink_to("real")
    (tmp_path / "later").symlink_to("not-yet")
    for link, folder in (("link", "real"), ("link", "real"), ("later", "not-yet")):
        run(tmp_path / link, "solve", x="1")
        assert (tmp_path / link).is_symlink()
        assert names(tmp_path / folder) == {"x", MANIFEST}
    assert names(tmp_path) == {"real", "link", "later", "not-yet"}
    (tmp_path / "loop").symlink_to("loop")
    with pytest.raises(OutputError, match="cannot be written"):
        run(tmp_path / "loop", "solve", x="1")


def test_the_current_folder_is_not_replaced_under_the_users_feet(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "here" / "below").mkdir(parents=True)
    monkeypatch.chdir(tmp_path / "here" / "below")
    for target in (".", "..", "", tmp_path / "here"):
        with pytest.raises(OutputError, match="is the current folder or above it"):
            check_folder(Path(target))
    check_folder(Path("out"))


def test_a_folder_below_two_thousand_new_ones_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(OutputError, match=r"cannot be written: .*nothing was changed$"):
        run(Path("d/" * 1900 + "out"), "solve", x="1")
    assert names(tmp_path) == set()


def test_other_files_stay_and_stale_ones_of_the_same_command_go(tmp_path: Path) -> None:
    target = tmp_path / "out"
    run(target, "solve", motion="1")
    run(target, "cam", gear="1", old="1")
    (target / "mine.txt").write_text("keep")
    (target / "folder").mkdir()
    (target / "folder" / "deep.txt").write_text("keep")
    run(target, "cam", gear="2")
    assert names(target) == {"motion", "gear", "mine.txt", "folder", MANIFEST}
    assert (target / "gear").read_text() == "2"
    assert (target / "folder" / "deep.txt").read_text() == "keep"
    assert set(json.loads((target / MANIFEST).read_text())["outputs"]) == {"motion", "gear"}
    assert names(tmp_path) == {"out"}


def test_the_same_run_gives_the_same_bytes(tmp_path: Path) -> None:
    run(tmp_path / "a", "build", x="1", y="2")
    run(tmp_path / "b", "build", y="2", x="1")
    for name in names(tmp_path / "a"):
        assert (tmp_path / "a" / name).read_bytes() == (tmp_path / "b" / name).read_bytes()


def test_a_folder_of_somebody_else_is_refused_untouched(tmp_path: Path) -> None:
    (tmp_path / "thesis.tex").write_text("years")
    with pytest.raises(OutputError, match="has not written; give a new or an empty folder"):
        run(tmp_path, "build", x="1")
    assert names(tmp_path) == {"thesis.tex"}


def test_a_file_in_the_way_is_refused(tmp_path: Path) -> None:
    (tmp_path / "out").write_text("a file")
    with pytest.raises(OutputError, match="is no folder"):
        run(tmp_path / "out", "build", x="1")
    with pytest.raises(OutputError, match=r"cannot be written: .*; nothing was changed"):
        run(tmp_path / "out" / "below", "build", x="1")
    assert (tmp_path / "out").read_text() == "a file"


@pytest.mark.parametrize("name", ["../x", "a/b", "", "..", "/etc/x"])
def test_no_file_leaves_the_folder(name: str) -> None:
    with pytest.raises(OutputError, match="no plain file name"):
        Output().add(name, "x")


def test_an_interrupted_run_leaves_the_old_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    target = tmp_path / "out"
    run(target, "build", x="old", y="old")

    def interrupt(staging: Path, target: Path) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(files, "_swap", interrupt)
    with pytest.raises(KeyboardInterrupt):
        run(target, "build", x="new", y="new")
    assert (target / "x").read_text() == (target / "y").read_text() == "old"
    assert names(tmp_path) == {"out"}


def test_without_an_atomic_exchange_two_renames_do_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(files, "exchange", lambda one, two: False)
    target = tmp_path / "out"
    run(target, "build", x="old")
    run(target, "build", x="new")
    assert (target / "x").read_text() == "new"
    assert names(tmp_path) == {"out"}


def test_a_second_rename_that_fails_is_undone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(files, "exchange", lambda one, two: False)
    target = tmp_path / "out"
    run(target, "build", x="old")
    rename, calls = os.replace, []

    def fail_second(one: Path, to: Path) -> None:
        calls.append(to)
        if len(calls) == 2:
            raise OSError(28, "No space left on device")
        rename(one, to)

    monkeypatch.setattr(os, "replace", fail_second)
    with pytest.raises(OutputError, match="No space left"):
        run(target, "build", x="new")
    assert (target / "x").read_text() == "old"
    assert names(tmp_path) == {"out"}


def test_a_new_file_does_not_replace_one(tmp_path: Path) -> None:
    path = tmp_path / "d.toml"
    write_new(path, "1")
    with pytest.raises(OutputError, match="is there already"):
        write_new(path, "2")
    assert path.read_text() == "1"
    write_new(path, "2", replace=True)
    assert path.read_text() == "2"
    with pytest.raises(OutputError, match="cannot be written"):
        write_new(tmp_path / "none" / "d.toml", "1")
    assert names(tmp_path) == {"d.toml"}
    assert not os.path.lexists(tmp_path / "none")


def test_a_byte_order_mark_stays_where_a_file_is_rewritten(tmp_path: Path) -> None:
    path = tmp_path / "design.toml"
    for old in (b"\xef\xbb\xbfa = 1\n", b"a = 1\n"):
        path.write_bytes(old)
        rewrite(path, "a = 2\n", known=hashlib.sha256(old).hexdigest())
        assert path.read_bytes() == old.replace(b"1", b"2")
