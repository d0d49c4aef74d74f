"""Assembly and solution of the equations of Newton and Euler for all links of a linkage.

With the centre of mass G of a link, Σ F = m a_G and Σ (r - G) × F + Σ M = I α: three rows per link. Each
column is one unknown of a joint or actuator with the value 1, which acts on two or three bodies.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from mechwright.arrays import Array
from mechwright.errors import KinematicsError
from mechwright.mechanics.planar.free_bodies import GROUND, Actuator, Gears, Joint, Link, Load, Pin
from mechwright.mechanics.planar.rigid import Plane, PointMotion

BLOCK = 2048
"""Systems that are solved together."""


@dataclass(frozen=True)
class Action:
    """What a unit of an unknown does to one body: a force at a place, or None, and a moment."""

    body: str
    force: Any
    place: Any
    moment: Any = 0.0


def actions(joint: Joint | Actuator) -> Iterator[tuple[Action, ...]]:
    """For each unknown of a joint or actuator its actions on the bodies."""
    if isinstance(joint, Gears):
        moments = (joint.two, 1.0), (joint.one, -joint.ratio), (joint.carrier, joint.ratio - 1)
        yield tuple(Action(body, None, None, moment) for body, moment in moments)
        return
    if isinstance(joint, Actuator):
        if joint.direction is None:
            yield Action(joint.link, None, None, 1.0), Action(joint.on, None, None, -1.0)
        else:
            yield from _forces(joint.on, joint.link, joint.place, joint.direction)
        return
    if isinstance(joint, Pin):
        yield from _forces(joint.one, joint.two, joint.place, 1.0, 1j)
        return
    yield from _forces(joint.one, joint.two, joint.place, 1j * np.asarray(joint.direction))
    yield Action(joint.one, None, None, -1.0), Action(joint.two, None, None, 1.0)


def _forces(one: str, two: str, place: Any, *vectors: Any) -> Iterator[tuple[Action, ...]]:
    """Unit forces of a body on another one at a place."""
    for vector in vectors:
        yield (
            Action(one, -np.asarray(vector, complex), place),
            Action(two, np.asarray(vector, complex), place),
        )


def unknowns(
    links: Sequence[Link], joints: Sequence[Joint | Actuator], loads: Sequence[Load], gravity: complex
) -> tuple[list[Array], Mapping[str, PointMotion]]:
    """Solve for joints and actuators.

    Returns
    -------
    values, centres
        The unknowns (..., n) in the order of :func:`actions`, and the motions of the centres of mass. Values
        are NaN where a motion is NaN, and for several designs where one is in a dead centre.

    Raises
    ------
    KinematicsError
        The one design is in a dead centre.
    """
    centres = {link.name: link.centre_motion for link in links}
    columns = [column for joint in joints for column in actions(joint)]
    shape = np.broadcast_shapes(
        *(centre.position.shape for centre in centres.values()),
        *(np.shape(one.place) for column in columns for one in column if one.force is not None),
        *(np.shape(part) for load in loads for part in (load.force, load.place, load.moment)),
    )
    flat = _Flat(shape)
    row = {link.name: 3 * number for number, link in enumerate(links)}
    at = {name: flat(centre.position) for name, centre in centres.items()}
    right = _right(links, loads, gravity, centres, flat)
    ready = [
        [
            Action(
                one.body, None if one.force is None else flat(one.force), flat(one.place), flat(one.moment)
            )
            for one in column
            if one.body != GROUND
        ]
        for column in columns
    ]
    found = np.empty_like(right)
    for first in range(0, len(right), BLOCK):
        some = slice(first, first + BLOCK)
        found[some] = _solved(_matrix(ready, at, row, some), right[some], single=len(shape) < 2)
    return [found[:, number].reshape(shape) for number in range(found.shape[1])], centres


@dataclass(frozen=True)
class _Flat:
    """Arrays of one shape as one axis; a constant takes no room."""

    shape: tuple[int, ...]

    def __call__(self, values: Any) -> Any:
        if values is None or np.ndim(values) == 0:
            return np.broadcast_to(np.asarray(0.0 if values is None else values), (int(np.prod(self.shape)),))
        return np.broadcast_to(values, self.shape).reshape(-1)


def _right(
    links: Sequence[Link],
    loads: Sequence[Load],
    gravity: complex,
    centres: Mapping[str, PointMotion],
    flat: _Flat,
) -> Array:
    """What inertia, weight and loads ask of the joints, (samples, 3 per link)."""
    right = np.zeros((int(np.prod(flat.shape)), 3 * len(links)))
    row = {link.name: 3 * number for number, link in enumerate(links)}
    for link in links:
        first, acceleration = row[link.name], centres[link.name].acceleration - gravity
        right[:, first] = flat(link.mass * acceleration.real)
        right[:, first + 1] = flat(link.mass * acceleration.imag)
        right[:, first + 2] = flat(link.inertia * link.motion.turning.alpha)
    for load in loads:
        if load.body == GROUND:
            continue
        first, force = row[load.body], np.asarray(load.force, dtype=complex)
        right[:, first] -= flat(force.real)
        right[:, first + 1] -= flat(force.imag)
        right[:, first + 2] -= flat(_cross(load.place - centres[load.body].position, force) + load.moment)
    return right


def _matrix(
    columns: Sequence[Sequence[Action]], at: Mapping[str, Plane], row: Mapping[str, int], some: slice
) -> Array:
    """What the unknowns do to each link at some samples, (m, 3 per link, unknowns)."""
    count = 3 * len(row)
    samples = len(next(iter(at.values()))[some])
    matrix = np.zeros((samples, count, count))
    for number, column in enumerate(columns):
        for one in column:
            first, moment = row[one.body], one.moment[some]
            if one.force is not None:
                force = one.force[some]
                matrix[:, first, number] = force.real
                matrix[:, first + 1, number] = force.imag
                moment = moment + _cross(one.place[some] - at[one.body][some], force)
            matrix[:, first + 2, number] += moment
    return matrix


def _solved(matrix: Array, right: Array, *, single: bool) -> Array:
    """Solutions (m, k) of systems (m, k, k); NaN where one is not finite, or is singular among designs."""
    finite = np.isfinite(matrix.sum(axis=(1, 2))) & np.isfinite(right.sum(axis=1))
    if not finite.all():
        found = np.full_like(right, np.nan)
        if finite.any():
            found[finite] = _solved(matrix[finite], right[finite], single=single)
        return found
    try:
        return np.asarray(np.linalg.solve(matrix, right[:, :, None])[:, :, 0], dtype=np.float64)
    except np.linalg.LinAlgError as error:
        if single:
            raise KinematicsError(
                "the linkage is in a dead centre, where no finite moment drives it"
            ) from error
    if len(matrix) == 1:
        return np.full_like(right, np.nan)
    half = len(matrix) // 2
    parts = [_solved(matrix[some], right[some], single=False) for some in (slice(half), slice(half, None))]
    return np.concatenate(parts)


def _cross(lever: ArrayLike, force: ArrayLike) -> Array:
    """Moment of a force at a lever."""
    moment: Array = (np.conj(lever) * np.asarray(force)).imag
    return moment
