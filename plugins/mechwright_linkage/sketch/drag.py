"""Points of a drawn linkage as places that a page lets one drag."""

from collections.abc import Mapping
from functools import partial
from typing import Any

from mechwright import Target
from mechwright.contracts.target import DECIMALS, Place
from mechwright_linkage.parameters import LinkageParams


def point_handles(params: LinkageParams) -> tuple[Target, ...]:
    """The points as drawn, mm, in ``scale``; none of a linkage of the catalogue.

    Examples
    --------
    >>> point_handles(LinkageParams(linkage="jansen"))
    ()
    """
    return tuple(
        Target(name, (point.x * params.scale, point.y * params.scale), partial(_moved, name, params.scale))
        for name, point in params.points.items()
    )


def _moved(name: str, scale: float, place: Place) -> Mapping[str, Any]:
    """Keys of [parameters] with the coordinates of a point that is dragged to a place, mm."""
    x, y = (round(part / scale, DECIMALS) for part in place)
    return {f"points.{name}.x": x, f"points.{name}.y": y}
