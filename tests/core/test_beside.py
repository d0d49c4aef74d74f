"""Work in a second interpreter: what it gives, and that nothing is lost where it fails."""

import os
import signal
import subprocess
import sys
import time
from contextlib import closing
from pathlib import Path

import pytest
from by_night import by_night

from mechwright.beside import Beside
from mechwright.build import Build, Wanted
from mechwright.contracts.exporter import Exporter
from mechwright.contracts.finding import Finding, Severity
from mechwright.cores import cores
from mechwright.errors import ProofError, ToolError
from mechwright.plugins.host import Host, Registered, host
from mechwright_cad.making import Solids, Work, compared_and_made
from mechwright_cad.pages import Interference, SolidFiles

HERE = os.getpid()


def test_a_call_runs_in_another_process_that_has_the_modules_already():
    with closing(Beside(["colorsys", "no_such_module"])) as second:
        second.ask(eval, "__import__('os').getpid(), 'colorsys' in __import__('sys').modules")
        process, imported = second.result(tuple)
    assert process != HERE
    assert imported


WHERE = "__import__('os').getpid()"


@pytest.mark.parametrize(
    "fault",
    [
        f"{HERE} if {WHERE} == {HERE} else __import__('os')._exit(3)",
        f"{HERE} // ({WHERE} == {HERE})",
        f"{HERE} if {WHERE} == {HERE} else 'another type'",
        f"{HERE} if {WHERE} == {HERE} else __import__('threading').Lock()",  # no copy of it
    ],
    ids=["dies", "raises", "another-type", "no-copy"],  # the process number is another at every run
)
def test_what_goes_wrong_there_is_done_here(fault):
    with closing(Beside([])) as second:
        second.ask(eval, fault)
        assert second.result(int) == HERE


@pytest.mark.skipif(not hasattr(signal, "SIGSTOP"), reason="no way to stop a process here")
def test_a_long_request_and_a_long_answer_do_not_wait_for_each_other():
    long = b"x" * 3_000_000
    with closing(Beside([])) as second:
        # Asking returns though nobody reads: the other end is stopped, as it is by a long import.
        second._process.send_signal(signal.SIGSTOP)
        second.ask(bytes.upper, long)
        second._process.send_signal(signal.SIGCONT)
        assert second.result(bytes) == long.upper()
    with closing(Beside([])) as second:  # ended before it has read what it is sent
        second.ask(bytes.upper, long)


def test_an_error_is_told_as_if_there_were_no_second_process():
    with closing(Beside([])) as second:
        second.ask(int, "twelve")
        with pytest.raises(ValueError, match="twelve"):
            second.result(int)


def test_what_cannot_be_copied_is_done_here():
    with closing(Beside([])) as second:
        second.ask(lambda: os.getpid())
        assert second.result(int) == HERE


@pytest.mark.parametrize("executable", ["", "/nowhere/python"])
def test_where_no_process_can_be_started_all_is_done_here(executable, monkeypatch):
    monkeypatch.setattr(sys, "executable", executable)
    with closing(Beside([])) as second:
        second.ask(os.getpid)
        assert second.result(int) == HERE


def test_the_second_interpreter_ends_with_its_caller_and_at_once():
    start = time.perf_counter()
    with closing(Beside([])) as second:
        second.ask(time.sleep, 60)
        process = second._process
    assert process.returncode is not None
    assert time.perf_counter() - start < 30
    orphan = Beside([])
    orphan.ask(time.sleep, 60)
    orphan._process.stdin.close()  # as when the caller dies
    assert orphan._process.wait(30) == 1
    orphan.close()


@pytest.mark.skipif(
    sys.platform != "linux", reason="elsewhere a thread looks, which has to wait for a library"
)
def test_a_second_interpreter_that_lets_no_thread_run_ends_with_a_caller_that_is_killed(tmp_path):
    """As while a large library is loaded: the thread that looked came to its turn seconds later."""
    (tmp_path / "holds.py").write_text(
        f"import re\nopen({str(tmp_path / 'there')!r}, 'w').close()\nre.match('(a+)+$', 'a' * 60 + 'b')\n"
    )
    begins = (
        "from mechwright.beside import Beside; import time; b = Beside(['holds']);"
        "print(b._process.pid, flush=True); time.sleep(60)"
    )
    with subprocess.Popen(
        [sys.executable, "-c", begins],
        stdout=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONPATH": str(tmp_path)},
    ) as caller:
        second = int(caller.stdout.readline())
        end = time.monotonic() + 60
        while not (tmp_path / "there").exists() and time.monotonic() < end:
            time.sleep(0.02)
        caller.kill()
    end = time.monotonic() + 5
    while runs(second) and time.monotonic() < end:
        time.sleep(0.02)
    left = runs(second)
    if left:
        os.kill(second, signal.SIGKILL)
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
    assert cores() >= 1
    for exporter, count, command, begun in (
        (Heavy, 2, "build", True),
        (Heavy, 1, "build", False),
        (Heavy, 2, "model", False),
        (Light, 2, "build", False),
    ):
        monkeypatch.setattr("mechwright_cad.making.cores", lambda count=count: count)
        monkeypatch.setattr(exporter, "name", "step")
        with pair(tmp_path, command, exporters=[exporter()]) as build:
            SolidFiles().warm(build)
            assert SolidFiles().late(build) is begun
            assert Interference().late(build) is begun


MET = Finding("interference.collision", Severity.ERROR, "", "one and two stand in each other")


@pytest.mark.parametrize("fault", [None, ProofError("the program gouges"), ToolError("no such mill")])
def test_a_collision_that_a_second_process_finds_is_told_first(fault, tmp_path, monkeypatch, command_line):
    class Programs:
        made = jobs = ()

        @property
        def findings(self):
            if fault is not None:
                raise fault
            return []

    def nothing(self, build):
        return {}

    for module in ("as_made", "pages.seen", "machining"):  # the first two have names of their own
        monkeypatch.setattr(f"mechwright_cam.{module}.Machining", lambda build: Programs())
    for page in ("DrawingFiles", "ProgramFiles", "ProofFile", "SetupSheets"):
        monkeypatch.setattr(f"mechwright_cam.pages.registered.{page}.files", nothing)
        monkeypatch.setattr(f"mechwright_cam.pages.registered.{page}.names", lambda self, build, wanted: [])
    monkeypatch.setattr(Solids, "warm", lambda self: None)
    monkeypatch.setattr(Solids, "begin", lambda self: None)
    monkeypatch.setattr(Solids, "beside", True)
    monkeypatch.setattr(Solids, "collisions", lambda self: [MET])
    monkeypatch.setattr(Solids, "files", lambda self: pytest.fail("there are none"))
    (tmp_path / "pair.toml").write_text('format = 1\nfamily = "elliptic-gears"\n[parameters]\nteeth = 21\n')
    code, _, said = command_line("build", tmp_path / "pair.toml", "-o", tmp_path / "out")
    assert code == 1, said
    assert str(MET) in said
    assert "gouges" not in said
    assert "mill" not in said
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
        with closing(Beside([])) as second:
            second.ask(compared_and_made, Work(build.design, exporters, motion, sample))
            findings, files, grams = second.result(tuple)
        solids = build.made(Solids)
        assert not solids.beside
        assert files.keys() == {"gear.step", "gear.stl", "assembly.step", "motion.html"}
        assert solids.files() == {name: text for name, text in files.items() if name != "motion.html"}
        assert solids.page() == {"motion.html": files["motion.html"]}
        assert [f.code for f in findings] == ["interference.clear"]
        assert solids.collisions() == findings
        assert solids.masses() == grams
        assert grams.keys() == {"gear"}
