"""Every command that writes, where nothing that is open can be moved, replaced or removed, as on Windows."""

import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest
import windows_files
from by_night import by_night
from strokes import TEXT, swept

from mechwright.contracts.alarm import TimeUpError, in_time
from mechwright.output import folder, staging
from mechwright.output.folder import Output, write_folder
from mechwright.output.locking import folder_lock
from mechwright.plugins.host import host
from mechwright_cad.live.session import Session
from mechwright_cad.live.wishing import Wishing

pytestmark = pytest.mark.skipif(not windows_files.available, reason="asks Linux what is open")
ROOT = Path(__file__).parents[1]
PAIR = ROOT / "examples" / "elliptic-pair.toml"
SHORT = """\
family = "four-bar"
[parameters]
ground = 90
crank = 9.0
coupler = 80
pin_diameter = 6
rim = 4
"""

Run = Callable[..., tuple[int, str, str]]


@pytest.fixture(autouse=True)
def refused(monkeypatch: pytest.MonkeyPatch) -> None:
    windows_files.refuse(monkeypatch.setattr, monkeypatch.delattr)


def names(place: Path) -> set[str]:
    return {entry.name for entry in place.iterdir()}


def test_what_is_open_stays_where_it_is(tmp_path: Path) -> None:
    """The fixture itself: of each kind one that is refused."""
    (tmp_path / "folder").mkdir()
    file = tmp_path / "folder" / "a"
    file.write_text("a")
    with file.open(), pytest.raises(PermissionError):
        file.replace(tmp_path / "b")
    with file.open(), pytest.raises(PermissionError):
        file.unlink()
    with file.open(), pytest.raises(PermissionError):
        (tmp_path / "folder").rename(tmp_path / "other")
    (tmp_path / "b").write_text("b")
    with file.open(), pytest.raises(PermissionError):
        (tmp_path / "b").replace(file)
    with pytest.raises(FileExistsError):
        (tmp_path / "b").rename(file)
    assert not folder.exchange(tmp_path, tmp_path)
    file.unlink()


@pytest.mark.parametrize("command", [("new", "four-bar"), ("schema", "four-bar"), ("shop",)], ids=" ".join)
def test_a_file_is_written_and_replaced(command: tuple[str, ...], tmp_path: Path, command_line: Run) -> None:
    file = tmp_path / "file"
    for more in ((), ("--force",)):
        assert command_line(*command, "-o", file, *more)[0] == 0
        assert names(tmp_path) == {"file"}


def test_a_design_is_mended_in_its_place(tmp_path: Path, command_line: Run) -> None:
    path = tmp_path / "short.toml"
    path.write_text(SHORT)
    code, _, err = command_line("fix", path, "--to", "parts", "--write")
    assert (code, err) == (0, "")
    assert path.read_text() != SHORT
    assert names(tmp_path) == {"short.toml"}


def test_tools_are_exported(tmp_path: Path, command_line: Run) -> None:
    for more in ((), ("--force",)):
        code, _, err = command_line("tools", "--export", tmp_path / "Library" / "tools.fctl", *more)
        assert code == 0, err


@pytest.mark.parametrize(
    "command",
    [
        ("solve",),
        *(pytest.param((one,), marks=by_night) for one in ("model", "cam", "build")),
    ],
    ids=" ".join,
)
def test_a_folder_is_written_and_replaced(
    command: tuple[str, ...], tmp_path: Path, command_line: Run
) -> None:
    for _ in range(2):
        code, _, err = command_line(*command, PAIR, "-o", tmp_path / "out")
        assert code == 0, err
        assert names(tmp_path) == {"out"}


@by_night
def test_the_demo_is_built(tmp_path: Path, command_line: Run) -> None:
    for _ in range(2):
        code, _, err = command_line("demo", tmp_path, "--no-open")
        assert code == 0, err
        assert names(tmp_path) == {"elliptic-pair.toml", "out"}


@by_night
def test_designs_that_meet_a_requirement_are_written(tmp_path: Path, command_line: Run) -> None:
    asked = ROOT / "examples" / "slider-crank-stroke-requirement.toml"
    code, _, err = command_line("synthesize", asked, "-o", tmp_path / "out")
    assert code == 0, err


def test_the_page_saves_and_writes_anew(tmp_path: Path) -> None:
    path = tmp_path / "pair.toml"
    path.write_bytes(PAIR.read_bytes())
    session = Session(path, host())
    session.save({"parameters.eccentricity": 0.3}, session.digest())
    session.save({"parameters.eccentricity": 0.2}, session.digest())
    session.save_as({}, "other")
    assert names(tmp_path) == {"pair.toml", "other.toml"}
    asked = tmp_path / "line.toml"
    asked.write_bytes((ROOT / "examples" / "four-bar-line-requirement.toml").read_bytes())
    wishing = Wishing(asked, host())
    wishing.save_as({}, "again")
    assert "again.toml" in names(tmp_path)


def test_a_sweep_is_stopped_and_goes_on(tmp_path: Path) -> None:
    for _ in range(2):
        done = swept(tmp_path / "out", "--workers", "1")
        assert done.exit_code == 0, done.output
        (tmp_path / "out" / "tables" / "part-000001.parquet").unlink()
        (tmp_path / "out" / "tables" / "part-000002.part").write_bytes(b"torn")
    assert names(tmp_path) == {"strokes.toml", "out"}


@by_night
def test_a_sweep_is_stopped_and_goes_on_with_its_processes(tmp_path: Path) -> None:
    """In processes that refuse it as well: the command, and two workers."""
    pytest.importorskip("pyarrow")
    study, out = tmp_path / "study.toml", tmp_path / "out"
    study.write_text(TEXT.format(more=""))
    (tmp_path / "site").mkdir()
    environment = windows_files.in_children(tmp_path / "site", dict(os.environ))
    call = [sys.executable, "-m", "mechwright", "sweep", study, "-o", out, "--workers", "2"]
    for _ in range(2):
        done = subprocess.run(call, env=environment, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        (out / "tables" / "part-000001.parquet").unlink()
        (out / "tables" / "part-000002.part").write_bytes(b"torn")
    assert names(tmp_path) == {"study.toml", "out", "site"}


def test_a_process_in_which_it_is_refused(tmp_path: Path) -> None:
    environment = windows_files.in_children(tmp_path, dict(os.environ))
    words = "import os; one = open(os.sys.argv[1]); os.replace(os.sys.argv[1], os.sys.argv[1] + '2')"
    call = [sys.executable, "-c", words, tmp_path / "sitecustomize.py"]
    done = subprocess.run(call, env=environment, capture_output=True, text=True, check=False)
    assert "is used by a process" in done.stderr


def test_a_folder_somebody_has_open_is_refused_with_what_to_close(tmp_path: Path) -> None:
    out = tmp_path / "out"
    write_folder(out, Output({"a": b"old"}), "solve", {})
    with (
        (out / "a").open(),
        pytest.raises(OSError, match="close the programs and terminals that have it open"),
    ):
        write_folder(out, Output({"a": b"new"}), "solve", {})
    assert (out / "a").read_bytes() == b"old"
    assert names(tmp_path) == {"out"}


def test_two_letters_cases_are_one_name(tmp_path: Path) -> None:
    out = tmp_path / "out"
    write_folder(out, Output({"Gear.step": b"old"}), "model", {})
    write_folder(out, Output({"gear.step": b"new"}), "cam", {})
    assert {name for name in names(out) if name.endswith(".step")} == {"gear.step"}
    output = Output({"gear.step": b""})
    with pytest.raises(OSError, match=r"'gear.step' and 'Gear.STEP' would be one"):
        output.add("Gear.STEP", b"")


@pytest.mark.parametrize(
    "name", ["con.step", "NUL", "aux.a.nc", "com1.nc", "lpt9", "a.", "a ", "a:b", "a?", "a\n"]
)
def test_names_that_windows_has_not_are_refused(name: str) -> None:
    with pytest.raises(OSError, match=r"Windows|plain"):
        Output().add(name, b"")


def test_the_lock_of_a_folder_is_one_writers(tmp_path: Path) -> None:
    with folder_lock(tmp_path) as first:
        assert first
        with pytest.raises(OSError, match="another process has been writing in"), folder_lock(tmp_path, 0.1):
            pass
    with folder_lock(tmp_path, 0.0) as again:
        assert again
    with folder_lock(tmp_path / "none") as missing:
        assert not missing


def test_what_a_dead_process_took_out_is_put_back(tmp_path: Path) -> None:
    out = tmp_path / "out"
    write_folder(out, Output({"a": b"old"}), "solve", {})
    out.rename(tmp_path / ".out.mechwright-01234567-old")
    (tmp_path / ".out.mechwright-89abcdef").mkdir()
    (tmp_path / ".out.mechwright-89abcdef-life").touch()
    staging.remove_leftovers(out)
    assert names(tmp_path) == {"out"}
    assert (out / "a").read_bytes() == b"old"


def test_what_lives_is_left_alone(tmp_path: Path) -> None:
    with staging.staging_folder(tmp_path / "out") as one, staging.staging_folder(tmp_path / "out") as two:
        assert one.path.exists()
        assert two.path.exists()
        assert len(names(tmp_path)) == 4
    assert names(tmp_path) == set()


def test_a_table_that_a_spreadsheet_has_open_is_told_before_the_work(
    tmp_path: Path, command_line: Run
) -> None:
    assert command_line("solve", PAIR, "-o", tmp_path / "out")[0] == 0
    with (tmp_path / "out" / "motion.csv").open():
        code, _, err = command_line("build", PAIR, "-o", tmp_path / "out")
    assert code == 2
    assert "close the programs and terminals that have it open" in err
    assert names(tmp_path) == {"out"}


def test_a_path_that_is_too_long_is_one_line(tmp_path: Path, command_line: Run) -> None:
    folder = tmp_path / ("n" * 100) / ("m" * 150)
    code, _, err = command_line("solve", PAIR, "-o", folder)
    assert code == 2
    assert err.count("\n") == 1
    assert "cannot be written" in err


@pytest.mark.parametrize("name", ["nul.toml", "com1.toml", "a?.toml", "b:c.toml"])
def test_a_name_that_windows_has_not_is_one_line(name: str, tmp_path: Path, command_line: Run) -> None:
    code, _, err = command_line("new", "four-bar", "-o", tmp_path / name)
    assert code == 2
    assert err.count("\n") == 1


def test_a_plugin_has_a_time_without_an_alarm() -> None:
    def endless() -> None:
        while True:
            pass

    with pytest.raises(TimeUpError, match=r"takes more than 0\.2 s"), in_time(0.2):
        endless()
    with in_time(5.0), in_time(0.01):
        time.sleep(0.1)  # what is inside of another one has its time
    with in_time(0.05):
        pass
    time.sleep(0.2)


@by_night
@pytest.mark.parametrize("command", ["check", "solve", "build", "schema", "shop", "families", "new"])
def test_commands_speak_an_older_encoding(command: str, tmp_path: Path) -> None:
    more = {
        "check": [PAIR], "solve": [PAIR, "-o", tmp_path / "out"], "build": [PAIR, "-o", tmp_path / "out"],
        "schema": ["four-bar"], "new": ["four-bar", "-o", tmp_path / "new.toml"],
    }.get(command, [])  # fmt: skip
    (tmp_path / "site").mkdir()
    environment = windows_files.in_children(tmp_path / "site", dict(os.environ))
    environment |= {"PYTHONIOENCODING": "cp1252", "PYTHONUTF8": "0", "LC_ALL": "C"}
    call = [sys.executable, "-m", "mechwright", command, *map(str, more)]
    done = subprocess.run(call, env=environment, capture_output=True, check=False, timeout=240)
    assert done.returncode == 0, done.stderr
    assert b"Traceback" not in done.stderr
