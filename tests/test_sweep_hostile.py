"""What a sweep finds in its folder, however wrong: one line, soon, and what is finished stays."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from random import Random

import pytest
from by_night import NIGHT
from strokes import bytes_of, swept, swept_file

from mechwright.errors import MechwrightError
from mechwright.plugins.host import host
from mechwright.studies import run
from mechwright.studies.folder import SweepFolder
from mechwright.studies.stamp import STAMP, sealed
from mechwright.studies.study import load_study
from mechwright.studies.task import Task

TABLE, OTHER = "tables/part-000001.parquet", "tables/part-000002.parquet"
COUNTS = b"mechwright.counts"
pipes = pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="the system has no pipes with names")


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    folder = tmp_path_factory.mktemp("hostile") / "whole"
    assert swept(folder, "--workers", "1").exit_code == 0
    return folder


@pytest.fixture
def folder(whole, tmp_path):
    shutil.copy(whole.parent / "strokes.toml", tmp_path)
    return shutil.copytree(whole, tmp_path / "out")


def zeros(path):
    path.symlink_to("/dev/zero")


def swept_alone(folder):
    """The same by a process of its own, which ends: whoever reads what has no end runs into a limit."""

    def limited():
        import resource

        resource.setrlimit(resource.RLIMIT_CPU, (40, 40))
        resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))

    words = [sys.executable, "-m", "mechwright", "sweep", "strokes.toml", "-o", folder.name, "--workers", "1"]
    return subprocess.run(
        words, cwd=folder.parent, capture_output=True, text=True, timeout=60, check=False, preexec_fn=limited
    )


@pipes
def test_pipes_and_devices_in_place_of_tables_are_made_anew_and_others_are_not_looked_at(whole, folder):
    for name, make in ((TABLE, os.mkfifo), (OTHER, zeros)):
        (folder / name).unlink()
        make(folder / name)
    tables = folder / "tables"
    os.mkfifo(tables / "part-000777.parquet")
    zeros(tables / "more.parquet")
    (tables / "junk.parquet").write_bytes(b"PAR1 and nothing")
    done = swept_alone(folder)
    assert done.returncode == 0, done.stderr
    for path in (tables / "part-000777.parquet", tables / "more.parquet"):
        assert not path.is_file()
        path.unlink()
    (tables / "junk.parquet").unlink()
    assert bytes_of(folder) == bytes_of(whole)


@pipes
@pytest.mark.parametrize("make", [os.mkfifo, zeros], ids=["pipe", "device"])
def test_a_pipe_in_place_of_what_was_begun_is_refused_at_once(whole, folder, make):
    (folder / "study.json").unlink()
    make(folder / "study.json")
    done = swept_alone(folder)
    said = "mechwright: out/study.json: does not say which study was begun here; give a new folder with -o\n"
    assert (done.returncode, done.stderr) == (2, said)
    assert (folder / TABLE).read_bytes() == (whole / TABLE).read_bytes()


@pytest.mark.parametrize("text", ["", "[]", "[" * 9000, '{"study": "' + "x" * 10_000 + '"}'])
def test_what_was_begun_is_not_guessed(folder, text):
    (folder / "study.json").write_text(text)
    before = bytes_of(folder)
    done = swept(folder, "--workers", "1")
    assert done.exit_code == 1
    assert "study.json: does not say which study was begun here" in str(done.exception)
    assert bytes_of(folder) == before


def with_counts(table, **changed):
    said = json.loads(table.schema.metadata[COUNTS]) | changed
    return table.replace_schema_metadata({**table.schema.metadata, COUNTS: json.dumps(said)})


def without(table, key):
    return table.replace_schema_metadata({k: v for k, v in table.schema.metadata.items() if k != key})


def with_stamp(table, text):
    return table.replace_schema_metadata({**table.schema.metadata, STAMP: text})


def stamped(table, **changed):
    return with_stamp(table, json.dumps(json.loads(table.schema.metadata[STAMP]) | changed))


def with_column(table, name, values):
    import pyarrow

    return table.set_column(table.schema.get_field_index(name), name, pyarrow.array(values))


def longer(table):
    import pyarrow

    return pyarrow.concat_tables([table] * 9)


def heavy(table):
    noise = os.urandom(1_000_000).hex()
    return table.replace_schema_metadata({**table.schema.metadata, b"noise": noise})


WRONG = {
    "too large": (heavy, "is larger than "),
    "too large when unpacked": (
        lambda table: with_column(table, "rod", [letter * 300_000 for letter in "abcdefgh"]),
        "it is too large when it is unpacked",
    ),
    "a column less": (lambda table: table.drop_columns(["rod"]), "it has other columns"),
    "a column more": (lambda table: table.append_column("more", table["rod"]), "it has other columns"),
    "words for numbers": (
        lambda table: with_column(table, "stroke", ["a"] * 8),
        "its column stroke holds no numbers",
    ),
    "more rows": (longer, "it has 72 designs, and counts 8"),
    "no counts": (lambda table: without(table, COUNTS), "it has no counts"),
    "no stamp": (lambda table: without(table, STAMP), "it does not say of which designs it is"),
    "a stamp of words": (lambda table: with_stamp(table, '"all"'), "is no table of this sweep"),
    "a stamp of more": (
        lambda table: with_stamp(table, '{"first": 8, "last": 9}'),
        "is no table of this sweep",
    ),
    "another study": (lambda table: stamped(table, study="0" * 64), "it is of another study"),
    "another program": (lambda table: stamped(table, program="python 0"), "it is by another program"),
    "other designs": (
        lambda table: stamped(table, first=0),
        "it holds the designs 0 to 7; here belong the designs 8 to 15",
    ),
    "fewer designs": (lambda table: stamped(table, designs=7), "it holds the designs 8 to 14; here belong"),
    "a slice": (lambda table: stamped(table, slice=1), "it holds slice 1 of the designs 8 to 15"),
    "less than none": (lambda table: with_counts(table, forbidden={"a": -1}), "are no whole numbers"),
    "a fraction": (lambda table: with_counts(table, designs=8.0), "are no whole numbers"),
    "more than a batch": (lambda table: with_counts(table, designs=9), "are those of no batch"),
    "more allowed than there are": (lambda table: with_counts(table, designs=7), "are those of no batch"),
}


@pytest.mark.parametrize(("change", "said"), WRONG.values(), ids=WRONG)
def test_a_table_that_is_not_of_the_study_is_refused_before_any_work(folder, change, said):
    parquet = pytest.importorskip("pyarrow.parquet")
    table = parquet.read_table(folder / TABLE)
    assert table.num_rows == 8
    parquet.write_table(change(table), folder / TABLE, compression="zstd")
    (folder / TABLE).write_bytes(sealed((folder / TABLE).read_bytes()))
    (folder / OTHER).unlink()
    text = refused(folder)
    assert said in text
    assert not (folder / OTHER).exists()


@pytest.mark.parametrize("content", [b"", b"PAR1 and nothing", b"PAR1" * 9])
def test_what_is_no_table_is_told_and_made_again_when_it_is_away(whole, folder, content):
    (folder / TABLE).write_bytes(content)
    text = refused(folder)
    assert "is no table of this sweep: " in text
    assert text.endswith("; move it away, and the same command makes it again")
    if content:
        return
    (folder / TABLE).unlink()
    assert swept(folder, "--workers", "1").exit_code == 0
    assert bytes_of(folder) == bytes_of(whole)


def test_a_table_with_torn_values_is_told(folder):
    content = bytearray((folder / TABLE).read_bytes())
    content[4:200] = bytes(196)
    (folder / TABLE).write_bytes(content)
    assert "is no table of this sweep: " in refused(folder)


def test_a_table_in_the_place_of_another_is_refused(folder):
    shutil.copy(folder / TABLE, folder / OTHER)
    said = refused(folder, OTHER)
    assert "it holds the designs 8 to 15; here belong the designs 16 to 23; move it away" in said


def test_a_table_of_another_study_is_refused(folder, tmp_path):
    """With the same columns and numbers, and another range."""
    text = (folder.parent / "strokes.toml").read_text()
    (tmp_path / "other").mkdir()
    path = tmp_path / "other" / "strokes.toml"
    path.write_text(text.replace("greatest = 160", "greatest = 161"))
    assert swept_file(path, tmp_path / "other" / "out", "--workers", "1").exit_code == 0
    shutil.copy(tmp_path / "other" / "out" / TABLE, folder / TABLE)
    assert "it is of another study" in refused(folder)


def damaged(content, random):
    """Bytes of a table of which some are others, missing, doubled, or of another place."""
    data = bytearray(content)
    at, to = sorted(random.sample(range(len(data)), 2))
    match random.randrange(7):
        case 0:
            data[at] ^= 1 << random.randrange(8)
        case 1:
            del data[at:to]
        case 2:
            data[at:at] = data[at:to]
        case 3:
            data[at:to] = bytes(to - at)
        case 4:
            data[at:to] = random.randbytes(to - at)
        case 5:
            data = data[:at]
        case 6:
            data[at:to] = reversed(data[at:to])
    return bytes(data)


@pytest.mark.parametrize("part", range(1 if not NIGHT else 10))
def test_of_damaged_tables_none_counts(folder, whole, part):
    """A hundred each, a thousand by night, read as a sweep reads them that goes on."""
    study = load_study(folder.parent / "strokes.toml", host())
    place, task = SweepFolder(folder, study, host()), Task("part-000001", 8, 1)
    content, random = (whole / TABLE).read_bytes(), Random(part)  # noqa: S311
    place.counts(task)
    for _ in range(100):
        (folder / TABLE).write_bytes(wrong := damaged(content, random))
        if wrong == content:
            continue
        with pytest.raises(
            MechwrightError, match=r"part-000001\.parquet: (is no table of this sweep|is larger)"
        ):
            place.counts(task)
        assert place.whole([task]) == set()


def refused(folder, name=TABLE):
    done = swept(folder, "--workers", "1")
    assert done.exit_code == 1
    text = str(done.exception)
    assert text.startswith(f"{folder / name}: ")
    assert "\n" not in text
    return text


def test_the_page_is_made_of_every_table_that_was_asked_for(tmp_path, monkeypatch):
    given, page_of = [], run.page_of

    def seen(study, counts, front, chosen, tables, pictures):
        given.extend(tables)
        return page_of(study, counts, front, chosen, tables, pictures)

    monkeypatch.setattr(run, "page_of", seen)
    assert swept(tmp_path / "out", "--workers", "1", text="refine = 1").exit_code == 0
    assert given == sorted((tmp_path / "out" / "tables").iterdir())
    assert {path.name.partition("-")[0] for path in given} == {"part", "refine"}


ENDLESS = """
import time
from pathlib import Path
class Endless:
    def done(self, task):
        Path(f"begun-{task}").touch()
        time.sleep(3600)
"""
STOPPED = """
import multiprocessing, os, signal, sys, threading, time
sys.path.append({tests!r})
from pathlib import Path
from endless import Endless
from listed_tasks import ListedTasks
from mechwright.studies.workers import Processes
def stop():
    while len(list(Path().glob("begun-*"))) < 2:
        time.sleep(0.02)
    os.kill(os.getpid(), signal.SIGINT)
if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.default_int_handler)  # which a process in the background may ignore
    other = multiprocessing.get_context("spawn").Process(target=time.sleep, args=(3600,), daemon=True)
    other.start()
    asked = Processes(2).done(Endless(), ListedTasks(["a", "b", "c"]))
    threading.Thread(target=stop, daemon=True).start()
    try:
        next(asked)
    except KeyboardInterrupt:
        other.join(1)
        print("stopped", other.is_alive())
"""


def test_workers_end_with_a_sweep_that_is_stopped(tmp_path):
    """The interpreter would wait at its end for what they are at, which is a minute at times; here an hour."""
    (tmp_path / "endless.py").write_text(ENDLESS)
    (tmp_path / "stopped.py").write_text(STOPPED.format(tests=str(Path(__file__).parent)))
    words = [sys.executable, "stopped.py"]
    done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, timeout=60, check=True)
    assert done.stdout == "stopped True\n", "a process of the caller's own goes on"
