"""Calls of worker processes: their results, their errors, and that no process is left."""

import os
import pickle
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest
from by_night import by_night

from mechwright.contracts.exporter import Exporter
from mechwright.contracts.finding import Finding, Severity
from mechwright.errors import ProofError, ToolError
from mechwright.pipeline import Build, Wanted
from mechwright.plugins.host import Host, Registered, host
from mechwright.worker_pool.budget import available_cores
from mechwright.worker_pool.pool import LostError, WorkerPool
from mechwright_cad.pages import Interference, SolidFiles
from mechwright_cad.solid_models import Solids, Work, collisions_and_files

HERE = os.getpid()


def test_a_call_runs_in_another_process_that_has_the_modules_already():
    with WorkerPool([1], ["colorsys", "no_such_module"]) as pool:
        asked = pool.submit(eval, "__import__('os').getpid(), 'colorsys' in __import__('sys').modules")
        process, imported = pool.result(asked)
    assert process != HERE
    assert imported


WHERE = "__import__('os').getpid()"
ANSWERS = "__import__('mechwright.worker_pool.serving', fromlist=['_answers'])._answers[0]"


@pytest.mark.parametrize(
    ("call", "error"),
    [
        ("__import__('os')._exit(3)", LostError),
        (f"{ANSWERS}.write(b'x' * 99), {ANSWERS}.flush()", LostError),
        ("1 / 0", ZeroDivisionError),
        ("__import__('threading').Lock()", TypeError),  # no copy of it
    ],
    ids=["dies", "writes-nonsense", "raises", "no-copy"],
)
def test_what_goes_wrong_there_is_an_error_here_and_the_next_call_is_answered(call, error):
    with WorkerPool([1], quiet=True) as pool:
        failed, good = pool.submit(eval, call), pool.submit(eval, WHERE)
        with pytest.raises(error):
            pool.result(failed)
        assert pool.result(good) != HERE


def test_a_long_request_and_a_long_answer_do_not_wait_for_each_other():
    long = b"x" * 3_000_000
    with WorkerPool([1]) as pool:  # submitting returns though nobody reads yet
        pool.submit(time.sleep, 0.2)
        assert pool.result(pool.submit(bytes.upper, long)) == long.upper()
    with WorkerPool([1]) as pool:  # ended before it has read its request
        pool.submit(bytes.upper, long)


def test_what_cannot_be_copied_is_an_error():
    with WorkerPool([1]) as pool, pytest.raises((AttributeError, pickle.PicklingError)):
        pool.result(pool.submit(lambda: os.getpid()))


@pytest.mark.parametrize("executable", ["", "/nowhere/python"])
def test_where_no_process_can_be_started_the_call_is_lost(executable, monkeypatch):
    monkeypatch.setattr(sys, "executable", executable)
    with WorkerPool([1]) as pool, pytest.raises(LostError):
        pool.result(pool.submit(os.getpid))


def test_where_no_thread_can_be_started_the_call_is_lost(monkeypatch):
    def fails(_):
        raise RuntimeError("can't start new thread")

    monkeypatch.setattr(threading.Thread, "start", fails)
    with WorkerPool([1]) as pool, pytest.raises(LostError):
        pool.result(pool.submit(os.getpid))


def test_a_call_ends_with_its_pool_and_at_once():
    start = time.perf_counter()
    with WorkerPool([1]) as pool:
        process = pool.result(pool.submit(os.getpid))
        asleep = pool.submit(time.sleep, 60)
        waiting = pool.submit(os.getpid)
    assert not runs(process)
    assert time.perf_counter() - start < 30
    for one in (asleep, waiting, pool.submit(os.getpid)):
        with pytest.raises(LostError):
            pool.result(one)


@pytest.mark.parametrize("modules", [[], ["sleeps"], ["holds"]])
@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere a thread looks, which may wait for a library")
def test_a_worker_ends_with_a_caller_that_is_killed_whatever_it_does(tmp_path, modules):
    """As while a large library is loaded: a thread that looks would come to its turn seconds later."""
    there = f"open({str(tmp_path / 'there')!r}, 'w').close()"
    (tmp_path / "sleeps.py").write_text(f"import time\n{there}\ntime.sleep(60)\n")
    (tmp_path / "holds.py").write_text(f"import re\n{there}\nre.match('(a+)+$', 'a' * 60 + 'b')\n")
    call = "time.sleep, 60" if modules else f"exec, {there + '; import time; time.sleep(60)'!r}"
    code = (
        "from mechwright.worker_pool.pool import WorkerPool; import time\n"
        f"pool = WorkerPool([1], {modules})\n"
        f"pool.submit({call})\n"
        "while not pool._workers[0]._process: time.sleep(0.01)\n"
        "print(pool._workers[0]._process.pid, flush=True); time.sleep(60)"
    )
    with subprocess.Popen(
        [sys.executable, "-c", code],
        stdout=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONPATH": f"{tmp_path}{os.pathsep}{os.environ.get('PYTHONPATH', '')}"},
    ) as caller:
        worker = int(caller.stdout.readline())
        end = time.monotonic() + 60
        while not (tmp_path / "there").exists() and time.monotonic() < end:
            time.sleep(0.02)
        caller.kill()
    end = time.monotonic() + 5
    while runs(worker) and time.monotonic() < end:
        time.sleep(0.02)
    left = runs(worker)
    if left:
        os.kill(worker, signal.SIGKILL)
    assert (tmp_path / "there").exists()
    assert not left


def runs(process):
    """Whether a process is there, and more than its number."""
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] not in "ZX"
    except FileNotFoundError:
        return False


class Heavy(Exporter):
    name, suffix = "heavy", ".hvy"
    modules = ("a_module_that_is_not_imported",)

    def part(self, part):
        return b""


class Light(Heavy):
    modules = ("os",)


PAIR = (
    'format = 1\nfamily = "elliptic-gears"\nname = "pair"\n[parameters]\nteeth = 21\nmodule = 2\n'
    "bore = 8\neccentricity = 0.1\n"
)


def pair(folder, command="build", formats=(), exporters=None):
    """A build of a pair of gears."""
    (folder / "pair.toml").write_text(PAIR)
    found = host()
    if exporters is not None:
        found = Host({**found.registered, Exporter: {one.name: Registered(one, "", "") for one in exporters}})
    return Build(folder / "pair.toml", found, Wanted(command, formats=formats))


def test_a_second_process_is_begun_only_where_it_gains_something(monkeypatch, tmp_path):
    assert available_cores() >= 1
    for exporter, count, command, begun in (
        (Heavy, 2, "build", True),
        (Heavy, 1, "build", False),
        (Heavy, 2, "model", False),
        (Light, 2, "build", False),
    ):
        monkeypatch.setattr("mechwright_cad.solid_models.available_cores", lambda count=count: count)
        monkeypatch.setattr(exporter, "name", "step")
        with pair(tmp_path, command, exporters=[exporter()]) as build:
            SolidFiles().warm(build)
            assert SolidFiles().late(build) is begun
            assert Interference().late(build) is begun


MET = Finding("interference.collision", Severity.ERROR, "", "one and two stand in each other")


@pytest.mark.parametrize("fault", [None, ProofError("the program gouges"), ToolError("no such mill")])
def test_a_collision_that_a_second_process_finds_is_told_first(fault, tmp_path, monkeypatch, command_line):
    class Programs:
        jobs = findings = ()

        @property
        def proven_programs(self):
            if fault is not None:
                raise fault
            return ()

    def nothing(self, build):
        return {}

    for module in ("as_made", "pages.seen", "machining"):  # the first two have names of their own
        monkeypatch.setattr(f"mechwright_cam.{module}.Machining", lambda build: Programs())
    for page in ("DrawingFiles", "ProgramFiles", "ProofFile", "SetupSheets", "JobPages"):
        monkeypatch.setattr(f"mechwright_cam.pages.registered.{page}.files", nothing)
        monkeypatch.setattr(f"mechwright_cam.pages.registered.{page}.names", lambda self, build, wanted: [])
    monkeypatch.setattr("mechwright_cam.pages.certificate.page.Certificates.files", nothing)
    monkeypatch.setattr(Solids, "warm", lambda self: None)
    monkeypatch.setattr(Solids, "begin", lambda self: None)
    monkeypatch.setattr(Solids, "in_second_process", True)
    monkeypatch.setattr(Solids, "collisions", lambda self: [MET])
    monkeypatch.setattr(Solids, "files", lambda self: pytest.fail("there are none"))
    (tmp_path / "pair.toml").write_text('format = 1\nfamily = "elliptic-gears"\n[parameters]\nteeth = 21\n')
    code, _, said = command_line("build", tmp_path / "pair.toml", "-o", tmp_path / "out")
    assert code == 1, said
    assert str(MET) in said
    assert "gouges" not in said
    assert not (tmp_path / "out").exists()
    monkeypatch.setattr(Solids, "collisions", lambda self: [])
    monkeypatch.setattr(Solids, "files", lambda self: {"x.step": b"x"})
    monkeypatch.setattr(Solids, "page", lambda self: {"motion.html": b"x"})
    monkeypatch.setattr(Solids, "masses", lambda self: {"gear": 1.0})
    code, _, said = command_line("build", tmp_path / "pair.toml", "-o", tmp_path / "out")
    assert code == {ProofError: 1, ToolError: 2}.get(type(fault), 0), said
    assert fault is None or str(fault) in said
    assert (tmp_path / "out" / "x.step").exists() is (fault is None)


@by_night
def test_a_second_process_compares_and_writes_the_same(tmp_path):
    with pair(tmp_path, "model", ("step", "stl")) as build:
        motion, sample = build.pose
        exporters = [build.host.get(Exporter, name) for name in ("step", "stl")]
        with WorkerPool([1]) as pool:
            work = Work(build.design, exporters, motion, sample)
            findings, files, grams = pool.result(pool.submit(collisions_and_files, work))
        solids = build.made(Solids)
        assert not solids.in_second_process
        assert files.keys() == {"gear.step", "gear.stl", "assembly.step", "motion.html"}
        assert solids.files() == {name: text for name, text in files.items() if name != "motion.html"}
        assert solids.page() == {"motion.html": files["motion.html"]}
        assert [f.code for f in findings] == ["interference.clear"]
        assert solids.collisions() == findings
        assert solids.masses() == grams
        assert grams.keys() == {"gear"}
