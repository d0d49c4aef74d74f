"""All triples of nine points, each path counted and each solution certified."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
from flint import ctx
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from mechwright import Array
from mechwright.mechanics.continuation import Balls
from mechwright.mechanics.continuation.certificate import BITS
from mechwright.mechanics.planar import Plane
from mechwright_four_bar.synthesis.nine.precise import Certified, certificate, followed, points_of
from mechwright_four_bar.synthesis.nine.start import any_points, start
from mechwright_four_bar.synthesis.nine.tracking import ARRIVED, FAR, LOST, SINGULAR, Paths, settle, tracked
from mechwright_four_bar.synthesis.nine.triples import SAME, TRIPLES, keys, members

CAREFUL = (1e-6, 0.02)
"""Error of predictions and longest step of paths that are followed again, because two came to one end."""

DETOURS = 3
"""Other ways on which all paths are followed again while triples are missing."""

PRECISE = 12
"""Most paths that are followed in ball arithmetic, seconds each: of points in general position one or two are
lost. Where more are, the points are special, and their ends are singular in any arithmetic."""

AT_END = 1e-4
"""Share of the way before its end from which a path that stops has a singular end: of points in general
position none has, and paths stop where doubles do not tell two solutions apart, anywhere on the way."""

LOOKS = (1e-3, 1e-5)
"""Shares of the way before the end at which the size of such a path is looked at."""

GROWS = 2.0
"""Growth between these from which a path runs to infinity, as with (1 - t) to the power -1/6."""

NEAR = 1e-3
"""Difference of keys below which balls decide whether two triples are one; theirs are far smaller."""

SETTLING = 3
"""Steps of Newton at the end of a path in doubles."""

Progress = Callable[[float], None]


@dataclass
class Triples:
    """What is known of the four-bars through nine points.

    Parameters
    ----------
    certified
        One solution of each triple, proven and distinct.
    origin, size
        The first point, mm, and mm to one unit of the solutions.
    far
        Paths that run to infinity.
    singular
        Paths that come to singular solutions: several to one, or to one of a family, or to a degenerate one.
    lost
        Paths of which nothing of this is known.
    precise
        Paths that were followed in ball arithmetic.
    detours
        Times that all paths were followed again on another way.
    """

    origin: complex
    size: float
    certified: list[Certified] = field(default_factory=list)
    far: int = 0
    singular: int = 0
    lost: int = 0
    precise: int = 0
    detours: int = 0

    @property
    def complete(self) -> bool:
        """Whether as many were found as nine points in general have."""
        return len(self.certified) == TRIPLES

    @property
    def real(self) -> list[Certified]:
        """Those that are real four-bars."""
        return [one for one in self.certified if one.real]


def all_triples(texts: Sequence[tuple[str, str]], progress: Progress, seed: int = 0) -> Triples:
    """Every triple of four-bars whose coupler point passes through nine points.

    Parameters
    ----------
    texts
        Nine points [x, y], mm, as decimal numbers: the certificates are for these very numbers.
    progress
        Told the part that is done, 0 to 1.
    seed
        Of the detours.

    Returns
    -------
    Triples
        Complete for points in general position; else with what is missing.
    """
    places = np.array([complex(float(x), float(y)) for x, y in texts])
    deltas = places[1:] - places[0]
    size = float(np.abs(deltas).mean())
    answer = Triples(complex(places[0]), size)
    exact = points_of(texts, size)
    target = np.array([deltas, deltas.conj()], dtype=np.complex128) / size
    rng = np.random.default_rng(seed)
    base = start()
    found, how = _ends(base.solutions, base.points, target, exact, answer)
    progress(0.3)
    answer.certified = _distinct(_proven(found, exact, lambda part: progress(0.3 + 0.5 * part)))
    _count(answer, how)
    while answer.lost and answer.detours < DETOURS:
        answer.detours += 1
        via = any_points(rng)
        first = _through(base.solutions, base.points, via)
        found, how = _ends(first, via, target, exact, answer)
        fresh = _proven(_unknown(found, answer.certified), exact, _unheard)
        known, answer.certified = len(answer.certified), _distinct([*answer.certified, *fresh])
        _count(answer, how)
        progress(0.8 + 0.2 * answer.detours / DETOURS)
        if len(answer.certified) == known:
            break
    progress(1.0)
    return answer


def _unheard(part: float) -> None:
    """Progress of what is soon done."""


def _count(answer: Triples, how: NDArray[np.int64]) -> None:
    """What is known of the paths that have no certified end of their own."""
    missing = TRIPLES - len(answer.certified)
    answer.far = min(int((how == FAR).sum()), missing)
    answer.singular = min(int((how == SINGULAR).sum()), missing - answer.far)
    answer.lost = missing - answer.far - answer.singular


def _through(starts: Plane, begin: Plane, end: Plane) -> Plane:
    """Where the paths of solutions (n, 8) arrive."""
    ends, how = _followed(starts, begin, end)[:2]
    arrived: Plane = ends[how == ARRIVED]
    return arrived


def _followed(starts: Plane, begin: Plane, end: Plane) -> tuple[Plane, NDArray[np.int64], Array]:
    """Ends (n, 8), how and how far of paths; one that is lost is followed by the other members of its triple.

    Of the three four-bars one may be far out or near to a degenerate one where another is not.
    """
    paths = tracked(starts, begin, end)
    ends, how, reached = paths.ends, paths.how, paths.reached
    for number in (1, 2):
        lost = np.flatnonzero(how != ARRIVED)
        if lost.size:
            others = np.ascontiguousarray(members(starts[lost])[:, number])
            again: Paths = tracked(others, begin, end)
            better = (again.how == ARRIVED) | ((how[lost] != FAR) & (again.reached > reached[lost]))
            ends[lost[better]] = again.ends[better]
            how[lost[better]] = again.how[better]
            reached[lost[better]] = again.reached[better]
    _parted(starts, begin, end, ends, how)
    return ends, how, reached


def _parted(starts: Plane, begin: Plane, end: Plane, ends: Plane, how: NDArray[np.int64]) -> None:
    """Follow again, with more care, paths that came to one end: one of them has changed to another's way."""
    there = np.flatnonzero(how == ARRIVED)
    found = ends[there]
    settle(found, end, SETTLING, np.empty(len(found)))
    prints = keys(found)
    fine = np.isfinite(prints).all(axis=1)
    pairs = cKDTree(prints[fine]).query_pairs(SAME, output_type="ndarray")
    doubled = there[fine][np.unique(pairs)]
    if doubled.size:
        again = tracked(starts[doubled], begin, end, *CAREFUL)
        arrived = again.how == ARRIVED
        ends[doubled[arrived]] = again.ends[arrived]


def _ends(
    starts: Plane, begin: Plane, target: Plane, exact: Balls, answer: Triples
) -> tuple[list[Plane | Balls], NDArray[np.int64]]:
    """Ends of paths to the points, those in balls of which doubles lost sight, and how the paths end."""
    ends, how, reached = _followed(starts, begin, target)
    found: list[Plane | Balls] = list(ends[how == ARRIVED])
    lost = np.flatnonzero(how != ARRIVED)
    _judge_ends(starts, begin, target, how, reached)
    for i in lost if lost.size <= PRECISE else ():
        last = followed(ends[i], begin, exact, float(reached[i]))
        answer.precise += 1
        if last is not None:
            how[i] = ARRIVED
            found.append(last)
    return found, how


def _judge_ends(starts: Plane, begin: Plane, target: Plane, how: NDArray[np.int64], reached: Array) -> None:
    """Say of paths that stop at their ends whether they run to infinity or to a singular solution."""
    there = np.flatnonzero((how == LOST) & (reached > 1 - AT_END))
    if not there.size:
        return
    sizes = [
        np.abs(members(_followed(starts[there], begin, begin + (1 - look) * (target - begin))[0])).max(
            axis=(1, 2)
        )
        for look in LOOKS
    ]
    how[there] = np.where(sizes[1] > GROWS * sizes[0], FAR, SINGULAR)


def _proven(found: Sequence[Plane | Balls], exact: Balls, progress: Progress) -> list[Certified]:
    answer: list[Certified] = []
    for number, one in enumerate(found):
        proof = certificate(one, exact)
        if proof is not None:
            answer.append(proof)
        if number % 50 == 0:
            progress(number / len(found))
    return answer


def _keys(certified: Sequence[Certified]) -> Array:
    return keys(np.array([one.z for one in certified]).reshape(-1, 8))


def _unknown(found: Sequence[Plane | Balls], certified: Sequence[Certified]) -> list[Plane | Balls]:
    """Ends that are no solution already proven, as far as doubles tell."""
    ends = np.array([[complex(value) for value in one] for one in found]).reshape(-1, 8)
    away, _ = cKDTree(_keys(certified)).query(keys(ends)) if certified else (np.full(len(ends), np.inf), None)
    return [one for one, distance in zip(found, away, strict=True) if not distance < SAME]


def _distinct(certified: Sequence[Certified]) -> list[Certified]:
    """One of each triple: of two whose fingerprints may be one, the first."""
    if not certified:
        return []
    pairs = cKDTree(_keys(certified)).query_pairs(NEAR)
    dropped: set[int] = set()
    with ctx.workprec(BITS):
        for i, k in sorted(pairs):
            one, other = certified[i].fingerprint, certified[k].fingerprint
            if i not in dropped and all(a.overlaps(b) for a, b in zip(one, other, strict=True)):
                dropped.add(k)
    return [one for i, one in enumerate(certified) if i not in dropped]
