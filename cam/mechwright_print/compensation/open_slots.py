"""Slots that are open at the rim, such as those of a Geneva wheel: a printer makes them as narrow as others.

Glossary
--------
bay
    Run of an outer loop between two corners that stand out, along which the wall turns back.
open slot
    A bay whose ends run against each other, deeper than its mouth is wide.
"""

import math

import numpy as np

from mechwright.geometry import Loop
from mechwright.geometry.segments import Segment

CORNER = 15.0
"""The boundary has a corner where it turns by more, degrees."""
PARALLEL = 6.0
"""Walls of a slot run against each other within this, degrees; flanks of a tooth space do not."""
SAMPLES = 33
"""Places along a segment at which its direction is taken."""


def open_slots(loop: Loop) -> list[list[int]]:
    """Numbers of the segments of each open slot of an outer loop, run counter-clockwise.

    >>> fork = Loop.polygon([(0, 0), (9, 0), (9, 9), (6, 9), (6, 2), (3, 2), (3, 9), (0, 9)])
    >>> open_slots(fork)
    [[3, 4, 5]]
    """
    segments = loop.segments
    turned = [_turn(one) for one in segments]
    corners = [_angle(_ends(segments[k - 1])[1], _ends(segments[k])[0]) for k in range(len(segments))]
    starts = [k for k, corner in enumerate(corners) if corner > math.radians(CORNER)]
    found = []
    for start, end in zip(starts, [*starts[1:], *(k + len(segments) for k in starts[:1])], strict=True):
        run = [k % len(segments) for k in range(start, end)]
        turn = sum(turned[k] for k in run) + sum(corners[k] for k in run[1:])
        if abs(turn + math.pi) < math.radians(PARALLEL) and _is_deep([segments[k] for k in run]):
            found.append(run)
    return found


def _is_deep(run: list[Segment]) -> bool:
    """Whether a bay is deeper than its mouth is wide."""
    (x0, y0), (x1, y1) = run[0].start, run[-1].end
    mouth = math.hypot(x1 - x0, y1 - y0)
    points = np.concatenate([one.at(np.linspace(0, 1, SAMPLES)) for one in run])
    across = (points[:, 1] - y0) * (x1 - x0) - (points[:, 0] - x0) * (y1 - y0)
    return float(np.abs(across).max()) > mouth**2


def _directions(segment: Segment) -> "np.ndarray[tuple[int, ...], np.dtype[np.float64]]":
    rate = segment.derivative(np.linspace(0, 1, SAMPLES))
    return np.unwrap(np.arctan2(rate[:, 1], rate[:, 0]))


def _turn(segment: Segment) -> float:
    """By how much a segment turns to the left, radians."""
    angles = _directions(segment)
    return float(angles[-1] - angles[0])


def _ends(segment: Segment) -> tuple[float, float]:
    angles = _directions(segment)
    return float(angles[0]), float(angles[-1])


def _angle(before: float, after: float) -> float:
    """Turn to the left from one direction to another, radians, -π to π."""
    return (after - before + math.pi) % math.tau - math.pi
