"""What loading a plugin may spoil for everybody else in a process, beside the ground that is set back.

Files that are open, modules and what stands in them, limits, timers, threads: none of it can be set back
with certainty, so a plugin that changes it is not used. It may add names that hide no others, and change
those that are private.
"""

import builtins
import dataclasses
import importlib.abc
import importlib.machinery
import numbers
import os
import sys
import threading
import types
from collections import abc
from collections.abc import Callable, Iterator, Sequence
from importlib.metadata import distributions
from itertools import product
from typing import Any

from mechwright.plugins.host import BUILT_IN
from mechwright.systems import on_fork, process_state

_OWN = frozenset(
    (
        BUILT_IN,
        *(
            point.module.partition(".")[0]
            for one in distributions(name=BUILT_IN)
            for point in one.entry_points
        ),
    )
)
"""Packages of this program."""
_LIBRARIES = (
    sys.stdlib_module_names
    | _OWN
    | {
        *("numpy", "scipy", "shapely", "pydantic", "pydantic_core", "pluggy", "typer", "rich", "click"),
        *("ezdxf", "cadquery", "OCP", "jinja2", "numba", "pyarrow"),
    }
)
"""Packages that this program uses, of which a plugin changes nothing."""
_WITH_CONSTANTS = frozenset(("math", "cmath", "numpy", "os", "string", "sys"))
"""Modules whose constants have small letters; those of others are known by their capitals."""
_VARYING = frozenset(("ps1", "ps2", "dont_write_bytecode", "tracebacklimit"))
"""Names of those modules that no constants stand under."""
_PLAIN = (bool, int, float, complex, str, bytes, tuple, frozenset)
_SETTINGS = "MECHWRIGHT_"
"""How variables of the environment begin by which a user sets this program."""
_OURS_TO_SET = frozenset((("sys", "stdout"), ("sys", "stderr"), ("warnings", "showwarning")))
"""Names that the guard itself sets back."""
_LIBRARIES_SET = frozenset((("PathFinder", "find_distributions"),))
"""Attributes of classes that libraries set while they are loaded: importlib_metadata, which pint brings."""
_HOOKS = ("excepthook", "unraisablehook", "displayhook", "breakpointhook")


class Disturbance(importlib.abc.MetaPathFinder):
    """What others use, noted at once, or as soon as a module of it is imported."""

    def __init__(self) -> None:
        self._modules: dict[str, types.ModuleType] = {}
        self._names: dict[str, dict[str, Any]] = {}
        self._classes: dict[type, dict[str, Any]] = {}
        self._inner: dict[tuple[str, str], tuple[Any, ...]] = {}
        self._hidden: dict[str, frozenset[str]] = {}
        for name, module in list(sys.modules.items()):
            self._note(name, module)
        self._files = _files()
        self._process, self._environment = _process(), dict(os.environ)
        self._threads = set(threading.enumerate())
        self._forks: list[int] = []
        on_fork(lambda: self._forks.append(1))
        self._audits = list(_audits())
        self._finders, self._path, self._hooks = list(sys.meta_path), list(sys.path), list(sys.path_hooks)
        # What looks is kept apart from what may be spoilt.
        self._looks: tuple[Callable[[], Iterator[str]], ...] = (
            self._of_audits, self._of_files, self._of_modules, self._of_names, self._of_process,
            self._of_imports, self._of_search,
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
            names = {key: value for key, value in vars(module).items() if _is_kept(name, key, value)}
            self._names[name] = names
            self._hidden[name] = _HIDEABLE & vars(module).keys()
            for key, value in names.items():
                if inner := _inner(name, value):
                    self._inner[name, key] = inner
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
                if (name, key) in _OURS_TO_SET:
                    continue
                if now.get(key) is not value or _inner(name, value) != self._inner.get((name, key), ()):
                    yield f"changes {name}.{key}, which is everybody's"
            if new := sorted(
                key
                for key in (_HIDEABLE & now.keys()) - self._hidden[name]
                if not isinstance(now[key], types.ModuleType)
            ):
                yield f"hides {new[0]} of Python in {name}, which is everybody's"
        for cls, names in self._classes.items():
            own = vars(cls)
            for key, value in names.items():
                if own.get(key) is not value and (cls.__name__, key) not in _LIBRARIES_SET:
                    yield f"changes {cls.__module__}.{cls.__qualname__}.{key}, which is everybody's"
            for key in own.keys() - names.keys():
                if _is_used(key, own[key]) and any(key in vars(one) for one in cls.__mro__[1:]):
                    yield f"changes {cls.__module__}.{cls.__qualname__}.{key}, which is everybody's"

    def _of_process(self) -> Iterator[str]:
        now = _process()
        for name, was in self._process.items():
            if now[name] != was:
                yield f"changes {name} of the process, which is everybody's"
        settings = (one for one in os.environ if one.startswith(_SETTINGS))
        if other := sorted(one for one in settings if self._environment.get(one) != os.environ[one]):
            yield f"changes {other[0]} of the environment, which the user sets"
        if gone := sorted(self._environment.keys() - os.environ.keys()):
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
        if wrong := [one for one in sys.path if not isinstance(one, str)]:
            yield f"puts {wrong[0]!r:.80} into sys.path, which has texts alone"

    def _of_audits(self) -> Iterator[str]:
        if _audits() != self._audits:
            yield "listens to all that Python does (sys.addaudithook), which nobody can end"

    def _of_search(self) -> Iterator[str]:
        """Whether a module that has not been imported yet would be another one."""
        if (self._finders, self._path) == (sys.meta_path, sys.path):
            return
        for name in sorted(_LIBRARIES - sys.modules.keys()):
            try:
                now = _origin(name)
            except Exception as error:
                yield f"keeps {name} from being imported ({type(error).__name__}), which is everybody's"
                return
            if now != _origin(name, self._finders, self._path):
                yield f"puts another module in the place of {name}, which is everybody's"
                return


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


def _is_kept(module: str, name: str, value: Any) -> bool:
    """Whether nobody changes what stands in a module under a name: what is called, and constants."""
    if _is_used(name, value):
        return True
    if name.startswith(("_", "last_")) or name in _VARYING:
        return False
    if module.partition(".")[0] in _OWN:
        return name.isupper() and not isinstance(value, types.ModuleType)
    return isinstance(value, _PLAIN) and (name.isupper() or module in _WITH_CONSTANTS)


def _inner(module: str, value: Any) -> tuple[Any, ...]:
    """What can be changed within something that stays the same; empty if there is nothing."""
    if isinstance(value, types.FunctionType):
        more = value.__kwdefaults__ or {}
        return (id(value.__code__), id(value.__defaults__), *((key, id(one)) for key, one in more.items()))
    if module.partition(".")[0] not in _OWN or isinstance(value, type):
        return ()
    if isinstance(value, (dict, types.MappingProxyType)):
        return tuple((key, id(one)) for key, one in value.items())
    if isinstance(value, (list, set)):
        return tuple(map(id, value))
    if dataclasses.is_dataclass(value):
        return tuple(id(getattr(value, field.name)) for field in dataclasses.fields(value))
    return ()


_HIDEABLE = frozenset(name for name in vars(builtins) if not name.startswith("__"))
"""Names of Python that a module may hide by one of its own."""
_heard: list[int] = []


_BUILT_IN_TYPES: tuple[type, ...] = (
    str,
    bytes,
    int,
    float,
    complex,
    bool,
    list,
    tuple,
    dict,
    set,
    frozenset,
    type(None),
)


def _kinds() -> list[bool]:
    """Which types of Python are taken for which kinds, such as for a mapping or a number."""
    names = [(module, name) for module in (abc, numbers) for name in module.__all__ if name != "ByteString"]
    kinds: list[type] = [getattr(*one) for one in names]
    return [issubclass(one, kind) for one, kind in product(_BUILT_IN_TYPES, kinds)]


def _audits() -> list[int]:
    """A mark for each listener to audits of Python that was added since this was asked first."""
    if not _heard:

        def hook(event: str, _: tuple[Any, ...]) -> None:
            if event == "sys.addaudithook":
                _heard.append(1)

        sys.addaudithook(hook)
        _heard.append(0)
    return list(_heard)


def _origin(name: str, finders: Sequence[Any] | None = None, path: Sequence[str] | None = None) -> str | None:
    """Where a module would be imported from, by these finders along this path, or as things stand."""
    if finders is None or path is None:
        found = (one.find_spec(name, None, None) for one in sys.meta_path)
    else:
        found = (
            importlib.machinery.PathFinder.find_spec(name, list(path))
            if one is importlib.machinery.PathFinder
            else one.find_spec(name, None, None)
            for one in finders
        )
    spec = next((one for one in found if one is not None), None)
    return None if spec is None else spec.origin


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
    found["kinds of types (register of collections.abc or numbers)"] = _kinds()
    found["the tracing function"] = sys.gettrace()
    found["the profiling function"] = sys.getprofile()
    return found | process_state()
