"""Tests that are collected once, and run in forks: which lines each reaches, and what it says of a mutant.

A mutant of a function is planted by giving the function that is in memory another code, in a fork of a
process that has loaded and collected everything: what is left to do are its tests. What stands outside of
functions, and whoever survived, is tried by a new interpreter on a copy of the project (:func:`afresh`).
"""

import contextlib
import gc
import importlib
import os
import shutil
import signal
import subprocess
import sys
import time
from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from types import CodeType, FrameType, FunctionType
from typing import Any

import pytest
from _pytest.config import _prepareconfig  # noqa: PLC2701 - pytest's own way in runs the tests at once
from code_mutants import Mutant

ROOT = Path(__file__).parents[1]
ROOMS = ("core", "cam", "plugins")
COPIED = (
    *ROOMS,
    "tests",
    "docs",
    "examples",
    "benchmarks",
    "pyproject.toml",
    "README.md",
    "CHANGELOG.md",
    "changelog.d",
)
COMPILED = frozenset({"core/mechwright/mechanics/compiled.py"})
"""Files whose functions become machine code, which is kept by the name of the file."""
QUIET = ("-x", "-q", "-s", "--no-header", "--tb=no", "-p", "no:cacheprovider")

ENOUGH = 200
"""Lines without a new one, after which a call is watched no longer: a loop goes on as it began."""

Reached = dict[str, tuple[float, dict[str, list[int]]]]
"""Test to the seconds that it takes and the lines that it reaches, by file."""


class Suite:
    """The tests of some files, collected in this process, and the modules that faults are planted in."""

    def __init__(self, files: Iterable[str], temporary: Path, paths: Iterable[str] = ()) -> None:
        os.chdir(ROOT)
        sys.dont_write_bytecode = True
        arguments = [*QUIET, f"--basetemp={temporary}", *files]
        self.config = _prepareconfig(arguments)
        self.config._do_configure()
        self.session = pytest.Session.from_config(self.config)
        self.config.hook.pytest_sessionstart(session=self.session)
        self.session.perform_collect()
        self.items = {item.nodeid: item for item in self.session.items}
        for path in paths:  # a test may load them on its way alone
            importlib.import_module(module(path))
        self.functions: dict[tuple[str, str, int], list[FunctionType]] = defaultdict(list)
        gc.unfreeze()
        for one in gc.get_objects():
            if type(one) is FunctionType:
                code = one.__code__
                self.functions[code.co_filename, code.co_qualname, code.co_firstlineno].append(one)
        gc.freeze()

    def run(self, tests: Iterable[str], before: Callable[[], object] = lambda: None) -> bool:
        """Whether tests pass in this process, up to the first that does not."""
        before()
        self.session.items = [self.items[name] for name in tests]
        with contextlib.suppress(self.session.Failed):
            self.config.hook.pytest_runtestloop(session=self.session)
        return self.session.testsfailed == 0

    def planted(self, mutant: Mutant, text: str) -> bool:
        """Give a function of this process the code of a mutant; False where that is not possible."""
        if not mutant.function or mutant.path in COMPILED:
            return False
        file, done = str(ROOT / mutant.path), False
        new = {(one.co_qualname, one.co_firstlineno): one for one in codes(mutant.applied(text), file)}
        for old in codes(text, file):
            place = old.co_qualname, old.co_firstlineno
            if old.co_qualname == mutant.function and new.get(place, old) != old:
                for function in self.functions.get((file, *place), ()):
                    with contextlib.suppress(ValueError):  # it has other free variables
                        function.__code__ = new[place]
                        done = True
        return done


def module(path: str) -> str:
    """The name by which a file of the project is imported: the tail of its path."""
    return ".".join(Path(path).with_suffix("").parts[1:]).removesuffix(".__init__")


def codes(text: str, file: str) -> list[CodeType]:
    """All code in a module, the outer one before what stands in it."""
    found = [compile(text, file, "exec", dont_inherit=True)]
    for one in found:
        found += [inner for inner in one.co_consts if isinstance(inner, CodeType)]
    return found


def forked(work: Callable[[], int], seconds: float) -> int | None:
    """The exit code of a fork that does some work in silence; None where it takes longer."""
    child = os.fork()
    if not child:
        os.setsid()
        sink = os.open(os.devnull, os.O_RDWR)
        for number in (0, 1, 2):
            os.dup2(sink, number)
        code = 70
        with contextlib.suppress(BaseException):
            code = work()
        os._exit(code)
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        done, status = os.waitpid(child, os.WNOHANG)
        if done:
            return os.waitstatus_to_exitcode(status)
        time.sleep(0.01)
    with contextlib.suppress(ProcessLookupError):
        os.killpg(child, signal.SIGKILL)
    os.waitpid(child, 0)
    return None


class Reaching:
    """Which lines of some files each test that passes reaches."""

    def __init__(self, starts: tuple[str, ...]) -> None:
        self.starts = tuple(str(ROOT / start) for start in starts)
        self.found: Reached = {}
        self.seen: dict[CodeType, set[int]] = {}
        self.passed = True

    def _called(self, frame: FrameType, *_: object) -> Any:
        code = frame.f_code
        if not code.co_filename.startswith(self.starts):
            return None
        lines, again = self.seen.setdefault(code, set()), 0

        def line(frame: FrameType, *_: object) -> Any:
            nonlocal again
            if frame.f_lineno in lines:
                again += 1
                frame.f_trace_lines = again < ENOUGH
            else:
                again = 0
                lines.add(frame.f_lineno)
            return line

        lines.add(frame.f_lineno)
        return line

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Any:
        self.seen, self.passed, begun = {}, True, time.process_time()
        sys.settrace(self._called)
        try:
            result = yield
        finally:
            sys.settrace(None)
        if self.passed:
            files: dict[str, set[int]] = defaultdict(set)
            for code, lines in self.seen.items():
                files[code.co_filename.removeprefix(f"{ROOT}{os.sep}")] |= lines
            taken = round(time.process_time() - begun, 3)
            self.found[item.nodeid] = taken, {file: sorted(lines) for file, lines in files.items()}
        return result

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        self.passed &= report.passed


def tree(place: Path) -> Path:
    """A copy of the project in which files may be changed; made once."""
    if not place.exists():
        for name in COPIED:
            source = ROOT / name
            if source.is_dir():
                shutil.copytree(source, place / name, ignore=shutil.ignore_patterns("__pycache__"))
            else:
                place.mkdir(parents=True, exist_ok=True)
                shutil.copy(source, place / name)
    return place


def afresh(copy: Path, mutant: Mutant, tests: Mapping[str, float]) -> bool | None:
    """Whether tests pass in a new interpreter on a copy with a mutant; None where they take far too long."""
    path = copy / mutant.path
    text = path.read_text(encoding="utf-8")
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(str(copy / room) for room in ROOMS)}
    environment |= {"PYTHONDONTWRITEBYTECODE": "1"}
    path.write_text(mutant.applied(text), encoding="utf-8")
    try:
        done = subprocess.run(
            [sys.executable, "-m", "pytest", *QUIET, *tests],
            cwd=copy,
            env=environment,
            capture_output=True,
            check=False,
            timeout=120 + 8 * sum(tests.values()),
        )
    except subprocess.TimeoutExpired:
        return None
    finally:
        path.write_text(text, encoding="utf-8")
    return done.returncode == 0
