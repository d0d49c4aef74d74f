"""Work in a second interpreter: what it gives, and that nothing is lost where it fails."""

import os
import signal
import sys
import time

import pytest
from mechwright.cli.solids import SolidWork, Work, compared_and_made

from mechwright.beside import Beside
from mechwright.contracts.exporter import Exporter
from mechwright.contracts.finding import Finding, Severity
from mechwright.cores import cores
from mechwright.designs.design import load
from mechwright.errors import ProofError, ToolError
from mechwright.plugins.host import host

HERE = os.getpid()


def test_a_call_runs_in_another_process_that_has_the_modules_already():
    with Beside(["colorsys", "no_such_module"]) as second:
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
    with Beside([]) as second:
        second.ask(eval, fault)
        assert second.result(int) == HERE


@pytest.mark.skipif(not hasattr(signal, "SIGSTOP"), reason="no way to stop a process here")
def test_a_long_request_and_a_long_answer_do_not_wait_for_each_other():
    long = b"x" * 3_000_000
    with Beside([]) as second:
        # Asking returns though nobody reads: the other end is stopped, as it is by a long import.
        second._process.send_signal(signal.SIGSTOP)
        second.ask(bytes.upper, long)
        second._process.send_signal(signal.SIGCONT)
        assert second.result(bytes) == long.upper()
    with Beside([]) as second:  # ended before it has read what it is sent
        second.ask(bytes.upper, long)


def test_an_error_is_told_as_if_there_were_no_second_process():
    with Beside([]) as second:
        second.ask(int, "twelve")
        with pytest.raises(ValueError, match="twelve"):
            second.result(int)


def test_what_cannot_be_copied_is_done_here():
    with Beside([]) as second:
        second.ask(lambda: os.getpid())
        assert second.result(int) == HERE


@pytest.mark.parametrize("executable", ["", "/nowhere/python"])
def test_where_no_process_can_be_started_all_is_done_here(executable, monkeypatch):
    monkeypatch.setattr(sys, "executable", executable)
    with Beside([]) as second:
        second.ask(os.getpid)
        assert second.result(int) == HERE


def test_the_second_interpreter_ends_with_its_caller_and_at_once():
    start = time.perf_counter()
    with Beside([]) as second:
        second.ask(time.sleep, 60)
        process = second._process
    assert process.returncode is not None
    assert time.perf_counter() - start < 30
    orphan = Beside([])
    orphan.ask(time.sleep, 60)
    orphan._process.stdin.close()  # as when the caller dies
    assert orphan._process.wait(30) == 1
    orphan.close()


class Heavy(Exporter):
    name, suffix = "heavy", ".hvy"
    modules = ("a_module_that_is_not_imported",)

    def part(self, part):
        return b""


class Light(Heavy):
    modules = ("os",)


def test_a_second_process_is_begun_only_where_it_gains_something(monkeypatch):
    assert cores() >= 1
    for exporter, count, wanted, begun in (
        (Heavy, 2, True, True),
        (Heavy, 1, True, False),
        (Heavy, 2, False, False),
        (Light, 2, True, False),
    ):
        monkeypatch.setattr("mechwright.cli.solids.cores", lambda count=count: count)
        with SolidWork([exporter()], build=wanted) as work:
            assert work.beside is begun


MET = Finding("interference.collision", Severity.ERROR, "", "one and two stand in each other")


class Late(SolidWork):
    """A second process that has found a collision."""

    beside = True

    def __init__(self, exporters, *, build):
        super().__init__(exporters, build=False)

    def begin(self, design, motion, sample):
        pass

    def collisions(self):
        return [MET]

    def files(self):
        raise AssertionError("there are none")


@pytest.mark.parametrize("fault", [None, ProofError("the program gouges"), ToolError("no such mill")])
def test_a_collision_that_a_second_process_finds_is_told_first(fault, tmp_path, monkeypatch, command_line):
    def programs(*_):
        if fault is not None:
            raise fault
        return []

    monkeypatch.setattr("mechwright.cli.work.SolidWork", Late)
    monkeypatch.setattr("mechwright.cli.work._programs", programs)
    (tmp_path / "pair.toml").write_text('format = 1\nfamily = "elliptic-gears"\n[parameters]\nteeth = 21\n')
    code, _, said = command_line("build", tmp_path / "pair.toml", "-o", tmp_path / "out")
    assert code == 1
    assert str(MET) in said
    assert "gouges" not in said
    assert "mill" not in said
    assert not (tmp_path / "out").exists()
    monkeypatch.setattr(Late, "collisions", lambda self: [])
    monkeypatch.setattr(Late, "files", lambda self: {"x.step": b"x"})
    code, _, said = command_line("build", tmp_path / "pair.toml", "-o", tmp_path / "out")
    assert code == {ProofError: 1, ToolError: 2}.get(type(fault), 0)
    assert fault is None or str(fault) in said
    assert (tmp_path / "out" / "x.step").exists() is (fault is None)


def test_a_second_process_compares_and_writes_the_same(tmp_path):
    (tmp_path / "pair.toml").write_text(
        'format = 1\nfamily = "elliptic-gears"\nname = "pair"\n[parameters]\nteeth = 21\nmodule = 2\n'
        "bore = 8\neccentricity = 0.1\n"
    )
    found = host()
    design = load(tmp_path / "pair.toml", found)
    exporters = [found.get(Exporter, name) for name in ("step", "stl")]
    motion = design.family.solve(design.params, 2)
    with Beside([]) as second:
        second.ask(compared_and_made, Work(design, exporters, motion, 1))
        findings, files = second.result(tuple)
    with SolidWork(exporters, build=False) as work:
        work.begin(design, motion, 1)
        assert not work.beside
        assert files.keys() == {"gear.step", "gear.stl", "assembly.step", "motion.html"}
        assert work.files() == {name: text for name, text in files.items() if name != "motion.html"}
        assert [f.code for f in findings] == ["interference.clear"]
        assert work.collisions() == findings
