"""Synthesis of a path: a point of the rod through points, timed or untimed, within limits."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mechwright import Array, Candidate, Finding, Progress, Rejected, Scalar, Synthesis
from mechwright.contracts.finding import errors
from mechwright.contracts.synthesis import ALIKE
from mechwright.mechanics.adjustable.machine import DIGITS
from mechwright.mechanics.planar import Plane
from mechwright.mechanics.tracing.dense import on_all, only
from mechwright.mechanics.tracing.points import in_plane, thinned
from mechwright.mechanics.tracing.requirement import SENSES, faults
from mechwright.mechanics.tracing.search import (
    EXACT,
    MORE,
    ROUND,
    SEARCH,
    Trace,
    Traces,
    followed,
    rounds_of,
    search,
)
from mechwright.mechanics.tracing.stepped import Held, stepped
from mechwright.mechanics.tracing.symmetry import Image, symmetries
from mechwright_slider_crank.kinematics.limits import least_transmission_angle
from mechwright_slider_crank.parameters import SliderCrankParams
from mechwright_slider_crank.requirements import PathRequirement
from mechwright_slider_crank.synthesis.designs import buildable
from mechwright_slider_crank.synthesis.paths.room import Limits, SliderRoom

GOOD_ANGLE = math.radians(40)
"""Transmission angle from which a larger one is not worth longer links."""


@dataclass(frozen=True)
class Drawn:
    """A slider-crank on the points.

    Parameters
    ----------
    crank, rod, offset, direction, branch
        Of the linkage, mm and rad.
    pivot, point
        The crank's pivot, and the coupler point in the rod's frame, x + i y, mm.
    phi
        (n,) crank angles from X, rad.
    mean
        Root mean square distance from the points, mm.
    trace
        What the search knows of it.
    """

    crank: float
    rod: float
    offset: float
    direction: float
    branch: int
    pivot: complex
    point: complex
    phi: Array
    mean: float
    trace: Trace

    @property
    def path(self) -> Plane:
        """(n,) places of the coupler point, mm."""
        pin = self.crank * np.exp(1j * (self.phi - self.direction))
        height = self.offset - pin.imag
        rod = self.branch * np.sqrt(self.rod**2 - height**2) + 1j * height
        way = pin + self.point / self.rod * rod
        return np.asarray(self.pivot + way * np.exp(1j * self.direction))

    @property
    def least_angle(self) -> float:
        """Least transmission angle, rad."""
        return float(least_transmission_angle(self.crank, self.rod, self.offset))

    @property
    def longest(self) -> float:
        """Longest of rod and distances of the coupler point from its joints, mm."""
        return max(self.rod, abs(self.point), abs(self.point - self.rod))

    def table(self) -> dict[str, object]:
        """The table ``[parameters]``; its origin is the crank's pivot."""
        return {
            "crank": round(self.crank, DIGITS),
            "rod": round(self.rod, DIGITS),
            "offset": round(self.offset, DIGITS),
            "slide_direction": round(math.degrees(math.remainder(self.direction, math.tau)), DIGITS),
            "assembly": "ahead" if self.branch > 0 else "behind",
            "clockwise": bool(self.phi[-1] < self.phi[0]),
            "coupler_x": round(self.point.real, DIGITS),
            "coupler_y": round(self.point.imag, DIGITS),
        }

    def broken(self, limits: Limits) -> tuple[str, str]:
        """The key of the first limit that it breaks, and by what; empty where it keeps all."""
        if self.crank < limits.shortest:
            return "shortest_link", f"the crank is {self.crank:.6g} mm long"
        if self.longest > limits.longest:
            return "longest_link", f"a link is {self.longest:.6g} mm long"
        if self.least_angle < limits.least_angle:
            angle = math.degrees(self.least_angle)
            return "least_transmission_angle", f"the transmission angle falls to {angle:.4g} degrees"
        if limits.frame is not None:
            x0, y0, x1, y1 = limits.frame
            if not (x0 <= self.pivot.real <= x1 and y0 <= self.pivot.imag <= y1):
                return "frame", f"the pivot stands at ({self.pivot.real:.5g}, {self.pivot.imag:.5g})"
        return "", ""


def through_points(wanted: PathRequirement, progress: Progress) -> Synthesis[SliderCrankParams]:
    """Slider-cranks with a point of the rod that runs through the points in their order, in one turn.

    The crank turns fully, on one assembly. Every design keeps all limits. Designs that meet the points come
    first, the best transmission angle up to a good one leading, then the smallest; then those that do not,
    the nearest first. Pivots stand where the figures ``pivot_x`` and ``pivot_y`` say: the design has its
    crank's pivot in the origin.
    """
    limits = Limits(
        wanted.shortest_link, wanted.longest_link, math.radians(wanted.least_transmission_angle), wanted.frame
    )
    wrong = faults(wanted, limits.contradiction(), "slider-crank")
    if errors(wrong):
        return Synthesis((), wrong)
    rooms = rooms_of(wanted, limits)
    targets, size = rooms[0].targets, rooms[0].size
    chosen = thinned(in_plane(targets), rooms[0].closed)
    met = max(wanted.tolerance, EXACT * size)
    most = MORE * wanted.designs
    result = search(
        only(rooms, chosen), ROUND, rounds_of(wanted.starts), most, wanted.seed, met / size,
        lambda part: progress(SEARCH * part, "slider-cranks through the points"),
    )  # fmt: skip
    rejected = Rejected()
    found = [drawn(rooms[one.room], one) for one in on_all(result.kept, rooms, chosen, most)]
    good = distinct(found, wanted, rooms[0], rejected)
    good.sort(key=lambda one: _rank(one, met))
    designs: list[tuple[Drawn, SliderCrankParams]] = []
    reason = ""
    for looked, one in _stepped(good, rooms, wanted, rejected):
        key, said = one.broken(limits)
        if key:
            rejected.because(f"path.{key.replace('_', '-')}", said)
            continue
        params, why = buildable(one.table())
        if params is None:
            rejected.because("slider-crank.not-buildable", why)
            reason = reason or why
            continue
        designs.append((one, params))
        progress(SEARCH + (1 - SEARCH) * len(designs) / wanted.designs, "designs")
        if len(designs) == wanted.designs:
            rejected.beyond(wanted.designs, len(good) - looked)
            break
    if not designs:
        return Synthesis((), (_refusal(result, good, reason, rooms, wanted),), rejected.reasons)
    designs.sort(key=lambda design: _rank(design[0], met))
    candidates = [Candidate(params, Scalar(one.mean, "mm"), _figures(one)) for one, params in designs]
    said_of = (*wrong, _count(result, len(good)), *_missed(wanted, candidates[0].residual.value))
    return Synthesis(tuple(candidates), said_of, rejected.reasons)


def rooms_of(wanted: PathRequirement, limits: Limits) -> list[SliderRoom]:
    """Every assembly and sense that is to be searched; a first point that comes again closes the path."""
    points: Plane = np.array([complex(x, y) for x, y in wanted.points])
    turns = None if wanted.crank_turns is None else np.radians(wanted.crank_turns)
    again = turns is None and points.size > 3 and points[0] == points[-1]
    points = points[:-1] if again else points
    centre = complex(points.mean())
    size = float(np.abs(points - centre).max())
    senses = SENSES[wanted.sense] if turns is None else (1 if turns[-1] > 0 else -1,)
    slack = math.radians(wanted.order_tolerance)
    unit: Plane = (points - centre) / size
    return [
        SliderRoom(unit, turns, branch, sense, wanted.closed or bool(again), slack, centre, size, limits)
        for branch in (1, -1)
        for sense in senses
    ]


def _stepped(
    good: Sequence[Drawn], rooms: Sequence[SliderRoom], wanted: PathRequirement, rejected: Rejected
) -> Iterator[tuple[int, Drawn]]:
    """The designs, their lengths in the steps that are asked for, and their numbers.

    Those that are one then are counted.
    """
    if not wanted.length_step:
        yield from enumerate(good, start=1)
        return
    kept: list[Drawn] = []
    for number, exact in enumerate(good, start=1):
        room = rooms[exact.trace.room]
        one = rounded(exact, room, wanted.length_step)
        if one is None:
            rejected.because("path.length-step", f"no multiples of {wanted.length_step:g} mm keep the limits")
        elif any(_same(one, other, [np.asarray], ALIKE * max(room.size, one.crank)) for other in kept):
            rejected.same()
        else:
            kept.append(one)
            yield number, one


def rounded(one: Drawn, room: SliderRoom, step: float) -> Drawn | None:
    """The design with lengths and coupler point in multiples of ``step``, mm, all else fitted; or None."""

    def exactly(values: Sequence[float], end: Trace) -> Drawn:
        again = drawn(room, end)
        rest: list[float] = room.dimensions(room.made(end.x))[len(values) :].tolist()
        crank, rod, offset, x, y = (*values, *rest)
        again = replace(again, crank=crank, rod=rod, offset=offset, point=complex(x, y))
        off = again.path - (room.centre + room.size * room.targets)
        return replace(again, mean=float(np.sqrt(np.mean(np.abs(off) ** 2))))

    def fitted(values: tuple[float, ...], before: Trace | None) -> tuple[Trace, float, Array] | None:
        begin = before or one.trace
        for end in followed(Held(room, values, room.size), begin.room, begin.x[None], begin.theta[None]):
            again = exactly(values, end)
            if end.kept and not again.broken(room.limits)[0] and again.crank + abs(again.offset) < again.rod:
                return end, again.mean, room.dimensions(room.made(end.x))
        return None

    found = stepped(room.dimensions(room.made(one.trace.x)), (3, 2), step, fitted)
    return None if found is None else exactly(*found)


def drawn(room: SliderRoom, one: Trace) -> Drawn:
    """A linkage of the search in millimetres."""
    made = room.made(one.x)
    rod, direction = float(np.abs(made.s)) * room.size, float(np.angle(made.s))
    theta = one.theta if room.turns is None else float(made.first) + room.turns
    return Drawn(
        float(made.a) * rod,
        rod,
        float(made.e) * rod,
        direction,
        room.branch,
        room.centre + complex(made.pivot) * room.size,
        complex(made.q / made.s) * rod,
        theta + direction,
        one.mean * room.size,
        one,
    )


def distinct(
    found: Sequence[Drawn], wanted: PathRequirement, room: SliderRoom, rejected: Rejected
) -> list[Drawn]:
    """The first designs, none near-identical to an earlier one or to its image where the points have one."""
    images: list[Image] = [
        lambda z: z,
        *symmetries(room.centre + room.size * room.targets, room.closed, room.turns),
    ]
    kept: list[Drawn] = []
    for one in found:
        if len(kept) == MORE * wanted.designs:
            break
        near = ALIKE * max(room.size, one.crank)
        if any(_same(one, other, images, near) for other in kept):
            rejected.same()
        else:
            kept.append(one)
    return kept


def _same(one: Drawn, other: Drawn, images: Sequence[Image], near: float) -> bool:
    """Whether links, coupler point, pivot and slide of two designs agree."""
    sizes = [(each.crank, each.rod, abs(each.point), abs(each.point - each.rod)) for each in (one, other)]
    if max(abs(a - b) for a, b in zip(*sizes, strict=True)) > near:
        return False
    places, others = _places(one), _places(other)
    return any(np.abs(image(places) - others).max() < near for image in images)


def _places(one: Drawn) -> Plane:
    """The pivot, and the middle of the slider pin's way."""
    way = one.branch * one.rod + 1j * one.offset
    return np.array([one.pivot, one.pivot + way * np.exp(1j * one.direction)])


def _rank(one: Drawn, met: float) -> tuple[float, float, float]:
    angle = min(one.least_angle, GOOD_ANGLE)
    return (0.0, -round(angle, 6), one.longest) if one.mean <= met else (one.mean, -angle, one.longest)


def _figures(one: Drawn) -> dict[str, Scalar]:
    return {
        "least_transmission_angle": Scalar(one.least_angle, "rad"),
        "longest_link": Scalar(one.longest, "mm"),
        "shortest_link": Scalar(one.crank, "mm"),
        "pivot_x": Scalar(one.pivot.real, "mm"),
        "pivot_y": Scalar(one.pivot.imag, "mm"),
        "first_crank_angle": Scalar(float(one.phi[0] % math.tau), "rad"),
        "crank_turn": Scalar(float(one.phi[-1] - one.phi[0]), "rad"),
    }


def _count(result: Traces, looked: int) -> Finding:
    return Finding.note(
        "path.found",
        f"in {result.starts} starts {len(result.kept)} slider-cranks came to rest within the limits and "
        f"{len(result.beyond)} beyond one; the {looked} nearest that differ were looked at",
        float(len(result.kept)),
    )


def _missed(wanted: PathRequirement, residual: float) -> list[Finding]:
    if not 0 < wanted.tolerance < residual:
        return []
    return [
        Finding.warning(
            "path.missed",
            "coupler_x",
            f"no design was found that meets the points within {wanted.tolerance:g} mm in the mean: within "
            f"the limits the best one misses them by {residual:.4g} mm",
            residual,
            wanted.tolerance,
            "mm",
            "allow a larger tolerance, or widen the limits",
        )
    ]


def _refusal(
    result: Traces, good: Sequence[Drawn], reason: str, rooms: Sequence[SliderRoom], wanted: PathRequirement
) -> Finding:
    if good and wanted.length_step and not reason:
        return Finding.error(
            "path.length-step",
            "length_step",
            f"slider-cranks keep the limits, but none with lengths in multiples of {wanted.length_step:g} mm",
            wanted.length_step,
            remedy="make length_step smaller",
        )
    if good:
        return Finding.error(
            "path.unbuildable",
            "crank",
            f"{len(good)} distinct slider-cranks keep the limits, the nearest missing the points by "
            f"{good[0].mean:.3g} mm, but none of them can be built: {reason}",
            remedy="scale the points, or change shortest_link and longest_link",
        )
    said, remedy = "", "use more starts, or widen the limits"
    if result.beyond:
        near = drawn(rooms[result.beyond[0].room], result.beyond[0])
        key, why = near.broken(rooms[0].limits)
        said = f": the nearest misses the points by {near.mean:.3g} mm and breaks {key}: {why}"
        remedy = f"widen {key}, or use more starts"
    return Finding.error(
        "path.none",
        "crank",
        f"in {result.starts} starts no slider-crank was found that keeps the limits and passes near the "
        f"{len(wanted.points)} points in their order{said}",
        remedy=remedy,
    )
