"""What every class that a plugin registers has in common, and how the host tells their kinds apart.

Glossary
--------
contract
    A class that derives from :class:`Plugin` itself: ``Family``, ``Exporter``, ``Control`` ... It says what
    its subclasses give.
kind
    What people call the subclasses of one contract: a family, a control. The host files each class that is
    registered under the contract it derives from, so a new kind of plugin changes nothing in the host.
"""

from abc import ABC
from collections.abc import Mapping
from typing import Any, ClassVar

from mechwright.contracts.guard import guard

HOOK_API = 2
"""Version of the contracts of this program; a class states the one that it was written for."""


class Plugin(ABC):
    """The base of all contracts.

    A contract states ``kind``, ``plural`` and ``texts``; its subclasses state ``api`` (by inheritance) and
    ``name``. A class is registered by the hook ``mechwright_register``; the host makes one instance of it
    without arguments.
    """

    api: ClassVar[int] = HOOK_API
    name: ClassVar[str]
    """Lower-case name with hyphens, as design files and the command line say it."""

    kind: ClassVar[str] = "plugin"
    """What one of this contract is called, for messages."""
    plural: ClassVar[str] = "plugins"
    """What all of them are called, for listings."""
    texts: ClassVar[tuple[str, ...]] = ()
    """Names of further attributes that each class gives as text."""

    guarded: ClassVar[bool] = True
    """Whether calls of its methods go through the guard; of commands they do not, which may print and end."""
    limited: ClassVar[bool] = False
    """Whether a call has a time."""
    steady: ClassVar[bool] = False
    """Whether a call works on parameters, its first argument, that stay as they are."""
    unlimited: ClassVar[frozenset[str]] = frozenset()
    """Methods whose calls have none all the same."""
    piecewise: ClassVar[frozenset[str]] = frozenset()
    """Methods that give one thing after the other; what others give so is gathered by the guard."""
    derived: ClassVar[frozenset[str]] = frozenset()
    """Methods of the contract itself that put together what a class gives: they are guarded as its own."""
    inner: ClassVar[frozenset[str]] = frozenset()
    """Methods that those alone call, inside of their guard."""
    registered_by: str = ""
    """What registered it, in words, where the host did: ``"plugin geneva of mechwright"``."""

    def __init_subclass__(cls, **named: Any) -> None:
        super().__init_subclass__(**named)
        contract = contract_of(cls)
        if contract is not None and contract.guarded:
            guard(cls, contract)

    @classmethod
    def sound(cls, method: str, answer: Any, arguments: tuple[Any, ...]) -> Any:  # noqa: ARG003 - by some
        """The answer of a method, if it is what its annotation says; raises UnsoundError if not."""
        from mechwright.contracts.declared import hold  # it needs numpy, which listings do not

        hold(cls, method, answer)
        return answer

    @classmethod
    def named(cls) -> Mapping[str, Any]:
        """What annotations of the contract name that its module imports for type checkers alone."""
        return {}

    @classmethod
    def fault(cls) -> str:
        """What else keeps a class from being used, in words that follow its name; nothing if it is sound."""
        return ""


def contract_of(cls: type[Plugin]) -> type[Plugin] | None:
    """The contract that a class derives from; None for :class:`Plugin` and for a contract itself."""
    for base in cls.__mro__[1:]:
        if Plugin in base.__bases__:
            return base
    return None
