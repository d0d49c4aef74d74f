"""Path synthesis of a spherical four-bar: a search with the limits inside, and designs from what it finds.

The size and the place of a path on the sphere cannot be taken out as in the plane, but its orientation can:
every random linkage is turned to lie on the path as well as it can (Kabsch), and the best are fitted.
Unknowns are the four arcs, the path point in the coupler, the orientation in space, and the input angle of
every point, or of the first one only where the timing is prescribed.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mechwright import Array, Candidate, Finding, GeometryError, Progress, Rejected, Scalar, Synthesis
from mechwright.contracts.finding import errors
from mechwright.mechanics.tracing.dense import on_all, only
from mechwright.mechanics.tracing.points import thinned
from mechwright.mechanics.tracing.requirement import fault_of_points
from mechwright.mechanics.tracing.search import MORE, SEARCH, Trace, search
from mechwright_spherical.defaults.complete_parameters import CompleteParams
from mechwright_spherical.kinematics.linkage import linkage_of
from mechwright_spherical.kinematics.vectors import vector
from mechwright_spherical.parameters import MOST_POSITIONS, FourBarTable, SphericalParams
from mechwright_spherical.requirements import FourBarPathRequirement
from mechwright_spherical.rules.assembly import weakest
from mechwright_spherical.rules.rule_table import findings_of
from mechwright_spherical.synthesis.four_bar_limits import Bounds, FourBarRoom
from mechwright_spherical.synthesis.rounding import NO_STEP, no_step, rounded

ROUNDED = 1e-7
"""rad. By how much the search keeps inside the bound of transmission angles, so that the decimals of a design
never break it."""

ALIKE = 0.5
"""Degrees by which two linkages differ at least in an arc or in the place of the path point. Mirror images of
each other that lie on the same points are one as well: the points are their own image then."""

DIGITS = 10
"""Decimals of degrees and directions in design files."""

EXACT = 1e-12
"""Share of the path's size that is rounding: the points are met."""


@dataclass(frozen=True, slots=True)
class Placed:
    """A linkage on the path: orientation (3, 3), arcs and point (6,), side, input angles (n,)."""

    frame: Array
    shape: Array
    side: float
    angles: Array


def from_points(wanted: FourBarPathRequirement, progress: Progress) -> Synthesis[SphericalParams]:
    """Designs whose coupler point follows the points, the nearest first."""
    try:
        targets = np.array([vector(point) for point in wanted.points])
    except GeometryError as error:
        return Synthesis((), (fault("points", str(error), "give each point a direction"),))
    timed = bool(wanted.angles)
    if said := fault_of_points(wanted.points, timed) or fault_of_points(directions(targets), timed):
        wrong, _, remedy = said.partition("; ")
        return Synthesis((), (fault("points", wrong, remedy or "give other points"),))
    rooms = rooms_of(wanted, targets)
    targets, closed = rooms[0].targets, rooms[0].closed
    chosen = thinned(targets, closed)
    result = search(
        only(rooms, chosen), wanted.atlas, wanted.starts, MORE * wanted.designs, wanted.seed, EXACT,
        lambda part: progress(SEARCH * part, "linkages on the points"),
    )  # fmt: skip
    rejected = Rejected()
    for one in result.beyond:
        rejected.because(*_broken(rooms[one.room], one))
    found: list[Candidate[SphericalParams]] = []
    refused: list[Finding] = []
    looked: list[SphericalParams] = []
    for trace in on_all(result.kept, rooms, chosen, MORE * wanted.designs):
        room, one = rooms[trace.room], trace
        if wanted.arc_step:
            again = rounded(trace, room, wanted.arc_step) if len(found) < wanted.designs else trace
            if again is None:
                rejected.because(*NO_STEP)
                continue
            one = again
        placed = shortest(_placed(room, one), room.bounds)
        params = design(placed, wanted, targets, closed)
        if params is None:
            rejected.because("spherical.order", "the linkage does not run through the points in their order")
        elif any(_same(params, other) for other in looked):
            rejected.same()
        elif len(found) == wanted.designs:
            rejected.beyond(wanted.designs, 1)
        else:
            looked.append(params)
            faults = errors(findings_of(params))
            refused += faults
            if not rejected.by(faults):
                found.append(_candidate(params, wanted.radius * room.size * one.mean))
                progress(SEARCH + (1 - SEARCH) * len(found) / wanted.designs, "designs")
    progress(1.0, "done")
    if not found:
        why = list(dict.fromkeys(refused)) or no_step(rejected, wanted.arc_step)
        why = why or [_none(result.starts, result.beyond, rooms, wanted)]
        return Synthesis((), tuple(why), rejected.reasons)
    note = Finding.note(
        "spherical.path",
        f"in {result.starts} starts {len(result.kept)} four-bars came to rest within the limits and "
        f"{len(result.beyond)} beyond one",
        float(len(result.kept)),
    )
    found.sort(key=lambda one: one.residual.value)
    return Synthesis(tuple(found), (note,), rejected.reasons)


def directions(targets: Array) -> list[tuple[float, ...]]:
    """Unit vectors (n, 3) as points: those of other lengths are one where they point the same way."""
    return [tuple(one) for one in targets.round(DIGITS + 2).tolist()]


def rooms_of(wanted: FourBarPathRequirement, targets: Array) -> list[FourBarRoom]:
    """Both sides and senses; a first point that comes again closes the path."""
    turns = np.radians(np.array(wanted.angles, dtype=float)) if wanted.angles else None
    again = turns is None and len(targets) > 3 and bool((targets[0] == targets[-1]).all())
    if again:
        targets = targets[:-1]
    size = float(np.linalg.norm(targets - targets.mean(axis=0), axis=1).max())
    bounds = Bounds(
        math.radians(wanted.least_arc),
        math.radians(wanted.greatest_arc),
        math.radians(wanted.least_transmission) + ROUNDED,
    )
    rooms = []
    for side in (1, -1):
        for sense in (1, -1):
            # Angles that are given may be passed in either sense.
            given = None if turns is None else sense * (turns - turns[0])
            way = sense if given is None else (1 if given[-1] > 0 else -1)
            rooms.append(FourBarRoom(targets, given, side, way, wanted.closed or again, size, bounds))
    return rooms


def _placed(room: FourBarRoom, one: Trace) -> Placed:
    angles = one.theta if room.turns is None else one.x[-1] + room.turns
    return Placed(room.frame(one.x), one.x[:6], float(room.side), angles)


def _least_angle(room: FourBarRoom, one: Trace) -> float:
    """Least transmission angle over the passage, rad."""
    over = room.exceeded(room.made(one.x), one.theta)[8:].max() + math.cos(room.bounds.least_angle)
    return math.acos(min(1.0, max(0.0, float(over))))


def _broken(room: FourBarRoom, one: Trace) -> tuple[str, str]:
    """The limit that a linkage breaks most, and by what."""
    over = room.exceeded(room.made(one.x), one.theta)
    if over[8:].max() >= over[:8].max():
        angle = math.degrees(_least_angle(room, one))
        return "spherical.transmission", f"the transmission angle falls to {angle:.4g} degrees"
    arcs = np.degrees(one.x[:4])
    return "spherical.limits", f"its arcs are {arcs.min():.4g} to {arcs.max():.4g} degrees"


def _none(
    starts: int, beyond: Sequence[Trace], rooms: Sequence[FourBarRoom], wanted: FourBarPathRequirement
) -> Finding:
    """Why there is no design at all."""
    if not beyond:
        return fault("four_bar.path", f"in {starts} starts no four-bar was found near the points")
    greatest = max(math.degrees(_least_angle(rooms[one.room], one)) for one in beyond)
    return fault(
        "least_transmission",
        f"in {starts} starts no four-bar was found that keeps a transmission angle of "
        f"{wanted.least_transmission:g} degrees with arcs of {wanted.least_arc:g} to "
        f"{wanted.greatest_arc:g}: the best of them has {greatest:.4g}",
    )


def fault(
    parameter: str,
    message: str,
    remedy: str = "ask for a larger atlas, more starts, fewer points, or a lower least_transmission",
) -> Finding:
    """The error of a path that no linkage meets."""
    return Finding.error("spherical.synthesis", parameter, message, remedy=remedy)


def shortest(found: Placed, bounds: Bounds) -> Placed:
    """The same linkage with the shortest arcs within the bounds: an axis may be held at either end.

    With the output axis at its other end, ground and output become their supplements, and x and the
    input angle turn round; with the pin b at its other end, coupler and output do, and the coupler's
    normal turns round.
    """
    options = [found]
    for flip_c in (False, True):
        for flip_b in (False, True):
            shape, frame, angles, side = found.shape.copy(), found.frame, found.angles, found.side
            if flip_c:
                shape[[0, 3]] = np.pi - shape[[0, 3]]
                frame, angles, side = frame * (-1.0, -1.0, 1.0), angles + np.pi, -side
            if flip_b:
                shape[[2, 3]] = np.pi - shape[[2, 3]]
                shape[4:] *= -1
                side = -side
            options.append(Placed(frame, shape, side, angles))
    kept = [
        one
        for one in options
        if one.shape[:4].min() >= bounds.least and one.shape[:4].max() <= bounds.greatest
    ]
    return min(kept or options, key=lambda one: float(one.shape[:4].sum()))


def design(
    start: Placed, wanted: FourBarPathRequirement, targets: Array, closed: bool
) -> SphericalParams | None:
    """The design of a fit; None if it does not run through the points in their order."""
    angles = start.angles
    shown = thinned(targets, closed) if len(targets) > MOST_POSITIONS else np.arange(len(targets))
    sense = 1.0 if angles[-1] >= angles[0] else -1.0
    steps = sense * np.diff(angles)
    travel = sense * math.tau if closed else angles[-1] - angles[0]
    if (steps < 0).any() or abs(angles[-1] - angles[0]) > abs(travel) + 1e-12 or travel == 0:
        return None
    first = math.remainder(angles[0], math.tau)
    kappa, eta = math.remainder(start.shape[4], math.tau), math.remainder(start.shape[5], math.tau)
    if abs(eta) > math.pi / 2:  # over the pole of the coupler's great circle: the same point from behind
        kappa, eta = kappa + math.pi, math.copysign(math.pi, eta) - eta
    degrees = np.degrees(start.shape).round(DIGITS).tolist()
    table = FourBarTable(
        ground=degrees[0],
        input=degrees[1],
        coupler=degrees[2],
        output=degrees[3],
        branch=1 if start.side > 0 else -1,
        point_azimuth=round(math.degrees(math.remainder(kappa, math.tau)), DIGITS),
        point_elevation=round(math.degrees(eta), DIGITS),
        start=round(math.degrees(first), DIGITS),
        travel=round(math.degrees(travel), DIGITS),
        input_axis=tuple(start.frame[:, 2].round(DIGITS + 2).tolist()),
        output_towards=tuple(start.frame[:, 0].round(DIGITS + 2).tolist()),
        path=tuple(map(tuple, targets[shown].round(DIGITS + 2).tolist())),
        path_angles=tuple(np.degrees(angles[shown] - angles[0]).round(DIGITS).tolist()),
    )
    return CompleteParams(
        kind="four-bar",
        radius=wanted.radius,
        speed=wanted.speed,
        least_transmission=wanted.least_transmission,
        four_bar=table,
    )


def _same(one: SphericalParams, two: SphericalParams) -> bool:
    return bool(np.abs(_shape(one.four_bar) - _shape(two.four_bar)).max() < ALIKE)


def _shape(table: FourBarTable) -> Array:
    """Arcs, and those from the path point to the coupler's pins, degrees: alike in mirror images."""
    azimuth, height = math.radians(table.point_azimuth), math.cos(math.radians(table.point_elevation))
    to_pins = [height * math.cos(azimuth - at) for at in (0.0, math.radians(table.coupler))]
    # A pin holds its axis at either end.
    folded = np.degrees(np.arccos(np.minimum(np.abs(to_pins), 1.0)))
    return np.array([table.ground, table.input, table.coupler, table.output, *folded])


def _candidate(params: SphericalParams, residual: float) -> Candidate[SphericalParams]:
    (phase,) = linkage_of(params).phases
    sine, table = weakest(phase)[1], params.four_bar
    arcs = table.ground, table.input, table.coupler, table.output
    return Candidate(
        params,
        Scalar(residual, "mm"),
        {
            "path_error_max": Scalar(float(params.radius * phase.path_errors.max()), "mm"),
            "least_transmission": Scalar(math.asin(min(1.0, sine)), "rad"),
            "least_arc": Scalar(math.radians(min(arcs)), "rad"),
            "greatest_arc": Scalar(math.radians(max(arcs)), "rad"),
        },
    )
