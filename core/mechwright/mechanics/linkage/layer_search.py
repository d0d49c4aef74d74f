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

from collections.abc import Callable, Sequence
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


Domains = tuple[frozenset[int], ...]


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
    for height in range(max(map(len, problem.cliques), default=1) - 1, highest + 1):
        domains = tuple(frozenset(layer for layer in choice if layer <= height) for choice in problem.choices)
        if (found := _shortest(problem, domains, height)) is not None:
            return found
    return None


def _shortest(problem: Problem, domains: Domains, height: int) -> tuple[int, ...] | None:
    """The dealing of this height that :func:`flattest` takes."""
    longest = height * len(problem.spindles)
    if (found := _first(problem, domains, height, longest + 1)) is None:
        return None
    most = _length(problem, tuple(frozenset({layer}) for layer in found))
    for length in range(_length(problem, domains), most):
        if (shorter := _first(problem, domains, height, length + 1)) is not None:
            found, most = shorter, length
            break
    # All with these spans are as good: plate after plate takes the lowest layer that still allows one.
    for plate, choice in enumerate(domains):
        for layer in sorted(one for one in choice if one < found[plate]):
            fixed = (*(frozenset({one}) for one in found[:plate]), frozenset({layer}), *domains[plate + 1 :])
            if (lower := _first(problem, fixed, height, most + 1)) is not None:
                found = lower
                break
    return found


def _first(problem: Problem, domains: Domains, height: int, bound: int) -> tuple[int, ...] | None:
    """Some dealing within these domains whose spans sum up to less than the bound."""
    reduced = _reduced(problem, domains, height)
    if reduced is None or _length(problem, reduced) >= bound:
        return None
    free = [plate for plate, domain in enumerate(reduced) if len(domain) > 1]
    if not free:
        return tuple(next(iter(domain)) for domain in reduced)
    plate = min(free, key=lambda one: (len(reduced[one]), -len(problem.foes[one])))
    for layer in sorted(reduced[plate]):
        tried = (*reduced[:plate], frozenset({layer}), *reduced[plate + 1 :])
        if (found := _first(problem, tried, height, bound)) is not None:
            return found
    return None


def _length(problem: Problem, domains: Domains) -> int:
    """The least sum of spans within domains; of single layers the sum itself."""
    total = 0
    for plates, least in zip(problem.spindles, problem.least_spans, strict=True):
        lowest = min(max(domains[plate]) for plate in plates)
        highest = max(min(domains[plate]) for plate in plates)
        total += max(least, highest - lowest)
    return total


def _reduced(problem: Problem, domains: Domains, height: int) -> Domains | None:
    """Domains without the layers that no dealing has; None where that leaves a plate without one."""
    current = list(domains)
    changed = True
    while changed:
        if not all(current) or not set(range(height + 1)) <= set().union(*current):
            return None
        if any(
            len(frozenset().union(*(current[one] for one in some))) < len(some) for some in problem.cliques
        ):
            return None
        changed = any(step(problem, current) for step in _STEPS)
    return tuple(current)


def _kept(domains: list[frozenset[int]], plate: int, allowed: Callable[[int], bool]) -> bool:
    """Whether a domain loses a layer that is not allowed."""
    smaller = frozenset(layer for layer in domains[plate] if allowed(layer))
    lost = len(smaller) < len(domains[plate])
    domains[plate] = smaller
    return lost


def _apart(problem: Problem, domains: list[frozenset[int]]) -> bool:
    """Clashing plates leave each other's layer; those of a group have the same ones."""
    changed = False
    for plate, foes in enumerate(problem.foes):
        if len(domains[plate]) == 1:
            own = domains[plate]
            for foe in foes:
                changed |= _kept(domains, foe, lambda layer, own=own: layer not in own)  # type: ignore[misc]
        for friend in problem.friends[plate]:
            other = domains[friend]
            changed |= _kept(domains, plate, lambda layer, other=other: layer in other)  # type: ignore[misc]
    return changed


def _past(problem: Problem, domains: list[frozenset[int]]) -> bool:
    """Plates that a spindle may not meet stand neither where it passes for certain nor above all it can."""
    changed = False
    for plates, blocked, covered in zip(problem.spindles, problem.blocked, problem.covered, strict=True):
        if not (blocked or covered) or not all(domains[plate] for plate in plates):
            continue
        low = min(max(domains[plate]) for plate in plates)
        high = max(min(domains[plate]) for plate in plates)
        top = max(max(domains[plate]) for plate in plates)
        for plate in blocked:
            changed |= _kept(domains, plate, lambda layer, a=low, b=high: not a <= layer <= b)  # type: ignore[misc]
        for plate in covered:
            changed |= _kept(domains, plate, lambda layer, top=top: layer <= top)  # type: ignore[misc]
    return changed


_STEPS: Sequence[Callable[[Problem, list[frozenset[int]]], bool]] = (_apart, _past)
