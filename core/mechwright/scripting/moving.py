"""Small moving pictures of designs: what a page needs to draw a mechanism at some moments of its period."""

import json
from pathlib import Path
from typing import Any

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.joint import GROUND
from mechwright.contracts.motion import Motion, Poses
from mechwright.contracts.part import Part
from mechwright.errors import MechwrightError
from mechwright.scripting.mechanism import Mechanism

SHOWING = Path(__file__).parent
"""Folder of the style and the script of pages with such pictures: ``shown.css`` and ``moving.js``."""

FRAMES = 72
"""Moments of a period: steps of five degrees of a turn look smooth at this size."""

CHORD = 0.001
"""Chord error of outlines as part of the picture: a fifth of a pixel."""

BORDER = 0.04
"""Free border around it, as part of its greater side."""

DOTS = 200
"""Points asked for that a picture shows at most: more are a line at this size."""

FLAT = 1e-6
"""By how much an axis may lean from the view and still be seen as a point."""

VIEW = np.array([[0.866, 0.5, 0.0], [-0.25, 0.433, 0.866]])
"""Of mechanisms in space: rows are x and y of the picture, seen from a corner, 30 degrees from above."""


def moving(mechanism: Mechanism, asked: Array | None = None) -> dict[str, Any] | None:
    """The picture of a mechanism: shapes, and a matrix of each at every moment; None where nothing moves.

    ``shapes`` are ``path``, ``colour`` and ``at`` (frames, 6), the matrices of SVG, a single one of what
    rests; or, in space, ``at`` (frames, 2 k), the corners of a line. ``traces`` are paths of points;
    ``window`` is left, bottom, width and height, mm, y upwards. ``asked`` is a path of dots at the points
    asked for, (k, 3) in the design's frame, mm.
    """
    try:
        motion = mechanism.design.solve(FRAMES + 1)
    except MechwrightError:
        return None
    plane = all(np.abs(poses.rotation[:, :2, 2]).max() < FLAT for poses in motion.poses.values())
    view = np.eye(3)[:2] if plane else VIEW
    seen = [motion.path(name)[:FRAMES] @ view.T for name in motion.traces]
    plates = _plates(mechanism.design.parts(), motion) if plane else []
    lines = [] if plates else _lines(motion, view)
    every = [*seen, *(points for _, _, points in plates), *lines]
    if not every:
        return None
    dots = np.empty((0, 2)) if asked is None else asked[:: 1 + len(asked) // DOTS] @ view.T
    every.append(dots)
    places = np.concatenate([points.reshape(-1, 2) for points in every])
    low, size = places.min(axis=0), np.ptp(places, axis=0)
    border = BORDER * float(size.max())
    shapes = [
        {"path": _path(_slim(outline, CHORD * float(size.max()))), "colour": colour, "at": _matrices(poses)}
        for (outline, colour), poses, _ in plates
    ] or [{"at": np.round(line.reshape(len(line), -1), 2).tolist()} for line in lines]
    window = [*(low - border), *(size + 2 * border)]
    return {
        "window": np.round(window, 2).tolist(),
        "shapes": shapes,
        "traces": [_path([points]) for points in seen],
        "asked": "".join(f"M{x:g} {y:g}h0" for x, y in (np.round(dots, 2) + 0.0).tolist()),
    }


def for_script(data: Any) -> str:
    """Data for a script on a page; nothing in it may end that."""
    return json.dumps(data).replace("<", "\\u003c")


def _plates(parts: Any, motion: Motion) -> list[tuple[tuple[list[Array], str], Poses, Array]]:
    """Loops and colour of each plate from the lowest up, its poses, and where its corners come (n, k, 2)."""
    still = Poses(np.zeros((1, 3)), np.eye(3)[None])
    found = []
    placed = [(part, one) for part in parts for one in part.instances]
    for part, one in sorted(placed, key=_height):
        poses = still if one.body == GROUND else motion.poses.get(one.body)
        if part.outline is None or poses is None:
            continue
        loops = [loop.flatten() for loop in (part.outline.outer, *part.outline.inner)]
        colour = "#" + "".join(f"{round(255 * share):02x}" for share in part.colour_of(one))
        outer = np.column_stack((loops[0], np.zeros(len(loops[0]))))
        found.append(((loops, colour), poses, poses.transform(outer)[:FRAMES, :, :2]))
    return found


def _height(pair: tuple[Part, Any]) -> float:
    return float(pair[1].z)


def _lines(motion: Motion, view: Array) -> list[Array]:
    """The joints of each body as corners of a line (frames, k, 2); of those with two and more."""
    of: dict[str, list[Array]] = {}
    for joint in motion.joints.values():
        if joint.kind in {"fixed", "gear"}:
            continue
        point = np.array([joint.point])
        path = motion.poses[joint.one].transform(point)[:, 0] if joint.one != GROUND else point
        for body in (joint.one, joint.two):
            of.setdefault(body, []).append(np.broadcast_to(path, (motion.samples, 3))[:FRAMES] @ view.T)
    for name, trace in motion.traces.items():
        of.setdefault(trace.body, []).append(motion.path(name)[:FRAMES] @ view.T)
    return [np.stack(points, axis=1) for points in of.values() if len(points) > 1]


def _matrices(poses: Poses) -> list[list[float]]:
    """The matrix of a body at each moment, as SVG's ``matrix`` wants its six numbers; one where it rests."""
    turn, place = poses.rotation[:FRAMES, :2, :2], poses.position[:FRAMES, :2]
    rows = np.concatenate([np.round(turn.transpose(0, 2, 1).reshape(-1, 4), 4), np.round(place, 2)], axis=1)
    rests = bool((rows == rows[0]).all())
    found: list[list[float]] = ((rows[:1] if rests else rows) + 0.0).tolist()
    return found


def _slim(loops: list[Array], chord: float) -> list[Array]:
    import shapely

    return [shapely.get_coordinates(shapely.simplify(shapely.LinearRing(one), chord))[:-1] for one in loops]


def _path(loops: list[Array]) -> str:
    """The ``d`` of an SVG path.

    >>> _path([np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 1.5]])])
    'M0 0L2 0L2 1.5Z'
    """
    told = ((np.round(loop, 2) + 0.0).tolist() for loop in loops)
    return "".join("M" + "L".join(f"{x:g} {y:g}" for x, y in points) + "Z" for points in told)
