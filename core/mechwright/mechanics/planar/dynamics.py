"""Forces in a linkage whose motion is known: Newton and Euler for every body, one linear system per sample.

Glossary
--------
link
    A moving body with mass; the ground is the body named ``GROUND``.
pin
    A joint that carries a force (two unknowns) through one point.
slide
    A joint along a direction that carries a normal force and a moment (two unknowns).
drive
    The moment from the ground that keeps a link moving as it does (one unknown). Of links that gears turn
    with each other each has its own; what the first one's shaft takes is their sum, each times its ratio.

With the centre of mass G of a link, Σ F = m a_G and Σ (r - G) × F + Σ M = I α. A linkage with one degree of
freedom and one drive has as many unknowns as equations.

Units are any consistent ones: kg, mm and s give forces in mN and moments in mN mm (µN m).
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from mechwright.arrays import Array
from mechwright.errors import KinematicsError
from mechwright.mechanics.planar.rigid import BodyMotion, Plane, PointMotion

GROUND = "ground"
"""Name of the body that does not move."""

BLOCK = 2048
"""Systems that are solved together."""


@dataclass(frozen=True)
class Link:
    """A moving body with mass.

    Parameters
    ----------
    name
        Its own.
    motion
        Samples (n,).
    mass
        kg.
    centre
        Centre of mass in the body's coordinates, x + i y, mm.
    inertia
        Moment of inertia about the centre of mass, kg mm².
    """

    name: str
    motion: BodyMotion
    mass: float
    centre: complex = 0j
    inertia: float = 0.0

    @property
    def centre_motion(self) -> PointMotion:
        """Motion of the centre of mass."""
        return self.motion.point(self.centre)


@dataclass(frozen=True)
class Pin:
    """A pin at ``place`` (n,), mm; its force is that of the body ``one`` on the body ``two``."""

    name: str
    one: str
    two: str
    place: Plane


@dataclass(frozen=True)
class Slide:
    """A slide along ``direction``, a unit vector (n,) or constant, that holds ``two`` at ``place`` (n,).

    Its force on ``two`` by ``one`` acts at ``place``, normal to the direction, together with a moment.
    """

    name: str
    one: str
    two: str
    direction: Plane | complex
    place: Plane


@dataclass(frozen=True)
class Load:
    """A given force (n,) or constant that acts on ``body`` at ``place`` (n,), and a moment."""

    body: str
    force: Plane | complex
    place: Plane
    moment: Array | float = 0.0


@dataclass(frozen=True)
class Forces:
    """What the joints carry.

    Parameters
    ----------
    joints
        Name of a joint to its force (n,) on its body ``two``, mN.
    moments
        Name of a slide to its moment (n,) on its body ``two`` about the slide's place, mN mm.
    drives
        Driven link to the moment (n,) of the ground on it, mN mm.
    shaking
        Force (n,) of the moving links' inertia on the ground, - Σ m a_G, mN; the loads are not in it.
    """

    joints: dict[str, Plane]
    moments: dict[str, Array]
    drives: dict[str, Array]
    shaking: Plane

    @property
    def drive(self) -> Array:
        """Moment (n,) on the first driven link, mN mm."""
        return next(iter(self.drives.values()))

    def scaled(self, factor: float) -> "Forces":
        """The same in another unit: with 1e-3 in N and N mm."""
        joints = {name: force * factor for name, force in self.joints.items()}
        moments = {name: moment * factor for name, moment in self.moments.items()}
        drives = {name: moment * factor for name, moment in self.drives.items()}
        return Forces(joints, moments, drives, self.shaking * factor)


def forces(
    links: Sequence[Link],
    joints: Sequence[Pin | Slide],
    driven: str | Sequence[str],
    loads: Sequence[Load] = (),
) -> Forces:
    """Forces in all joints, and the moments that drive the link ``driven``, or the links.

    Raises
    ------
    KinematicsError
        The linkage has not as many unknowns as equations, a joint or load names a body that is not there, or
        the linkage is in a dead centre, where no finite moment drives it.

    Examples
    --------
    A mass of 2 kg on a crank of 10 mm at 3 rad/s pulls with 2 · 10 · 9 mN:

    >>> from mechwright.mechanics.planar import Turning
    >>> crank = Link("crank", BodyMotion.about(0j, Turning.of([0.0], 3.0)), 2.0, 10 + 0j)
    >>> found = forces([crank], [Pin("shaft", GROUND, "crank", np.zeros(1, complex))], "crank")
    >>> found.joints["shaft"].round(9).tolist(), found.shaking.round(9).tolist()
    ([(-180+0j)], [(180-0j)])
    """
    row = {link.name: 3 * number for number, link in enumerate(links)}
    count = 3 * len(links)
    driving = (driven,) if isinstance(driven, str) else tuple(driven)
    unknowns = 2 * len(joints) + len(driving)
    if unknowns != count:
        said = "a drive" if len(driving) == 1 else f"{len(driving)} drives"
        raise KinematicsError(
            f"{len(links)} links give {count} equations, but {len(joints)} joints and {said} have "
            f"{unknowns} unknowns; the linkage needs one degree of freedom for each drive"
        )
    named = {name for joint in joints for name in (joint.one, joint.two)} | {load.body for load in loads}
    missing = (named | set(driving)) - set(row) - {GROUND}
    if missing or GROUND in driving:
        raise KinematicsError(f"no moving link is called {', '.join(sorted(missing)) or GROUND}")
    centres = {link.name: link.centre_motion for link in links}
    solution = _solved(joints, centres, row, driving, _right(links, loads, centres, row))
    found: dict[str, Plane] = {}
    moments: dict[str, Array] = {}
    for number, joint in enumerate(joints):
        one: Array = solution[:, 2 * number]
        two: Array = solution[:, 2 * number + 1]
        if isinstance(joint, Pin):
            found[joint.name] = one + 1j * two
        else:
            (normal,) = _directions(joint, len(solution))
            found[joint.name], moments[joint.name] = one * normal, two
    shaking: Plane = -np.sum([link.mass * centres[link.name].acceleration for link in links], axis=0)
    drives: dict[str, Array] = {
        name: solution[:, 2 * len(joints) + number] for number, name in enumerate(driving)
    }
    return Forces(found, moments, drives, shaking)


def _solved(
    joints: Sequence[Pin | Slide],
    centres: Mapping[str, PointMotion],
    row: Mapping[str, int],
    driven: Sequence[str],
    right: Array,
) -> Array:
    """The unknowns (n, k) for right sides (n, k), in blocks: all matrices at once fill the memory."""
    found = np.empty_like(right)
    try:
        for first in range(0, len(right), BLOCK):
            some = slice(first, first + BLOCK)
            matrix = _matrix(joints, centres, row, driven, some)
            found[some] = np.linalg.solve(matrix, right[some, :, None])[:, :, 0]
    except np.linalg.LinAlgError as error:
        raise KinematicsError("the linkage is in a dead centre, where no finite moment drives it") from error
    return found


def _right(
    links: Sequence[Link], loads: Sequence[Load], centres: Mapping[str, PointMotion], row: Mapping[str, int]
) -> Array:
    """What inertia and loads ask of the joints, (n, 3 per link)."""
    samples = next(iter(centres.values())).position.size
    right = np.zeros((samples, 3 * len(links)))
    for link in links:
        first, acceleration = row[link.name], centres[link.name].acceleration
        right[:, first] = link.mass * acceleration.real
        right[:, first + 1] = link.mass * acceleration.imag
        right[:, first + 2] = link.inertia * link.motion.turning.alpha
    for load in loads:
        if load.body == GROUND:
            continue
        first, force = row[load.body], np.asarray(load.force, dtype=complex)
        right[:, first] -= force.real
        right[:, first + 1] -= force.imag
        right[:, first + 2] -= _cross(load.place - centres[load.body].position, force) + load.moment
    return right


def _matrix(
    joints: Sequence[Pin | Slide],
    centres: Mapping[str, PointMotion],
    row: Mapping[str, int],
    driven: Sequence[str],
    some: slice,
) -> Array:
    """What the unknowns of joints and drive do to each link at some samples, (m, 3 per link, unknowns)."""
    at = {name: centre.position[some] for name, centre in centres.items()}
    samples, count = next(iter(at.values())).size, 3 * len(row)
    matrix = np.zeros((samples, count, count))
    for number, joint in enumerate(joints):
        for body, sign in ((joint.one, -1.0), (joint.two, 1.0)):
            if body == GROUND:
                continue
            first, lever = row[body], joint.place[some] - at[body]
            for column, vector in enumerate(_directions(joint, samples, some), start=2 * number):
                matrix[:, first, column] = sign * vector.real
                matrix[:, first + 1, column] = sign * vector.imag
                matrix[:, first + 2, column] = sign * _cross(lever, vector)
            if isinstance(joint, Slide):
                matrix[:, first + 2, 2 * number + 1] = sign
    for number, name in enumerate(driven, start=2 * len(joints)):
        matrix[:, row[name] + 2, number] = 1.0
    return matrix


def _directions(joint: Pin | Slide, samples: int, some: slice = slice(None)) -> tuple[Plane, ...]:
    """Unit vectors of the forces that a joint can carry, at so many samples, which are some of its own."""
    if isinstance(joint, Pin):
        return np.ones(samples, complex), np.full(samples, 1j)
    direction = np.asarray(joint.direction, dtype=complex)
    return (np.broadcast_to(1j * (direction[some] if direction.ndim else direction), (samples,)),)


def _cross(lever: ArrayLike, force: ArrayLike) -> Array:
    """Moment of a force at a lever."""
    moment: Array = (np.conj(lever) * np.asarray(force)).imag
    return moment
