"""What is computed of the form of a part, kept: copies that stand elsewhere and other settings share it."""

from collections.abc import Callable
from functools import lru_cache, wraps
from typing import Concatenate, Generic, ParamSpec, TypeVar

from mechwright.contracts.part import Part

P = ParamSpec("P")
T = TypeVar("T")
OfPart = Callable[Concatenate[Part, P], T]


class _Asked(Generic[T]):
    """A call: equal to another of the same form of part and the same further arguments."""

    __slots__ = ("call", "key", "number")

    def __init__(self, key: tuple[object, ...], call: Callable[[], T]) -> None:
        self.key, self.call, self.number = key, call, hash(key)

    def __hash__(self) -> int:
        return self.number

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Asked) and self.number == other.number and self.key == other.key


def kept_by_form(most: int) -> Callable[[OfPart[P, T]], OfPart[P, T]]:
    """Keep the last ``most`` results of a function of a part and of what can be hashed, by the part's form.

    The function must not ask for what :attr:`Part.form` leaves out.

    >>> from mechwright.contracts.part import Instance
    >>> from mechwright.contracts.shape import Shape, ring
    >>> from dataclasses import replace
    >>> part = Part("disc", None, 0.0, "steel", build=Shape((ring(0, 6, 1),)))
    >>> @kept_by_form(8)
    ... def made(part: Part) -> list[str]:
    ...     return [part.name]
    >>> made(part) is made(replace(part, instances=(Instance("rod"),)))
    True
    """

    def keeping(function: OfPart[P, T]) -> OfPart[P, T]:
        @lru_cache(maxsize=most)
        def found(asked: _Asked[T]) -> T:
            return asked.call()

        @wraps(function)
        def kept(part: Part, /, *rest: P.args, **named: P.kwargs) -> T:
            key = (part.form, *rest, *sorted(named.items()))
            return found(_Asked(key, lambda: function(part, *rest, **named)))

        kept.cache_clear = found.cache_clear  # type: ignore[attr-defined]
        return kept

    return keeping
