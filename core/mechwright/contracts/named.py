"""Things with names, in an order: parts of a mechanism, programs of a job."""

from typing import Protocol, SupportsIndex, TypeVar, overload

from mechwright.errors import DesignError, did_you_mean


class HasName(Protocol):
    """What has a name."""

    @property
    def name(self) -> str:
        """The name."""


T = TypeVar("T", bound=HasName)


class Named(tuple[T, ...]):
    """A tuple whose items can be taken by their names as well.

    Examples
    --------
    >>> from mechwright.contracts.part import Bore
    >>> bores = Named([Bore("crank", (0.0, 0.0), 6.0, 0.0, 5.0), Bore("rocker", (9.0, 0.0), 6.0, 0.0, 5.0)])
    >>> bores["rocker"].centre, bores[0].name, bores.names, "crank" in bores
    ((9.0, 0.0), 'crank', ('crank', 'rocker'), True)
    >>> bores["roker"]
    Traceback (most recent call last):
    mechwright.errors.DesignError: nothing is named 'roker'; did you mean 'rocker'?
    """

    __slots__ = ()

    @property
    def names(self) -> tuple[str, ...]:
        """The names, in order."""
        return tuple(item.name for item in self)

    @overload
    def __getitem__(self, key: SupportsIndex | str) -> T: ...
    @overload
    def __getitem__(self, key: slice) -> tuple[T, ...]: ...
    def __getitem__(self, key: SupportsIndex | str | slice) -> T | tuple[T, ...]:
        if not isinstance(key, str):
            return super().__getitem__(key)
        for item in self:
            if item.name == key:
                return item
        hint = did_you_mean(key, self.names) or f"known: {', '.join(self.names) or 'none'}"
        raise DesignError(f"nothing is named {key!r}; {hint}")

    def __contains__(self, key: object) -> bool:
        return key in self.names if isinstance(key, str) else super().__contains__(key)

    def __repr__(self) -> str:
        return f"({', '.join(map(repr, self))})"
