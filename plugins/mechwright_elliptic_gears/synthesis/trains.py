"""Trains that meet a requirement: a search between bounds, teeth that can be cut, the best first."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from mechwright import Array, Candidate, Finding, Progress, Rejected, Scalar, Severity, Synthesis
from mechwright.contracts.finding import errors
from mechwright.contracts.synthesis import ALIKE
from mechwright_elliptic_gears.kinematics.figures import point_peaks, point_window
from mechwright_elliptic_gears.parameters import LEAST_TEETH, EllipticGearParams
from mechwright_elliptic_gears.parts.gear import fillet_mill
from mechwright_elliptic_gears.requirements import BOUNDED, TrainRequirement
from mechwright_elliptic_gears.rules.rule_table import RULES
from mechwright_elliptic_gears.rules.undercut import least_teeth
from mechwright_elliptic_gears.synthesis.search import (
    MISSED,
    UNBUILDABLE,
    Designs,
    evolve,
    peaks,
    shortfall,
    window_lengths,
)
from mechwright_elliptic_gears.table import table_of

GRAIN = {
    "eccentricity": 1e-4,
    "phase": 0.01,
    "semi_major": 0.01,
    "speed": 0.01,
    "point_along": 1e-4,
    "point_across": 0.01,
}
"""Steps of the values in a design file, in its units: ten times finer than a good workshop can make them."""

SAMPLED_STEPS, EXACT_STEPS = (64, 16, 4), (8, 2, 1)
"""Steps of the last search, in grains, with scores from samples, then with exact ones. The first is as wide
as the ridge is known by then; samples miss it by a few grains."""

NICHE = 0.04
"""Around a design that is found, in parts of each range: the next one is sought elsewhere. Where that is less
than the share by which designs differ at least, this share counts."""

MOST_TRIES = 12
"""Numbers of teeth that are tried for a design, odd ones from the least without undercut on: gears with an
odd number can be turned over."""

KINDS = {"least-acceleration": "acceleration", "least-jerk": "jerk"}
"""What a kind makes least; the other one makes the window longest."""


@dataclass(frozen=True)
class Problem:
    """One requirement as a search over the variables that are free."""

    kind: str
    wanted: TrainRequirement
    places: list[Array] = field(default_factory=list)
    """Points (free,) of the unit cube that are found already: what is near them is no new design."""

    @property
    def free(self) -> list[str]:
        """Names of the variables whose bounds differ."""
        fixed = ("semi_major",) if self.wanted.length else ()
        wide = [name for name in BOUNDED if self.wanted.bounds(name)[0] < self.wanted.bounds(name)[1]]
        return [name for name in wide if name not in fixed]

    @property
    def window(self) -> float:
        """Wanted window, rad; 0 where the longest is sought."""
        return math.radians(getattr(self.wanted, "window", 0.0))

    def values(self, points: Array) -> dict[str, Array]:
        """Values (n,) of all variables, in units of design files, at points (n, free) of the unit cube."""
        found = {name: np.full(len(points), self.wanted.bounds(name)[0]) for name in BOUNDED}
        for column, name in enumerate(self.free):
            low, high = self.wanted.bounds(name)
            found[name] = low + (high - low) * points[:, column]
        if self.wanted.length:
            found["semi_major"] = self.wanted.length / (4 * found["eccentricity"])
        return found

    def value(self, point: Array) -> dict[str, float]:
        """Values of all variables at a point (free,) of the unit cube."""
        return {name: float(column[0]) for name, column in self.values(point[None, :]).items()}

    def point(self, value: Mapping[str, float]) -> Array:
        """The point (free,) of the unit cube that has these values."""
        bounds = [self.wanted.bounds(name) for name in self.free]
        return np.array(
            [(value[name] - low) / (high - low) for name, (low, high) in zip(self.free, bounds, strict=True)]
        )

    def known(self, points: Array) -> NDArray[np.bool_]:
        """Which of the points (n, free) are near a design that is found already."""
        near = np.zeros(len(points), dtype=np.bool_)
        for place in self.places:
            near |= (np.abs(points - place) < self.niche(place)).all(axis=1)
        return near

    def niche(self, place: Array) -> Array:
        """Half widths (free,) of what is near a place (free,), in parts of the ranges.

        Where a range is narrow, values that differ by a part of it are one to everybody.
        """
        value = self.value(place)
        bounds = [(value[name], *self.wanted.bounds(name)) for name in self.free]
        return np.array([max(NICHE, ALIKE * abs(one) / (high - low)) for one, low, high in bounds])

    def sampled_score(self, points: Array) -> Array:
        """Score (n,) of points (n, free) of the unit cube, from samples."""
        designs = _designs(self.values(points))
        lacking = shortfall(designs, self.wanted.bore, self.wanted.cutter)
        window = window_lengths(designs, self.wanted.band)
        if self.kind in KINDS:
            top = peaks(designs, KINDS[self.kind])
            score = np.where(window >= self.window, top, MISSED * (1 + self.window - window))
        else:
            score = -window
        score = np.where(lacking > 0, UNBUILDABLE * (1 + lacking), score)
        return np.where(self.known(points), np.inf, score)

    def params(self, value: Mapping[str, float]) -> EllipticGearParams:
        """The design of these values, its teeth still the default number."""
        wanted = self.wanted
        return EllipticGearParams(
            stages=2,
            bore=wanted.bore,
            thickness=wanted.thickness,
            band=wanted.band,
            **{name: value[name] for name in BOUNDED},
        )

    def score(self, value: Mapping[str, float]) -> float:
        """Exact score of a design."""
        if self.known(self.point(value)[None, :])[0]:
            return math.inf
        lacking = shortfall(
            _designs({name: np.array([one]) for name, one in value.items()}),
            self.wanted.bore,
            self.wanted.cutter,
        )[0]
        if lacking > 0:
            return UNBUILDABLE * (1 + float(lacking))
        params = self.params(value)
        window = point_window(params).length
        told = KINDS.get(self.kind)
        if told is None:
            return -window
        if window < self.window:
            return MISSED * (1 + self.window - window)
        return point_peaks(params, (told,))[told].value

    def rounded(self, value: Mapping[str, float]) -> dict[str, float]:
        """Free values on their grains and within the bounds; those that stand, as they are."""
        found = dict(value)
        for name in self.free:
            low, high = self.wanted.bounds(name)
            grain = GRAIN[name]
            # Digits, not multiples: 0.335, not 0.33500000000000002.
            found[name] = min(max(round(round(value[name] / grain) * grain, 6), low), high)
        if self.wanted.length:
            found["semi_major"] = round(self.wanted.length / (4 * found["eccentricity"]), 6)
        return found

    def polished(self, value: Mapping[str, float]) -> tuple[dict[str, float], float]:
        """The best design on the grains near ``value``, and its exact score: a pattern search."""
        best = self._sampled_best(self.rounded(value))
        score = self.score(best)
        for step in EXACT_STEPS:
            moving = True
            while moving:
                moving = False
                for trial in self._around(best, step):
                    found = self.score(trial)
                    if found < score:
                        best, score, moving = trial, found, True
                        break
        return best, score

    def _sampled_best(self, best: dict[str, float]) -> dict[str, float]:
        """The first part of the pattern search: all neighbours at once, the best of them next."""
        for step in SAMPLED_STEPS if self.free else ():
            moving = True
            while moving:
                trials = [best, *self._around(best, step)]
                scores = self.sampled_score(np.array([self.point(trial) for trial in trials]))
                moving = bool(scores.min() < scores[0])
                best = trials[int(scores.argmin())]
        return best

    def _around(self, value: Mapping[str, float], step: int) -> Iterator[dict[str, float]]:
        """Neighbours on the grains: one variable moved, then two."""
        names = self.free
        moves = [{name: sign} for name in names for sign in (1, -1)]
        moves += [
            {one: first, two: second}
            for i, one in enumerate(names)
            for two in names[i + 1 :]
            for first in (1, -1)
            for second in (1, -1)
        ]
        for move in moves:
            moved = {name: value[name] + sign * step * GRAIN[name] for name, sign in move.items()}
            trial = self.rounded({**value, **moved})
            if trial != value:
                yield trial


def _designs(value: Mapping[str, Array]) -> Designs:
    return Designs(
        value["eccentricity"],
        np.radians(value["phase"]),
        value["semi_major"],
        value["speed"] * (math.tau / 60),
        value["point_along"] + 0.5j * value["point_across"] / value["semi_major"],
    )


def synthesise(kind: str, wanted: TrainRequirement, progress: Progress) -> Synthesis[EllipticGearParams]:
    """Designs that meet the requirement, best first."""
    problem = Problem(kind, wanted)
    rng = np.random.default_rng(wanted.seed)
    distinct: list[tuple[float, dict[str, float]]] = []
    # Without a free variable there is one design.
    for number in range(wanted.designs if problem.free else 1):
        trials = []
        for start in range(wanted.starts):
            done = (number + 0.9 * start / wanted.starts) / wanted.designs
            progress(0.9 * done, f"design {number + 1}, search {start + 1} of {wanted.starts}")
            trials.append(evolve(problem.sampled_score, len(problem.free), rng))
        best = trials[int(np.argmin(problem.sampled_score(np.array(trials))))]
        value, score = problem.polished(problem.value(best))
        if math.isinf(score):
            break  # the bounds hold nothing else
        problem.places.append(problem.point(value))
        distinct.append((score, value))
    distinct.sort(key=lambda item: item[0])
    faults: list[Finding] = []
    rejected = Rejected()
    candidates = []
    for number, (score, value) in enumerate(distinct):
        progress(0.9 + 0.1 * number / len(distinct), "teeth")
        if MISSED <= score < UNBUILDABLE:
            faults.append(_missed(problem, value))
            rejected.by(faults[-1:])
            continue
        params, objections = _with_teeth(problem.params(value), wanted.cutter)
        if params is None:
            faults += objections
            rejected.by(objections)
        else:
            candidates.append(_candidate(problem, params))
    progress(1.0, "done")
    # What stands in the way of one design is no fault of the others.
    said = () if candidates else tuple(dict.fromkeys(faults[:1]))
    return Synthesis(tuple(candidates), said, rejected.reasons)


def _missed(problem: Problem, value: Mapping[str, float]) -> Finding:
    most, wanted = math.degrees(point_window(problem.params(value)).length), math.degrees(problem.window)
    return Finding.error(
        "synthesis.window",
        "window",
        f"no design between these bounds has a window of {wanted:.6g} degrees; the nearest has {most:.4g}",
        wanted,
        most,
        "deg",
        f"ask for a window of at most {math.floor(most * 10) / 10:g} degrees, widen the bounds or the band",
    )


def _with_teeth(params: EllipticGearParams, cutter: float) -> tuple[EllipticGearParams | None, list[Finding]]:
    """The design with the least odd number of teeth that nothing is to be said against.

    If there is none, one without an error; if there is none either, the errors of the last number.
    """
    fewest = params.model_copy(update={"teeth": LEAST_TEETH})
    first = least_teeth(fewest)
    if first is None:
        return None, errors(RULES.findings(table_of(fewest)))
    second_best: EllipticGearParams | None = None
    objections: list[Finding] = []
    start = first + (first + 1) % 2
    for teeth in range(start, start + 2 * MOST_TRIES, 2):
        tried = params.model_copy(update={"teeth": teeth})
        mill = fillet_mill(tried)
        if mill < cutter:
            objections = objections or [_no_cutter(tried, mill, cutter)]
            break
        said = RULES.findings(table_of(tried))
        if errors(said):
            objections = errors(said)
        elif any(finding.severity is Severity.WARNING for finding in said):
            second_best = second_best or tried
        else:
            return tried, []
    return second_best, objections


def _no_cutter(params: EllipticGearParams, mill: float, cutter: float) -> Finding:
    return Finding.error(
        "synthesis.cutter",
        "cutter",
        f"{params.teeth} teeth, the least without undercut, have fillets for a mill of {mill:.3f} mm",
        cutter,
        mill,
        "mm",
        f"use a cutter of at most {math.floor(mill * 100) / 100:g} mm, or larger gears",
    )


def _candidate(problem: Problem, params: EllipticGearParams) -> Candidate[EllipticGearParams]:
    window, tops = point_window(params), point_peaks(params)
    # What is wanted is a window, or else as much of the turn as can be.
    wanted = problem.window if problem.kind in KINDS else math.tau
    missing = max(0.0, wanted - window.length)
    shown = {
        "window": Scalar(window.length, "rad"),
        "acceleration": Scalar(tops["acceleration"].value, "mm/s^2"),
        "jerk": Scalar(tops["jerk"].value, "mm/s^3"),
        "window_start": Scalar(window.start, "rad"),
        "window_least_speed": Scalar(window.low, "mm/s"),
        "speed": Scalar(tops["speed"].value, "mm/s"),
    }
    told = KINDS.get(problem.kind, "window")
    measure = "residual" if problem.kind in KINDS else "rest_of_the_turn"
    return Candidate(params, Scalar(missing, "rad"), {told: shown[told], **shown}, measure)
