"""The points of a path on the sphere, as places of it."""

import math
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

from mechwright import Target
from mechwright_spherical.requirements import AdjustablePathRequirement, FourBarPathRequirement

Pin = tuple[float, ...]
Place = tuple[float, ...]

DECIMALS = 6
"""Of the numbers of a dragged pin."""

SHALLOW = 0.05
"""Least height of a place over the centre, in radii: down there the points of the plane are at infinity."""


def targets_of(wanted: AdjustablePathRequirement | FourBarPathRequirement) -> tuple[Target, ...]:
    """The points of the path, or of the path of each phase, mm. Those of phases at one place go together.

    >>> first, *_ = targets_of(FourBarPathRequirement(radius=50))
    >>> [round(part, 2) for part in first.place]
    [13.0, 0.0, 48.28]
    >>> first.moved((0.0, 30.0, 40.0))["points"][0]
    [0.0, 0.6, 0.8]
    """
    if isinstance(wanted, FourBarPathRequirement):
        return _line("points", wanted.points, wanted.radius, 1.0, partial(_of_one, "points", wanted.points))
    distance, found = wanted.projection_length, list[Target]()
    if wanted.phases:
        for number, points in enumerate(wanted.phases, start=1):
            written = partial(_of_phases, wanted.phases)
            found += _line(f"phases {number},", points, wanted.radius, distance, written)
    else:
        for key, points in (("path", wanted.path), ("path_n", wanted.path_n)):
            written = partial(_of_both, wanted)
            found += _line(key, points, wanted.radius, distance, written)
    return tuple(found)


def _line(
    name: str,
    points: Sequence[Pin],
    radius: float,
    distance: float,
    written: Callable[[Pin, list[float]], dict[str, Any]],
) -> tuple[Target, ...]:
    found = []
    for number, pin in enumerate(points, start=1):
        direction = pin if len(pin) == 3 else (*pin, distance)
        length = math.hypot(*direction)
        place = tuple(radius * part / length for part in direction)
        moved = partial(_moved, written, pin, distance)
        found.append(Target(f"{name} {number}", place, moved, name))
    return tuple(found)


def _moved(
    written: Callable[[Pin, list[float]], dict[str, Any]], pin: Pin, distance: float, place: Place
) -> dict[str, Any]:
    """A pin of the plane stays in it, as long as its place is on the plane's side of the sphere."""
    scale = (
        1 / math.hypot(*place) if len(pin) == 3 else distance / max(place[2], SHALLOW * math.hypot(*place))
    )
    return written(pin, [round(scale * part, DECIMALS) for part in place[: len(pin)]])


def _exchanged(points: Sequence[Pin], old: Pin, new: list[float]) -> list[list[float]]:
    return [new if point == old else list(point) for point in points]


def _of_one(key: str, points: Sequence[Pin], old: Pin, new: list[float]) -> dict[str, Any]:
    return {key: _exchanged(points, old, new)}


def _of_phases(phases: Sequence[Sequence[Pin]], old: Pin, new: list[float]) -> dict[str, Any]:
    return {"phases": [_exchanged(points, old, new) for points in phases]}


def _of_both(wanted: AdjustablePathRequirement, old: Pin, new: list[float]) -> dict[str, Any]:
    return {"path": _exchanged(wanted.path, old, new), "path_n": _exchanged(wanted.path_n, old, new)}
