"""All solutions at the parameters that are asked for, each path counted and each solution certified."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
from flint import ctx

from mechwright.mechanics.continuation.certificate import BITS, balls, is_own, krawczyk, middle, refined
from mechwright.mechanics.continuation.loops import settled
from mechwright.mechanics.continuation.paths import tracked
from mechwright.mechanics.continuation.system import Balls, System
from mechwright.mechanics.planar import Plane

DETOURS = 3
"""Other ways on which all solutions are followed again while some are missing."""


@dataclass(frozen=True)
class Start:
    """Parameters in general position and all solutions there.

    Parameters
    ----------
    parameters
        (k,).
    solutions
        (n, m).
    """

    parameters: Plane
    solutions: Plane


@dataclass(frozen=True)
class Proven:
    """A solution that is proven.

    Parameters
    ----------
    box
        (m,) balls that hold it, and no other solution.
    real
        Whether it is its own conjugate; None where that is not decided.
    """

    box: Balls
    real: bool | None


@dataclass(frozen=True)
class Solutions:
    """What is known of the solutions at some parameters.

    Parameters
    ----------
    proven
        Distinct, each certified.
    of
        How many there are at parameters in general position.
    """

    proven: tuple[Proven, ...]
    of: int

    @property
    def complete(self) -> bool:
        """Whether as many are proven as there are in general."""
        return len(self.proven) == self.of

    @property
    def real(self) -> tuple[Proven, ...]:
        """Those that are their own conjugates."""
        return tuple(one for one in self.proven if one.real)

    @property
    def count(self) -> str:
        """A part of a sentence that says how many of how many, and what that means."""
        said = "all of them" if self.complete else "at least these"
        return f"{len(self.proven)} found of {self.of} solutions, {said}, each certified"


@cache
def read(file: Path, system: System) -> Start:
    """A start that is kept as data: ``parameters`` (k,) and ``solutions`` (n, m)."""
    with np.load(file) as kept:
        parameters, solutions = kept["parameters"], kept["solutions"]
    return Start(parameters, settled(system, solutions, parameters))


def all_solutions(
    system: System,
    start: Start,
    parameters: Balls,
    conjugate: Callable[[Balls], Balls],
    elsewhere: Callable[[np.random.Generator], Plane],
) -> Solutions:
    """Follow every solution of a start to real parameters, and prove where it has come.

    Paths that are lost are followed again through other complex parameters. At special parameters solutions
    run to infinity or come together: then fewer are found than there are in general.

    Parameters
    ----------
    parameters
        (k,) balls.
    conjugate
        The conjugate of unknowns (m,), which at these parameters solves the equations where the unknowns do.
    elsewhere
        Draws complex parameters (k,).
    """
    rng = np.random.default_rng(len(start.solutions))
    target = np.array([complex(one) for one in parameters])
    proven: list[Proven] = []
    begin, known = start.parameters, start.solutions
    for detour in range(1 + DETOURS):
        if detour:
            begin = elsewhere(rng)
            known = tracked(system, start.solutions, start.parameters, begin).arrived
        ends = tracked(system, known, begin, target).arrived
        proven = _with_new(proven, ends, system, parameters, conjugate)
        if len(proven) == len(start.solutions):
            break
    return Solutions(tuple(proven), len(start.solutions))


def certified(
    system: System, z: Plane, parameters: Balls, conjugate: Callable[[Balls], Balls]
) -> Proven | None:
    """The solution near ``z`` (m,) at parameters (k,), proven; None where that cannot be done."""
    with ctx.workprec(BITS):
        exact = middle(parameters)
        here = refined(balls(z), lambda one: system.in_balls(one, exact))
        proof = None if here is None else krawczyk(here, lambda one: system.in_balls(one, parameters))
        if proof is None:
            return None
        box, image = proof
        return Proven(image, is_own(box, image, conjugate(image)))


def _with_new(
    proven: Sequence[Proven],
    ends: Plane,
    system: System,
    parameters: Balls,
    conjugate: Callable[[Balls], Balls],
) -> list[Proven]:
    """Certificates with those of further ends (n, m); boxes that meet are taken for one solution."""
    answer = list(proven)
    for end in ends:
        one = certified(system, end, parameters, conjugate)
        if one is not None and not any(_meet(one.box, other.box) for other in answer):
            answer.append(one)
    return answer


def _meet(one: Balls, other: Balls) -> bool:
    return all(a.overlaps(b) for a, b in zip(one, other, strict=True))
