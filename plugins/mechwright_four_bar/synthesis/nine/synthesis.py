"""Synthesis of every four-bar whose coupler point passes through nine points.

What is special about nine points: why fewer four-bars pass through them than in general.
"""

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from mechwright import Array, Finding, Progress, Scalar, Synthesis
from mechwright.mechanics.planar import Plane
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.kinematics.loop import close
from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.synthesis.burmester.kept import Option, designs, driven
from mechwright_four_bar.synthesis.burmester.rectify import Way, linkage, way_through
from mechwright_four_bar.synthesis.nine.requirement import NinePointsRequirement
from mechwright_four_bar.synthesis.nine.solving import Triples, all_triples
from mechwright_four_bar.synthesis.nine.triples import TRIPLES, members

NEAR = 1e-9
"""Distance from a line or a circle, in sizes of the points, within which a point lies on it."""

FEW = 4
"""Points in one line, or on one circle with one more, that are worth a word: any three lie on a circle."""


CIRCLE = "all points lie on one circle, which a crank's pin draws with any coupler and follower"
"""Then infinitely many linkages pass through the points, whatever isolated ones there are."""


def infinite(points: Plane) -> bool:
    """Whether infinitely many four-bars certainly pass through points (9,): one circle holds them all."""
    return special(points).startswith(CIRCLE)


def special(points: Plane) -> str:
    """What is special about points (9,), x + i y; empty where nothing is.

    >>> special(np.array([k + 0.1j * k for k in range(9)]))
    'all points lie in one line'
    """
    unit = (points - points.mean()) / np.abs(points - points.mean()).max()
    lined = _most(unit, 2)
    if len(lined) == unit.size:
        return "all points lie in one line"
    said = []
    round_ = _most(unit, 3)
    if len(round_) == unit.size:
        said.append(CIRCLE)
    if len(lined) >= FEW:
        said.append(f"points {_listed(lined)} lie in one line")
    if len(round_) > FEW and len(round_) < unit.size:
        said.append(f"points {_listed(round_)} lie on one circle")
    said += [f"the points are their own image under a {what}" for what in _images(unit)]
    return " and ".join(said)


def _listed(numbers: list[int]) -> str:
    first, last = [str(number + 1) for number in numbers[:-1]], numbers[-1] + 1
    return f"{', '.join(first)} and {last}"


def _most(unit: Plane, through: int) -> list[int]:
    """Numbers of the most points on one line through two of them, or on one circle through three."""
    best: list[int] = []
    for some in combinations(range(unit.size), through):
        on = np.flatnonzero(_away(unit, unit[list(some)]) < NEAR).tolist()
        if len(on) > len(best):
            best = on
    return best


def _images(unit: Plane) -> list[str]:
    """Under what points about their mean are the same set."""
    far = unit[np.abs(unit).argmax()]
    found = []
    for what, from_, other in (("reflection", np.conj(far), np.conj(unit)), ("turn", far, unit)):
        for turn in unit / from_:
            same = abs(turn - 1) < NEAR and what == "turn"
            if not same and abs(abs(turn) - 1) < NEAR and _one_set(turn * other, unit):
                found.append(what)
                break
    return found


def _one_set(one: Plane, two: Plane) -> bool:
    return bool(np.abs(one[:, None] - two).min(axis=1).max() < NEAR)


def _away(unit: Plane, few: Plane) -> Array:
    """Distance (9,) from the line through two points, or roughly from the circle through three."""
    along = few[1] - few[0]
    if few.size == 2:
        return np.asarray(np.abs(((unit - few[0]) * np.conj(along)).imag) / abs(along))
    # The cross ratio of four points on a circle is real.
    ratio = (unit - few[0]) * (few[2] - few[1])
    other = (unit - few[1]) * (few[2] - few[0])
    flat = abs((along * np.conj(few[2] - few[0])).imag) < NEAR
    return np.asarray(np.full(unit.size, np.inf) if flat else np.abs((ratio * np.conj(other)).imag))


SOLVED = 0.8
"""Part of the work that finds the triples."""

KEPT = 4
"""Sets of points whose triples are kept: other limits then cost nothing."""


@dataclass(frozen=True)
class Drawn:
    """A real four-bar with its joints at the nine points.

    Parameters
    ----------
    triple, member
        Which triple, from 1, and which of its three four-bars.
    a0, b0
        Fixed pivots, mm.
    a, b
        (9,) joints, mm.
    points
        (9,) the points, mm.
    """

    triple: int
    member: int
    a0: complex
    b0: complex
    a: Plane
    b: Plane
    points: Plane

    @property
    def bar(self) -> FourBar:
        """Its dimensions, driven at A0."""
        return linkage(self.a0, self.b0, self.a, self.b)

    @property
    def driven_at_b0(self) -> "Drawn":
        """The same four-bar, driven at its other pivot."""
        return Drawn(self.triple, self.member, self.b0, self.a0, self.b, self.a, self.points)


_solved: dict[tuple[tuple[str, str], ...], Triples] = {}
"""The triples of the last sets of points, by their coordinates."""


def solved(points: Sequence[tuple[float, float]], progress: Progress) -> Triples:
    """All triples of nine points [x, y], mm, that stand for the decimal numbers that they are written as."""
    texts = tuple((repr(float(x)), repr(float(y))) for x, y in points)
    if texts not in _solved:
        found = all_triples(texts, lambda part: progress(SOLVED * part, "four-bars through nine points"))
        while len(_solved) >= KEPT:
            del _solved[next(iter(_solved))]
        _solved[texts] = found
    return _solved[texts]


def drawn(triples: Triples, points: Plane) -> list[Drawn]:
    """The three four-bars of each real triple, at points (9,), mm."""
    deltas = (points - points[0]) / triples.size
    found: list[Drawn] = []
    for number, one in enumerate(triples.real, start=1):
        for member, z in enumerate(members(one.z[None])[0], start=1):
            x, a, y, b = z[::2]
            turns = _turns(x, a, y, b, deltas)
            first, last = (points + turns * joint * triples.size for joint in (x, y))
            a0, b0 = (complex(points[0] + pivot * triples.size) for pivot in (a, b))
            found.append(Drawn(number, member, a0, b0, first, last, points))
    return found


def _turns(x: complex, a: complex, y: complex, b: complex, deltas: Plane) -> Plane:
    """Turns of the coupler (9,) from the first point to each.

    |δ + x T - a| = |x - a| and the same of the other dyad are two linear equations for T.
    """
    rows, right = [], []
    for joint, pivot in ((x, a), (y, b)):
        off = deltas - pivot
        by = np.conj(off) * joint
        rows.append(np.stack((by.real, -by.imag), axis=-1))
        right.append((abs(joint - pivot) ** 2 - abs(joint) ** 2 - np.abs(off) ** 2) / 2)
    # At the first point both say T = 1 where the dyads are parallel to it; it is known.
    answer = np.ones(deltas.size, dtype=complex)
    solution = np.linalg.solve(np.stack(rows, axis=1)[1:], np.stack(right, axis=1)[1:, :, None])[..., 0]
    answer[1:] = solution[:, 0] + 1j * solution[:, 1]
    return answer


def through_nine(wanted: NinePointsRequirement, progress: Progress) -> Synthesis[FourBarParams]:
    """Every four-bar through the points that keeps the limits, the best transmission angle leading.

    Each real four-bar is driven at either pivot, and of the cognates of a triple, which draw one curve, the
    one that builds best is given. Those that would have to be taken apart, that cannot come
    from one point to the next, or that pass the points in another order, are counted and left out. The first
    finding says how many triples of how many are known.
    """
    points = np.array([complex(x, y) for x, y in wanted.points])
    triples = solved(wanted.points, progress)
    bars = drawn(triples, points)
    defects: Counter[str] = Counter()
    options: list[Option] = []
    for one in bars:
        for each in (one, one.driven_at_b0):
            way = way_through(each.a0, each.b0, each.a, each.b, wanted.order == "kept")
            if isinstance(way, str):
                defects[way] += 1
            else:
                options.append(_option(way, each))
    options.sort(key=lambda one: -driven(one.way, wanted).least_angle)
    full = sum(option.way.full for option in options)
    result = designs(
        "nine-points",
        options,
        dict(defects),
        wanted,
        lambda: (
            f"{_count(triples, infinite(points))}; {len(triples.real)} of them are real, with {len(bars)} "
            "four-bars, driven "
            f"without a defect in {len(options)} ways, in {full} of them by a crank that turns fully"
        ),
        lambda part: progress(SOLVED + (1 - SOLVED) * part, "designs"),
    )
    return Synthesis(result.candidates, (*result.findings, *_doubts(triples, points)), result.rejected)


def _count(triples: Triples, infinite_: bool) -> str:
    """How many were found; all only where nothing else is known to be there."""
    found = len(triples.certified)
    said = "all of them" if triples.complete and not infinite_ else "at least these"
    return f"{found} found of {TRIPLES} triples of cognates, {said}, each certified"


def _doubts(triples: Triples, points: Plane) -> Iterator[Finding]:
    """What is not known of points that are not in general position."""
    open_ones = sum(one.real is None for one in triples.certified)
    if open_ones:
        yield Finding.warning(
            "nine-points.undecided",
            "points",
            f"of {open_ones} triples it is not decided whether they are real",
        )
    why = special(points)
    if triples.complete and not infinite(points):
        return
    yield Finding.warning(
        "nine-points.incomplete",
        "points",
        (f"{why}: " if why else "")
        + f"{len(triples.certified)} found of {TRIPLES} triples: as far as can be seen {triples.far} run to "
        f"infinity and {triples.singular} end in singular solutions, which have no certificate; "
        f"{triples.lost} are lost",
        float(len(triples.certified)),
        float(TRIPLES),
        "",
        "move the points a little, for which the count is complete",
    )


def _option(way: Way, one: Drawn) -> Option:
    """A linkage with the distance by which it misses the points: rounding."""
    along = one.b[0] - one.a[0]
    point = complex((one.points[0] - one.a[0]) / along) * way.bar.coupler
    loop = close(way.bar, way.phi)
    places = one.a0 + loop.joint_a + point * loop.coupler.direction
    error = float(np.sqrt(np.mean(np.abs(places - one.points) ** 2)))
    figures = {"triple": Scalar(float(one.triple), ""), "cognate": Scalar(float(one.member), "")}
    return Option(way, Scalar(error, "mm"), figures, one.a0, point, one.triple)
