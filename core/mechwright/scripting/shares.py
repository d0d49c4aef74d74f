"""Items of one work, shared out between this process and second interpreters beside it.

Who works on what is decided before, by an estimate of each item's time; a second interpreter is begun only
where it ends earlier than this process would without it. It is faster, never different: what goes wrong there
is done once more here, which also tells the error, and results do not depend on how many share.
"""

import io
import pickle
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from typing import Any, TypeVar, cast

from mechwright.beside import Beside
from mechwright.contracts.guard import during, now
from mechwright.cores import cores, keep_to, keeping
from mechwright.scripting.heard import Heard, Teller, listen, taken

T = TypeVar("T")
R = TypeVar("R")

BEGINS = 1.25
"""Seconds until a second interpreter is at work, and its answer here: imports take most of them."""

Answer = tuple[list[bytes | None], list[Heard]]


def shares(seconds: Sequence[float], most: int) -> list[list[int]]:
    """Places of items by who works on them, this process first; those with nothing to do are left out.

    The longest items go first, each to who would end it first.

    >>> shares([1, 1], most=4)
    [[0, 1]]
    >>> shares([3, 4, 2, 6], most=2)
    [[2, 3], [0, 1]]
    """
    ends = [0.0] + [BEGINS] * (most - 1)
    found: list[list[int]] = [[] for _ in ends]
    for place in sorted(range(len(seconds)), key=lambda place: -seconds[place]):
        who = min(range(len(ends)), key=ends.__getitem__)
        ends[who] += seconds[place]
        found[who].append(place)
    return [sorted(places) for places in found if places]


def _nothing(item: object) -> Sequence[object]:  # noqa: ARG001
    return ()


def shared(
    work: Callable[[T], R],
    items: Sequence[T],
    seconds: Sequence[float],
    known: Callable[[T], Sequence[object]] = _nothing,
    progress: Callable[[float], None] = lambda _: None,
) -> list[R]:
    """What a function makes of every item, in their order; raises what it raises for the first that fails.

    Parameters
    ----------
    work
        A function of a module without side effects; items and results go through pickle, and where they
        cannot, the work is done here.
    seconds
        How long each item takes, about.
    known
        What of an item its result refers to: that stays this process's own, and is not copied.
    progress
        Told which part of this process's share is done, 0 to 1.
    """
    budget = cores()
    own, *others = shares(seconds, budget) or [[]]
    count = 1 + len(others)
    with ExitStack() as ended:
        asked: list[tuple[list[int], Beside]] = []
        for number, places in enumerate(others, 1):
            second = Beside(())
            ended.callback(second.close)
            allowed = budget // count + (number < budget % count)
            second.ask(_answer, work, [items[place] for place in places], known, allowed, now())
            asked.append((places, second))
        found: dict[int, R] = {}
        failed: dict[int, Exception] = {}
        with keeping(budget // count + (budget % count > 0)):
            for done, place in enumerate(own):
                progress(done / len(own))
                try:
                    found[place] = work(items[place])
                except Exception as error:  # noqa: BLE001,RUF100 - an item before it may have to tell first
                    failed[place] = error
                    break
        teller = Teller()
        for places, second in asked:
            contents, heard = cast(Answer, second.answer(tuple) or ([], []))
            teller.tell(heard)
            for place, content in zip(places, contents, strict=False):
                if content is not None:
                    found[place] = _Unpickler(content, known(items[place])).load()
    for place, item in enumerate(items):
        if place in failed:
            raise failed[place]
        if place not in found:
            found[place] = work(item)
    return [found[place] for place in range(len(items))]


def _answer(
    work: Callable[[T], R], items: Sequence[T], known: Callable[[T], Sequence[object]], allowed: int, who: str
) -> Answer:
    """The second interpreter's share: nothing for an item that fails, or whose result cannot be copied."""
    keep_to(allowed)
    listen()
    contents: list[bytes | None] = []
    for item in items:
        try:
            with during(who):
                result = work(item)
            buffer = io.BytesIO()
            _Pickler(buffer, known(item)).dump(result)
            contents.append(buffer.getvalue())
        except Exception:  # noqa: BLE001,RUF100 - it is done again by who asks, and told there
            contents.append(None)
    return contents, taken()


class _Pickler(pickle.Pickler):
    """Writes what is known by its place."""

    def __init__(self, file: io.BytesIO, known: Sequence[object]) -> None:
        super().__init__(file, pickle.HIGHEST_PROTOCOL)
        self._known = known
        self._places = {id(one): place for place, one in enumerate(known)}

    def persistent_id(self, thing: object) -> int | None:
        return self._places.get(id(thing))


class _Unpickler(pickle.Unpickler):  # noqa: S301 - of what a process of our own has written
    """Reads it again."""

    def __init__(self, content: bytes, known: Sequence[object]) -> None:
        super().__init__(io.BytesIO(content))
        self._known = known

    def persistent_load(self, place: Any) -> object:
        return self._known[place]
