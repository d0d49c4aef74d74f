"""The plugin host: finds plugins, keeps what they register, and turns a broken one into a warning."""

import os
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache
from importlib.metadata import EntryPoint, distributions
from typing import Any, Generic, TypeVar

import pluggy

from mechwright import hookspecs
from mechwright.errors import PluginError
from mechwright.family import HOOK_API, Family
from mechwright.output import Exporter, Post

GROUP = "mechwright"
DISABLE = "MECHWRIGHT_DISABLE_PLUGINS"
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
    posts: dict[str, Registered[Post]] = field(default_factory=dict)
    exporters: dict[str, Registered[Exporter]] = field(default_factory=dict)
    broken: list[Broken] = field(default_factory=list)

    def family(self, name: str) -> Family[Any]:
        """The family of this name; raises PluginError that lists the installed ones."""
        return self._get(self.families, name, "family")

    def post(self, name: str) -> Post:
        """The post of this name; raises PluginError that lists the installed ones."""
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
            manager.check_pending()
        except pluggy.PluginValidationError as error:
            fail(str(error).splitlines()[0])
            return
        calls: list[tuple[Callable[[], list[Any]], dict[str, Registered[Any]], type]] = [
            (manager.hook.mechwright_register_families, self.families, Family),
            (manager.hook.mechwright_register_posts, self.posts, Post),
            (manager.hook.mechwright_register_exporters, self.exporters, Exporter),
        ]
        for call, items, base in calls:
            try:
                classes = [cls for batch in call() for cls in batch]
            except Exception as error:  # noqa: BLE001,RUF100 - a plugin may fail in any way
                fail(_reason(error))
                continue
            for cls in classes:
                self._add_class(cls, base, items, distribution, plugin, fail)

    def _add_class(
        self,
        cls: Any,
        base: type[Any],
        items: dict[str, Registered[Any]],
        distribution: str,
        plugin: str,
        fail: Callable[[str], None],
    ) -> None:
        if not _is_subclass(cls, base):
            fail(f"{cls!r} is no subclass of {base.__name__}")
        elif getattr(cls, "api", None) != HOOK_API:
            fail(f"{cls.__name__} was written for hook API {getattr(cls, 'api', None)}; this is {HOOK_API}")
        elif not isinstance(getattr(cls, "name", None), str):
            fail(f"{cls.__name__} has no name")
        elif cls.name in items:
            other = items[cls.name]
            fail(
                f"{base.__name__.lower()} {cls.name!r} is already registered by "
                f"{other.plugin} of {other.distribution}"
            )
        else:
            try:
                items[cls.name] = Registered(cls(), distribution, plugin)
            except Exception as error:  # noqa: BLE001,RUF100 - a plugin may fail in any way
                fail(_reason(error))


def _is_subclass(cls: Any, base: type[Any]) -> bool:
    return isinstance(cls, type) and issubclass(cls, base)


def _reason(error: BaseException) -> str:
    text = str(error).strip().splitlines()
    return f"{type(error).__name__}: {text[0]}" if text else type(error).__name__


def load(points: list[tuple[str, EntryPoint]] | None = None, disabled: frozenset[str] | None = None) -> Host:
    """Load plugins from ``points`` (distribution name and entry point), or from what is installed.

    Names in ``disabled`` are skipped; None reads them from the environment variable
    ``MECHWRIGHT_DISABLE_PLUGINS``, separated by commas.
    """
    if points is None:
        points = _installed()
    if disabled is None:
        disabled = frozenset(name.strip() for name in os.environ.get(DISABLE, "").split(",") if name.strip())
    found = Host()
    for distribution, point in points:
        if point.name in disabled:
            continue
        try:
            module = point.load()
        except (Exception, SystemExit) as error:  # noqa: BLE001,RUF100 - a plugin may fail in any way
            found.broken.append(Broken(distribution, point.name, _reason(error)))
            continue
        found.add(module, distribution, point.name)
    return found


def _installed() -> list[tuple[str, EntryPoint]]:
    points: dict[tuple[str, str, str], tuple[str, EntryPoint]] = {}
    for distribution in distributions():
        for point in distribution.entry_points:
            if point.group == GROUP:
                name = distribution.metadata["Name"] or "unknown"
                # An editable install can be listed twice; the first on the path counts.
                points.setdefault((name, point.name, point.value), (name, point))
    # The built-in plugins go first, so that a third party cannot take their names.
    return sorted(points.values(), key=lambda item: (item[0] != "mechwright", item[0], item[1].name))


@cache
def host() -> Host:
    """The host of this process, loaded once."""
    return load()
