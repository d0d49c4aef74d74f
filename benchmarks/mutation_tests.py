"""Which tests run which functions, and the tests of a mutant run in a process of their own.

A *tree* is a copy of the project in which files are changed; processes that tests start see it too, by
``PYTHONPATH``. Pytest runs in forks of a process that has loaded the libraries, none of them ours.
"""

import contextlib
import importlib
import json
import os
import shutil
import signal
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from types import CodeType, FrameType
from typing import Any

import pytest
from code_mutants import executed_names

ROOT = Path(__file__).parents[1]
ROOMS = ("core", "cam", "plugins")
COPIED = (*ROOMS, "tests", "docs", "examples", "benchmarks", "pyproject.toml", "README.md", "CHANGELOG.md")
LIBRARIES = (
    "numpy",
    "scipy.optimize",
    "scipy.interpolate",
    "shapely",
    "pydantic",
    "typer",
    "jinja2",
    "ezdxf",
)
DISABLED = ("-x", "-q", "--no-header", "--tb=no", "-p", "no:cacheprovider")


def prepared(place: Path) -> Path:
    """A tree, in which this process stands from now on; libraries are loaded."""
    tree = place / "tree"
    if not tree.exists():
        for name in COPIED:
            source = ROOT / name
            if source.is_dir():
                shutil.copytree(source, tree / name, ignore=shutil.ignore_patterns("__pycache__"))
            else:
                shutil.copy(source, tree / name)
    os.environ |= {
        "PYTHONPATH": os.pathsep.join(str(tree / room) for room in ROOMS),
        "OMP_NUM_THREADS": "1",
        "OPENBLAS_NUM_THREADS": "1",
    }
    sys.path[:0] = [str(tree / room) for room in ROOMS]
    for name in LIBRARIES:
        importlib.import_module(name)
    os.chdir(tree)
    return tree


class Watching:
    """Which functions of the tree each test that passes calls, and how long it takes, s."""

    def __init__(self, tree: Path) -> None:
        self.tree = f"{tree}{os.sep}"
        self.found: dict[str, tuple[float, list[str]]] = {}
        self.seen: set[CodeType] = set()
        self.passed = True

    def _called(self, frame: FrameType, *_: object) -> None:
        self.seen.add(frame.f_code)

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Iterator[None]:
        self.seen, self.passed, begun = set(), True, time.perf_counter()
        sys.settrace(self._called)
        try:
            result = yield
        finally:
            sys.settrace(None)
        if self.passed:
            names = {self._name(code) for code in self.seen if code.co_filename.startswith(self.tree)}
            self.found[item.nodeid] = (round(time.perf_counter() - begun, 3), sorted(filter(None, names)))
        return result

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        self.passed &= report.passed

    def _name(self, code: CodeType) -> str:
        path = code.co_filename.removeprefix(self.tree)
        if not path.startswith(ROOMS) or code.co_name == "<module>":
            return ""
        return f"{path}:{executed_names(code.co_qualname)}"


def forked(
    arguments: list[str], seconds: float, plugin: object = None, told: Path | None = None
) -> int | None:
    """Exit code of pytest in a fork; None where it takes longer. What a plugin saw goes to a file."""
    child = os.fork()
    if not child:
        os.setsid()
        sink = os.open(os.devnull, os.O_RDWR)
        for number in (0, 1, 2):
            os.dup2(sink, number)
        sys.dont_write_bytecode = True
        os.environ["PYTHONDONTWRITEBYTECODE"] = "1"
        code = 70
        with contextlib.suppress(BaseException):
            code = int(pytest.main(arguments, plugins=[plugin] if plugin else []))
            if isinstance(plugin, Watching) and told is not None:
                told.write_text(json.dumps(plugin.found), encoding="utf-8")
        os._exit(code)
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        done, status = os.waitpid(child, os.WNOHANG)
        if done:
            return os.waitstatus_to_exitcode(status)
        time.sleep(0.02)
    with contextlib.suppress(ProcessLookupError):
        os.killpg(child, signal.SIGKILL)
    os.waitpid(child, 0)
    return None


def watched(tree: Path, file: str, seconds: float) -> dict[str, Any] | None:
    """What the tests of a file call; None where they take longer or cannot be collected."""
    told = tree.parent / f"watched-{os.getpid()}"
    told.unlink(missing_ok=True)
    arguments = [one for one in DISABLED if one != "-x"]
    forked([*arguments, file], seconds, Watching(tree), told)
    return json.loads(told.read_text(encoding="utf-8")) if told.exists() else None
