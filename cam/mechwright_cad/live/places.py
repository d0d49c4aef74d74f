"""The places that a requirement or a design states, as a page draws them: in the plane, or on a sphere."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from mechwright.contracts.motion import Channel, Motion
from mechwright.contracts.target import Target
from mechwright.errors import DesignError
from mechwright_cad.animation.figures import DRAWN
from mechwright_cad.animation.plane import window
from mechwright_cad.animation.scene import scene

NOTHING = "still"
"""Channel of a picture in which nothing moves."""


def drawn(places: Sequence[Target]) -> list[dict[str, Any]]:
    """Name, place and line of each."""
    return [
        {"name": one.name, "place": [float(part) for part in one.place], "line": one.line} for one in places
    ]


def dragged(places: Sequence[Target], body: Mapping[str, Any]) -> Mapping[str, Any]:
    """What the table says once the target that a page names is at the place that it sends.

    Raises
    ------
    DesignError
        The page sent no target or no place, or there is no such target.
    """
    name, to = body.get("target"), body.get("place")
    if not isinstance(name, str):
        raise DesignError("the page sent no target")
    if not isinstance(to, list) or not all(type(part) in {int, float} for part in to):
        raise DesignError("the page sent no place")
    for one in places:
        if one.name == name and len(one.place) == len(to):
            return one.moved(tuple(to))
    raise DesignError(f"{name}: there is no such place now")


def still(places: Sequence[Target], found: Mapping[str, Any] | None = None) -> dict[str, Any]:
    """A picture that has room for all places: of a design's motion, or of nothing else."""
    points = np.array([[*one.place, 0.0][:3] for one in places]).reshape(-1, 3)
    space = any(len(one.place) == 3 for one in places)
    if found is None:
        nothing = Motion(NOTHING, {NOTHING: Channel(np.zeros(2), "", "nothing moves yet")})
        found = scene((), nothing, solids=False)
        if not space:
            around = [np.zeros((1, 3)), points]  # from where the places are measured, too
            return {**found, "window": window((), solids=False, paths=around)}
        radius = round(float(np.linalg.norm(points, axis=1).max()), DRAWN)
        flat = {key: value for key, value in found.items() if key not in {"layers", "window"}}
        return {**flat, "meshes": [], "ball": {"centre": [0, 0, 0], "radius": radius}, "up": [0, 0, 1]}
    if not places or "window" not in found:
        return dict(found)
    left, bottom, wide, high = found["window"]
    corners = np.array([[left, bottom, 0.0], [left + wide, bottom + high, 0.0]])
    inside = (points > corners[0]).all(axis=0) & (points < corners[1]).all(axis=0)
    if inside[:2].all():
        return dict(found)
    return {**found, "window": window((), solids=False, paths=[points, corners])}
