"""What is stopped, killed or refused by the disk leaves old files or new ones, and nothing beside them."""

import contextlib
import os
import signal
import stat
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from by_night import examples
from writing_faults import KINDS, Shim, built, counted

from mechwright.output import folder as files
from mechwright.output.folder import Output, write_folder, write_new
from mechwright.output.locking import life_lock
from mechwright.output.staging import MARK, OLD, remove_leftovers, staging_folder

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="signals and rights of POSIX")
EXAMPLE = Path(__file__).parents[2] / "examples" / "elliptic-pair.toml"
SLOW = """
import sys, time
from pathlib import Path
from mechwright.output.folder import Output, write_folder
def pieces():
    yield b"new"
    print("begun", flush=True)
    time.sleep(60)
write_folder(Path(sys.argv[1]), Output({"a": pieces()}), "build", {})
"""


def wrote(target: Path, text: str) -> None:
    write_folder(target, Output({"a": text.encode()}), "build", {})


def names(folder: Path) -> set[str]:
    return {entry.name for entry in folder.iterdir()}


@contextlib.contextmanager
def writing(target: Path) -> Iterator["subprocess.Popen[str]"]:
    """A process in the middle of writing a folder."""
    call = [sys.executable, "-c", SLOW, str(target)]
    process = subprocess.Popen(call, stdout=subprocess.PIPE, text=True)
    try:
        assert process.stdout is not None
        assert process.stdout.readline() == "begun\n"
        yield process
    finally:
        process.kill()
        process.communicate()


def test_what_the_dead_left_goes_and_what_lives_stays(tmp_path: Path) -> None:
    target = tmp_path / "out"
    wrote(target, "old")
    mine = tmp_path / f".other{MARK}12345678"
    mine.mkdir()
    (tmp_path / ".out-backup").mkdir()
    kept = {"out", mine.name, ".out-backup"}
    with writing(target) as process:
        wrote(target, "between")
        assert len(names(tmp_path) - kept) == 1
        process.send_signal(signal.SIGKILL)
        process.wait()
        assert len(names(tmp_path) - kept) == 1
        wrote(target, "new")
    assert names(tmp_path) == kept
    assert (target / "a").read_text() == "new"


def test_a_file_that_was_left_goes_with_the_next_of_its_name(tmp_path: Path) -> None:
    left = tmp_path / f".a.toml{MARK}12345678"
    left.write_text("half")
    write_new(tmp_path / "a.toml", "text")
    assert names(tmp_path) == {"a.toml"}


def test_a_state_between_two_renames_is_put_back(tmp_path: Path) -> None:
    target = tmp_path / "out"
    wrote(target, "old")
    target.rename(tmp_path / f".out{MARK}12345678{OLD}")
    remove_leftovers(target)
    assert (target / "a").read_text() == "old"
    assert names(tmp_path) == {"out"}


def test_a_folder_that_somebody_takes_away_before_it_is_locked_is_made_anew(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    taken = []
    real = Path.mkdir

    def mkdir(path: Path, *arguments: object) -> None:
        real(path, *arguments)  # type: ignore[arg-type]
        if not taken:
            taken.append(path)
            path.rmdir()

    monkeypatch.setattr(Path, "mkdir", mkdir)
    with staging_folder(tmp_path / "out") as staged:
        folder = staged.path
        assert folder.is_dir()
        assert folder != taken[0]
        with life_lock(folder) as ours:
            assert not ours
    assert names(tmp_path) == set()


@pytest.mark.parametrize("mask", [0o022, 0o077, 0o002])
def test_rights_are_those_of_the_mask_and_then_the_folders_own(tmp_path: Path, mask: int) -> None:
    target = tmp_path / "out"
    before = os.umask(mask)
    try:
        wrote(target, "old")
    finally:
        os.umask(before)
    assert stat.S_IMODE(target.stat().st_mode) == 0o777 & ~mask
    target.chmod(0o750)
    wrote(target, "new")
    assert stat.S_IMODE(target.stat().st_mode) == 0o750


@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_a_signal_is_one_line_and_its_exit_code(tmp_path: Path, number: int, code: int) -> None:
    process = subprocess.Popen(
        [sys.executable, "-m", "mechwright", "build", str(EXAMPLE), "-o", str(tmp_path / "out")],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "MECHWRIGHT_PROGRESS": "1"},
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
        start_new_session=True,
    )
    assert process.stderr is not None
    assert process.stderr.readline().startswith("@progress")
    process.send_signal(number)
    said, err = process.communicate(timeout=60)
    told = [line for line in err.splitlines() if not line.startswith("@progress")]
    assert (process.returncode, said) == (code, "")
    assert told == [f"mechwright: stopped; {tmp_path / 'out'} is as it was"]
    assert names(tmp_path) == set()


def test_a_stop_that_a_module_takes_for_an_error_of_its_own_is_one(tmp_path: Path) -> None:
    (tmp_path / "stops.py").write_text(
        "import os, signal\ntry:\n    os.kill(os.getpid(), signal.SIGTERM)\n    [0 for _ in range(10**6)]\n"
        "except KeyboardInterrupt:\n    raise ImportError('initialization failed') from None\n"
    )
    assert imported_by_main(tmp_path) == (143, "mechwright: stopped; nothing was written\n")


def test_a_stop_that_somebody_makes_an_exit_of_is_told(tmp_path: Path) -> None:
    (tmp_path / "stops.py").write_text(
        "import os, signal, sys\ntry:\n    os.kill(os.getpid(), signal.SIGTERM)\n    [0 for _ in range(10**6)]\n"
        "except KeyboardInterrupt:\n    sys.exit(1)\n"
    )
    assert imported_by_main(tmp_path) == (143, "mechwright: stopped; nothing was written\n")


def test_the_exit_code_holds_where_the_keyboard_comes_while_a_text_is_executed(tmp_path: Path) -> None:
    (tmp_path / "stops.py").write_text("exec('import _thread; _thread.interrupt_main()')\n")
    assert imported_by_main(tmp_path) == (130, "mechwright: stopped; nothing was written\n")


def imported_by_main(folder: Path) -> tuple[int, str]:
    """Exit code and standard error of a command line that imports the module ``stops`` of a folder."""
    code = (
        "import signal; signal.signal(signal.SIGINT, signal.default_int_handler); "  # a shell may have it ignored
        "import mechwright.cli.app as app; import importlib; "
        "app.make_app = lambda: importlib.import_module('stops'); from mechwright.cli import main; main()"
    )
    environment = {**os.environ, "PYTHONPATH": str(folder)}
    call = [sys.executable, "-c", code]
    done = subprocess.run(call, capture_output=True, text=True, env=environment, check=False)
    return done.returncode, done.stderr


def test_a_want_of_memory_changes_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    wrote(tmp_path / "out", "old")

    def fails(*_: object) -> str:
        raise MemoryError

    monkeypatch.setattr(files, "_written", fails)
    with pytest.raises(MemoryError):
        wrote(tmp_path / "out", "new")
    assert (tmp_path / "out" / "a").read_text() == "old"
    assert names(tmp_path) == {"out"}


@pytest.fixture(scope="module")
def shim(tmp_path_factory: pytest.TempPathFactory) -> Shim:
    made = built(tmp_path_factory.mktemp("faults"))
    if made is None:
        pytest.skip("needs a C compiler (cc) and Linux")
    return made


def test_a_fault_at_any_step_leaves_old_files_or_new_ones(shim: Shim) -> None:
    for name, counts in counted(shim, every=examples(25, 1)).items():
        assert set(counts) <= {"written", "refused"}, (name, counts)
    assert len(KINDS) == 5
