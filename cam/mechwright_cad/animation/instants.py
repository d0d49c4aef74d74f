"""What is drawn of a plane motion besides bodies: poles, circles, velocities, and lines fixed to bodies.

It comes from the poses alone, so that it is there for every family.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from mechwright.arrays import Array
from mechwright.contracts.motion import TIME, Motion, Poses
from mechwright.mechanics.planar import BodyMotion, PointMotion, Turning, acceleration_pole
from mechwright.mechanics.planar.poles import circles
from mechwright_cad.animation.figures import ANGLE, DRAWN, MICRON, hidden, rounded
from mechwright_cad.animation.skeleton import leaders

SWING = 1e-6
"""A body that turns by less, rad, has its instant centre at infinity."""

RESTS = 1e-4
"""An instant centre that moves less, mm, is a pivot, and nothing to be shown."""

STANDS = 1e-3
"""A body whose velocities are a smaller part of its greatest stands; what they give there is rounding."""


def independent_variable(motion: Motion) -> tuple[Array, bool]:
    """Over what rates are taken (n,), s or rad, and whether the motion comes back to where it began."""
    over = motion.channels[TIME if TIME in motion.channels else motion.input_name].values
    ends = [np.abs(x[-1] - x[0]).max() for p in motion.poses.values() for x in (p.position, p.rotation)]
    return over, bool(ends) and max(ends) < SWING


def rates(values: Array, over: Array, *, comes_back: bool) -> tuple[Array, Array]:
    """First two rates (n, ...) of sampled values (n, ...); a part that grows evenly may not come back.

    >>> over = np.linspace(0, 2 * np.pi, 91)
    >>> first, second = rates(np.sin(over), over, comes_back=True)
    >>> bool(abs(first - np.cos(over)).max() < 1e-5), bool(abs(second + np.sin(over)).max() < 1e-3)
    (True, True)
    """
    span = over[-1] - over[0]
    even = (values[-1] - values[0]) / span if comes_back else np.zeros_like(values[0])
    level = values - np.multiply.outer(over - over[0], even)
    if comes_back:
        level[-1] = level[0]
    spline = CubicSpline(over, level, bc_type="periodic" if comes_back else "not-a-knot")
    return spline(over, 1) + even, spline(over, 2)


def body_motion(poses: Poses, over: Array, *, comes_back: bool) -> BodyMotion:
    """The motion of a body in the plane with its rates, from its poses."""
    place = poses.position[:, 0] + 1j * poses.position[:, 1]
    angle = np.unwrap(np.arctan2(poses.rotation[:, 1, 0], poses.rotation[:, 0, 0]))
    (vx, ax), (vy, ay), (w, al) = (
        rates(values, over, comes_back=comes_back) for values in (place.real, place.imag, angle)
    )
    return BodyMotion(PointMotion.of(place, vx + 1j * vy, ax + 1j * ay), Turning.of(angle, w, al))


def standstill(body: BodyMotion) -> NDArray[np.bool_]:
    """Where a body (n,) stands: neither its origin moves, nor does it turn.

    The instant centre is the acceleration pole there: with v = w x r and w = 0, both are where a = α x r.
    """
    moves, turns = np.abs(body.origin.velocity), np.abs(body.turning.omega)
    still: NDArray[np.bool_] = (moves <= STANDS * moves.max()) & (turns <= STANDS * turns.max())
    return still


def instants(motion: Motion) -> list[dict[str, Any]]:
    """Of each body that turns about no pivot: instant centre, acceleration pole, inflection pole (n,), mm.

    Coordinates are those of the ground. What is at infinity is None, as is the inflection pole of a body that
    stands. ``pose`` is the body's x, y and angle, with which a page brings them into the body.
    """
    over, comes_back = independent_variable(motion)
    if len(over) < 5 or not (np.diff(over) > 0).all():
        return []
    leader = leaders(motion.joints, ["", *motion.poses])
    found = []
    for name, poses in motion.poses.items():
        if leader[name] != name or poses.rotation[0, 2, 2] < 0:
            continue
        body = body_motion(poses, over, comes_back=comes_back)
        if np.ptp(body.turning.theta) < SWING:
            continue
        known, stands = circles(body), standstill(body)
        if np.nanmax(np.abs(known.instant_centre - known.instant_centre[0]), initial=0.0) < RESTS:
            continue
        marks = {
            "centre": np.where(stands, acceleration_pole(body).fixed, known.instant_centre),
            "pole": acceleration_pole(body).fixed,
            "opposite": np.where(stands, complex(np.nan, np.nan), known.inflection_pole),
        }
        pose = [body.origin.position.real, body.origin.position.imag, body.turning.theta]
        found.append(
            {
                "body": name,
                "pose": [rounded(pose[0], MICRON), rounded(pose[1], MICRON), rounded(pose[2], ANGLE)],
                **{key: [hidden(mark.real, DRAWN), hidden(mark.imag, DRAWN)] for key, mark in marks.items()},
            }
        )
    return found


def arrows(motion: Motion) -> dict[str, dict[str, Any]]:
    """Velocity and acceleration of each traced point, as parts of its greatest: columns x and y."""
    over, comes_back = independent_variable(motion)
    if len(over) < 5 or not (np.diff(over) > 0).all():
        return {}
    found: dict[str, dict[str, Any]] = {}
    for name in motion.traces:
        path = motion.path(name)[:, :2]
        found[name] = {}
        for word, rate in zip(
            ("velocity", "acceleration"), rates(path, over, comes_back=comes_back), strict=True
        ):
            most = float(np.linalg.norm(rate, axis=1).max()) or 1.0
            found[name][word] = [rounded(column, 4) for column in (rate / most).T]
    return found


def lines(motion: Motion) -> list[dict[str, Any]]:
    """The curves that a motion names, each with the body that it is fixed to, as the path of a picture."""
    found = []
    for name, curve in motion.curves.items():
        points = (np.round(curve.points[:, :2], DRAWN) + 0.0).tolist()
        found.append(
            {"name": name, "body": curve.body, "path": "M" + "L".join(f"{x:g} {y:g}" for x, y in points)}
        )
    return found
