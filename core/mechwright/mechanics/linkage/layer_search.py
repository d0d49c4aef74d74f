"""The flattest dealing of plates to layers, by branch and bound.

The search goes through heights from the lowest. At each height it assigns one plate after the other, the one
with the fewest free layers first, and takes from the layers of the others what the assignment excludes. A
branch ends where a plate has no layer left, or where its spindles are at least as long as the best ones.

Glossary
--------
domain
    The layers that are still free for a plate.
span
    Layers from the lowest plate of a spindle to its highest one.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property


@dataclass(frozen=True)
class Problem:
    """Plates by their number, and what keeps them apart.

    Parameters
    ----------
    choices
        Layers in which each plate may stand.
    spindles
        The plates of each spindle.
    clashes
        Pairs of plates that share no layer.
    blocked, covered
        For each spindle the plates that it may not pass through, and those that may not stand above it.
    together
        Groups of plates that share one layer.
    """

    choices: tuple[frozenset[int], ...]
    spindles: tuple[frozenset[int], ...]
    clashes: tuple[frozenset[int], ...]
    blocked: tuple[frozenset[int], ...]
    covered: tuple[frozenset[int], ...]
    together: tuple[frozenset[int], ...] = ()

    @cached_property
    def foes(self) -> tuple[frozenset[int], ...]:
        """The plates that share no layer with each."""
        return tuple(
            frozenset(other for pair in self.clashes if plate in pair for other in pair if other != plate)
            for plate in range(len(self.choices))
        )

    @cached_property
    def friends(self) -> tuple[frozenset[int], ...]:
        """The plates that share the layer of each."""
        return tuple(
            frozenset(other for group in self.together if plate in group for other in group)
            for plate in range(len(self.choices))
        )

    @cached_property
    def cliques(self) -> tuple[frozenset[int], ...]:
        """For each plate a set with it of which all clash: they need as many layers."""
        found = []
        for plate, foes in enumerate(self.foes):
            clique = {plate}
            for other in sorted(foes, key=lambda one: (-len(self.foes[one]), one)):
                if clique <= self.foes[other]:
                    clique.add(other)
            found.append(frozenset(clique))
        return tuple(dict.fromkeys(found))

    @cached_property
    def least_spans(self) -> tuple[int, ...]:
        """No spindle is shorter: of plates that all clash each has a layer of its own."""
        return tuple(
            len(plates) - 1
            if all(other in self.foes[plate] for plate in plates for other in plates if other != plate)
            else 0
            for plates in self.spindles
        )


Domains = tuple[int, ...]
"""The domain of each plate; its bit k stands for layer k."""


def flattest(problem: Problem) -> tuple[int, ...] | None:
    """The layer of each plate in the flattest dealing without an empty layer; None if there is none.

    Of several the one with the least sum of spans; of those the first in the order of plates.

    >>> clash = (frozenset({0, 1}), frozenset({1, 2}))
    >>> free = frozenset({1, 2})
    >>> shaft = (frozenset({0, 2}),)
    >>> flattest(Problem((frozenset({0}), free, free), shaft, clash, (frozenset({1}),), (frozenset(),)))
    (0, 2, 1)
    """
    highest = max((max(choice, default=0) for choice in problem.choices), default=-1)
    every = tuple(sum(1 << layer for layer in choice) for choice in problem.choices)
    for height in range(max(map(len, problem.cliques), default=1) - 1, highest + 1):
        domains = tuple(domain & _up_to(height) for domain in every)
        if (found := _shortest(problem, domains, height)) is not None:
            return found
    return None


def _up_to(layer: int) -> int:
    """The domain of all layers up to this one; of none below 0."""
    return (1 << layer + 1) - 1


def _least(domain: int) -> int:
    return (domain & -domain).bit_length() - 1


def _greatest(domain: int) -> int:
    return domain.bit_length() - 1


def _layers(domain: int) -> list[int]:
    return [layer for layer in range(domain.bit_length()) if domain >> layer & 1]


def _shortest(problem: Problem, domains: Domains, height: int) -> tuple[int, ...] | None:
    """The dealing of this height that :func:`flattest` takes."""
    longest = height * len(problem.spindles)
    if (found := _first(problem, domains, height, longest + 1)) is None:
        return None
    most = _length(problem, tuple(1 << layer for layer in found))
    for length in range(_length(problem, domains), most):
        if (shorter := _first(problem, domains, height, length + 1)) is not None:
            found, most = shorter, length
            break
    # All with these spans are as good: plate after plate takes the lowest layer that still allows one.
    for plate, domain in enumerate(domains):
        for layer in _layers(domain & _up_to(found[plate] - 1)):
            fixed = (*(1 << one for one in found[:plate]), 1 << layer, *domains[plate + 1 :])
            if (lower := _first(problem, fixed, height, most + 1)) is not None:
                found = lower
                break
    return found


def _first(problem: Problem, domains: Domains, height: int, bound: int) -> tuple[int, ...] | None:
    """Some dealing within these domains whose spans sum up to less than the bound."""
    reduced = _reduced(problem, domains, height)
    if reduced is None or _length(problem, reduced) >= bound:
        return None
    free = [plate for plate, domain in enumerate(reduced) if domain & (domain - 1)]
    if not free:
        return tuple(map(_least, reduced))
    plate = min(free, key=lambda one: (reduced[one].bit_count(), -len(problem.foes[one])))
    for layer in _layers(reduced[plate]):
        tried = (*reduced[:plate], 1 << layer, *reduced[plate + 1 :])
        if (found := _first(problem, tried, height, bound)) is not None:
            return found
    return None


def _length(problem: Problem, domains: Domains) -> int:
    """The least sum of spans within domains; of single layers the sum itself."""
    total = 0
    for plates, least in zip(problem.spindles, problem.least_spans, strict=True):
        lowest = min(_greatest(domains[plate]) for plate in plates)
        highest = max(_least(domains[plate]) for plate in plates)
        total += max(least, highest - lowest)
    return total


def _reduced(problem: Problem, domains: Domains, height: int) -> Domains | None:
    """Domains without the layers that no dealing has; None where that leaves a plate or a layer empty."""
    current, last = list(domains), list[int]()
    while current != last:
        last = current.copy()
        if not all(current) or _union(current, range(len(current))) != _up_to(height):
            return None
        if any(_union(current, some).bit_count() < len(some) for some in problem.cliques):
            return None
        _keep_apart(problem, current)
        if not all(current):
            return None
        _keep_off_spindles(problem, current)
    return tuple(current)


def _union(domains: Sequence[int], plates: Iterable[int]) -> int:
    found = 0
    for plate in plates:
        found |= domains[plate]
    return found


def _keep_apart(problem: Problem, domains: list[int]) -> None:
    """Clashing plates leave each other's layer; those of a group have the same ones."""
    for plate, foes in enumerate(problem.foes):
        own = domains[plate]
        if not own & (own - 1):
            for foe in foes:
                domains[foe] &= ~own
        for friend in problem.friends[plate]:
            domains[plate] &= domains[friend]


def _keep_off_spindles(problem: Problem, domains: list[int]) -> None:
    """Plates that a spindle may not meet stand above or below all of its plates, or not over its top."""
    for plates, blocked, covered in zip(problem.spindles, problem.blocked, problem.covered, strict=True):
        if not all(domains[plate] for plate in plates):
            return
        if covered:
            over = ~_up_to(max(_greatest(domains[plate]) for plate in plates))
            for plate in covered:
                domains[plate] &= ~over
        for plate in blocked:
            if not domains[plate] or not _keep_off(domains, plate, plates):
                return


def _keep_off(domains: list[int], plate: int, plates: frozenset[int]) -> bool:
    """A plate is above or below all plates of a spindle; False where a domain becomes empty."""
    low = min(_greatest(domains[one]) for one in plates)
    high = max(_least(domains[one]) for one in plates)
    # The spindle is there in any case.
    domains[plate] &= ~(_up_to(high) & ~_up_to(low - 1))
    own = domains[plate]
    if not own:
        return False
    if low < _least(own):  # above one of them, so above all
        domains[plate] &= ~_up_to(high)
        for one in plates:
            domains[one] &= _up_to(_greatest(own) - 1)
    elif high > _greatest(own):
        domains[plate] &= _up_to(low - 1)
        for one in plates:
            domains[one] &= ~_up_to(_least(own))
    return all(domains[one] for one in (plate, *plates))
