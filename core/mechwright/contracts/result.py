"""The contract of a result: what a part or a build can be asked for by a room that the core knows nothing of.

The core has no solids and no programs; who makes them registers a result, and it is asked for by its name:
``build.result("programs")``. The names that everybody expects have properties beside, such as
:attr:`mechwright.contracts.part.Part.solid`.
"""

from abc import abstractmethod
from collections.abc import Callable, Mapping
from typing import Any, ClassVar, Generic, Literal, TypeVar

from mechwright.contracts.plugin import Plugin
from mechwright.errors import PluginError

S = TypeVar("S")


class Result(Plugin, Generic[S]):
    r"""Something that is made of a part, or of a build.

    A build keeps what was made of it. Example of a whole result::

        class Masses(Result[Build]):
            name = "masses"
            of = "build"

            def make(self, build):
                return {part.name: density(part) * part.outline.area for part in build.parts}
    """

    kind = "result"
    plural = "results"
    of: ClassVar[Literal["part", "build"]]
    """What can be asked for it, named so that a plugin imports neither."""

    @abstractmethod
    def make(self, subject: S) -> Any:
        """What is made of it.

        Raises
        ------
        MechwrightError
            It cannot be made.
        """


Installed = Callable[[], Mapping[str, Result[Any]]]

_installed: list[Installed] = []


def found_by(installed: Installed) -> None:
    """Say who knows the results that are installed: the host does, as soon as it is imported."""
    _installed[:] = [installed]


def _kinds(subject: object) -> set[str]:
    return {base.__name__.lower() for base in type(subject).__mro__}


def maker(subject: object, name: str, known: Mapping[str, Result[Any]] | None = None) -> Result[Any]:
    """Who makes a result of a subject, among those that are ``known`` or installed.

    Raises PluginError with the names that there are.
    """
    if known is None:
        known = _installed[0]() if _installed else {}
    fitting = {one.name: one for one in known.values() if one.of in _kinds(subject)}
    if name in fitting:
        return fitting[name]
    there = ", ".join(sorted(fitting)) or "none is installed"
    raise PluginError(
        f"result {name!r} of a {type(subject).__name__.lower()} is not installed; known: {there}"
    )
