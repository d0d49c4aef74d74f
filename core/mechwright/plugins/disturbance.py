"""What loading a plugin may spoil for everybody else in a process, beside the ground that is set back.

Files that are open, modules and what stands in them, limits, timers, threads: none of it can be set back with
certainty, so a plugin that changes it is not used. It may add names, and change those that are private.
"""

import importlib.abc
import importlib.machinery
import os
import signal
import sys
import threading
import types
from collections.abc import Callable, Iterator, Sequence
from typing import Any

_LIBRARIES = sys.stdlib_module_names | {
    *(
        "mechwright",
        "mechwright_cad",
        "mechwright_cam",
        "numpy",
        "scipy",
        "shapely",
        "pydantic",
        "pydantic_core",
    ),
    *("pluggy", "typer", "rich", "click", "ezdxf", "cadquery", "OCP", "jinja2", "numba", "pyarrow"),
}
"""Packages that this program uses, of which a plugin changes nothing."""
_OURS_TO_SET = frozenset((("sys", "stdout"), ("sys", "stderr"), ("warnings", "showwarning")))
"""Names that the guard itself sets back."""
_HOOKS = ("excepthook", "unraisablehook", "displayhook", "breakpointhook")


class Disturbance(importlib.abc.MetaPathFinder):
    """What others use, noted at once, or as soon as a module of it is imported."""

    def __init__(self) -> None:
        self._modules: dict[str, types.ModuleType] = {}
        self._names: dict[str, dict[str, Any]] = {}
        self._classes: dict[type, dict[str, Any]] = {}
        for name, module in list(sys.modules.items()):
            self._note(name, module)
        self._files = _files()
        self._process, self._environment = _process(), set(os.environ)
        self._threads = set(threading.enumerate())
        self._forks: list[int] = []
        if hasattr(os, "register_at_fork"):
            os.register_at_fork(after_in_parent=lambda: self._forks.append(1))
        self._finders, self._path, self._hooks = list(sys.meta_path), list(sys.path), list(sys.path_hooks)
        # What looks is kept apart from what may be spoilt.
        self._looks: tuple[Callable[[], Iterator[str]], ...] = (
            self._of_files, self._of_modules, self._of_names, self._of_process, self._of_imports
        )  # fmt: skip
        sys.meta_path.insert(0, self)

    def find_spec(
        self, name: str, path: Sequence[str] | None, target: types.ModuleType | None = None
    ) -> importlib.machinery.ModuleSpec | None:
        """Have a module of a library noted when it has been executed."""
        if name.partition(".")[0] not in _LIBRARIES:
            return None
        spec = importlib.machinery.PathFinder.find_spec(name, path, target)
        if isinstance(spec and spec.loader, importlib.machinery.SourceFileLoader):
            assert spec is not None  # noqa: S101 - it has a loader
            spec.loader = _Noting(name, str(spec.origin), self._note)
        return spec

    def found(self) -> str:
        """What was disturbed since, in words that follow a plugin's name; empty where nothing was."""
        if self in sys.meta_path:
            sys.meta_path.remove(self)
        else:
            return "changes how modules are found (sys.meta_path), which is everybody's"
        return next((said for look in self._looks for said in look()), "")

    def _note(self, name: str, module: Any) -> None:
        if not isinstance(module, types.ModuleType) or name == "__main__":
            return
        self._modules[name] = module
        if name.partition(".")[0] in _LIBRARIES:
            names = {key: value for key, value in vars(module).items() if _is_used(key, value)}
            self._names[name] = names
            for value in names.values():
                if isinstance(value, type) and value.__module__ == name:
                    self._classes[value] = {k: v for k, v in vars(value).items() if _is_used(k, v)}

    def _of_files(self) -> Iterator[str]:
        now = _files()
        for number, was in self._files.items():
            if now.get(number) != was:
                yield f"closes or replaces the open file {number}, which is everybody's"

    def _of_modules(self) -> Iterator[str]:
        for name, module in self._modules.items():
            if sys.modules.get(name) is not module and name.partition(".")[0] in _LIBRARIES:
                yield f"replaces or removes the module {name}, which is everybody's"
        for name, module in list(sys.modules.items()):
            if name in _LIBRARIES and name not in self._modules:
                spec = getattr(module, "__spec__", None)
                if spec is None or spec.loader is None:
                    yield f"replaces the module {name}, which is everybody's"

    def _of_names(self) -> Iterator[str]:
        for name, names in self._names.items():
            now = vars(self._modules[name])
            for key, value in names.items():
                if now.get(key) is not value and (name, key) not in _OURS_TO_SET:
                    yield f"changes {name}.{key}, which is everybody's"
        for cls, names in self._classes.items():
            own = vars(cls)
            for key, value in names.items():
                if own.get(key) is not value:
                    yield f"changes {cls.__module__}.{cls.__qualname__}.{key}, which is everybody's"

    def _of_process(self) -> Iterator[str]:
        now = _process()
        for name, was in self._process.items():
            if now[name] != was:
                yield f"changes {name} of the process, which is everybody's"
        if gone := sorted(self._environment - set(os.environ)):
            first = "PATH" if "PATH" in gone else gone[0]
            yield f"removes {first} from the environment, which is everybody's"
        if self._forks:
            yield "forks the process"
        for one in threading.enumerate():
            if one not in self._threads and one.is_alive():
                yield f"leaves the thread {one.name!r} running; start it when it is needed"

    def _of_imports(self) -> Iterator[str]:
        for what, before, after in (
            ("meta_path", self._finders, sys.meta_path),
            ("path", self._path, sys.path),
            ("path_hooks", self._hooks, sys.path_hooks),
        ):
            if any(one not in after for one in before):
                yield f"removes what stands in sys.{what}, which is everybody's"


class _Noting(importlib.machinery.SourceFileLoader):
    """Notes a module as soon as it is executed."""

    def __init__(self, name: str, path: str, note: Callable[[str, Any], None]) -> None:
        super().__init__(name, path)
        self._note = note

    def exec_module(self, module: types.ModuleType) -> None:
        """Execute it, and note it."""
        super().exec_module(module)
        self._note(module.__name__, module)


def _is_used(name: str, value: Any) -> bool:
    """Whether others may call what a module or class has under a name; pydantic sets its own names later."""
    if name.startswith(("__pydantic", "_abc_")) or (name.startswith("_") and not name.endswith("__")):
        return False
    return callable(value) or isinstance(value, (property, classmethod, staticmethod))


def _files() -> dict[int, tuple[int, ...]]:
    """Number to what is open under it."""
    found: dict[int, tuple[int, ...]] = {}
    for number in range(64):
        try:
            status = os.fstat(number)
        except OSError:
            continue
        found[number] = (status.st_dev, status.st_ino, status.st_mode)
    return found


def _process() -> dict[str, Any]:
    """Limits, timers, and what the interpreter calls."""
    found: dict[str, Any] = {f"sys.{name}": getattr(sys, name, None) for name in _HOOKS}
    found["threading.excepthook"] = threading.excepthook
    found["the tracing function"] = sys.gettrace()
    found["the profiling function"] = sys.getprofile()
    if hasattr(signal, "getitimer"):
        timers = (signal.ITIMER_VIRTUAL, signal.ITIMER_PROF)
        found["a timer"] = [signal.getitimer(one)[0] > 0 for one in timers]
    if hasattr(os, "getpriority"):
        found["the priority"] = os.getpriority(os.PRIO_PROCESS, 0)
    try:
        import resource
    except ImportError:  # not on Windows
        return found
    for name in dir(resource):
        if name.startswith("RLIMIT_"):
            found[f"the limit {name}"] = resource.getrlimit(getattr(resource, name))
    return found
