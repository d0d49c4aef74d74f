"""A disk that is full, of its own or gone, streams that are closed, files that are written while they are read."""

import errno
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from writing_faults import built

from mechwright import reading
from mechwright.errors import DesignError, OutputError
from mechwright.output.folder import Output, check_folder, write_folder, write_new

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="disks and streams of POSIX")
KB = 1024


@pytest.fixture
def disk(tmp_path: Path) -> Iterator[Callable[[str], Path]]:
    """A disk of a size of its own, where one may be mounted."""
    place = tmp_path / "disk"
    place.mkdir()

    def mounted(options: str) -> Path:
        call = ["mount", "-t", "tmpfs", "-o", options, "none", str(place)]
        if sys.platform != "linux" or subprocess.run(call, capture_output=True, check=False).returncode:
            pytest.skip("only who may mount a disk")
        return place

    yield mounted
    subprocess.run(["umount", "-l", str(place)], capture_output=True, check=False)


def wrote(target: Path, size: int, name: str = "a") -> None:
    write_folder(target, Output({name: b"x" * size, "b": [b"y" * size]}), "build", {})


def stands(place: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in place.rglob("*") if path.is_file()}


@pytest.mark.parametrize("size", [5, 13, 25, 29, 60])
def test_a_small_disk_that_is_full_keeps_what_it_has(disk: Callable[[str], Path], size: int) -> None:
    """The room ends not at all, at the manifest, within the second file, or at the first."""
    place = disk("size=64k")
    wrote(place / "out", 4 * KB)
    before = stands(place)
    if size < 20:
        wrote(place / "out", size * KB)
        assert len(stands(place)["a"]) == size * KB
    else:
        said = rf"^{place}/out: cannot be written: No space left on device; nothing was changed$"
        with pytest.raises(OutputError, match=said):
            wrote(place / "out", size * KB)
        assert stands(place) == before
    assert [path.name for path in place.iterdir()] == ["out"]


def test_a_disk_without_room_for_names_keeps_what_it_has(disk: Callable[[str], Path]) -> None:
    place = disk("size=1m,nr_inodes=6")
    wrote(place / "out", KB)
    before = (place / "out" / "a").stat()
    with pytest.raises(OutputError, match="No space left on device; nothing was changed"):
        wrote(place / "out", 2 * KB, "c")
    assert (place / "out" / "a").stat() == before
    assert [path.name for path in place.iterdir()] == ["out"]


def test_a_folder_that_is_a_disk_is_refused_before_any_work(disk: Callable[[str], Path]) -> None:
    """It cannot be exchanged with another in one step."""
    place = disk("size=1m")
    with pytest.raises(
        OutputError, match=r"disk: is a disk of its own, .*; give a folder in it, such as -o "
    ):
        check_folder(place)
    wrote(place / "out", KB)
    assert [path.name for path in place.iterdir()] == ["out"]


def test_a_quota_is_told_as_such(tmp_path: Path) -> None:
    shim = built(tmp_path)
    if shim is None:
        pytest.skip("no compiler")
    shim.write("old")
    before = shim.state()
    found = shim.write("new", at=2, call="write", errno=errno.EDQUOT)
    assert found.returncode == 1
    assert "out: cannot be written: Disk quota exceeded; nothing was changed" in found.stderr
    assert shim.state() == before


def test_a_current_folder_that_is_gone_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    gone = tmp_path / "gone"
    gone.mkdir()
    monkeypatch.chdir(gone)
    gone.rmdir()
    with pytest.raises(
        OutputError, match=r"^out: cannot be written: the current folder is gone; nothing was "
    ):
        check_folder(Path("out"))
    wrote(tmp_path / "out", KB)
    assert (tmp_path / "out" / "a").stat().st_size == KB


def run(folder: Path, *words: str, closed: tuple[int, ...] = (), full: int = 0) -> tuple[int, str, str]:
    """A command with some of the three streams closed, or one that leads to a full disk."""

    def prepared() -> None:
        for number in closed:
            os.close(number)
        if full:
            os.dup2(os.open("/dev/full", os.O_WRONLY), full)

    found = subprocess.run(
        [sys.executable, "-m", "mechwright", *words],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
        preexec_fn=prepared,
    )
    return found.returncode, found.stdout, found.stderr


@pytest.mark.parametrize("closed", [(0, 1, 2), (2,)])
def test_closed_streams_are_no_fault(tmp_path: Path, closed: tuple[int, ...]) -> None:
    code, _, err = run(tmp_path, "schema", "four-bar", "-o", "s.json", closed=closed)
    assert code == 0, err
    assert err == ""
    assert (tmp_path / "s.json").read_text().endswith("}\n")
    assert run(tmp_path, "check", "nowhere.toml", closed=closed)[0] == 2


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no device that is full")
def test_a_full_standard_error_leaves_the_exit_code(tmp_path: Path) -> None:
    assert run(tmp_path, "check", "nowhere.toml", full=2) == (2, "", "")
    assert run(tmp_path, "families", full=1) == (2, "", "mechwright: output: No space left on device\n")


def meanwhile(monkeypatch: pytest.MonkeyPatch, act: Callable[[int], object]) -> None:
    """Do something after each piece that is read, of which the number is told."""
    read, count = os.read, iter(range(10_000))

    def reading_and(handle: int, size: int) -> bytes:
        piece = read(handle, size)
        act(next(count))
        return piece

    monkeypatch.setattr(reading.os, "read", reading_and)
    monkeypatch.setattr(reading, "_WAITS", (0.0, 0.0, 0.0))


def appended(path: Path) -> None:
    with path.open("ab") as file:
        file.write(b"more")


def test_a_file_that_grows_while_it_is_read_is_read_when_it_is_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "a"
    path.write_bytes(b"begin")
    meanwhile(monkeypatch, lambda number: number == 0 and appended(path))
    assert reading.read_bytes(path) == b"beginmore"


def test_a_file_that_never_ends_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "a"
    path.write_bytes(b"begin")
    meanwhile(monkeypatch, lambda _: appended(path))
    with pytest.raises(DesignError, match="is larger than 100 bytes"):
        reading.read_bytes(path, 100)


@pytest.mark.parametrize("change", [lambda path: path.write_bytes(b"n"), lambda path: os.truncate(path, 2)])
def test_a_file_that_is_written_again_and_again_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, change: Callable[[Path], object]
) -> None:
    path = tmp_path / "a"

    def written(number: int) -> None:
        change(path)
        os.utime(path, ns=(0, number))

    path.write_bytes(b"begin")
    meanwhile(monkeypatch, written)
    with pytest.raises(
        OutputError, match="a: cannot be read: it changes meanwhile; try again when it is writ"
    ):
        reading.read_bytes(path)


@pytest.mark.parametrize(
    ("becomes", "said"),
    [
        (lambda path: path.mkdir(), "it is a folder"),
        (os.mkfifo, "it is a pipe"),
        (None, "No such file or dir"),
    ],
)
def test_a_file_that_becomes_another_before_it_is_opened(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, becomes: Callable[[Path], object] | None, said: str
) -> None:
    path, opened = tmp_path / "a", os.open
    path.write_bytes(b"begin")

    def replaced(name: Path, flags: int) -> int:
        path.unlink()
        if becomes is not None:
            becomes(path)
        return opened(name, flags)

    monkeypatch.setattr(reading.os, "open", replaced)
    with pytest.raises(OutputError, match=f"a: cannot be read: {said}"):
        reading.read_bytes(path)


def test_a_single_file_is_whole_or_as_it_was(disk: Callable[[str], Path]) -> None:
    place = disk("size=16k")
    write_new(place / "d.toml", "old")
    with pytest.raises(OutputError, match="cannot be written: No space left on device"):
        write_new(place / "d.toml", "n" * 20 * KB, replace=True)
    assert (place / "d.toml").read_text() == "old"
    assert [path.name for path in place.iterdir()] == ["d.toml"]
