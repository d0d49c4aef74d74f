"""From the machines that a search has found to designs: which keep their limits, which are given."""

import math
from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from typing import ClassVar, Generic, TypeVar

import numpy as np
from pydantic import ValidationError

from mechwright.contracts.finding import Finding, errors
from mechwright.contracts.motion import Scalar
from mechwright.contracts.parameters import Parameters
from mechwright.contracts.synthesis import ALIKE, Candidate, Progress, Rejected, Synthesis
from mechwright.mechanics.adjustable.counts import Moves
from mechwright.mechanics.adjustable.machine import Machine, count_note, machines, missed, refusal, rounded
from mechwright.mechanics.adjustable.requirement import PhasedPath

W = TypeVar("W", bound=PhasedPath)
P = TypeVar("P", bound=Parameters)


class Phased(ABC, Generic[W, P]):
    """What a family says of the machines that are found for its requirement ``wanted``.

    ``k`` is the number of a phase, from 0.
    """

    bars: ClassVar[int]
    """4 or 5."""

    out_of_bounds: ClassVar[str]
    """Code under which machines are counted that the family's parameters refuse."""

    good_transmission: ClassVar[float]
    """Degrees; designs with a greater least transmission angle are no better for it."""

    remedy: ClassVar[str]
    """What to do where the points are missed."""

    params: type[P]

    def __init__(self, wanted: W) -> None:
        self.wanted = wanted

    @property
    def moves(self) -> Moves:
        """Which pivots are set."""
        return "moving"

    @property
    def ratio(self) -> float:
        """Turns of a five-bar's arm per turn of the crank; 0 for a four-bar."""
        return 0.0

    @abstractmethod
    def lengths(self, one: Machine, k: int) -> Sequence[float]:
        """Of all links, mm."""

    @abstractmethod
    def branch(self, one: Machine, k: int) -> int:
        """+1 or -1: which of two ways the links are joined."""

    @abstractmethod
    def turns_fully(self, one: Machine, k: int) -> bool:
        """Whether the crank does."""

    @abstractmethod
    def transmission(self, one: Machine, k: int) -> float:
        """Least transmission angle, rad: over the whole motion, or with a lever as far as its points go."""

    @abstractmethod
    def table(self, one: Machine, k: int) -> Mapping[str, object]:
        """The table ``[parameters]`` of the design that shows the phase."""

    @abstractmethod
    def faults(self, params: P) -> Sequence[Finding]:
        """What there is to say of a design, in the phase that it shows."""

    @abstractmethod
    def figures(self, one: Machine, k: int) -> dict[str, Scalar]:
        """What is to be said of a phase besides :meth:`shared_figures`."""

    def all_lengths(self, one: Machine) -> list[float]:
        """Of all links in all phases, mm."""
        return [length for k in range(len(one.theta)) for length in self.lengths(one, k)]

    def weakest(self, one: Machine) -> float:
        """Least transmission angle of all phases, rad."""
        return min(self.transmission(one, k) for k in range(len(one.theta)))

    def rank(self, one: Machine) -> tuple[float, float, float]:
        """The nearest first; of exact ones those with a good transmission angle, the smallest leading."""
        angle = min(self.weakest(one), math.radians(self.good_transmission))
        return one.rms, -angle, max(self.all_lengths(one))

    def shared_figures(self, one: Machine, k: int) -> dict[str, Scalar]:
        """Of a phase: its errors, its transmission angle, and the least distance of holes."""
        misses = one.misses[k]
        found = {
            "phase": Scalar(float(k + 1), ""),
            "phase_error": Scalar(float(np.sqrt(np.mean(misses**2))), "mm"),
            "path_error_max": Scalar(float(misses.max()), "mm"),
            "least_transmission_angle": Scalar(self.transmission(one, k), "rad"),
            "chord_min": Scalar(min(one.chords, default=0.0), "mm"),
            "longest_link": Scalar(max(self.all_lengths(one)), "mm"),
        }
        return found | {f"error_{n}": Scalar(float(miss), "mm") for n, miss in enumerate(misses, start=1)}


def designs_of(family: Phased[W, P], progress: Progress) -> Synthesis[P]:
    """Machines whose coupler point follows all paths, each as one design per phase; the best first."""
    wanted = family.wanted
    task, size, found = machines(
        wanted, family.bars, family.moves, family.ratio, lambda part: progress(0.9 * part, "linkages")
    )
    rejected = Rejected()
    kept = sorted(
        (one for one in (each.rounded(size) for each in found) if _keeps(family, one, rejected)),
        key=family.rank,
    )
    candidates: list[Candidate[P]] = []
    given: list[np.ndarray] = []
    reason = ""
    for looked, exact in enumerate(kept, start=1):
        one = exact
        if wanted.length_step:
            again = rounded(exact, task, size, wanted.length_step)
            if again is None:
                why = f"no multiples of {wanted.length_step:g} mm keep the limits"
                rejected.because("path.length-step", why)
                reason = reason or why
                continue
            if not _keeps(family, again, rejected):
                continue
            one = again
        row = np.array(family.all_lengths(one))
        near = ALIKE * max(size, row.min())
        if any(np.abs(row - other).max() < near for other in given):
            rejected.same()
            continue
        designs = _designs(family, one, rejected)
        if isinstance(designs, str):
            reason = reason or designs
            continue
        given.append(row)
        candidates += designs
        if len(given) == wanted.designs:
            rejected.beyond(wanted.designs, len(kept) - looked)
            break
    progress(1.0, "done")
    notes = [count_note(wanted, family.bars, family.moves)]
    if not candidates:
        return Synthesis((), (*notes, refusal(found, reason)), rejected.reasons)
    if candidates[0].residual.value > wanted.tolerance:
        notes.append(missed(wanted, candidates[0].residual.value, family.remedy))
    return Synthesis(tuple(candidates), tuple(notes), rejected.reasons)


def _keeps(family: Phased[W, P], one: Machine, rejected: Rejected) -> bool:
    """Whether a machine keeps the limits; one that does not is counted under the first that it breaks."""
    if not one.finite:
        return False
    broken = next(_broken(family, one), None)
    if broken is not None:
        rejected.because(*broken)
    return broken is None


def _broken(family: Phased[W, P], one: Machine) -> Iterator[tuple[str, str]]:
    """Codes and messages of the limits that a machine breaks; what costs most is looked at last."""
    wanted, phases = family.wanted, range(len(one.theta))
    lengths = family.all_lengths(one)
    if max(lengths) > wanted.longest_link:
        yield "path.longest-link", f"a link is {max(lengths):.4g} mm long"
    if min(lengths) < wanted.shortest_link:
        yield "path.shortest-link", f"a link is {min(lengths):.4g} mm long"
    if wanted.full_turn and not all(family.turns_fully(one, k) for k in phases):
        yield "path.rotation", "the crank does not turn fully in all phases"
    if not one.in_order:
        yield "path.order", "points are passed out of their order, or not within one turn"
    if len({family.branch(one, k) for k in phases}) > 1:
        yield "path.branch", "the phases are on different branches"
    if (chord := min(one.chords, default=math.inf)) < wanted.least_chord:
        yield "path.chord", f"two places of a pivot are {chord:.4g} mm apart"
    angle = math.degrees(family.weakest(one))
    if angle < wanted.least_transmission_angle:
        yield "path.transmission", f"the transmission angle falls to {angle:.3g} degrees"


def _designs(family: Phased[W, P], one: Machine, rejected: Rejected) -> list[Candidate[P]] | str:
    """A design per phase, or why there is none."""
    found = []
    for k in range(len(one.theta)):
        try:
            params = family.params.model_validate(family.table(one, k))
        except ValidationError as error:
            said = error.errors(include_url=False)[0]["msg"]
            rejected.because(family.out_of_bounds, said)
            return said
        faults = errors(family.faults(params))
        if rejected.by(faults):
            return f"phase {k + 1}: {faults[0].parameter}: {faults[0].message}"
        figures = family.shared_figures(one, k) | family.figures(one, k)
        found.append(Candidate(params, Scalar(one.rms, "mm"), figures))
    return found
