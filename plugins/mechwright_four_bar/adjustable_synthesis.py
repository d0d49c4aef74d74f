"""Synthesis of adjustable four-bars: one set of links whose pivots are set to a path per phase."""

import math

import numpy as np
from pydantic import ValidationError

from mechwright import Candidate, Progress, Rejected, Scalar, Synthesis
from mechwright.contracts.finding import errors
from mechwright.mechanics.adjustable import PlaneSpace, settings_of
from mechwright.mechanics.adjustable.machine import SAME, Machine, count_note, machines, missed, refusal
from mechwright.mechanics.multistart import distinct
from mechwright_four_bar.checks import GOOD_TRANSMISSION, findings
from mechwright_four_bar.dimensions import FourBar
from mechwright_four_bar.loop import close
from mechwright_four_bar.params import FourBarParams
from mechwright_four_bar.phases import in_phase
from mechwright_four_bar.requirements import AdjustablePathRequirement

MISSED = 'allow a larger tolerance, leave points out, set moves = "both", or use more starts'


def bar_in(one: Machine, phase: int) -> FourBar:
    """Dimensions of a machine's phase, from 0."""
    a0, a, b0, c = (complex(getattr(one.pins, name)[phase]) for name in ("a0", "a", "b0", "c"))
    side = PlaneSpace(0j).side(np.array(a), np.array(b0), np.array(c))
    return FourBar(abs(a - a0), abs(c - a), abs(c - b0), abs(b0 - a0), float(np.angle(b0 - a0)), int(side))


def through_phases(wanted: AdjustablePathRequirement, progress: Progress) -> Synthesis[FourBarParams]:
    """Machines whose coupler point follows all paths, each as one design per phase; the best first."""
    size, found = machines(wanted, 4, wanted.moves, 0.0, lambda part: progress(0.9 * part, "linkages"))
    rejected = Rejected()
    kept = [one.rounded(size) for one in found if _keeps(one, wanted, rejected)]
    kept.sort(key=lambda one: _rank(one, wanted))
    candidates: list[Candidate[FourBarParams]] = []
    given: list[np.ndarray] = []
    reason = ""
    for one in kept:
        row = (
            np.concatenate([[bar.crank, bar.coupler, bar.follower, bar.ground] for bar in _bars(one)]) / size
        )
        if given and distinct(np.array([*given, row]), SAME).size <= len(given):
            continue
        designs = _designs(one, wanted, rejected)
        if isinstance(designs, str):
            reason = reason or designs
            continue
        given.append(row)
        candidates += designs
        if len(given) == wanted.designs:
            break
    progress(1.0, "done")
    notes = [count_note(wanted, 4, wanted.moves)]
    if not candidates:
        return Synthesis((), (*notes, refusal(found, reason)), rejected.reasons)
    if candidates[0].residual.value > wanted.tolerance:
        notes.append(missed(wanted, candidates[0].residual.value, MISSED))
    return Synthesis(tuple(candidates), tuple(notes), rejected.reasons)


def _bars(one: Machine) -> list[FourBar]:
    return [bar_in(one, k) for k in range(len(one.theta))]


def _transmission(one: Machine, k: int, full: bool) -> float:
    """Least transmission angle of a phase, rad: over a turn, or as far as its points go."""
    bar = bar_in(one, k)
    if full:
        return bar.least_transmission_angle()
    start = float(np.angle(one.pins.a[k] - one.pins.a0[k])) - bar.ground_angle
    return bar.transmission_range(start, start + float(one.theta[k][-1]))[0]


def _weakest(one: Machine, wanted: AdjustablePathRequirement) -> float:
    return min(_transmission(one, k, wanted.full_turn) for k in range(len(one.theta)))


def _rank(one: Machine, wanted: AdjustablePathRequirement) -> tuple[float, float, float]:
    """The nearest first; of exact ones those with a good transmission angle, the smallest leading."""
    angle = min(_weakest(one, wanted), math.radians(GOOD_TRANSMISSION))
    return one.rms, -angle, max(max(bar.lengths) for bar in _bars(one))


def _keeps(one: Machine, wanted: AdjustablePathRequirement, rejected: Rejected) -> bool:
    """Whether a machine keeps the limits; one that does not is counted under the first that it breaks."""
    bars = _bars(one)
    if not one.finite:
        return False
    lengths = [length for bar in bars for length in bar.lengths]
    chords = one.chords
    broken = {
        "path.longest-link": (max(lengths) > wanted.longest_link, f"a link is {max(lengths):.4g} mm long"),
        "path.shortest-link": (min(lengths) < wanted.shortest_link, f"a link is {min(lengths):.4g} mm long"),
        "path.rotation": (
            wanted.full_turn and not all(bar.kind.full_turn for bar in bars),
            "the crank does not turn fully in all phases",
        ),
        "path.order": (
            not one.in_order,
            "points are passed out of their order, or not within one turn",
        ),
        "path.branch": (
            len({bar.branch for bar in bars}) > 1,
            "the phases are on different branches",
        ),
        "path.chord": (
            bool(chords) and min(chords) < wanted.least_chord,
            f"two places of a pivot are {min(chords, default=0.0):.4g} mm apart",
        ),
    }
    for code, (breaks, message) in broken.items():
        if breaks:
            rejected.because(code, message)
            return False
    angle = math.degrees(_weakest(one, wanted))
    if angle < wanted.least_transmission_angle:
        rejected.because("path.transmission", f"the transmission angle falls to {angle:.3g} degrees")
        return False
    return True


def _designs(
    one: Machine, wanted: AdjustablePathRequirement, rejected: Rejected
) -> list[Candidate[FourBarParams]] | str:
    """A design per phase, or why there is none."""
    found = []
    for k in range(len(one.theta)):
        try:
            params = FourBarParams.model_validate(_table(one, k, wanted))
        except ValidationError as error:
            said = error.errors(include_url=False)[0]["msg"]
            rejected.because("four-bar.out-of-bounds", said)
            return said
        faults = errors(findings(in_phase(params)))
        if rejected.by(faults):
            return f"phase {k + 1}: {faults[0].parameter}: {faults[0].message}"
        found.append(Candidate(params, Scalar(one.rms, "mm"), _figures(one, k, wanted)))
    return found


def _table(one: Machine, k: int, wanted: AdjustablePathRequirement) -> dict[str, object]:
    """The table ``[parameters]`` that shows a phase, from 0."""
    settable = wanted.moves == "moving"
    own = 0 if settable else k
    bar = bar_in(one, own)
    a0, a, c, p = (complex(getattr(one.pins, name)[own]) for name in ("a0", "a", "c", "p"))
    point = (p - a) * (c - a).conjugate() / abs(c - a)
    table: dict[str, object] = {
        "crank": bar.crank,
        "coupler": bar.coupler,
        "follower": bar.follower,
        "ground": bar.ground,
        "ground_angle": math.degrees(bar.ground_angle),
        "branch": "open" if bar.branch > 0 else "crossed",
        "pivot_x": a0.real,
        "pivot_y": a0.imag,
        "coupler_point_x": point.real,
        "coupler_point_y": point.imag,
    }
    start = math.degrees(float(np.angle(one.pins.a[k] - one.pins.a0[k])))
    if wanted.full_turn:
        table["direction"] = "ccw" if one.theta[k][-1] > 0 else "cw"
    else:
        table |= {"swing_from": start, "swing_to": start + math.degrees(one.theta[k][-1])}
    if settable and len(one.theta) > 1:
        settings = settings_of(PlaneSpace(0j), one.pins)
        table["setting_angle"] = math.degrees(float(np.angle(a - a0)))
        table["phase"] = k + 1
        table["phases"] = [
            {"crank_turn": crank, "follower_turn": follower}
            for crank, follower in np.degrees([settings.crank, settings.follower]).T[1:].tolist()
        ]
    return table


def _figures(one: Machine, k: int, wanted: AdjustablePathRequirement) -> dict[str, Scalar]:
    """What is to be said of a phase: its errors point by point, and crank and follower at each."""
    settings = settings_of(PlaneSpace(0j), one.pins)
    bar, misses, theta = bar_in(one, k), one.misses[k], one.theta[k]
    start = float(np.angle(one.pins.a[k] - one.pins.a0[k]))
    loop = close(bar, start + theta)
    follower = np.angle(loop.follower.direction)
    figures = {
        "phase": Scalar(float(k + 1), ""),
        "phase_error": Scalar(float(np.sqrt(np.mean(misses**2))), "mm"),
        "path_error_max": Scalar(float(misses.max()), "mm"),
        "transmission_min": Scalar(_transmission(one, k, wanted.full_turn), "rad"),
        "crank_turned": Scalar(float(settings.crank[k]), "rad"),
        "follower_turned": Scalar(float(settings.follower[k]), "rad"),
        "chord_min": Scalar(min(one.chords, default=0.0), "mm"),
        "longest_link": Scalar(max(max(each.lengths) for each in _bars(one)), "mm"),
    }
    for number in range(len(misses)):
        figures[f"error_{number + 1}"] = Scalar(float(misses[number]), "mm")
        figures[f"crank_angle_{number + 1}"] = Scalar(start + float(theta[number]), "rad")
        figures[f"follower_angle_{number + 1}"] = Scalar(float(follower[number]), "rad")
    return figures
