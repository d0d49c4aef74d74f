"""Places that a requirement or a design states, so that a page can draw them and let one drag them."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

from mechwright.contracts.model_schema import model_schema
from mechwright.contracts.parameters import Parameters

Place = tuple[float, ...]

DECIMALS = 6
"""Of what a dragged place writes into a table, mm or parts of one."""


@dataclass(frozen=True, slots=True)
class Target:
    """A place that a requirement asks for, or that a design is drawn with.

    Parameters
    ----------
    name
        As people are told it: ``"points 3"``; no two of a requirement have the same.
    place
        x and y, mm, in the frame of the designs' ground; or x, y and z of a point that stays on its sphere
        about the origin.
    moved
        What the table ``[requirement]``, or ``[parameters]`` of a design, says when the target is dragged to
        a place: key to value. A target
        that can go one way only takes what lies on its way.
    line
        Targets of one line are joined in their order; ``""`` stands alone.
    """

    name: str
    place: Place
    moved: Callable[[Place], Mapping[str, Any]]
    line: str = ""


def point_targets(requirement: Parameters) -> tuple[Target, ...]:
    """Every list of points [x, y] in mm that a requirement has, and every list of such lists.

    Points of one field that are the same place are dragged together. Of a list of poses [x, y, direction] the
    places are dragged, and each keeps its direction.

    Examples
    --------
    >>> from typing import Annotated
    >>> from pydantic import Field
    >>> from mechwright.units import Unit
    >>> X = Annotated[float, Unit("mm")]
    >>> class Path(Parameters):
    ...     points: tuple[tuple[X, X], ...] = Field(((0.0, 1.0), (2.0, 3.0)), description="Of the path.")
    >>> [(one.name, one.place) for one in point_targets(Path())]
    [('points 1', (0.0, 1.0)), ('points 2', (2.0, 3.0))]
    >>> point_targets(Path())[1].moved((5.0, 5.0))
    {'points': [[0.0, 1.0], [5.0, 5.0]]}
    """
    schema = model_schema(type(requirement))
    found: list[Target] = []
    for name in type(requirement).model_fields:
        facts = schema["properties"][name]
        value = getattr(requirement, name)
        if _pair(facts.get("items")):
            found += _line(name, name, value, partial(_replaced, name, value))
        elif _pose(facts.get("items")):
            found += [
                Target(f"{name} {number}", pose[:2], partial(_moved, name, value, number - 1), name)
                for number, pose in enumerate(value, start=1)
            ]
        elif _pair(facts.get("items", {}).get("items")):
            for number, points in enumerate(value, start=1):
                found += _line(name, f"{name} {number}", points, partial(_replaced_in_all, name, value))
    return tuple(found)


def _pair(facts: Any) -> bool:
    """Whether a schema is that of two lengths, mm."""
    items = facts.get("prefixItems", ()) if isinstance(facts, dict) else ()
    return len(items) == 2 and all(item.get("unit") == "mm" for item in items)


def _pose(facts: Any) -> bool:
    """Whether a schema is that of two lengths, mm, and a direction."""
    items = facts.get("prefixItems", ()) if isinstance(facts, dict) else ()
    return [item.get("unit") for item in items] == ["mm", "mm", "deg"]


def _moved(key: str, poses: tuple[Place, ...], index: int, new: Place) -> dict[str, Any]:
    """The poses with one at another place."""
    place = [round(float(value), DECIMALS) for value in new]
    return {key: [[*place, *pose[2:]] if n == index else [*pose] for n, pose in enumerate(poses)]}


def _line(
    key: str, line: str, points: tuple[Place, ...], replaced: Callable[[Place, Place], Mapping[str, Any]]
) -> list[Target]:
    join = "," if line != key else ""
    return [
        Target(f"{line}{join} {number}", point, partial(replaced, point), line)
        for number, point in enumerate(points, start=1)
    ]


def _replaced(key: str, points: tuple[Place, ...], old: Place, new: Place) -> dict[str, Any]:
    return {key: exchanged(points, old, new)}


def _replaced_in_all(
    key: str, lines: tuple[tuple[Place, ...], ...], old: Place, new: Place
) -> dict[str, Any]:
    return {key: [exchanged(points, old, new) for points in lines]}


def exchanged(points: tuple[Place, ...], old: Place, new: Place) -> list[list[float]]:
    """Points with one of them at another place, as a table of a file holds them.

    >>> exchanged(((0.0, 1.0), (2.0, 3.0)), (0.0, 1.0), (0.5, 0.25))
    [[0.5, 0.25], [2.0, 3.0]]
    """
    return [[round(part, DECIMALS) for part in new] if point == old else list(point) for point in points]
