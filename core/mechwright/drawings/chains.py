"""Curves joined end to end to closed loops, over gaps within a tolerance. Imports ezdxf.

First what meets is joined, however short it is, then the ends that are left over: so that lines shorter than
the tolerance are no gaps.
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from ezdxf import edgeminer

from mechwright.drawings.doubles import Piece
from mechwright.drawings.fault import Told, at
from mechwright.drawings.strokes import Stroke, bulged
from mechwright.geometry import Arc, BSpline, Line, Loop, Segment
from mechwright.geometry.segments import Point
from mechwright.tolerances import TOLERANCES

MEETS = 1e-4
"""Ends nearer than this meet, mm: drawings have four decimals and more."""
TOLD = 1e-3
"""Gaps above this, mm, are told."""

Chain = list[Piece]


def loops(pieces: Sequence[Piece], join: float, told: Told) -> list[tuple[Loop, Stroke]]:
    """The closed loops of a layer's pieces, each with the stroke that messages name it by.

    Faults are ends that nothing meets, and places where more than two curves do.
    """
    found, rest = list[Chain](), list[Chain]()
    for piece in pieces:
        segment = piece[0]
        closed = math.dist(segment.start, segment.end) <= TOLERANCES.closure
        (found if closed else rest).append([piece])
    shortest = min((_reach(chain) for chain in rest), default=1.0)
    for tolerance in (min(MEETS, shortest / 4, join), join + TOLERANCES.noise):
        rest, closed_now = _joined(rest, tolerance, told)
        found += closed_now
    if not told.faults:
        for chain in rest:
            _open(chain, rest, join, told)
    if told.faults:
        return []
    made = []
    gaps: list[tuple[float, Point]] = []
    for chain in found:
        loop = _closed(chain, gaps)
        if loop is not None:
            made.append((loop, chain[0][1]))
    _tell(gaps, told)
    return made


def _reach(chain: Chain) -> float:
    return math.dist(chain[0][0].start, chain[-1][0].end)


def _joined(chains: list[Chain], tolerance: float, told: Told) -> tuple[list[Chain], list[Chain]]:
    """Chains that are still open, and those that are closed now."""
    ready = [chain for chain in chains if _reach(chain) <= tolerance < _size(chain) / 2]
    chains = [chain for chain in chains if chain not in ready]
    if not chains:
        return [], ready
    edges = [
        edgeminer.make_edge(chain[0][0].start, chain[-1][0].end, 1.0, payload=number)
        for number, chain in enumerate(chains)
    ]
    deposit = edgeminer.Deposit(edges, gap_tol=tolerance)
    for edge in edges:
        for end in (edge.start, edge.end):
            linked = deposit.edges_linked_to(end)
            if len(linked) > 2:
                names = sorted({chains[one.payload][0][1].name for one in linked})
                told.fault(
                    "contour",
                    f"{len(linked)} curves meet at {at((end.x, end.y))}: {', '.join(names[:3])}",
                    "let two meet there: delete what is none of the contour's, or give it a layer of its own",
                )
    if told.faults:
        return chains, []
    left, closed = list[Chain](), ready
    # In the order of the drawing: the same file gives the same loops.
    done: set[int] = set()
    for edge in edges:
        if edge.payload in done:
            continue
        linked_up = edgeminer.find_simple_chain(deposit, edge)
        done |= {one.payload for one in linked_up}
        chain = [piece for one in linked_up for piece in _run(chains[one.payload], backwards=one.is_reverse)]
        near = math.dist(chain[0][0].start, chain[-1][0].end) <= tolerance
        (closed if near and _size(chain) > 2 * tolerance else left).append(chain)
    return left, closed


def _size(chain: Chain) -> float:
    """How far a chain goes from its start, mm."""
    start = chain[0][0].start
    return max(
        math.dist(start, (float(x), float(y))) for segment, _ in chain for x, y in segment.at([0.5, 1.0])
    )


def _run(chain: Chain, *, backwards: bool) -> Chain:
    return [(segment.reversed(), stroke) for segment, stroke in reversed(chain)] if backwards else chain


def _open(chain: Chain, others: list[Chain], join: float, told: Told) -> None:
    """Say where a chain ends, and how far the next end is."""
    end, stroke = chain[-1][0].end, chain[-1][1]
    if _size(chain) <= join:
        told.note(f"{stroke.name} at {at(end)} is a speck of less than {join:g} mm; it is left out")
        return
    ends = [point for other in others for point in (other[0][0].start, other[-1][0].end)]
    apart = sorted((math.dist(end, point), point) for point in ends if point is not end)
    apart = [one for one in apart if one[0] > 0] or [(math.inf, end)]
    gap, place = apart[0]
    said = f"the contour is open at {at(end)}, where {stroke.name} ends"
    if gap <= MOST_JOIN:
        wide = math.ceil(gap * 1000 - TOLERANCES.noise) / 1000
        told.fault(
            "contour",
            f"{said}, {gap:.3g} mm from the next end at {at(place)}",
            f"close it, or let such gaps be joined: join = {wide:g}",
            "join",
        )
    else:
        told.fault("contour", f"{said}", "close it, or give what is no contour a layer of its own")


MOST_JOIN = 1.0
"""Greatest gap that a design may ask to be joined, mm."""


def _closed(chain: Chain, gaps: list[tuple[float, Point]]) -> Loop | None:
    """The loop of a closed chain, its joints brought together; None for one that comes to nothing."""
    segments = [segment for segment, _ in chain]
    if len(segments) == 1 and isinstance(segments[0], Arc) and segments[0].is_circle:
        return Loop((segments[0],))
    for number in range(len(segments)):
        after = (number + 1) % len(segments)
        one, two = segments[number], segments[after]
        gap = math.dist(one.end, two.start)
        if gap <= TOLERANCES.closure:
            continue
        gaps.append((gap, one.end))
        place = _joint(one, two)
        segments[number] = moved(one, one.start, place)
        two = segments[after]
        segments[after] = moved(two, place, two.end)
    kept = [
        one for one in segments if math.dist(one.start, one.end) > TOLERANCES.closure or len(segments) == 1
    ]
    return Loop(tuple(kept)) if kept else None


def _joint(one: Segment, two: Segment) -> Point:
    """Where two curves are to meet: on the arc of a line and an arc, else in the middle of the gap."""
    if isinstance(one, Line) != isinstance(two, Line):
        return two.start if isinstance(one, Line) else one.end
    return (one.end[0] + two.start[0]) / 2, (one.end[1] + two.start[1]) / 2


def moved(segment: Segment, start: Point, end: Point) -> Segment:
    """The segment from other ends nearby: an arc keeps its sweep, a spline its inner points."""
    if math.dist(segment.start, start) == 0 and math.dist(segment.end, end) == 0:
        return segment
    match segment:
        case Line():
            return Line(start, end)
        case Arc():
            return bulged(start, end, math.tan(segment.sweep / 4))
        case BSpline():
            return replace(segment, points=(start, *segment.points[1:-1], end))


def _tell(gaps: list[tuple[float, Point]], told: Told) -> None:
    wide = sorted((one for one in gaps if one[0] > TOLD), reverse=True)
    if wide:
        gap, place = wide[0]
        more = f"; {len(wide)} in all" if len(wide) > 1 else ""
        told.note(f"a gap of {gap:.3g} mm is closed at {at(place)}{more}")


def corners(loop: Loop) -> list[Point]:
    """Where segments of a loop meet."""
    return [one.end for one, _ in pairwise((*loop.segments, loop.segments[0]))]
