"""Trying changes of one design, and remembering what came of each."""

import time
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from mechwright.contracts.finding import Change, Finding, Severity, Stage, errors
from mechwright.contracts.synthesis import Progress, unheard
from mechwright.designs.change import found_at
from mechwright.designs.design import Design
from mechwright.remedies.keys import Key, keys_of
from mechwright.remedies.values import distance

Judge = Callable[[Design], Sequence[Finding]]
"""What is found of a design; an exception refuses it."""


KEY = 0.5
"""What one more key adds to the size of a change: as much as a number that grows by two thirds."""
SAID, ASKED = 1.5, 3.0
"""How many times as much a change counts of a key that the file says, and of one that people set first
besides: what somebody has asked for is changed last."""


@dataclass(frozen=True)
class Limits:
    """When a search ends.

    Parameters
    ----------
    tries
        Designs that are judged; the same number of tries gives the same remedy.
    seconds
        Processor time of judging after which no further one is judged, for designs whose check takes long:
        what else the machine does changes no remedy.
    """

    tries: int = 400
    seconds: float = 5.0


@dataclass
class Bench:
    """A design, and every change of it that was tried.

    Parameters
    ----------
    design
        As the file says it.
    judge
        What is found of it, or of a changed one.
    tell
        All that is found of it, with all that is said of remedies, which takes longer; by default the judge.
    stage
        Errors of this stage and of earlier ones count.
    limits
        When the search ends.
    progress
        Told how near that is.
    share
        Of the limits, what may be used up for now: a search of several ways leaves something for the next.
    fixed
        Tables whose keys stay as they are, besides what is at hand.
    """

    design: Design
    judge: Judge
    stage: Stage = Stage.MACHINING
    limits: Limits = Limits()
    tell: Judge | None = None
    progress: Progress = unheard
    tries: int = 0
    share: float = 1.0
    fixed: Collection[str] = ()
    keys: dict[str, Key] = field(init=False)
    """Those that a change may have: what is at hand stays as it is."""

    def __post_init__(self) -> None:
        keys, fixed = keys_of(self.design), tuple(f"{table}." for table in self.fixed)
        self.keys = {path: key for path, key in keys.items() if not (key.given or path.startswith(fixed))}
        self.given = keys.keys() - self.keys.keys()
        """Keys that stay as they are."""
        self._found: dict[frozenset[tuple[str, str]], tuple[Finding, ...] | None] = {}
        self._used = 0.0

    @property
    def spent(self) -> bool:
        """Whether the search has to end."""
        limits = self.limits
        return self.tries >= self.share * limits.tries or self._used >= self.share * limits.seconds

    def now(self, key: Key, change: Change | None = None) -> Any:
        """The value of a key, with a change that has been decided on."""
        if change and key.path in change:
            value = change[key.path]
            return key.default if value is None else value
        return key.now(self.design.content)

    def found(self, change: Change) -> tuple[Finding, ...] | None:
        """What is found of the design with a change; None where it is refused, or there is no try left."""
        name = self._differing(change)
        if name not in self._found:
            if self.spent:
                return None
            self._found[name] = self._judged(change)
        return self._found[name]

    def _differing(self, change: Change) -> frozenset[tuple[str, str]]:
        """What a change makes other than the file says it, by which answers are kept."""
        said = ((path, value, *found_at(self.design.content, path)) for path, value in change.items())
        return frozenset(
            (path, _number_or_text(value))
            for path, value, stands, now in said
            if (value is not None if not stands else _number_or_text(value) != _number_or_text(now))
        )

    def errors(self, change: Change) -> list[Finding] | None:
        """The errors that count with a change; None where the design is refused."""
        found = self.found(change)
        return None if found is None else errors(found, self.stage)

    @cached_property
    def sure(self) -> "Bench":
        """A bench whose judge is what tells all, with limits of its own; this one without one that does."""
        return self if self.tell is None else Bench(self.design, self.tell, self.stage, self.limits)

    def told(self, finding: Finding, change: Change) -> Finding:
        """A finding of the design with a change, with all that is said of its remedies."""
        if self.tell is None:
            return finding
        found = self.sure.found(change) or ()
        alike = (one for one in found if (one.code, one.severity) == (finding.code, finding.severity))
        return same(finding, found) or next(alike, finding)

    def builds(self, change: Change) -> bool:
        """Whether no error is left with a change."""
        return self.errors(change) == []

    def spoils(self, change: Change) -> bool:
        """Whether a motion that nothing was said against is warned of with a change.

        A crank that turned becomes a lever, say: what builds then is not what was asked for.
        """
        found, start = self.found(change), self.found({})
        if found is None or start is None or errors(start, Stage.MOTION):
            return False
        return bool({one.code for one in _of_motion(found)} - {one.code for one in _of_motion(start)})

    def kept_by(self, change: Change) -> Callable[[Change], bool]:
        """What a smaller change has to keep: that the design builds, and that the motion is not spoiled."""
        spoilt = self.spoils(change)
        return lambda smaller: self.builds(smaller) and (spoilt or not self.spoils(smaller))

    def size(self, change: Change) -> float:
        """How much a change is: how far its keys go, how many they are, and how much they are meant."""
        sizes = (
            self.weight(path) * (KEY + distance(self.keys[path], self.now(self.keys[path]), value))
            for path, value in change.items()
            if path in self.keys
        )
        return sum(sizes) + KEY * len(change.keys() - self.keys.keys())

    def weight(self, path: str) -> float:
        """How much the design means a key: whether its file says it, and whether people set it first."""
        key = self.keys.get(path)
        if key is None or not key.stands_in(self.design.content):
            return 1.0
        return ASKED if key.first else SAID

    def _judged(self, change: Change) -> tuple[Finding, ...] | None:
        if not self.given.isdisjoint(change):
            return None
        start = time.process_time()
        try:
            design = self.design.changed(change)
            self.tries += 1
            near = max(self.tries / self.limits.tries, self._used / self.limits.seconds)
            self.progress(near, "trying changes")
            return tuple(self.judge(design))
        except Exception:  # noqa: BLE001,RUF100 - whatever a design nobody asked for leads to, it is no remedy
            return None
        finally:
            self._used += time.process_time() - start


def _number_or_text(value: Any) -> str:
    """A value by which it is told from others: 9 and 9.0 are one number, 1 and true are not."""
    return repr(float(value) if isinstance(value, int) and not isinstance(value, bool) else value)


def _of_motion(findings: Iterable[Finding]) -> Iterator[Finding]:
    """The warnings among findings that are about the motion."""
    return (one for one in findings if one.severity is Severity.WARNING and one.stage is Stage.MOTION)


def same(finding: Finding, findings: Iterable[Finding] | None) -> Finding | None:
    """Which of some findings says the same; None where none does."""
    known = (one for one in findings or () if (one.code, one.message) == (finding.code, finding.message))
    return next(known, None)


def identity(finding: Finding) -> tuple[str, str]:
    """What makes a finding the same one after a change."""
    return finding.code, finding.parameter


def of_family(
    design: Design, limits: Limits, stage: Stage = Stage.MACHINING, progress: Progress = unheard
) -> Bench:
    """A bench whose judge is the design's family, with what stands around the mechanism."""
    return Bench(
        design,
        Design.judge,
        stage,
        limits,
        Design.check,
        progress,
    )
