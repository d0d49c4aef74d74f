"""A sweep that is stopped in the middle of a batch: what is saved, what is said of it, and how it goes on."""

import os
import re
import signal
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
import sweep_in_slices
from by_night import by_night, examples
from strokes import bytes_of

from mechwright.cli.progress import now_and_then
from mechwright.contracts.slices import Work
from mechwright.errors import OutputError
from mechwright.plugins.host import host
from mechwright.studies import portion, run, schedule
from mechwright.studies.folder import SweepFolder
from mechwright.studies.portion import Portion
from mechwright.studies.run import evaluate
from mechwright.studies.slice_file import designs_in, slice_of, work_of
from mechwright.studies.stamp import Stamp
from mechwright.studies.standing import Standing
from mechwright.studies.study import load_study
from mechwright.studies.workers import Alone

pytest.importorskip("pyarrow", reason="pip install 'mechwright[scale]'")

COUNT = sweep_in_slices.COUNT
STOPS = (signal.SIGINT, signal.SIGTERM, signal.SIGKILL)


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    path = tmp_path_factory.mktemp("slices") / "forces.toml"
    path.write_text(sweep_in_slices.TEXT.format(more=""))
    return load_study(path, host())


@pytest.fixture(scope="module")
def whole(study):
    """The folder of a sweep that nobody stops: its one batch is evaluated at once."""
    folder = study.path.parent / "whole"
    evaluate(study, folder, Alone(), host())
    return bytes_of(folder)


@pytest.fixture
def short(monkeypatch):
    for name in ("SECONDS", "LONGEST", "FIRST"):
        monkeypatch.setattr(schedule, name, sweep_in_slices.QUARTER)


class StoppedError(Exception):
    pass


class Stopping(Alone):
    """Stops after so many slices, and knows which designs it was asked for."""

    def __init__(self, slices):
        self.slices, self.asked = slices, Counter()

    def done(self, source, tasks):
        for number, (task, found) in enumerate(super().done(source, tasks)):
            if number == self.slices:
                raise StoppedError
            if isinstance(found, Portion):
                self.asked.update((task.name, chunk) for chunk in found.work.answers)
                for question, some in found.work.singles.items():
                    self.asked.update((task.name, question, place) for place in some.places.tolist())
            yield task, found


def test_each_design_is_evaluated_once_however_often_it_is_stopped(study, whole, tmp_path, short):
    asked, said, runs = Counter(), [], 0
    while True:
        standing, workers = Standing(study), Stopping(runs % 4 + 2)
        runs += 1
        try:
            evaluate(study, tmp_path / "out", workers, host(), standing=standing)
            break
        except StoppedError:
            said.append(standing.sentence())
        finally:
            asked.update(workers.asked)
    assert runs > 2
    assert max(asked.values()) == 1
    assert bytes_of(tmp_path / "out") == whole
    saved = [int(re.match(r".*: (\d+) of 40 designs; ", one)[1]) for one in said]
    assert saved == sorted(saved)
    assert all(
        one.endswith(f"goes on with the other {COUNT - n}") for one, n in zip(said, saved, strict=True)
    )


@by_night
def test_several_batches_and_rounds_of_search_are_cut_alike(tmp_path, short):
    path, asked = tmp_path / "forces.toml", Counter()
    path.write_text(sweep_in_slices.TEXT.format(more="batch = 24\nrefine = 1"))
    several = load_study(path, host())
    with pytest.MonkeyPatch.context() as long:
        for name in ("LONGEST", "FIRST"):
            long.setattr(schedule, name, 600.0)
        evaluate(several, tmp_path / "whole", Alone(), host())
    while True:
        workers = Stopping(4)
        try:
            evaluate(several, tmp_path / "out", workers, host())
            break
        except StoppedError:
            continue
        finally:
            asked.update(workers.asked)
    assert len({key[0] for key in asked}) > 2
    assert max(asked.values()) == 1
    assert bytes_of(tmp_path / "out") == bytes_of(tmp_path / "whole")


def test_nothing_saved_is_said(study, tmp_path, short):
    standing = Standing(study)
    assert standing.sentence() == "the sweep had not begun; no file was changed"
    with pytest.raises(StoppedError):
        evaluate(study, tmp_path / "out", Stopping(0), host(), standing=standing)
    said = f"saved in {tmp_path / 'out'}: none of {COUNT} designs; the same command begins anew"
    assert standing.sentence() == said
    assert {path.name for path in (tmp_path / "out").rglob("*") if path.is_file()} == {
        "study.json",
        "manifest.json",
    }


def test_slices_of_a_batch_that_has_its_table_are_removed(study, whole, tmp_path, short):
    """It was killed between the two."""
    with pytest.raises(StoppedError):
        evaluate(study, tmp_path / "out", Stopping(2), host())
    (tmp_path / "out" / "tables" / "part-000000.parquet").write_bytes(whole["tables/part-000000.parquet"])
    assert list((tmp_path / "out" / "slices").iterdir())
    evaluate(study, tmp_path / "out", Stopping(0), host())
    assert bytes_of(tmp_path / "out") == whole


def test_the_file_of_a_slice_holds_its_work(study, short, tmp_path):
    kept = []

    class Keeping(Alone):
        def done(self, source, tasks):
            for task, found in super().done(source, tasks):
                if isinstance(found, Portion):
                    kept.append(found.work)
                yield task, found

    evaluate(study, tmp_path / "out", Keeping(), host())
    path, stamp = tmp_path / "one.parquet", Stamp.of(study, 0, COUNT, 0)
    assert any(work.answers for work in kept)
    for work in kept:
        path.write_bytes(slice_of(study, work, stamp))
        again = work_of(study, path, stamp)
        assert slice_of(study, again, stamp) == path.read_bytes()
        assert designs_in(study, again) == designs_in(study, work)
        for question, some in work.singles.items():
            assert again.singles[question].places.tolist() == some.places.tolist()
            for name in question.columns:
                assert again.singles[question].values[name].tobytes() == some.values[name].tobytes()


@pytest.mark.parametrize(
    "content", [b"", b"PAR1 and nothing", slice_of.__doc__.encode()], ids=["empty", "torn", "text"]
)
def test_what_is_no_slice_is_told(study, tmp_path, short, content):
    with pytest.raises(StoppedError):
        evaluate(study, tmp_path / "out", Stopping(3), host())
    first, *_ = sorted((tmp_path / "out" / "slices").iterdir())
    first.write_bytes(content)
    standing = Standing(study)
    with pytest.raises(
        OutputError, match=r"is no table of this sweep: .*; move it away, and the same command"
    ):
        evaluate(study, tmp_path / "out", Alone(), host(), standing=standing)
    assert re.search(r": \d+ of 40 designs; ", standing.sentence())
    first.unlink()
    evaluate(study, tmp_path / "out", Alone(), host())
    assert not (tmp_path / "out" / "slices").exists()


def test_a_slice_of_another_batch_is_told(study, tmp_path):
    path = tmp_path / "one.parquet"
    work = Work()
    found = portion.portion(
        study, portion.sliced(run.Task("part-000000", 0, 0) and schedule.batch_of(study, run.Task("p", 0, 0))), 0,
        portion.Survey(1e-9),
    )  # fmt: skip
    work.update(found.work)
    fewer, whole = Stamp.of(study, 0, 10, 0), Stamp.of(study, 0, COUNT, 0)
    path.write_bytes(slice_of(study, work, fewer))
    with pytest.raises(OutputError, match="its designs are those of no batch"):
        work_of(study, path, fewer)
    with pytest.raises(
        OutputError, match="it holds slice 0 of the designs 0 to 9; here belong slice 0 of the"
    ):
        work_of(study, path, whole)


def test_a_slice_in_the_place_of_another_is_told(study, short, tmp_path):
    with pytest.raises(StoppedError):
        evaluate(study, tmp_path / "out", Stopping(3), host())
    first, second, *_ = sorted((tmp_path / "out" / "slices").iterdir())
    second.write_bytes(first.read_bytes())
    with pytest.raises(OutputError, match="it holds slice 0 of the designs 0 to 39; here belong slice 1 of"):
        evaluate(study, tmp_path / "out", Alone(), host())
    second.write_bytes(first.read_bytes()[:-100] + bytes(100))
    with pytest.raises(OutputError, match="is no table of this sweep"):
        evaluate(study, tmp_path / "out", Alone(), host())


def started(folder, workers, **more):
    """The command in a process group of its own, which the keyboard reaches, without a terminal."""
    words = [sys.executable, sweep_in_slices.__file__, "sweep", "forces.toml", "-o", folder.name]
    return subprocess.Popen(
        [*words, "--workers", str(workers), "--json"],
        cwd=folder.parent,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        env=os.environ | more,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )


def saved_in(study, folder):
    """What a folder has, read by itself."""
    standing = Standing(study)
    if not (folder / "study.json").exists():
        return None
    standing.place = SweepFolder(folder, study, host())
    standing.tasks = [run.Task("part-000000", 0, 0)]
    return standing.saved()


@pytest.mark.skipif(os.name == "nt", reason="signals of Unix")
@pytest.mark.parametrize("workers", [2, pytest.param(1, marks=by_night)])
def test_processes_that_are_killed_at_any_moment_lose_no_slice(study, whole, tmp_path, workers):
    (tmp_path / "forces.toml").write_text(study.path.read_text())
    rng, folder, before = np.random.default_rng(workers), tmp_path / "out", 0
    for number in range(examples(3, 12)):
        slices = folder / "slices"
        known = len(list(slices.glob("*.parquet")))
        running, stop = started(folder, workers), STOPS[number % 3]
        end = time.monotonic() + 60
        while (
            running.poll() is None and len(list(slices.glob("*.parquet"))) <= known and time.monotonic() < end
        ):  # it has begun: before, a signal ends Python itself
            time.sleep(0.02)
        time.sleep(rng.random() * 0.3)
        if stop == signal.SIGKILL:
            os.killpg(running.pid, stop)
        else:
            running.send_signal(stop)
        out, said = running.communicate(timeout=60)
        if f'"designs": {COUNT}' in out:  # it had ended: Python itself may still hear the signal at its exit
            assert running.returncode in (0, -stop)
            break
        assert running.returncode in (-signal.SIGKILL, 128 + stop)
        assert out == ""
        saved = saved_in(study, folder)
        assert saved >= before
        before = saved
        if stop != signal.SIGKILL:
            assert said == f"mechwright: stopped; {sentence(saved)}\n"
    last = started(folder, 3 - workers)
    out, said = last.communicate(timeout=120)
    assert (last.returncode, said) == (0, "")
    assert f'"designs": {COUNT}' in out
    assert bytes_of(folder) == whole


@pytest.mark.skipif(os.name == "nt", reason="signals of Unix")
def test_a_worker_that_dies_costs_its_slice_alone(study, whole, tmp_path):
    (tmp_path / "forces.toml").write_text(study.path.read_text())
    running, folder = started(tmp_path / "out", 2), tmp_path / "out"
    for number in (1, 3, 5):  # as often than processes are started in vain
        end = time.monotonic() + 60
        while len(list((folder / "slices").glob("*.parquet"))) <= number and time.monotonic() < end:
            if running.poll() is not None:
                break
            time.sleep(0.02)
        for child in children(running.pid):
            os.kill(child, signal.SIGKILL)
            break
    _, said = running.communicate(timeout=120)
    assert running.returncode == 0, said
    assert bytes_of(folder) == whole


def sentence(saved):
    """What is said of a folder with so many designs."""
    if not saved:
        return f"saved in out: none of {COUNT} designs; the same command begins anew"
    if saved == COUNT:
        return f"saved in out: all of {COUNT} designs; the same command goes on from there"
    return (
        f"saved in out: {saved} of {COUNT} designs; the same command goes on with the other {COUNT - saved}"
    )


def children(pid):
    """Workers of a process."""
    for path in Path("/proc").glob("[0-9]*"):
        try:
            stat, words = (path / "stat").read_text(), (path / "cmdline").read_bytes()
        except OSError:
            continue
        if int(stat.rpartition(")")[2].split()[1]) == pid and b"spawn_main" in words:
            yield int(path.name)


@pytest.mark.skipif(not Path("/proc/self/fd").exists(), reason="looks into /proc")
@pytest.mark.parametrize("room", [0, 3])
def test_a_full_disk_is_one_line_that_says_what_is_saved(study, whole, tmp_path, room):
    (tmp_path / "forces.toml").write_text(study.path.read_text())
    full = started(tmp_path / "out", 1, MECHWRIGHT_DISK=str(room))
    _, said = full.communicate(timeout=120)
    assert full.returncode == 2
    saved = saved_in(study, tmp_path / "out")
    assert (saved == 0) == (room == 0)
    assert said.startswith(
        f"mechwright: out/slices/part-000000-{room:06d}.parquet: cannot be written: No space left"
    )
    assert said.endswith(f"; {sentence(saved)}\n")
    assert said.count("\n") == 1
    last = started(tmp_path / "out", 1)
    last.communicate(timeout=120)
    assert bytes_of(tmp_path / "out") == whole


def test_progress_without_a_terminal_is_a_line_now_and_then(capsys):
    with now_and_then(0.05) as progress:
        progress(0.25, "25 of 100 designs saved")
        time.sleep(0.02)
        progress(0.5, "50 of 100 designs saved")
        time.sleep(0.1)
    first, *_, last = capsys.readouterr().err.splitlines()
    assert first == "mechwright: 50 %: 50 of 100 designs saved; 0 s so far, about 0 s left"
    assert last == "mechwright: 100 %: done; 0 s"
    with now_and_then(10) as progress:
        progress(0.5, "something")
    assert capsys.readouterr().err == ""
