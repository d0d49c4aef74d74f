"""Synthesis of adjustable five-bars: one set of links whose pivots are set to a path per phase."""

import math

import numpy as np
from pydantic import ValidationError

from mechwright import Candidate, Progress, Rejected, Scalar, Synthesis
from mechwright.contracts.finding import errors
from mechwright.mechanics.adjustable import PlaneSpace, settings_of
from mechwright.mechanics.adjustable.machine import SAME, Machine, count_note, machines, missed, refusal
from mechwright.mechanics.multistart import distinct
from mechwright_five_bar.checks import GOOD_TRANSMISSION, findings
from mechwright_five_bar.loop import FiveBar, close
from mechwright_five_bar.params import FiveBarParams
from mechwright_five_bar.phases import in_phase
from mechwright_five_bar.reach import transmission_range, turns_fully
from mechwright_five_bar.requirements import AdjustablePathRequirement

MISSED = "allow a larger tolerance, leave points out, take other gears, or use more starts"


def through_phases(wanted: AdjustablePathRequirement, progress: Progress) -> Synthesis[FiveBarParams]:
    """Machines whose coupler point follows all paths, each as one design per phase; the best first."""
    size, found = machines(wanted, 5, "moving", wanted.ratio, lambda part: progress(0.9 * part, "linkages"))
    rejected = Rejected()
    kept = [one.rounded(size) for one in found if _keeps(one, wanted, rejected)]
    kept.sort(key=lambda one: _rank(one, wanted))
    candidates: list[Candidate[FiveBarParams]] = []
    given: list[np.ndarray] = []
    reason = ""
    for one in kept:
        row = np.concatenate([bar.lengths for bar in _bars(one, wanted)]) / size
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
    notes = [count_note(wanted, 5, "moving")]
    if not candidates:
        return Synthesis((), (*notes, refusal(found, reason)), rejected.reasons)
    if candidates[0].residual.value > wanted.tolerance:
        notes.append(missed(wanted, candidates[0].residual.value, MISSED))
    return Synthesis(tuple(candidates), tuple(notes), rejected.reasons)


def bar_in(one: Machine, phase: int, wanted: AdjustablePathRequirement) -> FiveBar:
    """Dimensions of a machine's phase, from 0."""
    names = ("a0", "a", "b0", "b1", "c")
    a0, a, b0, b1, c = (complex(getattr(one.pins, name)[phase]) for name in names)
    side = PlaneSpace(0j).side(np.array(a), np.array(b1), np.array(c))
    start, arm = start_of(one, phase), float(np.angle(b1 - b0))
    return FiveBar(
        abs(a - a0), abs(c - a), abs(c - b1), abs(b1 - b0), abs(b0 - a0), float(np.angle(b0 - a0)),
        arm - wanted.ratio * start, (wanted.crank_teeth, wanted.arm_teeth), 1 if wanted.idler else -1,
        int(side),
    )  # fmt: skip


def _bars(one: Machine, wanted: AdjustablePathRequirement) -> list[FiveBar]:
    return [bar_in(one, k, wanted) for k in range(len(one.theta))]


def start_of(one: Machine, k: int) -> float:
    """Crank angle of a phase in the pose of setting, rad: that of the first phase and the turn from it on.

    A turn more would be half a turn of the arm where the ratio is a half, so it matters how it is counted.
    """
    first, own = (complex(one.pins.a[n] - one.pins.a0[n]) for n in (0, k))
    return float(np.angle(first) + np.angle(own / first))


def _transmission(one: Machine, k: int, wanted: AdjustablePathRequirement) -> float:
    """Least transmission angle of a phase, rad: over all turns, or as far as its points go."""
    bar, start = bar_in(one, k, wanted), start_of(one, k)
    way = math.tau * bar.turns if wanted.full_turn else float(one.theta[k][-1])
    return transmission_range(bar, start, start + way)[0]


def _weakest(one: Machine, wanted: AdjustablePathRequirement) -> float:
    return min(_transmission(one, k, wanted) for k in range(len(one.theta)))


def _rank(one: Machine, wanted: AdjustablePathRequirement) -> tuple[float, float, float]:
    """The nearest first; of exact ones those with a good transmission angle, the smallest leading."""
    angle = min(_weakest(one, wanted), math.radians(GOOD_TRANSMISSION))
    return one.rms, -angle, max(max(bar.lengths) for bar in _bars(one, wanted))


def _keeps(one: Machine, wanted: AdjustablePathRequirement, rejected: Rejected) -> bool:
    """Whether a machine keeps the limits; one that does not is counted under the first that it breaks."""
    if not one.finite:
        return False
    bars = _bars(one, wanted)
    lengths = [length for bar in bars for length in bar.lengths]
    broken = {
        "path.longest-link": (max(lengths) > wanted.longest_link, f"a link is {max(lengths):.4g} mm long"),
        "path.shortest-link": (min(lengths) < wanted.shortest_link, f"a link is {min(lengths):.4g} mm long"),
        "path.rotation": (
            wanted.full_turn and not all(turns_fully(bar) for bar in bars),
            "the crank does not turn fully in all phases",
        ),
        "path.order": (
            not one.in_order,
            "points are passed out of their order, or not within one turn",
        ),
        "path.branch": (len({bar.branch for bar in bars}) > 1, "the phases are on different branches"),
        "path.chord": (
            bool(one.chords) and min(one.chords) < wanted.least_chord,
            f"two places of a pivot are {min(one.chords, default=0.0):.4g} mm apart",
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
) -> list[Candidate[FiveBarParams]] | str:
    """A design per phase, or why there is none."""
    found = []
    for k in range(len(one.theta)):
        try:
            params = FiveBarParams.model_validate(table_of(one, k, wanted))
        except ValidationError as error:
            said = error.errors(include_url=False)[0]["msg"]
            rejected.because("five-bar.out-of-bounds", said)
            return said
        faults = errors(findings(in_phase(params)))
        if rejected.by(faults):
            return f"phase {k + 1}: {faults[0].parameter}: {faults[0].message}"
        found.append(Candidate(params, Scalar(one.rms, "mm"), _figures(one, k, wanted)))
    return found


def table_of(one: Machine, k: int, wanted: AdjustablePathRequirement) -> dict[str, object]:
    """The table ``[parameters]`` that shows a phase, from 0."""
    bar = bar_in(one, 0, wanted)
    a0, a, c, p = (complex(getattr(one.pins, name)[0]) for name in ("a0", "a", "c", "p"))
    point = (p - a) * (c - a).conjugate() / abs(c - a)
    table: dict[str, object] = {
        "crank": bar.crank,
        "coupler": bar.coupler,
        "rocker": bar.rocker,
        "arm": bar.arm,
        "ground": bar.ground,
        "ground_angle": math.degrees(bar.ground_angle),
        "arm_angle": math.degrees(bar.offset),
        "branch": "open" if bar.branch > 0 else "crossed",
        "pivot_x": a0.real,
        "pivot_y": a0.imag,
        "coupler_point_x": point.real,
        "coupler_point_y": point.imag,
        "crank_teeth": wanted.crank_teeth,
        "arm_teeth": wanted.arm_teeth,
        "idler_teeth": wanted.crank_teeth if wanted.idler else 0,
    }
    phases = range(len(one.theta))
    swings = [_swing(one, number) for number in phases]
    if wanted.full_turn:
        table["direction"] = "ccw" if one.theta[k][-1] > 0 else "cw"
    else:
        table |= swings[0]
    if len(one.theta) > 1:
        settings = settings_of(PlaneSpace(0j), one.pins)
        turns = np.degrees([settings.crank, settings.follower]).T[1:].tolist()
        table["setting_angle"] = math.degrees(start_of(one, 0))
        table["phase"] = k + 1
        table["phases"] = [
            {"crank_turn": crank, "rocker_turn": rocker, **({} if wanted.full_turn else swings[number])}
            for number, (crank, rocker) in enumerate(turns, start=1)
        ]
    return table


def _swing(one: Machine, k: int) -> dict[str, float]:
    """From the pose of setting to a phase's last point, degrees, counted on from phase 1."""
    start = start_of(one, k)
    return {"swing_from": math.degrees(start), "swing_to": math.degrees(start + float(one.theta[k][-1]))}


def _figures(one: Machine, k: int, wanted: AdjustablePathRequirement) -> dict[str, Scalar]:
    """What is to be said of a phase: its errors point by point, and crank, arm and rocker at each."""
    settings = settings_of(PlaneSpace(0j), one.pins)
    bar, misses, theta = bar_in(one, k, wanted), one.misses[k], one.theta[k]
    loop = close(bar, start_of(one, k) + theta)
    rocker = np.angle(loop.rocker.direction)
    figures = {
        "phase": Scalar(float(k + 1), ""),
        "phase_error": Scalar(float(np.sqrt(np.mean(misses**2))), "mm"),
        "path_error_max": Scalar(float(misses.max()), "mm"),
        "transmission_min": Scalar(_transmission(one, k, wanted), "rad"),
        "crank_turned": Scalar(float(settings.crank[k]), "rad"),
        "rocker_turned": Scalar(float(settings.follower[k]), "rad"),
        "chord_min": Scalar(min(one.chords, default=0.0), "mm"),
        "longest_link": Scalar(max(max(each.lengths) for each in _bars(one, wanted)), "mm"),
    }
    for number in range(len(misses)):
        angle = start_of(one, k) + float(theta[number])
        figures[f"error_{number + 1}"] = Scalar(float(misses[number]), "mm")
        figures[f"crank_angle_{number + 1}"] = Scalar(angle, "rad")
        figures[f"arm_angle_{number + 1}"] = Scalar(bar.offset + bar.ratio * angle, "rad")
        figures[f"rocker_angle_{number + 1}"] = Scalar(float(rocker[number]), "rad")
    return figures
