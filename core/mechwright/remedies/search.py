"""Changes that remove a finding: what was proposed, then values along the keys that it speaks of."""

import math
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from enum import IntEnum
from itertools import zip_longest
from typing import Any

from mechwright.contracts.finding import Change, Finding, Severity, Stage
from mechwright.designs.chains import STAGE
from mechwright.designs.change import found_at
from mechwright.remedies.bench import KEY, Bench, identity
from mechwright.remedies.keys import Key, meant, named
from mechwright.remedies.measured import measured
from mechwright.remedies.values import closest, ladder, round_to, typed

_PAST = (0.0, 1e-3, 1e-2)
"""Shares of a limit by which a value goes past it: on it, and as a person would round it."""

_NEAR = KEY + 0.3
"""A change that helps and costs no more than this ends the search: a number a third larger."""

_EXACT = 12
"""Significant digits of a proposal: all that is meant, without the last ones of 0.4 x 14."""

_PART = re.compile(r"\bpart [\w-]+")
"""The name of a part, which is none of a key: a four-bar has a part and a length that are called ground."""


class Worth(IntEnum):
    """What a change is worth against a finding, the best first."""

    BUILDS = 0
    """No error is left."""
    HELPS = 1
    """The finding is gone, and no error stands that did not stand before."""
    REVEALS = 2
    """The finding is gone, and others stand: checks not reached before, or what the change spoils. So does a
    change of the motion's kind, for the sake of what is no matter of the motion."""
    USELESS = 3
    """The finding stays, or the design is refused."""


@dataclass(frozen=True)
class Step:
    """A change that does something against a finding: what was decided before it, with one key more."""

    worth: Worth
    size: float
    change: Change


def worth(bench: Bench, finding: Finding, before: Iterable[Finding], change: Change) -> Worth:
    """What a change is worth against a finding; ``before`` are the errors that stand without it."""
    found, left = bench.found(change), bench.errors(change)
    if found is None or left is None:
        return Worth.USELESS
    if identity(finding) in {identity(one) for one in found if one.severity is not Severity.NOTE}:
        return Worth.USELESS
    if finding.stage is not Stage.MOTION and bench.spoils(change):
        return Worth.REVEALS
    if not left:
        return Worth.BUILDS
    stood = {identity(one) for one in before}
    return Worth.HELPS if {identity(one) for one in left} <= stood else Worth.REVEALS


def related(bench: Bench, finding: Finding) -> list[Key]:
    """The keys to search along: the finding's own, then those that its remedy and its message speak of."""
    words = _PART.sub("part", f"{finding.parameter} {finding.remedy} {finding.message}")
    own = bench.keys.get(path_of(bench, finding.parameter))
    found = [*([own] if own else []), *named(words, bench.keys)]
    return list(dict.fromkeys(found or meant(words, bench.keys)))


def path_of(bench: Bench, parameter: str) -> str:
    """The dotted key of the design file that a finding names."""
    tables = {reader.name for reader in bench.design.readers} | {STAGE}
    return parameter if parameter.partition(".")[0] in tables else f"parameters.{parameter}"


def best_step(bench: Bench, finding: Finding, decided: Change, before: list[Finding]) -> Step | None:
    """The change of least size that does most against a finding; None where nothing does.

    ``decided`` holds besides. What was proposed comes first, and the first proposal that helps is taken.
    """
    best, told = proposed_step(bench, finding, decided, before), bench.told(finding, decided)
    if best is not None and best.worth <= Worth.HELPS:
        return best
    for key in related(bench, told):
        # Nothing larger is better than what builds: of the next keys only smaller changes are tried.
        most = best.size if best is not None and best.worth is Worth.BUILDS else math.inf
        for step in _along(bench, finding, decided, before, key, most):
            if best is None or (step.worth, step.size) < (best.worth, best.size):
                best = step
        if best is not None and best.worth <= Worth.HELPS and best.size - bench.size(decided) < _NEAR:
            break
    return best


def proposed_step(bench: Bench, finding: Finding, decided: Change, before: list[Finding]) -> Step | None:
    """The first change that does most against a finding, of those that it and others like it propose."""
    alike = [bench.told(one, decided) for one in before if identity(one) == identity(finding)]
    best = None
    for proposal in _proposals(bench, alike or [bench.told(finding, decided)], decided):
        step = _step(bench, finding, decided, before, written(bench, proposal, decided))
        if step is not None and (best is None or step.worth < best.worth):
            best = step
        if best is not None and best.worth is Worth.BUILDS:
            break
    return best


def _proposals(bench: Bench, findings: Sequence[Finding], decided: Change) -> list[Change]:
    """What findings that say the same of several parts propose: what is enough for all is the farthest."""
    each = [[*proposals(bench, one), *unnamed(bench, one, decided)] for one in findings]
    ranks = ([one for one in rank if one is not None] for rank in zip_longest(*each))
    return [one for rank in ranks for one in sorted(rank, key=bench.size, reverse=True)]


def proposals(bench: Bench, finding: Finding) -> list[Change]:
    """What a finding proposes.

    A key that is left out for the program to choose, and that another table lends, is left out or set to the
    program's choice: what is lent may be what stands in the way.
    """
    found: list[Change] = []
    for change in finding.proposed:
        own = {path: _unlent(bench, path) if value is None else value for path, value in change.items()}
        found += [change] if own == change else [change, own]
    return found


def _unlent(bench: Bench, path: str) -> Any:
    """What a key is left out to: None, or the program's own choice where another table lends one."""
    key = bench.keys.get(path)
    return key.usual if key is not None and key.lender else None


def unnamed(bench: Bench, finding: Finding, decided: Change) -> list[Change]:
    """Changes of a length that the finding measures, where its own parameter is no number to be changed."""
    own = bench.keys.get(path_of(bench, finding.parameter))
    return [] if own is not None and own.numeric else list(measured(bench, finding, decided))


def written(bench: Bench, change: Change, decided: Change) -> Change:
    """A proposal with its numbers as a person writes them, without what is so already."""
    return {
        path: typed(bench.keys[path], round_to(value, _EXACT))
        if isinstance(value, float) and path in bench.keys and bench.keys[path].numeric
        else value
        for path, value in change.items()
        if _differs(bench, path, value, decided)
    }


def _differs(bench: Bench, path: str, value: Any, decided: Change) -> bool:
    """Whether a key is not so already; what neither the file nor an earlier change states is left out."""
    if value is None:
        return decided.get(path) is not None or found_at(bench.design.content, path)[0]
    return path not in bench.keys or bool(bench.now(bench.keys[path], decided) != value)


def _step(
    bench: Bench, finding: Finding, decided: Change, before: list[Finding], change: Change
) -> Step | None:
    merged = {**decided, **change}
    value = worth(bench, finding, before, merged)
    return None if value is Worth.USELESS else Step(value, bench.size(merged), merged)


def _along(
    bench: Bench, finding: Finding, decided: Change, before: list[Finding], key: Key, most: float
) -> Iterator[Step]:
    """The nearest value of a key that removes the finding, and the nearest that also spoils nothing.

    Changes as large as ``most`` are passed over.
    """
    now = bench.now(key, decided)
    best = Worth.USELESS
    for value in dict.fromkeys([*_past(key, now, finding), *ladder(key, now)]):
        if bench.size({**decided, key.path: value}) >= most:
            continue
        step = _step(bench, finding, decided, before, {key.path: value})
        if step is not None and step.worth < best:
            best = step.worth
            yield step
        if best <= Worth.HELPS or bench.spent:
            return


def _past(key: Key, now: Any, finding: Finding) -> list[float]:
    """Values at the limit and just past it, where the finding compares the key's own value with a limit."""
    value, limit = finding.value, finding.limit
    if (
        not key.numeric
        or value is None
        or limit is None
        or not isinstance(now, int | float)
        or value == limit
    ):
        return []
    if abs(value - now) > 1e-6 * max(abs(value), abs(now)):
        return []
    ends = [limit + (limit - value) / abs(limit - value) * share * abs(limit) for share in _PAST]
    rounded = [typed(key, round_to(end)) for end in ends]
    return [end for end in rounded if key.low <= end <= key.high and end != now]


def refined(bench: Bench, finding: Finding, before: list[Finding], change: Change) -> Change:
    """The same change with every number as near to the present one as it may be, and as round."""

    def keeps(candidate: Change) -> bool:
        return worth(bench, finding, before, candidate) <= Worth.HELPS

    return drawn_back(bench, change, keeps)


def drawn_back(bench: Bench, change: Change, keeps: Callable[[Change], bool]) -> Change:
    """Draw every number of a change back towards the present one, as far as ``keeps`` allows."""
    drawn = dict(change)

    def draw(key: Key, now: float, value: float) -> float:
        def passes(number: float) -> bool:
            return keeps({**drawn, key.path: typed(key, number)})

        return typed(key, closest(key, now, value, passes))

    for path, value in sorted(change.items(), key=lambda item: -bench.weight(item[0])):
        if drawable(bench, path, value) and not bench.spent:
            key = bench.keys[path]
            drawn[path] = draw(key, float(bench.now(key)), float(value))
    return drawn


def drawable(bench: Bench, path: str, value: Any) -> bool:
    """Whether a value is a number in place of a number, which may come nearer to it."""
    key = bench.keys.get(path)
    return key is not None and key.numeric and value is not None and bench.now(key) is not None
