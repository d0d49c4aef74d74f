"""The search for numbers of a chain: a bounded one, which says what it tried.

A third of the tries is spread evenly within the bounds, the others go from the best one along each number
and along drawn directions, with steps that are halved where none is better. A chain is better that misses its
limits by less, then one whose figure is less; one that its families would refuse counts as missing them.
Nothing says that what is found is the least of all.
"""

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np
from pydantic import ValidationError

from mechwright.arrays import Array
from mechwright.contracts.design_table import DesignTable
from mechwright.contracts.finding import Finding, Stage, errors
from mechwright.contracts.motion import Scalar
from mechwright.contracts.synthesis import Candidate, Progress, Rejected, Synthesis
from mechwright.errors import MechwrightError, PluginFaultError
from mechwright.mechanics.chain.checks import rules_of
from mechwright.mechanics.chain.indexing import index_figures
from mechwright.mechanics.chain.links import links_of
from mechwright.mechanics.chain.motion import motion_of, rate_figures
from mechwright.mechanics.chain.numbers import Numbers
from mechwright.mechanics.chain.params import ChainParams, Families
from mechwright.mechanics.chain.placing import in_plan
from mechwright.mechanics.chain.wanted import ChainRequirement, FigureLimit
from mechwright.tolerances import exceeds

_SPREAD = 3
"""One in so many tries is spread over the bounds."""

_FIRST_STEP, _LAST_STEP = 0.15, 1e-3
"""Shares of the bounds: the first step along a number, and the one below which nothing is sought."""

_REFUSED = 1e3
"""By what a chain counts as missing its limits that its families refuse: more than any figure misses them."""

_SAMPLES = 3
"""Of a motion whose figures are asked for: those do not depend on them."""


@dataclass(frozen=True, order=True)
class Merit:
    """How good a chain is: by how much it misses its limits, then its figure; less is better."""

    missed: float
    value: float


@dataclass
class Search:
    """A search under way."""

    wanted: ChainRequirement
    families: Families
    numbers: Numbers
    progress: Progress
    rejected: Rejected = field(default_factory=Rejected)
    tried: dict[tuple[float, ...], Merit] = field(default_factory=dict)
    known: frozenset[str] = frozenset()
    unable: str = ""

    @property
    def sign(self) -> float:
        """-1 where the greatest is sought."""
        return -1.0 if self.wanted.least.startswith("-") else 1.0

    @property
    def figure(self) -> str:
        """Whose least or greatest value is sought."""
        return self.wanted.least.removeprefix("-")

    def merit(self, place: tuple[float, ...], best: Merit) -> Merit:
        """Of a place (n,), 0 to 1 within the bounds; remembered."""
        if place not in self.tried:
            self.progress(len(self.tried) / self.wanted.tries, f"least {self.figure}")
            self.tried[place] = self._merit(place, best)
        return self.tried[place]

    def _merit(self, place: tuple[float, ...], best: Merit) -> Merit:
        try:
            params = self.numbers.at(place)
            figures = self.figures(params)
        except PluginFaultError:  # of no design
            raise
        except (MechwrightError, ValidationError) as error:
            self.unable = self.unable or _first(error)
            self.rejected.because("chain.no-motion", _first(error))
            return Merit(math.inf, math.inf)
        self.known |= figures.keys()
        if self.figure not in figures or any(one.figure not in figures for one in self.wanted.limits):
            return Merit(math.inf, math.inf)
        missed = sum(missing(one, figures[one.figure]) for one in self.wanted.limits)
        found = Merit(missed, self.sign * figures[self.figure].value)
        if found >= best:
            if missed == 0:
                self.rejected.because("chain.not-the-least", f"its {self.figure} is not the least")
            return found
        findings = rules_of(self.families).findings(DesignTable(params), quick=True)
        faults = errors(findings, Stage.PARTS)
        if faults:
            self.rejected.because(faults[0].code, faults[0].message)
            return Merit(_REFUSED + len(faults) + missed, found.value)
        return found

    def figures(self, params: ChainParams) -> Mapping[str, Scalar]:
        """Of a chain: those of its rates and moves, and those of its stages only where one is asked for."""
        figures = rate_figures(params, self.families) | index_figures(params, self.families)
        asked = {self.figure, *(one.figure for one in self.wanted.limits)}
        if asked <= figures.keys():
            return figures
        motion = motion_of(params, self.families, in_plan(links_of(params, self.families)), _SAMPLES)
        return motion.scalars

    def places(self) -> Iterator[tuple[float, ...]]:
        """That of the file, and others spread over the bounds."""
        yield self.numbers.begin
        count, free = max(2, self.wanted.tries // _SPREAD), len(self.wanted.free)
        rng = np.random.default_rng(self.wanted.seed)
        columns = [(rng.permutation(count) + rng.random(count)) / count for _ in range(free)]
        yield from (tuple(map(float, row)) for row in np.stack(columns, axis=1))

    def run(self) -> tuple[tuple[float, ...], Merit]:
        """The best place and its merit."""
        best, merit = self.numbers.begin, Merit(math.inf, math.inf)

        def better(place: tuple[float, ...]) -> bool:
            nonlocal best, merit
            found = self.merit(self.numbers.rounded(place), merit)
            if found < merit:
                best, merit = self.numbers.rounded(place), found
                return True
            return False

        for place in self.places():
            better(place)
        rng, step = np.random.default_rng(self.wanted.seed), _FIRST_STEP
        while step >= _LAST_STEP and len(self.tried) < self.wanted.tries and math.isfinite(merit.missed):
            if not self._round(lambda: best, better, step, rng):
                step /= 2
        return best, merit

    def _round(
        self,
        best: Callable[[], tuple[float, ...]],
        better: Callable[[tuple[float, ...]], bool],
        step: float,
        rng: np.random.Generator,
    ) -> bool:
        """A step each way along each number and some drawn directions; a good one is taken again.

        The directions lead along ridges, where a step of one number alone is none. Whether any was good.
        """
        good, free = False, len(self.wanted.free)
        drawn = rng.normal(size=(free if free > 1 else 0, free))
        drawn /= np.linalg.norm(drawn, axis=1, keepdims=True)
        for way in np.concatenate((np.eye(free), drawn)):
            for side in (step, -step):
                while len(self.tried) < self.wanted.tries and better(_moved(best(), side * way)):
                    good = True
        return good


def _moved(place: tuple[float, ...], way: Array) -> tuple[float, ...]:
    return tuple(np.clip(np.add(place, way), 0.0, 1.0).tolist())


def missing(limit: FigureLimit, figure: Scalar) -> float:
    """By what share of itself a figure misses its bounds; 0 where it keeps them."""
    value = shown(figure)
    missed = 0.0
    for bound, over in ((limit.most, 1.0), (limit.least, -1.0)):
        if bound is not None and exceeds(over * value, over * bound):
            missed += over * (value - bound) / max(abs(bound), 1e-9 * abs(value), _TINY)
    return missed


_TINY = 1e-12
"""Of a bound at 0, by which nothing is divided."""


def shown(figure: Scalar) -> float:
    """Its value as people read it: angles in degrees."""
    return math.degrees(figure.value) if figure.unit == "rad" else figure.value


def sought(
    wanted: ChainRequirement, base: ChainParams, families: Families, progress: Progress
) -> Synthesis[ChainParams]:
    """The best chain of a search, or what kept it from one; DesignError for a key that is no number."""
    search = Search(wanted, families, Numbers.of(wanted.free, base), progress)
    place, merit = search.run()
    if merit.missed == 0:
        params = search.numbers.at(place)
        figures = search.figures(params)
        told = {search.figure: figures[search.figure]}
        told |= {one.figure: figures[one.figure] for one in wanted.limits}
        free = {key: Scalar(value, "") for key, value in search.numbers.values(place).items()}
        note = Finding.note(
            "chain.sought",
            f"the least of {len(search.tried)} chains within the bounds; whether there is less is not known",
            len(search.tried),
        )
        best = Candidate(params, Scalar(0.0, figures[search.figure].unit), {**told, **free})
        return Synthesis((best,), (note,), search.rejected.reasons)
    return Synthesis((), (_nothing(search, place, merit),), search.rejected.reasons)


def _nothing(search: Search, place: tuple[float, ...], merit: Merit) -> Finding:
    wanted = search.wanted
    for field_name, name in (("least", search.figure), *(("limits", one.figure) for one in wanted.limits)):
        if search.known and name not in search.known:
            known = ", ".join(sorted(search.known))
            message = f"the chain has no figure {name}"
            return Finding.error("chain.no-figure", field_name, message, remedy=f"name one of: {known}")
    if not math.isfinite(merit.missed):
        message = f"no chain within the bounds moves: {search.unable}"
        return Finding.error("chain.no-motion", "free", message, remedy="change the bounds, or the stages")
    where = ", ".join(f"{key} = {value:g}" for key, value in search.numbers.values(place).items())
    if merit.missed >= _REFUSED:
        why = search.rejected.reasons[0].message
        return Finding.error(
            "chain.not-buildable",
            "free",
            f"of {len(search.tried)} chains within the bounds none that keeps the limits can be built: {why}",
            remedy=f"change the bounds, or the stages; the nearest was at {where}",
        )
    figures = search.figures(search.numbers.at(place))
    worst = max(wanted.limits, key=lambda one: missing(one, figures[one.figure]))
    value = shown(figures[worst.figure])
    bound = worst.most if worst.most is not None and value > worst.most else worst.least
    return Finding.error(
        "chain.limits",
        "limits",
        f"of {len(search.tried)} chains within the bounds none keeps all limits: {worst.figure} is "
        f"{value:.5g} at the nearest, {where}",
        value,
        bound,
        remedy=f"let {worst.figure} come to {value:.5g}, or widen the bounds",
    )


def _first(error: Exception) -> str:
    return str(error).splitlines()[-1 if isinstance(error, ValidationError) else 0].strip()[:300]
