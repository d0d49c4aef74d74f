"""Synthesis of adjustable four-bars: one set of links whose pivots are set to a path per phase."""

import math
from dataclasses import dataclass, replace

import numpy as np
from pydantic import ValidationError

from mechwright import Candidate, Finding, Progress, Rejected, Scalar, Synthesis
from mechwright.contracts.finding import errors
from mechwright.mechanics.adjustable import (
    Limits,
    Path,
    Pins,
    PlaneSpace,
    Task,
    Unknowns,
    exact_number,
    search,
    settings_of,
)
from mechwright.mechanics.multistart import distinct
from mechwright_four_bar.checks import GOOD_TRANSMISSION, findings
from mechwright_four_bar.dimensions import FourBar
from mechwright_four_bar.loop import close
from mechwright_four_bar.params import FourBarParams
from mechwright_four_bar.phases import in_phase
from mechwright_four_bar.requirements import AdjustablePathRequirement

INSIDE = 0.002
"""Share by which limits are tightened in the search, where they are held by penalties: what it gives keeps
them strictly."""

MARGIN = math.radians(0.5)
"""The same of the transmission angle, which the search looks at in a few places."""

SAME = 1e-3
"""Linkages whose unknowns agree to this are one."""

TINY = 1e-9
"""Distance, in sizes of the path, below which points are met: a millionth of what can be made."""


@dataclass(frozen=True)
class Machine:
    """One linkage with all its phases, mm.

    Parameters
    ----------
    pins
        Of all phases (phases,), in the pose of setting.
    theta
        Crank angles (n,) of the points from that pose, one array per phase, the pose itself first, rad.
    misses
        Distances (n,) of the points, one array per phase, mm.
    """

    pins: Pins
    theta: tuple[np.ndarray, ...]
    misses: tuple[np.ndarray, ...]

    @property
    def rms(self) -> float:
        """Root mean square over all points, mm."""
        return float(np.sqrt(np.mean(np.concatenate(self.misses) ** 2)))

    def bar(self, phase: int) -> FourBar:
        """Dimensions of a phase, from 0."""
        a0, a, b0, c = (complex(getattr(self.pins, name)[phase]) for name in ("a0", "a", "b0", "c"))
        side = PlaneSpace(0j).side(np.array(a), np.array(b0), np.array(c))
        return FourBar(
            abs(a - a0), abs(c - a), abs(c - b0), abs(b0 - a0), float(np.angle(b0 - a0)), int(side)
        )


def through_phases(wanted: AdjustablePathRequirement, progress: Progress) -> Synthesis[FourBarParams]:
    """Machines whose coupler point follows all paths, each as one design per phase; the best first."""
    size, path, unknowns = _scaled(wanted)
    limits = Limits(
        math.radians(wanted.least_transmission_angle) + MARGIN,
        wanted.shortest_link * (1 + INSIDE) / size,
        wanted.longest_link * (1 - INSIDE) / size,
        wanted.full_turn,
        wanted.least_chord * (1 + INSIDE) / size,
    )
    found = search(
        path, unknowns, limits, wanted.starts, wanted.seed, lambda part: progress(0.9 * part, "linkages")
    )
    task, rejected = path.task(unknowns, limits), Rejected()
    machines = [_machine(task, size, x, theta) for x, theta in zip(found.x, found.theta, strict=True)]
    kept = [one for one in machines if _keeps(one, wanted, rejected)]
    kept = [replace(one, misses=_rounded(one.misses, size)) for one in kept]
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
    notes = [_count(wanted)]
    if not candidates:
        return Synthesis((), (*notes, _refusal(machines, reason)), rejected.reasons)
    if candidates[0].residual.value > wanted.tolerance:
        notes.append(_missed(wanted, candidates[0].residual.value))
    return Synthesis(tuple(candidates), tuple(notes), rejected.reasons)


def _scaled(wanted: AdjustablePathRequirement) -> tuple[float, Path, Unknowns]:
    """Size of the paths, mm; the paths in it; and the unknowns."""
    points = [np.array([complex(x, y) for x, y in one]) for one in wanted.phases]
    whole = np.concatenate(points)
    size = float(np.abs(whole - whole.mean()).max())
    path = Path(tuple(one / size for one in points), 1.0)
    return size, path, Unknowns(PlaneSpace(complex(path.phases[0][0])), 4, wanted.moves, len(points))


def _machine(task: Task, size: float, x: np.ndarray, theta: np.ndarray) -> Machine:
    pins = task.unknowns.pins(x)
    off = np.linalg.norm(task.misses(x, theta), axis=-1) * size
    phases = range(task.unknowns.phases)
    return Machine(
        Pins(*(getattr(pins, name) * size for name in Pins.__slots__)),
        tuple(np.concatenate([[0.0], theta[task.phase == k]]) for k in phases),
        tuple(np.concatenate([[0.0], off[task.phase == k]]) for k in phases),
    )


def _rounded(misses: tuple[np.ndarray, ...], size: float) -> tuple[np.ndarray, ...]:
    """Misses, with what is rounding set to nothing: exact designs are then ranked by their transmission."""
    return tuple(np.where(one < TINY * size, 0.0, one) for one in misses)


def _bars(one: Machine) -> list[FourBar]:
    return [one.bar(k) for k in range(len(one.theta))]


def _transmission(one: Machine, k: int, full: bool) -> float:
    """Least transmission angle of a phase, rad: over a turn, or as far as its points go."""
    bar = one.bar(k)
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
    if not all(np.isfinite(np.concatenate([*one.misses, np.abs(one.pins.c)]))):
        return False
    lengths = [length for bar in bars for length in bar.lengths]
    chords = _chords(one, wanted)
    broken = {
        "path.longest-link": (max(lengths) > wanted.longest_link, f"a link is {max(lengths):.4g} mm long"),
        "path.shortest-link": (min(lengths) < wanted.shortest_link, f"a link is {min(lengths):.4g} mm long"),
        "path.rotation": (
            wanted.full_turn and not all(bar.kind.full_turn for bar in bars),
            "the crank does not turn fully in all phases",
        ),
        "path.order": (
            any(abs(theta[-1]) >= math.tau or (np.abs(np.diff(theta)) <= 0).any() for theta in one.theta),
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


def _chords(one: Machine, wanted: AdjustablePathRequirement) -> list[float]:
    """Distances between the places of each pivot that is set, mm."""
    names = {"moving": ("a", "c"), "fixed": ("a0", "b0"), "both": ("a", "c", "a0", "b0")}[wanted.moves]
    upper = np.triu_indices(len(one.theta), 1)
    return [
        float(apart)
        for name in names
        for apart in np.abs(getattr(one.pins, name)[:, None] - getattr(one.pins, name)[None, :])[upper]
    ]


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
    bar = one.bar(own)
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
    bar, misses, theta = one.bar(k), one.misses[k], one.theta[k]
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
        "chord_min": Scalar(min(_chords(one, wanted), default=0.0), "mm"),
        "longest_link": Scalar(max(max(each.lengths) for each in _bars(one)), "mm"),
    }
    for number in range(len(misses)):
        figures[f"error_{number + 1}"] = Scalar(float(misses[number]), "mm")
        figures[f"crank_angle_{number + 1}"] = Scalar(start + float(theta[number]), "rad")
        figures[f"follower_angle_{number + 1}"] = Scalar(float(follower[number]), "rad")
    return figures


def _count(wanted: AdjustablePathRequirement) -> Finding:
    """How the number of points compares with what can be met exactly."""
    given = sum(len(points) for points in wanted.phases)
    most = exact_number(4, wanted.moves, len(wanted.phases))
    free = most - given
    said = (
        f"{given} points in {len(wanted.phases)} phases, and {most} can be met exactly with these pivots set"
    )
    if free > 0:
        said += f": there is a family of linkages with {free} free parameters, of which a few are given"
    elif free < 0:
        said += f": {-free} too many, so they are met as nearly as can be"
    return Finding.note("path.count", said, float(given), "")


def _missed(wanted: AdjustablePathRequirement, residual: float) -> Finding:
    return Finding.warning(
        "path.missed",
        "phases",
        f"the best machine found misses the points by {residual:.4g} mm in the mean, more than the tolerance "
        f"of {wanted.tolerance:g} mm",
        residual,
        wanted.tolerance,
        "mm",
        'allow a larger tolerance, leave points out, set moves = "both", or use more starts',
    )


def _refusal(machines: list[Machine], reason: str) -> Finding:
    best = min((one.rms for one in machines if math.isfinite(one.rms)), default=math.inf)
    said = reason or f"the nearest linkage misses the points by {best:.3g} mm and does not keep them"
    return Finding.error(
        "path.limits",
        "phases",
        f"within the limits no machine was found that can be built: {said}",
        remedy="ask for a smaller least_transmission_angle, least_chord or shortest_link, a larger "
        "longest_link, or more starts",
    )
