"""The plugin host: finds plugins, keeps what they register, and turns a broken one into a warning."""

import os
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager, nullcontext, suppress
from dataclasses import dataclass, field
from functools import cache
from importlib.metadata import Distribution, EntryPoint, distributions
from typing import TYPE_CHECKING, Any, Generic, NoReturn, TypeVar

import pluggy

from mechwright.contracts.guard import TimeUpError, loading
from mechwright.contracts.plugin import Plugin, contract_of, methods_of
from mechwright.contracts.result import Result, found_by
from mechwright.contracts.stops import is_stop
from mechwright.errors import PluginError, did_you_mean, shortened
from mechwright.plugins import hookspecs
from mechwright.plugins.trial import Candidate, verdicts
from mechwright.plugins.versions import api_fault, api_warning, program

if TYPE_CHECKING:
    from mechwright.contracts.family import Family

GROUP = "mechwright"
"""Entry-point group in which a distribution names its plugin modules."""
COMMANDS = "mechwright.commands"
"""Entry-point group of the modules that register commands, which are all that ``--help`` needs."""
BUILT_IN = "mechwright"
"""The distribution whose plugins go first, so that a third party cannot take their names."""
DISABLE = "MECHWRIGHT_DISABLE_PLUGINS"
"""Environment variable with the names of plugins to leave out, separated by commas."""

HOOK = hookspecs.mechwright_register.__name__
_ASKING = ("__getattribute__", "__setattr__", "__delattr__", "__hash__", "__eq__", "__bool__", "__len__")
"""Methods by which a plugin is asked for anything at all."""
_NAME = re.compile(r"[a-z0-9]+(-[a-z0-9]+)*")
_SUFFIX = re.compile(r"(\.[a-z0-9]+)+")

T = TypeVar("T")
C = TypeVar("C", bound=Plugin)


@dataclass(frozen=True, slots=True)
class Broken:
    """A plugin, or something it registers, that cannot be used."""

    distribution: str
    plugin: str
    reason: str

    def __str__(self) -> str:
        return f"plugin {self.plugin} of {self.distribution} is not used: {self.reason}"


@dataclass(frozen=True, slots=True)
class Outdated:
    """A class that is used, and that the next minor version of this program will refuse."""

    distribution: str
    plugin: str
    reason: str

    def __str__(self) -> str:
        return f"plugin {self.plugin} of {self.distribution}: {self.reason}"


@dataclass(frozen=True, slots=True)
class Registered(Generic[T]):
    """A registered class and the distribution it comes from."""

    item: T
    distribution: str
    plugin: str

    def __post_init__(self) -> None:
        if isinstance(self.item, Plugin):
            self.item.registered_by = f"plugin {self.plugin} of {self.distribution}"


@dataclass
class Host:
    """What is installed.

    Parameters
    ----------
    registered
        Contract to name to registration.
    broken
        What could not be used, and why.
    outdated
        What is used and will be refused, and from when on.
    """

    registered: dict[type[Plugin], dict[str, Registered[Any]]] = field(default_factory=dict)
    broken: list[Broken] = field(default_factory=list)
    outdated: list[Outdated] = field(default_factory=list)

    def of(self, contract: type[C]) -> "dict[str, Registered[C]]":
        """What is registered of a contract, name to registration."""
        return self.registered.get(contract, {})

    def all(self, contract: type[C]) -> list[C]:
        """What is registered of a contract, in the order of registration: what is built in comes first."""
        return [entry.item for entry in self.of(contract).values()]

    def get(self, contract: type[C], name: str) -> C:
        """One of a contract by its name; raises PluginError that lists the installed ones."""
        items = self.of(contract)
        if name in items:
            return items[name].item
        known = ", ".join(sorted(items)) or "none is installed"
        meant = "; ".join(filter(None, (f"known: {known}", did_you_mean(name, items))))
        raise PluginError(f"{contract.kind} {name!r} is not installed; {meant}")

    def family(self, name: str) -> "Family[Any]":
        """The family of this name; raises PluginError that lists the installed ones."""
        from mechwright.contracts.family import (
            Family,  # its tables take long to import, --help has no use for
        )

        return self.get(Family, name)

    def add(self, module: object, distribution: str, plugin: str) -> None:
        """Register one plugin module; whatever is wrong with it ends up in ``broken``."""
        fail = self._failing(distribution, plugin)
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
        classes: list[Any] = []
        with _instead(fail, f"{HOOK}: "):
            classes = _call(manager.hook.mechwright_register)
        for cls in classes:
            with _instead(fail):
                if reason := _class_fault(cls, distribution):
                    fail(reason)
                else:
                    self._take(cls, distribution, plugin, fail)
                    if warning := api_warning(cls.api, program()):
                        self.outdated.append(Outdated(distribution, plugin, f"{cls.__name__} {warning}"))

    def _take(self, cls: type[Plugin], distribution: str, plugin: str, fail: Callable[[str], object]) -> None:
        """Register a class that is well made."""
        contract = contract_of(cls)
        assert contract is not None  # noqa: S101 - a class without one has been refused
        items = self.registered.setdefault(contract, {})
        if other := items.get(cls.name):
            owner = f"{other.plugin} of {other.distribution}"
            fail(f"{cls.kind} {cls.name!r} is already registered by {owner}")
            return
        with _instead(fail, f"{cls.__name__}(): "):
            made = cls()
            if hidden := vars(made).keys() & methods_of(contract):
                fail(f"{cls.__name__}(): sets {', '.join(sorted(hidden))}; a method stands in the class")
            else:
                items[cls.name] = Registered(made, distribution, plugin)

    def _failing(self, distribution: str, plugin: str) -> Callable[[str], None]:
        """What files a reason for which a plugin is not used."""
        return lambda reason: self.broken.append(Broken(distribution, plugin, reason))


@contextmanager
def _instead(fail: Callable[[str], object], where: str = "") -> Iterator[None]:
    """Report whatever is raised meanwhile, and go on; a stop by the keyboard passes."""
    try:
        yield
    except BaseException as error:
        if is_stop(error):
            raise
        fail(where + _reason(error))


def _hook_fault(module: object, name: str) -> str:
    """What is wrong with the attribute of a plugin, if it is or looks like a hook; else nothing."""
    marked = looks_like = False
    with _instead(len):  # a lazy attribute that fails is no hook
        value = getattr(module, name)
        marked = isinstance(getattr(value, f"{hookspecs.PROJECT}_impl", None), dict)
        marks_others = isinstance(getattr(value, f"{hookspecs.PROJECT}_spec", None), dict)
        looks_like = name.startswith(HOOK) and callable(value) and not marks_others
    if not (marked or looks_like):
        return ""
    if name != HOOK:
        return f"there is no hook {name}; since hook API 2 one hook gives all classes: {HOOK}"
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


def _class_fault(cls: Any, distribution: str) -> str:
    """What keeps a class from being registered; nothing if it is well made."""
    if not (isinstance(cls, type) and issubclass(cls, Plugin)):
        return f"{cls!r} is no class of a contract, such as mechwright.Family"
    contract = contract_of(cls)
    if contract is None:
        return f"{cls.__name__} is a contract itself; register classes that derive from it"
    if fault := api_fault(getattr(cls, "api", None), program()):
        return f"{cls.__name__} {fault}"
    if taken := [name for name in _ASKING if getattr(cls, name, None) is not getattr(contract, name, None)]:
        return f"{cls.__name__} has a {taken[0]} of its own, by which everybody asks it; leave that out"
    name = getattr(cls, "name", None)
    if not isinstance(name, str):
        return f"{cls.__name__} has no name"
    if not _NAME.fullmatch(name):
        return f"{cls.__name__}: name {name!r} is not of lower-case letters, digits and single hyphens"
    suffix = getattr(cls, "suffix", None)
    if isinstance(suffix, str) and not _SUFFIX.fullmatch(suffix):
        return f"{cls.__name__}: suffix {suffix!r} is not a dot with lower-case letters and digits"
    faults = [""]
    with _instead(faults.append, "fault(): "):
        faults.append(cls.fault())
    if not faults[-1] and contract.guarded and distribution != BUILT_IN:
        from mechwright.contracts.declared import unstated  # it needs numpy, which our own listings do not

        faults.append(unstated(contract, cls))
    return (
        re.sub(": (has|overrides) ", r" \1 ", f"{cls.__name__}: {faults[-1]}", count=1) if faults[-1] else ""
    )


_MOVED = {
    "mechwright.build": "mechwright.pipeline",
    "mechwright.sweep": "mechwright.studies",
    "mechwright.cores": "mechwright.worker_pool.budget",
    "mechwright.beside": "mechwright.worker_pool",
}
"""Modules under the names that they had, and those that they have."""


def _reason(error: BaseException) -> str:
    if isinstance(error, TimeUpError):
        return str(error)
    text: list[str] = []
    with suppress(Exception):  # words of its own may fail as well
        text = str(error).strip().splitlines()
    said = "".join(c for c in text[0] if c.isprintable()) if text else ""
    if isinstance(error, ModuleNotFoundError) and (new := _MOVED.get(str(error.name))):
        said += f"; it is called {new} now"
    kind = " ".join(type(error).__name__.split())
    return shortened(f"{kind}: {said}") if said else kind


def load(
    points: list[tuple[str, EntryPoint]] | None = None,
    disabled: frozenset[str] | None = None,
    group: str = GROUP,
) -> Host:
    """Load plugins from ``points`` (distribution name and entry point), or from what a group has installed.

    What others have installed is tried in a second process before. Names in ``disabled`` are skipped; None
    reads them from the environment variable ``MECHWRIGHT_DISABLE_PLUGINS``, separated by commas.
    """
    found, tried = Host(), points is None
    if points is None:
        points, found.broken = hook_points(distributions(), group)
    if disabled is None:
        disabled = frozenset(name.strip() for name in os.environ.get(DISABLE, "").split(",") if name.strip())
    points = [(distribution, point) for distribution, point in points if point.name not in disabled]
    foreign = [Candidate(*one) for one in points if one[0] != BUILT_IN] if tried else []
    verdict = verdicts(foreign) if foreign else {}
    for distribution, point in points:
        if said := verdict.get(Candidate(distribution, point).key):
            found._failing(distribution, point.name)(said)
        else:
            with nullcontext() if distribution == BUILT_IN else _no_exit():
                register(found, distribution, point)
    return found


@contextmanager
def _no_exit() -> Iterator[None]:
    """Have ``os._exit`` raise SystemExit meanwhile: a plugin may do here what it did not do in its trial."""
    real, own, ended = os._exit, os.getpid(), False

    def leave(status: int) -> NoReturn:
        if ended or os.getpid() != own:
            real(status)
        raise SystemExit(status)

    os._exit = leave
    try:
        yield
    finally:
        ended, os._exit = True, real


def register(host: Host, distribution: str, point: EntryPoint) -> None:
    """Load what an entry point names, and register it; whatever is wrong with it ends up in ``broken``."""
    own = distribution == BUILT_IN
    guard = nullcontext() if own else loading(f"plugin {point.name} of {distribution}", point.module)
    with guard, _instead(host._failing(distribution, point.name)):
        host.add(point.load(), distribution, point.name)


def hook_points(
    everything: Iterable[Distribution], group: str = GROUP
) -> tuple[list[tuple[str, EntryPoint]], list[Broken]]:
    """The entry points of a group, built-in ones first, then by name; and what cannot be read."""
    points: dict[tuple[str, str, str], tuple[str, EntryPoint]] = {}
    broken: list[Broken] = []
    for distribution in everything:
        name = "unknown"
        with _instead(lambda reason: broken.append(Broken(name, "entry_points.txt", reason))):  # noqa: B023
            # Other people's broken packages are none of our business.
            if f"[{group}]" not in (distribution.read_text("entry_points.txt") or ""):
                continue
            if "Name" in distribution.metadata:
                name = distribution.metadata["Name"] or name
            for point in distribution.entry_points:
                if point.group == group:
                    # An editable install can be listed twice; the first on the path counts.
                    points.setdefault((name, point.name, point.value), (name, point))
    ordered = sorted(points.values(), key=lambda item: (item[0] != BUILT_IN, item[0], item[1].name))
    return ordered, broken


@cache
def host() -> Host:
    """The host of this process, loaded once."""
    return load()


def foreign() -> bool:
    """Whether a plugin of another distribution is used in this process, which has loaded its plugins."""
    used = host().registered.values() if host.cache_info().currsize else ()
    return any(one.distribution != BUILT_IN for entries in used for one in entries.values())


def _results() -> dict[str, Result[Any]]:
    return {one.name: one for one in host().all(Result)}


found_by(_results)  # a part knows no host, and is asked for its solid all the same
