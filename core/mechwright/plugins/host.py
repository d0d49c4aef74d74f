"""The plugin host: finds plugins, keeps what they register, and turns a broken one into a warning."""

import difflib
import os
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import cache
from importlib.metadata import Distribution, EntryPoint, distributions
from typing import Any, Generic, TypeVar

import pluggy

from mechwright.contracts.exporter import Exporter
from mechwright.contracts.family import HOOK_API, Family
from mechwright.contracts.parameters import Parameters
from mechwright.errors import PluginError
from mechwright.plugins import hookspecs
from mechwright_cam.controls.contract import Control

GROUP = "mechwright"
"""Entry-point group in which a distribution names its plugin modules."""
BUILT_IN = "mechwright"
"""The distribution whose plugins go first, so that a third party cannot take their names."""
DISABLE = "MECHWRIGHT_DISABLE_PLUGINS"
"""Environment variable with the names of plugins to leave out, separated by commas."""

_HOOK_PREFIX = "mechwright_register_"
_NAME = re.compile(r"[a-z0-9]+(-[a-z0-9]+)*")
_SUFFIX = re.compile(r"(\.[a-z0-9]+)+")
# A plugin may fail in any way; sys.exit() at import is one of them. Only the keyboard stops the host.
_ANY_FAILURE = (Exception, SystemExit)

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Broken:
    """A plugin, or something it registers, that cannot be used."""

    distribution: str
    plugin: str
    reason: str

    def __str__(self) -> str:
        return f"plugin {self.plugin} of {self.distribution} is not used: {self.reason}"


@dataclass(frozen=True, slots=True)
class Registered(Generic[T]):
    """A registered class and the distribution it comes from."""

    item: T
    distribution: str
    plugin: str


@dataclass
class Host:
    """What is installed.

    Parameters
    ----------
    families, posts, exporters
        Name to registration.
    broken
        What could not be used, and why.
    """

    families: dict[str, Registered[Family[Any]]] = field(default_factory=dict)
    posts: dict[str, Registered[Control]] = field(default_factory=dict)
    exporters: dict[str, Registered[Exporter]] = field(default_factory=dict)
    broken: list[Broken] = field(default_factory=list)

    def family(self, name: str) -> Family[Any]:
        """The family of this name; raises PluginError that lists the installed ones."""
        return self._get(self.families, name, "family")

    def post(self, name: str) -> Control:
        """The control of this name; raises PluginError that lists the installed ones."""
        return self._get(self.posts, name, "control")

    def exporter(self, name: str) -> Exporter:
        """The exporter of this name; raises PluginError that lists the installed ones."""
        return self._get(self.exporters, name, "exporter")

    def _get(self, items: dict[str, Registered[T]], name: str, what: str) -> T:
        if name in items:
            return items[name].item
        known = ", ".join(sorted(items)) or "none is installed"
        raise PluginError(f"{what} {name!r} is not installed; known: {known}")

    def add(self, module: object, distribution: str, plugin: str) -> None:
        """Register one plugin module; whatever is wrong with it ends up in ``broken``."""

        def fail(reason: str) -> None:
            self.broken.append(Broken(distribution, plugin, reason))

        manager = pluggy.PluginManager(hookspecs.PROJECT)
        manager.add_hookspecs(hookspecs)
        try:
            manager.register(module, plugin)
        except pluggy.PluginValidationError as error:
            fail(" ".join(str(error).split()))
            return
        for name in dir(module):
            reason = _hook_fault(module, name)
            if reason:
                fail(reason)
        kinds: list[tuple[pluggy.HookCaller, dict[str, Registered[Any]], type[Any]]] = [
            (manager.hook.mechwright_register_families, self.families, Family),
            (manager.hook.mechwright_register_posts, self.posts, Control),
            (manager.hook.mechwright_register_exporters, self.exporters, Exporter),
        ]
        for hook, items, base in kinds:
            try:
                classes = _call(hook)
            except _ANY_FAILURE as error:
                fail(f"{hook.name}: {_reason(error)}")
                continue
            for cls in classes:
                reason = _class_fault(cls, base) or _taken(cls.name, base, items)
                if reason:
                    fail(reason)
                    continue
                try:
                    items[cls.name] = Registered(cls(), distribution, plugin)
                except _ANY_FAILURE as error:
                    fail(f"{cls.__name__}(): {_reason(error)}")


def _hook_fault(module: object, name: str) -> str:
    """What is wrong with the attribute of a plugin, if it is or looks like a hook; else nothing."""
    try:
        value = getattr(module, name)
        marked = isinstance(getattr(value, f"{hookspecs.PROJECT}_impl", None), dict)
        marks_others = isinstance(getattr(value, f"{hookspecs.PROJECT}_spec", None), dict)
    except _ANY_FAILURE:
        return ""  # A lazy attribute that fails is no hook.
    looks_like = name.startswith(_HOOK_PREFIX) and callable(value) and not marks_others
    if not (marked or looks_like):
        return ""
    known = [hook for hook in vars(hookspecs) if hook.startswith(_HOOK_PREFIX)]
    if name not in known:
        guess = difflib.get_close_matches(name, known, n=1)
        return f"there is no hook {name}" + (f"; do you mean {guess[0]}?" if guess else "")
    # pluggy passes over a function without the mark in silence.
    return "" if marked else f"hook {name} is not marked with mechwright.plugins.hookspecs.hookimpl"


def _call(hook: pluggy.HookCaller) -> list[Any]:
    """The classes that one plugin's hook gives."""
    if not hook.get_hookimpls():
        return []
    batches: list[Sequence[Any]] = hook()
    if not batches:
        raise TypeError("it returns nothing; return a list of classes")
    if isinstance(batches[0], type) or not isinstance(batches[0], Iterable):
        raise TypeError(f"it returns {batches[0]!r}; return a list of classes")
    return list(batches[0])


def _class_fault(cls: Any, base: type[Any]) -> str:
    """What keeps a class from being used as a family, control or exporter; nothing if it is well made."""
    if not (isinstance(cls, type) and issubclass(cls, base)):
        return f"{cls!r} is no subclass of {base.__name__}"
    api = getattr(cls, "api", None)
    if api != HOOK_API:
        return f"{cls.__name__} was written for hook API {api}; this is {HOOK_API}"
    name = getattr(cls, "name", None)
    if not isinstance(name, str):
        return f"{cls.__name__} has no name"
    if not _NAME.fullmatch(name):
        return f"{cls.__name__}: name {name!r} is not of lower-case letters, digits and single hyphens"
    for text in ("title", "summary", "suffix"):
        if text in base.__annotations__ and not isinstance(getattr(cls, text, None), str):
            return f"{cls.__name__} has no {text}"
    suffix = getattr(cls, "suffix", None)
    if isinstance(suffix, str) and not _SUFFIX.fullmatch(suffix):
        return f"{cls.__name__}: suffix {suffix!r} is not a dot with lower-case letters and digits"
    if base is Family:
        params = getattr(cls, "Params", None)
        if not (isinstance(params, type) and issubclass(params, Parameters)):
            return f"{cls.__name__}: Params is no subclass of mechwright.contracts.parameters.Parameters"
    return ""


def _taken(name: str, base: type[Any], items: dict[str, Registered[Any]]) -> str:
    if name not in items:
        return ""
    other = items[name]
    return f"{base.__name__.lower()} {name!r} is already registered by {other.plugin} of {other.distribution}"


def _reason(error: BaseException) -> str:
    text = str(error).strip().splitlines()
    said = "".join(c for c in text[0] if c.isprintable()) if text else ""
    return f"{type(error).__name__}: {said}" if said else type(error).__name__


def load(points: list[tuple[str, EntryPoint]] | None = None, disabled: frozenset[str] | None = None) -> Host:
    """Load plugins from ``points`` (distribution name and entry point), or from what is installed.

    Names in ``disabled`` are skipped; None reads them from the environment variable
    ``MECHWRIGHT_DISABLE_PLUGINS``, separated by commas.
    """
    found = Host()
    if points is None:
        points, found.broken = hook_points(distributions())
    if disabled is None:
        disabled = frozenset(name.strip() for name in os.environ.get(DISABLE, "").split(",") if name.strip())
    for distribution, point in points:
        if point.name in disabled:
            continue
        try:
            module = point.load()
        except _ANY_FAILURE as error:
            found.broken.append(Broken(distribution, point.name, _reason(error)))
            continue
        found.add(module, distribution, point.name)
    return found


def hook_points(everything: Iterable[Distribution]) -> tuple[list[tuple[str, EntryPoint]], list[Broken]]:
    """The entry points of the group, built-in ones first, then by name; and what cannot be read."""
    points: dict[tuple[str, str, str], tuple[str, EntryPoint]] = {}
    broken = []
    for distribution in everything:
        name = "unknown"
        try:
            # Other people's broken packages are none of our business.
            if f"[{GROUP}]" not in (distribution.read_text("entry_points.txt") or ""):
                continue
            name = distribution.metadata["Name"] or name
            for point in distribution.entry_points:
                if point.group == GROUP:
                    # An editable install can be listed twice; the first on the path counts.
                    points.setdefault((name, point.name, point.value), (name, point))
        except _ANY_FAILURE as error:
            broken.append(Broken(name, "entry_points.txt", _reason(error)))
    ordered = sorted(points.values(), key=lambda item: (item[0] != BUILT_IN, item[0], item[1].name))
    return ordered, broken


@cache
def host() -> Host:
    """The host of this process, loaded once."""
    return load()
