"""Without memory, at whichever allocation: the files of before or those of now, and the right words."""

import sys
from pathlib import Path

import pytest
from by_night import by_night, examples

if not sys.platform.startswith("linux"):
    pytest.skip("forks and limits of Linux", allow_module_level=True)
pytest.importorskip("_testcapi", reason="this interpreter cannot let allocations fail")

from memory_faults import bounded, outcomes

from mechwright.cli import failure

ROOT = Path(__file__).parents[2]
SOUND = {"written", "refused", "refused, as another error"}


def test_one_allocation_that_fails_leaves_old_files_or_new_ones(tmp_path: Path) -> None:
    steps = range(0, 1600, examples(160, 1))
    found = [(word, step) for word, step in outcomes(tmp_path / "work", steps) if word not in SOUND]
    assert found == []


def test_want_of_memory_behind_the_exchange_is_no_failure(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import memory_faults

    from mechwright.output import folder, staging

    def fails(*_: object, **__: object) -> None:
        raise MemoryError

    memory_faults.write(tmp_path, "old")
    with monkeypatch.context() as patched:
        patched.setattr(folder, "folder_to_disk", lambda path: path == tmp_path and fails())
        patched.setattr(staging.shutil, "rmtree", fails)
        memory_faults.write(tmp_path, "new")
    assert (tmp_path / "out" / "file-0").read_bytes().startswith(b"new 0")
    assert len(list(tmp_path.iterdir())) == 2  # nothing could be removed, and the next run does it
    memory_faults.write(tmp_path, "newer")
    assert [path.name for path in tmp_path.iterdir()] == ["out"]


def test_a_library_that_finds_no_room_is_told_as_that() -> None:
    error = ImportError("libx.so: failed to map segment from shared object")
    assert failure.lines(error) == ["there is not enough memory for this; nothing was written"]
    assert "please report it" in failure.lines(ImportError("no such thing"))[0]


@by_night
@pytest.mark.parametrize("megabytes", [40, 120, 160, 240, 320, 400, 600])
def test_a_command_with_little_room_changes_nothing_and_says_so(tmp_path: Path, megabytes: int) -> None:
    """What else is said are warnings of plugins that found no room, and what libraries say that end the process."""
    done = bounded(
        ["solve", str(ROOT / "examples" / "slider-crank-quick-return.toml"), "-o", str(tmp_path / "out")],
        megabytes,
    )
    if done.returncode == 0:
        assert (tmp_path / "out" / "manifest.json").exists()
    else:
        assert "Traceback" not in done.stderr
        assert "emory" in done.stderr.splitlines()[-1]
        assert list(tmp_path.iterdir()) == []
