"""Path synthesis of a spherical five-bar: the search of the four-bars, with an arm that the crank gears.

Five-bars have two unknowns more than four-bars, the arm's arc and its angle, so that they meet more points
exactly. A design has the pose of its first point as that of adjustment, and both of its phases are the same.
"""

import math
from dataclasses import dataclass
from itertools import product

import numpy as np

from mechwright import Array, Candidate, Finding, GeometryError, Progress, Rejected, Scalar, Synthesis
from mechwright.contracts.finding import errors
from mechwright.mechanics.tracing.dense import on_all, only
from mechwright.mechanics.tracing.points import thinned
from mechwright.mechanics.tracing.requirement import fault_of_points
from mechwright.mechanics.tracing.search import MORE, SEARCH, Trace, Traces, search
from mechwright_spherical.defaults.complete_parameters import CompleteParams
from mechwright_spherical.kinematics.linkage import linkage_of
from mechwright_spherical.kinematics.vectors import arc, vector
from mechwright_spherical.parameters import MOST_POSITIONS, FiveBarTable, SphericalParams
from mechwright_spherical.requirements import FiveBarPathRequirement
from mechwright_spherical.rules.assembly import least_transmission
from mechwright_spherical.rules.rule_table import findings_of
from mechwright_spherical.synthesis.five_bar_limits import ARCS, FiveBarRoom
from mechwright_spherical.synthesis.four_bar_limits import Bounds
from mechwright_spherical.synthesis.four_bar_path import ALIKE, DIGITS, EXACT, directions, fault
from mechwright_spherical.synthesis.rounding import NO_STEP, no_step, rounded

INSIDE = math.radians(0.01)
"""By how much the search keeps inside the bound of transmission angles: it knows their cosine to 1e-5."""

GOOD_ANGLE = math.radians(50)
"""Transmission angle from which a larger one is not worth longer links, where points are met exactly."""


@dataclass(frozen=True)
class Drawn:
    """A five-bar on the points: its pins (3,) at the first, crank angles (n,), mean distance over radius.

    ``trace`` is what the search knows of it.
    """

    a0: Array
    b0: Array
    a: Array
    b: Array
    c: Array
    p: Array
    angles: Array
    mean: float
    trace: Trace

    @property
    def arcs(self) -> tuple[float, ...]:
        """Of ground, crank, coupler, rocker and arm, rad."""
        pairs = ((self.a0, self.b0), (self.a0, self.a), (self.a, self.c), (self.b, self.c), (self.b0, self.b))
        return tuple(float(arc(*pair)) for pair in pairs)

    @property
    def shape(self) -> Array:
        """Arcs, and those from the path point to the coupler's axes, degrees: alike in mirror images."""
        to_axes = (min(one, math.pi - one) for one in (float(arc(self.p, pin)) for pin in (self.a, self.c)))
        return np.degrees([*self.arcs, *to_axes])


def from_points(wanted: FiveBarPathRequirement, progress: Progress) -> Synthesis[SphericalParams]:
    """Designs whose coupler point follows the points, within the limits.

    Those that meet the points come first, the best transmission angle up to a good one leading; then those
    that do not, the nearest first.
    """
    try:
        targets = np.array([vector(point) for point in wanted.points])
    except GeometryError as error:
        return Synthesis((), (fault("points", str(error), "give each point a direction"),))
    timed = bool(wanted.angles)
    if said := fault_of_points(wanted.points, timed) or fault_of_points(directions(targets), timed):
        wrong, _, remedy = said.partition("; ")
        return Synthesis((), (fault("points", wrong, remedy or "give other points"),))
    rooms = rooms_of(wanted, targets)
    chosen = thinned(rooms[0].targets, rooms[0].closed)
    most = MORE * wanted.designs
    result = search(
        only(rooms, chosen), wanted.atlas, wanted.starts, most, wanted.seed, EXACT,
        lambda part: progress(SEARCH * part, "linkages on the points"),
    )  # fmt: skip
    size = rooms[0].size
    found = [_drawn(rooms[one.room], one) for one in on_all(result.kept, rooms, chosen, most)]
    found.sort(key=lambda one: _rank(one, wanted, rooms[0], EXACT * size))
    rejected, refused = Rejected(), list[Finding]()
    for trace in result.beyond:
        rejected.because(*_broken(rooms[trace.room], trace))
    candidates: list[Candidate[SphericalParams]] = []
    looked: list[Drawn] = []
    for exact in found:
        one = exact
        if wanted.arc_step and len(candidates) < wanted.designs:
            room = rooms[exact.trace.room]
            again = rounded(exact.trace, room, wanted.arc_step)
            if again is None:
                rejected.because(*NO_STEP)
                continue
            one = _drawn(room, again)
        if any(np.abs(one.shape - other.shape).max() < ALIKE for other in looked):
            rejected.same()
            continue
        if len(candidates) == wanted.designs:
            rejected.beyond(wanted.designs, 1)
            continue
        looked.append(one)
        params = design(one, wanted, rooms[0])
        faults = errors(findings_of(params))
        refused += faults
        if rejected.by(faults):
            continue
        angle = _least_angle(params)
        if angle < math.radians(wanted.least_transmission):
            rejected.because(
                "spherical.limits", f"the transmission angle falls to {math.degrees(angle):.6g} degrees"
            )
            continue
        candidates.append(_candidate(params, one, wanted.radius))
        progress(SEARCH + (1 - SEARCH) * len(candidates) / wanted.designs, "designs")
    progress(1.0, "done")
    if not candidates:
        why = list(dict.fromkeys(refused)) or no_step(rejected, wanted.arc_step)
        why = why or [_none(result, rooms, wanted)]
        return Synthesis((), tuple(why), rejected.reasons)
    note = Finding.note(
        "spherical.path",
        f"in {result.starts} starts {len(result.kept)} five-bars came to rest within the limits and "
        f"{len(result.beyond)} beyond one",
        float(len(result.kept)),
    )
    return Synthesis(tuple(candidates), (note,), rejected.reasons)


def rooms_of(wanted: FiveBarPathRequirement, targets: Array) -> list[FiveBarRoom]:
    """Both sides and senses; a first point that comes again closes the path."""
    turns = np.radians(np.array(wanted.angles, dtype=float)) if wanted.angles else None
    if turns is None and wanted.comes_again:
        targets = targets[:-1]
    size = float(np.linalg.norm(targets - targets.mean(axis=0), axis=1).max())
    bounds = Bounds(
        math.radians(wanted.least_arc),
        math.radians(wanted.greatest_arc),
        math.radians(wanted.least_transmission) + INSIDE,
    )
    rooms = []
    for side, sense in product((1, -1), (1, -1)):
        # Angles that are given may be passed in either sense.
        given = None if turns is None else sense * (turns - turns[0])
        way = sense if given is None else (1 if given[-1] > 0 else -1)
        rooms.append(FiveBarRoom(targets, given, wanted.ratio, side, way, wanted.closes, size, bounds))
    return rooms


def _drawn(room: FiveBarRoom, one: Trace) -> Drawn:
    """A linkage of the search, each moving pin at that end of its axis that makes the arcs shortest."""
    angles = one.theta if room.turns is None else one.x[-1] + room.turns
    pins = room.pins(one.x, float(angles[0]))
    ends = [
        Drawn(
            **{**pins, "a": a * pins["a"], "b": b * pins["b"], "c": c * pins["c"]},
            angles=angles,
            mean=one.mean * room.size,
            trace=one,
        )
        for a, b, c in product((1, -1), repeat=3)
    ]
    kept = [
        each for each in ends if room.bounds.least <= min(each.arcs) <= max(each.arcs) <= room.bounds.greatest
    ]
    return min(kept or ends[:1], key=lambda each: sum(each.arcs))


def design(one: Drawn, wanted: FiveBarPathRequirement, room: FiveBarRoom) -> SphericalParams:
    """The design; its pose of adjustment is that at the first point."""
    targets = room.targets
    shown = thinned(targets, room.closed) if len(targets) > MOST_POSITIONS else np.arange(len(targets))
    turned = np.degrees(one.angles - one.angles[0])
    travel = math.copysign(360.0, turned[-1]) if room.closed else round(float(turned[-1]), DIGITS)
    pins = {"a0": one.a0, "b0": one.b0, "a1": one.a, "a1n": one.a, "b1": one.b, "c1": one.c, "c1n": one.c}
    table = FiveBarTable(
        **{name: _row(pin) for name, pin in pins.items()},
        point=_row(one.p),
        ratio=wanted.ratio,
        travel=travel,
        travel_n=travel,
        path=tuple(_row(point) for point in targets[shown]),
        path_angles=tuple(turned[shown].round(DIGITS).tolist()),
    )
    return CompleteParams(
        kind="five-bar",
        radius=wanted.radius,
        speed=wanted.speed,
        least_transmission=wanted.least_transmission,
        five_bar=table,
    )


def _row(pin: Array) -> tuple[float, float, float]:
    x, y, z = pin.round(DIGITS + 2).tolist()
    return x, y, z


def _least_angle(params: SphericalParams) -> float:
    """Least transmission angle over the passage, rad."""
    return least_transmission(linkage_of(params).phases[0])


def _rank(
    one: Drawn, wanted: FiveBarPathRequirement, room: FiveBarRoom, met: float
) -> tuple[float, float, float]:
    if one.mean > met:
        return one.mean, 0.0, sum(one.arcs)
    angle = min(_least_angle(design(one, wanted, room)), GOOD_ANGLE)
    return 0.0, -round(angle, 6), sum(one.arcs)


def _candidate(params: SphericalParams, one: Drawn, radius: float) -> Candidate[SphericalParams]:
    (phase, _) = linkage_of(params).phases
    return Candidate(
        params,
        Scalar(radius * one.mean, "mm"),
        {
            "path_error_max": Scalar(float(radius * phase.path_errors.max()), "mm"),
            "least_transmission": Scalar(_least_angle(params), "rad"),
            "least_arc": Scalar(min(one.arcs), "rad"),
            "greatest_arc": Scalar(max(one.arcs), "rad"),
        },
    )


def _pinched(room: FiveBarRoom, one: Trace) -> float:
    """Least transmission angle over the passage, rad, as the search knows it."""
    return math.acos(min(1.0, max(0.0, float(room.cosines(room.made(one.x), one.theta).max()))))


def _broken(room: FiveBarRoom, one: Trace) -> tuple[str, str]:
    """The limit that a linkage breaks most, and by what."""
    over = room.exceeded(room.made(one.x), one.theta)
    if over[2 * ARCS :].max() >= over[: 2 * ARCS].max():
        return "spherical.transmission", (
            f"the transmission angle falls to {math.degrees(_pinched(room, one)):.4g} degrees"
        )
    arcs = np.degrees(one.x[:ARCS])
    return "spherical.limits", f"its arcs are {arcs.min():.4g} to {arcs.max():.4g} degrees"


def _none(result: Traces, rooms: list[FiveBarRoom], wanted: FiveBarPathRequirement) -> Finding:
    """Why there is no design at all."""
    if not result.beyond:
        return fault("five_bar.path", f"in {result.starts} starts no five-bar was found near the points")
    near = result.beyond[0]
    room = rooms[near.room]
    return fault(
        "least_transmission",
        f"in {result.starts} starts no five-bar was found that keeps a transmission angle of "
        f"{wanted.least_transmission:g} degrees with arcs of {wanted.least_arc:g} to "
        f"{wanted.greatest_arc:g}: the nearest misses the points by "
        f"{wanted.radius * room.size * near.mean:.3g} mm, and {_broken(room, near)[1]}",
    )
