"""What builds nearest: step by step against each finding, or back from one that is known to build.

Checks stop at the first group with an error, so what a step brings to light is often none of its doing. Steps
alone may run in a circle. The other way never does: the family's own defaults build, in their own size or in
that of the design, and every key that may have the design's value gets it back.
"""

from collections.abc import Iterator, Sequence
from heapq import heapify, heappop, heappush
from itertools import combinations

from mechwright.contracts.finding import Change
from mechwright.remedies.bench import KEY, Bench, identity
from mechwright.remedies.keys import Key
from mechwright.remedies.search import best_step, drawable, drawn_back
from mechwright.remedies.values import round_to, typed

MOST_CHANGES = 10
"""Keys that a remedy changes at most: more is another design."""
_ENOUGH = 3
"""Keys of a remedy found step by step with which the other way is not looked at."""
_FAR = 8.0
"""Size of a remedy found step by step from which the other way is looked at all the same: three lengths that
the file asks for, changed by half each, or one of them by eight times."""
_FIRST_WAY = 0.5
"""Share of the tries that the steps may use up: the other way needs its own where they end nowhere."""
_AGAIN = 3
"""Times that the same finding is met before the steps are given up."""
_FIRST = 5
"""Lengths, the first of a family's table, whose middle ratio to the defaults is the size of a design."""


def nearest(bench: Bench) -> Change | None:
    """The smallest change found with which the design builds; None where none was found.

    It may have more than :data:`MOST_CHANGES` keys: whoever asks decides what to do with another design.
    """
    found = False
    for change in candidates(bench, enough=_ENOUGH):
        found = True
        if bench.sure.builds(change):
            return change
    return nearest(bench.sure) if found and bench.sure is not bench else None


def candidates(bench: Bench, enough: int = 0) -> Iterator[Change]:
    """Changes with which the design builds, the best first; one of at most ``enough`` keys is alone.

    Those that are not too large come first, of them those that leave the motion as it was, then the smallest.
    A change is brought near only when none that is near already can be better: that takes most of the tries.
    """
    bench.share = _FIRST_WAY
    by_steps = _by_steps(bench)
    bench.share = 1.0
    found = [] if by_steps is None else [_given_back(bench, by_steps)]
    if by_steps is None or len(by_steps) > enough or bench.size(by_steps) > _FAR or bench.spoils(by_steps):
        found += _from_known(bench)

    def rank(change: Change) -> tuple[bool, bool, float]:
        return len(change) > MOST_CHANGES, bench.spoils(change), bench.size(change)

    # What is far off is ranked by what it is at least: its keys stay, however near their values come.
    queue = [(_least(bench, change), False, number) for number, change in enumerate(found)]
    heapify(queue)
    while queue:
        _, near, number = heappop(queue)
        if near:
            yield found[number]
        else:
            found[number] = _joined(bench, _near(bench, found[number]))
            heappush(queue, (rank(found[number]), True, number))


def _least(bench: Bench, change: Change) -> tuple[bool, bool, float]:
    """No rank of a change is below this one: its numbers may come near, its other values are what they are.

    Where there are too many keys, some may go back besides.
    """
    few = change.items() if len(change) <= MOST_CHANGES else ()
    sizes = (
        KEY * bench.weight(path) if drawable(bench, path, value) else bench.size({path: value})
        for path, value in few
    )
    return False, False, sum(sizes)


def _by_steps(bench: Bench) -> Change | None:
    """One finding after the other, each by the best single step against it."""
    change: Change = {}
    met: dict[tuple[str, str], int] = {}
    for _ in range(MOST_CHANGES + 1):
        left = bench.errors(change)
        if left is None:
            return None
        if not left:
            return change
        target = left[0]
        met[identity(target)] = met.get(identity(target), 0) + 1
        if met[identity(target)] > _AGAIN:
            return None
        best = best_step(bench, target, change, left)
        if best is None:
            return None
        change = best.change
    return None


def _from_known(bench: Bench) -> Iterator[Change]:
    """From each design that is known to build: what has to stay of it."""
    tables = tuple(f"{table}." for table in bench.design.own_tables)
    mine = [key for key in bench.keys.values() if key.path.startswith(tables)]
    for known in _known(bench, mine):
        if bench.builds(known):
            yield _given_back(bench, known)


def _known(bench: Bench, keys: Sequence[Key]) -> Iterator[Change]:
    """Changes that lead to the family's defaults, as they are and in the size of the design."""
    ratios = []
    for key in keys:
        now = bench.now(key)
        if key.unit == "mm" and key.low > 0 and now and key.default:
            ratios.append(now / key.default)
    first = sorted(ratios[:_FIRST])
    sizes = [round_to(first[len(first) // 2], 2)] if first else []
    for scale in dict.fromkeys([1.0, *sizes]):
        yield {
            key.path: value
            for key in keys
            if not key.fitted or key.stands_in(bench.design.content)
            if (value := _scaled(key, scale)) != bench.now(key) or (value is None) != (bench.now(key) is None)
        }


def _scaled(key: Key, scale: float) -> object:
    value = None if key.fitted else key.default
    if scale != 1.0 and key.unit == "mm" and isinstance(value, int | float):
        return typed(key, min(max(round_to(value * scale), key.low), key.high))
    return value


def _given_back(bench: Bench, known: Change) -> Change:
    """A design that builds, with as many keys as possible as the file has them: halves, then single ones.

    What the file asks for is given back first, and all is asked again until nothing more goes back.
    """
    kept, keeps = dict(known), bench.kept_by(known)

    def give(paths: list[str]) -> None:
        without = {path: value for path, value in kept.items() if path not in paths}
        if keeps(without):
            kept.clear()
            kept.update(without)
        elif len(paths) > 1:
            half = len(paths) // 2
            give(paths[:half])
            give(paths[half:])

    before = len(kept) + 1
    while kept and len(kept) < before:
        before = len(kept)
        give(sorted(kept, key=bench.weight, reverse=True))
    return kept


def _trimmed(bench: Bench, change: Change) -> Change:
    """The same remedy without what it does not need, its numbers as near as they may be."""
    return _near(bench, _given_back(bench, change))


def _near(bench: Bench, change: Change) -> Change:
    """The same remedy with its numbers as near as they may be."""
    return drawn_back(bench, change, bench.kept_by(change))


def _joined(bench: Bench, change: Change) -> Change:
    """A remedy of too many keys with fewer, where there is one: two go back, and one other value does.

    The way back from the defaults knows the values of the defaults alone: a law of the drive and its number
    both go, where a smaller number is enough. Keys whose names begin alike are tried together first.
    """
    while len(change) > MOST_CHANGES:
        pairs = sorted(combinations(change, 2), key=lambda pair: len({path.split("_")[0] for path in pair}))
        fewer = next(filter(None, (_in_place_of(bench, change, pair) for pair in pairs)), None)
        if fewer is None:
            return change
        change = _trimmed(bench, fewer)
    return change


def _in_place_of(bench: Bench, change: Change, pair: tuple[str, str]) -> Change | None:
    """A change that builds, with two keys as the file says them, and another value of one key at most."""
    rest = {path: value for path, value in change.items() if path not in pair}
    left = bench.errors(rest)
    step = best_step(bench, left[0], rest, left) if left else None
    if step is None or len(step.change) >= len(change) or not bench.kept_by(change)(step.change):
        return None
    return step.change
